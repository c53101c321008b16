//! Singular postures, and numbers that are not finite.

use crate::impedance::plant::*;
use dynamics_core::algorithms::Conditioning;
use dynamics_core::model::Robot;
use dynamics_core::robots::Ur5e;
use glam::{DMat3, DVec3};
use motion_control::law::{CartesianImpedance, ImpedanceConfig};

/// The largest step of a torque between neighbours in a sweep through the stretched elbow, N·m.
fn largest_step(impedance: CartesianImpedance<f64, 6>, steps: i32) -> f64 {
    let (mut last, mut largest, mut damped) = (None, 0.0_f64, false);
    for k in -steps..=steps {
        let mut sprung = Sprung::at(Ur5e::MODEL, UR5E);
        let elbow = 0.3 * f64::from(k) / f64::from(steps);
        sprung.goal.pos += DVec3::new(0.3, 0.2, 0.4);
        sprung.goal.rot = DMat3::from_rotation_x(0.8) * sprung.goal.rot;
        sprung.impedance = impedance;
        sprung.posture.1 = 20.0;
        sprung.state.q = [0.2, -1.2, elbow, 0.3, 0.7, 0.1];
        sprung.state.qd = [0.3, 0.4, 1.0, -0.5, 0.2, 0.1];
        let (tau, how) = sprung.torque().unwrap();
        damped |= how != Conditioning::Regular;
        if let Some(last) = last.replace(tau) {
            let steps = tau.iter().zip(last).map(|(a, b): (&f64, f64)| (a - b).abs());
            largest = steps.fold(largest, f64::max);
        }
    }
    assert!(damped, "the sweep meets the singularity");
    largest
}

#[test]
fn the_torque_is_continuous_through_the_stretched_elbow() {
    let impedance = CartesianImpedance::try_new(CONFIG).unwrap();
    let [coarse, fine] = [200, 2000].map(|steps| largest_step(impedance, steps));
    // For a differentiable function, steps go to zero with the distance of the neighbours.
    assert!(fine < 0.15 * coarse, "{coarse} {fine}");
    // Without damping of the null space and of slow modes they do not.
    let config = ImpedanceConfig { slowest: 1e-9, ..CONFIG };
    let naive = CartesianImpedance::try_new(config).unwrap();
    let [coarse, fine] = [200, 2000].map(|steps| largest_step(naive, steps));
    assert!(fine > 0.5 * coarse, "{coarse} {fine}");
}

#[test]
fn the_damping_is_bounded_where_a_mode_has_no_frequency() {
    let impedance = CartesianImpedance::try_new(CONFIG).unwrap();
    let (d, how) = impedance.damping(&[[0.0; 6]; 6]);
    assert_eq!(how, Conditioning::Damped { smallest: 0.0 });
    let bound = 3.0 * CONFIG.zeta * STIFFNESS[5] / CONFIG.slowest;
    assert!((d[5][5] - bound).abs() < 1e-9, "{}", d[5][5]);
    // Nor does rounding of a singular mobility, here in f32, exceed the bound.
    let slow = CartesianImpedance::try_new(ImpedanceConfig {
        stiffness: STIFFNESS.map(|k| k as f32),
        zeta: 0.5,
        slowest: 1e-2,
    })
    .unwrap();
    for q4 in [0.0, 0.3, 0.6] {
        let task = Sprung::at(Ur5e::MODEL, [0.2, -1.2, 0.0, q4, 0.7, 0.1]).task();
        let (d, how) = slow.damping(&task.mobility.map(|row| row.map(|x| x as f32)));
        assert!(how != Conditioning::Regular);
        for i in 0..6 {
            let bound = 3.0 * 0.5 * STIFFNESS[i] / 1e-2;
            assert!(f64::from(d[i][i]) < bound * (1.0 + 1e-6), "{}", d[i][i]);
        }
    }
    let (d, how) = impedance.damping(&[[f64::NAN; 6]; 6]);
    assert!(d[0][0].is_nan() && how != Conditioning::Regular);
}
