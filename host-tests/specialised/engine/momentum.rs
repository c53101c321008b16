//! p = M q̇, Cᵀ q̇ and β = Cᵀ q̇ − g − F of the engine are those of the core.

use dynamics_core::effects::{
    Armature, Coulomb, Effect, Gravity, LoadFriction, MovingBase, Viscous, Width,
};
use dynamics_core::model::Robot;
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::Motion;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use host_tests::stress_robot::StressRobot;
use proptest::prelude::RngExt;
use proptest::test_runner::{RngAlgorithm, TestRng};

use super::{Aslant, Drag, Push, ULPS, Ulps, payload};

/// The quantities at random states, within ulps of full scale.
fn agree<R: Real, T, E, const B: usize, const N: usize>(scene: &E)
where
    T: Robot<B, N, N>,
    E: Effect<R, B, N>,
{
    let mut rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut random = |bound: f64| -> [R; N] {
        core::array::from_fn(|_| R::from_f64(rng.random_range(-bound..bound)))
    };
    let mut worst = <[Ulps; 3]>::default();
    for _ in 0..500 {
        let qd = random(3.0);
        let state = State { qd, ..State::at(random(std::f64::consts::PI)) };
        let core = Core::<T>::momentum_and_coriolis(&state, scene);
        let engine = Engine::<T>::momentum_and_coriolis(&state, scene);
        worst[0].see(core.p, engine.p);
        worst[1].see(core.ct_qd, engine.ct_qd);
        let core = Core::<T>::momentum_and_drift(&state, scene);
        let drift = Engine::<T>::momentum_and_drift(&state, scene);
        assert_eq!(drift.p, engine.p);
        worst[2].see(core.beta, drift.beta);
    }
    let [p, ct_qd, beta] = worst;
    let ulps = [p.of::<R>("M qd"), ct_qd.of::<R>("C^T qd"), beta.of::<R>("drift")];
    assert!(ulps.iter().all(|&ulps| ulps <= ULPS), "{ulps:?} ulp");
}

/// An odd tree with prismatic joints, branches and welds, with rotors and a load, pushed and with
/// friction, on a base that moves.
fn odd_tree<R: Real>() {
    let vec3 = |[x, y, z]: [f64; 3]| R::Vec3::new(R::from_f64(x), R::from_f64(y), R::from_f64(z));
    let ship = MovingBase {
        velocity: Motion::new(vec3([0.3, -0.5, 0.7]), vec3([0.1, 0.2, -0.3])),
        acceleration: Motion::new(vec3([-1.0, 2.0, 0.5]), vec3([0.4, 1.0, -2.0])),
    };
    let rotors = Armature([0.2, 0.1, 0.3, 0.05, 0.15, 0.4, 0.25].map(R::from_f64));
    let load = payload::<R, 10>();
    #[cfg(feature = "full")]
    {
        agree::<R, StressRobot, _, 11, 7>(&(
            Gravity::EARTH,
            dynamics_core::effects::Inertia,
            rotors,
            load,
        ));
        agree::<R, StressRobot, _, 11, 7>(&(ship, rotors, load));
    }
    let width = Width::new(R::from_f64(0.5));
    let friction = (
        Viscous([0.7, 0.3, 0.9, 0.2, 0.4, 0.1, 0.6].map(R::from_f64)),
        Coulomb { torque: [0.5, 0.2, 0.8, 0.1, 0.3, 0.4, 0.7].map(R::from_f64), width },
        LoadFriction { driving: [R::from_f64(0.2); 7], backdriving: [R::from_f64(0.1); 7], width },
    );
    let aslant = Gravity::<Aslant>::new(9.81);
    agree::<R, StressRobot, _, 11, 7>(&(aslant, rotors, load, friction, Push, Drag));
    agree::<R, StressRobot, _, 11, 7>(&(aslant, ship, load, friction, Push, Drag));
}

#[test]
fn momenta_and_coriolis_products_of_engine_and_core_are_equal() {
    agree::<f32, Ur5e, _, 6, 6>(&());
    odd_tree::<f32>();
}

// Those of the engine are compared with those of the core.
#[cfg(feature = "full")]
#[test]
fn momenta_and_coriolis_products_are_equal_in_f64() {
    agree::<f64, Ur5e, _, 6, 6>(&());
    agree::<f64, dynamics_core::robots::Panda, _, 7, 7>(&());
    odd_tree::<f64>();
}
