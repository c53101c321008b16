//! The functions as C calls them: against the algorithms of the textbook, and with inputs that are wrong.

mod controller;
mod fuzz;
mod goal;
mod header;
mod misuse;
mod thermal;
mod tip;
mod wrench;

use core::ptr::NonNull;

use crate::library::{self as c, *};
use crate::scene::{self, N};
use dynamics_c::status::*;
use dynamics_core::Core;
use dynamics_core::algorithms::frame::LocalWorldAligned;
use dynamics_core::effects::{Gravity, GravityVector, Payload};
use dynamics_core::model::BodyInertia;

/// The inputs of most tests.
pub fn probe() -> State {
    let of = |first: f32, step: f32| core::array::from_fn(|joint| first + step * joint as f32);
    State { q: of(0.1, 0.07), qd: of(0.3, -0.05), qdd: of(-0.2, 0.11) }
}

fn largest(values: &[f32]) -> f32 {
    values.iter().fold(0.0, |most, x| most.max(x.abs()))
}

fn close(a: &[f32], b: &[f32]) {
    close_for(largest(b), a, b);
}

/// Compares numbers that were computed from others of this size, whose rounding they have.
fn close_for(size: f32, a: &[f32], b: &[f32]) {
    for (x, y) in a.iter().zip(b) {
        assert!((x - y).abs() <= 1e-5 * size, "{a:?} {b:?}");
    }
}

const LOAD: Load =
    Load { mass: 0.5, com: [0.01, -0.02, 0.1], inertia: [2e-3, 1e-4, 0.0, 2e-3, 0.0, 1e-3] };
const TILTED: [f32; 3] = [3.0, -4.0, -8.4];

/// A value that consists of numbers alone, all of them zero.
pub fn numbers<T: Copy>() -> T {
    // SAFETY: any bits are a value of such a type.
    unsafe { core::mem::zeroed() }
}

/// The memory of a controller.
#[repr(C, align(8))]
#[derive(Clone, Copy, Debug)]
pub struct Memory([u8; Exports::CONTROLLER_BYTES]);

impl Memory {
    pub fn new() -> Self {
        Self::filled(0)
    }

    pub fn filled(byte: u8) -> Self {
        Self([byte; Exports::CONTROLLER_BYTES])
    }

    /// Overwrites its first byte.
    pub fn spoil(&mut self, byte: u8) {
        self.0[0] = byte;
    }

    pub fn handle(&mut self) -> Option<Handle> {
        // SAFETY: it has the size and the alignment of the header's type.
        Some(unsafe { Handle::new(NonNull::from(&mut self.0).cast()) })
    }
}

/// A tool on a body.
pub fn tool(body: usize) -> Tool {
    let mut tool = Tool::default();
    let status = c::tool_set(Some(&mut tool), body as i32, Some(&LOAD), Some(&TILTED));
    assert_eq!(status, OK);
    tool
}

#[test]
fn every_function_computes_what_the_textbook_does() {
    let (state, mut tau) = (probe(), [0.0; N]);
    assert_eq!(c::inverse_dynamics(Some(&state), Some(&mut tau)), OK);
    close(&tau, &Core::<scene::Arm>::rnea(&state, &scene::EFFECTS));

    let mut gravity = [0.0; N];
    assert_eq!(c::gravity(Some(&state.q), Some(&mut gravity)), OK);
    close(&gravity, &Core::<scene::Arm>::rnea(&State::at(state.q), &Gravity::EARTH));

    let mut inertia = [[0.0; N]; N];
    assert_eq!(c::inertia(Some(&state.q), Some(&mut inertia)), OK);
    let m = Core::<scene::Arm>::crba(&state.q, &scene::EFFECTS);
    let rows: Vec<f32> = (0..N * N).map(|at| m.get(at / N, at % N)).collect();
    close(inertia.as_flattened(), &rows);

    let [mut by_q, mut by_qd] = [[[0.0; N]; N]; 2];
    let status = c::inverse_dynamics_derivatives(Some(&state), Some(&mut by_q), Some(&mut by_qd));
    assert_eq!(status, OK);
    let by = Core::<scene::Arm>::rnea_derivatives(&state, &scene::EFFECTS);
    close(by_q.as_flattened(), by.dq.as_flattened());
    close(by_qd.as_flattened(), by.dqd.as_flattened());

    let mut qdd = [0.0; N];
    assert_eq!(c::forward_dynamics(Some(&state), Some(&tau), Some(&mut qdd)), OK);
    // M q̈ is compared, since q̈ of a light joint has the rounding of the others' torque.
    close_for(largest(&tau), &m.mul_vec(&qdd), &m.mul_vec(&state.qdd));
}

