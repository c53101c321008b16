//! Uncoupled joints, whose torques are known in closed form, and the configuration.

use super::*;
use crate::limits::ConfigParameter::{DampingRatio, SlowestMode, Stiffness};

const CONFIG: ImpedanceConfig<f64, 2> =
    ImpedanceConfig { stiffness: [400.0, 90.0], zeta: 0.75, slowest: 2.0 };

/// Inertias of three joints, kg·m², of which the last is not in the task.
const MASSES: [f64; 3] = [4.0, 0.5, 2.0];
/// The motion of each direction with its joint.
const LEVERS: [f64; 2] = [2.0, 0.5];

fn torque(
    config: ImpedanceConfig<f64, 2>,
    deviation: &TaskDeviation<f64, 2>,
    bias: [f64; 3],
    posture: [f64; 3],
) -> ImpedanceTorque<f64, 3> {
    let rows = [[LEVERS[0], 0.0, 0.0], [0.0, LEVERS[1], 0.0]];
    let solve = |tau: &[f64; 3]| core::array::from_fn(|i| tau[i] / MASSES[i]);
    let mut law = CartesianImpedance::try_new(config).expect("a good one");
    law.torque(&rows, solve, deviation, &bias, &posture).expect("finite")
}

#[test]
fn uncoupled_joints_have_their_own_springs_and_dampers() {
    let (position, velocity) = ([0.25, -0.5], [0.5, 2.0]);
    let deviation = TaskDeviation { position, velocity };
    let (bias, posture) = ([3.0, -2.0, 1.0], [7.0, 5.0, -4.0]);
    let got = torque(CONFIG, &deviation, bias, posture);
    for i in 0..2 {
        // Λ = m/j², D = 2 ζ √(K Λ), and all of the posture's torque acts on the task.
        let inertia = MASSES[i] / (LEVERS[i] * LEVERS[i]);
        let d = 2.0 * CONFIG.zeta * (CONFIG.stiffness[i] * inertia).sqrt();
        let force = CONFIG.stiffness[i] * position[i] + d * velocity[i];
        let want = bias[i] + LEVERS[i] * force;
        assert!((got.tau[i] - want).abs() < 1e-9, "{} {want}", got.tau[i]);
    }
    // The posture has the joint that the task does not move.
    assert!((got.tau[2] - (bias[2] + posture[2])).abs() < 1e-12);
    assert_eq!(got.conditioning, Conditioning::Regular);
    let law = CartesianImpedance::try_new(CONFIG).expect("a good one");
    let mobility = [0, 1].map(|i| {
        core::array::from_fn(|j| match i == j {
            true => LEVERS[i] * LEVERS[i] / MASSES[i],
            false => 0.0,
        })
    });
    let (d, how) = law.damping(&mobility);
    // 2 · 0.75 · √(400 · 1) and 2 · 0.75 · √(90 · 2).
    let want = [[30.0, 0.0], [0.0, 1.5 * 180.0_f64.sqrt()]];
    for (got, want) in d.as_flattened().iter().zip(want.as_flattened()) {
        assert!((got - want).abs() < 1e-9, "{d:?}");
    }
    assert_eq!(how, Conditioning::Regular);
}

#[test]
fn a_slow_mode_has_the_damping_of_the_tangent() {
    // Ω² = K/Λ: 400 and 45 rad²/s². Below ω_min, 1/Ω is (3/2 − Ω²/2 ω_min²)/ω_min.
    let slowest = 12.0;
    let config = ImpedanceConfig { slowest, ..CONFIG };
    let deviation = TaskDeviation { position: [0.0; 2], velocity: [0.0, 2.0] };
    let got = torque(config, &deviation, [0.0; 3], [0.0; 3]);
    let share = 45.0 / (slowest * slowest);
    let d = 2.0 * config.zeta * config.stiffness[1] * (1.5 - 0.5 * share) / slowest;
    let want = LEVERS[1] * d * 2.0;
    assert!((got.tau[1] - want).abs() < 1e-9, "{} {want}", got.tau[1]);
    let Conditioning::Damped { smallest } = got.conditioning else {
        panic!("a slow mode");
    };
    assert!((smallest - share).abs() < 1e-12, "{smallest}");
    let law = CartesianImpedance::try_new(config).expect("a good one");
    let (damping, how) = law.damping(&[[1.0, 0.0], [0.0, 0.5]]);
    assert!((damping[1][1] - d).abs() < 1e-9, "{damping:?}");
    let Conditioning::Damped { smallest } = how else {
        panic!("a slow mode");
    };
    assert!((smallest - share).abs() < 1e-12, "{smallest}");
}

#[test]
fn a_spring_that_is_none_is_refused_by_name() {
    type Change = fn(&mut ImpedanceConfig<f64, 2>, f64);
    let changes: [(Change, _); 4] = [
        (|c, x| c.stiffness[0] = x, Stiffness),
        (|c, x| c.stiffness[1] = x, Stiffness),
        (|c, x| c.zeta = x, DampingRatio),
        (|c, x| c.slowest = x, SlowestMode),
    ];
    assert_eq!(CONFIG.check(), Ok(()));
    for (change, parameter) in changes {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let mut config = CONFIG;
            change(&mut config, bad);
            let refused = ConfigError::OutOfRange { parameter };
            assert_eq!(config.check(), Err(refused), "{bad}");
            assert_eq!(CartesianImpedance::try_new(config), Err(refused), "{bad}");
        }
    }
}
