//! Derivatives of inverse and forward dynamics: against differences, and products against the
//! matrices, on trees with joints of every kind.

use crate::common::*;
use dynamics_core::algorithms::{
    aba, forward_dynamics_derivatives, rnea, rnea_along, rnea_derivatives, rnea_transposed, solve,
};
use dynamics_core::effects::{Armature, Effect, MovingBase, Payload, RIGID_BODY, Viscous};
use dynamics_core::model::BodyInertia;
use dynamics_core::spatial::Motion;
use dynamics_core::state::State;
use glam::DVec3;

type Matrix = [[f64; V]; V];

/// All that has derivatives: a payload, a base that moves, armatures and friction.
fn scene() -> impl Effect<f64, B, V> + Copy {
    let load = Payload::<f64, { B - 1 }>::from_inertia(BodyInertia {
        mass: 1.5,
        com: [0.1, -0.2, 0.05],
        inertia: [0.01, 0.0, 0.0, 0.02, 0.0, 0.015],
    });
    let ship = MovingBase {
        velocity: Motion::new(DVec3::new(0.3, -0.5, 0.7), DVec3::new(0.1, 0.2, -0.3)),
        acceleration: Motion::new(DVec3::new(-1.0, 2.0, 0.5), DVec3::new(0.4, 1.0, -2.0)),
    };
    (RIGID_BODY, Armature([0.3; V]), load, ship, Viscous([0.7; V]))
}

fn unit(k: usize) -> [f64; V] {
    core::array::from_fn(|j| f64::from(u8::from(j == k)))
}

fn column(rows: &Matrix, k: usize) -> [f64; V] {
    core::array::from_fn(|i| rows[i][k])
}

/// The state after changes of position and velocity along these.
fn after(
    tree: &Tree,
    state: &State<f64, Q, V>,
    [dq, dqd]: [[f64; V]; 2],
    t: f64,
) -> State<f64, Q, V> {
    let qd = core::array::from_fn(|j| state.qd[j] + t * dqd[j]);
    State { q: moved(tree, &state.q, &dq, t), qd, ..*state }
}

/// The largest error of the columns of ∂τ/∂q and of ∂τ/∂q̇.
fn of_trees() -> [Worst; 2] {
    let mut worst = <[Worst; 2]>::default();
    let scene = scene();
    for (tree, state) in trees(false) {
        let gradient = rnea_derivatives(&tree, &state, &scene);
        for k in 0..V {
            let slope = |changes| slope(|t| rnea(&tree, &after(&tree, &state, changes, t), &scene));
            worst[0].see(column(&gradient.dq, k), slope([unit(k), [0.0; V]]));
            worst[1].see(column(&gradient.dqd, k), slope([[0.0; V], unit(k)]));
        }
    }
    worst
}

#[test]
fn the_derivatives_of_inverse_dynamics_are_the_slopes_of_its_torques() {
    let mut verdict = Verdict::default();
    for (name, worst) in ["q", "qd"].iter().zip(of_trees()) {
        verdict.see("mixed tree", &format!("∂ID/∂{name} by differences"), "f64", &worst);
    }
    verdict.speak();
}

#[test]
fn the_derivatives_of_forward_dynamics_are_the_slopes_of_its_accelerations() {
    let mut worst = <[Worst; 3]>::default();
    let scene = scene();
    for (tree, state) in trees(false) {
        let tau = rnea(&tree, &state, &scene);
        let by = forward_dynamics_derivatives(&tree, &state, &tau, &scene).expect("M is positive");
        let at = |state: State<f64, Q, V>, tau: [f64; V]| {
            aba(&tree, &state, &tau, &scene).expect("M is positive")
        };
        for k in 0..V {
            let slope_of = |changes| slope(|t| at(after(&tree, &state, changes, t), tau));
            worst[0].see(column(&by.dq, k), slope_of([unit(k), [0.0; V]]));
            worst[1].see(column(&by.dqd, k), slope_of([[0.0; V], unit(k)]));
            let by_tau = slope(|t| at(state, core::array::from_fn(|j| tau[j] + t * unit(k)[j])));
            worst[2].see(solve(&tree, &by.factors, &unit(k)), by_tau);
        }
    }
    let mut verdict = Verdict::default();
    for (name, worst) in ["q", "qd", "tau"].iter().zip(worst) {
        verdict.see("mixed tree", &format!("∂FD/∂{name} by differences"), "f64", &worst);
    }
    verdict.speak();
}

#[test]
fn products_with_the_derivatives_are_those_of_the_matrices() {
    let mut worst = <[Worst; 2]>::default();
    let (scene, mut rng) = (scene(), Rng::new(31));
    for (tree, state) in trees(false) {
        let by = rnea_derivatives(&tree, &state, &scene);
        let [x, y] = [rng.vector::<V>(3.0), rng.vector::<V>(3.0)];
        let row = |a: &[f64; V], b: &[f64; V]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let want = core::array::from_fn::<_, V, _>(|i| row(&by.dq[i], &x) + row(&by.dqd[i], &y));
        worst[0].see(rnea_along(&tree, &state, &x, &y, &scene), want);
        let transposed = rnea_transposed(&tree, &state, &x, &scene);
        for (got, rows) in transposed.into_iter().zip([by.dq, by.dqd]) {
            worst[1].see::<V>(got, core::array::from_fn(|k| row(&column(&rows, k), &x)));
        }
    }
    let mut verdict = Verdict::default();
    for (name, worst) in ["∂ID x", "xᵀ ∂ID"].iter().zip(worst) {
        verdict.see("mixed tree", name, "f64", &worst);
    }
    verdict.speak();
}
