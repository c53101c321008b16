//! Control: reference, estimate, control law, and the safety gate that every command passes.
//!
//! | item | purpose | memory |
//! |---|---|---|
//! | [`MotionController`] | a control loop without its law and devices: all of the following items with memory | the state of a loop |
//! | [`Trajectory`] | quintics through way-points, checked against speed and acceleration limits | none |
//! | [`RestToRest`] | from stop to stop with four derivatives, for compliant joints | none |
//! | [`Reference`] | the reference of a controller: a trajectory, or a user's own motion | |
//! | [`MultiTurnEncoder`] | the position of an encoder over many turns | counts |
//! | [`Observer`] | velocity from positions | estimate |
//! | [`ContactDetector`] | external torques beyond thresholds that follow the stated errors of the model | as the observer, thresholds |
//! | [`ContactReaction`] | what an arm does after a contact: stop, go back along its path, float | the last path |
//! | [`MomentumObserver`] | external torques from the momentum of the joints | momentum, external torques |
//! | [`TipWrench`] | the wrench of a contact at the tip, from external torques | none |
//! | [`PayloadEstimator`] | mass, centre of mass and inertia of a load from the torques of the joints | information |
//! | [`ParameterEstimator`] | inertial parameters, frictions and armatures of an arm, from one joint's torque in each update | estimate, covariance |
//! | [`PhysicalParameters`] | parameters that bodies can have, near those of the estimator | the last set |
//! | [`Gains`], [`feedback()`] | K_p (q_d − q) + K_d (q̇_d − q̇) | none |
//! | [`PassivityGains`], [`passivity_based_torque()`] | the law of Slotine & Li: M q̈_r + C q̇_r + g + F − K_D s | none |
//! | [`hold()`] | the reference of a held arm: q̈ = −λ q̇ | none |
//! | [`hybrid_motion_force`], [`TaskCommand`] | motions and forces along a task's directions | none |
//! | [`CartesianImpedance`], [`pose_error()`] | a spring and a damper between a body and its goal, with null space | none |
//! | [`HandGuiding`] | an arm that a hand moves: friction in part, virtual walls, locked joints | where joints are locked |
//! | [`InertiaShaping`] | external torques, amplified: an arm that is lighter for a hand | none |
//! | [`TaughtPath`] | way-points of an arm that is guided by hand | the way-points |
//! | [`PathSpline`], [`GeometricPath`] | a smooth path near way-points | none |
//! | [`TimedPath`] | the fastest motion along a path within limits of torque, speed and acceleration | none |
//! | [`ZeroOrderHold`], [`FirstOrderHold`], [`Interpolator`], [`InertiaUpdate`] | the torque in ticks without a computation of the dynamics | last torques |
//! | [`Supervisor`] | limits, plausibility, reactions to faults | last good values |
//! | [`Fault`], [`Reaction`] | what each fault leads to | |
//! | [`FrozenEncoder`], [`ReferenceStep`], [`Saturation`] | faults that take several ticks to show | the last ticks |
//! | [`TickCounter`], [`Watchdog`] | missed ticks, overruns, and what feeds a watchdog | a count |
//! | [`Approach`] | the way from any pose to the start of a motion | none |
//! | [`BackOff`] | the return of an arm that is beyond its bounds | how far it has come back |
//! | [`ResumeTrajectory`] | the return onto the trajectory after a fault | reference |
//!
//! Types with a configuration struct have a `try_new`, which checks the struct, and a `new` for constants, which does
//! not.
//!
//! Time is counted in integer ticks of one nominal length; nothing divides by a measured interval. Items without memory
//! give the same bits for the same inputs at any time; items with memory never store a value that they reject. None of
//! them panics or returns NaN.
//!
//! The control loop of an arm:
//!
//! ```
#![doc = include_str!("example.rs")]
//!
//! let stop = |q, ticks| WayPoint { q, qd: [0.0; 6], ticks };
//! let (home, away) = ([0.0, -1.57, 1.57, -1.57, -1.57, 0.0], [1.0, -1.2, 1.4, -1.57, -1.57, 0.0]);
//! let speeds = [MotionLimits { velocity: 3.0, acceleration: 10.0 }; 6];
//! let trajectory = Trajectory::new(&[stop(home, 0), stop(away, 1000)], TICK, &speeds)?;
//! let torque = [150.0, 150.0, 150.0, 28.0, 28.0, 28.0];
//! let limits = SafetyLimits { torque, rate: torque, speed: [3.2; 6], lower: [-6.3; 6], upper: [6.3; 6] };
//!
//! let (mut controller, gains) = (controller(limits)?, gains(&home));
//! // Each tick: from what the encoders latched in the tick before to what goes to drives and brake.
//! for measured in [Ok(&home), Ok(&home), Err(Fault::Encoder { joint: 2 })] {
//!     let command = controller.tick(measured, &trajectory, |reference, estimate| {
//!         law(&gains, reference, estimate)
//!     });
//!     assert_eq!((command.status.fault, command.brake), (measured.err(), false));
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod approach;
mod back_off;
mod command;
mod config_error;
mod contact_detector;
mod contact_reaction;
mod controller;
mod detectors;
mod fault;
mod feedback;
mod geometric_path;
mod hand_guiding;
mod hold;
mod hybrid_force;
mod impedance;
mod inertia_shaping;
mod momentum_observer;
mod multi_turn;
mod multirate;
mod observer;
mod parameter_estimator;
mod passivity;
mod path_spline;
mod payload_estimator;
mod pose_error;
mod reaction;
mod reference;
mod resume;
mod safety_limits;
mod shaper;
mod supervisor;
mod taught_path;
mod tick_counter;
mod timed_path;
mod tip_wrench;
mod trajectory;

