//! Data that firmware keeps in flash roundtrips exactly, and invalid data is refused.

use dynamics_core::effects::{
    Armature, AsymmetricCoulomb, Cogging, ConstantTorque, Coulomb, EndStops, LoadFriction, Lugre,
    Payload, PreslidingLoadFriction, Spring, Stribeck, Viscous, Width,
};
use dynamics_core::glam::Mat3;
use dynamics_core::model::{BodyInertia, JointLimits};
use dynamics_core::spatial::SpatialInertia;
use dynamics_core::state::State;
use motion_control::estimate::{
    ObserverConfig, ParameterEstimatorConfig, PayloadEstimatorConfig, TipWrenchConfig,
};
use motion_control::law::{
    AccelerationGains, BreakawayConfig, Gains, HandGuidingConfig, ImpedanceConfig,
    InertiaShapingConfig, LimitedSpring, PassivityGains, SpeedBrake,
};
use motion_control::limits::{MotionLimits, SafetyLimits};
use motion_control::motion::MotionControllerConfig;
use motion_control::reference::WayPoint;
use motion_control::safety::{SupervisorConfig, ThermalConfig, ThermalState};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Writes a value and reads it again.
fn comes_back<T: Serialize + DeserializeOwned + PartialEq + std::fmt::Debug>(value: T) {
    let text = serde_json::to_string(&value).expect("a value that JSON has");
    let read: T = serde_json::from_str(&text).expect("what was written");
    assert_eq!(read, value, "{text}");
}

/// Why a text is not read as a T.
fn refusal<T: DeserializeOwned + std::fmt::Debug>(text: &str) -> String {
    serde_json::from_str::<T>(text).expect_err("not a T").to_string()
}

const LIMITS: SafetyLimits<f32, 2> = SafetyLimits {
    torque: [10.1, 20.2],
    rate: [1.0, 3.4e38],
    speed: [3.3, 1e-30],
    lower: [-1.1, -2.2],
    upper: [1.1, 2.2],
};
const CONFIG: MotionControllerConfig<f32, 2> = MotionControllerConfig {
    supervisor: SupervisorConfig {
        limits: LIMITS,
        tick: 1e-3,
        resolution: 3.8e-4,
        ride_through_ticks: 5,
        hold_ticks: 100,
        reentry_ticks: 200,
    },
    observer_bandwidth: 250.1,
    decay_rate: 25.1,
    restart_distance: 0.15,
};
const THIRDS: [f32; 2] = [1.0 / 3.0, -2.0 / 3.0];

fn inertia() -> SpatialInertia<f32> {
    Payload::<f32, 0>::from_inertia(BodyInertia {
        mass: 1.7,
        com: [0.1, -0.2, 0.3],
        inertia: [0.4, 0.01, 0.02, 0.5, 0.03, 0.6],
    })
    .0
}

#[test]
fn controller_configurations_roundtrip_bit_by_bit() {
    let [a, b] = [THIRDS, [1e-30, 3.4e38]];
    comes_back(LIMITS);
    comes_back(CONFIG.supervisor);
    comes_back(CONFIG);
    comes_back(ObserverConfig { bandwidth: 250.1_f32, tick: 1e-3 });
    comes_back(Gains { kp: a, kd: b });
    comes_back(AccelerationGains { kp: a, kd: b });
    comes_back(PassivityGains { lambda: a, kd: b });
    comes_back(ImpedanceConfig { stiffness: LIMITS.torque, zeta: 0.7, slowest: 2.1 });
    let positive = THIRDS.map(f32::abs);
    comes_back(TipWrenchConfig { noise: positive, force: 30.1, couple: 0.0 });
    comes_back(PayloadEstimatorConfig {
        noise: positive,
        prior: [0.3; 10],
        forgetting: 1e-3,
        limit: 5.1,
    });
    comes_back(ParameterEstimatorConfig {
        noise: positive,
        prior: [0.1, 0.2, 0.3],
        own: [2, 1],
        forgetting: 1e-3,
        limit: 5.1,
    });
    let spring = LimitedSpring { stiffness: positive, damping: [0.1, 0.2], torque: [0.3, 0.4] };
    comes_back(HandGuidingConfig {
        error: 0.1,
        share: 0.9,
        rest_speed: positive,
        compensation: positive,
        damping: positive,
        brake: SpeedBrake { speed: [0.5, 0.6], damping: [0.7, 0.8], torque: [0.9, 1.1] },
        lower: [-1.0, -2.0],
        upper: positive,
        wall: spring,
        lock: spring,
    });
    comes_back(BreakawayConfig {
        tick: 2e-3,
        resolution: 1e-3,
        late: true,
        stiction: positive,
        push: 0.3,
        dither: 0.7,
        window: 20,
        push_ticks: 100,
        dither_ticks: 6,
        energy: positive,
        friction: positive,
        share: 0.9,
        speed: positive,
    });
    comes_back(InertiaShapingConfig {
        amplification: 0.7,
        dead_band: positive,
        damping: positive,
        torque: positive,
    });
    comes_back(ThermalConfig {
        tick: 1e-3,
        continuous: positive,
        peak: positive,
        winding_time: [12.0, 13.0],
        housing_time: [600.0, 700.0],
        share: [0.4, 1.0],
        hottest: [120.0, 155.0],
        ambient: 40.0,
    });
    comes_back(ThermalState { winding: a, housing: positive });
    comes_back(MotionLimits { velocity: a[0], acceleration: b[1] });
    comes_back(WayPoint { q: a, qd: b, ticks: u32::MAX });
    comes_back(State { q: [0.1_f64, 0.2, 0.3], qd: [0.4, 0.5], qdd: [0.6, 0.7] });
    comes_back(JointLimits { lower: a[0], upper: a[1], velocity: b[0], torque: b[1] });
}

