//! The promises of the bridges.

use std::io::ErrorKind as IoError;

use embedded_hal::digital::{ErrorKind as PinKind, PinState};
use embedded_hal::pwm::ErrorKind as PwmKind;
use embedded_hal_mock::eh1::{MockError, digital, pwm};
use joint_drivers::Direction;
use joint_drivers::h_bridge::{DriveError, FullScale, LockedAntiphase, SignMagnitude};

/// A PWM channel of 1000 counts that expects these duties.
pub(crate) fn channel(duties: &[u16]) -> pwm::Mock {
    let mut all = vec![pwm::Transaction::max_duty_cycle(1000)];
    all.extend(duties.iter().map(|duty| pwm::Transaction::set_duty_cycle(*duty)));
    pwm::Mock::new(&all)
}

fn newton_metres(full_scale: f32) -> FullScale {
    FullScale::new(full_scale).unwrap()
}

fn pin(levels: &[digital::State]) -> digital::Mock {
    let set = levels.iter().map(|level| digital::Transaction::set(*level));
    digital::Mock::new(&set.collect::<Vec<_>>())
}

pub(crate) fn done((mut pwm, mut pin): (pwm::Mock, digital::Mock)) {
    pwm.done();
    pin.done();
}

fn failure() -> MockError {
    MockError::Io(IoError::Other)
}

#[test]
fn locked_antiphase_maps_zero_and_nan_to_half_duty() {
    for direction in [Direction::Forward, Direction::Reverse] {
        let mut drive = LockedAntiphase::new(channel(&[500, 500]), newton_metres(3.0), direction);
        drive.set_torque(0.0).unwrap();
        drive.set_torque(f32::NAN).unwrap();
        drive.release().done();
    }
}

#[test]
fn locked_antiphase_duty_is_linear_saturated_and_directed() {
    let torques = [-9.0, -3.0, -1.5, 1.5, 3.0, f32::INFINITY];
    let duties = [0, 0, 250, 750, 1000, 1000];
    for (direction, duties) in
        [(Direction::Forward, duties), (Direction::Reverse, duties.map(|duty| 1000 - duty))]
    {
        let mut drive = LockedAntiphase::new(channel(&duties), newton_metres(3.0), direction);
        for torque in torques {
            drive.set_torque(torque).unwrap();
        }
        drive.release().done();
    }
}

#[test]
fn locked_antiphase_rounds_to_the_nearest_duty() {
    for max in [1000_u16, 8400, 65_534] {
        let mut channel = pwm::Mock::new(&[pwm::Transaction::max_duty_cycle(max)]);
        let drive = LockedAntiphase::new(channel.clone(), newton_metres(2.0), Direction::Forward);
        for step in -1000..=1000 {
            let torque = step as f32 * 0.002;
            let exact = f64::from(max) * (0.5 + f64::from(torque) / 4.0);
            let error = f64::from(drive.duty(torque)) - exact;
            assert!(error.abs() < 0.501, "{max} {torque}: {error}");
        }
        channel.done();
    }
}

#[test]
fn a_full_scale_that_is_not_above_zero_is_refused() {
    for full_scale in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e-38] {
        assert_eq!(FullScale::new(full_scale), Err(DriveError::FullScale));
        for torques in [[1.0, full_scale], [full_scale, 1.0]] {
            assert_eq!(FullScale::of(torques), Err(DriveError::FullScale));
        }
    }
    let both = [newton_metres(1.0), newton_metres(2.0)];
    assert_eq!(FullScale::of([1.0, 2.0]), Ok(both));
}

#[test]
fn sign_magnitude_is_off_while_the_sign_changes() {
    use digital::State::{High, Low};
    let torques = [0.5, 1.0, -1.0, -7.0, 0.0, f32::NAN, -0.5, 2.0];
    //              +      +    −           −    0  NaN  −    +
    let duties = [0, 250, 500, 0, 500, 1000, 0, 0, 250, 0, 1000];
    let mut levels = [High, Low, High];
    for direction in [Direction::Forward, Direction::Reverse] {
        let (pwm, pin, scale) = (channel(&duties), pin(&levels), newton_metres(2.0));
        let mut drive = SignMagnitude::new(pwm, pin, scale, direction);
        for torque in torques {
            drive.set_torque(torque).unwrap();
        }
        done(drive.release());
        levels = [Low, High, Low];
    }
}

#[test]
fn sign_magnitude_is_symmetric_up_to_full_duty() {
    let (pwm, pin, scale) = (channel(&[]), pin(&[]), newton_metres(2.0));
    let drive = SignMagnitude::new(pwm, pin, scale, Direction::Forward);
    for torque in [2.0, 1e30, f32::INFINITY] {
        assert_eq!(drive.sign_and_duty(torque), (PinState::High, 1000));
        assert_eq!(drive.sign_and_duty(-torque), (PinState::Low, 1000));
    }
    for step in 1..1000 {
        let torque = step as f32 * 0.002;
        let [forward, back] = [torque, -torque].map(|torque| drive.sign_and_duty(torque).1);
        assert_eq!(forward, back);
    }
    done(drive.release());
}

// The next torque sets the sign again.
#[test]
fn a_pin_error_leaves_the_bridge_off() {
    use digital::State::{High, Low};
    let levels = [
        digital::Transaction::set(High),
        digital::Transaction::set(Low).with_error(failure()),
        digital::Transaction::set(High),
    ];
    let (pwm, pin) = (channel(&[0, 1000, 0, 0, 1000]), digital::Mock::new(&levels));
    let mut drive = SignMagnitude::new(pwm, pin, newton_metres(1.0), Direction::Forward);
    assert_eq!(drive.set_torque(1.0), Ok(()));
    assert_eq!(drive.set_torque(-1.0), Err(DriveError::Pin(PinKind::Other)));
    // The pin may have either level.
    assert_eq!(drive.set_torque(1.0), Ok(()));
    done(drive.release());
}

#[test]
fn an_error_of_a_pwm_is_typed() {
    let transactions = [
        pwm::Transaction::max_duty_cycle(1000),
        pwm::Transaction::set_duty_cycle(500).with_error(failure()),
    ];
    let channel = pwm::Mock::new(&transactions);
    let mut drive = LockedAntiphase::new(channel, newton_metres(1.0), Direction::Forward);
    assert_eq!(drive.set_torque(0.0), Err(DriveError::Pwm(PwmKind::Other)));
    drive.release().done();
}
