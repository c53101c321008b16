//! The categories of stops, and the one that is configured.

use crate::limits::Fault;
#[cfg(doc)]
use crate::limits::Mode;
use dynamics_core::scalar::Real;

/// The ways to stop an arm: the stop categories of IEC 60204-1 (2016), 9.2.2, and the lowering of
/// an arm without brakes.
///
/// A fault that outlasts the ride-through and a
/// [`stop_by`](crate::motion::MotionController::stop_by) choose among them;
/// [`stop`](crate::motion::MotionController::stop) is at once, for faults that leave no torque to
/// decelerate with, such as a failed drive.
///
/// | category | first | then | power |
/// |---|---|---|---|
/// | 0, [`Self::TorqueOff`] | | zero torque and the brake | off at once |
/// | 1, [`Self::ControlledOff`] | [`Mode::Hold`] for `hold_ticks` | zero torque and the brake | off at rest |
/// | 2, [`Self::ControlledHold`] | [`Mode::Hold`] for `hold_ticks` | held in [`Mode::Hold`] until a reset | stays on |
/// | none, [`Self::DampedLowering`] | [`Mode::Hold`] for `hold_ticks` | τ = −d q̇, no brake needed | on while the arm sinks |
///
/// Category 2 needs measurements: if they fail for longer than `hold_ticks`, it ends as category 1.
/// The controlled part is not safety-rated: keep a safe torque off in hardware.
///
/// ```
/// use motion_control::limits::{Fault, Mode};
/// use motion_control::motion::{MotionController, MotionControllerConfig};
/// use motion_control::safety::StopCategory;
/// # use dynamics_core::state::State;
/// # use motion_control::{limits::SafetyLimits, safety::SupervisorConfig};
/// # let config = MotionControllerConfig {
/// #     supervisor: SupervisorConfig {
/// #         limits: SafetyLimits { torque: [10.0], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] },
/// #         tick: 1e-3, resolution: 0.0, ride_through_ticks: 5, hold_ticks: 2, reentry_ticks: 4,
/// #     },
/// #     observer_bandwidth: 250.0, decay_rate: 25.0, restart_distance: 0.1,
/// # };
/// # let reference = State::at([0.5]);
/// let mut controller = MotionController::<f32, 1>::try_new(config)?;
/// controller.tick(Ok(&[0.5]), &reference, |_, _| [7.0]);
/// controller.stop_by(Fault::External, StopCategory::ControlledOff);
/// for mode in [Mode::Hold, Mode::Hold, Mode::Stopped, Mode::Stopped] {
///     let command = controller.tick(Ok(&[0.5]), &reference, |_, _| [7.0]);
///     assert_eq!((command.status.mode, command.status.fault), (mode, Some(Fault::External)));
///     assert_eq!(command.brake, mode == Mode::Stopped);
/// }
/// # Ok::<(), motion_control::limits::ConfigError>(())
/// ```
#[doc(alias = "IEC 60204-1")]
#[doc(alias = "stop category")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum StopCategory<R, const V: usize> {
    /// Category 0: zero torque and the brake at once.
    TorqueOff,
    /// Category 1, the default: the arm is decelerated, then zero torque and the brake.
    ControlledOff,
    /// Category 2: the arm is decelerated, then held with torque until a reset.
    ControlledHold,
    /// For an arm without brakes: the arm is decelerated, then sinks against a damping.
    DampedLowering {
        /// d of each joint, N·m·s/rad or N·s/m. The arm sinks at the torque of gravity divided by
        /// d.
        damping: [R; V],
    },
}

/// The action after the deceleration of a controlled stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// Category 1.
    Off,
    /// Category 2.
    Hold,
    /// The arm sinks against a damping.
    Lowering,
}

/// A controlled stop that was required from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct StopRequest {
    pub(crate) reason: Fault,
    /// Another stop was required during this one.
    pub(crate) again: bool,
}

/// The configured category.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stopping<R, const V: usize> {
    /// The action after the deceleration; none for category 0.
    pub(crate) configured: Option<Ending>,
    pub(crate) damping: [R; V],
}

impl<R: Real, const V: usize> Stopping<R, V> {
    pub(crate) fn new() -> Self {
        Self { configured: Some(Ending::Off), damping: [R::ZERO; V] }
    }

    pub(crate) fn choose(&mut self, category: &StopCategory<R, V>) -> Option<Ending> {
        match *category {
            StopCategory::TorqueOff => None,
            StopCategory::ControlledOff => Some(Ending::Off),
            StopCategory::ControlledHold => Some(Ending::Hold),
            StopCategory::DampedLowering { damping } => {
                // A damping that is not a positive number would drive the joint.
                self.damping = damping.map(|d| if d > R::ZERO { d } else { R::ZERO });
                Some(Ending::Lowering)
            }
        }
    }
}
