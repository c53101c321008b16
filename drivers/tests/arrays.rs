//! Devices through the traits by which a loop reads and sets all joints, and the ends of their
//! ranges.

use embedded_can::{ExtendedId, Frame, StandardId};
use embedded_hal_mock::eh1::{digital, i2c};
use joint_drivers::as5600::{As5600, As5600Error};
use joint_drivers::can::FdFrame;
use joint_drivers::h_bridge::{FullScale, LockedAntiphase, SignMagnitude};
use joint_drivers::incremental::{
    IncrementalEncoder, IncrementalError, QuadratureCounter, QuadratureDecoder,
};
use joint_drivers::{
    Direction, JointDrive, JointDrives, JointEncoders, JointError, JointMapping, JointRange,
    MultiTurnEncoder, Resolution,
};

use super::absolute::registers;
use super::drives::{channel, done};
use super::identity;

#[test]
fn encoders_of_an_array_are_read_through_their_trait() {
    let turns = [0x0400, 0x0c00].map(|raw| registers(0x20, raw));
    let mut encoders = turns.map(|all| As5600::new(i2c::Mock::new(&all), identity()));
    let quarter = core::f32::consts::FRAC_PI_2;
    assert_eq!(encoders.read(), Ok([quarter, -quarter]));
    let [(), ()] = encoders.map(|encoder| encoder.release().done());
    // The second has no magnet; the first is read nevertheless.
    let all = [registers(0x20, 0).to_vec(), registers(0, 0)[..1].to_vec()];
    let mut encoders = all.map(|all| As5600::new(i2c::Mock::new(&all), identity()));
    let (joint, error) = (1, As5600Error::MagnetAbsent);
    assert_eq!(encoders.read(), Err(JointError { joint, error }));
    let [(), ()] = encoders.map(|encoder| encoder.release().done());
}

#[test]
fn an_incremental_encoder_of_an_array_is_unknown_before_its_index() {
    let resolution = Resolution::new(40).unwrap();
    let of = |_| {
        let decoder = QuadratureDecoder::new();
        IncrementalEncoder::new(decoder, resolution, identity()).unwrap()
    };
    let mut encoders = [0, 1].map(of);
    let edge = |encoder: &mut IncrementalEncoder<QuadratureDecoder>, z| {
        encoder.counter().update(true, false, z).unwrap();
        encoder.counter().update(true, true, false).unwrap();
    };
    edge(&mut encoders[0], true);
    edge(&mut encoders[1], false);
    let (joint, error) = (1, IncrementalError::NotReferenced);
    assert_eq!(encoders.read(), Err(JointError { joint, error }));
    let mut known = [0].map(of);
    edge(&mut known[0], true);
    assert_eq!(known.read(), Ok([resolution.angle(1)]));
}

#[test]
fn drives_of_an_array_are_set_through_their_trait() {
    let scale = FullScale::new(2.0).unwrap();
    let mut drives = [[500, 750], [500, 250]].map(|all| {
        let pwm = channel(&all);
        LockedAntiphase::new(pwm, scale, Direction::Forward)
    });
    drives.set_torques(&[0.0, 0.0]).unwrap();
    drives.set_torques(&[1.0, -1.0]).unwrap();
    drives.into_iter().for_each(|drive| drive.release().done());
    let level = digital::Mock::new(&[digital::Transaction::set(digital::State::Low)]);
    let mut drive = SignMagnitude::new(channel(&[0, 500]), level, scale, Direction::Forward);
    JointDrive::set_torque(&mut drive, -1.0).unwrap();
    done(drive.release());
}

#[test]
fn an_index_is_the_first_state_in_which_z_is_high() {
    let mut decoder = QuadratureDecoder::new();
    // Z is high in the counts 1 to 3, and again from 5 on.
    for (a, b, z) in [(true, false, true), (true, true, true), (false, true, true)] {
        decoder.update(a, b, z).unwrap();
    }
    assert_eq!((decoder.index(), decoder.index()), (Some(1), None));
    decoder.update(false, false, false).unwrap();
    decoder.update(true, false, true).unwrap();
    assert_eq!(decoder.index(), Some(5));
    // One that is high from the begin on has not been passed.
    let mut decoder = QuadratureDecoder::at(false, false, true);
    decoder.update(true, false, true).unwrap();
    assert_eq!(decoder.index(), None);
}

#[test]
fn an_angle_within_a_turn_has_both_signs() {
    let quarter = core::f32::consts::FRAC_PI_2;
    for turns in [-1000, -1, 0, 1, 10_000] {
        for (raw, angle) in [(4096, quarter), (0x3000, -quarter), (0, 0.0)] {
            let range = JointRange::Near(turns as f32 * core::f32::consts::TAU);
            let mapping = JointMapping::IDENTITY.with_range(range, 1e-3).unwrap();
            let mut joint = MultiTurnEncoder::<14>::new(mapping);
            joint.update(raw).unwrap();
            assert_eq!(joint.within_turn::<f32>(), angle, "{turns} {raw}");
        }
    }
}

#[test]
fn a_frame_has_its_identifier_and_a_length_that_has_a_code() {
    let (standard, extended) = (StandardId::new(0x101).unwrap(), ExtendedId::new(0x101).unwrap());
    let data: [u8; 64] = core::array::from_fn(|at| at as u8);
    for length in 0..=64 {
        let frame = FdFrame::new(standard, &data[..length]);
        let has_code = length <= 8 || [12, 16, 20, 24, 32, 48, 64].contains(&length);
        assert_eq!(frame.is_some(), has_code, "{length}");
        if let Some(frame) = frame {
            assert_eq!((frame.data(), frame.dlc()), (&data[..length], length));
            assert!(frame.is_data_frame() && frame.is_standard());
        }
    }
    assert!(FdFrame::new(extended, &[]).unwrap().is_extended());
    assert_eq!(FdFrame::new(standard, &[]).unwrap().id(), standard.into());
    let remote = FdFrame::new_remote(extended, 8).unwrap();
    assert!(remote.is_remote_frame() && remote.is_extended());
    assert_eq!((remote.data(), remote.dlc()), (&[][..], 8));
    assert!(FdFrame::new_remote(extended, 9).is_none());
}
