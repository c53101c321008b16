//! Compliant joints: derivatives against differences, the rigid limit, two masses, and stiffness.

use super::*;
use dynamics_core::algorithms::rnea;
use dynamics_core::drivetrain::{
    ElasticJoints, ElasticReference, MotorState, elastic_inverse_dynamics, elastic_step,
};
use dynamics_core::effects::{Armature, Inertia, RIGID_BODY, Viscous};
use dynamics_core::model::Robot;
use dynamics_core::robots::{Panda, Ur5e};
use dynamics_core::sim::linearly_implicit;
use host_tests::measured::largest;
use host_tests::random::{random_body, random_numbers, within};
use proptest::prelude::RngExt;
use proptest::test_runner::TestRng;

/// Σ c_k t^k / k! and its first four derivatives, six coefficients a joint.
fn along<const N: usize>(c: &[[f64; 7]; N], t: f64) -> ElasticReference<f64, N, N> {
    let derivative = |n: usize| {
        core::array::from_fn(|i| {
            let (mut sum, mut term) = (0.0, 1.0);
            for (k, c) in c[i].iter().skip(n).enumerate() {
                sum += c * term;
                term *= t / (k + 1) as f64;
            }
            sum
        })
    };
    ElasticReference {
        state: State { q: derivative(0), qd: derivative(1), qdd: derivative(2) },
        jerk: derivative(3),
        snap: derivative(4),
    }
}

fn coefficients<const N: usize>(rng: &mut TestRng) -> [[f64; 7]; N] {
    core::array::from_fn(|_| {
        [3.0, 2.0, 5.0, 10.0, 20.0, 40.0, 80.0].map(|bound| rng.random_range(-bound..bound))
    })
}

/// A tree of one-axis joints of all four kinds.
fn tree(rng: &mut TestRng) -> ArmModel<f64, 8> {
    const NAMES: [&str; 8] = ["a", "b", "c", "d", "e", "f", "g", "h"];
    let bodies = core::array::from_fn(|i| {
        let axis = within(rng, 1.0);
        let joint = match i % 4 {
            0 => Joint::revolute(axis),
            1 => Joint::prismatic(axis),
            2 => Joint::helical(axis, 0.2),
            _ => Joint::continuous(axis),
        };
        let parent = if i == 0 { BASE } else { rng.random_range(0..i) };
        random_body(rng, Body::new(NAMES[i], parent, joint))
    });
    Model::new("tree", bodies)
}

/// θ, θ̇ and τ_m by differences of rnea along the course: of sixth order.
fn by_differences<const N: usize>(
    model: &ArmModel<f64, N>,
    joints: &ElasticJoints<f64, N>,
    c: &[[f64; 7]; N],
) -> [[f64; N]; 3] {
    let scene = (RIGID_BODY, Viscous([0.7; N]), Armature([0.2; N]));
    let h = 2e-3;
    let tau: [[f64; N]; 7] =
        core::array::from_fn(|k| rnea(model, &along(c, h * (k as f64 - 3.0)).state, &scene));
    let at = along(c, 0.0).state;
    let of = |i: usize| {
        let t = |k: usize| tau[k][i];
        let first = (45.0 * (t(4) - t(2)) - 9.0 * (t(5) - t(1)) + (t(6) - t(0))) / (60.0 * h);
        let second = (270.0 * (t(4) + t(2)) - 27.0 * (t(5) + t(1)) + 2.0 * (t(6) + t(0))
            - 490.0 * t(3))
            / (180.0 * h * h);
        let k = joints.stiffness[i];
        let (theta, rate) = (at.q[i] + t(3) / k, at.qd[i] + first / k);
        let torque = joints.rotor[i] * (at.qdd[i] + second / k) + joints.friction[i] * rate + t(3);
        [theta, rate, torque]
    };
    [0, 1, 2].map(|n| core::array::from_fn(|i| of(i)[n]))
}

