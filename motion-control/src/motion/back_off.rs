//! The return of an arm that is beyond a bound of its positions.

use crate::estimate::{Estimate, Observer};
use crate::limits::MotionLimits;
use crate::limits::{Command, Fault, Mode};
use crate::motion::approach::{least_seconds, path};
use crate::motion::{ApproachError, MeasurementAge, MotionController, ResetError};
use crate::reference::Trajectory;
use crate::safety::StopCategory;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

#[cfg(test)]
mod tests;

/// The parameters of a [`BackOff`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BackOffConfig<R> {
    /// Greatest speed and acceleration of the path back, of all joints.
    pub limits: MotionLimits<R>,
    /// The distance from its bound at which a joint ends, rad or m.
    pub margin: R,
}

/// Leads an arm that stands beyond its bounds back, at a low speed.
///
/// While a joint is beyond its bound:
///
/// - positions are accepted up to the innermost one so far and the plausible step of one tick;
///   further out, the arm is stopped in the same tick by [`Fault::Position`], without ride-through;
/// - torques that point outward are limited to τ_max v/v_max, where v is the speed at which the
///   joint moves inward: they brake it, and are zero at rest;
/// - the reference moves inward only, and never further out than the joint is.
///
/// Outside of [`Self::tick`] the configured bounds apply: another tick of the controller stops the
/// arm. At the end the arm is held by a stop of category 2; [`MotionController::approach`] and
/// [`MotionController::reset`] lead on.
///
/// ```
/// use motion_control::{limits::*, motion::*, reference::*, safety::*};
/// # let bounds = SafetyLimits { torque: [10.0], rate: [10.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
/// # let config = MotionControllerConfig {
/// #     supervisor: SupervisorConfig {
/// #         limits: bounds,
/// #         tick: 1e-3, resolution: 0.0, ride_through_ticks: 2, hold_ticks: 3, reentry_ticks: 10,
/// #     },
/// #     observer_bandwidth: 250.0, decay_rate: 25.0, restart_distance: 0.1,
/// # };
/// # let point = |q, ticks| WayPoint { q: [q], qd: [0.0], ticks };
/// # let limits = [MotionLimits { velocity: 3.0, acceleration: 10.0 }];
/// # let motion = Trajectory::new(&[point(0.0, 0), point(0.5, 1000)], 1e-3, &limits)?;
/// let mut controller = MotionController::<f64, 1>::try_new(config)?.on_brake();
/// let mut q = 1.2; // the upper bound is 1
/// controller.tick(Ok(&[q]), &motion, |_, _| [0.0]);
/// assert_eq!(controller.reset(&motion), Err(ResetError::OutOfBounds { joint: 0 }));
///
/// let slow = MotionLimits { velocity: 0.5, acceleration: 2.0 };
/// let mut back_off = BackOff::start(&mut controller, &BackOffConfig { limits: slow, margin: 0.05 })?;
/// while !back_off.is_done() {
///     let command = back_off.tick(&mut controller, Ok(&[q]), |_, _| [0.0]);
///     assert_eq!(command.status.fault, None);
///     q = controller.reference().q[0]; // a joint that follows
/// }
/// assert!((q - 0.95).abs() < 1e-3);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "joint limit recovery")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BackOff<R, const V: usize> {
    path: Trajectory<R, V, 2>,
    /// The goal of each joint, and the range in which it is accepted.
    goal: [R; V],
    bounds: [[R; 2]; V],
    configured: [[R; 2]; V],
    /// 1 beyond the greatest position, −1 beyond the least, 0 within them.
    outward: [R; V],
    velocity: R,
    /// The speeds of the joints without the acceleration of the reference, which a blocked joint
    /// does not have.
    speeds: Observer<R, V>,
    tick: u32,
    done: bool,
}

impl<R: Real, const V: usize> BackOff<R, V> {
    /// Plans the path back of a stopped arm from its measured position, and starts the arm.
    ///
    /// # Errors
    /// [`ApproachError`]; the controller is then unchanged.
    pub fn start<A: MeasurementAge>(
        controller: &mut MotionController<R, V, A>,
        config: &BackOffConfig<R>,
    ) -> Result<Self, ApproachError> {
        if !matches!(controller.mode(), Mode::Stopped) {
            return Err(ApproachError::Reset(ResetError::NotStopped));
        }
        if !controller.measured() {
            return Err(ApproachError::Reset(ResetError::NoMeasurement));
        }
        let from = controller.estimate().q;
        let configured = controller.supervisor.bounds();
        let (mut goal, mut outward, mut bounds) = (from, [R::ZERO; V], configured);
        let mut seconds = R::ZERO;
        let joints = goal.iter_mut().zip(&mut outward).zip(bounds.iter_mut().zip(&from));
        let steps = controller.supervisor.plausible_step();
        for (joint, (((goal, side), (bounds, &from)), &step)) in joints.zip(steps).enumerate() {
            let [lower, upper] = *bounds;
            let middle = R::from_f64(0.5) * lower + R::from_f64(0.5) * upper;
            if from > upper {
                *side = R::ONE;
                *goal = (upper - config.margin).clamped(middle, upper);
                *bounds = [lower, from + step];
            } else if from < lower {
                *side = -R::ONE;
                *goal = (lower + config.margin).clamped(lower, middle);
                *bounds = [from - step, upper];
            }
            let least = least_seconds(joint, (*goal - from).abs(), &config.limits)?;
            seconds = if least > seconds { least } else { seconds };
        }
        let limits = [config.limits; V];
        let path = path(from, goal, seconds, controller.observer.tick(), &limits)?;
        let mut speeds = controller.observer;
        speeds.reset(&from);
        controller.restart();
        Ok(Self {
            path,
            goal,
            bounds,
            configured,
            outward,
            velocity: config.limits.velocity,
            speeds,
            tick: 0,
            done: false,
        })
    }

