//! p = M q̇ and Cᵀ q̇ of the engine are those of the core.

use dynamics_core::algorithms::MomentumAndCoriolis;
use dynamics_core::effects::{Armature, Effect, Gravity, Inertia, MovingBase};
use dynamics_core::model::Robot;
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::Motion;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use host_tests::stress_robot::StressRobot;
use proptest::prelude::RngExt;
use proptest::test_runner::{RngAlgorithm, TestRng};

use super::{ULPS, Ulps, payload};

/// The worst differences of both quantities over random states, in ulps of full scale; `spoil` changes the engine's.
fn compare<R: Real, T, E, const B: usize, const N: usize>(
    scene: &E,
    spoil: impl Fn(&mut MomentumAndCoriolis<R, N>),
) -> [f64; 2]
where
    T: Robot<B, N, N>,
    E: Effect<R, B, N>,
{
    let mut rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut random = |bound: f64| -> [R; N] {
        core::array::from_fn(|_| R::from_f64(rng.random_range(-bound..bound)))
    };
    let mut worst = <[Ulps; 2]>::default();
    for _ in 0..2_000 {
        let qd = random(3.0);
        let state = State {
            qd,
            ..State::at(random(std::f64::consts::PI))
        };
        let core = Core::<T>::momentum_and_coriolis(&state, scene);
        let mut engine = Engine::<T>::momentum_and_coriolis(&state, scene);
        spoil(&mut engine);
        worst[0].see(core.p, engine.p);
        worst[1].see(core.ct_qd, engine.ct_qd);
    }
    let [p, ct_qd] = worst;
    [p.of::<R>("M qd"), ct_qd.of::<R>("C^T qd")]
}

fn agree<R: Real, T, E, const B: usize, const N: usize>(scene: &E)
where
    T: Robot<B, N, N>,
    E: Effect<R, B, N>,
{
    let ulps = compare::<R, T, E, B, N>(scene, |_| ());
    assert!(ulps.iter().all(|&ulps| ulps <= ULPS), "{ulps:?} ulp");
}

/// An odd tree with prismatic joints, branches and welds, with rotors and a load, on a base that moves.
fn odd_tree<R: Real>() {
    let vec3 = |[x, y, z]: [f64; 3]| R::Vec3::new(R::from_f64(x), R::from_f64(y), R::from_f64(z));
    let ship = MovingBase {
        velocity: Motion::new(vec3([0.3, -0.5, 0.7]), vec3([0.1, 0.2, -0.3])),
        acceleration: Motion::new(vec3([-1.0, 2.0, 0.5]), vec3([0.4, 1.0, -2.0])),
    };
    let rotors = Armature([0.2, 0.1, 0.3, 0.05, 0.15, 0.4, 0.25].map(R::from_f64));
    let load = payload::<R, 10>();
    agree::<R, StressRobot, _, 11, 7>(&(Gravity::EARTH, Inertia, rotors, load));
    agree::<R, StressRobot, _, 11, 7>(&(ship, rotors, load));
}

#[test]
fn momenta_and_coriolis_products_of_engine_and_core_are_equal() {
    agree::<f32, Ur5e, _, 6, 6>(&());
    odd_tree::<f32>();
}

#[cfg(feature = "full")]
#[test]
fn momenta_and_coriolis_products_of_engine_and_core_are_equal_in_f64() {
    agree::<f64, Ur5e, _, 6, 6>(&());
    agree::<f64, dynamics_core::robots::Panda, _, 7, 7>(&());
    odd_tree::<f64>();
}

#[test]
fn a_product_that_is_off_by_ten_ulps_is_found() {
    let [_, whole] = compare::<f32, Ur5e, _, 6, 6>(&(), |_| ());
    let [p, ct_qd] = compare::<f32, Ur5e, _, 6, 6>(&(), |found| found.ct_qd[1] *= 1.000_01);
    assert!(p <= ULPS && whole <= ULPS && ct_qd > ULPS, "{p} {ct_qd}");
}
