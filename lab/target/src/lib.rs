//! Programs that measure on the target, and those that tests run there. The demo's scenes, robots
//! and plants are in [`firmware_demo`]; nothing that ships depends on this crate.
//!
//! | module | contents |
//! |---|---|
//! | [`accuracy`] | the ways to compute a torque that `cargo xtask accuracy` compares |
//! | [`effect_presets`] | every effect with numbers |
//! | [`faults`] | arms under injected faults, on host and target |
//! | [`hard`] | hard cases that host and target share |
//! | [`recorded`] | digests of the dynamics' results on recorded states |
//! | [`trajectories`] | ways that arms go where no scene does |
#![no_std]

pub mod accuracy;
pub mod effect_presets;
pub mod faults;
pub mod hard;
mod own;
pub mod recorded;
pub mod trajectories;

pub use own::Own;
