//! Effects on all bodies: gravity, M q̈, the velocity products, a base that moves.

mod bias;
mod gravity;
mod inertia_coriolis;
mod moving_base;
mod resting;

pub(crate) use bias::{Bias, OfBodies};
pub use gravity::{Direction, Down, Gravity};
pub use inertia_coriolis::{Coriolis, Elasticity, Inertia, RIGID_BODY};
pub use moving_base::{GravityVector, MovingBase};
pub(crate) use resting::Resting;
