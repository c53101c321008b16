//! ∂ID/∂q and ∂ID/∂q̇: against differences on trees with joints of every kind.

use crate::common::*;
use dynamics_core::algorithms::{rnea, rnea_derivatives};
use dynamics_core::effects::{Armature, MovingBase, Payload, RIGID_BODY, Viscous};
use dynamics_core::model::BodyInertia;
use dynamics_core::spatial::Motion;
use dynamics_core::state::State;
use glam::DVec3;

/// The largest error of the columns of ∂τ/∂q and of ∂τ/∂q̇.
fn of_trees() -> [Worst; 2] {
    let mut worst = <[Worst; 2]>::default();
    let load = Payload::<f64, { B - 1 }>::from_inertia(BodyInertia {
        mass: 1.5,
        com: [0.1, -0.2, 0.05],
        inertia: [0.01, 0.0, 0.0, 0.02, 0.0, 0.015],
    });
    let ship = MovingBase {
        velocity: Motion::new(DVec3::new(0.3, -0.5, 0.7), DVec3::new(0.1, 0.2, -0.3)),
        acceleration: Motion::new(DVec3::new(-1.0, 2.0, 0.5), DVec3::new(0.4, 1.0, -2.0)),
    };
    let scene = (RIGID_BODY, Armature([0.3; V]), load, ship, Viscous([0.7; V]));
    for (tree, state) in trees(false) {
        let gradient = rnea_derivatives(&tree, &state, &scene);
        for k in 0..V {
            let unit: [f64; V] = core::array::from_fn(|j| f64::from(u8::from(j == k)));
            let by_q = slope(|t| {
                let q = moved(&tree, &state.q, &unit, t);
                rnea(&tree, &State { q, ..state }, &scene)
            });
            let by_qd = slope(|t| {
                let qd = core::array::from_fn(|j| state.qd[j] + t * unit[j]);
                rnea(&tree, &State { qd, ..state }, &scene)
            });
            let column = |rows: &[[f64; V]; V]| core::array::from_fn(|i| rows[i][k]);
            worst[0].see(column(&gradient.dq), by_q);
            worst[1].see(column(&gradient.dqd), by_qd);
        }
    }
    worst
}

#[test]
fn the_derivatives_of_inverse_dynamics_are_the_slopes_of_its_torques() {
    let [by_q, by_qd] = of_trees();
    let mut verdict = Verdict::default();
    verdict.see("mixed tree", "∂ID/∂q by differences", "f64", &by_q);
    verdict.see("mixed tree", "∂ID/∂qd by differences", "f64", &by_qd);
    verdict.speak();
}
