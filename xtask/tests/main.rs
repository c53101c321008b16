//! The behaviour of `cargo xtask` for a user: the tests start it as a process and signal it, as
//! Unix does.
#![cfg(unix)]

mod manners;
mod meter_command;
mod support;
