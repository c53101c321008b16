//! The algorithms, one a file, for every tree and joint.

mod aba;
mod articulated_pass;
mod crba;
mod crba_jacobian;
mod energy;
mod error;
mod forward_dynamics;
mod hybrid;
pub mod kinematics;
mod mass_matrix;
mod momentum;
mod operational_space;
mod pivot_check;
mod rnea;
mod tree_pass;

pub use aba::{aba, aba_at};
pub use crba::{crba, crba_at};
pub use crba_jacobian::{crba_jacobian, crba_jacobian_at};
pub use energy::{kinetic_energy, kinetic_energy_at, potential_energy, potential_energy_at};
pub use error::NotPositiveDefinite;
pub use forward_dynamics::{forward_dynamics, forward_dynamics_at};
pub use hybrid::{JointResult, Prescribed, hybrid_dynamics, hybrid_dynamics_at};
pub use kinematics::{
    Frame, Kinematics, Pose, bias_acceleration, bias_acceleration_at, classical, frame, jacobian,
    jacobian_at, kinematics, kinematics_at, poses, poses_at,
};
pub(crate) use mass_matrix::MATRIX_ROUNDINGS;
pub use mass_matrix::{
    Cholesky, Ltdl, MassMatrix, cholesky, inverse, ltdl, solve, spatial_operator_inverse,
    spatial_operator_ltdl,
};
pub use momentum::{
    CenterOfMass, base_velocity_from_momentum, base_velocity_from_momentum_at, center_of_mass,
    center_of_mass_at, centroidal_matrix, centroidal_matrix_at, centroidal_momentum,
    centroidal_momentum_at, momentum, momentum_at,
};
pub use operational_space::{
    Conditioning, Damping, OperationalSpace, OsimInverse, damped_inverse, operational_space,
    operational_space_at, osim_inverse, osim_inverse_at, task_jacobian,
};
pub use rnea::{rnea, rnea_at};
