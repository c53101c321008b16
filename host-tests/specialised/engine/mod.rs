//! Core and engine are each other's oracle: the same robot, state and scene, the same torques.

use dynamics_core::algorithms::rnea;
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Direction, Effect, Gravity, Inertia, Payload, RIGID_BODY, Viscous,
    Width, hook,
};
use dynamics_core::model::{BodyInertia, Robot};
use dynamics_core::robots::{Panda, Ur5e};
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use host_tests::measured::largest;
use host_tests::stress_robot::StressRobot;
use proptest::prelude::RngExt;
use proptest::test_runner::{RngAlgorithm, TestRng};

mod bodies;
mod elastic;
mod free_base;
mod joints;
mod large;
mod loaded;
mod matrix;
mod momentum;
mod recorded;
mod tasks;
/// Pushes the plinth, the rail, the bracket (a weld in mid-tree), the tool (a weld at a tip) and
/// the jib, each in its own frame.
struct Push;

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Push {
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::constant(|_, body, fx| {
        if matches!(body, 0 | 1 | 3 | 6 | 8) {
            let k = R::from_f64(2.0 + body as f64);
            *fx += Force::new(R::Vec3::new(k, -k, R::ONE), R::Vec3::new(R::ONE, k, k + R::ONE));
        }
    });
}

/// A drag on every body, against its own velocity.
struct Drag;

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Drag {
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::of_velocity(|_, body, at, fx| {
        let k = R::from_f64(0.3 + 0.1 * body as f64);
        *fx -= Force::new(at.velocity.ang * k, at.velocity.lin * k);
    });
}

/// Down a slope that no axis of the base frame lies on.
#[derive(Clone, Copy, Debug)]
struct Aslant;

impl Direction for Aslant {
    const UNIT: [f64; 3] = [0.48, 0.6, -0.64];
}

/// Ulps of full scale that the two may differ by.
const ULPS: f64 = 4.0;

/// Random states in which engine and core are compared.
const STATES: usize = 2_000;

/// The worst difference over these states and that of all zeros, in ulps of full scale.
fn compare<R, T, E, const B: usize, const N: usize>(scene: &E) -> f64
where
    R: Real,
    T: Robot<B, N, N>,
    E: Effect<R, B, N>,
{
    let mut rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut random = |bound: f64| -> [R; N] {
        core::array::from_fn(|_| R::from_f64(rng.random_range(-bound..bound)))
    };
    let mut worst = Ulps::default();
    for i in 0..=STATES {
        let mut state = State::at([R::ZERO; N]);
        if i > 0 {
            state = State { q: random(std::f64::consts::PI), qd: random(3.0), qdd: random(10.0) };
        }
        let core = Core::<T>::rnea(&state, scene);
        let engine = Engine::<T>::rnea(&state, scene);
        worst.see(core, engine);
    }
    worst.of::<R>(T::MODEL.name)
}

/// The largest difference of two results, and the largest component of the first.
#[derive(Default)]
struct Ulps {
    worst: f64,
    full_scale: f64,
}

impl Ulps {
    fn see<R: Real, const N: usize>(&mut self, core: [R; N], engine: [R; N]) {
        for (core, engine) in core.iter().zip(engine) {
            let (core, engine) = (core.to_f64(), engine.to_f64());
            assert!(core.is_finite() && engine.is_finite());
            self.worst = largest([self.worst, (core - engine).abs()]);
            self.full_scale = self.full_scale.max(core.abs());
        }
    }

    fn of<R: Real>(&self, what: &str) -> f64 {
        let ulp = if R::from_f64(1.0 + f64::EPSILON) == R::ONE {
            f64::from(f32::EPSILON)
        } else {
            f64::EPSILON
        };
        let (scalar, full_scale) = (std::any::type_name::<R>(), self.full_scale);
        let ulps = self.worst / (ulp * full_scale);
        println!("{what} {scalar}: {ulps:.2} ulp of {full_scale:.1}");
        ulps
    }
}

fn robot<R: Real, T, const B: usize, const N: usize>()
where
    T: Robot<B, N, N>,
{
    let ulps = compare::<R, T, _, B, N>(&RIGID_BODY);
    assert!(ulps <= ULPS, "{}: {ulps:.2} ulp", T::MODEL.name);
}

#[test]
fn engine_equals_core_on_ur5e() {
    robot::<f32, Ur5e, 6, 6>();
}

