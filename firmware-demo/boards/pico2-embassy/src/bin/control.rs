//! The control loop of the scene `ur5e` on encoders and drives: the firmware of a project for this
//! board, with this robot in place of the user's. Nothing is simulated.
#![cfg_attr(target_arch = "arm", no_std, no_main)]

#[cfg(target_arch = "arm")]
#[path = "../../../ur5e.rs"]
mod board;
#[cfg(target_arch = "arm")]
// Formatted as users' files are.
#[rustfmt::skip]
#[path = "../firmware.rs"]
mod firmware;
#[cfg(target_arch = "arm")]
#[path = "../../../silent.rs"]
mod log;
#[cfg(target_arch = "arm")]
// Formatted as users' files are.
#[rustfmt::skip]
#[path = "../pins.rs"]
mod pins;

#[cfg(target_arch = "arm")]
use panic_halt as _;

#[cfg(not(target_arch = "arm"))]
fn main() {}