#[test]
fn a_tool_is_the_library_s_payload_under_its_gravity() {
    let state = probe();
    let Load { mass, com, inertia } = LOAD;
    let load =
        Payload::<f32, { scene::TOOL_BODY }>::from_inertia(BodyInertia { mass, com, inertia });
    let [x, y, z] = TILTED;
    let mut field = GravityVector::<f32>(load.0.first_moment);
    (field.0.x, field.0.y, field.0.z) = (x, y, z);
    let scene = (field, load, scene::FORCES);
    let m = Core::<scene::Arm>::crba(&state.q, &scene);
    let on_last = tool(scene::TOOL_BODY);

    let (mut tau, mut gravity) = ([0.0; N], [0.0; N]);
    let (mut inertia, mut qdd) = ([[0.0; N]; N], [0.0; N]);
    let set = Some(&on_last);
    assert_eq!(c::inverse_dynamics_with_tool(Some(&state), set, Some(&mut tau)), OK);
    close(&tau, &Core::<scene::Arm>::rnea(&state, &scene));
    assert_eq!(c::gravity_with_tool(Some(&state.q), set, Some(&mut gravity)), OK);
    close(&gravity, &Core::<scene::Arm>::rnea(&State::at(state.q), &(field, load)));
    assert_eq!(c::inertia_with_tool(Some(&state.q), set, Some(&mut inertia)), OK);
    let rows: Vec<f32> = (0..N * N).map(|at| m.get(at / N, at % N)).collect();
    close(inertia.as_flattened(), &rows);
    let status = c::forward_dynamics_with_tool(Some(&state), Some(&tau), set, Some(&mut qdd));
    assert_eq!(status, OK);
    close_for(largest(&tau), &m.mul_vec(&qdd), &m.mul_vec(&state.qdd));
}

#[test]
fn a_tool_on_any_body_weighs_by_its_jacobian() {
    let state = probe();
    for body in 0..N {
        let (mut with, mut without) = ([0.0; N], [0.0; N]);
        let (mut light, mut jacobian) = (Tool::default(), [[0.0; N]; 6]);
        let none = Load::default();
        let set = c::tool_set(Some(&mut light), body as i32, Some(&none), Some(&TILTED));
        assert_eq!(set, OK);
        // A point of 2 kg at the body's origin.
        let (mut heavy, point) = (Tool::default(), Load { mass: 2.0, ..none });
        let set = c::tool_set(Some(&mut heavy), body as i32, Some(&point), Some(&TILTED));
        assert_eq!(set, OK);
        for (tool, tau) in [(&heavy, &mut with), (&light, &mut without)] {
            assert_eq!(c::gravity_with_tool(Some(&state.q), Some(tool), Some(tau)), OK);
        }
        let found = c::body_jacobian(Some(&state.q), body as i32, Some(&mut jacobian));
        assert_eq!(found, OK);
        let size = largest(&with).max(largest(&without));
        for joint in 0..N {
            let weight: f32 = (0..3).map(|k| -2.0 * TILTED[k] * jacobian[3 + k][joint]).sum();
            let found = with[joint] - without[joint];
            assert!((found - weight).abs() <= 1e-5 * size, "body {body}: {found} {weight}");
        }
    }
}

