//! The detectors of a control loop, at their places in a tick.

use super::{FrozenEncoder, ReferenceStep, Saturation};
use crate::limits::{Command, Fault, Mode};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

/// Faults that a control loop detects beside its supervisor; `()` detects none and is not in the
/// machine code.
pub trait Detect<R, const V: usize> {
    /// Checks the positions measured in a tick, rad or m; `reference` acted since the tick before.
    ///
    /// # Errors
    /// The fault of the measurement: for
    /// [`MotionController::observe`](crate::motion::MotionController::observe).
    fn measured(&mut self, q: &[R; V], reference: &[R; V]) -> Result<(), Fault>;

    /// Checks the reference of a tick.
    ///
    /// # Errors
    /// The fault of the reference: for
    /// [`ReferencedTick::stop_by`](crate::motion::ReferencedTick::stop_by).
    fn referenced(&mut self, reference: &State<R, V, V>, mode: Mode) -> Result<(), Fault>;

    /// Checks the command of a tick.
    ///
    /// # Errors
    /// The fault of the torques: for
    /// [`MotionController::react`](crate::motion::MotionController::react).
    fn commanded(&mut self, command: &Command<R, V>) -> Result<(), Fault>;

    /// Ticks were missed, or another motion begins.
    fn restart(&mut self);
}

impl<R, const V: usize> Detect<R, V> for () {
    #[inline(always)]
    fn measured(&mut self, _: &[R; V], _: &[R; V]) -> Result<(), Fault> {
        Ok(())
    }
    #[inline(always)]
    fn referenced(&mut self, _: &State<R, V, V>, _: Mode) -> Result<(), Fault> {
        Ok(())
    }
    #[inline(always)]
    fn commanded(&mut self, _: &Command<R, V>) -> Result<(), Fault> {
        Ok(())
    }
    #[inline(always)]
    fn restart(&mut self) {}
}

impl<R, D: Detect<R, V>, const V: usize> Detect<R, V> for &mut D {
    fn measured(&mut self, q: &[R; V], reference: &[R; V]) -> Result<(), Fault> {
        (**self).measured(q, reference)
    }
    fn referenced(&mut self, reference: &State<R, V, V>, mode: Mode) -> Result<(), Fault> {
        (**self).referenced(reference, mode)
    }
    fn commanded(&mut self, command: &Command<R, V>) -> Result<(), Fault> {
        (**self).commanded(command)
    }
    fn restart(&mut self) {
        (**self).restart();
    }
}

/// All detectors of this module.
///
/// ```
/// use motion_control::limits::{Fault, Mode};
/// use motion_control::safety::{Detect, Detectors, FrozenEncoder, ReferenceStep, Saturation};
/// use dynamics_core::state::State;
/// let mut detectors = Detectors {
///     frozen: FrozenEncoder::new([0.004_f32], 3),
///     steps: ReferenceStep::new([0.004]),
///     saturation: Saturation::new([10.0], 50),
/// };
/// assert_eq!(detectors.measured(&[0.2], &[0.2]), Ok(()));
/// assert_eq!(detectors.referenced(&State::at([0.2]), Mode::Full), Ok(()));
/// let step = detectors.referenced(&State::at([0.5]), Mode::Full);
/// assert_eq!(step, Err(Fault::Reference { joint: 0 }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detectors<R, const V: usize, const CIRCLES: u128 = 0> {
    /// The detector of the positions; it is restarted by each command that sets the brake.
    pub frozen: FrozenEncoder<R, V, CIRCLES>,
    /// The detector of the reference, while the arm follows its trajectory.
    pub steps: ReferenceStep<R, V, CIRCLES>,
    /// The detector of the torques.
    pub saturation: Saturation<R, V>,
}

impl<R: Real, const V: usize> Detectors<R, V> {
    /// The same detectors for joints of which those of
    /// [`Circles::bits`](crate::limits::Circles::bits) are circles, as those of the controller.
    #[must_use]
    pub fn on_circles<const CIRCLES: u128>(self) -> Detectors<R, V, CIRCLES> {
        Detectors {
            frozen: self.frozen.on_circles(),
            steps: self.steps.on_circles(),
            saturation: self.saturation,
        }
    }
}

impl<R: Real, const V: usize, const CIRCLES: u128> Detect<R, V> for Detectors<R, V, CIRCLES> {
    fn measured(&mut self, q: &[R; V], reference: &[R; V]) -> Result<(), Fault> {
        self.frozen.check(q, reference)
    }

    fn referenced(&mut self, reference: &State<R, V, V>, mode: Mode) -> Result<(), Fault> {
        if mode != Mode::Full {
            self.steps.restart();
            return Ok(());
        }
        self.steps.check(reference)
    }

    fn commanded(&mut self, command: &Command<R, V>) -> Result<(), Fault> {
        if command.brake {
            self.frozen.restart();
        }
        self.saturation.check(&command.torque)
    }

    fn restart(&mut self) {
        self.steps.restart();
    }
}
