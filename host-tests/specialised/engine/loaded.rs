//! The engine with loaded base parameters computes what the textbook does of the calibrated robot.

use dynamics_core::Engine;
use dynamics_core::algorithms::{aba, crba, momentum_and_coriolis, rnea};
use dynamics_core::effects::{
    Armature, BaseParameters, Effect, Gravity, MovingBase, Payload, RIGID_BODY,
};
use dynamics_core::model::{Calibrated, Problem, Robot};
use dynamics_core::robots::Panda;
use dynamics_core::spatial::{Motion, SpatialInertia};
use dynamics_core::state::State;
use glam::DVec3;
use host_tests::measured::largest;
use host_tests::stress_robot::StressRobot;
use proptest::prelude::RngExt;
use proptest::test_runner::{RngAlgorithm, TestRng};

use super::payload;

/// A robot whose inertias differ from those of the description, each in its own direction.
fn calibrated<T: Robot<B, N, N>, const B: usize, const N: usize>() -> Calibrated<T, f64, B, N, N> {
    let mut arm = Calibrated::<T, f64, B, N, N>::nominal();
    for (i, inertia) in arm.inertias().enumerate() {
        let k = 1.0 + 0.1 * i as f64;
        let more = [0.2, 0.03 * k, -0.02, 0.01 * k, 0.05, 0.004, 0.06 * k, -0.003, 0.002, 0.07];
        *inertia = *inertia + SpatialInertia::from_parameters(more);
    }
    arm
}

/// The largest difference from the textbook in units of the largest value, of τ with and without
/// motion, M, q̈, M q̇ and Cᵀ q̇.
fn apart<T, E, const B: usize, const N: usize>(
    scene: E,
    load: impl Fn(&Calibrated<T, f64, B, N, N>) -> BaseParameters<T, f64, B, N, N>,
) -> f64
where
    T: Robot<B, N, N>,
    E: Effect<f64, B, N> + Copy,
{
    let arm = calibrated::<T, B, N>();
    let set = load(&arm);
    let (loaded, scene) = ((&set, scene), &scene);
    let mut rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut random =
        |bound: f64| -> [f64; N] { core::array::from_fn(|_| rng.random_range(-bound..bound)) };
    let (mut worst, mut sizes) = ([0.0_f64; 6], [0.0_f64; 6]);
    for _ in 0..200 {
        let state = State { q: random(3.0), qd: random(3.0), qdd: random(10.0) };
        let still = State::at(state.q);
        let h = (
            momentum_and_coriolis(&arm, &state, scene),
            Engine::<T>::momentum_and_coriolis(&state, &loaded),
        );
        let m = [crba(&arm, &state.q, scene), Engine::<T>::crba(&state.q, &loaded)];
        let m = m.map(|m| (0..N * N).map(|k| m.get(k / N, k % N)).collect::<Vec<f64>>());
        let tau = (rnea(&arm, &state, scene), Engine::<T>::rnea(&state, &loaded));
        let qdd = (
            aba(&arm, &state, &tau.0, scene).expect("M is positive definite"),
            Engine::<T>::aba(&state, &tau.0, &loaded).expect("M is positive definite"),
        );
        let pairs = [
            (tau.0.to_vec(), tau.1.to_vec()),
            (rnea(&arm, &still, scene).to_vec(), Engine::<T>::rnea(&still, &loaded).to_vec()),
            (m[0].clone(), m[1].clone()),
            (qdd.0.to_vec(), qdd.1.to_vec()),
            (h.0.p.to_vec(), h.1.p.to_vec()),
            (h.0.ct_qd.to_vec(), h.1.ct_qd.to_vec()),
        ];
        for ((worst, size), (a, b)) in worst.iter_mut().zip(&mut sizes).zip(pairs) {
            *size = largest(a.iter().map(|a| a.abs()).chain([*size]));
            *worst = largest(a.iter().zip(b).map(|(a, b)| (a - b).abs()).chain([*worst]));
        }
    }
    worst.iter().zip(sizes).fold(0.0, |most, (worst, size)| {
        assert!(size > 0.0 && worst.is_finite());
        most.max(worst / size)
    })
}

fn loaded<T: Robot<B, N, N>, const B: usize, const N: usize>(
    arm: &Calibrated<T, f64, B, N, N>,
) -> BaseParameters<T, f64, B, N, N> {
    Engine::<T>::base_parameters(arm, &()).expect("finite inertias in the described places")
}

