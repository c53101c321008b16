//! The regions of a tick that `cycle-meter` measures: those of the control loop between markers.

use joint_drivers::{Phase, Probe, Telemetry};

use crate::marker;

/// The whole tick, which holds the others.
pub const TICK: u8 = 0;
pub const READ: u8 = 1;
/// The trajectory at this tick.
pub const REFERENCE: u8 = 2;
/// Feed-forward and feedback torque.
pub const DYNAMICS: u8 = 3;
/// Limits and state machine.
pub const SAFETY: u8 = 4;
/// Drives and brake.
pub const WRITE: u8 = 5;
/// Putting the record of the tick into the queue of the telemetry, after the tick.
pub const RECORD: u8 = 6;
/// Code with interrupts masked, in firmware that measures it.
pub const MASKED: u8 = 7;

/// Puts the markers of the regions around the phases of a tick, and passes them on to another
/// probe.
#[derive(Debug)]
pub struct Marked<P = ()>(pub P);

impl<P: Probe<V>, const V: usize> Probe<V> for Marked<P> {
    #[inline(always)]
    fn begin(&mut self, phase: Phase) {
        match phase {
            Phase::Tick => marker::start::<TICK>(),
            Phase::Read => marker::start::<READ>(),
            Phase::Reference => marker::start::<REFERENCE>(),
            Phase::Dynamics => marker::start::<DYNAMICS>(),
            Phase::Safety => marker::start::<SAFETY>(),
            Phase::Write => marker::start::<WRITE>(),
        }
        self.0.begin(phase);
    }

    #[inline(always)]
    fn end(&mut self, phase: Phase) {
        match phase {
            Phase::Tick => marker::stop::<TICK>(),
            Phase::Read => marker::stop::<READ>(),
            Phase::Reference => marker::stop::<REFERENCE>(),
            Phase::Dynamics => marker::stop::<DYNAMICS>(),
            Phase::Safety => marker::stop::<SAFETY>(),
            Phase::Write => marker::stop::<WRITE>(),
        }
        self.0.end(phase);
    }

    #[inline(always)]
    fn record(&mut self, telemetry: &Telemetry<V>) {
        self.0.record(telemetry);
    }
}
