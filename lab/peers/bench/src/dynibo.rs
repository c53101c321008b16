//! The crate dynibo: f64, a robot read from a URDF at run time, gravity fixed at 9.80665 m/s².

use std::error::Error;
use std::path::Path;

use dynamics_core::state::State;
use host_tests::recordings::Recording;

use crate::subject::{Subject, square};

/// Its gravity, relative to the recordings'.
const GRAVITY: f64 = 9.80665 / 9.81;

/// Its inverse dynamics, gravity torques, mass matrix and forward dynamics; nothing for what it lacks.
pub fn subject<const Q: usize, const N: usize>(
    algorithm: &str,
    urdf: &Path,
    recording: &Recording,
    states: &[State<f64, Q, N>],
) -> Result<Option<Subject<f64>>, Box<dyn Error>> {
    let gravity = match algorithm {
        // It has no free base.
        _ if Q != N => return Ok(None),
        "rnea" | "gravity" => GRAVITY,
        "crba" | "aba" => 1.0,
        _ => return Ok(None),
    };
    let mut robot = dynibo::Robot::from_urdf(urdf)?;
    if robot.joint_count() != N {
        return Err(format!("dynibo sees {} joints", robot.joint_count()).into());
    }
    // It has an order of its own for the joints of a tree.
    let order = (0..N)
        .map(|index| {
            let name = robot.joint_name(index)?;
            let moving = recording
                .model
                .bodies
                .iter()
                .filter(|body| body.joint != "fixed");
            let mut ours = moving.map(|body| format!("{}_joint", body.name));
            Ok(ours
                .position(|ours| ours == name)
                .ok_or("dynibo made up a joint")?)
        })
        .collect::<Result<Vec<usize>, Box<dyn Error>>>()?;
    let sorted = |values: &[f64]| std::array::from_fn(|index| values[order[index]]);
    let weights = recording.gravity.iter().cycle();
    let states: Vec<State<f64, N, N>> = std::iter::zip(states, weights)
        .map(|(s, weight)| {
            let mut last = s.qdd;
            if algorithm == "aba" {
                // The torque that, under its gravity, does what ours does under the recordings'.
                for (tau, weight) in std::iter::zip(&mut last, weight) {
                    *tau -= (1.0 - GRAVITY) * weight;
                }
            }
            State {
                q: sorted(&s.q),
                qd: sorted(&s.qd),
                qdd: sorted(&last),
            }
        })
        .collect();
    let order = match algorithm {
        "crba" => square(&order),
        _ => order.into_iter().map(Some).collect(),
    };
    let (run, outputs) = (compute(algorithm), order.len());
    let run = move |out: &mut [f64]| {
        for (out, s) in std::iter::zip(out.chunks_exact_mut(outputs), &states) {
            run(&mut robot, s, out).expect("finite inputs of the right size");
        }
    };
    Ok(Some(Subject {
        gravity,
        ..Subject::new("dynibo", Box::new(run), order)
    }))
}

type Compute<const N: usize> =
    fn(&mut dynibo::Robot, &State<f64, N, N>, &mut [f64]) -> dynibo::Result<()>;

/// Its function; in forward dynamics the torque stands in the place of q̈.
fn compute<const N: usize>(algorithm: &str) -> Compute<N> {
    match algorithm {
        "rnea" => |robot, s, out| robot.inverse_dynamics(&s.q, &s.qd, &s.qdd, &[], out),
        "gravity" => |robot, s, out| robot.gravity(&s.q, &[], out),
        "crba" => |robot, s, out| robot.mass_matrix(&s.q, out),
        _ => |robot, s, out| robot.forward_dynamics(&s.q, &s.qd, &s.qdd, &[], out),
    }
}
