//! The mistakes that people make, and what the log says of each within two seconds: the joint, what
//! was seen, what to do. The guide's page of motors on CAN has those that nothing can see.

use dynamics_core::effects::{Coriolis, Gravity, Inertia};
use embedded_can::ErrorKind;
use joint_drivers::JointError;
use joint_drivers::can::CanError;
use motion_control::limits::Mode;

use crate::arm::{Bench, is_whole};
use crate::damiao_bus::{Drive, Wire};
use crate::robot::board::{SCALES, bus};
use crate::robot::say::Line;
use crate::robot::scene::{self, JOINTS, N, TICK};

/// The joint of the mistakes.
const J: usize = N / 2;

/// A mistake, the joint that is named, if it is one, and words of what is seen and what to do.
type Mistake = (fn(&Bench), Option<usize>, &'static str, &'static str);

fn drive(bench: &Bench, change: impl FnOnce(&mut Drive)) {
    change(&mut bench.wire.borrow_mut().drives[J]);
}

fn wire(bench: &Bench, change: impl FnOnce(&mut Wire)) {
    change(&mut bench.wire.borrow_mut());
}

fn no_supply(bench: &Bench) {
    wire(bench, |wire| wire.drives.iter_mut().for_each(|drive| drive.supply(false)));
}

/// An error that a drive reports, and whether its cause lasts.
fn fails(bench: &Bench, error: u8, lasts: bool) {
    drive(bench, |drive| (drive.error, drive.error_lasts) = (error, lasts));
}

const AT: Option<usize> = Some(J);

/// Mistakes that are there when the board starts. The arm stays on its brake.
const BEFORE: &[Mistake] = &[
    (no_supply, None, "no drive answers", "supply"),
    (|b| wire(b, |w| w.error = Some(ErrorKind::Acknowledge)), None, "acknowledges", "bit rate"),
    (|b| wire(b, |w| w.reaches = Some(0)), None, "no drive answers", "cable"),
    (|b| wire(b, |w| w.reaches = AT), AT, "all behind it", "cable"),
    // One drive without supply; another number; two of one number; the factory's MST_ID.
    (|b| drive(b, |d| d.supply(false)), AT, "does not answer", "supply"),
    (|b| drive(b, |d| d.number = 14), AT, "does not answer", "its number"),
    (|b| drive(b, |d| (d.number, d.host) = PREVIOUS), AT, "does not answer", "second drive"),
    (|b| drive(b, |d| d.host = 0), AT, "none from its drive", "MST_ID"),
    // Another maker's drive.
    (
        |b| (drive(b, |d| d.supply(false)), wire(b, |w| w.foreign = 1)).0,
        AT,
        "none from its drive",
        "ESC_ID",
    ),
    (|b| drive(b, |d| d.scale.position = 12.566), AT, "PMAX", "the drive's"),
    (|b| drive(b, |d| d.scale.velocity *= 1.5), AT, "VMAX", "48 V"),
    (|b| drive(b, |d| d.scale.torque *= 2.8), AT, "TMAX", "this joint's motor"),
    (|b| drive(b, |d| d.mode = 2), AT, "control mode", "register 10"),
    // No terminator; an MCP2515; another program.
    (|b| wire(b, |w| w.destroys = 2), None, "answers are lost", "120 Ω"),
    (|b| wire(b, |w| w.places = 3), Some(3), "no room", "fewer places"),
    (|b| wire(b, |w| w.foreign = 200), None, "more frames", "who else sends"),
    // A zero that was never set, or is off; an arm that is not at home.
    (|b| drive(b, |d| d.zero += 2.5), AT, "zero", "move it"),
    (|b| drive(b, |d| d.zero += 0.7), AT, "zero", "move it"),
    (|b| drive(b, |d| d.zero -= 0.5), AT, "zero", "move it"),
    (|b| fails(b, 0xc, true), AT, "motor is too hot", "cool"),
];

/// The numbers of the drive before.
const PREVIOUS: (u8, u16) = (J as u8, 0x10 + J as u16);

