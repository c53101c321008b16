//! Drives of two makers on one bus.

use std::cell::RefCell;

use super::super::damiao_bus::{Bus, Wire};
use super::*;

/// A drive of Damiao, of RobStride with 29 bits or with 11, or of CubeMars.
pub(crate) fn drive((maker, number, host): (char, u8, u16), at: EncoderMapping) -> AnyDrive {
    match maker {
        'd' => Damiao::new(number, host, damiao::DM4340, 5.0, at).unwrap().into(),
        'r' => RobStride::new(number, host, robstride::RS00, 5.0, at).unwrap().into(),
        'm' => RobStrideMit::new(number, host, robstride::RS00, 5.0, at).unwrap().into(),
        _ => CubeMars::new(number, host, cubemars::AK80_9, 5.0, at).unwrap().into(),
    }
}

/// Three drives of each, two with a latched error, behind a controller of three places.
#[test]
fn drives_of_two_makers_start_follow_a_motion_and_are_named() {
    let numbers = [1, 2, 3, 4, 5, 6];
    let address = |number| if number > 3 { ('r', number, 0xfd) } else { ('d', number, 0x10) };
    let joints = CanJoints::new(
        Outbox::<FdFrame, 6>::new(),
        numbers.map(|number| drive(address(number), identity())),
    );
    let drives = numbers.map(|number| Drive {
        host: address(number).2,
        is_robstride: number > 3,
        is_enabled: false,
        error: [0, 0xd, 0, 0, 1 << 1, 0][usize::from(number) - 1],
        ..Drive::new(number, if number > 3 { robstride::RS00 } else { damiao::DM4340 })
    });
    let wire = RefCell::new(Wire::new(drives.into()));
    wire.borrow_mut().places = 3;
    // Joints of 0.1 kg m² with a damper, and a spring to the target.
    let run = |ticks: u32, target: f32, is_pressed: bool| {
        let tick = |_| {
            for _ in 0..4 {
                joints.exchange(&mut Bus(&wire));
                let mut wire = wire.borrow_mut();
                for drive in &mut wire.drives {
                    drive.speed += (drive.torque() - 2.0 * drive.speed) / 0.1 * 5e-4;
                    drive.angle += drive.speed * 5e-4;
                }
                wire.advance(5e-4);
            }
            let read = (&joints).read();
            let torques = read.unwrap_or([target; 6]).map(|q| 20.0 * (target - q));
            let set = (&joints).set_torques(&torques);
            (read.and(Ok(())), set, is_pressed.then(|| joints.start_up()))
        };
        (0..ticks).map(tick).last().unwrap()
    };
    let at = |joint, error| Err(JointError { joint, error });
    assert_eq!(run(5, 0.0, false), (Ok(()), at(1, CanError::LostCommunication), None));
    assert_eq!(joints.errors()[4], Err(CanError::OverCurrent));
    // The errors are cleared, the registers of three drives compared, and all are enabled.
    assert_eq!(run(40, 0.0, true), (Ok(()), Ok(()), Some(Ok(true))));
    for (joint, number, target) in [(0, 1, 0.3), (5, 6, -0.2)] {
        assert_eq!(run(400, target, false), (Ok(()), Ok(()), None));
        for drive in &wire.borrow().drives {
            assert!((drive.angle - f64::from(target)).abs() < 2e-3, "{drive:?}");
        }
        // One of each falls silent, and is back with its number.
        wire.borrow_mut().drives[joint].number = 14;
        assert_eq!(run(3, target, false).0, at(joint, CanError::NoReply));
        wire.borrow_mut().drives[joint].number = number;
    }
}

#[test]
fn no_frame_of_one_drive_is_read_as_that_of_another() {
    for (pair, clashes) in [
        ([('d', 1, 0x11), ('r', 1, 0x11)], false),
        ([('d', 1, 0xfd), ('m', 0x22, 0xfd)], false),
        ([('r', 1, 0xfd), ('m', 1, 0xfd)], false),
        ([('c', 3, 3), ('c', 0x13, 0x13)], false),
        ([('m', 1, 0xfd), ('m', 0x11, 0xfd)], false),
        // One number; a reply that is the other's command, in any mode of it; one reply.
        ([('d', 1, 0x11), ('m', 1, 0xfd)], true),
        ([('r', 1, 0xfd), ('r', 1, 0xfd)], true),
        ([('c', 0x11, 0x11), ('d', 1, 0x11)], true),
        ([('d', 1, 0x122), ('m', 0x22, 0xfd)], true),
        ([('d', 2, 0xfd), ('m', 0x22, 0xfd)], true),
    ] {
        let drives = pair.map(|address| drive(address, identity()));
        let joints = CanJoints::new(Outbox::<FdFrame, 2>::new(), drives);
        let clash = Err(JointError { joint: 0, error: CanError::Clash });
        assert_eq!(joints.enable() == clash, clashes, "{pair:?}");
        let replies = pair.into_iter().flat_map(|(_, number, host)| {
            let id = 0x0280_0000 | u32::from(number) << 8 | u32::from(host);
            let data = (0..=u8::MAX).map(|first| [first, 0x80, 0, 0x80, 8, 0, 30, 30]);
            data.flat_map(move |data| [standard(host, &data), extended(id, &data)])
        });
        let is_read_twice = |reply| drives.iter().all(|drive| { *drive }.report(&reply).is_ok());
        assert!(clashes || !replies.into_iter().any(is_read_twice), "{pair:?}");
    }
}
