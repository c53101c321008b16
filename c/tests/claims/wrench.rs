//! Wrenches in joints and of loads against each other, and a sensor's load that is found again.

use crate::library::{self as c, *};
use crate::scene::{self, N};
use dynamics_c::status::*;
use dynamics_core::Core;
use dynamics_core::glam::{Mat3, Vec3};

use super::{LOAD, TILTED, close, close_for, numbers, probe};

pub fn six(wrench: &Wrench) -> [f32; 6] {
    [wrench.ang.x, wrench.ang.y, wrench.ang.z, wrench.lin.x, wrench.lin.y, wrench.lin.z]
}

fn joint(tool: Option<&Tool>, body: usize) -> ([f32; N], Wrench) {
    let (mut tau, mut wrench) = ([7.0; N], Wrench::ZERO);
    let found =
        c::joint_wrench(Some(&probe()), tool, body as i32, Some(&mut tau), Some(&mut wrench));
    assert_eq!(found, OK);
    (tau, wrench)
}

/// The wrench of a load on a body, and the tool that has it.
fn of_tool(state: &State, body: usize, load: &Load, gravity: &[f32; 3]) -> (Wrench, Tool) {
    let (mut wrench, mut tool) = (Wrench::ZERO, Tool::default());
    assert_eq!(c::tool_set(Some(&mut tool), body as i32, Some(load), Some(gravity)), OK);
    assert_eq!(c::tool_wrench(Some(state), Some(&tool), Some(&mut wrench)), OK);
    (wrench, tool)
}

#[test]
fn wrenches_in_joints_are_those_of_the_textbook_with_what_a_tool_adds() {
    let all = Core::<scene::Arm>::rnea_and_wrenches(&probe(), &scene::EFFECTS);
    for (body, expected) in all.wrenches.iter().enumerate() {
        let (tau, wrench) = joint(None, body);
        close(&tau, &all.tau);
        close(&six(&wrench), &six(expected));
        // The wrench in its own joint with a tool is that without it and the tool's.
        let [(zero, light), (added, heavy)] =
            [Load::default(), LOAD].map(|load| of_tool(&probe(), body, &load, &TILTED));
        let sum = joint(Some(&light), body).1 + added - zero;
        close(&six(&joint(Some(&heavy), body).1), &six(&sum));
    }
    let (mut tau, mut wrench) = ([7.0; N], Wrench::ZERO);
    for body in [-1, N as i32] {
        let found = c::joint_wrench(Some(&probe()), None, body, Some(&mut tau), Some(&mut wrench));
        assert_eq!((found, tau), (NO_BODY, [7.0; N]));
    }
    let unset = c::tool_wrench(Some(&probe()), Some(&Tool::default()), Some(&mut wrench));
    assert_eq!((unset, c::sensor_fit_load(None, None)), (TOOL, NULL));
}

#[test]
fn the_load_of_a_sensor_is_found_from_poses_at_rest() {
    let (mut fit, mut load): (SensorFit, SensorLoad) = numbers();
    let offset = Wrench::new(Vec3::new(0.2, -0.1, 0.05), Vec3::new(3.0, -2.0, 5.0));
    // A tool at rest: its gravity turns instead of its body.
    let state = State::at(probe().q);
    let rot = Core::<scene::Arm>::poses(&state.q)[scene::TOOL_BODY].rot;
    let shown = |gravity| of_tool(&state, scene::TOOL_BODY, &LOAD, &gravity).0 + offset;
    let mut add = |gravity: [f32; 3], expected| {
        let here = rot.transpose() * Vec3::from(gravity);
        let found = c::sensor_fit_add(Some(&mut fit), Some(&here), Some(&shown(gravity)));
        assert_eq!((found, c::sensor_fit_load(Some(&fit), Some(&mut load))), (OK, expected));
    };
    let (few, line) = (FEW_POSES, ONE_DIRECTION);
    [few, few, line, line].into_iter().for_each(|expected| add([0.0, 0.0, -9.81], expected));
    add(TILTED, line);
    add([9.81, 0.0, 0.0], OK);
    close(&[load.mass], &[LOAD.mass]);
    close_for(10.0, load.first_moment.as_ref(), &LOAD.com.map(|c| LOAD.mass * c));
    close_for(10.0, &six(&load.offset), &six(&offset));
    let (gravity, mut rest) = ([-4.0, 8.0, 1.0], Wrench::ZERO);
    let here = rot.transpose() * Vec3::from(gravity);
    assert_eq!(c::sensor_at_rest(Some(&load), Some(&here), Some(&mut rest)), OK);
    close_for(10.0, &six(&rest), &six(&shown(gravity)));
    let refused = c::sensor_fit_add(Some(&mut fit), Some(&Vec3::NAN), Some(&rest));
    assert_eq!((refused, c::sensor_fit_load(Some(&fit), Some(&mut load))), (NOT_FINITE, OK));
    // A sensor of the other sign, and one that is turned about its z.
    for (by, expected) in [(-Mat3::IDENTITY, SENSOR_SIGN), (QUARTER, SENSOR_AXES)] {
        let mut fit: SensorFit = numbers();
        for gravity in [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y].map(|axis| axis * 9.81) {
            let here = Wrench::new(Vec3::ZERO, by * -gravity);
            assert_eq!(c::sensor_fit_add(Some(&mut fit), Some(&gravity), Some(&here)), OK);
        }
        assert_eq!(c::sensor_fit_load(Some(&fit), Some(&mut load)), expected);
    }
}

/// A turn by 90° about z.
const QUARTER: Mat3 = Mat3::from_cols(Vec3::Y, Vec3::NEG_X, Vec3::Z);