#[test]
fn identified_parameters_roundtrip_bit_by_bit() {
    let [a, b] = [THIRDS, [0.25, 1e-7]];
    comes_back(inertia());
    comes_back(BodyInertia {
        mass: 1.7_f32,
        com: [0.1, -0.2, 0.3],
        inertia: [0.4, 0.01, 0.02, 0.5, 0.03, 0.6],
    });
    comes_back(Viscous(a));
    comes_back(ConstantTorque(a));
    comes_back(Armature(b));
    comes_back(Coulomb { torque: a, width: Width::new(0.05) });
    comes_back(AsymmetricCoulomb { forward: a, backward: b, width: Width::new(0.05) });
    comes_back(LoadFriction { driving: a, backdriving: b, width: Width::new(0.05) });
    comes_back(PreslidingLoadFriction { magnitude: a, torque: b, deflection: a, direction: b });
    comes_back(Stribeck { excess: a, stribeck_speed: Width::new(0.1), width: Width::new(0.007) });
    comes_back(Lugre {
        stiffness: LIMITS.torque,
        damping: b,
        viscous: a,
        sliding: b,
        excess: a,
        stribeck_speed: Width::new(0.1),
        bristle: b,
    });
    comes_back(Cogging { per_turn: a, cos: [[0.1, 0.2, 0.3]; 2], sin: [[0.4, 0.5, 0.6]; 2] });
    comes_back(Spring { stiffness: LIMITS.torque, rest: b });
    comes_back(EndStops {
        lower: a,
        upper: b,
        stiffness: 1e4,
        damping: 10.0,
        damping_depth: Width::new(3e-3),
    });
}

#[test]
fn arrays_of_40_joints_roundtrip() {
    let values: [f32; 40] = std::array::from_fn(|i| i as f32);
    comes_back(Viscous(values));
}

#[test]
fn numbers_of_another_robot_are_refused() {
    let text = serde_json::to_string(&Viscous([1.0_f32, 2.0])).expect("two numbers");
    assert!(refusal::<Viscous<f32, 3>>(&text).contains("invalid length 2"));
    assert!(refusal::<Viscous<f32, 1>>(&text).contains("invalid length 2"));
}

#[test]
fn a_field_that_is_missing_or_unknown_is_refused() {
    assert!(refusal::<Gains<f32, 1>>(r#"{"kp": [1.0]}"#).contains("missing field `kd`"));
    let unknown = r#"{"kp": [1.0], "kd": [1.0], "ki": [1.0]}"#;
    assert!(refusal::<Gains<f32, 1>>(unknown).contains("unknown field `ki`"));
}

#[test]
fn bounds_that_allow_nothing_are_refused_as_they_are_read() {
    let negative = SafetyLimits { torque: [10.0, -10.0], ..LIMITS };
    let text = serde_json::to_string(&negative).expect("bounds");
    assert!(refusal::<SafetyLimits<f32, 2>>(&text).contains("joint 1: its torque limit"));
    let mut config = CONFIG;
    config.observer_bandwidth = -1.0;
    let text = serde_json::to_string(&config).expect("a configuration");
    assert!(
        refusal::<MotionControllerConfig<f32, 2>>(&text)
            .contains("the bandwidth of the observer is not a positive number")
    );
}

#[test]
fn a_rotational_inertia_is_six_numbers_and_thus_symmetric() {
    let text = serde_json::to_string(&inertia()).expect("an inertia");
    let read: SpatialInertia<f32> = serde_json::from_str(&text).expect("the same");
    assert_eq!(read.rotational, Mat3::transpose(&read.rotational));
    let nine = r#"{"mass": 1.0, "moment": [0, 0, 0], "inertia": [1, 0, 0, 0, 1, 0, 0, 0, 1]}"#;
    refusal::<SpatialInertia<f32>>(nine);
}
