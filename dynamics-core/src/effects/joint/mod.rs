//! Effects at a joint or its motor, apart from friction.

mod armature;
mod cogging;
mod constant_torque;
mod end_stops;
mod gyroscopic_rotors;
mod spring;

pub use armature::Armature;
pub use cogging::Cogging;
pub use constant_torque::ConstantTorque;
pub use end_stops::EndStops;
pub use gyroscopic_rotors::GyroscopicRotors;
pub use spring::Spring;
