//! Poses, velocities, accelerations, Jacobians, energies and momenta: closed forms, and laws that
//! hold for every tree and joint.

use crate::common::*;
use dynamics_core::algorithms::{
    bias_acceleration, center_of_mass, centroidal_matrix, classical, frame, jacobian, kinematics,
    kinetic_energy, momentum, poses, potential_energy,
};
use dynamics_core::effects::{Effect, Gravity, hook};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
use dynamics_core::scalar::Real;
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::state::State;
use glam::{DMat3, DVec3};

/// Two links of 1 m and 0.5 m that turn about y.
const TWO: ArmModel<f64, 3> = Model::new(
    "two links",
    [
        Body::new("upper", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(2.0).com([0.5, 0.0, 0.0]),
        Body::new("lower", 0, Joint::revolute([0.0, 1.0, 0.0]))
            .xyz([1.0, 0.0, 0.0])
            .mass(1.0)
            .com([0.25, 0.0, 0.0]),
        Body::new("tool", 1, Joint::revolute([1.0, 0.0, 0.0])).xyz([0.5, 0.0, 0.0]),
    ],
);

#[test]
fn two_link_kinematics_agree_with_trigonometry() {
    let (q, qd) = ([0.3_f64, -0.7, 0.2], [1.1, -0.4, 0.6]);
    let (a, b) = (q[0], q[0] + q[1]);
    let p = DVec3::new(a.cos() + 0.5 * b.cos(), 0.0, -a.sin() - 0.5 * b.sin());
    let [w1, w2] = [qd[0], qd[0] + qd[1]];
    let v = DVec3::new(-a.sin() * w1 - 0.5 * b.sin() * w2, 0.0, -a.cos() * w1 - 0.5 * b.cos() * w2);
    let at_rest = DVec3::new(
        -a.cos() * w1 * w1 - 0.5 * b.cos() * w2 * w2,
        0.0,
        a.sin() * w1 * w1 + 0.5 * b.sin() * w2 * w2,
    );
    let state = State { qd, ..State::at(q) };
    let k = kinematics(&TWO, &state, &());
    let near = |x: DVec3, y: DVec3| assert!((x - y).length() < 1e-15, "{x} {y}");
    near(k.poses[2].pos, p);
    near(k.poses[2].rot.x_axis, DVec3::new(b.cos(), 0.0, -b.sin()));
    near(k.velocity(2, frame::LocalWorldAligned).lin, v);
    near(k.velocity(2, frame::World).lin, v - k.velocity(2, frame::LocalWorldAligned).ang.cross(p));
    near(k.classical(2, frame::LocalWorldAligned).lin, at_rest);
    near(bias_acceleration(&TWO, &state, 2, frame::LocalWorldAligned).lin, at_rest);
    let height = -2.0 * 0.5 * a.sin() + (-a.sin() - 0.25 * b.sin());
    let energy = potential_energy(&TWO, &q, &Gravity::EARTH);
    assert!((energy - 9.81 * height).abs() < 1e-14);
}

#[test]
fn velocities_are_rates_of_poses() {
    let mut worst = Worst::default();
    for (tree, state) in trees(false) {
        let k = kinematics(&tree, &state, &());
        assert_eq!(k.poses, poses(&tree, &state.q));
        for body in 0..B {
            let pose = |t| poses(&tree, &moved(&tree, &state.q, &state.qd, t))[body];
            let v = DVec3::from(slope(|t| pose(t).pos.to_array()));
            let turning = DMat3::from_cols_array(&slope(|t| pose(t).rot.to_cols_array()));
            let turning = turning * pose(0.0).rot.transpose(); // [ω]×
            let omega = DVec3::new(turning.y_axis.z, turning.z_axis.x, turning.x_axis.y);
            worst.see(
                six(k.velocity(body, frame::LocalWorldAligned)),
                six::<f64>(Motion::new(omega, v)),
            );
        }
    }
    let mut verdict = Verdict::default();
    verdict.see("mixed tree", "velocity by difference", "f64", &worst);
    verdict.speak();
}

/// J q̇ at a state, of any frame.
fn by_jacobian<F: frame::Frame>(tree: &Tree, at: &State<f64, Q, V>, body: usize, f: F) -> [f64; 6] {
    let columns = jacobian(tree, &at.q, body, f);
    six(columns.iter().zip(at.qd).fold(Motion::ZERO, |sum, (&column, qd)| sum + column * qd))
}

fn jacobian_laws<F: frame::Frame>(
    f: F,
    worst: &mut [Worst; 3],
    extra: fn(Motion<f64>, Motion<f64>) -> Motion<f64>,
) {
    for (tree, state) in trees(false) {
        let k = kinematics(&tree, &state, &());
        let still = kinematics(&tree, &State { qdd: [0.0; V], ..state }, &());
        for body in 0..B {
            let (v, a) = (k.velocity(body, f), k.acceleration(body, f));
            worst[0].see(by_jacobian(&tree, &state, body, f), six(v));
            let rate = slope(|t| by_jacobian(&tree, &later(&tree, &state, t), body, f));
            worst[1].see(six(extra(a, v)), rate);
            let bias = extra(still.acceleration(body, f), v);
            worst[2].see(six(bias_acceleration(&tree, &state, body, f)), six(bias));
        }
    }
}

#[test]
fn jacobians_give_velocities_and_their_rates_accelerations_in_every_frame() {
    let mut worst = [(); 3].map(|()| Worst::default());
    jacobian_laws(frame::Local, &mut worst, |a, _| a);
    jacobian_laws(frame::World, &mut worst, |a, _| a);
    jacobian_laws(frame::LocalWorldAligned, &mut worst, classical);
    let mut verdict = Verdict::default();
    for (law, worst) in ["J qd", "acceleration by difference"].iter().zip(&worst) {
        verdict.see("mixed tree", law, "f64", worst);
    }
    assert_eq!(worst[2].error, 0.0, "the same operations");
    verdict.speak();
}

#[test]
fn the_base_has_zero_jacobian_and_missing_bodies_have_nan() {
    let (tree, state) = trees(false).next().unwrap();
    assert_eq!(jacobian(&tree, &state.q, BASE, frame::World), [Motion::ZERO; V]);
    assert_eq!(bias_acceleration(&tree, &state, BASE, frame::LocalWorldAligned), Motion::ZERO);
    let columns = jacobian(&tree, &state.q, B, frame::World);
    let kinematics = kinematics(&tree, &state, &());
    let others = [
        bias_acceleration(&tree, &state, B, frame::LocalWorldAligned),
        kinematics.velocity(B, frame::Local),
        kinematics.acceleration(B, frame::LocalWorldAligned),
    ];
    for motion in columns.iter().chain(&others) {
        assert!(motion.ang.is_nan() && motion.lin.is_nan());
    }
}

struct Carried(Motion<f64>, Motion<f64>);

impl<const B: usize, const V: usize> Effect<f64, B, V> for Carried {
    const BASE: hook::Base<Self, f64> = hook::Base::moving(|given, velocity, acceleration| {
        *velocity += given.0;
        *acceleration += given.1;
    });
}

#[test]
fn a_moving_base_equals_a_free_joint() {
    const UPPER: Body =
        Body::new("upper", BASE, Joint::revolute([0.0, 1.0, 0.3])).mass(2.0).com([0.5, 0.1, 0.0]);
    const LOWER: Joint<f64> = Joint::universal([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    let lower = |parent| {
        Body::new("lower", parent, LOWER).xyz([1.0, 0.0, 0.2]).mass(1.0).com([0.2, 0.0, 0.1])
    };
    let carried: Model<f64, 2, 3, 3> = Model::new("carried", [UPPER, lower(0)]);
    let upper =
        Body::new("upper", 0, Joint::revolute([0.0, 1.0, 0.3])).mass(2.0).com([0.5, 0.1, 0.0]);
    let free: Model<f64, 3, 10, 9> =
        Model::new("free", [Body::new("base", BASE, Joint::free()), upper, lower(1)]);
    let mut rng = Rng::new(5);
    let mut worst = Worst::default();
    for _ in 0..100 {
        let mut whole = random_state(&free, &mut rng);
        whole.q[..7].copy_from_slice(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
        let part = |from: &[f64]| core::array::from_fn(|i| from[from.len() - 3 + i]);
        let arm = State { q: part(&whole.q), qd: part(&whole.qd), qdd: part(&whole.qdd) };
        let six_of = |x: &[f64]| Motion::new(DVec3::from_slice(x), DVec3::from_slice(&x[3..]));
        let base = Carried(six_of(&whole.qd), six_of(&whole.qdd));
        let (a, b) = (kinematics(&carried, &arm, &base), kinematics(&free, &whole, &()));
        for body in 0..2 {
            worst.see(six(a.velocity(body, frame::World)), six(b.velocity(body + 1, frame::World)));
            worst.see(
                six(a.acceleration(body, frame::Local)),
                six(b.acceleration(body + 1, frame::Local)),
            );
        }
        let (h, c) = (momentum(&carried, &arm, &base), center_of_mass(&carried, &arm, &base));
        let (h_free, c_free) = (momentum(&free, &whole, &()), center_of_mass(&free, &whole, &()));
        worst.see(flat::<f64>(h.ang, h.lin), flat::<f64>(h_free.ang, h_free.lin));
        worst.see(c.velocity.to_array(), c_free.velocity.to_array());
        worst.see([kinetic_energy(&carried, &arm, &base)], [kinetic_energy(&free, &whole, &())]);
    }
    assert_eq!(worst.error, 0.0, "the same operations");
}

/// The f32 code against the f64 code at the same states.
#[test]
fn single_precision_is_near_double() {
    fn cast<const N: usize>(x: [f64; N]) -> [f32; N] {
        x.map(|x| x as f32)
    }
    let mut worst = [(); 5].map(|()| Worst::default());
    let forces = |columns: [Force<f64>; V]| columns.map(|f| flat::<f64>(f.ang, f.lin));
    for (tree, state) in trees(false) {
        let single = tree.to_f32();
        let short = State { q: cast(state.q), qd: cast(state.qd), qdd: cast(state.qdd) };
        let (k, s) = (kinematics(&tree, &state, &()), kinematics(&single, &short, &()));
        for body in 0..B {
            worst[0].see(s.poses[body].pos.to_array().map(f64::from), k.poses[body].pos.to_array());
            worst[1].see(
                six(s.velocity(body, frame::LocalWorldAligned)),
                six(k.velocity(body, frame::LocalWorldAligned)),
            );
            worst[2].see(
                six(s.acceleration(body, frame::LocalWorldAligned)),
                six(k.acceleration(body, frame::LocalWorldAligned)),
            );
        }
        worst[3].see(
            [kinetic_energy(&single, &short, &()).to_f64()],
            [kinetic_energy(&tree, &state, &())],
        );
        let got = centroidal_matrix(&single, &short.q, &()).map(|f| flat::<f32>(f.ang, f.lin));
        for (got, want) in got.into_iter().zip(forces(centroidal_matrix(&tree, &state.q, &()))) {
            worst[4].see(got, want);
        }
    }
    let mut verdict = Verdict::default();
    let names = ["poses", "velocities", "accelerations", "kinetic energy", "A_G"];
    for (law, worst) in names.iter().zip(&worst) {
        verdict.see("mixed tree", law, "f32", worst);
    }
    verdict.speak();
}
