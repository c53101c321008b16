//! Drives whose supply goes and comes: they count turns in their own memory, and lose them.

use core::cell::RefCell;
use core::f64::consts::TAU;

use dynamics_core::state::State;
use embedded_can::{ExtendedId, Frame, StandardId};
use joint_drivers::can::{CanError, FdFrame};
use joint_drivers::mit::cubemars::{self, CubeMars};
use joint_drivers::mit::damiao::{self, Damiao};
use joint_drivers::moteus::Moteus;
use joint_drivers::odrive::ODrive;
use joint_drivers::{
    CanJoint, CanJoints, ControlLoop, EncoderMapping, EncoderType, JointEncoders, JointMapping,
    JointRange, Law, NoBrake, Outbox,
};
use motion_control::law::Gains;
use motion_control::limits::{Fault, Mode, SafetyLimits};
use motion_control::motion::{MotionController, MotionControllerConfig, PreviousTick, ResetError};
use motion_control::safety::SupervisorConfig;

use super::damiao_bus;
use super::lost_turn::CONFIG;
use super::mit::makers;

/// A drive on its bus.
#[derive(Clone, Copy, Debug)]
struct Drive {
    /// Its maker, number and host, if it is one in MIT mode.
    address: (char, u8, u16),
    /// The reply at an angle of the shaft by the drive's count, rad.
    reply: fn(f64) -> FdFrame,
    /// The part of a turn in which it begins, and the angle after which its count begins again.
    start: f64,
    period: f64,
    /// A step of its count, rad.
    step: f64,
}

/// The count of an angle over ±12.5 rad.
fn count(angle: f64) -> [u8; 2] {
    let within = (angle / 25.0 + 0.5).rem_euclid(1.0);
    // The ends are refused.
    ((within * 65_535.0).round() as u16).clamp(1, 65_534).to_be_bytes()
}

const DAMIAO: Drive = Drive {
    address: ('d', 1, 0x11),
    reply: |angle| {
        let [high, low] = count(angle);
        FdFrame::new(StandardId::new(0x11).unwrap(), &[0x11, high, low, 0x80, 8, 0, 30, 25])
            .unwrap()
    },
    start: 1.0,
    period: 25.0,
    step: 25.0 / 65_535.0,
};
const CUBEMARS: Drive = Drive {
    address: ('c', 1, 1),
    reply: |angle| {
        let [high, low] = count(angle);
        FdFrame::new(StandardId::new(1).unwrap(), &[1, high, low, 0x80, 8, 0, 70, 0]).unwrap()
    },
    start: 1.0 / 9.0,
    ..DAMIAO
};
const ROBSTRIDE: Drive = Drive {
    address: ('r', 0x7f, 0xfd),
    reply: |angle| {
        // ±12.57 rad over the counts, and again after 8π.
        let angle = angle - (angle / (4.0 * TAU)).round() * 4.0 * TAU;
        let count = ((angle / 25.14 + 0.5) * 65_535.0).round() as u16;
        let [high, low] = count.clamp(1, 65_534).to_be_bytes();
        let data = [high, low, 0x7f, 0xff, 0x7f, 0xff, 1, 0];
        FdFrame::new(ExtendedId::new(0x0280_7ffd).unwrap(), &data).unwrap()
    },
    start: 1.0,
    period: 4.0 * TAU,
    // As large as the difference of both scales at their ends.
    step: 3.0 * 25.14 / 65_535.0,
};
const MOTEUS: Drive = Drive {
    address: (' ', 0, 0),
    reply: |angle| {
        let [q0, q1, q2, q3] = ((angle / TAU) as f32).to_le_bytes();
        let data = [0x21, 0, 10, 0x2f, 1, q0, q1, q2, q3, 0, 0, 0, 0, 0, 0, 0, 0, 0x21, 0x0f, 0];
        FdFrame::new(ExtendedId::new(0x100).unwrap(), &data).unwrap()
    },
    start: 1.0,
    period: f64::INFINITY,
    step: 1e-4,
};
const ODRIVE: Drive = Drive {
    address: (' ', 1, 0),
    reply: |angle| {
        let [q0, q1, q2, q3] = ((angle / TAU) as f32).to_le_bytes();
        FdFrame::new(StandardId::new(1 << 5 | 9).unwrap(), &[q0, q1, q2, q3, 0, 0, 0, 0]).unwrap()
    },
    ..MOTEUS
};

