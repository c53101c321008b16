//! Steps and differences on the configuration manifold, for every kind of joint.

use dynamics_core::algorithms::rnea;
use dynamics_core::effects::{Inertia, RIGID_BODY};
use dynamics_core::model::{BASE, Body, Joint, JointKind, Model};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::state::manifold::{difference, integrate, neutral, normalise};
use host_tests::random::{MIXED, MixedTree, mixed_tree, random_numbers, state_of, within};
use host_tests::{measured, tolerances};

const TREES: usize = 200;

fn check<R>(quantity: &str, error: f64) {
    tolerances::check("tree", quantity, std::any::type_name::<R>(), error)
        .unwrap_or_else(|e| panic!("{e}"));
}

/// The largest size of some errors.
fn largest(errors: impl IntoIterator<Item = f64>) -> f64 {
    measured::largest(errors.into_iter().map(f64::abs))
}

/// Whether the coordinates at `k` belong to a joint of this kind.
fn kind_at(tree: &MixedTree, k: usize) -> JointKind {
    let link = tree.links.iter().find(|link| {
        let (count, _) = link.joint.kind.coordinates();
        count > 0 && (link.idx_q..link.idx_q + count).contains(&k)
    });
    link.expect("every coordinate is some joint's").joint.kind
}

#[test]
fn the_difference_of_a_step_is_the_step() {
    fn worst<R: Real>() -> f64 {
        let (rng, mut worst) = (&mut random_numbers(), 0.0_f64);
        for _ in 0..TREES {
            let tree = mixed_tree(rng);
            let q = state_of(&tree, rng).q.map(R::from_f64);
            // Steps of up to ±1 in each coordinate: attitudes stay within half a turn.
            let step = within::<{ MIXED.2 }>(rng, 1.0).map(R::from_f64);
            let robot = cast::<R>(&tree);
            let back = difference(&robot, &q, &integrate(&robot, &q, &step));
            let errors = back.iter().zip(&step);
            let error = largest(errors.map(|(a, b)| a.to_f64() - b.to_f64()));
            worst = largest([worst, error]);
        }
        worst
    }
    check::<f64>("difference of a step", worst::<f64>());
    check::<f32>("difference of a step", worst::<f32>());
}

/// The model in the scalar R.
fn cast<R: Real>(tree: &MixedTree) -> Model<R, { MIXED.0 }, { MIXED.1 }, { MIXED.2 }> {
    R::cast(tree)
}

#[test]
fn a_step_along_the_difference_arrives() {
    let (rng, mut worst) = (&mut random_numbers(), 0.0_f64);
    for _ in 0..TREES {
        let tree = mixed_tree(rng);
        let (from, to) = (state_of(&tree, rng).q, state_of(&tree, rng).q);
        let mut there = integrate(&tree, &from, &difference(&tree, &from, &to));
        for link in &tree.links {
            match link.joint.kind {
                // A turn without end arrives at the same place, a quaternion at itself or its
                // negative.
                JointKind::Continuous | JointKind::Planar => {
                    let turn = (there[link.idx_q] - to[link.idx_q]) / core::f64::consts::TAU;
                    there[link.idx_q] -= turn.round() * core::f64::consts::TAU;
                }
                JointKind::Spherical | JointKind::Free => {
                    let (p, at) = (&mut there, link.idx_q);
                    if (0..4).map(|k| p[at + k] * to[at + k]).sum::<f64>() < 0.0 {
                        (0..4).for_each(|k| p[at + k] = -p[at + k]);
                    }
                }
                _ => {}
            }
        }
        let error = largest(there.iter().zip(to).map(|(a, b)| a - b));
        worst = largest([worst, error]);
    }
    check::<f64>("step along a difference", worst);
}

/// The velocity of the manifold is that of the dynamics: kinetic energy from ½ q̇ᵀ M q̇ does not
/// change while no force acts, when q moves by `integrate` and q̇ by the accelerations of free
/// motion.
#[test]
fn velocities_of_steps_are_those_of_the_dynamics() {
    let (rng, mut worst) = (&mut random_numbers(), 0.0_f64);
    for _ in 0..TREES / 4 {
        let tree = mixed_tree(rng);
        let state = state_of(&tree, rng);
        let energy = |q: &[f64; MIXED.1], qd: &[f64; MIXED.2]| {
            let at = State { q: *q, qd: [0.0; MIXED.2], qdd: *qd };
            0.5 * std::iter::zip(rnea(&tree, &at, &(Inertia,)), qd)
                .map(|(p, qd)| p * qd)
                .sum::<f64>()
        };
        // dE/dt = q̇ᵀ τ, at any q̈.
        let tau = rnea(&tree, &State { ..state }, &(Inertia, dynamics_core::effects::Coriolis));
        let power: f64 = std::iter::zip(tau, state.qd).map(|(tau, qd)| tau * qd).sum();
        let along = |t: f64| {
            let step = core::array::from_fn(|i| t * (state.qd[i] + 0.5 * t * state.qdd[i]));
            let qd = core::array::from_fn(|i| state.qd[i] + t * state.qdd[i]);
            energy(&integrate(&tree, &state.q, &step), &qd)
        };
        let h = 2e-4;
        let slope = (8.0 * (along(h) - along(-h)) - along(2.0 * h) + along(-2.0 * h)) / (12.0 * h);
        worst = largest([worst, (slope - power).abs() / along(0.0)]);
    }
    check::<f64>("power of a step", worst);
}

#[test]
fn drifted_quaternions_are_brought_back_and_zero_ones_named() {
    let tree = mixed_tree(&mut random_numbers());
    let mut q = neutral(&tree).map(|q| q * 1.7);
    normalise(&tree, &mut q).expect("no quaternion is zero");
    assert_eq!(q, neutral(&tree));
    let at = (0..MIXED.1).find(|&k| kind_at(&tree, k) == JointKind::Spherical);
    let at = at.expect("there are two");
    for bad in [0.0, f64::NAN, f64::INFINITY] {
        let mut q = neutral(&tree);
        q[at + 3] = bad;
        let error = normalise(&tree, &mut q).expect_err("this is no attitude");
        assert_eq!(error.at, at, "{error}");
    }
}

/// The algorithms take a quaternion of square 1 + ε as one of length 1 within 3ε²/8.
#[test]
fn a_drifting_quaternion_costs_what_is_stated() {
    let ball = Model::<f64, 1, 4, 3>::new(
        "ball",
        [Body::new("b", BASE, Joint::spherical())
            .mass(2.0)
            .com([0.1, 0.2, 0.3])
            .inertia([0.4, 0.01, 0.02, 0.5, 0.03, 0.6])],
    );
    let mut state = State::at([0.1, -0.7, 0.5, 0.5]);
    normalise(&ball, &mut state.q).expect("not zero");
    state.qd = [1.0, -2.0, 0.5];
    let exact = rnea(&ball, &state, &RIGID_BODY);
    for epsilon in [1e-2_f64, 1e-3, 1e-4] {
        let stretched = State { q: state.q.map(|q| q * (1.0 + epsilon).sqrt()), ..state };
        let tau = rnea(&ball, &stretched, &RIGID_BODY);
        let error = largest(tau.iter().zip(exact).map(|(a, b)| a - b));
        // An attitude that is longer by 3ε²/8 turns coordinates by twice that; gravity's moment is
        // 7.3 N·m.
        let bound = 2.0 * 0.375 * epsilon * epsilon * 8.0;
        measured::within(&format!("torque at {epsilon}, N·m"), error, bound);
    }
}
