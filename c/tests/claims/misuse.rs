//! What people do wrong on the first day with the library, and what it says.

use std::collections::BTreeSet;

use super::controller::{blank, config, ends};
use super::goal::{goal, limited};
use super::{LOAD, Memory, TILTED, numbers, probe};
use crate::library::{self as c, *};
use crate::scene::N;
use dynamics_c::status::*;
use dynamics_c::{fault_of, field, number_of};
use dynamics_core::glam::Vec3;

#[test]
fn a_goal_before_a_measurement_is_refused() {
    let (mut memory, config) = (Memory::new(), limited());
    let (mut motion, home) = (goal(&config, 200.0), ends(&config)[0]);
    let handle = memory.handle();
    assert_eq!(c::controller_init(handle, Exports::CONTROLLER_BYTES, Some(&config), None), OK);
    let ask = |motion: &mut Goal| c::controller_goal(handle, Some(motion), Some(&home), None, None);
    let command = || c::controller_command(handle, Some(&mut blank()));
    assert_eq!(ask(&mut motion), NO_MEASUREMENT);
    let (first, mut change) = (Some(&motion), numbers());
    let begun =
        c::controller_goal_begin(handle, first, Some(&mut change), 9, Some(&home), None, None);
    assert_eq!(begun, NO_MEASUREMENT);
    // A measurement counts with the end of its tick; one that is no number never does.
    for (q, expected) in [([f32::NAN; N], NO_MEASUREMENT), (home, OK)] {
        assert_eq!(c::controller_observe(handle, Some(&q), None), OK);
        assert_eq!(ask(&mut motion), NO_MEASUREMENT);
        assert_eq!(command(), OK);
        assert_eq!(ask(&mut motion), expected);
    }
    let mut first = State::at([7.0; N]);
    assert_eq!(c::goal_state(Some(&motion), 0, Some(&mut first)), OK);
    assert_eq!(first.q, home);
    // An arm on its brake may have moved since.
    assert_eq!(command(), OK);
    assert_eq!(ask(&mut motion), NO_MEASUREMENT);
}

#[test]
fn a_goal_or_a_tip_without_an_acceleration_names_it() {
    let (described, mut at) = (config(), Where::NOWHERE);
    let mut init = |config: &Config| {
        let (mut goal, mut tip) = (numbers(), numbers());
        let found = c::goal_init(Some(&mut goal), Some(config), Some(&[9.0; N]), Some(&mut at));
        let of_goal = (found, at.field, at.joint);
        let start = State::at(ends(config)[0]);
        let found =
            c::tip_init(Some(&mut tip), Some(config), Some(&start), 0.01, 0.3, 0.0, Some(&mut at));
        (of_goal, (found, at.field, at.joint))
    };
    let none = (CONFIG, field::ACCELERATION, 0);
    assert_eq!(init(&described), (none, none));
    let mut set = Config { acceleration: [20.0; N], speed: [2.0; N], ..described };
    assert_eq!(init(&set), ((OK, field::NONE, -1), (OK, field::NONE, -1)));
    set.speed[N - 1] = f32::INFINITY;
    assert_eq!(init(&set).0, (CONFIG, field::SPEED, N as i32 - 1));
}

/// The address that is `offset` bytes from an aligned one.
fn at<T>(buffer: &mut [u64; 2048], offset: usize) -> *mut T {
    buffer.as_mut_ptr().cast::<u8>().wrapping_add(offset).cast()
}

