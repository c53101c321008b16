//! The algorithms, one a file, for every tree and joint.

pub(crate) mod aba;
mod articulated_pass;
mod coriolis_matrix;
pub(crate) mod crba;
mod crba_jacobian;
mod derivatives;
mod energy;
mod error;
mod forms;
mod forward_dynamics;
mod forward_error;
mod hybrid_dynamics;
mod joint_result;
pub mod kinematics;
pub(crate) mod mass_matrix;
mod momentum;
mod operational_space;
pub(crate) mod pivot_check;
mod regressor;
pub(crate) mod rnea;
mod rnea_two_velocities;
pub(crate) mod rotors;
mod transmitted;
pub(crate) mod tree_pass;
mod wrenches;

pub use coriolis_matrix::coriolis_matrix;
pub use crba_jacobian::crba_jacobian;
pub(crate) use derivatives::named_derivatives;
pub use derivatives::{
    AccelerationGradient, Linearisation, TorqueGradient, forward_dynamics_derivatives, rnea_along,
    rnea_derivatives, rnea_transposed,
};
pub use energy::{kinetic_energy, potential_energy};
pub use error::NotPositiveDefinite;
pub use forms::{aba, crba, rnea};
pub use forward_dynamics::forward_dynamics;
pub use forward_error::{EstimatedAcceleration, acceleration_error, forward_dynamics_with_error};
pub use hybrid_dynamics::hybrid_dynamics;
pub use joint_result::{JointResult, Prescribed};
pub use kinematics::{
    Frame, Kinematics, Pose, bias_acceleration, classical, frame, jacobian, kinematics, poses,
};
pub use mass_matrix::{
    Cholesky, Ltdl, MassMatrix, cholesky, inverse, ltdl, solve, spatial_operator_inverse,
    spatial_operator_ltdl,
};
pub(crate) use mass_matrix::{MATRIX_ROUNDINGS, ltdl_in_place};
pub use momentum::{
    CenterOfMass, MomentumAndCoriolis, MomentumAndDrift, base_velocity_from_momentum,
    center_of_mass, centroidal_matrix, centroidal_momentum, momentum, momentum_and_coriolis,
    momentum_and_drift,
};
pub(crate) use operational_space::shifted_inverse;
pub use operational_space::{
    Conditioning, Damping, OperationalSpace, OsimInverse, damped_inverse, jacobian_rows,
    operational_space, osim_inverse, task_jacobian,
};
#[doc(hidden)]
pub use operational_space::{eigen, shifted_solution};
pub(crate) use pivot_check::Magnitude;
pub use regressor::{
    friction_regressor, inertial_parameters, regressor, regressor_columns, regressor_row,
    regressor_row_of_bodies,
};
pub use rnea_two_velocities::rnea_two_velocities;
pub use transmitted::{motor_torque, transmitted_torque};
pub(crate) use tree_pass::{inward, per_body};
pub use wrenches::{TorquesAndWrenches, rnea_and_wrenches};
