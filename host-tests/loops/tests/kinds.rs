//! Every kind of loop joint: K, k and φ against differences along a motion of a tree that mixes
//! kinds.

use dynamics_core::algorithms::{poses, rnea};
use dynamics_core::effects::BodyWrench;
use dynamics_core::loops::{BodyFrame, LoopJoint, Loops, Moving, assemble, constraints};
use dynamics_core::model::{BASE, Body, Joint, Model};
use dynamics_core::state::State;
use dynamics_core::state::manifold::integrate;
use host_tests::measured::{largest, within as bounded};
use host_tests::random::{random_body, random_numbers, state_of, within};
use loop_tests::wrenches::wrenches;

/// Bodies, position and velocity coordinates: two branches on a trunk.
const B: usize = 8;
const Q: usize = 15;
const V: usize = 14;
/// Random trees for each kind.
const TREES: usize = 20;

/// From how many random guesses assembly may fail, and not find one in this many.
const MOST_TRIES: usize = 8;

const U: [f64; 3] = [0.3, 0.5, 0.8];

fn tree(mut body: impl FnMut(&'static str, usize, Joint<f64>) -> Body) -> Model<f64, B, Q, V> {
    let bodies = [
        body("trunk", BASE, Joint::prismatic(U)),
        body("hip", 0, Joint::universal([1.0, 0.0, 0.0], [0.0, 0.6, 0.8])),
        body("knee", 1, Joint::spherical()),
        body("foot", 2, Joint::revolute(U)),
        body("slab", 0, Joint::planar()),
        body("screw", 4, Joint::helical(U, 0.05)),
        body("sleeve", 5, Joint::cylindrical(U)),
        body("wheel", 6, Joint::continuous(U)),
    ];
    Model::new("mixed", bodies)
}

/// Errors of K q̇ against the change of φ where the loop is closed, and of K q̈ − k against that of
/// K q̇ anywhere, both relative to full scale; and of Kᵀ λ against the torques of the loop joint's
/// force, and K q̇ against the relative velocity, absolutely.
fn errors<const C: usize>(joint: Joint<f64>) -> [f64; 3] {
    let (mut rng, h) = (random_numbers(), 1e-4);
    let (mut differences, mut sizes) = ([vec![], vec![]], [vec![], vec![]]);
    let mut rounding = vec![];
    for _ in 0..TREES {
        let model =
            tree(|name, parent, joint| random_body(&mut rng, Body::new(name, parent, joint)));
        let [p, s] = [(3, "p"), (7, "s")].map(|(body, _)| {
            BodyFrame::new(body).xyz(within(&mut rng, 0.3)).rpy(within(&mut rng, 3.0))
        });
        let joints = [LoopJoint::new("loop", joint, [p, s])];
        let loops = Loops::<1, C, V>::new(&model, joints, core::array::from_fn(|i| i));
        let open = state_of(&model, &mut rng);
        // From some guesses it ends where the error is least, but not zero: it starts again from
        // others.
        let mut tries = 0;
        let closed = loop {
            let guess = state_of(&model, &mut rng);
            tries += 1;
            if let Ok(closed) = assemble(&model, &loops, &guess.q, Moving::All) {
                break State { q: closed.q, ..open };
            }
            assert!(tries < MOST_TRIES, "{joint:?} does not close");
        };
        for (k, state) in [closed, open].iter().enumerate() {
            let after = |h: f64| {
                let step = core::array::from_fn(|i| h * state.qd[i] + 0.5 * h * h * state.qdd[i]);
                let there = State {
                    q: integrate(&model, &state.q, &step),
                    qd: core::array::from_fn(|i| state.qd[i] + h * state.qdd[i]),
                    qdd: [0.0; V],
                };
                constraints(&model, &loops, &there)
            };
            let (now, [later, before]) = (after(0.0), [h, -h].map(after));
            for row in 0..C {
                let (want, got) = match k {
                    0 => (now.velocity[row], later.position[row] - before.position[row]),
                    _ => {
                        let products = now.jacobian[row].iter().zip(state.qdd).map(|(k, a)| k * a);
                        (
                            products.sum::<f64>() - now.bias[row],
                            later.velocity[row] - before.velocity[row],
                        )
                    }
                };
                differences[k].push((got / (2.0 * h) - want).abs());
                sizes[k].push(want.abs());
            }
            for (row, rate) in now.jacobian.iter().zip(now.velocity) {
                let products = row.iter().zip(state.qd).map(|(k, v)| k * v);
                rounding.push((products.sum::<f64>() - rate).abs());
            }
            let lambda = within::<C>(&mut rng, 1.0);
            let (mut torque, poses) = ([0.0; V], poses(&model, &state.q));
            let force = now.force(&loops, 0, &lambda);
            for (body, wrench) in wrenches(&joints[0], force, &poses) {
                let of_wrench = rnea(&model, state, &BodyWrench { body, wrench });
                for (sum, tau) in torque.iter_mut().zip(of_wrench) {
                    *sum += tau;
                }
            }
            for (i, torque) in torque.into_iter().enumerate() {
                let column = now.jacobian.iter().zip(lambda).map(|(row, l)| row[i] * l);
                let sum = column.sum::<f64>() + torque;
                rounding.push(sum.abs());
            }
        }
    }
    let [position, velocity] =
        [0, 1].map(|k| largest(differences[k].clone()) / largest(sizes[k].clone()));
    [position, velocity, largest(rounding)]
}

// This holds for every kind of joint.
#[test]
fn loop_constraints_are_derivatives_of_their_position_errors() {
    let all = [
        errors::<5>(Joint::revolute(U)),
        errors::<5>(Joint::continuous(U)),
        errors::<5>(Joint::prismatic(U)),
        errors::<5>(Joint::helical(U, 0.07)),
        errors::<4>(Joint::cylindrical(U)),
        errors::<4>(Joint::universal([0.0, 1.0, 0.0], [0.6, 0.0, 0.8])),
        errors::<3>(Joint::spherical()),
        errors::<3>(Joint::planar()),
        errors::<6>(Joint::fixed()),
    ];
    for [position, velocity, rounding] in all {
        bounded("K q̇ by differences", position, 5e-7);
        bounded("K q̈ − k by differences", velocity, 5e-7);
        bounded("K q̇ and Kᵀ λ", rounding, 2e-14);
    }
}
