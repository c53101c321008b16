//! Torques, angles and rates of the motors of elastic joints: those of the engine are those of the
//! core.

use dynamics_core::drivetrain::{ElasticJoints, ElasticReference};
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Effect, Gravity, Inertia, RIGID_BODY, Viscous, Width,
};
use dynamics_core::model::{Calibrated, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use host_tests::stress_robot::StressRobot;
use proptest::prelude::RngExt;
use proptest::test_runner::{RngAlgorithm, TestRng};

use super::{Aslant, ULPS, Ulps, payload};

/// Torques, angles and rates along random courses, within ulps of full scale.
fn agree<R: Real, T, E, F, const B: usize, const N: usize>(scene: &E, of_engine: &F)
where
    T: Robot<B, N, N>,
    E: Effect<R, B, N>,
    F: Effect<R, B, N>,
{
    let mut rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut random = |bound: f64| -> [R; N] {
        core::array::from_fn(|_| R::from_f64(rng.random_range(-bound..bound)))
    };
    // Springs so soft that what they add to angles and rates is of their size.
    let joints = ElasticJoints {
        stiffness: [R::from_f64(100.0); N],
        rotor: [R::from_f64(0.5); N],
        friction: [R::from_f64(2.0); N],
    };
    let mut worst = <[Ulps; 3]>::default();
    for _ in 0..500 {
        let reference = ElasticReference {
            state: State { q: random(std::f64::consts::PI), qd: random(3.0), qdd: random(10.0) },
            jerk: random(50.0),
            snap: random(300.0),
        };
        let core = Core::<T>::elastic_inverse_dynamics(&joints, &reference, scene);
        let engine = Engine::<T>::elastic_inverse_dynamics(&joints, &reference, of_engine);
        worst[0].see(core.torque, engine.torque);
        worst[1].see(core.position, engine.position);
        worst[2].see(core.velocity, engine.velocity);
    }
    let [torque, angle, rate] = worst;
    let ulps =
        [torque.of::<R>("motor torque"), angle.of::<R>("motor angle"), rate.of::<R>("motor rate")];
    assert!(ulps.iter().all(|&ulps| ulps <= ULPS), "{ulps:?} ulp");
}

/// An odd tree with prismatic joints, branches and welds, with rotors, friction and a load.
fn odd_tree<R: Real>() {
    let scene = (
        Gravity::<Aslant>::new(9.81),
        (Inertia, Coriolis),
        Viscous([0.7, 0.3, 0.9, 0.2, 0.4, 0.1, 0.6].map(R::from_f64)),
        Coulomb {
            torque: [0.5, 0.2, 0.8, 0.1, 0.3, 0.4, 0.7].map(R::from_f64),
            width: Width::new(R::from_f64(0.5)),
        },
        Armature([0.2, 0.1, 0.3, 0.05, 0.15, 0.4, 0.25].map(R::from_f64)),
        payload::<R, 10>(),
    );
    agree::<R, StressRobot, _, _, 11, 7>(&scene, &scene);
}

#[test]
fn motors_of_elastic_joints_are_those_of_the_core() {
    agree::<f32, Ur5e, _, _, 6, 6>(&RIGID_BODY, &RIGID_BODY);
    odd_tree::<f32>();
    odd_tree::<f64>();
}

#[cfg(feature = "full")]
#[test]
fn a_humanoid_may_have_elastic_joints() {
    agree::<f64, dynamics_core::robots::G1, _, _, 29, 29>(&RIGID_BODY, &RIGID_BODY);
}

#[test]
fn loaded_base_parameters_move_elastic_joints_as_the_description_does() {
    let load = payload::<f64, 5>();
    let arm = Calibrated::<Ur5e, f64, 6, 6, 6>::nominal();
    let loaded = Engine::<Ur5e>::base_parameters(&arm, &load).expect("finite");
    agree::<f64, Ur5e, _, _, 6, 6>(&(RIGID_BODY, load), &(RIGID_BODY, &loaded));
}
