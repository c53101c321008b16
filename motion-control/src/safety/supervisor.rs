//! The safety gate that every measurement and every command passes, and the reaction to faults.
//!
//! ```text
//!          more than ride_through_ticks of fault   hold_ticks more
//!   Full ────────────────────────────────▶ Hold ───────────────▶ Stopped
//!    ▲                                      │                       │
//!    └──────────────────────────────────────┘ no fault              │
//!    ▲         authority() rises over reentry_ticks                 │
//!    └──────────────────────────────────────────────────────────────┘ reset()
//! ```
//!
//! [`StopCategory`] chooses what `Hold` and `Stopped` are for an arm. Ticks with a fault are counted until
//! `reentry_ticks` consecutive ticks had none. The state from tick to tick (last good positions, last torques, counters)
//! is updated only by accepted values. With limits that allow no motion or
//! torque (NaN, negative, an empty range), `try_new` returns an error and `new` a supervisor that keeps the arm
//! stopped.

use crate::limits::{Command, ConfigError, Fault, Mode, Status};
use crate::real;
use dynamics_core::scalar::Real;

mod bounds;
mod config;
mod gate;
mod reentry;
mod state;
mod stop;
mod stop_category;
#[cfg(test)]
mod tests;
mod tick;
mod transitions;

pub use config::SupervisorConfig;
use state::State;
pub use stop_category::StopCategory;
use stop_category::Stopping;
pub use tick::SupervisorTick;

/// The greatest plausible distance of a measurement from the last accepted one, in steps at full speed; the resolution
/// of the encoder is added. Speed itself is checked with the velocity of the observer.
const JUMP: f64 = 2.0;
/// Positions beyond this are as good as infinite, in f64 too.
const FAR: f64 = f32::MAX as f64;
/// Beyond this, rad, f32 has no sine accurate to 10⁻⁷: positions beyond it are rejected for all limits. For joints
/// without limits the angle within a turn is measured, `MultiTurnEncoder::within_turn` of `joint-drivers`.
const RANGE: f64 = 1e4;

/// The safety gate that every measurement and every torque passes in each tick: [`Self::tick`].
///
/// [`crate::MotionController`] contains one, with the rest of a loop's state.
///
/// ```
/// use motion_control::{Fault, Mode, SafetyLimits, Supervisor, SupervisorConfig};
/// let mut supervisor = Supervisor::try_new(SupervisorConfig {
///     limits: SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] },
///     tick: 1e-3,
///     resolution: 0.0,
///     ride_through_ticks: 1,
///     hold_ticks: 1,
///     reentry_ticks: 4,
/// })?;
/// // Not more than 8 N·m in one tick.
/// assert_eq!(supervisor.tick(Ok(&[0.5]), |_| [9.0]).torque, [8.0]);
///
/// // One bad measurement is ridden through.
/// let command = supervisor.tick(Ok(&[f32::NAN]), |tick| {
///     assert_eq!((tick.mode(), tick.last_good()), (Mode::Full, &[0.5]));
///     [9.0]
/// });
/// assert_eq!(command.status.fault, Some(Fault::NotFinite { joint: 0 }));
///
/// for (mode, torque, brake) in [(Mode::Hold, [5.0], false), (Mode::Stopped, [0.0], true)] {
///     let command = supervisor.tick(Err(Fault::Encoder { joint: 0 }), |_| [5.0]);
///     assert_eq!((command.status.mode, command.torque, command.brake), (mode, torque, brake));
/// }
/// # Ok::<(), motion_control::ConfigError>(())
/// ```
#[doc(alias = "watchdog")]
#[doc(alias = "safety gate")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Supervisor<R, const V: usize> {
    /// Greatest torque, its greatest change in a tick, and greatest speed.
    torque_limit: [R; V],
    rate_limit: [R; V],
    speed_limit: [R; V],
    /// Middle and half width of the range of positions.
    middle: [R; V],
    half: [R; V],
    /// Greatest plausible change of position in one tick.
    plausible_step: [R; V],
    /// Ticks since the last good position; very many before the first.
    ticks_since_good: R,
    ride_through_ticks: u32,
    hold_ticks: u32,
    reentry_ticks: u32,
    reentry_inv: R,

    last_good: [R; V],
    /// The positions of this tick were accepted.
    accepted: bool,
    /// Whether there is a last good position.
    known: bool,
    /// The last torque that was accepted.
    torque: [R; V],
    /// Ticks with a fault since `reentry_ticks` in a row had none.
    faults: u32,
    /// Ticks in a row without a fault, up to `reentry_ticks`.
    quiet: u32,
    /// Ticks of the full law since the last without it, up to `reentry_ticks`.
    ramp: u32,
    state: State,
    /// The first fault of this tick, or the one that stopped the arm.
    fault: Option<Fault>,
    /// There was a fault in this tick.
    faulted: bool,
    /// A tick has begun and has no torque yet.
    open: bool,
    /// The brake waits for the torque to be there after a reset.
    braked: bool,
    stopping: Stopping<R, V>,
    /// The fault of [`Self::report`] for the next tick.
    reported: Option<Fault>,
}

