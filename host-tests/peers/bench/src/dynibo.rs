//! The crate dynibo: f64, a robot read from a URDF at run time, gravity fixed at 9.80665 m/s².

use std::error::Error;
use std::path::Path;

use dynamics_core::state::State;
use host_tests::export::Body;

use crate::subject::Subject;

/// Its inverse dynamics and its gravity torques; nothing for what we do not compare.
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
    let states: Vec<State<f64, N, N>> = states
        .iter()
        .map(|s| State {
            q: sorted(&s.q),
            qd: sorted(&s.qd),
            qdd: sorted(&s.qdd),
        })
        .collect();
    let full = match algorithm {
        "rnea" => true,
        "gravity" => false,
        _ => return Ok(None),
    };
    Ok(Some(Subject {
        peer: "dynibo".to_owned(),
        run: Box::new(move |out| {
            for (tau, s) in std::iter::zip(out.as_chunks_mut::<N>().0, &states) {
                let done = if full {
                    robot.inverse_dynamics(&s.q, &s.qd, &s.qdd, &[], tau)
                } else {
                    robot.gravity(&s.q, &[], tau)
                };
                done.expect("finite inputs of the right size");
            }
        }),
        outputs: N,
        order,
        timed: true,
        gravity: 9.80665 / 9.81,
    }))
}