#[test]
fn motor_torques_of_a_course_are_those_of_its_differences() {
    fn see<const N: usize>(model: &ArmModel<f64, N>, rng: &mut TestRng, worst: &mut [Worst; 3]) {
        let joints = ElasticJoints { stiffness: [100.0; N], rotor: [0.5; N], friction: [2.0; N] };
        let c = coefficients::<N>(rng);
        let scene = (RIGID_BODY, Viscous([0.7; N]), Armature([0.2; N]));
        let got = elastic_inverse_dynamics(model, &joints, &along(&c, 0.0), &scene).unwrap();
        let got = [got.position, got.velocity, got.torque];
        let want = by_differences(model, &joints, &c);
        for ((worst, got), want) in worst.iter_mut().zip(got).zip(want) {
            worst.see_all(&got, &want);
        }
    }
    let (rng, mut worst) = (&mut random_numbers(), <[Worst; 3]>::default());
    for _ in 0..20 {
        let tree = tree(rng);
        see(&tree, rng, &mut worst);
        see(&Ur5e::MODEL, rng, &mut worst);
        see(&Panda::MODEL, rng, &mut worst);
    }
    let names = ["motor angle", "motor rate", "motor torque"];
    for (worst, name) in worst.iter().zip(names) {
        worst.check::<f64>("compliant joints", name);
    }
}

#[test]
fn motor_torques_in_f32_are_those_in_f64() {
    let (rng, mut worst) = (&mut random_numbers(), Worst::default());
    for _ in 0..200 {
        let joints = ElasticJoints { stiffness: [4096.0; 6], rotor: [0.5; 6], friction: [2.0; 6] };
        let double = along(&coefficients::<6>(rng), 0.0);
        let want = elastic_inverse_dynamics(&Ur5e::MODEL, &joints, &double, &RIGID_BODY).unwrap();
        let single = ElasticReference {
            state: cast::<f32, 6>(&double.state),
            jerk: double.jerk.map(|x| x as f32),
            snap: double.snap.map(|x| x as f32),
        };
        let joints =
            ElasticJoints { stiffness: [4096.0_f32; 6], rotor: [0.5; 6], friction: [2.0; 6] };
        let got =
            elastic_inverse_dynamics(&Ur5e::MODEL_F32, &joints, &single, &RIGID_BODY).unwrap();
        worst.see_all(&got.torque, &want.torque);
    }
    worst.check::<f32>("compliant joints", "motor torque");
}

#[test]
fn elastic_joints_converge_to_rigid_with_one_over_k() {
    let (rng, rotor) = (&mut random_numbers(), 0.5);
    let c = coefficients::<6>(rng);
    let course = along(&c, 0.0);
    let want = rnea(&Ur5e::MODEL, &course.state, &(RIGID_BODY, Armature([rotor; 6])));
    let error = |k: f64| {
        let joints = ElasticJoints { stiffness: [k; 6], rotor: [rotor; 6], friction: [0.0; 6] };
        let got = elastic_inverse_dynamics(&Ur5e::MODEL, &joints, &course, &RIGID_BODY).unwrap();
        let off = |i: usize| (got.torque[i] - want[i]).abs();
        largest((0..6).map(off))
    };
    for k in [1e3, 1e4, 1e5, 1e6] {
        let order = (error(k) / error(10.0 * k)).log10();
        assert!((order - 1.0).abs() < 1e-3, "order {order} at {k}");
    }
    // The plant, too: what a step does to the links.
    let tau = [3.0, -40.0, 10.0, 5.0, -2.0, 1.0];
    let start = State { qdd: [0.0; 6], ..course.state };
    let mut rigid = start;
    let mut scene = (RIGID_BODY, Armature([rotor; 6]));
    linearly_implicit(&Ur5e::MODEL, &mut rigid, &tau, &mut scene, 1e-3).unwrap();
    let error = |k: f64| {
        let joints = ElasticJoints { stiffness: [k; 6], rotor: [rotor; 6], friction: [0.0; 6] };
        let mut links = start;
        let mut motors = MotorState { position: start.q, velocity: start.qd };
        elastic_step(
            &Ur5e::MODEL,
            &joints,
            &mut links,
            &mut motors,
            &tau,
            &mut RIGID_BODY.clone(),
            1e-3,
        )
        .unwrap();
        largest((0..6).map(|i| (links.qd[i] - rigid.qd[i]).abs()))
    };
    for k in [1e8, 1e9] {
        let order = (error(k) / error(10.0 * k)).log10();
        assert!((order - 1.0).abs() < 1e-2, "order {order} at {k}");
    }
    assert!(error(1e10) < 1e-3);
}

