//! Limits, configurations and motions with which the tests of several modules begin.

use dynamics_core::scalar::Real;
use dynamics_core::state::State;

use crate::{estimate::*, limits::*, motion::*, reference::*, safety::*};

pub(crate) const fn motion_limits<R: Copy>(velocity: R, acceleration: R) -> MotionLimits<R> {
    MotionLimits { velocity, acceleration }
}

pub(crate) const fn estimate_of<R: Copy, const V: usize>(q: [R; V], qd: [R; V]) -> Estimate<R, V> {
    Estimate { q, qd }
}

/// A way-point at rest.
pub(crate) fn stop<R: Real, const V: usize>(q: [R; V], ticks: u32) -> WayPoint<R, V> {
    let qd = [R::ZERO; V];
    WayPoint { q, qd, ticks }
}

pub(crate) const fn safety_limits<R: Copy, const V: usize>(
    torque: [R; V],
    rate: [R; V],
    speed: [R; V],
    lower: [R; V],
    upper: [R; V],
) -> SafetyLimits<R, V> {
    SafetyLimits { torque, rate, speed, lower, upper }
}

/// The ticks of the ride-through, of the hold and of the reentry; encoders without steps.
pub(crate) const fn supervised<R: Real, const V: usize>(
    limits: SafetyLimits<R, V>,
    tick: R,
    ticks: [u32; 3],
) -> SupervisorConfig<R, V> {
    SupervisorConfig {
        limits,
        tick,
        resolution: R::ZERO,
        ride_through_ticks: ticks[0],
        hold_ticks: ticks[1],
        reentry_ticks: ticks[2],
    }
}

/// The last numbers are the bandwidth of the observer, the rate of the decay and the restart
/// distance.
pub(crate) const fn controlled<R: Real, const V: usize>(
    limits: SafetyLimits<R, V>,
    tick: R,
    ticks: [u32; 3],
    numbers: [R; 3],
) -> MotionControllerConfig<R, V> {
    MotionControllerConfig {
        supervisor: supervised(limits, tick, ticks),
        observer_bandwidth: numbers[0],
        decay_rate: numbers[1],
        restart_distance: numbers[2],
    }
}

/// The command of a tick of the full law without a fault.
pub(crate) const fn full_command<R: Copy, const V: usize>(
    torque: [R; V],
    brake: bool,
) -> Command<R, V> {
    let status = Status { mode: Mode::Full, fault: None, limited: false };
    Command { torque, brake, status }
}

/// A motion without an end, by a function of the tick.
pub(crate) struct Motion<F>(pub(crate) F);

impl<R, const V: usize, F: Fn(u32) -> State<R, V, V>> Reference<R, V> for Motion<F> {
    fn at(&self, tick: u32) -> State<R, V, V> {
        self.0(tick)
    }
    fn ticks(&self) -> u32 {
        u32::MAX
    }
}

/// The parameter that a check refuses, if it refuses one.
pub(crate) fn refused<T>(checked: Result<T, ConfigError>) -> Option<ConfigParameter> {
    match checked {
        Err(ConfigError::OutOfRange { parameter }) => Some(parameter),
        _ => None,
    }
}

/// Uniform numbers.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
    pub(crate) fn within(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.next()
    }
    pub(crate) fn log(&mut self, least: f64, most: f64) -> f64 {
        least * (most / least).powf(self.next())
    }
}
