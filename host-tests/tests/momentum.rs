//! Energy and momentum: laws of mechanics on trees of every joint.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, SQRT_2};

use crate::common::*;
use dynamics_core::algorithms::{
    MassMatrix, MomentumAndCoriolis, aba, center_of_mass, centroidal_matrix, centroidal_momentum,
    crba, kinetic_energy, momentum, momentum_and_coriolis, momentum_and_drift, potential_energy,
    rnea,
};
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Effect, Gravity, Inertia, LoadFriction, MovingBase, Payload,
    RIGID_BODY, Viscous, Width, hook,
};
use dynamics_core::model::{BodyInertia, Model, Robot};
use dynamics_core::robots::{A1, Panda, Ur5e};
use dynamics_core::scalar::Real;
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::state::State;
use glam::DVec3;

// Rotors and a payload are part of M.
#[test]
fn momentum_is_m_qd_and_energy_half_qd_m_qd() {
    let mut worst = <[Worst; 2]>::default();
    for (tree, state) in trees(false) {
        let scene = (Inertia, Armature([0.3; V]), load());
        // M q̇ is the torque of q̈ = q̇ at rest.
        let at_rest = State { qd: [0.0; V], qdd: state.qd, ..state };
        let p = rnea(&tree, &at_rest, &scene);
        let half: f64 = p.iter().zip(state.qd).map(|(p, qd)| 0.5 * p * qd).sum();
        worst[0].see([kinetic_energy(&tree, &state, &scene)], [half]);
        let m_qd = product(&crba(&tree, &state.q, &scene), &state.qd);
        worst[1].see(momentum_and_coriolis(&tree, &state, &scene).p, m_qd);
    }
    let mut verdict = Verdict::default();
    verdict.see("mixed tree", "kinetic energy", "f64", &worst[0]);
    verdict.see("mixed tree", "M qd", "f64", &worst[1]);
    verdict.speak();
}

#[test]
fn motors_supply_the_rate_of_both_energies() {
    let mut worst = Worst::default();
    for (tree, state) in trees(false) {
        let tau = rnea(&tree, &state, &RIGID_BODY);
        let power: f64 = tau.iter().zip(state.qd).map(|(tau, qd)| tau * qd).sum();
        let [stored] = slope(|t| {
            let at = later(&tree, &state, t);
            [kinetic_energy(&tree, &at, &()) + potential_energy(&tree, &at.q, &RIGID_BODY)]
        });
        worst.see([power], [stored]);
    }
    let mut verdict = Verdict::default();
    verdict.see("mixed tree", "rate of energy", "f64", &worst);
    verdict.speak();
}

// It is the centroidal matrix times q̇ as well.
#[test]
fn centroidal_momentum_is_mass_times_centre_velocity() {
    let mut worst = [(); 3].map(|()| Worst::default());
    for (tree, state) in trees(false) {
        let (h, c) = (momentum(&tree, &state, &()), center_of_mass(&tree, &state, &()));
        let mass: f64 = tree.links.iter().map(|link| link.inertia.mass).sum();
        assert!((c.mass - mass).abs() < 1e-14 * mass);
        let centre =
            |t| center_of_mass(&tree, &State::at(moved(&tree, &state.q, &state.qd, t)), &());
        worst[0].see(c.velocity.to_array(), slope(|t| centre(t).position.to_array()));
        let about_centre = centroidal_momentum(&tree, &state, &());
        let moved = about_centre.ang + c.position.cross(about_centre.lin);
        worst[1].see(flat::<f64>(moved, about_centre.lin), flat::<f64>(h.ang, h.lin));
        let columns = centroidal_matrix(&tree, &state.q, &());
        let product =
            columns.iter().zip(state.qd).fold(Force::<f64>::ZERO, |sum, (&a, qd)| sum + a * qd);
        worst[2].see(
            flat::<f64>(product.ang, product.lin),
            flat::<f64>(about_centre.ang, about_centre.lin),
        );
    }
    let mut verdict = Verdict::default();
    for (law, worst) in
        ["velocity of the centre", "momentum about the centre", "A_G qd"].iter().zip(&worst)
    {
        verdict.see("mixed tree", law, "f64", worst);
    }
    verdict.speak();
}