#[test]
fn a_sprung_motor_and_sledge_have_the_closed_form() {
    let (k, j, h) = (500.0, 0.5, 1e-6);
    let joints = ElasticJoints { stiffness: [k], rotor: [j], friction: [0.0] };
    let mut links = State::at([0.0]);
    let mut motors = MotorState { position: [0.02], velocity: [0.0] };
    let omega = (k * (1.0 / 2.0 + 1.0 / j)).sqrt();
    let (mut worst, mut centre) = (Worst::default(), 0.0_f64);
    for i in 1..=400_000 {
        elastic_step(&SLEDGE, &joints, &mut links, &mut motors, &[0.0], &mut (Inertia,), h)
            .unwrap();
        let t = h * f64::from(i);
        worst.see(motors.position[0] - links.q[0], 0.02 * (omega * t).cos());
        centre = largest([centre, (j * motors.velocity[0] + 2.0 * links.qd[0]).abs()]);
    }
    assert!(centre < 1e-11, "momentum {centre:e}");
    worst.check::<f64>("motor and sledge", "stretch");
}

#[test]
fn a_compliant_arm_follows_by_elastic_feedforward() {
    // A fifth-order rest-to-rest course in closed form, and a soft arm.
    let joints = ElasticJoints { stiffness: [800.0; 6], rotor: [0.3; 6], friction: [3.0; 6] };
    let (from, by) = ([0.0, -1.2, 1.0, 0.2, 0.4, 0.0], [0.4, 0.3, -0.5, 0.3, -0.2, 0.5]);
    let course = |t: f64| {
        // s(t) = 35 t⁴ − 84 t⁵ + 70 t⁶ − 20 t⁷: at rest through its jerk at both ends.
        let s = [
            t.powi(4) * (35.0 - 84.0 * t + 70.0 * t * t - 20.0 * t * t * t),
            140.0 * t.powi(3) * (1.0 - t).powi(3),
            420.0 * t * t * (1.0 - t).powi(2) * (1.0 - 2.0 * t),
            840.0 * t * (1.0 - t) * (1.0 - 5.0 * t + 5.0 * t * t),
            840.0 * (1.0 - 12.0 * t + 30.0 * t * t - 20.0 * t * t * t),
        ];
        let of = |n: usize| by.map(|by| by * s[n]);
        let q = core::array::from_fn(|i| from[i] + by[i] * s[0]);
        ElasticReference { state: State { q, qd: of(1), qdd: of(2) }, jerk: of(3), snap: of(4) }
    };
    let run = |h: f64, stiff: bool| {
        let start =
            elastic_inverse_dynamics(&Ur5e::MODEL, &joints, &course(0.0), &RIGID_BODY).unwrap();
        let mut links = State::at(from);
        let mut motors = MotorState { position: start.position, velocity: [0.0; 6] };
        let (mut off, mut scene) = (0.0_f64, RIGID_BODY);
        for i in 0..(0.5 / h) as u32 {
            let now = course((f64::from(i) + 0.5) * h);
            let mut feedforward =
                elastic_inverse_dynamics(&Ur5e::MODEL, &joints, &now, &RIGID_BODY).unwrap();
            if stiff {
                let rigid = (RIGID_BODY, Armature(joints.rotor), Viscous(joints.friction));
                feedforward.torque = rnea(&Ur5e::MODEL, &now.state, &rigid);
            }
            elastic_step(
                &Ur5e::MODEL,
                &joints,
                &mut links,
                &mut motors,
                &feedforward.torque,
                &mut scene,
                h,
            )
            .unwrap();
            let want = course(f64::from(i + 1) * h).state.q;
            let now = (0..6).map(|i| (links.q[i] - want[i]).abs());
            off = largest(now.chain([off]));
        }
        off
    };
    let [coarse, fine] = [run(2e-4, false), run(1e-4, false)];
    println!(
        "off the course by {coarse:.2e}, {fine:.2e} rad; fed forward as if rigid {:.2e}",
        run(1e-4, true)
    );
    assert!((coarse / fine - 2.0).abs() < 0.3, "it is the integrator's error alone");
    assert!(run(1e-4, true) > 3.0 * fine);
}

#[test]
fn joints_of_several_degrees_of_freedom_are_refused_by_name() {
    let ball: Model<f64, 1, 4, 3> =
        Model::new("ball", [Body::new("ball", BASE, Joint::spherical()).mass(1.0)]);
    let joints = ElasticJoints { stiffness: [1.0; 3], rotor: [1.0; 3], friction: [0.0; 3] };
    let course =
        ElasticReference { state: State::at([0.0, 0.0, 0.0, 1.0]), jerk: [0.0; 3], snap: [0.0; 3] };
    let refused = elastic_inverse_dynamics(&ball, &joints, &course, &RIGID_BODY);
    assert_eq!(refused.unwrap_err().body, 0);
}
