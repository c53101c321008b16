//! What a user of `cargo xtask` sees: the tests start it as a process and signal it, as Unix does.
#![cfg(unix)]

mod manners;
mod meter_command;
mod support;