#[test]
fn gravity_of_a_base_is_turned_with_it() {
    let mut gravity = [0.0; 3];
    let upside_down = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]];
    let status = c::gravity_of_base(Some(&upside_down), Some(&mut gravity));
    assert_eq!((status, gravity), (OK, [0.0, 0.0, scene::GRAVITY as f32]));
    // The base's x axis points upwards.
    let wall = [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    assert_eq!(c::gravity_of_base(Some(&wall), Some(&mut gravity)), OK);
    assert_eq!(gravity, [-(scene::GRAVITY as f32), 0.0, 0.0]);
    let mirrored = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]];
    let refused = c::gravity_of_base(Some(&mirrored), Some(&mut gravity));
    assert_eq!(refused, ROTATION);
}

#[test]
fn pose_and_jacobian_are_those_of_the_textbook() {
    let (q, poses) = (probe().q, Core::<scene::Arm>::poses(&probe().q));
    for (body, expected) in poses.iter().enumerate() {
        let (mut pose, mut jacobian) = (Pose::default(), [[0.0; N]; 6]);
        assert_eq!(c::body_pose(Some(&q), body as i32, Some(&mut pose)), OK);
        assert_eq!(pose.position, expected.pos.to_array());
        assert_eq!(pose.rotation[0][1], expected.rot.y_axis.x);
        let found = c::body_jacobian(Some(&q), body as i32, Some(&mut jacobian));
        assert_eq!(found, OK);
        for (joint, column) in
            Core::<scene::Arm>::jacobian(&q, body, LocalWorldAligned).iter().enumerate()
        {
            let entries = [column.ang.to_array(), column.lin.to_array()];
            let found: Vec<f32> = jacobian.iter().map(|row| row[joint]).collect();
            assert_eq!(found, entries.as_flattened());
        }
    }
    for body in [-1, N as i32, i32::MAX] {
        let (mut pose, mut jacobian) = (Pose::default(), [[7.0; N]; 6]);
        assert_eq!(c::body_pose(Some(&q), body, Some(&mut pose)), NO_BODY);
        let refused = c::body_jacobian(Some(&q), body, Some(&mut jacobian));
        assert_eq!((refused, jacobian), (NO_BODY, [[7.0; N]; 6]));
    }
}

#[test]
fn loads_that_no_body_has_are_refused() {
    let good = LOAD;
    for (body, load, expected) in [
        (N, good, NO_BODY),
        (0, Load { mass: -0.1, ..good }, MASS),
        (0, Load { mass: 0.0, ..good }, MASSLESS),
        (0, Load { mass: f32::NAN, ..good }, NOT_FINITE),
        (0, Load { com: [f32::INFINITY, 0.0, 0.0], ..good }, NOT_FINITE),
        (0, Load { com: [3e38, 0.0, 0.0], ..good }, LOAD_COM),
        (0, Load { inertia: [0.01, 0.0, 0.0, 0.01, 0.0, 0.03], ..good }, MOMENTS),
        (0, Load { inertia: [-0.01, 0.0, 0.0, 0.01, 0.0, 0.01], ..good }, MOMENTS),
    ] {
        let mut tool = Tool::default();
        let status = c::tool_set(Some(&mut tool), body as i32, Some(&load), Some(&TILTED));
        assert_eq!(status, expected, "{load:?}");
        // It is still none.
        let mut tau = [7.0; N];
        let refused = c::gravity_with_tool(Some(&probe().q), Some(&tool), Some(&mut tau));
        assert_eq!((refused, tau), (TOOL, [7.0; N]));
    }
}

#[test]
fn wrong_inputs_have_a_status_and_leave_the_output() {
    let mut tau = [7.0; N];
    assert_eq!(c::inverse_dynamics(None, Some(&mut tau)), NULL);
    assert_eq!(c::inverse_dynamics(Some(&probe()), None), NULL);
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for joint in 0..N {
            for (k, mut state) in [probe(); 3].into_iter().enumerate() {
                [&mut state.q, &mut state.qd, &mut state.qdd][k][joint] = bad;
                let returned = c::inverse_dynamics(Some(&state), Some(&mut tau));
                assert_eq!(returned, NOT_FINITE);
            }
        }
    }
    // Infinities of both signs have no sum.
    let both = State { q: [f32::INFINITY; N], qd: [f32::NEG_INFINITY; N], ..probe() };
    assert_eq!(c::inverse_dynamics(Some(&both), Some(&mut tau)), NOT_FINITE);
    assert_eq!(tau, [7.0; N]);
}

