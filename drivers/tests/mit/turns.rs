//! The joint's position when the drive's count begins again.

use super::*;

/// The reply of a Damiao drive at a count.
fn at(count: u16) -> FdFrame {
    let [high, low] = count.to_be_bytes();
    standard(0x11, &[0x11, high, low, 0x80, 0x08, 0, 30, 30])
}

#[test]
fn positions_go_on_where_the_count_begins_again() {
    let mut drive = damiao();
    let count = 25.0 / 65535.0;
    let mut read = |count| state(drive.reply(&at(count))).position;
    let start = read(0x8000);
    // Less than half a turn between two replies.
    for eighth in [0xa000, 0xc000, 0xe000, 0xff00] {
        read(eighth);
    }
    let before = read(0xfffe);
    assert!(near(before - start, (65534.0 - 32768.0) * count));
    // Both ends are refused, and nothing is changed.
    let after = read(0x0001);
    assert!((after - before - 2.0 * count).abs() < 1e-4, "{after} {before}");
    // Around once more and back.
    for eighth in [0x2000, 0x4000, 0x6000, 0x8000, 0xa000, 0xc000, 0xe000, 0xfff0, 0x2000] {
        read(eighth);
    }
    let twice = read(0x8000 - 0x4000);
    assert!(twice > 25.0);
    for back in [
        0x2000, 0x10, 0xff00, 0xe000, 0xc000, 0xa000, 0x8000, 0x6000, 0x4000, 0x2000, 0x10, 0xfff0,
        0xe000, 0xc000, 0xa000,
    ] {
        read(back);
    }
    assert!((read(0x8000) - start).abs() < 1e-4);
}

#[test]
fn the_ends_of_the_scale_are_no_positions() {
    let mut drive = damiao();
    for end in [0, u16::MAX] {
        assert_eq!(drive.reply(&at(end)), Err(CanError::Range));
    }
    // The first reply is still the first.
    assert!(state(drive.reply(&at(1))).position.abs() < PI);
}

#[test]
fn a_robstride_repeats_after_four_turns() {
    let mut drive = robstride();
    let count = |angle: f32| ((angle + 12.57) / 25.14 * 65535.0).round() as u16;
    let mut read = |angle: f32| {
        let [high, low] = count(angle).to_be_bytes();
        state(drive.reply(&extended(0x0280_7ffd, &[high, low, 0x80, 0, 0x80, 0, 1, 0]))).position
    };
    for angle in [0.0, 3.0, 6.0, 9.0, 12.0] {
        read(angle);
    }
    let before = read(4.0 * PI - 0.01);
    let after = read(-4.0 * PI + 0.01);
    assert!((after - before - 0.02).abs() < 5e-4, "{after} {before}");
}

#[test]
fn beyond_the_first_scale_there_is_torque_alone() {
    let scale = damiao::DM4310;
    let mut drive = damiao();
    let gain = |drive: &Damiao, position| {
        let wanted = setpoint([position, 0.0, 50.0, 1.0, 1.0]);
        decoded(&drive.command(&wanted).unwrap(), &scale)[2]
    };
    let mut position = 0.0;
    for count in [0x8000, 0xa000, 0xc000, 0xe000, 0xfff0] {
        position = state(drive.reply(&at(count))).position;
        assert!(gain(&drive, position) > 0.0);
    }
    assert_eq!(gain(&drive, position + 0.1), 0.0);
    let beyond = state(drive.reply(&at(0x0010))).position;
    assert_eq!(gain(&drive, beyond), 0.0);
    assert!(gain(&drive, beyond - 0.1) > 0.0);
}

#[test]
fn a_circle_takes_the_short_way_across_its_seam() {
    let circle = JointMapping::IDENTITY.with_range(JointRange::Continuous, 1e-3).unwrap();
    let scale = damiao::DM4310;
    let mut drive = Damiao::new(1, 0x11, scale, 10.0, circle).unwrap();
    // 3.1 rad, and the same further turns.
    let count = |angle: f32| ((angle + 12.5) / 25.0 * 65535.0).round() as u16;
    for turns in [0.0, 1.0, 0.0, -1.0, -2.0] {
        let shaft = 3.1 + turns * TAU;
        let position = state(drive.reply(&at(count(shaft)))).position;
        assert!((position - 3.1).abs() < 2e-4);
        // A reference at the other side of the seam, on either turn: 0.05 rad ahead.
        for reference in [3.15, 3.15 - TAU] {
            let wanted = setpoint([reference, 0.0, 50.0, 1.0, 0.0]);
            let sent = decoded(&drive.command(&wanted).unwrap(), &scale);
            assert!((sent[0] - f64::from(shaft) - 0.05).abs() < 5e-4, "{sent:?}");
        }
    }
}

#[test]
fn a_joint_is_placed_in_its_range_or_by_another_sensor() {
    let within: EncoderMapping = JointMapping::IDENTITY
        .with_range(JointRange::Within { lower: 1.0, upper: 6.0 }, 1e-3)
        .unwrap();
    let mut drive = Damiao::new(1, 0x11, damiao::DM4310, 10.0, within).unwrap();
    // −2 rad of a drive that is within a turn after power-up.
    let count = ((12.5_f32 - 2.0) / 25.0 * 65535.0).round() as u16;
    assert!((state(drive.reply(&at(count))).position - (TAU - 2.0)).abs() < 2e-4);
    let mut drive = damiao();
    drive.reply(&at(count)).unwrap();
    drive.place_near(9.0).unwrap();
    assert!((state(drive.reply(&at(count))).position - (2.0 * TAU - 2.0)).abs() < 2e-4);
}
