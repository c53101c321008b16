//! Speed limits, and walls that stop a joint from every speed up to its limit.

use super::*;
use crate::estimate::{Observer, ObserverConfig};
use crate::limits::{ConfigParameter, LimitKind, SafetyLimitsError};
use crate::tests::refused;
use dynamics_core::model::JointLimits;

/// A joint of a shoulder: 1 rad to both sides, 1.5 rad/s.
const JOINT: JointLimits<f64> =
    JointLimits { lower: -1.0, upper: 1.0, velocity: 1.5, torque: 150.0 };
const HEAVY: f64 = 16.0; // kg·m²
const BANDWIDTH: f64 = 30.0; // rad/s, of the observer
const TICK: f64 = 1e-3;
const STEP: f64 = core::f64::consts::TAU / 16_384.0;

fn from_limits(
    joint: JointLimits<f64>,
    inertia: f64,
) -> Result<HandGuidingConfig<f64, 1>, ConfigError> {
    HandGuidingConfig::from_limits([joint], &[inertia], BANDWIDTH)
}

/// The furthest position and the greatest torque of a joint without friction that a hand has let
/// go, measured by encoders with an observer, or exactly.
fn coasts(
    config: HandGuidingConfig<f64, 1>,
    m: f64,
    [from, speed]: [f64; 2],
    exact: bool,
) -> [f64; 2] {
    let guiding = guiding(config);
    let mut observer =
        Observer::try_new(ObserverConfig { bandwidth: BANDWIDTH, tick: TICK }).expect("good");
    let measure = |q: f64| (q / STEP).round() * STEP;
    let (mut q, mut qd) = (from, speed);
    // The observer has followed the hand.
    for k in -500..0 {
        observer.update_delayed(&[measure(q + speed * TICK * f64::from(k))], &[0.0]);
    }
    let (mut measured, mut furthest, mut most) = (measure(q), from, 0.0_f64);
    for _ in 0..5000 {
        let estimate =
            *observer.update_delayed(&[core::mem::replace(&mut measured, measure(q))], &[0.0]);
        let estimate = if exact { Estimate { q: [q], qd: [qd] } } else { estimate };
        let [tau] = guiding.torque(&estimate, &[0.0], &[0.0]);
        qd += TICK * tau / m;
        q += TICK * qd;
        (furthest, most) = (f64::max(furthest, q), most.max(tau.abs()));
    }
    [furthest, most]
}

#[test]
fn a_wall_stops_every_inertia_from_every_speed_inside_the_bounds() {
    let config = from_limits(JOINT, HEAVY).expect("good limits");
    let undamped = HandGuidingConfig { damping: [0.0], brake: no_brake(), ..config };
    let late = |speed: f64| speed * config.wall.damping[0] / config.wall.stiffness[0];
    let (mut overshoot, mut through) = (f64::NEG_INFINITY, 0.0_f64);
    for m in [HEAVY, 0.5 * HEAVY, 0.25 * HEAVY] {
        for tenth in 1..=15 {
            let speed = 0.1 * f64::from(tenth);
            let from = (0.95 - late(speed)).max(-0.9) - 0.05;
            let [furthest, torque] = coasts(undamped, m, [from, speed], true);
            assert!(furthest <= 0.95 + 1e-9, "{m} kg·m² at {speed} rad/s: {furthest} rad");
            assert!(torque <= config.wall.torque[0]);
            let [furthest, _] = coasts(undamped, m, [from, speed], false);
            overshoot = overshoot.max(furthest - 0.95);
            // The spring of the same wall alone.
            let wall = LimitedSpring { damping: [0.0], ..undamped.wall };
            let [furthest, _] =
                coasts(HandGuidingConfig { wall, ..undamped }, m, [from, speed], true);
            through = through.max(furthest - 0.95);
        }
    }
    println!("{overshoot} rad by the observer's lag, {through} rad without the brake");
    assert!(overshoot <= 0.0, "{overshoot} rad");
    assert!(through > 0.2, "{through} rad");
}

#[test]
fn a_released_joint_coasts_for_a_second_and_a_fast_one_is_braked() {
    let wide = JointLimits { lower: -10.0, upper: 10.0, ..JOINT };
    let config = from_limits(wide, HEAVY).expect("good limits");
    let [way, _] = coasts(config, HEAVY, [0.0, 0.75], true);
    assert!((way - 0.75).abs() < 0.01, "{way} rad");
    let [fast, torque] = coasts(config, HEAVY, [0.0, 1.5], true);
    // The damping alone would take 1.5 rad.
    assert!((1.1..1.25).contains(&fast), "{fast} rad");
    assert!(torque <= 0.25 * JOINT.torque + HEAVY * 0.75);
    // A lock has neither.
    let mut locked = guiding(config);
    locked.lock(&[true], &[0.0]).expect("finite");
    assert_eq!(torque_of(&locked, 0.0), 0.0);
    let free = torque_of(&guiding(config), 0.5);
    assert_eq!(free, -HEAVY * 0.5);
    // The damping stays where the brake's torque has its limit.
    assert_eq!(torque_of(&guiding(config), 3.0), -(HEAVY * 0.75 + 37.5));
}

fn torque_of(guiding: &HandGuiding<f64, 1>, qd: f64) -> f64 {
    torque(guiding, 0.0, qd, 0.0, 0.0)
}

#[test]
fn limits_that_make_no_walls_are_refused_by_name() {
    let joint = 0;
    let endless = JointLimits { velocity: f64::INFINITY, ..JOINT };
    let refusal = SafetyLimitsError::Infinite { joint, of: LimitKind::Speed };
    assert_eq!(from_limits(endless, 1.0), Err(refusal.into()));
    let endless = JointLimits { torque: f64::INFINITY, ..JOINT };
    let refusal = SafetyLimitsError::Infinite { joint, of: LimitKind::Torque };
    assert_eq!(from_limits(endless, 1.0), Err(refusal.into()));
    let narrow = JointLimits { lower: 0.0, upper: 0.1, ..JOINT };
    assert_eq!(refused(from_limits(narrow, 1.0)), Some(ConfigParameter::WallPosition));
    let weak = JointLimits { torque: 0.0, ..JOINT };
    assert_eq!(refused(from_limits(weak, 1.0)), Some(ConfigParameter::Wall));
    let slow = JointLimits { velocity: 0.0, ..JOINT };
    assert_eq!(refused(from_limits(slow, 1.0)), Some(ConfigParameter::GuidingSpeed));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(refused(from_limits(JOINT, bad)), Some(ConfigParameter::Inertia));
        let config = HandGuidingConfig::from_limits([JOINT], &[1.0], bad);
        assert_eq!(refused(config), Some(ConfigParameter::Bandwidth));
    }
    // A weak motor makes a softer wall, whose torque still stops the joint.
    let weak = from_limits(JointLimits { torque: 20.0, ..JOINT }, HEAVY).expect("good limits");
    let [k, d] = [weak.wall.stiffness[0], weak.wall.damping[0]];
    assert!((d * d - 4.0 * k * HEAVY).abs() < 1e-9 * d * d);
    assert!((d * 1.5 * 0.5 / core::f64::consts::E - 10.0).abs() < 1e-9);
    // A joint that turns without an end has no walls.
    let endless = JointLimits { lower: f64::NEG_INFINITY, upper: f64::INFINITY, ..JOINT };
    assert_eq!(from_limits(endless, 1.0).map(|c| c.upper), Ok([f64::INFINITY]));
}
