//! Laws that inverse dynamics, inertia and forward dynamics of links that bend obey.

use dynamics_core::algorithms;
use dynamics_core::effects::{Coriolis, Elasticity, Gravity, Inertia, RIGID_BODY, WorldWrench};
use dynamics_core::flexible::{
    FlexibleError, JointsAndModes, ModalFeedforward, Modes, crba, forward_dynamics, modal_dynamics,
    rnea,
};
use dynamics_core::model::{ArmModel, Robot};
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use flexible_tests::{JOINTS, MODES, Numbers, PLANAR, Planar, SPATIAL, Spatial};

const SCENE: ((Gravity, Inertia, Coriolis), Elasticity) = (RIGID_BODY, Elasticity);

fn difference<const V: usize, const M: usize>(
    a: &JointsAndModes<f64, V, M>,
    b: &JointsAndModes<f64, V, M>,
) -> f64 {
    let joints = a.joints.iter().zip(&b.joints);
    let pairs = joints.chain(a.modes.iter().zip(&b.modes));
    pairs.fold(0.0, |worst, (a, b)| f64::max(worst, (a - b).abs()))
}

fn laws<const M: usize>(model: &ArmModel<f64, 2>, modes: &Modes<f64, M>) {
    let mut numbers = Numbers::new(7);
    for _ in 0..100 {
        let (state, bent) = (numbers.state::<2>(JOINTS), numbers.state::<M>(MODES));
        // M's columns are what unit accelerations add.
        let m = crba(model, modes, &state.q, &bent.q, &SCENE);
        let still = |k: usize| {
            let unit = |from: usize, j: usize| f64::from(u8::from(k == from + j));
            let joints = State { qdd: core::array::from_fn(|j| unit(0, j)), ..State::at(state.q) };
            let bent = State { qdd: core::array::from_fn(|j| unit(2, j)), ..State::at(bent.q) };
            rnea(model, modes, &joints, &bent, &Inertia)
        };
        for k in 0..2 + M {
            let column = still(k);
            for j in 0..2 {
                let entry = if k < 2 { m.joints.get(j, k) } else { m.coupling[k - 2][j] };
                assert!((column.joints[j] - entry).abs() < 1e-14 * entry.abs().max(1.0), "{j} {k}");
            }
            for j in 0..M {
                let entry = if k < 2 { m.coupling[j][k] } else { m.modes.get(j, k - 2) };
                assert!(
                    (column.modes[j] - entry).abs() < 1e-14 * entry.abs().max(1.0),
                    "mode {j} {k}: {} {entry}",
                    column.modes[j]
                );
            }
        }

        // Forward dynamics inverts inverse dynamics, with a force of the scene on the modes.
        let free = rnea(model, modes, &state, &State { qdd: [0.0; M], ..bent }, &SCENE);
        let moving =
            modal_dynamics(model, modes, &state, &bent, &SCENE).expect("positive definite");
        let along = rnea(model, modes, &state, &State { qdd: moving, ..bent }, &SCENE);
        let scale = free.modes.iter().fold(0.0, |worst, f| f64::max(worst, f.abs()));
        assert!(along.modes.iter().all(|f| f.abs() < 1e-13 * scale), "{along:?}");
        let found = forward_dynamics(model, modes, &state, &bent, &along.joints, &SCENE);
        let found = found.expect("positive definite");
        let given = JointsAndModes { joints: state.qdd, modes: moving };
        let size = moving.iter().fold(20.0, |worst, a| f64::max(worst, a.abs()));
        assert!(difference(&found, &given) < 1e-11 * size, "{found:?} {given:?}");

        // Power: what joints and modes are given is the change of kinetic energy, without gravity.
        let plain = (Inertia, Coriolis);
        let at = |t: f64| {
            let moved = |q: f64, qd: f64, qdd: f64| (q + t * (qd + 0.5 * t * qdd), qd + t * qdd);
            let joints: [(f64, f64); 2] =
                core::array::from_fn(|j| moved(state.q[j], state.qd[j], state.qdd[j]));
            let of_modes: [(f64, f64); M] =
                core::array::from_fn(|j| moved(bent.q[j], bent.qd[j], bent.qdd[j]));
            let m = crba(model, modes, &joints.map(|x| x.0), &of_modes.map(|x| x.0), &plain);
            m.kinetic_energy(&joints.map(|x| x.1), &of_modes.map(|x| x.1))
        };
        let h = 1e-4;
        let rate = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
        let tau_plain = rnea(model, modes, &state, &bent, &plain);
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let power = dot(&tau_plain.joints, &state.qd) + dot(&tau_plain.modes, &bent.qd);
        assert!((power - rate).abs() < 1e-7 * (1.0 + power.abs()), "{power} {rate}");
    }
}

#[test]
fn inertia_power_and_forward_dynamics_agree_with_inverse_dynamics() {
    laws(&Planar::MODEL, &PLANAR);
    laws(&Spatial::MODEL, &SPATIAL);
}

#[test]
fn straight_flexible_links_feel_world_wrenches_like_rigid_ones() {
    let mut numbers = Numbers::new(3);
    for body in 0..2 {
        let wrench = WorldWrench {
            body,
            wrench: Force::new(glam::DVec3::new(1.0, -2.0, 0.5), glam::DVec3::new(5.0, 3.0, -4.0)),
        };
        for _ in 0..20 {
            let (state, straight) = (numbers.state::<2>(JOINTS), State::at([0.0; 6]));
            let bending = |with: bool| {
                let share = f64::from(u8::from(with));
                let scaled = WorldWrench { wrench: wrench.wrench * share, ..wrench };
                rnea(&Spatial::MODEL, &SPATIAL, &state, &straight, &(SCENE, scaled)).joints
            };
            let rigid = algorithms::rnea(&Spatial::MODEL, &state, &wrench);
            let (with, without) = (bending(true), bending(false));
            for j in 0..2 {
                assert!((with[j] - without[j] - rigid[j]).abs() < 1e-12, "{body} {j}");
            }
        }
    }
}

#[test]
fn a_link_too_soft_for_its_weight_is_named() {
    // Nearly upright: its weight bends a link more, the more it is bent.
    let at_rest = |gravity: f64| {
        let weight = <Gravity>::new(gravity);
        let scene = (weight, Inertia, Elasticity);
        ModalFeedforward::at_rest(&Planar::MODEL, &PLANAR, &[-1.5, 0.1], &scene)
    };
    assert!(at_rest(9.81).is_ok());
    assert!(matches!(at_rest(200.0), Err(FlexibleError::Mode(_))));
}
