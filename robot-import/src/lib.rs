//! Robots from URDF or MJCF as constants of dynamics-core.

pub mod description;
pub mod error;
pub mod project;
pub mod snap;
pub mod source;
