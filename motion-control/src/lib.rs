//! Motion control of robot arms on a microcontroller: reference, estimate, control law, and the
//! safety gate that every command passes; in f32 or f64, with no heap, no panic and no `unsafe`.
//!
//! | item | purpose | memory |
//! |---|---|---|
//! | [`MotionController`] | a control loop without its law and devices: all of the following items with memory | the state of a loop |
//! | [`Trajectory`] | quintics through way-points, checked against speed and acceleration limits | none |
//! | [`RestToRest`] | from stop to stop with four derivatives, for compliant joints | none |
//! | [`MovingGoal`] | a goal that may change at any tick, with limits of velocity, acceleration and jerk | the motion |
//! | [`Reference`] | the reference of a controller: a trajectory, or a user's own motion | |
//! | [`Observer`] | velocity from positions | estimate |
//! | [`ContactDetector`] | external torques beyond thresholds that follow the stated errors of the model | as the observer, thresholds |
//! | [`ContactReaction`] | what an arm does after a contact: stop, go back along its path, float | the last path |
//! | [`MomentumObserver`] | external torques from the momentum of the joints | momentum, external torques |
//! | [`TipWrench`] | the wrench of a contact at the tip, from external torques | none |
//! | [`SensorLoadFit`], [`SensorLoad`] | load and offset of a force sensor, from poses at rest | sums |
//! | [`PayloadEstimator`] | mass, centre of mass and inertia of a load from the torques of the joints | information |
//! | [`ParameterEstimator`] | inertial parameters, frictions and armatures of an arm, from one joint's torque in each update | estimate, covariance |
//! | [`PhysicalParameters`] | parameters that bodies can have, near those of the estimator | the last set |
//! | [`Gains`], [`feedback()`] | K_p (q_d − q) + K_d (q̇_d − q̇) | none |
//! | [`PassivityGains`], [`passivity_based_torque()`] | the law of Slotine & Li: M q̈_r + C q̇_r + g + F − K_D s | none |
//! | [`hold()`] | the reference of a held arm: q̈ = −λ q̇ | none |
//! | [`hybrid_motion_force`], [`TaskCommand`] | motions and forces along a task's directions | none |
//! | [`CartesianImpedance`], [`pose_error()`] | a spring and a damper between a body and its goal, with null space | the modes of the last tick |
//! | [`HandGuiding`] | an arm that a hand moves: friction in part, a speed limit, virtual walls, locked joints | where joints are locked |
//! | [`Breakaway`] | joints that stick: a push and a dither out of a tank of energy | energies, the last steps |
//! | [`HandOver`] | from one law to another without a step of the torque | the difference |
//! | [`InertiaShaping`] | external torques, amplified: an arm that is lighter for a hand | none |
//! | [`TaughtPath`] | way-points of an arm that is guided by hand | the way-points |
//! | [`PathSpline`], [`GeometricPath`] | a smooth path near way-points | none |
//! | [`TimedPath`] | the fastest motion along a path within limits of torque, speed and acceleration | none |
//! | [`ZeroOrderHold`], [`FirstOrderHold`], [`Interpolator`], [`InertiaUpdate`] | the torque in ticks without a computation of the dynamics | last torques |
//! | [`Fault`], [`Reaction`] | what each fault leads to | |
//! | [`FrozenEncoder`], [`ReferenceStep`], [`Saturation`] | faults that take several ticks to show | the last ticks |
//! | [`ThermalLimit`] | torques that no winding overheats by, and how long one can be held | temperatures |
//! | [`TickCounter`], [`Watchdog`] | missed ticks, overruns, and what feeds a watchdog | a count |
//! | [`TipMotion`], [`TipGoal`] | a tip that follows a joystick or goes to a pose, within limits of the joints | the reference |
//! | [`PoseSolver`] | positions of the joints for a pose of the tip | none |
//! | [`Approach`] | the way from any pose to the start of a motion | none |
//! | [`Circles`], [`OnCircles`] | which joints are points on a circle: the short way, at any number of turns | none |
//! | [`BackOff`] | the return of an arm that is beyond its bounds | how far it has come back |
//!
//! Types with a configuration struct have a `try_new`, which checks the struct, and a `new` for
//! constants, which does not.
//!
//! Time is counted in integer ticks of one nominal length; nothing divides by a measured interval.
//! Items without memory give the same bits for the same inputs at any time; items with memory never
//! store a value that they reject. None of them panics or returns NaN.
//!
//! Cargo features, off by default, neither of which changes a number: `defmt` for faults, modes,
//! status, commands and errors; `serde` for limits, gains, configurations and way-points.
//!
//! The control loop of an arm:
//!
//! ```
#![doc = include_str!("example.rs")]
//!
//! let stop = |q, ticks| WayPoint { q, qd: [0.0; 6], ticks };
//! let home = [0.0, -1.57, 1.57, -1.57, -1.57, 0.0];
//! let away = [1.0, -1.2, 1.4, -1.57, -1.57, 0.0];
//! let speeds = [MotionLimits { velocity: 3.0, acceleration: 10.0 }; 6];
//! let trajectory = Trajectory::new(&[stop(home, 0), stop(away, 1000)], TICK, &speeds)?;
//! let torque = [150.0, 150.0, 150.0, 28.0, 28.0, 28.0];
//! let (lower, upper) = ([-6.3; 6], [6.3; 6]);
//! let limits = SafetyLimits { torque, rate: torque, speed: [3.2; 6], lower, upper };
//!
//! let (mut controller, gains) = (controller(limits)?, gains(&home));
//! // Each tick: from what the encoders latched in the tick before to what goes to drives and
//! // brake.
//! for measured in [Ok(&home), Ok(&home), Err(Fault::Encoder { joint: 2 })] {
//!     let command = controller.tick(measured, &trajectory, |reference, estimate| {
//!         law(&gains, reference, estimate)
//!     });
//!     assert_eq!((command.status.fault, command.brake), (measured.err(), false));
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![cfg_attr(not(test), no_std)]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

