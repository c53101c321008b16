//! The controller as C calls it, with an arm that the library itself simulates.

use super::{Memory, numbers};
use crate::library::{self as c, *};
use crate::scene::{self, N};
use dynamics_c::status::*;
use dynamics_c::{WayPoint, field};

const FULL: i32 = 0;
const HOLD: i32 = 1;
const STOPPED: i32 = 2;

pub fn config() -> Config {
    let mut config: Config = numbers();
    let status = c::config_of_description(1e-3, 25.0, Some(&mut config));
    assert_eq!(status, OK);
    for (torque, rate) in config.torque.iter_mut().zip(&mut config.rate) {
        if torque.is_infinite() {
            (*torque, *rate) = (1e3, 5e2);
        }
    }
    config
}

/// The middle of each joint's range, and a point at a tenth of the range from it.
pub fn ends(config: &Config) -> [[f32; N]; 2] {
    let range = |joint: usize| (config.lower[joint].max(-1.0), config.upper[joint].min(1.0));
    let at = |share: f32| {
        core::array::from_fn(|joint| {
            let (lower, upper) = range(joint);
            lower + share * (upper - lower)
        })
    };
    [at(0.5), at(0.6)]
}

pub fn there_and_back(config: &Config, ticks: u32) -> Motion {
    let [home, away] = ends(config);
    let point = |q, ticks| WayPoint { q, qd: [0.0; N], ticks };
    let mut points = [point(home, 0); scene::MOST_POINTS];
    points[1] = point(away, ticks);
    points[2] = point(home, ticks);
    Motion { count: 3, points }
}

pub fn blank() -> Command {
    Command { torque: [f32::NAN; N], brake: 7, enable: 7, mode: 7, fault: 7, joint: 7, limited: 7 }
}

pub fn report(handle: Option<Handle>) -> Report {
    let state = State { q: [7.0; N], qd: [7.0; N], qdd: [7.0; N] };
    let mut report = Report { q: [7.0; N], qd: [7.0; N], reference: state, left: 7 };
    assert_eq!(c::controller_report(handle, Some(&mut report)), OK);
    report
}

fn init(memory: &mut Memory, config: &Config) {
    let mut at = Where { field: 7, joint: 7, point: 7 };
    let status =
        c::controller_init(memory.handle(), Exports::CONTROLLER_BYTES, Some(config), Some(&mut at));
    assert_eq!((status, at), (OK, Where::NOWHERE));
}

/// Observes and commands.
pub fn tick(memory: &mut Memory, q: &[f32; N]) -> Command {
    let (handle, mut command) = (memory.handle(), blank());
    assert_eq!(c::controller_observe(handle, Some(q), None), OK);
    assert_eq!(c::controller_command(handle, Some(&mut command)), OK);
    command
}

/// A controller that tracks a motion from the start of it.
pub fn moving(memory: &mut Memory, config: &Config, ticks: u32) {
    init(memory, config);
    let [home, _] = ends(config);
    let handle = memory.handle();
    let motion = there_and_back(config, ticks);
    assert_eq!(c::controller_move(handle, Some(&motion), None), OK);
    let command = tick(memory, &home);
    assert_eq!((command.mode, command.brake, command.enable), (STOPPED, 1, 0));
    assert_eq!(c::controller_reset(handle, None), OK);
}

#[test]
fn a_simulated_arm_with_a_tool_follows_its_way_points() {
    let mut memory = Memory::new();
    // A load that is small for any robot, under a gravity of another direction.
    let load =
        Load { mass: 0.01, com: [0.0, 0.01, 0.02], inertia: [1e-6, 0.0, 0.0, 1e-6, 0.0, 1e-6] };
    let (config, mut tool) = (config(), Tool::default());
    let status = c::tool_set(
        Some(&mut tool),
        scene::TOOL_BODY as i32,
        Some(&load),
        Some(&[3.0, -4.0, -8.4]),
    );
    assert_eq!(status, OK);
    moving(&mut memory, &config, 1000);
    let handle = memory.handle();
    assert_eq!(c::controller_tool(handle, Some(&tool)), OK);
    let mut arm = State::at(ends(&config)[0]);
    let (mut worst, mut furthest) = (0.0_f32, 0.0_f32);
    for k in 0..2600 {
        let command = tick(&mut memory, &arm.q);
        assert!(k < 50 || (command.mode, command.brake) == (FULL, 0), "{k}: {command:?}");
        assert_eq!(command.fault, 0, "{k}: {command:?}");
        let known = report(handle);
        for joint in 0..N {
            worst = worst.max((known.reference.q[joint] - arm.q[joint]).abs());
            furthest = furthest.max((arm.q[joint] - ends(&config)[0][joint]).abs());
        }
        if command.brake != 0 {
            continue;
        }
        for _ in 0..8 {
            let (mut qdd, h) = ([0.0; N], 1e-3 / 8.0);
            let torque = Some(&command.torque);
            let status =
                c::forward_dynamics_with_tool(Some(&arm), torque, Some(&tool), Some(&mut qdd));
            assert_eq!(status, OK);
            for ((q, qd), qdd) in arm.q.iter_mut().zip(&mut arm.qd).zip(qdd) {
                *qd += h * qdd;
                *q += h * *qd;
            }
        }
    }
    assert!(worst < 0.03 && furthest > 0.01, "{worst} {furthest}");
    assert_eq!(report(handle).left, 0);
    // From where it stands it goes on; from elsewhere it does not.
    let mut next = there_and_back(&config, 500);
    let accepted = c::controller_move(handle, Some(&next), None);
    assert_eq!(accepted, OK);
    assert_eq!(c::controller_move(handle, Some(&next), None), STATE);
    for _ in 0..1300 {
        let q = report(handle).reference.q;
        tick(&mut memory, &q);
    }
    next.points[0].q[N - 1] += 0.01;
    let mut at = Where::NOWHERE;
    assert_eq!(c::controller_move(handle, Some(&next), Some(&mut at)), TOO_FAR);
    assert_eq!((at.field, at.joint, at.point), (field::POSITION, N as i32 - 1, 0));
}

