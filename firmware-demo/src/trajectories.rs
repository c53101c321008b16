//! Ways that arms go, for the laboratory, for tests and for several scenes; what one scene alone
//! uses is in its file.

use core::f32::consts::{FRAC_PI_2, FRAC_PI_4};

use motion_control::reference::WayPoint;

pub mod hop;
pub mod picks;
pub mod swing_and_back;
pub mod watch;

/// The start and end of the UR5e's pick and place, rad.
pub const HOME: [f32; 6] = [0.0, -FRAC_PI_2, FRAC_PI_2, -FRAC_PI_2, -FRAC_PI_2, 0.0];

pub const PICK_AND_PLACE: [WayPoint<f32, 6>; 9] = [
    stop(HOME, 0),
    pass([-0.70, -1.35, 1.75, -1.97, -FRAC_PI_2, -0.70], [0.0, 0.35, 0.25, -0.6, 0.0, 0.0], 1000),
    stop([-0.70, -1.05, 1.85, -2.37, -FRAC_PI_2, -0.70], 600),
    stop([-0.70, -1.35, 1.75, -1.97, -FRAC_PI_2, -0.70], 600),
    pass([0.30, -1.45, 1.55, -1.67, -FRAC_PI_2, 0.30], [1.9, 0.0, 0.0, 0.0, 0.0, 1.9], 1000),
    stop([1.10, -1.30, 1.70, -1.97, -FRAC_PI_2, 1.10], 900),
    stop([1.10, -0.95, 1.80, -2.42, -FRAC_PI_2, 1.10], 600),
    stop([1.10, -1.30, 1.70, -1.97, -FRAC_PI_2, 1.10], 600),
    stop(HOME, 1400),
];

/// The Panda's first and last configuration, rad.
pub const READY: [f32; 7] = [0.0, -FRAC_PI_4, 0.0, -3.0 * FRAC_PI_4, 0.0, FRAC_PI_2, FRAC_PI_4];

/// The start and end of the SO-101's path, rad: folded above the table.
pub const SO101_START: [f32; 6] = [0.0, -1.2, 1.2, 0.8, 0.0, 0.2];

/// The folded posture of the space arm, rad.
pub const STOWED: [f32; 6] = [0.0, -1.2, 2.4, -1.2, 0.0, 0.0];

/// The configuration in which the steps of a humanoid's leg begin and end: knee, pitch and roll of
/// the ankle, rad.
pub const MID_STANCE: [f32; 3] = [0.3, -0.15, 0.0];

pub const fn stop<const N: usize>(q: [f32; N], ticks: u32) -> WayPoint<f32, N> {
    pass(q, [0.0; N], ticks)
}

/// A way-point that the arm passes at speed.
pub const fn pass<const N: usize>(q: [f32; N], qd: [f32; N], ticks: u32) -> WayPoint<f32, N> {
    WayPoint { q, qd, ticks }
}
