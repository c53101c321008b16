//! Claims about the power of the compensation, walls, locks, and numbers that are not finite.

use super::*;
use dynamics_core::effects::smooth_sign;

mod limits;
mod numbers;

const BAD: [f64; 4] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX];

fn spring<R, const V: usize>(
    stiffness: [R; V],
    damping: [R; V],
    torque: [R; V],
) -> LimitedSpring<R, V> {
    LimitedSpring { stiffness, damping, torque }
}

fn no_brake<const V: usize>() -> SpeedBrake<f64, V> {
    SpeedBrake { speed: [f64::INFINITY; V], damping: [0.0; V], torque: [0.0; V] }
}

fn config() -> HandGuidingConfig<f64, 1> {
    let spring = spring([200.0], [20.0], [10.0]);
    HandGuidingConfig {
        error: 0.1,
        share: 1.0 / 1.1,
        rest_speed: [1e-3],
        compensation: [12.0],
        damping: [0.0],
        brake: no_brake(),
        lower: [-1.0],
        upper: [1.0],
        wall: spring,
        lock: spring,
    }
}

/// The whole friction is compensated.
fn full() -> HandGuidingConfig<f64, 1> {
    let mut config = config();
    (config.share, config.error) = (1.0, 0.0);
    config
}

fn guiding(config: HandGuidingConfig<f64, 1>) -> HandGuiding<f64, 1> {
    HandGuiding::try_new(config).expect("a good one")
}

fn torque(guiding: &HandGuiding<f64, 1>, q: f64, qd: f64, friction: f64, error: f64) -> f64 {
    let estimate = Estimate { q: [q], qd: [qd] };
    let [tau] = guiding.torque(&estimate, &[friction], &[error]);
    tau
}

/// Viscous and Coulomb friction whose sign has a width, N·m.
fn friction(qd: f64, width: f64) -> f64 {
    8.0 * smooth_sign(qd / width) + 12.0 * qd
}

/// From ±10⁻⁷ to ±1 rad/s.
fn velocities() -> impl Iterator<Item = f64> {
    (0..=700).flat_map(|k| [1.0, -1.0].map(|sign| sign * 10f64.powf(0.01 * f64::from(k) - 7.0)))
}

/// Signs as wide as that of the model, and steeper, rad/s.
const WIDTHS: [f64; 4] = [0.01, 0.003, 1e-4, 1e-9];

/// The greatest power of compensation and true friction with such signs, W, where the model exceeds
/// it by `over`.
fn power(config: HandGuidingConfig<f64, 1>, over: f64, widths: &[f64]) -> f64 {
    let (guiding, mut most) = (guiding(config), f64::NEG_INFINITY);
    for qd in velocities() {
        for &width in widths {
            let (modelled, real) = (friction(qd, 0.01), friction(qd, width) / (1.0 + over));
            most = most.max((torque(&guiding, 0.0, qd, modelled, 0.0) - real) * qd);
        }
    }
    most
}

#[test]
fn compensation_and_true_friction_together_never_have_positive_power() {
    for over in [-0.5, -0.1, 0.0, 0.05, 0.1] {
        let most = power(config(), over, &WIDTHS);
        assert!(most <= 1e-15, "{most} W, over-estimated by {over}");
    }
    // With a model that is further off than stated, or has a steeper sign than the friction, it is
    // positive.
    assert!(power(config(), 0.12, &WIDTHS) > 0.01);
    assert!(power(config(), 0.1, &[0.05]) > 0.01);
    assert!(power(full(), 0.1, &WIDTHS) > 0.1);
}

