//! Stops and faults from outside the controller.

use super::{MeasurementAge, MotionController};
use crate::limits::Fault;
use crate::safety::StopCategory;
use dynamics_core::scalar::Real;

impl<R: Real, const V: usize, A: MeasurementAge> MotionController<R, V, A> {
    /// Stops the arm from the next tick on, for an external reason such as a failed drive or an emergency stop.
    ///
    /// The stop is latched until [`Self::reset`], with its first reason. While a stop is still required after a reset,
    /// call this function in every tick. [`ReferencedTick::stop`](super::ReferencedTick::stop) acts in the present tick.
    #[doc(alias = "e-stop")]
    #[doc(alias = "emergency stop")]
    #[cold]
    pub fn stop(&mut self, fault: Fault) {
        self.supervisor.stop(fault);
    }

    /// The same controller with another stop category for lasting faults than [`StopCategory::ControlledOff`].
    ///
    /// ```
    /// use motion_control::{Fault, Mode, MotionController, MotionControllerConfig, StopCategory};
    /// # use motion_control::{SafetyLimits, SupervisorConfig, MotionLimits, Trajectory, WayPoint};
    /// # let config = MotionControllerConfig {
    /// #     supervisor: SupervisorConfig {
    /// #         limits: SafetyLimits { torque: [10.0], rate: [10.0], speed: [3.0], lower: [-1.0], upper: [1.0] },
    /// #         tick: 1e-3, resolution: 0.0, ride_through_ticks: 2, hold_ticks: 3, reentry_ticks: 10,
    /// #     },
    /// #     observer_bandwidth: 250.0, decay_rate: 25.0, restart_distance: 0.1,
    /// # };
    /// # let point = |q, ticks| WayPoint { q: [q], qd: [0.0], ticks };
    /// # let limits = [MotionLimits { velocity: 3.0, acceleration: 10.0 }];
    /// # let trajectory = Trajectory::new(&[point(0.0, 0), point(0.5, 1000)], 1e-3, &limits)?;
    /// let sinks = StopCategory::DampedLowering { damping: [4.0] };
    /// let mut controller = MotionController::<f32, 1>::try_new(config)?.with_stop(sinks);
    /// controller.tick(Ok(&[0.0]), &trajectory, |_, _| [1.0]);
    /// controller.stop(Fault::External);
    /// for tick in 0..50 {
    ///     // The arm sinks at 0.5 rad/s: −4 N·m·s/rad of it are 2 N·m.
    ///     let command = controller.tick(Ok(&[-5e-4 * tick as f32]), &trajectory, |_, _| [1.0]);
    ///     assert_eq!(command.status.mode, Mode::Stopped);
    ///     assert!(tick < 40 || (command.torque[0] - 2.0).abs() < 0.01);
    /// }
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_stop(mut self, category: StopCategory<R, V>) -> Self {
        self.supervisor = self.supervisor.with_stop(category);
        self
    }

    /// Stops the arm by a category, for a reason that leaves the drives usable; see
    /// [`Supervisor::stop_by`](crate::Supervisor::stop_by).
    #[cold]
    pub fn stop_by(&mut self, fault: Fault, category: StopCategory<R, V>) {
        self.supervisor.stop_by(fault, category);
    }

    /// Reports a fault that the controller cannot detect, which is then a fault of the next tick; see
    /// [`Supervisor::report`](crate::Supervisor::report).
    #[cold]
    pub fn report(&mut self, fault: Fault) {
        self.supervisor.report(fault);
    }
}

impl<R: Real, const V: usize, A: MeasurementAge> MotionController<R, V, A> {
    /// Reacts to a fault that the controller cannot detect, by its [`Fault::reaction`]; see [`Supervisor::react`](crate::Supervisor::react).
    #[cold]
    pub fn react(&mut self, fault: Fault) {
        self.supervisor.react(fault);
    }
}