/// Marsaglia's xorshift64, 2003.
struct Random(u64);

impl Random {
    fn between(&mut self, from: f64, to: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        from + (to - from) * (self.0 >> 40) as f64 / 16_777_216.0
    }
    fn chance(&mut self, share: f64) -> bool {
        self.between(0.0, 1.0) < share
    }
}

const STEP: f64 = 0.02;

fn mapping(range: JointRange, ratio: f64) -> EncoderMapping {
    let mapping = JointMapping::new(0.7, joint_drivers::Direction::Reverse, ratio as f32).unwrap();
    mapping.with_range(range, (STEP / ratio) as f32).unwrap()
}

/// Runs a joint in many ticks, and returns how often it was lost, and in how many ticks known.
fn run<Joint: CanJoint>(drive: Drive, joint: Joint, range: JointRange, ratio: f64) -> [u32; 2] {
    let joints = CanJoints::new(Outbox::<FdFrame, 1>::new(), [joint]);
    let mut random = Random(0x5eed_0001_2345_6789);
    let (mut shaft, mut speed) = (0.7, 0.0_f64);
    // The shaft's angle at which the drive counts zero, and the ticks until it has its supply.
    let (mut zero, mut off, mut silent) = (0.0, 0, 0);
    let (mut late, mut past) = (Vec::new(), [shaft; 3]);
    let (mut lost, mut known, mut was_lost) = (0, 0, false);
    for tick in 0..50_000 {
        speed = (speed + random.between(-0.06, 0.06) * STEP).clamp(-STEP, STEP);
        if random.chance(0.003) {
            speed = 0.0;
        }
        let next = shaft + speed;
        let joint_at = |shaft: f64| -(shaft - 0.7) / ratio;
        let inside = match range {
            JointRange::Within { lower, upper } => {
                (f64::from(lower)..f64::from(upper)).contains(&joint_at(next))
            }
            // Some turns, so that counts begin again.
            JointRange::Near(_) => (next - 0.7).abs() < 60.0,
            _ => true,
        };
        if inside {
            shaft = next;
        } else {
            speed = -speed;
        }
        past = [shaft, past[0], past[1]];
        // The replies of this tick, behind those that are late.
        let mut came: Vec<FdFrame> = core::mem::take(&mut late);
        if off > 0 {
            off -= 1;
            if off == 0 {
                let part = TAU * drive.start;
                zero += ((shaft - zero) / part).round() * part;
            }
        } else if silent > 0 {
            silent -= 1;
        } else {
            let reply = (drive.reply)(shaft - zero);
            match random.between(0.0, 1.0) {
                ..0.02 => {}
                ..0.03 => came.extend([reply; 2]),
                ..0.04 => late.push(reply),
                ..0.05 => {
                    came.push(reply);
                    late.push(reply);
                }
                _ => came.push(reply),
            }
            if random.chance(0.0005) {
                off = random.between(5.0, 500.0) as u32;
            } else if random.chance(0.0005) {
                silent = random.between(2.0, 400.0) as u32;
            }
        }
        if random.chance(0.01) {
            let foreign = FdFrame::new(StandardId::new(0x700).unwrap(), &[1; 8]).unwrap();
            came.splice(0..0, [foreign; 12]);
        }
        came.iter().for_each(|frame| joints.receive(frame));
        match (&joints).read() {
            Ok([q]) => {
                known += 1;
                was_lost = false;
                let circle = matches!(range, JointRange::Continuous);
                let off = |at: f64| {
                    let off = f64::from(q) - joint_at(at);
                    let turn = if circle { TAU / ratio } else { f64::INFINITY };
                    (if circle { off - (off / turn).round() * turn } else { off }).abs()
                };
                let least = past.map(off).into_iter().fold(f64::MAX, f64::min);
                // Where a drive begins in a part of a turn, the place is taken as it is given.
                let placed = if drive.start < 1.0 { 0.02 + 8.0 * STEP } else { 0.0 };
                let most = (drive.step + placed + 2e-6 * shaft.abs()) / ratio + 2e-6;
                assert!(
                    least <= most,
                    "{tick}: {q} {} {least} {drive:?} {range:?}",
                    joint_at(shaft)
                );
            }
            Err(failed) if failed.error == CanError::LostTurn => {
                assert_eq!(
                    <&CanJoints<Outbox<FdFrame, 1>, Joint, 1>>::fault(&failed.error, 0),
                    Fault::LostTurn { joint: 0 }
                );
                lost += u32::from(!was_lost);
                was_lost = true;
                if random.chance(0.05) {
                    // As well as another sensor says: whole turns need less.
                    let near = joint_at(shaft) + random.between(-0.02, 0.02) / ratio;
                    joints.place_near(0, near as f32).unwrap();
                }
            }
            Err(_) => {}
        }
    }
    [lost, known]
}

