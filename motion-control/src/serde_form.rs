//! serde's traits for the configurations that firmware stores in flash, for the feature `serde`:
//! their form is that of dynamics-core's.

use dynamics_core::scalar::Real;
use dynamics_core::serde_form::{Array, Form};
use dynamics_core::serde_record;

/// Types with a record of their own.
macro_rules! nested {
    ($($module:ident::$name:ident),+) => {$(
        impl<R: Real, const V: usize> Form<Self> for crate::$module::$name<R, V> {
            fn form(self) -> Self {
                self
            }
            fn of(form: Self) -> Self {
                form
            }
        }
    )+};
}

nested!(law::LimitedSpring, limits::SafetyLimits, law::SpeedBrake, safety::SupervisorConfig);

serde_record!(limits::SafetyLimits<R, V> {
    torque: Array<R, V>,
    rate: Array<R, V>,
    speed: Array<R, V>,
    lower: Array<R, V>,
    upper: Array<R, V>,
} check);
serde_record!(safety::SupervisorConfig<R, V> {
    limits: crate::limits::SafetyLimits<R, V>,
    tick: R,
    resolution: R,
    ride_through_ticks: u32,
    hold_ticks: u32,
    reentry_ticks: u32,
} check);
serde_record!(motion::MotionControllerConfig<R, V> {
    supervisor: crate::safety::SupervisorConfig<R, V>,
    observer_bandwidth: R,
    decay_rate: R,
    restart_distance: R,
} check);
serde_record!(estimate::ObserverConfig<R> { bandwidth: R, tick: R } check);
serde_record!(law::Gains<R, V> { kp: Array<R, V>, kd: Array<R, V> });
serde_record!(law::AccelerationGains<R, V> { kp: Array<R, V>, kd: Array<R, V> });
serde_record!(law::PassivityGains<R, V> { lambda: Array<R, V>, kd: Array<R, V> });
serde_record!(law::ImpedanceConfig<R, M> { stiffness: Array<R, M>, zeta: R, slowest: R } check);
serde_record!(estimate::TipWrenchConfig<R, V> { noise: Array<R, V>, force: R, couple: R });
serde_record!(estimate::PayloadEstimatorConfig<R, V> {
    noise: Array<R, V>,
    prior: Array<R, 10>,
    forgetting: R,
    limit: R,
} check);
serde_record!(estimate::ParameterEstimatorConfig<R, P, V> {
    noise: Array<R, V>,
    prior: Array<R, P>,
    own: Array<u16, V>,
    forgetting: R,
    limit: R,
} check);
serde_record!(law::LimitedSpring<R, V> {
    stiffness: Array<R, V>,
    damping: Array<R, V>,
    torque: Array<R, V>,
});
serde_record!(law::SpeedBrake<R, V> {
    speed: Array<R, V>,
    damping: Array<R, V>,
    torque: Array<R, V>,
});
serde_record!(law::HandGuidingConfig<R, V> {
    error: R,
    share: R,
    rest_speed: Array<R, V>,
    compensation: Array<R, V>,
    damping: Array<R, V>,
    brake: crate::law::SpeedBrake<R, V>,
    lower: Array<R, V>,
    upper: Array<R, V>,
    wall: crate::law::LimitedSpring<R, V>,
    lock: crate::law::LimitedSpring<R, V>,
} check);
serde_record!(law::BreakawayConfig<R, V> {
    tick: R,
    resolution: R,
    late: bool,
    stiction: Array<R, V>,
    push: R,
    dither: R,
    window: u32,
    push_ticks: u32,
    dither_ticks: u32,
    energy: Array<R, V>,
    friction: Array<R, V>,
    share: R,
    speed: Array<R, V>,
} check);
serde_record!(law::InertiaShapingConfig<R, V> {
    amplification: R,
    dead_band: Array<R, V>,
    damping: Array<R, V>,
    torque: Array<R, V>,
} check);
serde_record!(safety::ThermalConfig<R, V> {
    tick: R,
    continuous: Array<R, V>,
    peak: Array<R, V>,
    winding_time: Array<R, V>,
    housing_time: Array<R, V>,
    share: Array<R, V>,
    hottest: Array<R, V>,
    ambient: R,
} check);
serde_record!(safety::ThermalState<R, V> { winding: Array<R, V>, housing: Array<R, V> });
serde_record!(limits::MotionLimits<R> { velocity: R, acceleration: R });
serde_record!(reference::WayPoint<R, V> { q: Array<R, V>, qd: Array<R, V>, ticks: u32 });
