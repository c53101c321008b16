//! The reaction of an arm to a contact: it stops, goes back along its path, or floats, and is then
//! held until a reset.
//!
//! ```text
//!            contact                 stop, the end of the retraction, at rest without a contact, a lasting fault
//! Watching ──────────▶ Retracting, Floating ──────────▶ Held ──▶ Watching
//!                                  ▲                     │   reset, after ticks without a contact
//!                                  └─────────────────────┘ a contact, if the arm floats and no other stop was required
//! ```
//!
//! Haddadin, De Luca & Albu-Schäffer, "Robot collisions: a survey" (2017), has these strategies.

use crate::estimate::DetectedContact;
use crate::limits::{ConfigError, ConfigParameter, Fault, Mode, MotionLimits};
use crate::motion::{
    MeasurementAge, MotionController, ObservedTick, ReferencedTick, ResetError, hold,
};
use crate::reference::Reference;
use crate::safety::StopCategory;
use crate::safety::supervisor::Supervisor;
use dynamics_core::scalar::Real;

#[cfg(test)]
mod tests;
mod travelled_path;

use travelled_path::TravelledPath;

/// The reaction of an arm to a contact. Each ends with the arm held by a stop of category 2.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ContactResponse<R> {
    /// The arm is decelerated: a stop of category 2.
    Stop,
    /// The reference stops and goes back along its path, from rest where the arm is. The gap from
    /// there to the newest point of the path fades over the whole retraction.
    Retract {
        /// The distance from the newest point of the path, rad or m: the sum over the path of the
        /// steps of the joint that moves most. The points are apart by a fraction 1/(N − 1) of it.
        distance: R,
        /// Greatest speed and acceleration of the reference in the retraction, of all joints.
        limits: MotionLimits<R>,
    },
    /// The arm follows the contact: the reference is the estimate of the joints with q̈ = −d q̇, so
    /// that feedback is zero and the law is left with gravity, friction and damping. The law must
    /// produce q̈, with the inertia of the arm: one of gravity and friction alone leaves the arm
    /// undamped up to the speed limit of the supervisor.
    ///
    /// An arm that is released comes to rest only if the friction that its law leaves out is larger
    /// than the error of its gravity: let the law compensate a share of the friction in
    /// [`ContactPhase::Floating`].
    Float {
        /// d, 1/s.
        damping: R,
        /// The speed of a joint beyond which it is decelerated as in a hold, rad/s or m/s.
        speed: R,
    },
}

/// The parameters of a [`ContactReaction`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ContactReactionConfig<R> {
    /// The reaction.
    pub response: ContactResponse<R>,
    /// Consecutive ticks without a contact after which the arm may be reset.
    pub release_ticks: u32,
}

impl<R: Real> ContactReactionConfig<R> {
    /// Checks that every number is finite and greater than zero; a limit of acceleration may be
    /// infinite.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] names the number.
    pub fn check(&self) -> Result<(), ConfigError> {
        ConfigParameter::ReleaseTicks.require(self.release_ticks > 0)?;
        match self.response {
            ContactResponse::Stop => Ok(()),
            ContactResponse::Retract { distance, limits } => {
                ConfigParameter::RetractDistance.positive(distance)?;
                ConfigParameter::RetractLimit.positive(limits.velocity)?;
                ConfigParameter::RetractLimit.require(limits.acceleration > R::ZERO)
            }
            ContactResponse::Float { damping, speed } => {
                ConfigParameter::FloatDamping.positive(damping)?;
                ConfigParameter::FloatSpeed.positive(speed)
            }
        }
    }
}

/// The action of a [`ContactReaction`] in a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ContactPhase {
    /// The arm follows its motion, or what a fault replaces it by.
    Watching,
    /// The arm goes back along its path.
    Retracting,
    /// The arm can be moved by hand.
    Floating,
    /// The arm is held by a stop with [`Fault::External`], or stopped by another fault, until
    /// [`ContactReaction::reset`].
    Held,
}

