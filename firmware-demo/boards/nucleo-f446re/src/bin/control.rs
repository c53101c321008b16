//! The control loop of the scene `ur5e` on encoders and drives: the firmware of a project for this
//! board, with this robot in place of the user's. Nothing is simulated.
#![cfg_attr(target_arch = "arm", no_std, no_main)]

#[cfg(target_arch = "arm")]
#[path = "../../../ur5e.rs"]
mod board;
#[cfg(target_arch = "arm")]
// Formatted as users' files are.
#[rustfmt::skip]
#[path = "../../../../../tools/robot-import/template/board/stm32f4/src/chip.rs"]
mod chip;
#[cfg(target_arch = "arm")]
// Formatted as users' files are.
#[rustfmt::skip]
#[path = "../../../../../tools/robot-import/template/board/rtic/src/devices.rs"]
mod devices;
#[cfg(target_arch = "arm")]
// Formatted as users' files are.
#[rustfmt::skip]
#[path = "../../../../../tools/robot-import/template/board/rtic/src/firmware.rs"]
mod firmware;
#[cfg(target_arch = "arm")]
#[path = "../../../silent.rs"]
mod log;
#[cfg(target_arch = "arm")]
// Formatted as users' files are.
#[rustfmt::skip]
#[path = "../../../../../tools/robot-import/template/board/nucleo-f446re/src/pins.rs"]
mod pins;

#[cfg(target_arch = "arm")]
use panic_halt as _;

#[cfg(not(target_arch = "arm"))]
fn main() {}
