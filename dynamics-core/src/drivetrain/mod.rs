//! Drivetrains between motors and joints: a constant matrix that couples them, or springs.

mod elastic;
mod elastic_compiled;
mod elastic_inverse_dynamics;
mod elastic_plant;
mod transmission;

pub use elastic::{ElasticJoints, MotorState};
pub use elastic_inverse_dynamics::{
    ElasticCommand, ElasticReference, MultiDofJoint, elastic_inverse_dynamics,
};
pub use elastic_plant::elastic_step;
pub use transmission::Transmission;
