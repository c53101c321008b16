//! Robots with kinematic loops, in f64: ours as general loops or as clusters, against Pinocchio's
//! `constraintDynamics` and inverse dynamics that are composed of its algorithms.

use std::error::Error;
use std::ffi::CString;
use std::fmt::Write as _;
use std::hint::black_box;
use std::path::PathBuf;

use dynamics_core::clusters::{Clustered, ClusteredRobot};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::loops::{Loops, Stabilisation, forward_dynamics, inverse_dynamics};
use dynamics_core::model::{Model, Static, model};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use host_tests::export::{Placement, Robot};
use host_tests::recordings::{full_scale, row};
use loop_tests::clusters::recorded as clusters;
use loop_tests::machines::Machine;
use loop_tests::recorded::Recording;

use crate::foreign;
use crate::ours::rows;
use crate::robot::print;
use crate::subject::Subject;

/// The algorithms, Pinocchio's functions of them, and the largest errors of what is worth timing.
const INVERSE: (&str, &str, f64) = ("loops inverse", "pinocchio_loops_inverse", 1e-12);
const FORWARD: (&str, &str, f64) = ("loops forward", "pinocchio_loops_forward", 1e-10);
/// States in a timed batch: short against a time slice, since a state takes ten microseconds.
const BATCH: usize = 64;
const STILL: Stabilisation<f64> = Stabilisation::NONE;

/// A machine as Pinocchio's side reads it, and the recorded states in its order.
struct Theirs {
    /// A line of the robot, one a body, and lines of its loops, its actuated coordinates and `mu`.
    text: String,
    /// Our index of each of its positions and velocities.
    order: [Vec<usize>; 2],
    /// Our indices of the actuated coordinates.
    actuated: Vec<usize>,
}

impl Theirs {
    /// Points by the bodies that they are on; `mu` is that of the proximal solver.
    fn new(robot: &Robot, ends: &[[(i64, Placement); 2]], actuated: &[usize], mu: f64) -> Self {
        let order = foreign::their_order(robot.bodies.iter().map(|body| &*body.joint));
        let mut text = format!("{} {}\n", robot.name, robot.bodies.len());
        let place = |p: &Placement| [&p.rotation[..], &p.position].concat();
        for body in &robot.bodies {
            let _ = write!(text, "{} {} {}", body.name, body.parent, body.joint);
            let second = body.axis2.iter().flatten();
            let mut numbers = [&body.axis[..], &second.copied().collect::<Vec<_>>()].concat();
            numbers.extend(place(&body.placement));
            numbers.extend([&[body.mass], &body.com[..], &body.inertia_com].concat());
            spaced(&mut text, &numbers);
        }
        let _ = writeln!(text, "{}", ends.len());
        for (body, placement) in ends.as_flattened() {
            let _ = write!(text, "{body}");
            spaced(&mut text, &place(placement));
        }
        let theirs = actuated.iter().map(|i| order[1].iter().position(|k| k == i));
        let theirs: Vec<f64> = theirs.map(|i| i.expect("a coordinate") as f64).collect();
        let _ = write!(text, "{}", theirs.len());
        spaced(&mut text, &theirs);
        let _ = writeln!(text, "{mu}");
        Self { text, order, actuated: actuated.to_vec() }
    }

    /// Its function on states of q, q̇ and q̈ or the actuated torques; `wanted` says which of the
    /// recorded numbers each of our velocity coordinates is.
    fn subject(
        &self,
        (peer, path): &(String, PathBuf),
        function: &str,
        states: &[[&[f64]; 3]],
        wanted: impl Fn(usize) -> Option<usize>,
    ) -> Result<Subject<f64>, Box<dyn Error>> {
        let in_order = |which: usize, values: &[f64]| -> Vec<f64> {
            self.order[which].iter().map(|&k| values[k]).collect()
        };
        let is_forward = function == FORWARD.1;
        let mut input = Vec::new();
        for [q, qd, last] in states {
            input.extend([in_order(0, q), in_order(1, qd)].concat());
            if is_forward {
                let mut torque = vec![0.0; self.order[1].len()];
                for (&at, &tau) in self.actuated.iter().zip(*last) {
                    torque[at] = tau;
                }
                input.extend(in_order(1, &torque));
            } else {
                input.extend(in_order(1, last));
            }
        }
        let order: Vec<_> = match is_forward {
            true => self.order[1].iter().map(|&k| wanted(k)).collect(),
            false => (0..self.actuated.len()).map(Some).collect(),
        };
        let machine = CString::new(&*self.text)?;
        let run = foreign::loops(path, function, &machine, input, [states.len(), order.len()])?;
        Ok(Subject::new(peer, run, order))
    }
}

/// Checks on all recorded states what `gather` makes of some of them, then times it on the first
/// ones.
fn measure(
    robot: &str,
    (algorithm, _, bound): (&str, &str, f64),
    expected: &[Vec<f64>],
    gather: impl Fn(usize) -> Result<Vec<Subject<f64>>, Box<dyn Error>>,
) -> Result<(), Box<dyn Error>> {
    let full_scale = full_scale(expected);
    let mut errors = Vec::new();
    for mut subject in gather(expected.len())? {
        let error = subject.check(expected.len(), expected, full_scale, bound);
        errors.push(error.map_err(|e| format!("{algorithm} of {robot}: {e}"))?);
    }
    print([robot, algorithm, "f64"], gather(BATCH)?, BATCH, errors)
}

