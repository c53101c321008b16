//! The engine beside the textbook and the recordings, in one program: each robot, scalar and set of
//! effects is compiled once.

mod bad_input;
mod contract;
mod derivatives;
mod engine;
mod laws;
mod matrix;
mod oracle;
mod pruned;
mod singular_across;
mod singular_engine;
mod wrenches;