// The rooms in order; each uses those before it alone.
//
// | room | contents |
// |---|---|
// | `limits` | what a command may be: limits, faults and reactions, the command itself |
// | `estimate` | what is known of the arm |
// | `reference` | where the arm should be |
// | `law` | the torque from a reference and an estimate |
// | `safety` | the gate that every command passes, and what detects faults |
// | `motion` | a whole control loop without its law and devices |
mod estimate;
mod law;
mod limits;
mod motion;
mod reference;
mod safety;
#[cfg(feature = "serde")]
mod serde_form;
#[cfg(test)]
mod tests;

pub use estimate::{
    ContactDetector, DetectedContact, Estimate, Excitation, ImpossibleParameters, MomentumObserver,
    Observer, ObserverConfig, ParameterEstimator, ParameterEstimatorConfig, PayloadEstimator,
    PayloadEstimatorConfig, PhysicalParameters, RecordError, RejectedMeasurement, RejectedRow,
    SelectedParameters, SensorLoad, SensorLoadError, SensorLoadFit, TipWrench, TipWrenchConfig,
};
pub use law::{
    Breakaway, BreakawayConfig, CartesianImpedance, FirstOrderHold, GainTable, Gains, HandGuiding,
    HandGuidingConfig, HandOver, ImpedanceConfig, ImpedanceTorque, InertiaShaping,
    InertiaShapingConfig, InertiaUpdate, Interpolator, LimitedSpring, ModeSearch, PassivityGains,
    SlidingVariable, SpeedBrake, TablePlace, TaskCommand, TaskDeviation, TaskForce, TaskFrame,
    TaskMotion, ZeroOrderHold, feedback, hybrid_motion_force, orientation_error,
    passivity_based_torque, pose_error, quaternion_error,
};
pub use limits::{
    Circles, Command, ConfigError, ConfigParameter, Fault, LimitKind, Mode, MotionLimits, Reaction,
    SafetyLimits, SafetyLimitsError, Status,
};
pub use motion::{
    Approach, ApproachError, BackOff, BackOffConfig, ContactPhase, ContactReaction,
    ContactReactionConfig, ContactResponse, CurrentTick, MeasurementAge, MotionController,
    MotionControllerConfig, ObservedTick, OnCircles, PoseSolution, PoseSolver, PoseSolverError,
    PreviousTick, ReferencedTick, ResetError, TipGoal, TipMotion, TipMotionConfig, TipStatus, hold,
};
pub use reference::{
    GeometricPath, GoalChange, GoalError, JerkLimits, JointFriction, MovingGoal, PathLimits,
    PathPoint, PathSpline, PathSplineError, Recorded, Reference, RestToRest, Shaped, Shaper,
    ShaperError, ShaperProblem, TaughtPath, TimedPath, TimedPathError, Trajectory, TrajectoryError,
    Vibration, WayPoint,
};
pub use safety::{
    CompletedTick, CountedTick, Detect, Detectors, FrozenEncoder, ReferenceStep, Saturation,
    StopCategory, SupervisorConfig, ThermalConfig, ThermalLimit, ThermalState, ThermalStatus,
    TickCounter, Watchdog,
};

use dynamics_core::scalar::Real;

/// A number of ticks as a scalar.
#[inline(always)]
fn real<R: Real>(ticks: u32) -> R {
    // One VCVT in f32: the other conversion, a call into software there, is dead code.
    R::select(f64::from(ticks), ticks as f32)
}

/// √x of a number that is zero or normal and not negative: without the division of the usual
/// routine, which is a call into software.
#[inline(always)]
fn root<R: Real>(x: R) -> R {
    x * x.rsqrt()
}

/// The entry of a joint's coordinate, or zero for a joint that has none.
#[inline(always)]
fn entry<T: Copy + Default>(values: &[T], at: usize) -> T {
    values.get(at).copied().unwrap_or_default()
}