/// Mistakes of a robot that runs.
const RUNNING: &[Mistake] = &[
    (|b| fails(b, 0xc, true), AT, "motor is too hot", "cool"),
    (|b| fails(b, 0xb, true), AT, "drive is too hot", "cool"),
    (|b| fails(b, 0xe, false), AT, "overloaded", "A start clears"),
    (|b| fails(b, 0xa, false), AT, "too much current", "A start clears"),
    (|b| fails(b, 0x8, false), AT, "too much voltage", "brake resistor"),
    (|b| fails(b, 0x9, false), AT, "too little voltage", "supply's limit"),
    // The watchdog of a drive; a drive that another program disables.
    (|b| fails(b, 0xd, false), AT, "missed its commands", "TIMEOUT"),
    (|b| drive(b, |d| d.is_enabled = false), AT, "not enabled", "another program"),
    // A supply that goes, comes back, or that an emergency stop cuts.
    (|b| drive(b, |d| d.supply(false)), AT, "does not answer", "supply"),
    (|b| [false, true].map(|on| drive(b, |d| d.supply(on)))[0], AT, "not enabled", "came back"),
    (no_supply, None, "no drive answers", "supply"),
    (|b| b.is_held.set(true), None, "does not move", "brake is closed"),
    (|b| wire(b, |w| w.reaches = AT), AT, "all behind it", "plug"),
    (|b| wire(b, |w| w.error = Some(ErrorKind::Other)), None, "the bus is off", "120 Ω"),
    (|b| wire(b, |w| w.error = Some(ErrorKind::Crc)), None, "destroyed", "ends"),
    (|b| b.is_late.set(true), None, "longer than its period", "opt-level"),
];

/// Whether the mistakes can be made: joints enough, and one in the middle that turns.
fn is_usual() -> bool {
    let limits = scene::described_limits()[J];
    N > 3
        && scene::encoder_ratios()[J] == 1.0
        && (2.0..6.28).contains(&(limits.upper - limits.lower))
}

fn is_said(bench: &Bench, joint: Option<usize>, words: [&str; 2]) -> bool {
    let name = joint.map(|joint| format!("joint {} `{}`: ", joint + 1, JOINTS[joint]));
    bench.lines.iter().map(Line::to_string).any(|text| {
        let is_joint = name.as_ref().is_none_or(|name| text.starts_with(name));
        is_joint && words.iter().all(|words| text.contains(words))
    })
}

/// No line is said twice in two seconds.
fn is_brief(bench: &Bench) -> bool {
    let lines = || bench.said.iter().enumerate().filter(|(_, said)| said.1.contains(": "));
    lines().all(|(at, (time, text))| {
        let again = lines().filter(|(other, said)| *other > at && said.1 == *text);
        again.into_iter().all(|(_, (then, _))| then - time > 1.99)
    })
}

/// Says what was said in place of these words.
fn check(bench: &Bench, &(_, joint, seen, remedy): &Mistake) -> Option<String> {
    let is_right = is_said(bench, joint, [seen, remedy]) && is_brief(bench);
    (!is_right).then(|| format!("{seen}, {remedy}: {:#?}", bench.said))
}

#[test]
fn mistakes_before_the_start_are_named_and_the_arm_stays_on_its_brake() {
    if !is_usual() {
        return;
    }
    let mut unnamed = Vec::new();
    for mistake in BEFORE {
        let mut bench = Bench::new();
        mistake.0(&bench);
        bench.run(0.1, false);
        let starts = bench.start();
        bench.run(0.9, false);
        unnamed.extend(check(&bench, mistake));
        assert!(!starts, "{}: {:#?}", mistake.2, bench.said);
    }
    assert!(unnamed.is_empty(), "{}", unnamed.join("\n"));
}

#[test]
fn mistakes_of_a_robot_that_runs_are_named() {
    if !is_usual() || !is_whole() {
        return;
    }
    let mut unnamed = Vec::new();
    for mistake in RUNNING {
        let mut bench = Bench::new();
        bench.run(0.1, false);
        assert!(bench.start(), "{:#?}", bench.said);
        bench.run(0.3, false);
        bench.lines.clear();
        mistake.0(&bench);
        bench.run(1.9, false);
        unnamed.extend(check(&bench, mistake));
    }
    assert!(unnamed.is_empty(), "{}", unnamed.join("\n"));
}