/// Euler's laws: nothing but weight acts on a tree that falls, whatever its motors do.
#[test]
fn only_gravity_changes_a_falling_trees_momentum() {
    let mut worst = Worst::default();
    for (tree, mut state) in trees(true) {
        let mut tau = state.qdd; // any torques, but none on the free joint
        let at = tree.links[0].idx_v;
        tau[at..at + 6].fill(0.0);
        state.qdd = aba(&tree, &state, &tau, &(Gravity::EARTH, Inertia, Coriolis)).unwrap();
        let rate = slope(|t| {
            let h = momentum(&tree, &later(&tree, &state, t), &());
            flat::<f64>(h.ang, h.lin)
        });
        let c = center_of_mass(&tree, &state, &());
        let weight = DVec3::new(0.0, 0.0, -9.81 * c.mass);
        worst.see(rate, flat::<f64>(c.position.cross(weight), weight));
        let rate =
            slope(|t| centroidal_momentum(&tree, &later(&tree, &state, t), &()).ang.to_array());
        worst.see(rate, [0.0; 3]);
    }
    let mut verdict = Verdict::default();
    verdict.see("mixed tree", "rate of momentum", "f64", &worst);
    verdict.speak();
}

/// On trees of every joint, by a payload, armatures and a base that moves: ṗ, and the torque with
/// Cᵀ q̇.
fn rate_of_momentum() -> Worst {
    let mut worst = Worst::default();
    for (i, (tree, state)) in trees(false).enumerate() {
        let scale = (i % 2) as f64;
        let v = Motion::new(DVec3::new(0.3, -0.5, 0.7), DVec3::new(0.1, 0.2, -0.3)) * scale;
        let a = Motion::new(DVec3::new(-1.0, 2.0, 0.5), DVec3::new(0.4, 1.0, -2.0)) * scale;
        let ship = |t| MovingBase { velocity: v + a * t, acceleration: a };
        let scene = |t| ((Inertia, Coriolis, Armature([0.3; V])), (load(), ship(t)));
        let rate = slope(|t| momentum_and_coriolis(&tree, &later(&tree, &state, t), &scene(t)).p);
        let tau = rnea(&tree, &state, &scene(0.0));
        let ct_qd = momentum_and_coriolis(&tree, &state, &scene(0.0)).ct_qd;
        worst.see(core::array::from_fn(|k| tau[k] + ct_qd[k]), rate);
    }
    worst
}

fn product<const V: usize>(m: &MassMatrix<f64, V>, qd: &[f64; V]) -> [f64; V] {
    core::array::from_fn(|i| (0..V).map(|j| m.get(i, j) * qd[j]).sum())
}

fn load() -> Payload<f64, { B - 1 }> {
    Payload::from_inertia(BodyInertia {
        mass: 1.5,
        com: [0.1, -0.2, 0.05],
        inertia: [0.01, 0.0, 0.0, 0.02, 0.0, 0.015],
    })
}

// The trees have joints of every kind.
#[test]
fn generalised_momentum_changes_by_torque_and_ct_qd() {
    let worst = rate_of_momentum();
    let mut verdict = Verdict::default();
    verdict.see("mixed tree", "rate of M qd", "f64", &worst);
    verdict.speak();
}

/// Drags every body through the air, against its velocity and that of the base, and pulls it to a
/// point.
struct Air;

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Air {
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::of_state(|_, body, at, fx| {
        let k = R::from_f64(0.3 + 0.1 * body as f64);
        let base = at.base.unwrap_or(Motion::ZERO).lin;
        *fx -= Force::new(at.velocity.ang * k, (at.velocity.lin + base) * k);
        fx.lin -= at.pose.rot * at.pose.pos;
    });
}

