//! What is kept of a tick.

use joint_drivers::as5047p::FrameError;
use motion_control::Status;

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
    /// The status of the supervisor.
    pub status: Status,
    /// The error of the first encoder without an angle.
    pub frame: Option<FrameError>,
}

/// What keeps a record of a tick while it runs; `()` keeps none and is not in the machine code.
pub trait Recorder<const V: usize> {
    /// The count of a timer at the start of the tick, with 0, and after each phase, with 1 to 5: reading, reference,
    /// dynamics, safety, writing.
    fn count(&mut self, phase: usize, count: u32);

    /// The end of the tick.
    fn record(&mut self, telemetry: &Telemetry<V>);
}

impl<const V: usize> Recorder<V> for () {
    #[inline(always)]
    fn count(&mut self, _: usize, _: u32) {}
    #[inline(always)]
    fn record(&mut self, _: &Telemetry<V>) {}
}