/// The reaction of an arm to the contacts of a
/// [`ContactDetector`](crate::estimate::ContactDetector): the second step of the ticks of a
/// [`MotionController`], in place of [`ObservedTick::reference`].
///
/// N points of the reference's path are kept, at distances along it and not in time, so that an arm
/// that has paused goes back as far as one that moves. The retraction is a cubic B-spline of them,
/// whose speed and acceleration have closed bounds.
///
/// A lasting fault ends the reaction, and so does a contact during the retraction, once there was
/// none for `release_ticks`; a second contact before that has no further reaction. The arm is then
/// held. Torques pass the gate of the supervisor as in any tick. A stop that you require stays
/// until a reset: an arm does not float again after it.
///
/// The clock of the motion stands still from the contact to the reset; only for an arm that is
/// stopped at once it first advances by 1/λ, as in any hold. Ticks that were missed
/// ([`MotionController::missed`]) do not count in a retraction.
///
/// # Cost
/// By count: 5 V flops in a tick that follows the motion; some 27 V and 60 in a retraction; 7 N V
/// and one root more in the tick of a contact.
///
/// ```
/// use motion_control::{estimate::*, limits::*, motion::*, reference::*, safety::*};
/// # let bounds = SafetyLimits { torque: [10.0], rate: [10.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
/// # let config = MotionControllerConfig {
/// #     supervisor: SupervisorConfig {
/// #         limits: bounds,
/// #         tick: 1e-3, resolution: 0.0, ride_through_ticks: 2, hold_ticks: 3, reentry_ticks: 10,
/// #     },
/// #     observer_bandwidth: 250.0, decay_rate: 25.0, restart_distance: 0.5,
/// # };
/// # let point = |q, ticks| WayPoint { q: [q], qd: [0.0], ticks };
/// # let limits = [MotionLimits { velocity: 3.0, acceleration: 10.0 }];
/// # let motion = Trajectory::new(&[point(0.0, 0), point(0.5, 1000)], 1e-3, &limits)?;
/// let mut controller = MotionController::<f64, 1>::try_new(config)?;
/// let slow = MotionLimits { velocity: 0.5, acceleration: 2.0 };
/// let mut reaction: ContactReaction<f64, 1> = ContactReaction::try_new(ContactReactionConfig {
///     response: ContactResponse::Retract { distance: 0.1, limits: slow },
///     release_ticks: 50,
/// })?;
/// let mut q = 0.0;
/// for tick in 0..1500 {
///     let observed = controller.observe(Ok(&[q]));
///     // In place of this: the verdict of a detector, from the estimate.
///     let contact = (tick == 500).then_some(DetectedContact { joint: 0, torque: -3.0 });
///     let tick = reaction.reference(observed, Ok(contact), &motion);
///     q = tick.reference().q[0]; // a joint that follows
///     tick.command(&[0.0]);
/// }
/// assert_eq!(reaction.phase(), ContactPhase::Held);
/// assert!((q - 0.15).abs() < 0.01); // the contact was at 0.25 rad
/// reaction.reset(&mut controller, &motion)?;
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "collision reaction")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactReaction<R, const V: usize, const N: usize = 16> {
    config: ContactReactionConfig<R>,
    path: TravelledPath<R, V, N>,
    phase: ContactPhase,
    /// Consecutive ticks without a contact.
    quiet: u32,
    /// During a retraction: the contact that began it has ended.
    armed: bool,
    /// The tick of the retraction.
    tick: u32,
}

impl<R: Real, const V: usize, const N: usize> ContactReaction<R, V, N> {
    /// A reaction that waits for a contact; N ≥ 3, which the compiler checks.
    ///
    /// # Errors
    /// [`ConfigError`], as [`ContactReactionConfig::check`].
    pub fn try_new(config: ContactReactionConfig<R>) -> Result<Self, ConfigError> {
        config.check()?;
        let distance = match config.response {
            ContactResponse::Retract { distance, .. } => distance,
            _ => R::ZERO,
        };
        Ok(Self {
            config,
            path: TravelledPath::new(distance),
            phase: ContactPhase::Watching,
            quiet: 0,
            armed: false,
            tick: 0,
        })
    }

    /// The arm's reaction to a contact, as of the last tick.
    #[inline(always)]
    pub fn phase(&self) -> ContactPhase {
        self.phase
    }

    /// Whether the arm is held after a contact and there was none for `release_ticks`.
    pub fn released(&self) -> bool {
        matches!(self.phase, ContactPhase::Held) & self.quiet()
    }

    fn quiet(&self) -> bool {
        self.quiet >= self.config.release_ticks
    }

