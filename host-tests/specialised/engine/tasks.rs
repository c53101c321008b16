//! Operational space, hybrid dynamics and the regressor of the engine, against the core's on an odd
//! tree.

use dynamics_core::algorithms::frame::LocalWorldAligned;
use dynamics_core::algorithms::{
    Conditioning, Damping, OperationalSpace, Prescribed, momentum, operational_space, task_jacobian,
};
use dynamics_core::effects::{
    Coulomb, Gravity, GyroscopicRotors, LoadFriction, MovingBase, RIGID_BODY, Viscous, Width,
};
use dynamics_core::model::{OnBody, Static};
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::{Core, Engine};
use glam::DVec3;
use host_tests::measured::largest;
use host_tests::stress_robot::StressRobot;

use super::matrix::{Fork, ROTORS, Random, check};
use super::{Aslant, Drag, Push, payload};

/// The largest difference of two sets of numbers, relative to the largest number.
fn difference(got: &[f64], want: &[f64]) -> f64 {
    let scale = largest(want.iter().map(|x| x.abs()));
    assert_eq!(got.len(), want.len());
    largest(got.iter().zip(want).map(|(a, b)| (a - b).abs())) / scale
}

fn numbers<const M: usize, const V: usize>(task: &OperationalSpace<f64, M, V>) -> [Vec<f64>; 4] {
    [
        task.jacobian.as_flattened().to_vec(),
        task.response.as_flattened().to_vec(),
        task.mobility.as_flattened().to_vec(),
        task.inertia.as_flattened().to_vec(),
    ]
}

/// The task of one body, and that of two bodies on branches of the tree.
#[test]
fn operational_spaces_are_those_of_the_core() {
    type Odd = StressRobot;
    let (mut random, mut worst, mut regular) = (Random::new(), 0.0, 0);
    let place = DVec3::AXES.map(|axis| Force::new(DVec3::ZERO, axis));
    let (damping, scene) = (Damping::relative(1e-4), (RIGID_BODY, ROTORS, payload::<f64, 10>()));
    for _ in 0..100 {
        let q = random.array::<f64, 7>(3.0);
        let tip = (OnBody::<8>, LocalWorldAligned);
        let found = Engine::<Odd>::operational_space(&q, tip, &place, &scene, damping);
        let found = found.expect("M is positive");
        let tip = (8, LocalWorldAligned);
        let want = operational_space(&Static::<Odd>::NEW, &q, tip, &place, &scene, damping);
        let want = want.expect("M is positive");
        regular += u32::from(found.conditioning == Conditioning::Regular);
        for (found, want) in numbers(&found).iter().zip(numbers(&want)) {
            worst = largest([worst, difference(found, &want)]);
        }

        let [x, y, z] = task_jacobian(&Core::<Odd>::jacobian(&q, 8, LocalWorldAligned), &place);
        let [u, ..] = task_jacobian(&Core::<Odd>::jacobian(&q, 6, LocalWorldAligned), &place);
        let rows = [x, y, z, u];
        let found = Engine::<Odd>::operational_space_of_rows(&q, rows, &scene, damping);
        let m = Core::<Odd>::crba(&q, &scene);
        let factors = Core::<Odd>::ltdl(&m).expect("M is positive");
        let want = OperationalSpace::new(rows, |tau| Core::<Odd>::solve(&factors, tau), damping);
        let found = found.expect("M is positive");
        worst = largest([worst, difference(&numbers(&found)[2].clone(), &numbers(&want)[2])]);
    }
    assert!(regular > 90);
    check("odd", "engine operational space", "f64", worst);
}