#[cfg(feature = "full")]
#[test]
fn engine_equals_core_on_other_robots_and_in_f64() {
    use dynamics_core::robots::{A1, Iiwa14};
    robot::<f64, Ur5e, 6, 6>();
    robot::<f32, Panda, 7, 7>();
    robot::<f64, Panda, 7, 7>();
    robot::<f32, Iiwa14, 7, 7>();
    robot::<f64, Iiwa14, 7, 7>();
    robot::<f32, A1, 16, 12>();
    robot::<f64, A1, 16, 12>();
}

/// The odd tree under every effect.
fn odd_tree<R: Real>() {
    let scene = (
        Gravity::EARTH,
        Inertia,
        Coriolis,
        Viscous([0.7, 0.3, 0.9, 0.2, 0.4, 0.1, 0.6].map(R::from_f64)),
        Coulomb {
            torque: [0.5, 0.2, 0.8, 0.1, 0.3, 0.4, 0.7].map(R::from_f64),
            width: Width::new(R::from_f64(0.5)),
        },
        Armature([0.2, 0.1, 0.3, 0.05, 0.15, 0.4, 0.25].map(R::from_f64)),
        Push,
        Drag,
        payload::<R, 10>(),
    );
    let ulps = compare::<R, StressRobot, _, 11, 7>(&scene);
    assert!(ulps <= ULPS, "{ulps:.2} ulp");
}

#[test]
fn engine_equals_core_on_an_odd_tree_under_every_effect() {
    odd_tree::<f32>();
}

// Every effect acts.
#[cfg(feature = "full")]
#[test]
fn engine_equals_core_on_an_odd_tree_in_f64() {
    odd_tree::<f64>();
    let ulps =
        compare::<f64, StressRobot, _, 11, 7>(&(Gravity::<Aslant>::new(9.81), Inertia, Drag));
    assert!(ulps <= ULPS, "{ulps:.2} ulp");
}

/// 2.5 kg off the axis, with dense inertia.
fn payload<R: Real, const BODY: usize>() -> Payload<R, BODY> {
    let inertia = [0.03, -0.004, 0.002, 0.05, 0.006, 0.04].map(R::from_f64);
    Payload::from_inertia(BodyInertia {
        mass: R::from_f64(2.5),
        com: [0.1, -0.2, 0.3].map(R::from_f64),
        inertia,
    })
}

#[test]
fn a_payload_is_inertia_of_its_body() {
    let mut rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut loaded = Panda::MODEL;
    loaded.links[6].inertia = loaded.links[6].inertia + payload::<f64, 6>().0;
    let scene = (Gravity::EARTH, Inertia, Coriolis, payload::<f64, 6>());
    for _ in 0..100 {
        let mut random = |bound: f64| [0.0; 7].map(|_: f64| rng.random_range(-bound..bound));
        let state = State { q: random(3.0), qd: random(3.0), qdd: random(10.0) };
        let want = rnea(&loaded, &state, &RIGID_BODY);
        let core = Core::<Panda>::rnea(&state, &scene);
        let engine = Engine::<Panda>::rnea(&state, &scene);
        for i in 0..7 {
            assert!((core[i] - want[i]).abs() < 2e-13, "core, joint {i}");
            assert!((engine[i] - want[i]).abs() < 2e-13, "engine, joint {i}");
        }
        let qdd = Core::<Panda>::aba(&state, &want, &scene).expect("M is positive");
        for (got, want) in qdd.iter().zip(state.qdd) {
            assert!((got - want).abs() < 1e-11);
        }
    }
}

#[test]
fn an_effect_of_velocities_adds_no_coriolis_torque() {
    let scene = (Gravity::<Aslant>::new(9.81), Inertia, Drag);
    let ulps = compare::<f32, StressRobot, _, 11, 7>(&scene);
    assert!(ulps <= ULPS, "{ulps:.2} ulp");
    // The core itself: what drag adds does not depend on what else is there.
    let state = State { q: [0.3; 7], qd: [1.0, -2.0, 3.0, 1.5, -1.0, 2.0, 0.5], qdd: [0.0; 7] };
    let drag = Core::<StressRobot>::rnea(&state, &(Drag,));
    let with = Core::<StressRobot>::rnea(&state, &(Coriolis, Drag));
    let without = Core::<StressRobot>::rnea(&state, &(Coriolis,));
    for ((drag, with), without) in drag.iter().zip(with).zip(without) {
        assert!((with - without - drag).abs() < 1e-12, "{with} {without} {drag}");
    }
}

#[test]
fn engine_equals_core_where_nothing_moves() {
    let ulps = compare::<f32, StressRobot, _, 11, 7>(&(Gravity::<Aslant>::new(9.81), Push));
    assert!(ulps <= ULPS, "{ulps:.2} ulp");
}