    /// The second step of a tick: the reference of the motion, or that of the reaction to a
    /// contact.
    ///
    /// `contact` is what [`ContactDetector::update`](crate::estimate::ContactDetector::update)
    /// returns for the estimate of this tick; a fault of it starts no reaction and releases no arm.
    pub fn reference<'a, A: MeasurementAge, T: Reference<R, V>>(
        &mut self,
        observed: ObservedTick<'a, R, V, A>,
        contact: Result<Option<DetectedContact<R>>, Fault>,
        motion: &T,
    ) -> ReferencedTick<'a, R, V, A> {
        let touched = matches!(contact, Ok(Some(_)));
        self.quiet = match contact {
            Ok(None) => self.quiet.saturating_add(1),
            _ => 0,
        };
        self.armed |= self.quiet();
        let controller = &mut *observed.controller;
        let full = matches!(controller.mode(), Mode::Full);
        match self.phase {
            ContactPhase::Watching if full & touched => self.begin(controller),
            ContactPhase::Retracting => {
                let arrived = self.tick >= self.path.ticks();
                if !full | arrived | (touched & self.armed) {
                    self.end(controller);
                } else {
                    self.tick = self.tick.saturating_add(1);
                }
            }
            ContactPhase::Floating => {
                let at_rest = controller.supervisor.at_rest(&controller.estimate().qd);
                if !full | (self.quiet() & at_rest) {
                    self.end(controller);
                }
            }
            ContactPhase::Held if full => self.watch(),
            ContactPhase::Held if touched & self.floats_again(&controller.supervisor) => {
                controller.supervisor.release();
                self.phase = ContactPhase::Floating;
            }
            ContactPhase::Watching | ContactPhase::Held => {}
        }
        match (self.phase, self.config.response) {
            (ContactPhase::Retracting, _) => observed.replace(&self.path.at(self.tick)),
            (ContactPhase::Floating, ContactResponse::Float { damping, speed }) => {
                let decay = observed.controller.decay_rate();
                let estimate = observed.estimate();
                let mut state = hold(estimate, damping);
                for (qdd, &qd) in state.qdd.iter_mut().zip(&estimate.qd) {
                    *qdd -= decay * (qd - qd.clamped(-speed, speed));
                }
                observed.replace(&state)
            }
            (phase, _) => {
                let tick = observed.reference(motion);
                match (phase, tick.mode()) {
                    // An arm on its brake, or one without a measurement yet, is not on its
                    // reference.
                    (_, Mode::Stopped) => self.path.clear(),
                    (ContactPhase::Watching, _) => {
                        let q = &tick.reference().q;
                        if A::ON_CIRCLES {
                            self.path.turn_to(A::CIRCLES, q);
                        }
                        self.path.record(q);
                    }
                    _ => {}
                }
                tick
            }
        }
    }

    /// Returns the arm to its motion after a contact, as [`MotionController::reset`].
    ///
    /// If the arm is too far from its motion, [`MotionController::approach`] plans the path; reset
    /// with it.
    ///
    /// # Errors
    /// [`ResetError::Contact`] unless the arm is [released](Self::released); as
    /// [`MotionController::reset`] otherwise. The controller is then unchanged.
    pub fn reset<A: MeasurementAge, T: Reference<R, V>>(
        &mut self,
        controller: &mut MotionController<R, V, A>,
        motion: &T,
    ) -> Result<(), ResetError> {
        if matches!(self.phase, ContactPhase::Held) & !self.released() {
            return Err(ResetError::Contact);
        }
        controller.reset(motion)?;
        self.watch();
        Ok(())
    }

    /// Whether a contact moves a held arm again. A stop that was required by others is not the
    /// reaction's to release.
    fn floats_again(&self, supervisor: &Supervisor<R, V>) -> bool {
        let floats = matches!(self.config.response, ContactResponse::Float { .. });
        floats & supervisor.stands_by_one_stop()
    }

    fn watch(&mut self) {
        self.phase = ContactPhase::Watching;
        self.path.clear();
    }

    #[cold]
    fn begin<A: MeasurementAge>(&mut self, controller: &mut MotionController<R, V, A>) {
        self.armed = false;
        self.tick = 0;
        let (from, tick) = (controller.estimate().q, controller.observer.tick());
        match self.config.response {
            ContactResponse::Retract { limits, .. } => {
                if A::ON_CIRCLES {
                    self.path.turn_to(A::CIRCLES, &from);
                }
                if self.path.plan(&from, tick, &limits) {
                    self.phase = ContactPhase::Retracting;
                } else {
                    self.end(controller);
                }
            }
            ContactResponse::Float { .. } => self.phase = ContactPhase::Floating,
            ContactResponse::Stop => self.end(controller),
        }
    }

    /// Holds the arm.
    #[cold]
    fn end<A: MeasurementAge>(&mut self, controller: &mut MotionController<R, V, A>) {
        controller.stop_by(Fault::External, StopCategory::ControlledHold);
        self.phase = ContactPhase::Held;
    }
}
