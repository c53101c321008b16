//! The spring: force over displacement, and motions that it does not show.

use crate::common::*;
use crate::impedance::plant::*;
use dynamics_core::algorithms::{aba, kinetic_energy};
use dynamics_core::effects::{Coriolis, Gravity, Inertia};
use dynamics_core::model::{ArmModel, Robot};
use dynamics_core::robots::{Panda, Ur5e};
use glam::DVec3;
use motion_control::law::{CartesianImpedance, ImpedanceConfig};

/// The displacement by a force after it has settled, and that of the spring; m and rad.
fn displaced<const N: usize>(mut sprung: Sprung<N>, worst: &mut Worst) {
    let push = DVec3::new(20.0, -12.0, 8.0);
    (0..4000).for_each(|_| sprung.advance(push, 2e-3));
    let moved = sprung.deviation().position.map(|x| -x);
    let [x, y, z] = (push / STIFFNESS[5]).to_array();
    worst.see(moved, [0.0, 0.0, 0.0, x, y, z]);
}

// The posture does not change it.
#[test]
fn the_tip_displacement_is_force_over_stiffness() {
    let mut worst = [(); 2].map(|()| Worst::default());
    displaced(Sprung::at(Ur5e::MODEL, UR5E), &mut worst[0]);
    displaced(Sprung::at(Panda::MODEL, PANDA), &mut worst[1]);
    // A posture that pulls on the elbow does not change that.
    let mut pulled = Sprung::at(Panda::MODEL, PANDA);
    pulled.posture = (PANDA.map(|q| q + 0.5), 5.0, 4.0);
    displaced(pulled, &mut worst[1]);
    let mut verdict = Verdict::default();
    verdict.see("ur5e", "displacement of an impedance", "f64", &worst[0]);
    verdict.see("panda", "displacement of an impedance", "f64", &worst[1]);
    verdict.speak();
    // Outside the null space it does.
    let mut pulled = Sprung::at(Panda::MODEL, PANDA);
    (pulled.posture.0, pulled.posture.1) = (PANDA.map(|q| q + 0.5), 5.0);
    pulled.projected = false;
    let mut off = Worst::default();
    displaced(pulled, &mut off);
    assert!(off.error > 0.1 * off.full_scale, "{:e}", off.error);
}

#[test]
fn a_motion_of_the_elbow_does_not_move_the_tip() {
    let swing = |projected| {
        let mut sprung = Sprung::at(Panda::MODEL, PANDA);
        let config = ImpedanceConfig { zeta: 1.0, ..CONFIG };
        sprung.impedance = CartesianImpedance::try_new(config).unwrap();
        sprung.projected = projected;
        sprung.posture = (PANDA, 20.0, 15.0);
        sprung.posture.0[2] += 1.0;
        let (mut off, mut elbow) = (0.0_f64, 0.0_f64);
        for _ in 0..3000 {
            sprung.advance(DVec3::ZERO, 1e-3);
            let [.., x, y, z] = sprung.deviation().position;
            off = off.max(DVec3::new(x, y, z).length());
            elbow = elbow.max((sprung.state.q[2] - PANDA[2]).abs());
        }
        (off, elbow)
    };
    let ((off, elbow), (without, _)) = (swing(true), swing(false));
    assert!(elbow > 0.2, "{elbow}");
    let mut verdict = Verdict::default();
    let worst = Worst { error: off, full_scale: 1.0 };
    verdict.see("panda", "tip by a motion of the elbow, m", "f64", &worst);
    verdict.speak();
    assert!(without > 20.0 * off, "{without} {off}");
}

/// The rate of kinetic energy and that of the spring, and what the damper dissipates, at random
/// states; `more`: a torque beside the impedance.
fn balance<const N: usize>(arm: ArmModel<f64, N>, more: f64) -> Worst {
    let (mut worst, mut rng) = (Worst::default(), Rng::new(47));
    for _ in 0..100 {
        let mut sprung = Sprung::at(arm, rng.vector(2.5));
        sprung.state = random_state(&arm, &mut rng);
        (sprung.posture.1, sprung.posture.2) = (0.0, 0.0);
        let (mut tau, _) = sprung.torque().unwrap();
        tau[0] += more;
        let rotors = Sprung::<N>::rotors();
        let scene = (Gravity::EARTH, Inertia, Coriolis, rotors);
        sprung.state.qdd = aba(&arm, &sprung.state, &tau, &scene).unwrap();
        let dissipated = {
            let (d, _) = sprung.impedance.damping(&sprung.task().mobility);
            let v = sprung.deviation().velocity;
            let force = d.map(|row| row.iter().zip(v).map(|(d, v)| d * v).sum::<f64>());
            force.iter().zip(v).map(|(f, v)| f * v).sum::<f64>()
        };
        let [rate] = slope(|t| {
            let state = later(&arm, &sprung.state, t);
            let sprung = Sprung { state, ..sprung };
            let [a, b, c, x, y, z] = sprung.deviation().position;
            let cos = (1.0 - 0.25 * (a * a + b * b + c * c)).sqrt();
            let stored =
                4.0 * STIFFNESS[0] * (1.0 - cos) + 0.5 * STIFFNESS[5] * (x * x + y * y + z * z);
            [kinetic_energy(&arm, &sprung.state, &rotors) + stored]
        });
        worst.see([rate], [-dissipated]);
    }
    worst
}

#[test]
fn only_the_damper_changes_the_arm_and_spring_energy() {
    let mut verdict = Verdict::default();
    let quantity = "energy on an impedance";
    verdict.see("ur5e", quantity, "f64", &balance(Ur5e::MODEL, 0.0));
    verdict.see("panda", quantity, "f64", &balance(Panda::MODEL, 0.0));
    verdict.speak();
    let pushed = balance(Ur5e::MODEL, 1.0);
    assert!(pushed.error > 1e-4 * pushed.full_scale);
}
