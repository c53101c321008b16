//! Proven rounding errors of machine code over a whole box of states: what `cargo xtask certify` runs.
pub mod decode;
pub mod error;
pub mod graph;
pub mod image;
pub mod interval;
pub mod walk;
pub mod bound;
pub mod branch;
pub mod search;
pub mod state_box;
pub mod gappa;
pub mod sines;
pub mod forms;