#[test]
fn a_lagging_observer_keeps_the_compensation_passive() {
    use crate::estimate::{Observer, ObserverConfig};
    let (tick, bandwidth) = (1e-3, 30.0);
    // The energy that compensation and true friction have absorbed together by the end of each
    // tick, J.
    let least = |config, over: f64, omega: f64| {
        let guiding = guiding(config);
        let mut observer = Observer::try_new(ObserverConfig { bandwidth, tick }).expect("good");
        let (mut q, mut absorbed, mut least) = (0.0, 0.0, 0.0_f64);
        for k in 0..5000 {
            let qd = 0.2 * (omega * tick * f64::from(k)).sin();
            let estimate = *observer.update_delayed(&[q], &[0.0]);
            let [tau] = guiding.torque(&estimate, &[friction(estimate.qd[0], 0.01)], &[0.0]);
            absorbed += (friction(qd, 1e-9) / (1.0 + over) - tau) * qd * tick;
            q += qd * tick;
            least = least.min(absorbed);
        }
        least
    };
    for omega in [1.0, 5.0, 20.0, 100.0] {
        assert!(least(config(), 0.1, omega) > -1e-4, "{omega} rad/s");
    }
    assert!(least(full(), 0.1, 5.0) < -0.1);
}

// It is an error of the other torques.
#[test]
fn an_error_within_the_stated_one_adds_no_power() {
    let (guiding, error) = (guiding(config()), 1.5);
    for qd in velocities() {
        let real = friction(qd, 1e-9) / 1.1;
        let tau = torque(&guiding, 0.0, qd, friction(qd, 0.01), error);
        assert!((tau + error * qd.signum() - real) * qd <= 1e-15, "{qd} rad/s");
        // Beyond, the compensation is at its limit.
        if (0.01..0.3).contains(&qd.abs()) {
            let without = torque(&guiding, 0.0, qd, friction(qd, 0.01), 0.0);
            let excess = (without + error * qd.signum() - real) * qd;
            assert!(excess > 0.0, "{qd} rad/s");
        }
    }
}

// They push back up to their torque.
#[test]
fn walls_only_push_and_damp_inward_motion() {
    let guiding = guiding(config());
    let wall = |q, qd| torque(&guiding, q, qd, 0.0, 0.0);
    for side in [1.0, -1.0] {
        for depth in [-0.1, -1e-9, 1e-9, 0.01, 0.04, 0.3] {
            for inward in [-10.0, -0.1, 0.0, 0.1, 10.0] {
                let push = -side * wall(side * (1.0 + depth), side * inward);
                let damper = 20.0 * f64::max(inward, 0.0);
                let off = push - (200.0 * depth + damper).clamp(0.0, 10.0);
                assert!(off.abs() < 1e-6, "{depth} {inward}");
            }
        }
    }
    let mut open = config();
    (open.lower, open.upper) = ([f64::NEG_INFINITY], [f64::INFINITY]);
    let open = HandGuiding::try_new(open).expect("a good one");
    assert_eq!(torque(&open, 1e3, 1.0, 0.0, 0.0), 0.0);
}

#[test]
fn torques_are_finite_and_limited_whatever_the_arguments_are() {
    let mut guiding = guiding(config());
    for lock in [false, true] {
        guiding.lock(&[lock], &[0.99]).expect("finite");
        for bad in BAD {
            for [q, qd, friction, error] in [
                [bad, 0.1, 8.0, 0.0],
                [1.02, bad, 8.0, 0.0],
                [0.0, 0.1, bad, 0.0],
                [0.0, 0.1, 8.0, bad],
                [bad; 4],
            ] {
                let tau = torque(&guiding, q, qd, friction, error);
                assert!(tau.abs() <= 22.0, "{tau} of {q} {qd} {friction} {error}");
            }
        }
    }
    guiding.lock(&[false], &[0.0]).expect("finite");
    let wrong = torque(&guiding, 0.0, 0.1, -8.0, 0.0);
    let [velocity, friction, error] = [
        torque(&guiding, 0.0, f64::NAN, 8.0, 0.0),
        torque(&guiding, 0.0, 0.1, f64::NAN, 0.0),
        torque(&guiding, 0.0, 0.1, 8.0, f64::NAN),
    ];
    assert_eq!([velocity, friction, error, wrong], [0.0; 4]);
    // A wall remains without a velocity.
    assert!((torque(&guiding, 1.02, f64::NAN, f64::NAN, 0.0) + 4.0).abs() < 1e-9);
}
