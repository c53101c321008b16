//! Probes watch a tick while it runs and keep a record of it.

use motion_control::limits::Status;

/// A phase of a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The whole tick, which contains the others.
    Tick,
    /// Encoders, plausibility, observer: [`motion_control::motion::MotionController::observe`].
    Read,
    /// The trajectory at this tick.
    Reference,
    /// Feed-forward and feedback torque.
    Dynamics,
    /// The limits and the state machine.
    Safety,
    /// The commands to drives and brake.
    Write,
}

/// A probe watches a tick while it runs: a pin for an oscilloscope, a counter of cycles, a record.
/// `()` watches nothing and is not in the machine code.
///
/// ```
/// use embedded_hal::digital::OutputPin;
/// use joint_drivers::{Phase, Probe};
/// /// A pin that is high during the dynamics.
/// struct Scope<Pin>(Pin);
/// impl<Pin: OutputPin, const V: usize> Probe<V> for Scope<Pin> {
///     fn begin(&mut self, phase: Phase) {
///         if phase == Phase::Dynamics {
///             let _ = self.0.set_high();
///         }
///     }
///     fn end(&mut self, phase: Phase) {
///         if phase == Phase::Dynamics {
///             let _ = self.0.set_low();
///         }
///     }
/// }
/// ```
pub trait Probe<const V: usize> {
    /// Notes that a phase begins.
    #[inline(always)]
    fn begin(&mut self, _: Phase) {}

    /// Notes that a phase ends.
    #[inline(always)]
    fn end(&mut self, _: Phase) {}

    /// The record of the tick, shortly before its end.
    #[inline(always)]
    fn record(&mut self, _: &Telemetry<V>) {}
}

impl<const V: usize> Probe<V> for () {}

/// The record of a tick, for logs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Telemetry<const V: usize> {
    /// Ticks since the trajectory's start, held during a fault.
    pub tick: u32,
    /// The reference positions, rad or m.
    pub reference: [f32; V],
    /// The estimated positions, rad or m.
    pub estimate: [f32; V],
    /// Torque commanded, N·m or N.
    pub torque: [f32; V],
    /// The status of the controller.
    pub status: Status,
}
