//! The crate dynibo: f64, a robot read from a URDF at run time, gravity fixed at 9.80665 m/s².

use std::error::Error;
use std::path::Path;

use dynamics_core::state::State;
use host_tests::export::Body;

use crate::subject::Subject;

/// Its gravity, of ours.
const GRAVITY: f64 = 9.80665 / 9.81;

/// What it has of the algorithms that we compare.
pub fn subject<const N: usize>(
    algorithm: &str,
    urdf: &Path,
    bodies: &[Body],
    states: &[State<f64, N, N>],
) -> Result<Option<Subject<f64>>, Box<dyn Error>> {
    let mut robot = dynibo::Robot::from_urdf(urdf)?;
    if robot.joint_count() != N {
        return Err(format!("dynibo sees {} joints", robot.joint_count()).into());
    }
    // It has an order of its own for the joints of a tree.
    let order = (0..N)
        .map(|index| {
            let name = robot.joint_name(index)?;
            let moving = bodies.iter().filter(|body| body.joint != "fixed");
            let mut ours = moving.map(|body| format!("{}_joint", body.name));
            Ok(ours
                .position(|ours| ours == name)
                .ok_or("dynibo made up a joint")?)
        })
        .collect::<Result<Vec<usize>, Box<dyn Error>>>()?;
    let sorted = |values: &[f64; N]| std::array::from_fn(|index| values[order[index]]);
    let outputs = if algorithm == "crba" {
        N * (N + 1) / 2
    } else {
        N
    };
    let mut states: Vec<State<f64, N, N>> = states
        .iter()
        .map(|s| State {
            q: sorted(&s.q),
            qd: sorted(&s.qd),
            qdd: sorted(&s.qdd),
        })
        .collect();
    if !["rnea", "gravity", "crba", "aba"].contains(&algorithm) {
        return Ok(None);
    }
    if algorithm == "aba" {
        // The torque that makes up for its gravity, so that it accelerates as under ours.
        for state in &mut states {
            let mut weight = [0.0; N];
            robot.gravity(&state.q, &[], &mut weight)?;
            for (tau, weight) in std::iter::zip(&mut state.qdd, weight) {
                *tau += weight * (1.0 - 1.0 / GRAVITY);
            }
        }
    }
    let weighs = matches!(algorithm, "rnea" | "gravity");
    let algorithm = algorithm.to_owned();
    let (mut m, matrix) = (vec![0.0; N * N], algorithm == "crba");
    Ok(Some(Subject {
        peer: "dynibo".to_owned(),
        run: Box::new(move |out| {
            for (out, s) in std::iter::zip(out.chunks_exact_mut(outputs), &states) {
                let done = match &*algorithm {
                    "rnea" => robot.inverse_dynamics(&s.q, &s.qd, &s.qdd, &[], out),
                    "gravity" => robot.gravity(&s.q, &[], out),
                    "crba" => robot.mass_matrix(&s.q, &mut m),
                    _ => robot.forward_dynamics(&s.q, &s.qd, &s.qdd, &[], out),
                };
                done.expect("finite inputs of the right size");
                if matrix {
                    let upper = (0..N).flat_map(|i| (i..N).map(move |j| i * N + j));
                    for (out, at) in std::iter::zip(out, upper) {
                        *out = m[at];
                    }
                }
            }
        }),
        outputs,
        order: if matrix { triangle::<N>(&order) } else { order },
        timed: true,
        gravity: if weighs { GRAVITY } else { 1.0 },
    }))
}

/// Which entry of our upper triangle each of its own is, given which of our joints each of its own is.
fn triangle<const N: usize>(order: &[usize]) -> Vec<usize> {
    let place = |i: usize, j: usize| i * N - i * (i + 1) / 2 + j;
    let ours = |i: usize, j: usize| place(order[i].min(order[j]), order[i].max(order[j]));
    (0..N)
        .flat_map(|i| (i..N).map(move |j| (i, j)))
        .map(|(i, j)| ours(i, j))
        .collect()
}