#[test]
fn memory_without_a_controller_has_a_status() {
    let (config, mut memory) = (config(), Memory::new());
    let mut command = blank();
    for fill in [0_u8, 0xff, 0x5a] {
        memory = Memory::filled(fill);
        let handle = memory.handle();
        assert_eq!(c::controller_observe(handle, Some(&[0.0; N]), None), MEMORY);
        assert_eq!(c::controller_reset(handle, None), MEMORY);
        assert_eq!(c::controller_stop(handle), MEMORY);
        // What a wrong memory leaves for the drives is zero torque on the brake.
        command = blank();
        assert_eq!(c::controller_command(handle, Some(&mut command)), MEMORY);
        assert_eq!((command.torque, command.brake, command.enable), ([0.0; N], 1, 0));
    }
    assert_eq!(c::controller_command(None, Some(&mut command)), NULL);
    assert_eq!(c::controller_command(memory.handle(), None), NULL);
    let of = |handle, bytes| c::controller_init(handle, bytes, Some(&config), None);
    assert_eq!(of(memory.handle(), 64), MEMORY);
    assert_eq!(of(None, Exports::CONTROLLER_BYTES), NULL);
    // A controller that moved in memory is still one; one of other bytes is not.
    init(&mut memory, &config);
    let mut copy = memory;
    assert_eq!(tick(&mut copy, &[0.0; N]).mode, STOPPED);
    // The word is odd.
    copy.spoil(0);
    assert_eq!(c::controller_stop(copy.handle()), MEMORY);
}

#[test]
fn a_wrong_number_of_the_configuration_is_named() {
    let mut memory = Memory::new();
    let last = N - 1;
    type Set = fn(&mut Config, f32);
    let cases: [(Set, i32, i32); 10] = [
        (|config, x| config.tick = x, field::TICK, -1),
        (|config, x| config.bandwidth = x, field::BANDWIDTH, -1),
        (|config, x| config.decay_rate = x, field::DECAY_RATE, -1),
        (|config, x| config.restart_distance = x, field::RESTART_DISTANCE, -1),
        (|config, x| config.resolution = x, field::RESOLUTION, -1),
        (|config, x| config.torque[N - 1] = x, field::TORQUE, last as i32),
        (|config, x| config.rate[N - 1] = x, field::RATE, last as i32),
        (|config, x| config.speed[N - 1] = x, field::SPEED, last as i32),
        (|config, x| config.kp[N - 1] = x, field::KP, last as i32),
        (|config, x| config.kd[N - 1] = x, field::KD, last as i32),
    ];
    for (set, field, joint) in cases {
        for bad in [f32::NAN, -1.0, f32::NEG_INFINITY] {
            let (mut wrong, mut at) = (config(), Where::NOWHERE);
            set(&mut wrong, bad);
            let status = c::controller_init(
                memory.handle(),
                Exports::CONTROLLER_BYTES,
                Some(&wrong),
                Some(&mut at),
            );
            assert_eq!((status, at.field, at.joint), (CONFIG, field, joint));
        }
    }
    let (mut empty, mut at) = (config(), Where::NOWHERE);
    (empty.lower[0], empty.upper[0]) = (1.0, 0.5);
    let status =
        c::controller_init(memory.handle(), Exports::CONTROLLER_BYTES, Some(&empty), Some(&mut at));
    assert_eq!((status, at.field, at.joint), (CONFIG, field::UPPER, 0));
    // None of them left a controller.
    assert_eq!(c::controller_stop(memory.handle()), MEMORY);
}

