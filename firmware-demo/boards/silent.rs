//! In place of the log of a project for this board: what is measured here says nothing.

use joint_drivers::Telemetry;
use motion_control::motion::ResetError;

use crate::board::N;

pub struct Log;

impl Log {
    pub const fn new() -> Self {
        Self
    }

    pub fn tick(&mut self, _: &Telemetry<N>) {}

    #[allow(dead_code, reason = "the Pico 2 says nothing of its devices")]
    pub fn say(&mut self, (): ()) {}

    pub fn refused(&mut self, _: ResetError) {}
}

pub fn impossible<E>(_: &E) {}