impl<R: Real, const V: usize> Supervisor<R, V> {
    /// A supervisor of an arm that holds its position, at full authority from the first tick; the torque rises from
    /// zero at the allowed rate. For an arm on its brake, use [`Self::on_brake`].
    ///
    /// A fault that lasts longer than `ride_through_ticks` and `hold_ticks` together, or recurs as often without
    /// `reentry_ticks` good ticks in between, stops the arm.
    ///
    /// ```
    /// use motion_control::{ConfigError, SafetyLimits, SafetyLimitsError, Supervisor, SupervisorConfig};
    /// let limits = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [1.0], upper: [-1.0] };
    /// let config = SupervisorConfig {
    ///     limits, tick: 1e-3, resolution: 0.0, ride_through_ticks: 0, hold_ticks: 1, reentry_ticks: 4,
    /// };
    /// let empty = SafetyLimitsError::Empty { joint: 0, lower: 1.0, upper: -1.0 };
    /// assert_eq!(Supervisor::try_new(config), Err(ConfigError::Limits(empty)));
    /// ```
    ///
    /// # Errors
    /// [`ConfigError`], as [`SupervisorConfig::check`].
    pub fn try_new(config: SupervisorConfig<R, V>) -> Result<Self, ConfigError> {
        config.check()?;
        Ok(Self::new(config))
    }

    /// As [`Self::try_new`], without the check: for constant configurations.
    ///
    /// If a limit allows no motion or torque ([`crate::SafetyLimits::check`]), the arm is stopped by [`Fault::Limits`],
    /// and a reset does not restart it. If the tick is not a positive number, no step of the joints is plausible; a
    /// resolution that is not a positive number is treated as zero.
    pub fn new(config: SupervisorConfig<R, V>) -> Self {
        let (limits, tick) = (&config.limits, config.tick);
        let unusable = limits.check().err().map(|error| Fault::Limits {
            joint: error.joint(),
        });
        // Comparisons with NaN are false, so that a limit of NaN allows nothing.
        let allowed = |x| if x > R::ZERO { x } else { R::ZERO };
        let finite = |x: R| if x.is_finite() { allowed(x) } else { R::ZERO };
        // Finite ends, so that what lies between them is finite.
        let (far, range) = (R::from_f64(FAR), R::from_f64(RANGE));
        let end = |x: R| {
            if x.abs() > range {
                x.clamped(-range, range)
            } else {
                x
            }
        };
        let (mut middle, mut half) = (limits.lower, limits.upper);
        for (lower, upper) in middle.iter_mut().zip(&mut half) {
            let [a, b] = [*lower, *upper].map(|x| R::from_f64(0.5) * end(x));
            (*lower, *upper) = (a + b, b - a);
        }
        let resolution = allowed(config.resolution);
        Self {
            torque_limit: limits.torque.map(finite),
            rate_limit: limits.rate.map(allowed),
            speed_limit: limits.speed,
            middle,
            half,
            plausible_step: limits
                .speed
                .map(|speed| R::from_f64(JUMP) * speed * tick + resolution),
            ticks_since_good: far,
            ride_through_ticks: config.ride_through_ticks,
            hold_ticks: config.hold_ticks,
            reentry_ticks: config.reentry_ticks,
            reentry_inv: R::ONE / real(config.reentry_ticks.max(1)),
            last_good: [R::ZERO; V],
            accepted: false,
            known: false,
            torque: [R::ZERO; V],
            faults: 0,
            quiet: config.reentry_ticks,
            ramp: config.reentry_ticks,
            state: match unusable {
                None => State::Full,
                Some(fault) => State::Unusable(fault),
            },
            fault: unusable,
            faulted: false,
            open: false,
            braked: false,
            stopping: Stopping::new(),
            reported: None,
        }
    }

    /// The same supervisor for an arm that is on its brake: stopped without a fault until [`Self::reset`].
    #[must_use]
    pub fn on_brake(mut self) -> Self {
        if matches!(self.state, State::Full) {
            self.state = self.stopping.stopped(self.stopping.configured);
        }
        self.ramp = 0;
        self
    }

    /// Whether any positions were accepted since the start or the last reset.
    #[inline(always)]
    pub(crate) fn knows_positions(&self) -> bool {
        self.known
    }

    /// Reports ticks that have passed without a call, as counted by a timer: the joints may have moved.
    ///
    /// Call it before [`Self::tick`], and [`crate::Observer::predict`] as many times for the estimate.
    /// [`crate::MotionController::missed`] does both.
    ///
    /// ```
    /// # use motion_control::{SafetyLimits, Mode, Supervisor, SupervisorConfig};
    /// # let limits = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let mut supervisor = Supervisor::try_new(SupervisorConfig {
    /// #     limits, tick: 1e-3, resolution: 0.0, ride_through_ticks: 0, hold_ticks: 1, reentry_ticks: 4,
    /// # })?;
    /// supervisor.tick(Ok(&[0.5]), |_| [0.0]);
    /// supervisor.missed(9); // 3 rad/s for 10 ms are no jump
    /// for (q, mode) in [([0.53], Mode::Full), ([0.56], Mode::Hold)] {
    ///     assert_eq!(supervisor.tick(Ok(&q), |_| [0.0]).status.mode, mode);
    /// }
    /// # Ok::<(), motion_control::ConfigError>(())
    /// ```
    #[cold]
    pub fn missed(&mut self, ticks: u32) {
        self.ticks_since_good += real(ticks);
    }

    /// Whether the positions of the last tick were accepted.
    #[inline(always)]
    pub fn measurement_accepted(&self) -> bool {
        self.accepted
    }

    /// The last positions that were accepted, rad or m; zeros before the first.
    #[inline(always)]
    pub fn last_good(&self) -> &[R; V] {
        &self.last_good
    }

    /// The greatest number of ticks for which a fault may last before the arm is stopped.
    pub(crate) fn longest_fault(&self) -> u32 {
        self.ride_through_ticks.saturating_add(self.hold_ticks)
    }

    /// The mode of the arm: that of the last tick, or of a stop since.
    #[inline(always)]
    pub fn mode(&self) -> Mode {
        self.state.mode()
    }
}