#[test]
fn a_wrong_way_point_is_named() {
    let (mut memory, mut config) = (Memory::new(), config());
    config.speed = [2.0; N];
    init(&mut memory, &config);
    let good = there_and_back(&config, 500);
    let refused = |motion: &Motion| {
        let mut at = Where::NOWHERE;
        let mut copy = memory;
        ((c::controller_move(copy.handle(), Some(motion), Some(&mut at))), at)
    };
    let at = |field, joint, point| Where { field, joint, point };
    for count in [0, scene::MOST_POINTS as u32 + 1, u32::MAX] {
        let found = refused(&Motion { count, ..good });
        assert_eq!(found, (POINT, at(field::COUNT, -1, -1)));
    }
    let mut wrong = good;
    wrong.points[1].q[0] = f32::NAN;
    assert_eq!(refused(&wrong), (NOT_FINITE, at(field::POSITION, 0, 1)));
    wrong = good;
    wrong.points[2].ticks = 0;
    assert_eq!(refused(&wrong), (POINT, at(field::TICKS, -1, 2)));
    wrong = good;
    wrong.points[2].qd[0] = 0.1;
    assert_eq!(refused(&wrong), (POINT, at(field::VELOCITY, 0, 2)));
    wrong = good;
    wrong.points[1].ticks = 1;
    let (status, place) = refused(&wrong);
    assert_eq!((status, place.field, place.point), (POINT, field::SPEED, 1));
    assert_eq!(refused(&good).0, OK);
    // A motion is needed for a reset, and a measurement.
    assert_eq!(c::controller_reset(memory.handle(), None), NO_REFERENCE);
    assert_eq!(c::controller_move(memory.handle(), Some(&good), None), OK);
    assert_eq!(c::controller_reset(memory.handle(), None), NO_MEASUREMENT);
    let mut far = ends(&config)[0];
    far[0] += 0.2;
    tick(&mut memory, &far);
    let (mut place, handle) = (Where::NOWHERE, memory.handle());
    assert_eq!(c::controller_reset(handle, Some(&mut place)), TOO_FAR);
    assert_eq!(place, at(field::POSITION, 0, -1));
}

#[test]
fn faults_lead_from_full_to_hold_to_zero_torque() {
    let (mut memory, config) = (Memory::new(), config());
    moving(&mut memory, &config, 5000);
    let handle = memory.handle();
    let mut q = ends(&config)[0];
    for _ in 0..300 {
        assert_eq!(tick(&mut memory, &q).fault, 0);
        q = report(handle).reference.q;
    }
    // An encoder that fails: bridged, then held, then off.
    let (mut modes, mut valid) = (Vec::new(), [1; N]);
    valid[N - 1] = 0;
    for _ in 0..120 {
        let mut command = blank();
        q[N - 1] = f32::NAN;
        assert_eq!(c::controller_observe(handle, Some(&q), Some(&valid)), OK);
        assert_eq!(c::controller_command(handle, Some(&mut command)), OK);
        assert_eq!((command.fault, command.joint), (1, N as i32 - 1));
        assert!(command.torque.iter().all(|torque| torque.is_finite()));
        modes.push(command.mode);
        if command.mode == STOPPED {
            assert_eq!((command.torque, command.brake, command.enable), ([0.0; N], 1, 0));
        }
    }
    modes.dedup();
    assert_eq!(modes, [FULL, HOLD, STOPPED]);
    // It starts again after a measurement and a reset.
    let q = report(handle).q;
    assert_eq!(c::controller_reset(handle, None), NO_MEASUREMENT);
    tick(&mut memory, &q);
    assert_eq!(c::controller_reset(handle, None), OK);
    assert_eq!(tick(&mut memory, &q).mode, FULL);
    // A tick without a measurement, a measurement without a command, and one that is not finite.
    let mut command = blank();
    assert_eq!(c::controller_command(handle, Some(&mut command)), OK);
    assert_eq!((command.mode, command.fault), (FULL, 2));
    assert_eq!(c::controller_observe(handle, Some(&q), None), OK);
    assert_eq!(tick(&mut memory, &q).fault, 3);
    let mut bad = q;
    bad[0] = f32::INFINITY;
    let command = tick(&mut memory, &bad);
    assert_eq!((command.fault, command.joint), (4, 0));
    // A drive that fails takes the torque off; stop and off are from outside.
    for (stop, fault, joint) in
        [(0, 9, 0), (1, 21, -1), (2, 21, -1), (3, 23, 0), (3, 24, 0), (4, 25, 0)]
    {
        let mut again = Memory::new();
        moving(&mut again, &config, 5000);
        let handle = again.handle();
        tick(&mut again, &ends(&config)[0]);
        let status = match stop {
            0 => c::controller_fault(handle, 9, 0),
            1 => c::controller_stop(handle),
            3 | 4 => c::controller_fault(handle, fault, 0),
            _ => c::controller_off(handle),
        };
        assert_eq!(status, OK);
        let command = tick(&mut again, &ends(&config)[0]);
        let mode = if stop % 2 == 1 { HOLD } else { STOPPED };
        assert_eq!((command.mode, command.fault, command.joint), (mode, fault, joint));
    }
    assert_eq!(c::controller_fault(handle, 9, N as i32), NO_FAULT);
    assert_eq!(c::controller_fault(handle, 99, 0), NO_FAULT);
    assert_eq!(c::controller_missed(handle, 1000), OK);
    assert_eq!(tick(&mut memory, &q).mode, STOPPED);
}