const WITHIN: JointRange = JointRange::Within { lower: -1.5, upper: 1.5 };

/// Each drive in each range: no position is beside the true one without a fault.
#[test]
fn a_lost_supply_never_puts_a_joint_beside_itself() {
    let of = |drive: Drive, range, ratio| {
        let at = mapping(range, ratio);
        match drive.address {
            (_, 0, _) => run(drive, Moteus::new(1, 0, 10.0, at).unwrap(), range, ratio),
            (_, _, 0) => run(drive, ODrive::new(1, 10.0, at).unwrap(), range, ratio),
            address => run(drive, makers::drive(address, at), range, ratio),
        }
    };
    for drive in [DAMIAO, CUBEMARS, ROBSTRIDE, MOTEUS, ODRIVE] {
        for (range, ratio) in [
            (JointRange::Near(0.0), 1.0),
            (JointRange::Near(0.0), 10.0),
            (WITHIN, 1.0),
            (JointRange::Continuous, 1.0),
        ] {
            let [lost, known] = of(drive, range, ratio);
            println!(
                "{range:?}, {ratio}, start {}, period {:.1}: lost {lost} times, known in {known} ticks",
                drive.start, drive.period
            );
            assert!(known > 25_000, "{drive:?} {range:?}: {known}");
            // A drive that knows its turn is known in a range below one, after any gap.
            let may_be_lost = matches!(range, JointRange::Near(_)) || drive.start < 1.0;
            assert!(lost > 5 || !may_be_lost, "{drive:?} {range:?}: {lost}");
            assert!(lost == 0 || range != WITHIN || drive.start < 1.0, "{drive:?}: {lost}");
        }
    }
}

/// A controller without gains that may be reset.
fn controller() -> MotionController<f32, 1, PreviousTick> {
    let limits =
        SafetyLimits { torque: [7.0], rate: [7.0], speed: [5.0], lower: [-4.4], upper: [4.4] };
    let supervisor = SupervisorConfig { limits, tick: 2e-3, resolution: 4e-4, ..CONFIG.supervisor };
    let config = MotionControllerConfig { supervisor, observer_bandwidth: 150.0, ..CONFIG };
    MotionController::try_new(config).unwrap()
}

struct Nothing;

impl Law<1> for Nothing {
    const ACCELERATES: bool = false;
    fn feedforward(_: &State<f32, 1, 1>, (): &()) -> [f32; 1] {
        [0.0]
    }
}

/// An emergency stop cuts the supply while the joint stands at 4 rad: it comes back a turn lower.
#[test]
fn a_loop_stops_until_the_joint_is_placed() {
    let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 6e-3).unwrap();
    let drive = Damiao::new(1, 0x11, damiao::DM4310, 7.0, mapping).unwrap();
    // The second one, of nobody, acknowledges the frames meanwhile.
    let motors = [1, 2].map(|number| damiao_bus::Drive::new(number, damiao::DM4310));
    let wire = RefCell::new(damiao_bus::Wire::new(motors.into()));
    let joints = CanJoints::new(damiao_bus::Bus(&wire), [drive]);
    let gains = Gains { kp: [0.0], kd: [0.0] };
    let mut control = ControlLoop::new(&joints, &joints, NoBrake, gains, controller(), ());
    let (here, mut status) = (State::at([4.0]), None);
    let mut run = |control: &mut ControlLoop<_, _, _, 1>, ticks: core::ops::Range<u32>| {
        for tick in ticks {
            wire.borrow_mut().drives[0].angle = 4.0 * f64::from(tick.min(1000)) / 1000.0;
            wire.borrow_mut().drives[0].supply(!(1400..2000).contains(&tick));
            wire.borrow_mut().drives[0].is_enabled = true;
            wire.borrow_mut().advance(2e-3);
            status = Some(control.tick::<Nothing, _, ()>(&here, &()).status);
        }
        status.unwrap()
    };
    run(&mut control, 0..1400);
    let status = run(&mut control, 1400..2500);
    // The fault is the one that came first.
    assert_eq!((status.mode, status.fault), (Mode::Stopped, Some(Fault::Encoder { joint: 0 })));
    let error = control.encoder_error().map(|error| *error.error);
    assert_eq!(error, Some(CanError::LostTurn));
    assert_eq!(control.reset(&here), Err(ResetError::NoMeasurement));
    control.encoders().place_near(0, 3.9).unwrap();
    run(&mut control, 2500..2510);
    control.reset(&here).unwrap();
    let telemetry = control.tick::<Nothing, _, ()>(&here, &());
    assert!((telemetry.estimate[0] - 4.0).abs() < 1e-3, "{telemetry:?}");
}