    /// Runs one tick of the controller, as [`MotionController::tick`]; the reference is that of the
    /// path back.
    ///
    /// A command in [`Mode::Stopped`] ends the return: start another one.
    pub fn tick<A: MeasurementAge>(
        &mut self,
        controller: &mut MotionController<R, V, A>,
        measured: Result<&[R; V], Fault>,
        law: impl FnOnce(&State<R, V, V>, &Estimate<R, V>) -> [R; V],
    ) -> Command<R, V> {
        let clock = controller.clock;
        let before = controller.supervisor.replace_bounds(&self.bounds);
        let limit = *controller.supervisor.torque_limit();
        let turned;
        let measured = match measured {
            Ok(q) if A::ON_CIRCLES => {
                turned = controller.turn_to(q);
                self.speeds.turn_to(A::CIRCLES, &turned);
                Ok(&turned)
            }
            other => other,
        };
        let observed = controller.observe(measured);
        let reference = self.reference(observed.estimate());
        let mut tick = observed.reference(&reference);
        if let Some(joint) = measured.ok().and_then(|q| self.further_out(q)) {
            tick.stop(Fault::Position { joint });
        }
        let mut tau = law(tick.reference(), tick.estimate());
        self.limit_outward(&mut tau, &limit);
        let command = tick.command(&tau);
        controller.supervisor.restore_bounds(before);
        controller.clock = clock;
        let last = self.speeds.estimate().q;
        match measured {
            Ok(q) if controller.supervisor.measurement_accepted() => self.speeds.follow(q),
            _ => self.speeds.reset(&last),
        }
        if let (Ok(q), None) = (measured, command.status.fault) {
            self.follow(q, controller.supervisor.plausible_step());
            self.tick = self.tick.saturating_add(u32::from(!command.brake));
            let joint = self.outward.iter().position(|side| side.abs() > R::ZERO).unwrap_or(0);
            self.done |= (self.tick > self.path.ticks()) & self.inside(q);
            if self.done {
                controller.stop_by(Fault::Position { joint }, StopCategory::ControlledHold);
            }
        }
        command
    }

    /// Whether every joint is within its bounds and the arm is held there.
    pub fn is_done(&self) -> bool {
        self.done
    }

    fn reference(&self, estimate: &Estimate<R, V>) -> State<R, V, V> {
        let mut state = self.path.at(self.tick);
        let joints = state.q.iter_mut().zip(&estimate.q);
        for ((q, &measured), (&side, &goal)) in joints.zip(self.outward.iter().zip(&self.goal)) {
            if side * (*q - measured) > R::ZERO {
                // The joint is ahead: the reference does not lead it out again.
                *q = if side * (measured - goal) > R::ZERO { measured } else { goal };
            }
        }
        state
    }

    /// The first joint that is further out than it was.
    fn further_out(&self, q: &[R; V]) -> Option<usize> {
        let mut joints = q.iter().zip(&self.bounds);
        joints.position(|(&q, &[lower, upper])| q < lower || q > upper)
    }

    fn inside(&self, q: &[R; V]) -> bool {
        let mut joints = q.iter().zip(&self.configured);
        joints.all(|(&q, &[lower, upper])| lower <= q && q <= upper)
    }

    /// The bounds come back with the joints.
    fn follow(&mut self, q: &[R; V], steps: &[R; V]) {
        let joints = self.bounds.iter_mut().zip(&self.configured).zip(q.iter().zip(steps));
        for (([lower, upper], &[least, greatest]), (&q, &step)) in joints {
            let (low, high) = (q - step, q + step);
            *lower = if low > *lower { low } else { *lower };
            *lower = if *lower > least { least } else { *lower };
            *upper = if high < *upper { high } else { *upper };
            *upper = if *upper < greatest { greatest } else { *upper };
        }
    }

    fn limit_outward(&self, tau: &mut [R; V], limit: &[R; V]) {
        let estimate = self.speeds.estimate();
        let states = estimate.q.iter().zip(&estimate.qd).zip(&self.configured);
        let joints = tau.iter_mut().zip(&self.outward).zip(states.zip(limit));
        for ((tau, &side), (((&q, &qd), &[lower, upper]), &limit)) in joints {
            let beyond = if side > R::ZERO { q > upper } else { q < lower };
            let inward = (-(side * qd) / self.velocity).clamped(R::ZERO, R::ONE);
            let most = limit * inward;
            if (side.abs() > R::ZERO) & beyond & (side * *tau > most) {
                *tau = side * most;
            }
        }
    }
}