#[test]
fn finite_numbers_whose_sum_is_infinite_are_accepted() {
    let mut tau = [7.0; N];
    // A friction or an inertia at the joint may still overflow, and then says so.
    let state = State { qd: [0.0; N], qdd: [2e38; N], ..probe() };
    let status = c::inverse_dynamics(Some(&state), Some(&mut tau));
    let expected = Core::<scene::Arm>::rnea(&state, &scene::EFFECTS);
    if status == OK {
        close(&tau, &expected);
    } else {
        assert_eq!((status, tau), (OVERFLOW, [7.0; N]));
        assert!(expected.iter().any(|tau| !tau.is_finite()), "{expected:?}");
    }
}

#[test]
fn angles_beyond_their_range_are_an_error() {
    for (joint, link) in
        dynamics_core::model::model::<f32, scene::Arm, N, N, N>().links.iter().enumerate()
    {
        let range = Exports::RANGE[joint];
        let limits = link.limits;
        let near = limits.lower >= -4.0 * core::f32::consts::PI
            && limits.upper <= 4.0 * core::f32::consts::PI;
        let is_angle = link.joint.kind != dynamics_core::model::JointKind::Prismatic;
        assert_eq!(
            range,
            if !is_angle {
                f32::MAX
            } else if near {
                100.0
            } else {
                1e4
            }
        );
        for (q, expected) in
            [(range, OK), (-range, OK), (range.next_up(), ANGLE), (-range.next_up(), ANGLE)]
        {
            // The next number after the greatest one is infinite.
            let expected = if q.is_finite() { expected } else { NOT_FINITE };
            let (mut at, mut tau, mut m) = (probe(), [7.0; N], [[7.0; N]; N]);
            at.q[joint] = q;
            let mut found = vec![
                c::inverse_dynamics(Some(&at), Some(&mut tau)),
                c::gravity(Some(&at.q), Some(&mut tau)),
                c::inertia(Some(&at.q), Some(&mut m)),
            ];
            if !is_angle && q.is_finite() {
                // A prismatic joint may be anywhere, as long as the result is finite.
                found.retain(|&status| status != OVERFLOW);
            }
            assert!(found.iter().all(|&status| status == expected), "{q} {found:?}");
        }
    }
}

/// The inputs with which the functions once returned OK and torques that were not a number.
#[test]
fn results_that_are_not_finite_have_a_status() {
    let still = State { qd: [0.0; N], qdd: [0.0; N], ..probe() };
    for (k, value) in [
        (0, 3e38),
        (0, -3e38),
        (0, 1e30),
        (0, 1e5),
        (0, 101.0),
        (1, 1e18),
        (1, 1e20),
        (1, 1e30),
        (2, 3e38),
    ] {
        let (mut tau, mut qdd) = ([42.0; N], [42.0; N]);
        for all in [false, true] {
            let mut state = still;
            let list = match k {
                0 => &mut state.q,
                1 => &mut state.qd,
                _ => &mut state.qdd,
            };
            list[0] = value;
            if all {
                *list = [value; N];
            }
            let inverse = c::inverse_dynamics(Some(&state), Some(&mut tau));
            let forward = c::forward_dynamics(Some(&state), Some(&[1.0; N]), Some(&mut qdd));
            for (status, result) in [(inverse, &mut tau), (forward, &mut qdd)] {
                let is_written = *result != [42.0; N];
                assert_eq!(is_written, status == OK, "{state:?}");
                assert!(result.iter().all(|x| x.is_finite()), "{state:?} {result:?}");
                *result = [42.0; N];
            }
            if k == 0 && Exports::RANGE[0] < value.abs() {
                assert_eq!((inverse, forward), (ANGLE, ANGLE));
            }
        }
    }
}
