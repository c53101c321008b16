//! A tick and its steps: each can be called only once, and only in this order.

use super::{MeasurementAge, MotionController, PreviousTick};
use crate::estimate::Estimate;
use crate::limits::{Command, Fault, Mode};
use crate::reference::Reference;
use crate::safety::StopCategory;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

/// A tick of a [`MotionController`] after the check of its measurement; [`Self::reference`] is the
/// next step.
#[must_use = "a tick without a command leaves the drives the torques of an older one"]
#[derive(Debug)]
pub struct ObservedTick<'a, R, const V: usize, A = PreviousTick> {
    pub(crate) controller: &'a mut MotionController<R, V, A>,
}

/// A tick of a [`MotionController`] that needs the torques of the law; [`Self::command`] ends it.
///
/// ```
/// use motion_control::limits::{Command, Fault};
/// use motion_control::motion::MotionController;
/// use motion_control::reference::Reference;
/// fn tick(
///     controller: &mut MotionController<f32, 6>,
///     trajectory: &impl Reference<f32, 6>,
///     measured: Result<&[f32; 6], Fault>,
///     emergency_stop: bool,
/// ) -> Command<f32, 6> {
///     let mut tick = controller.observe(measured).reference(trajectory);
///     if emergency_stop {
///         tick.stop(Fault::External);
///     }
///     let tau = [0.0; 6]; // of the law, from tick.reference() and tick.estimate()
///     tick.command(&tau)
/// }
/// ```
///
/// A tick has one command:
///
/// ```compile_fail,E0382
/// # use motion_control::{motion::MotionController, reference::Reference};
/// # fn tick(controller: &mut MotionController<f32, 6>, trajectory: &impl Reference<f32, 6>) {
/// let tick = controller.observe(Ok(&[0.0; 6])).reference(trajectory);
/// tick.command(&[0.0; 6]);
/// tick.command(&[0.0; 6]);
/// # }
/// ```
///
/// and one reference:
///
/// ```compile_fail,E0382
/// # use motion_control::{motion::MotionController, reference::Reference};
/// # fn tick(controller: &mut MotionController<f32, 6>, trajectory: &impl Reference<f32, 6>) {
/// let tick = controller.observe(Ok(&[0.0; 6]));
/// let referenced = tick.reference(trajectory);
/// let again = tick.reference(trajectory);
/// # }
/// ```
///
/// which comes before the command:
///
/// ```compile_fail,E0599
/// # use motion_control::motion::MotionController;
/// # fn tick(controller: &mut MotionController<f32, 6>) {
/// controller.observe(Ok(&[0.0; 6])).command(&[0.0; 6]);
/// # }
/// ```
///
/// and no other tick begins before it has ended:
///
/// ```compile_fail,E0499
/// # use motion_control::{motion::MotionController, reference::Reference};
/// # fn tick(controller: &mut MotionController<f32, 6>, trajectory: &impl Reference<f32, 6>) {
/// let tick = controller.observe(Ok(&[0.0; 6])).reference(trajectory);
/// let other = controller.observe(Ok(&[0.0; 6]));
/// tick.command(&[0.0; 6]);
/// # }
/// ```
#[must_use = "a tick without a command leaves the drives the torques of an older one"]
#[derive(Debug)]
pub struct ReferencedTick<'a, R, const V: usize, A = PreviousTick> {
    controller: &'a mut MotionController<R, V, A>,
}

impl<R: Real, const V: usize, A: MeasurementAge> MotionController<R, V, A> {
    /// Runs one tick: from the measured positions (rad, m), or the fault that prevented them, to
    /// the command to the drives.
    ///
    /// `law` is called once, in every mode; it computes torques (N·m, N) from the reference and the
    /// estimate of the joints. Its feed-forward must produce the acceleration of the reference; for
    /// a law without inertia, see [`ReferencedTick::without_inertia`].
    ///
    /// # Cost
    /// 25 flops per joint in addition to the trajectory and the law, with the same instructions for
    /// all data; more during a fault and the return after it.
    #[inline]
    pub fn tick<T: Reference<R, V>>(
        &mut self,
        measured: Result<&[R; V], Fault>,
        trajectory: &T,
        law: impl FnOnce(&State<R, V, V>, &Estimate<R, V>) -> [R; V],
    ) -> Command<R, V> {
        let tick = self.observe(measured).reference(trajectory);
        let tau = law(tick.reference(), tick.estimate());
        tick.command(&tau)
    }

