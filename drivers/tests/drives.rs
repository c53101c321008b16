//! The promises of the bridges.

use core::f64::consts::TAU;
use std::io::ErrorKind as IoError;

use embedded_hal::digital::{ErrorKind as PinKind, PinState};
use embedded_hal::pwm::ErrorKind as PwmKind;
use embedded_hal_mock::eh1::{MockError, digital, pwm};
use joint_drivers::h_bridge::{DriveError, FullScale, LockedAntiphase, SignMagnitude};
use joint_drivers::three_phase::{Duties, LONGEST, PhaseError, ThreePhase};
use joint_drivers::{Direction, JointMapping};

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

/// v_d and v_q in V of three duties, by the forward transforms in f64.
fn park(phases: [f32; 3], angle: f64, v_dc: f64) -> (f64, f64) {
    let [a, b, c] = phases.map(|duty| f64::from(duty) * v_dc);
    let (alpha, beta) = ((2.0 * a - b - c) / 3.0, (b - c) / 3.0_f64.sqrt());
    let (sin, cos) = angle.sin_cos();
    (alpha * cos + beta * sin, beta * cos - alpha * sin)
}

#[test]
fn the_forward_transforms_of_the_duties_are_the_commanded_voltages() {
    let (mut worst, v_dc) = (0.0_f64, 24.0);
    for step in -200..200 {
        let angle = (step as f32) * 0.37;
        for [d, q] in [[0.0, 13.8], [0.0, -13.8], [5.0, 0.0], [-4.0, 9.0], [3.0, -1.0]] {
            let duties = Duties::new(d, q, angle, v_dc as f32);
            assert!(!duties.is_saturated);
            let (d_out, q_out) = park(duties.phases, f64::from(angle), v_dc);
            let error = (d_out - f64::from(d)).hypot(q_out - f64::from(q));
            worst = worst.max(error / v_dc);
        }
    }
    assert!(worst < 1e-6, "{worst}");
}

// They reach the rails at the longest voltage.
#[test]
fn phases_are_centred_and_reach_the_rails() {
    let mut reached = 0.5_f32;
    for step in 0..3600 {
        let angle = step as f32 * (TAU / 3600.0) as f32;
        let Duties { phases, .. } = Duties::new(0.0, LONGEST * 48.0 * 0.999_99, angle, 48.0);
        let highest = phases.into_iter().fold(0.0, f32::max);
        let lowest = phases.into_iter().fold(1.0, f32::min);
        assert!((highest + lowest - 1.0).abs() < 1e-6 && lowest >= 0.0);
        reached = reached.max(highest);
    }
    // Without centring the same voltage needs a duty of 1.077.
    assert!((reached - 1.0).abs() < 1e-4);
}

// The result says that it is saturated.
#[test]
fn too_long_a_voltage_is_shortened_in_its_direction() {
    for (d, q) in [(0.0, 24.0), (-30.0, 40.0), (1e6, -1e6), (1e9, 1.0)] {
        let duties = Duties::new(d, q, 1.1, 24.0);
        assert!(duties.is_saturated);
        let (d_out, q_out) = park(duties.phases, f64::from(1.1_f32), 24.0);
        let length = d_out.hypot(q_out);
        assert!((length / 24.0 - f64::from(LONGEST)).abs() < 1e-6);
        let (d, q) = (f64::from(d), f64::from(q));
        assert!((d_out * q - q_out * d).abs() < 1e-5 * d.hypot(q) * length);
    }
}

#[test]
fn invalid_voltages_give_no_voltage_and_finite_duties() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for place in 0..4 {
            let mut inputs = [0.0, 1.0, 0.0, 24.0];
            inputs[place] = bad;
            let [d, q, angle, v_dc] = inputs;
            assert_eq!(Duties::new(d, q, angle, v_dc), Duties::ZERO);
        }
    }
    for v_dc in [0.0, -24.0, f32::MIN_POSITIVE] {
        assert_eq!(Duties::new(0.0, 1.0, 0.0, v_dc), Duties::ZERO);
    }
    for extreme in [1e-45, 1e-30, 1.0, 1e9, 1e30, f32::MAX] {
        for angle in [0.0, 1e3, 1e9, f32::MAX] {
            for (d, v_dc) in [(extreme, 1.0), (1.0, extreme), (-extreme, extreme)] {
                let duties = Duties::new(d, extreme, angle, v_dc).phases;
                assert!(duties.iter().all(|duty| (0.0..=1.0).contains(duty)));
            }
        }
    }
}

#[test]
fn the_electrical_angle_follows_zero_direction_and_pole_pairs() {
    let commutation = JointMapping::new(0.2, Direction::Reverse, 1.0 / 4.0).unwrap();
    let Duties { phases, .. } = Duties::new(1.0, 8.0, -4.0 * (0.5 - 0.2), 24.0);
    let channels = phases.map(|duty| channel(&[(duty * 1000.0).round() as u16]));
    let mut motor = ThreePhase::new(channels, commutation);
    assert_eq!(motor.set_voltage(1.0, 8.0, 0.5, 24.0), Ok(false));
    motor.release().iter_mut().for_each(pwm::Mock::done);
}

#[test]
fn a_phase_error_removes_the_voltage_from_all_phases() {
    let transactions = [
        pwm::Transaction::max_duty_cycle(1000),
        pwm::Transaction::set_duty_cycle(644).with_error(failure()),
        pwm::Transaction::set_duty_cycle(500).with_error(failure()),
    ];
    let channels = [channel(&[500, 500]), pwm::Mock::new(&transactions), channel(&[500])];
    let mut motor = ThreePhase::new(channels, JointMapping::IDENTITY);
    let PhaseError { phase, kind, .. } = motor.set_voltage(0.0, 4.0, 0.0, 24.0).unwrap_err();
    assert_eq!((phase, kind), (1, PwmKind::Other));
    motor.release().iter_mut().for_each(pwm::Mock::done);
}