#[test]
fn without_a_mistake_nothing_is_said_and_the_arm_follows_its_motion() {
    if !is_whole() {
        return;
    }
    let mut bench = Bench::new();
    bench.run(0.1, false);
    let advice = bench.lines.len();
    assert!(bench.start(), "{:#?}", bench.said);
    bench.run(bench.motion.ticks() as f32 * TICK + 0.5, false);
    let status = bench.status.expect("ticks");
    assert_eq!((status.mode, status.fault), (Mode::Full, None), "{:#?}", bench.said);
    assert_eq!(bench.lines.len(), advice, "{:#?}", bench.said);
    for (q, home) in bench.state.q.iter().zip(scene::home()) {
        assert!((q - home).abs() < 0.02, "{:?}", bench.state.q);
    }
}

/// No Full while a drive reports an error: the start clears it first.
#[test]
fn the_start_clears_the_errors_that_drives_keep() {
    if !is_whole() {
        return;
    }
    let mut bench = Bench::new();
    fails(&bench, 0xd, false);
    bench.run(0.1, false);
    assert!(
        is_said(&bench, Some(J), ["missed its commands", "A start clears"]),
        "{:#?}",
        bench.said
    );
    assert!(bench.start(), "{:#?}", bench.said);
    assert_eq!(bench.wire.borrow().drives[J].error, 0);
    bench.run(0.5, false);
    assert_eq!(bench.status.map(|status| status.mode), Some(Mode::Full), "{:#?}", bench.said);
    // A cause that lasts: the arm stays on its brake, without flicker.
    fails(&bench, 0xc, true);
    bench.run(0.2, false);
    let changes = bench.said.len();
    bench.run(1.0, true);
    assert_eq!(bench.status.map(|status| status.mode), Some(Mode::Stopped));
    assert!(bench.said.len() < changes + 5, "{:#?}", bench.said);
}

#[test]
fn the_start_says_what_the_description_has_too_much_of_or_lacks() {
    let mut bench = Bench::new();
    bench.run(0.01, false);
    let weak = |torques: [f32; N]| {
        let mut weak = Vec::new();
        bus::advice(&torques, |line| {
            let is_it = line.text.contains("above its motor's greatest");
            weak.extend(line.joint.filter(|_| is_it && line.text.contains("SCALES")));
        });
        weak
    };
    let of_motors = SCALES.map(|scale| scale.torque);
    assert_eq!(weak(of_motors), []);
    let stronger = |joint| if joint == J { 1.1 } else { 1.0 };
    assert_eq!(weak(core::array::from_fn(|joint| stronger(joint) * of_motors[joint])), [J]);
    let [has_rotor, has_friction] = bus::terms(&scene::EFFECTS);
    let is_bare = !(has_rotor && has_friction);
    assert_eq!(is_said(&bench, None, ["no rotors", "armature"]), is_bare);
    assert_eq!(bus::terms(&(Gravity::EARTH, Inertia, Coriolis)), [false; 2]);
}

/// The guide's table of what nothing can see: one that is seen some day has to leave it.
#[test]
fn what_nothing_can_see_starts_without_a_word() {
    if !is_usual() || !is_whole() {
        return;
    }
    let unseen: [(&str, fn(&mut Bench)); 3] = [
        ("zero off by 0.1 rad", |b| drive(b, |d| d.zero += 0.1)),
        // Its zero was set where it is.
        ("mounted in reverse", |b| {
            let home = f64::from(scene::home()[J]);
            // The drive still reads home.
            let way = b.directions[J];
            b.directions[J] = -way;
            drive(b, |d| d.zero -= 2.0 * way * home);
        }),
        ("no watchdog", |b| drive(b, |d| d.timeout = 0.0)),
    ];
    let mut clean = Bench::new();
    clean.run(0.1, false);
    for (name, make) in unseen {
        let mut bench = Bench::new();
        make(&mut bench);
        bench.run(0.1, false);
        assert!(bench.start() && bench.lines == clean.lines, "{name}: {:#?}", bench.said);
    }
}

/// A drive that lost its turns: its joint's range has to be longer than a turn for it.
#[test]
fn a_lost_turn_says_how_it_is_found_again() {
    let line = bus::line(JointError { joint: J, error: CanError::LostTurn });
    assert!(line.text.contains("lost its turns") && line.text.contains("home"), "{line}");
}
