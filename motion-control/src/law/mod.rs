//! The torque from a reference and an estimate.

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
pub use feedback::{Gains, feedback};
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
