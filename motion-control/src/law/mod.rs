//! The torque from a reference and an estimate.
//!
//! | item | purpose | memory |
//! |---|---|---|
//! | [`Gains`], [`feedback()`] | K_p (q_d − q) + K_d (q̇_d − q̇) | none |
//! | [`AccelerationGains`] | M (q̈_d + K_p (q_d − q) + K_d (q̇_d − q̇)) + … | inverse dynamics |
//! | [`PassivityGains`], [`passivity_based_torque()`] | the law of Slotine & Li: M q̈_r + C q̇_r + g + F − K_D s | none |
//! | [`hybrid_motion_force`], [`TaskCommand`] | motions and forces along a task's directions | none |
//! | [`CartesianImpedance`], [`pose_error()`] | a spring and a damper between a body and its goal, with null space | the modes of the last tick |
//! | [`HandGuiding`] | an arm that a hand moves: friction in part, a speed limit, virtual walls, locked joints | where joints are locked |
//! | [`Breakaway`] | joints that stick: a push and a dither out of a tank of energy | energies, the last steps |
//! | [`HandOver`] | from one law to another without a step of the torque | the difference |
//! | [`InertiaShaping`] | external torques, amplified: an arm that is lighter for a hand | none |
//! | [`ZeroOrderHold`], [`FirstOrderHold`], [`Interpolator`], [`InertiaUpdate`] | the torque in ticks without a computation of the dynamics | last torques |

pub(crate) mod breakaway;
pub(crate) mod feedback;
pub(crate) mod gain_table;
pub(crate) mod hand_guiding;
pub(crate) mod hand_over;
pub(crate) mod hybrid_force;
pub(crate) mod impedance;
pub(crate) mod inertia_shaping;
pub(crate) mod multirate;
pub(crate) mod passivity;
pub(crate) mod pose_error;

pub use breakaway::{Breakaway, BreakawayConfig};
pub use feedback::{AccelerationGains, Feedback, Gains, feedback};
pub use gain_table::{GainTable, TablePlace};
pub use hand_guiding::{HandGuiding, HandGuidingConfig, LimitedSpring, SpeedBrake};
pub use hand_over::HandOver;
pub use hybrid_force::{
    TaskCommand, TaskForce, TaskFrame, TaskMotion, hybrid_motion_force, orientation_error,
};
pub use impedance::{
    CartesianImpedance, ImpedanceConfig, ImpedanceTorque, ModeSearch, TaskDeviation,
};
pub use inertia_shaping::{InertiaShaping, InertiaShapingConfig};
pub use multirate::{FirstOrderHold, InertiaUpdate, Interpolator, ZeroOrderHold};
pub use passivity::{PassivityGains, SlidingVariable, passivity_based_torque};
pub use pose_error::{pose_error, quaternion_error};
