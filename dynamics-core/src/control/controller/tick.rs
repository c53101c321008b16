//! The steps of a tick: each can be called once only, and only in its order.

use super::super::{Command, Estimate, Fault, Mode, Reference};
use super::{MeasurementAge, MotionController, PreviousTick};
use crate::scalar::Real;
use crate::state::State;

/// A tick of a [`MotionController`] whose measurement has been judged: [`Self::reference`] comes next.
#[must_use = "a tick without a command leaves the drives the torques of an older one"]
#[derive(Debug)]
pub struct ObservedTick<'a, R, const V: usize, A = PreviousTick> {
    controller: &'a mut MotionController<R, V, A>,
}

/// A tick of a [`MotionController`] that waits for the law's torques: [`Self::command`] ends it.
///
/// ```
/// use dynamics_core::control::{Command, Fault, MotionController, Reference};
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
/// # use dynamics_core::control::{MotionController, Reference};
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
/// # use dynamics_core::control::{MotionController, Reference};
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
/// # use dynamics_core::control::MotionController;
/// # fn tick(controller: &mut MotionController<f32, 6>) {
/// controller.observe(Ok(&[0.0; 6])).command(&[0.0; 6]);
/// # }
/// ```
///
/// and no other tick begins before it has ended:
///
/// ```compile_fail,E0499
/// # use dynamics_core::control::{MotionController, Reference};
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

impl<'a, R: Real, const V: usize, A: MeasurementAge> ObservedTick<'a, R, V, A> {
    #[inline(always)]
    pub(super) fn new(controller: &'a mut MotionController<R, V, A>) -> Self {
        Self { controller }
    }

    /// Where the joints are and how fast, as the observer has it.
    #[inline(always)]
    pub fn estimate(&self) -> &Estimate<R, V> {
        self.controller.estimate()
    }

    /// What the arm does in this tick.
    #[inline(always)]
    pub fn mode(&self) -> Mode {
        self.controller.mode()
    }

    /// Goes on with what the joints are to follow in this tick: the trajectory, or what a fault puts in its place.
    #[inline(always)]
    pub fn reference<T: Reference<R, V>>(self, trajectory: &T) -> ReferencedTick<'a, R, V, A> {
        self.controller.next_reference(trajectory);
        ReferencedTick {
            controller: self.controller,
        }
    }
}

impl<R: Real, const V: usize, A: MeasurementAge> ReferencedTick<'_, R, V, A> {
    /// What the joints are to follow in this tick.
    #[inline(always)]
    pub fn reference(&self) -> &State<R, V, V> {
        &self.controller.reference
    }

    /// Where the joints are and how fast, as the observer has it.
    #[inline(always)]
    pub fn estimate(&self) -> &Estimate<R, V> {
        self.controller.estimate()
    }

    /// What the arm does in this tick.
    #[inline(always)]
    pub fn mode(&self) -> Mode {
        self.controller.mode()
    }

    /// The trajectory's tick; it stands still while the arm is held or returns.
    #[inline(always)]
    pub fn trajectory_tick(&self) -> u32 {
        self.controller.clock
    }

    /// The same for a law whose feed-forward has no inertia in it (gravity compensation, or no feed-forward at all).
    ///
    /// Such a law cannot bring the deceleration of a held arm about. The reference of a held arm then has a velocity of
    /// zero, and K_d slows the joints down.
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

    /// Ends the tick: what goes to the drives, of the torques that the law wants (N·m, N).
    ///
    /// A torque that is not finite is a fault, see [`Supervisor::tick`](super::super::Supervisor::tick).
    #[inline(always)]
    pub fn command(self, tau: &[R; V]) -> Command<R, V> {
        let controller = self.controller;
        let command = controller.supervisor.gate(tau);
        let moving = matches!(command.status.mode, Mode::Full) & !controller.resume.active();
        controller.clock = controller.clock.saturating_add(u32::from(moving));
        command
    }
}