    /// Starts a tick: checks the measured positions (rad, m), or accepts the fault that prevented
    /// them, and updates the estimate.
    ///
    /// The first of the three steps of [`Self::tick`], for loops that do other work between them. A
    /// tick that ends without a command is [`Fault::Unfinished`] in the next one.
    ///
    /// Accepted are positions that are finite, within their limits (and within 10⁴ rad or m, beyond
    /// which f32 has no accurate sine) and plausible: within twice the greatest speed times the
    /// ticks since the last good ones. Before the first accepted position there is no position to
    /// hold: a fault stops the arm at once.
    ///
    /// A joint that is a circle ([`OnCircles`](crate::motion::OnCircles)) may be measured in any
    /// turn, within ±π most accurately; the estimate is within half a turn of the middle of the
    /// range, or of zero.
    ///
    /// ```compile_fail
    /// # #![deny(unused_must_use)]
    /// # use motion_control::{motion::MotionController, reference::Reference};
    /// fn tick(controller: &mut MotionController<f32, 1>, trajectory: &impl Reference<f32, 1>) {
    ///     controller.observe(Ok(&[0.0])).reference(trajectory); // and the command?
    /// }
    /// ```
    #[inline]
    pub fn observe(&mut self, measured: Result<&[R; V], Fault>) -> ObservedTick<'_, R, V, A> {
        match measured {
            Ok(q) => self.observe_positions(q),
            Err(fault) => self.observe_fault(fault),
        }
        ObservedTick { controller: self }
    }

    #[inline(always)]
    fn observe_positions(&mut self, q: &[R; V]) {
        let turned;
        let q = if A::ON_CIRCLES {
            turned = self.turn_to(q);
            &turned
        } else {
            q
        };
        self.supervisor.accept_positions(q);
        let stopped = matches!(self.supervisor.mode(), Mode::Stopped);
        if !self.supervisor.measurement_accepted() | self.dead_reckoning | stopped {
            self.observe_otherwise(Ok(q));
            return;
        }
        A::correct(&mut self.observer, q, &self.reference.qdd);
        self.supervisor.check_speed(&self.observer.estimate().qd);
    }

    #[cold]
    fn observe_fault(&mut self, fault: Fault) {
        self.supervisor.accept_fault(fault);
        self.observe_otherwise(Err(fault));
    }

    /// A tick during or after a fault: in a function of its own, so that the usual one has no case
    /// for it.
    #[cold]
    #[inline(never)]
    fn observe_otherwise(&mut self, measured: Result<&[R; V], Fault>) {
        self.predict_estimate(measured);
        self.supervisor.check_speed(&self.observer.estimate().qd);
    }
}

impl<'a, R: Real, const V: usize, A: MeasurementAge> ObservedTick<'a, R, V, A> {
    /// The estimated positions and velocities of the joints.
    #[inline(always)]
    pub fn estimate(&self) -> &Estimate<R, V> {
        self.controller.estimate()
    }

    /// The mode of the arm in this tick.
    #[inline(always)]
    pub fn mode(&self) -> Mode {
        self.controller.mode()
    }

    /// The second step: computes the reference of this tick, which is the trajectory or, on a
    /// fault, what replaces it.
    #[inline(always)]
    pub fn reference<T: Reference<R, V>>(self, trajectory: &T) -> ReferencedTick<'a, R, V, A> {
        self.controller.next_reference(trajectory);
        ReferencedTick { controller: self.controller }
    }

    /// The second step with a reference that is not the trajectory's: the clock of the trajectory
    /// stands still.
    pub(crate) fn replace(self, reference: &State<R, V, V>) -> ReferencedTick<'a, R, V, A> {
        self.controller.replace_reference(reference);
        ReferencedTick { controller: self.controller }
    }
}

impl<R: Real, const V: usize, A: MeasurementAge> ReferencedTick<'_, R, V, A> {
    /// The reference of the joints in this tick.
    #[inline(always)]
    pub fn reference(&self) -> &State<R, V, V> {
        &self.controller.reference
    }

    /// The estimated positions and velocities of the joints.
    #[inline(always)]
    pub fn estimate(&self) -> &Estimate<R, V> {
        self.controller.estimate()
    }

    /// The mode of the arm in this tick.
    #[inline(always)]
    pub fn mode(&self) -> Mode {
        self.controller.mode()
    }

    /// The tick of the trajectory; it does not advance while the arm is held or returns.
    #[inline(always)]
    pub fn trajectory_tick(&self) -> u32 {
        self.controller.clock
    }

    /// The same tick for a law without inertia in its feed-forward (gravity compensation, or no
    /// feed-forward at all).
    ///
    /// Such a law cannot produce the deceleration of a held arm. The reference of a held arm then
    /// has zero velocity, and K_d decelerates the joints.
    #[inline(always)]
    pub fn without_inertia(self) -> Self {
        if !matches!(self.mode(), Mode::Full) {
            self.controller.reference.qd = [R::ZERO; V];
        }
        self
    }

    /// Stops the arm in this tick, as [`MotionController::stop`] does from the next one on.
    #[doc(alias = "e-stop")]
    #[doc(alias = "emergency stop")]
    #[cold]
    pub fn stop(&mut self, fault: Fault) {
        self.controller.stop(fault);
    }

    /// Stops the arm by a category, as [`MotionController::stop_by`], in this tick: the reference
    /// of a controlled stop replaces that of the trajectory.
    #[cold]
    pub fn stop_by(&mut self, fault: Fault, category: StopCategory<R, V>) {
        self.controller.stop_by(fault, category);
        self.controller.hold_now();
    }

    /// Ends the tick: limits the torques of the law (N·m, N) and returns the command to the drives.
    ///
    /// Torques and their rates of change are limited. A torque that is not finite is a fault: the
    /// last torques stand for all of its tick, and the next tick is a hold unless the fault is
    /// ridden through; in a hold, for which there is then no torque, it stops the arm. After a
    /// reset the brake opens when no limit keeps the torque from being there.
    #[inline(always)]
    pub fn command(self, tau: &[R; V]) -> Command<R, V> {
        let controller = self.controller;
        let qd = &controller.observer.estimate().qd;
        let command = controller.supervisor.gate(tau, qd);
        let moving = matches!(command.status.mode, Mode::Full) & !controller.resume.active();
        controller.clock = controller.clock.saturating_add(u32::from(moving));
        command
    }
}
