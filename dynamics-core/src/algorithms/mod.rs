//! The algorithms, one a file, for every tree and joint.

mod aba;
mod centroidal;
mod cholesky;
mod composite;
mod crba;
mod damped;
mod eigen;
mod eliminate;
mod energy;
mod error;
mod factor;
mod forward;
pub mod frame;
mod handed;
mod hybrid;
mod jacobian;
mod kinematics;
mod mobility;
mod momentum;
mod operational;
mod operator;
mod recoil;
mod rnea;
mod taken;

pub use aba::{aba, aba_at};
pub use centroidal::{
    centroidal_matrix, centroidal_matrix_at, centroidal_momentum, centroidal_momentum_at,
};
pub use cholesky::{Cholesky, cholesky};
pub use composite::{crba_jacobian, crba_jacobian_at};
pub use crba::{crba, crba_at};
pub use damped::{Conditioning, Damping, damped_inverse};
pub use energy::{kinetic_energy, kinetic_energy_at, potential_energy, potential_energy_at};
pub use error::NotPositiveDefinite;
pub(crate) use factor::MATRIX_ROUNDINGS;
pub use factor::{factor, inverse, solve};
pub use forward::{forward, forward_at};
pub use frame::{Frame, Pose, classical};
pub use hybrid::{Given, Response, hybrid, hybrid_at};
pub use jacobian::{drift, drift_at, jacobian, jacobian_at};
pub use kinematics::{Kinematics, kinematics, kinematics_at, poses, poses_at};
pub use mobility::{Mobility, mobility, mobility_at};
pub use momentum::{MassCentre, mass_centre, mass_centre_at, momentum, momentum_at};
pub use operational::{OperationalSpace, operational_space, operational_space_at, task_rows};
pub use operator::{operator_factor, operator_inverse};
pub use recoil::{with_momentum, with_momentum_at};
pub use rnea::{rnea, rnea_at};