/// References that are not aligned must not exist: these are C's pointers.
#[test]
fn pointers_that_are_not_aligned_are_refused() {
    let (mut buffer, config, mut tau) = ([0x5a5a; 2048], limited(), [7.0; N]);
    let (jerk, state, motors) = ([9.0; N], probe(), &super::thermal::MOTORS);
    let (before, bytes) = (buffer, Exports::CONTROLLER_BYTES);
    let (null, nowhere) = (core::ptr::null(), core::ptr::null_mut());
    for offset in [1, 2, 3, 4, 7] {
        let array: *mut Joints = at(&mut buffer, offset);
        // SAFETY: they point into the buffer, whose numbers are a value of any of these types.
        let found = unsafe {
            [
                c::raw::goal_init(at(&mut buffer, offset), &config, &jerk, nowhere),
                c::raw::tip_init(at(&mut buffer, offset), &config, &state, 0.01, 0.3, 0.0, nowhere),
                c::raw::thermal_init(at(&mut buffer, offset), motors, &config, null, 0.0, nowhere),
                if offset == 4 { MEMORY } else { c::raw::gravity(array, &mut tau) },
                if offset == 4 { MEMORY } else { c::raw::gravity(&state.q, array) },
            ]
        };
        assert_eq!(found, [MEMORY; 5], "{offset}");
        // A controller, whose command is a stop all the same.
        let handle = core::ptr::NonNull::new(at(&mut buffer, offset));
        // SAFETY: as above.
        let handle = handle.map(|memory| unsafe { Handle::new(memory) });
        assert_eq!(c::controller_init(handle, bytes, Some(&config), None), MEMORY);
        let mut command = blank();
        assert_eq!(c::controller_command(handle, Some(&mut command)), MEMORY);
        assert_eq!((command.torque, command.brake, command.enable), ([0.0; N], 1, 0));
    }
    assert_eq!((buffer, tau), (before, [7.0; N]));
    // Aligned objects are taken, and bytes wherever they are.
    let mut memory = Memory::new();
    assert_eq!(c::controller_init(memory.handle(), bytes, Some(&config), None), OK);
    // SAFETY: as above.
    unsafe {
        assert_eq!(c::raw::goal_init(at(&mut buffer, 8), &config, &jerk, nowhere), OK);
        assert_eq!(c::raw::controller_observe(memory.handle(), &state.q, at(&mut buffer, 1)), OK);
        assert_eq!(c::raw::gravity(null.cast(), &mut tau), NULL);
    }
}

#[test]
fn a_load_or_a_gravity_in_another_unit_is_named() {
    let set = |load: Load, gravity: [f32; 3]| {
        c::tool_set(Some(&mut Tool::default()), 0, Some(&load), Some(&gravity))
    };
    for (load, expected) in [
        (Load { mass: 2500.0, ..LOAD }, LOAD_MASS),
        (Load { com: [0.0, -80.0, 0.0], ..LOAD }, LOAD_COM),
        (Load { mass: 9.9, ..LOAD }, OK),
        (Load { com: [0.0, 0.0, 0.99], ..LOAD }, OK),
    ] {
        assert_eq!(set(load, TILTED), expected, "{load:?}");
    }
    let wrench = Wrench::new(Vec3::ZERO, Vec3::ONE);
    let load = SensorLoad { mass: 1.0, first_moment: Vec3::ZERO, offset: wrench };
    for (gravity, expected) in [
        ([0.0, 0.0, 1.0], GRAVITY),
        ([0.0, -0.6, -0.8], GRAVITY),
        ([0.0, 0.0, -9810.0], GRAVITY),
        ([0.0, 0.0, f32::NAN], NOT_FINITE),
        // On the ceiling, on the moon, in orbit.
        ([0.0, 0.0, 9.81], OK),
        ([0.0, 0.0, -1.62], OK),
        ([0.0; 3], OK),
    ] {
        let (mut fit, mut shown, down) = (numbers(), wrench, Vec3::from(gravity));
        assert_eq!(set(LOAD, gravity), expected, "{gravity:?}");
        assert_eq!(c::sensor_fit_add(Some(&mut fit), Some(&down), Some(&wrench)), expected);
        assert_eq!(c::sensor_at_rest(Some(&load), Some(&down), Some(&mut shown)), expected);
    }
}

/// `LostTurn` of the library is `LOST_TURN` of the header, and each fault of it is one of these.
#[test]
fn each_fault_has_a_number_of_its_own_and_comes_back() {
    let source = include_str!("../../../motion-control/src/limits/fault.rs");
    let (_, list) = source.split_once("pub enum Fault {").expect("the faults");
    let (list, _) = list.split_once("\n}\n").expect("their end");
    let names = list.lines().filter_map(|line| line.strip_prefix("    "));
    let names = names.filter(|line| line.starts_with(char::is_uppercase));
    let faults: BTreeSet<String> =
        names.map(|name| name.trim_end_matches([' ', '{', ',']).to_lowercase()).collect();
    let header = include_str!("../../include/dynamics.h.liquid").replace(',', " ").to_lowercase();
    let (header, mut found) = (header.replace('_', ""), BTreeSet::new());
    for (number, fault) in (0..100).filter_map(|number| Some((number, fault_of::<N>(number, 0)?))) {
        let debug = format!("{fault:?}").to_lowercase();
        let (name, joint) = debug.split_once(" {").map_or((&*debug, -1), |(name, _)| (name, 0));
        assert!(header.contains(&format!("fault{name} = {number} ")), "{name}");
        assert_eq!(number_of(fault), (number, joint));
        found.insert(name.to_owned());
    }
    assert_eq!(found, faults);
}