/// Numbers, and the end of the line.
fn spaced(text: &mut String, numbers: &[f64]) {
    for number in numbers {
        let _ = write!(text, " {number}");
    }
    text.push('\n');
}

/// General loops: the core over the robot as it is compiled, and over a model that is known at run
/// time only.
pub fn general<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>(
    libraries: &[(String, PathBuf)],
) -> Result<(), Box<dyn Error>>
where
    T: Machine<B, Q, V, L, C, A>,
{
    let recorded = Recording::load(T::MODEL.name);
    let machine = &recorded.machine;
    let ends: Vec<_> = (machine.loops.iter())
        .map(|joint| [0, 1].map(|k| (joint.bodies[k], joint.placements[k].clone())))
        .collect();
    let theirs = Theirs::new(&machine.robot, &ends, T::LOOPS.actuated(), 0.0);
    let states: Vec<(State<f64, Q, V>, [f64; A])> =
        (0..recorded.q.len()).map(|k| (recorded.state(k), row(&recorded.given_tau, k))).collect();
    for (key, last, expected) in
        [(INVERSE, &recorded.qdd, &recorded.tau), (FORWARD, &recorded.given_tau, &recorded.forward)]
    {
        let raw: Vec<[&[f64]; 3]> =
            (0..recorded.q.len()).map(|k| [&*recorded.q[k], &recorded.qd[k], &last[k]]).collect();
        measure(T::MODEL.name, key, expected, |count| {
            let robot: Box<Model<f64, B, Q, V>> = black_box(Box::new(*model::<f64, T, B, Q, V>()));
            let loops: Box<Loops<L, C, A>> = black_box(Box::new(T::LOOPS));
            let mut subjects = match key == INVERSE {
                true => vec![
                    rows("core", &states[..count], |(s, _)| {
                        let found = inverse_dynamics(&Static::<T>::NEW, &T::LOOPS, s, &RIGID_BODY);
                        found.expect("a torque").tau
                    }),
                    rows("core run-time model", &states[..count], move |(s, _)| {
                        let found = inverse_dynamics(&*robot, &loops, s, &RIGID_BODY);
                        found.expect("a torque").tau
                    }),
                ],
                false => vec![
                    rows("core", &states[..count], |(s, tau)| {
                        let robot = &Static::<T>::NEW;
                        let found = forward_dynamics(robot, &T::LOOPS, s, tau, STILL, &RIGID_BODY);
                        found.expect("accelerations").qdd
                    }),
                    rows("core run-time model", &states[..count], move |(s, tau)| {
                        let found = forward_dynamics(&*robot, &loops, s, tau, STILL, &RIGID_BODY);
                        found.expect("accelerations").qdd
                    }),
                ],
            };
            for library in libraries {
                subjects.push(theirs.subject(library, key.1, &raw[..count], Some)?);
            }
            Ok(subjects)
        })?;
    }
    Ok(())
}

/// Loops as clusters of joints: core and engine, which also close the loops; `mu` as in [`Theirs`].
pub fn clustered<T, const B: usize, const N: usize, const Y: usize>(
    libraries: &[(String, PathBuf)],
    mu: f64,
) -> Result<(), Box<dyn Error>>
where
    T: ClusteredRobot<B, N, N, Y, Y>,
{
    let recorded = clusters::recording(T::MODEL.name);
    let end = |loop_: &clusters::PointLoop, k: usize| {
        let rotation = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        let position = loop_.points[k];
        (loop_.bodies[k], Placement { rotation, position })
    };
    let ends: Vec<_> =
        (recorded.loops.iter()).map(|joint| [end(joint, 0), end(joint, 1)]).collect();
    let independent = recorded.independent.clone();
    let theirs = Theirs::new(&recorded.model, &ends, &independent, mu);
    let states: Vec<(State<f64, Y, Y>, [f64; Y])> = (0..recorded.q.len())
        .map(|k| (clusters::state(&recorded, k), row(&recorded.tau, k)))
        .collect();
    for (key, last, expected) in
        [(INVERSE, &recorded.tree_qdd, &recorded.rnea), (FORWARD, &recorded.tau, &recorded.forward)]
    {
        let raw: Vec<[&[f64]; 3]> = (0..recorded.q.len())
            .map(|k| [&*recorded.tree_q[k], &recorded.tree_qd[k], &last[k]])
            .collect();
        measure(T::MODEL.name, key, expected, |count| {
            let mut subjects = match key == INVERSE {
                true => vec![
                    rows("clusters, core", &states[..count], |(y, _)| {
                        Clustered::<Core<T>>::rnea(y, &RIGID_BODY).expect("it closes")
                    }),
                    rows("clusters, engine", &states[..count], |(y, _)| {
                        Clustered::<Engine<T>>::rnea(y, &RIGID_BODY).expect("it closes")
                    }),
                ],
                false => vec![rows("clusters, core", &states[..count], |(y, tau)| {
                    Clustered::<Core<T>>::aba(y, tau, &RIGID_BODY).expect("it moves")
                })],
            };
            for library in libraries {
                let wanted = |k| independent.iter().position(|&i| i == k);
                subjects.push(theirs.subject(library, key.1, &raw[..count], wanted)?);
            }
            Ok(subjects)
        })?;
    }
    Ok(())
}