pub use approach::{Approach, ApproachError};
pub use back_off::{BackOff, BackOffConfig};
pub use command::{Command, Mode, Status};
pub use config_error::{ConfigError, ConfigParameter};
pub use contact_detector::{ContactDetector, DetectedContact};
pub use contact_reaction::{ContactPhase, ContactReaction, ContactReactionConfig, ContactResponse};
pub use controller::{
    CurrentTick, MeasurementAge, MotionController, MotionControllerConfig, ObservedTick,
    PreviousTick, ReferencedTick, ResetError,
};
pub use detectors::{Detect, Detectors, FrozenEncoder, ReferenceStep, Saturation};
pub use fault::Fault;
pub use feedback::{Gains, feedback};
pub use geometric_path::{GeometricPath, PathPoint};
pub use hand_guiding::{HandGuiding, HandGuidingConfig, LimitedSpring};
pub use hold::hold;
pub use hybrid_force::{
    TaskCommand, TaskForce, TaskFrame, TaskMotion, hybrid_motion_force, orientation_error,
};
pub use impedance::{CartesianImpedance, ImpedanceConfig, ImpedanceTorque, TaskDeviation};
pub use inertia_shaping::{InertiaShaping, InertiaShapingConfig};
pub use momentum_observer::MomentumObserver;
pub use multi_turn::MultiTurnEncoder;
pub use multirate::{FirstOrderHold, InertiaUpdate, Interpolator, ZeroOrderHold};
pub use observer::{Estimate, Observer, ObserverConfig};
pub use parameter_estimator::{
    Excitation, ImpossibleParameters, ParameterEstimator, ParameterEstimatorConfig,
    PhysicalParameters, RecordError, RejectedRow, SelectedParameters,
};
pub use passivity::{PassivityGains, SlidingVariable, passivity_based_torque};
pub use path_spline::{PathSpline, PathSplineError};
pub use payload_estimator::{PayloadEstimator, PayloadEstimatorConfig, RejectedMeasurement};
pub use pose_error::{pose_error, quaternion_error};
pub use reaction::Reaction;
pub use reference::Reference;
pub use resume::{ResumeConfig, ResumeTrajectory};
pub use safety_limits::{LimitKind, SafetyLimits, SafetyLimitsError};
pub use shaper::{Shaped, Shaper, ShaperError, ShaperProblem, Vibration};
pub use supervisor::{StopCategory, Supervisor, SupervisorConfig, SupervisorTick};
pub use taught_path::{Recorded, TaughtPath};
pub use tick_counter::{CompletedTick, CountedTick, TickCounter, Watchdog};
pub use timed_path::{JointFriction, PathLimits, TimedPath, TimedPathError};
pub use tip_wrench::{TipWrench, TipWrenchConfig};
pub use trajectory::{MotionLimits, RestToRest, Trajectory, TrajectoryError, WayPoint};

use crate::scalar::Real;

/// A number of ticks as a scalar.
#[inline(always)]
fn real<R: Real>(ticks: u32) -> R {
    // One VCVT in f32: the other conversion, a call into software there, is dead code.
    R::select(f64::from(ticks), ticks as f32)
}