fn ship() -> MovingBase<f64> {
    MovingBase {
        velocity: Motion::new(DVec3::new(0.3, -0.5, 0.7), DVec3::new(0.1, 0.2, -0.3)),
        acceleration: Motion::new(DVec3::new(-1.0, 2.0, 0.5), DVec3::new(0.4, 1.0, -2.0)),
    }
}

const ROTORS: Armature<f64, 7> = Armature([0.2, 0.1, 0.3, 0.05, 0.15, 0.4, 0.25]);
const BOUND: f64 = 1e-13;

#[test]
fn an_engine_with_loaded_base_parameters_computes_the_calibrated_robot() {
    let odd = apart::<StressRobot, _, 11, 7>((RIGID_BODY, ROTORS, payload::<f64, 10>()), loaded);
    let afloat = apart::<StressRobot, _, 11, 7>((RIGID_BODY, ROTORS, ship()), loaded);
    println!("{odd:.1e} {afloat:.1e}");
    assert!(odd < BOUND && afloat < BOUND);
    #[cfg(feature = "full")]
    assert!(apart::<Panda, _, 7, 7>(RIGID_BODY, loaded) < BOUND);
}

#[test]
fn calibration_changes_the_base_parameters() {
    let nominal = |_: &_| loaded(&Calibrated::<StressRobot, f64, 11, 7, 7>::nominal());
    assert!(apart::<StressRobot, _, 11, 7>((RIGID_BODY, ROTORS, ship()), nominal) > 0.01);
}

#[test]
fn a_payload_in_the_set_is_one_in_the_scene() {
    let arm = calibrated::<StressRobot, 11, 7>();
    let load: Payload<f64, 10> = payload();
    let set = Engine::<StressRobot>::base_parameters(&arm, &load).expect("finite inertias");
    let state = State { q: [0.3; 7], qd: [0.5; 7], qdd: [1.0; 7] };
    let a = Engine::<StressRobot>::rnea(&state, &(RIGID_BODY, &set));
    let b = Engine::<StressRobot>::rnea(&state, &(RIGID_BODY, loaded(&arm), load));
    let empty = Engine::<StressRobot>::rnea(&state, &(RIGID_BODY, loaded(&arm)));
    let apart = |a: [f64; 7], b: [f64; 7]| largest(a.iter().zip(b).map(|(a, b)| (a - b).abs()));
    let (same, less) = (apart(a, b), apart(a, empty));
    let full_scale = largest(a.map(f64::abs));
    assert!(same < BOUND * full_scale && less > 0.01 * full_scale, "{same} {less}");
}

#[test]
fn a_changed_placement_or_nonfinite_inertia_is_named() {
    let mut arm = calibrated::<Panda, 7, 7>();
    let set = |arm: &_| Engine::<Panda>::base_parameters(arm, &());
    assert!(set(&arm).is_ok());
    if let Some(placement) = arm.placements().nth(3) {
        placement.pos.x += 1e-4;
    }
    let error = set(&arm).expect_err("another length");
    let name = Panda::MODEL.links[3].name;
    assert_eq!((error.body, error.problem), (name, Problem::Placement));

    let mut arm = calibrated::<Panda, 7, 7>();
    if let Some(inertia) = arm.inertias().nth(2) {
        inertia.first_moment.x = f64::NAN;
    }
    let error = set(&arm).expect_err("a first moment that is no number");
    let name = Panda::MODEL.links[2].name;
    assert_eq!((error.body, error.problem), (name, Problem::NotFinite));
}

/// A rope of light rods with loaded inertias a million times as large is no more singular than with
/// those described.
#[test]
fn pivots_are_compared_with_the_loaded_inertias() {
    let mut arm = Calibrated::<Panda, f32, 7, 7, 7>::nominal();
    let scale = 1e6_f32;
    for inertia in arm.inertias() {
        *inertia = SpatialInertia::from_parameters(inertia.parameters().map(|x| x * scale));
    }
    let set = Engine::<Panda>::base_parameters(&arm, &()).expect("finite inertias");
    let state = State::at([0.3_f32; 7]);
    let tau = Engine::<Panda>::rnea(&state, &(Gravity::EARTH, &set));
    let qdd = Engine::<Panda>::aba(&state, &tau, &(RIGID_BODY, &set)).expect("regular");
    assert!(qdd.iter().all(|qdd| qdd.abs() < 1e-3), "{qdd:?}");
}
