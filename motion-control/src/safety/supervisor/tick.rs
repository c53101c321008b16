//! A tick of the supervisor, which its caller can neither leave unfinished nor finish twice.

use super::{Command, Fault, Mode, StopCategory, Supervisor};
use dynamics_core::scalar::Real;

/// A tick of a [`Supervisor`] between its measurement and its torque.
#[derive(Debug)]
pub struct SupervisorTick<'a, R, const V: usize> {
    supervisor: &'a mut Supervisor<R, V>,
    /// Those of [`Self::check_speed`].
    qd: [R; V],
}

impl<R: Real, const V: usize> Supervisor<R, V> {
    /// Runs one tick: judges the measured positions, has the law compute torques, and limits these.
    ///
    /// `measured`: the positions of this tick (rad, m), or the fault that prevented them. `law` is called once, in
    /// every mode, and returns torques (N·m, N); its argument [`SupervisorTick`] has the mode of the arm.
    ///
    /// Accepted are positions that are finite, within their limits (and within 10⁴ rad or m, beyond which f32 has no
    /// accurate sine) and plausible: within twice the greatest speed times the ticks since the last good ones. Before
    /// the first accepted position there is no position to hold: a fault stops the arm at once.
    ///
    /// Torques and their rates of change are limited. A torque that is not finite is a fault: the last torques stand for
    /// all of its tick, and the next tick is a hold unless the fault is ridden through; in a hold, for which there is
    /// then no torque, it stops the arm. After a reset the brake opens when no limit keeps the torque from being there.
    ///
    /// # Cost
    /// 10 flops and 7 comparisons per joint in addition to the law, with the same instructions for all data, except on
    /// a fault.
    ///
    /// # Misuse
    /// A law without a torque does not compile:
    ///
    /// ```compile_fail,E0308
    /// # use motion_control::Supervisor;
    /// fn tick(supervisor: &mut Supervisor<f32, 1>) {
    ///     supervisor.tick(Ok(&[0.5]), |tick| { tick.mode(); });
    /// }
    /// ```
    ///
    /// Nor does a second tick within the first:
    ///
    /// ```compile_fail,E0499
    /// # use motion_control::Supervisor;
    /// fn tick(supervisor: &mut Supervisor<f32, 1>) {
    ///     supervisor.tick(Ok(&[0.5]), |_| supervisor.tick(Ok(&[0.5]), |_| [1.0]).torque);
    /// }
    /// ```
    #[inline]
    pub fn tick(
        &mut self,
        measured: Result<&[R; V], Fault>,
        law: impl FnOnce(&mut SupervisorTick<'_, R, V>) -> [R; V],
    ) -> Command<R, V> {
        self.accept_measurement(measured);
        let mut tick = SupervisorTick {
            supervisor: self,
            qd: [R::ZERO; V],
        };
        let tau = law(&mut tick);
        let qd = tick.qd;
        self.gate(&tau, &qd)
    }
}

impl<R: Real, const V: usize> SupervisorTick<'_, R, V> {
    /// The mode of the arm in this tick.
    #[inline(always)]
    pub fn mode(&self) -> Mode {
        self.supervisor.mode()
    }

    /// Whether the positions of this tick were accepted.
    #[inline(always)]
    pub fn measurement_accepted(&self) -> bool {
        self.supervisor.measurement_accepted()
    }

    /// The last positions that were accepted, rad or m; zeros before the first.
    #[inline(always)]
    pub fn last_good(&self) -> &[R; V] {
        self.supervisor.last_good()
    }

    /// The progress of the return to the full law, 0 to 1, as [`Supervisor::authority`].
    #[inline(always)]
    pub fn authority(&self) -> R {
        self.supervisor.authority()
    }

    /// Compares the observer's velocities (rad/s, m/s) with their limits, and returns the mode of the arm in this tick.
    ///
    /// Excessive speed is a fault without ride-through. An arm that sinks ([`StopCategory::DampedLowering`]) is damped
    /// by these velocities, and by none if this function is not called.
    ///
    /// ```
    /// # use motion_control::{SafetyLimits, Mode, Supervisor, SupervisorConfig};
    /// # let limits = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let mut supervisor = Supervisor::try_new(SupervisorConfig {
    /// #     limits, tick: 1e-3, resolution: 0.0, ride_through_ticks: 5, hold_ticks: 2, reentry_ticks: 4,
    /// # })?;
    /// supervisor.tick(Ok(&[0.5]), |tick| {
    ///     assert_eq!(tick.mode(), Mode::Full);
    ///     assert_eq!(tick.check_speed(&[-3.1]), Mode::Hold);
    ///     [0.0]
    /// });
    /// # Ok::<(), motion_control::ConfigError>(())
    /// ```
    #[inline(always)]
    pub fn check_speed(&mut self, qd: &[R; V]) -> Mode {
        self.qd = *qd;
        self.supervisor.check_speed(qd)
    }

    /// Stops the arm in this tick, as [`Supervisor::stop`].
    #[cold]
    pub fn stop(&mut self, fault: Fault) {
        self.supervisor.stop(fault);
    }

    /// Stops the arm by a category, as [`Supervisor::stop_by`].
    #[cold]
    pub fn stop_by(&mut self, fault: Fault, category: StopCategory<R, V>) {
        self.supervisor.stop_by(fault, category);
    }
}