/// On the same trees, with weight, friction and wrenches of their surroundings.
#[test]
fn generalised_momentum_changes_by_motor_torque_and_drift() {
    let mut worst = Worst::default();
    for (i, (tree, state)) in trees(false).enumerate() {
        let scale = (i % 2) as f64;
        let v = Motion::new(DVec3::new(0.3, -0.5, 0.7), DVec3::new(0.1, 0.2, -0.3)) * scale;
        let a = Motion::new(DVec3::new(-1.0, 2.0, 0.5), DVec3::new(0.4, 1.0, -2.0)) * scale;
        let width = Width::new(0.5);
        let coulomb = Coulomb { torque: [0.8; V], width };
        let scene = |t| {
            let ship = MovingBase { velocity: v + a * t, acceleration: a };
            let joints = (Armature([0.3; V]), Viscous([0.7; V]), coulomb);
            (RIGID_BODY, joints, load(), ship, Air)
        };
        let gears = LoadFriction { driving: [0.2; V], backdriving: [0.1; V], width };
        let rate = slope(|t| {
            let later = later(&tree, &state, t);
            momentum_and_drift(&tree, &later, &scene(t)).p
        });
        let tau = rnea(&tree, &state, &scene(0.0));
        // The friction of the gears is no part of it.
        let beta = momentum_and_drift(&tree, &state, &(scene(0.0), gears)).beta;
        worst.see(core::array::from_fn(|k| tau[k] + beta[k]), rate);
    }
    let mut verdict = Verdict::default();
    verdict.see("mixed tree", "rate of M qd by its drift", "f64", &worst);
    verdict.speak();
}

/// df/dq of a trigonometric polynomial of second degree, without truncation: it is spanned by four
/// values.
fn slope_of_turn<const N: usize>(f: impl Fn(f64) -> [f64; N]) -> [f64; N] {
    let [a, b] = [FRAC_PI_2, FRAC_PI_4].map(|by| {
        let (ahead, behind) = (f(by), f(-by));
        core::array::from_fn::<_, N, _>(|i| ahead[i] - behind[i])
    });
    core::array::from_fn(|i| b[i] + 0.5 * (1.0 - SQRT_2) * a[i])
}

/// Compares for an arm of revolute joints p and M q̇, Cᵀ q̇ and Ṁ q̇ − C q̇, and Cᵀ q̇ and ∂T/∂q.
fn of_an_arm<const N: usize, const V: usize>(arm: &Model<f64, N, V, V>, worst: &mut [Worst; 3]) {
    let mut rng = Rng::new(5);
    for _ in 0..100 {
        let state = random_state(arm, &mut rng);
        let scene = (Coriolis, Armature([0.3; V]));
        let at = |k: usize, by: f64| State {
            q: core::array::from_fn(|i| state.q[i] + if i == k { by } else { 0.0 }),
            ..state
        };
        let m_qd = |q: &[f64; V]| product(&crba(arm, q, &scene), &state.qd);
        let MomentumAndCoriolis { p, ct_qd } = momentum_and_coriolis(arm, &state, &scene);
        worst[0].see(p, m_qd(&state.q));
        let rest = State { qdd: [0.0; V], ..state };
        let mut less = rnea(arm, &rest, &scene).map(|c_qd| -c_qd);
        for k in 0..V {
            let by_q = slope_of_turn(|by| m_qd(&at(k, by).q));
            for (less, by_q) in less.iter_mut().zip(by_q) {
                *less += by_q * state.qd[k];
            }
        }
        worst[1].see(ct_qd, less);
        let by_q = core::array::from_fn(|k| {
            slope_of_turn(|by| [kinetic_energy(arm, &at(k, by), &scene)])[0]
        });
        worst[2].see(ct_qd, by_q);
    }
}

// p = M q̇, and Cᵀ q̇ = Ṁ q̇ − C q̇ is the slope of the kinetic energy.
#[test]
fn momentum_and_ct_qd_of_arms_obey_their_laws() {
    let mut verdict = Verdict::default();
    let mut see = |arm, worst: &[Worst; 3]| {
        for (law, worst) in ["M qd", "Cᵀ qd", "slope of energy"].iter().zip(worst) {
            verdict.see(arm, law, "f64", worst);
        }
    };
    let mut worst = <[Worst; 3]>::default();
    of_an_arm(&Ur5e::MODEL, &mut worst);
    see("ur5e", &worst);
    let mut worst = <[Worst; 3]>::default();
    of_an_arm(&Panda::MODEL, &mut worst);
    see("panda", &worst);
    let mut worst = <[Worst; 3]>::default();
    of_an_arm(&A1::MODEL, &mut worst);
    see("a1", &worst);
    verdict.speak();
}