#[test]
fn a_streamed_reference_is_checked_and_followed() {
    let (mut memory, mut config) = (Memory::new(), config());
    config.speed = [2.0; N];
    init(&mut memory, &config);
    let handle = memory.handle();
    let mut reference = State::at(ends(&config)[0]);
    let follow = |reference: &State| c::controller_follow(handle, Some(reference), None);
    assert_eq!(follow(&reference), OK);
    tick(&mut memory, &reference.q);
    assert_eq!(c::controller_reset(handle, None), OK);
    for _ in 0..400 {
        assert_eq!(follow(&reference), OK);
        assert_eq!(tick(&mut memory, &reference.q).fault, 0);
    }
    // A step, a speed, a number that is not finite: none of them is taken.
    let mut wrong = reference;
    wrong.q[0] += 0.05;
    assert_eq!(follow(&wrong), TOO_FAR);
    wrong = reference;
    wrong.qd[0] = 2.5;
    assert_eq!(follow(&wrong), POINT);
    wrong.qd[0] = f32::NAN;
    assert_eq!(follow(&wrong), NOT_FINITE);
    wrong = reference;
    wrong.q[0] = 2e4;
    let beyond = if Exports::RANGE[0] > 1e4 { POINT } else { ANGLE };
    assert!([beyond, TOO_FAR].contains(&follow(&wrong)));
    // A tick without a reference is bridged, and then the arm is held.
    reference.qd[0] = 0.1;
    assert_eq!(follow(&reference), OK);
    let modes: Vec<(i32, i32)> = (0..9)
        .map(|_| {
            let command = tick(&mut memory, &reference.q);
            (command.mode, command.fault)
        })
        .collect();
    assert_eq!(modes[0], (FULL, 0));
    assert_eq!(modes[1], (FULL, 2));
    assert_eq!(modes[8], (HOLD, 2));
}

#[test]
fn an_arm_away_from_its_streamed_reference_returns_to_it() {
    let (mut memory, mut config) = (Memory::new(), config());
    config.speed = [2.0; N];
    init(&mut memory, &config);
    let handle = memory.handle();
    let mut reference = State::at(ends(&config)[0]);
    let mut q = reference.q;
    // Within the distance of a restart, beyond the step of a tick.
    q[0] += 0.5 * config.restart_distance.min(0.1);
    let follow = |reference: &State| c::controller_follow(handle, Some(reference), None);
    assert_eq!(follow(&reference), OK);
    tick(&mut memory, &q);
    assert_eq!(c::controller_reset(handle, None), OK);
    for k in 0..3000 {
        // The reference moves meanwhile; the arm is where the controller wants it.
        reference.q[0] += if k % 2 == 0 { 1e-4 } else { -1e-4 };
        assert_eq!(follow(&reference), OK, "tick {k}");
        let command = tick(&mut memory, &q);
        assert_eq!((command.mode, command.fault), (FULL, 0), "tick {k}");
        q = report(handle).reference.q;
    }
    assert!((q[0] - reference.q[0]).abs() < 2e-3, "{} {}", q[0], reference.q[0]);
}

#[test]
fn a_configuration_in_other_units_gets_advice() {
    let mut advice = AdviceText { text: [7; 2048] };
    let mut said = |config: &Config| {
        let count = c::config_advice(Some(config), Some(&mut advice));
        let text = core::ffi::CStr::from_bytes_until_nul(&advice.text).expect("a zero");
        (count, text.to_str().expect("UTF-8").to_owned())
    };
    let good = config();
    let (before, _) = said(&good);
    let (count, text) = said(&Config { tick: 1.0, ..good });
    assert!(count > before && text.contains("tick"), "{count} {text}");
    assert_eq!(text.lines().count() as i32, count, "{text}");
    assert_eq!(c::config_advice(None, Some(&mut advice)), NULL);
    assert_eq!(c::config_advice(Some(&good), None), NULL);
}