/// A drive of which only replies are seen: a fall by whole turns is visible by itself.
#[test]
fn a_count_that_begins_anew_is_seen_and_placed() {
    let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3).unwrap();
    for at in [5.0_f64, 10.0, 20.0, 1000.0] {
        let mut drive = Damiao::new(1, 0x11, damiao::DM4310, 10.0, mapping).unwrap();
        let read = |drive: &mut Damiao, angle: f64| drive.report(&(DAMIAO.reply)(angle));
        let turned = (0..=(at / 2.0) as u32).map(|part| 2.0 * f64::from(part)).chain([at]);
        turned.for_each(|angle| _ = read(&mut drive, angle));
        let anew = at - (at / TAU).round() * TAU;
        if (at - anew).abs() > 6.0 && at < 10.0 {
            assert_eq!(read(&mut drive, anew), Err(CanError::LostTurn));
        }
        drive.place_near(at as f32).unwrap();
        let position = read(&mut drive, anew).unwrap().position.unwrap();
        assert!((f64::from(position) - at).abs() < 6e-4, "{at}: {position}");
    }
}

#[test]
fn errors_are_cleared_and_zeros_set_through_the_joints() {
    let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3).unwrap();
    let drive = Damiao::new(1, 0x11, damiao::DM4310, 10.0, mapping).unwrap();
    let joints = CanJoints::new(Outbox::<FdFrame, 1>::new(), [drive]);
    joints.receive(&(DAMIAO.reply)(1.0));
    assert_eq!(joints.errors(), [Ok(())]);
    for (request, last) in
        [(CanJoints::clear_errors as fn(&_, _) -> _, 0xfb), (CanJoints::set_zero, 0xfe)]
    {
        request(&joints, 0).unwrap();
        assert_eq!(joints.commands()[0].unwrap().data()[7], last);
        assert_eq!(request(&joints, 1).unwrap_err().error, CanError::Node);
    }
    // The count is that of the new zero.
    joints.receive(&(DAMIAO.reply)(0.0));
    assert!((&joints).read().unwrap()[0].abs() < 4e-4);
    let cubemars = CubeMars::new(1, 1, cubemars::AK80_9, 18.0, mapping).unwrap();
    let joints = CanJoints::new(Outbox::<FdFrame, 1>::new(), [cubemars]);
    assert!(matches!(joints.clear_errors(0).unwrap_err().error, CanError::Unknown(_)));
}

#[test]
fn a_drive_without_an_end_is_as_exact_after_a_hundred_thousand_turns() {
    for (range, ratio) in [(JointRange::Continuous, 1.0), (JointRange::ContinuousNear(0.0), 3.0)] {
        let mapping = JointMapping::new(0.7, joint_drivers::Direction::Reverse, ratio).unwrap();
        let mapping = mapping.with_range(range, 0.1).unwrap();
        let mut drive = Damiao::new(1, 0x11, damiao::DM4310, 10.0, mapping).unwrap();
        let mut worst = 0.0_f64;
        let turns = 1e5 * f64::from(ratio);
        let mut shaft = 0.7_f64;
        while shaft < turns * TAU {
            shaft += 3.0;
            let position = drive.report(&(DAMIAO.reply)(shaft)).unwrap().position.unwrap();
            let truth = -(shaft - f64::from(0.7_f32)) / f64::from(ratio);
            let off = (f64::from(position) - truth) / TAU;
            worst = worst.max((off - off.round()).abs() * TAU);
            assert!(position.abs() < 3.15, "{position}");
        }
        // Half a count, and those beside the ends of the scale.
        assert!(worst < 2.1 * DAMIAO.step / f64::from(ratio), "{ratio}: {worst}");
    }
}