/// Each coordinate has a given torque or acceleration, under friction that depends on the load.
#[test]
fn hybrid_dynamics_are_those_of_the_core() {
    let (mut random, mut worst) = (Random::new(), 0.0);
    let width = Width::new(0.5);
    let gears = LoadFriction { driving: [0.2; 7], backdriving: [0.1; 7], width };
    let friction = (Viscous([0.7; 7]), Coulomb { torque: [0.5; 7], width });
    let scene = (
        (Gravity::<Aslant>::new(9.81), RIGID_BODY.1, RIGID_BODY.2),
        (friction, gears, ROTORS, payload::<f64, 10>(), Push, Drag),
    );
    for _ in 0..200 {
        let state = random.state::<f64, 7>();
        let values = random.array::<f64, 7>(10.0);
        let given = core::array::from_fn(|k| match random.array::<f64, 1>(1.0) {
            [x] if x < 0.0 => Prescribed::Torque(values[k]),
            _ => Prescribed::Acceleration(values[k]),
        });
        let found = Engine::<StressRobot>::hybrid_dynamics(&state, &given, &scene);
        let want = Core::<StressRobot>::hybrid_dynamics(&state, &given, &scene);
        let (found, want) = (found.expect("M is positive"), want.expect("M is positive"));
        for (k, given) in given.iter().enumerate() {
            match *given {
                Prescribed::Torque(tau) => assert_eq!(found.tau[k], tau),
                Prescribed::Acceleration(qdd) => assert_eq!(found.qdd[k], qdd),
            }
        }
        let errors = [difference(&found.tau, &want.tau), difference(&found.qdd, &want.qdd)];
        worst = largest([worst, errors[0], errors[1]]);
    }
    check("odd", "engine hybrid dynamics", "f64", worst);
}

/// Every function of the engine that takes rotors that spin as bodies, on a tree with revolute and
/// prismatic joints and a base that moves; the core's agree with a tree that has the rotors as
/// bodies.
#[test]
fn rotors_that_spin_act_as_in_the_core() {
    let (mut random, mut worst) = (Random::new(), 0.0);
    let rotors =
        GyroscopicRotors { inertia: [2e-3, 1.5e-3, 1e-3, 6e-4], ratio: [6.0, -4.0, 9.0, 40.0] };
    let ship = MovingBase {
        velocity: Motion::new(DVec3::new(0.3, -0.5, 0.7), DVec3::new(0.1, 0.2, -0.3)),
        acceleration: Motion::new(DVec3::new(-1.0, 2.0, 0.5), DVec3::new(0.4, 1.0, -2.0)),
    };
    let scene = (RIGID_BODY, rotors, ship);
    let robot = &Static::<Fork>::NEW;
    for _ in 0..200 {
        let state = random.state::<f64, 4>();
        let tau = Core::<Fork>::rnea(&state, &scene);
        let rigid = Core::<Fork>::rnea(&state, &(RIGID_BODY, ship));
        assert!(difference(&tau, &rigid) > 1e-3);
        let mut given = tau.map(Prescribed::Torque);
        given[1] = Prescribed::Acceleration(state.qdd[1]);
        let hybrid = Engine::<Fork>::hybrid_dynamics(&state, &given, &scene);
        let hybrid = hybrid.expect("M is positive");
        let forward = Engine::<Fork>::forward_dynamics(&state, &tau, &scene);
        let [m, want] =
            [Engine::<Fork>::crba(&state.q, &scene), Core::<Fork>::crba(&state.q, &scene)];
        let rows = |m: &dynamics_core::MassMatrix<f64, 4>| -> Vec<f64> {
            (0..16).map(|k| m.get(k / 4, k % 4)).collect()
        };
        let [p, wanted] = [
            Engine::<Fork>::momentum_and_coriolis(&state, &scene),
            Core::<Fork>::momentum_and_coriolis(&state, &scene),
        ];
        let drift = [
            Engine::<Fork>::momentum_and_drift(&state, &scene).beta,
            Core::<Fork>::momentum_and_drift(&state, &scene).beta,
        ];
        let h = [Engine::<Fork>::momentum(&state, &scene), momentum(robot, &state, &scene)];
        let h = h.map(|h| [h.ang.to_array(), h.lin.to_array()]);
        let energy = [
            Engine::<Fork>::kinetic_energy(&state, &scene),
            Core::<Fork>::kinetic_energy(&state, &scene),
        ];
        worst = largest([
            worst,
            difference(&Engine::<Fork>::rnea(&state, &scene), &tau),
            difference(&rows(&m), &rows(&want)),
            difference(&forward.expect("M is positive"), &state.qdd) * 0.1,
            difference(&hybrid.qdd, &state.qdd) * 0.1,
            difference(&hybrid.tau, &tau) * 0.1,
            difference(&p.p, &wanted.p),
            difference(&p.ct_qd, &wanted.ct_qd),
            difference(&drift[0], &drift[1]),
            difference(h[0].as_flattened(), h[1].as_flattened()),
            difference(&energy[..1], &energy[1..]),
        ]);
    }
    check("fork", "engine spinning rotors", "f64", worst);
}
