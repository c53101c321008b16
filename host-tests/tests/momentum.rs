//! Energy and momentum: laws of mechanics on trees of every joint.

mod common;

use common::*;
use dynamics_core::algorithms::{
    aba, center_of_mass, centroidal_matrix, centroidal_momentum, kinetic_energy, momentum,
    potential_energy, rnea,
};
use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia, Payload, RIGID_BODY};
use dynamics_core::model::BodyInertia;
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use glam::DVec3;

#[test]
fn kinetic_energy_is_half_qd_m_qd_with_rotors_and_a_payload() {
    let mut worst = Worst::default();
    for (tree, state) in trees(false) {
        let load = Payload::<_, { B - 1 }>::from_inertia(BodyInertia {
            mass: 1.5,
            com: [0.1, -0.2, 0.05],
            inertia: [0.01, 0.0, 0.0, 0.02, 0.0, 0.015],
        });
        let scene = (Inertia, Armature([0.3; V]), load);
        // M q̇ is the torque of q̈ = q̇ at rest.
        let at_rest = State {
            qd: [0.0; V],
            qdd: state.qd,
            ..state
        };
        let p = rnea(&tree, &at_rest, &scene);
        let half: f64 = p.iter().zip(state.qd).map(|(p, qd)| 0.5 * p * qd).sum();
        worst.see([kinetic_energy(&tree, &state, &scene)], [half]);
    }
    let mut verdict = Verdict::default();
    verdict.see("mixed tree", "kinetic energy", "f64", &worst);
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

#[test]
fn momentum_is_mass_times_velocity_of_the_centre_and_the_matrix_times_qd() {
    let mut worst = [(); 3].map(|()| Worst::default());
    for (tree, state) in trees(false) {
        let (h, c) = (
            momentum(&tree, &state, &()),
            center_of_mass(&tree, &state, &()),
        );
        let mass: f64 = tree.links.iter().map(|link| link.inertia.mass).sum();
        assert!((c.mass - mass).abs() < 1e-14 * mass);
        let centre =
            |t| center_of_mass(&tree, &State::at(moved(&tree, &state.q, &state.qd, t)), &());
        worst[0].see(
            c.velocity.to_array(),
            slope(|t| centre(t).position.to_array()),
        );
        let about_centre = centroidal_momentum(&tree, &state, &());
        let moved = about_centre.ang + c.position.cross(about_centre.lin);
        worst[1].see(
            flat::<f64>(moved, about_centre.lin),
            flat::<f64>(h.ang, h.lin),
        );
        let columns = centroidal_matrix(&tree, &state.q, &());
        let product = columns
            .iter()
            .zip(state.qd)
            .fold(Force::<f64>::ZERO, |sum, (&a, qd)| sum + a * qd);
        worst[2].see(
            flat::<f64>(product.ang, product.lin),
            flat::<f64>(about_centre.ang, about_centre.lin),
        );
    }
    let mut verdict = Verdict::default();
    for (law, worst) in [
        "velocity of the centre",
        "momentum about the centre",
        "A_G qd",
    ]
    .iter()
    .zip(&worst)
    {
        verdict.see("mixed tree", law, "f64", worst);
    }
    verdict.speak();
}

/// Euler's laws: nothing but weight acts on a tree that falls, whatever its motors do.
#[test]
fn only_weight_changes_the_momentum_of_what_falls_freely() {
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
        let rate = slope(|t| {
            centroidal_momentum(&tree, &later(&tree, &state, t), &())
                .ang
                .to_array()
        });
        worst.see(rate, [0.0; 3]);
    }
    let mut verdict = Verdict::default();
    verdict.see("mixed tree", "rate of momentum", "f64", &worst);
    verdict.speak();
}
