//! Ways that arms go, for scenes and for what is computed of them on a host.

use core::f32::consts::{FRAC_PI_2, FRAC_PI_4};

use motion_control::WayPoint;

pub mod hop;
pub mod picks;
pub mod swing_and_back;
pub mod watch;

/// Where the UR5e's pick and place begins and ends, rad.
pub const HOME: [f32; 6] = [0.0, -FRAC_PI_2, FRAC_PI_2, -FRAC_PI_2, -FRAC_PI_2, 0.0];

/// The UR5e's pick and place.
pub const PICK_AND_PLACE: [WayPoint<f32, 6>; 9] = [
    stop(HOME, 0),
    pass(
        [-0.70, -1.35, 1.75, -1.97, -FRAC_PI_2, -0.70],
        [0.0, 0.35, 0.25, -0.6, 0.0, 0.0],
        1000,
    ),
    stop([-0.70, -1.05, 1.85, -2.37, -FRAC_PI_2, -0.70], 600),
    stop([-0.70, -1.35, 1.75, -1.97, -FRAC_PI_2, -0.70], 600),
    pass(
        [0.30, -1.45, 1.55, -1.67, -FRAC_PI_2, 0.30],
        [1.9, 0.0, 0.0, 0.0, 0.0, 1.9],
        1000,
    ),
    stop([1.10, -1.30, 1.70, -1.97, -FRAC_PI_2, 1.10], 900),
    stop([1.10, -0.95, 1.80, -2.42, -FRAC_PI_2, 1.10], 600),
    stop([1.10, -1.30, 1.70, -1.97, -FRAC_PI_2, 1.10], 600),
    stop(HOME, 1400),
];

/// Where the Panda begins and ends, rad.
pub const READY: [f32; 7] = [
    0.0,
    -FRAC_PI_4,
    0.0,
    -3.0 * FRAC_PI_4,
    0.0,
    FRAC_PI_2,
    FRAC_PI_4,
];

/// Where the iiwa 14 swings from, rad.
pub const UPRIGHT: [f32; 7] = [0.0, 0.4, 0.0, -1.2, 0.0, 0.8, 0.0];

/// A swing of the iiwa 14 there and back.
pub const SWING: [WayPoint<f32, 7>; 4] = [
    stop(UPRIGHT, 0),
    stop([0.7, 0.9, 0.3, -0.8, 0.5, 0.3, 0.6], 1300),
    stop([-0.5, 0.7, -0.3, -1.5, -0.5, 1.0, -0.6], 2100),
    stop(UPRIGHT, 1300),
];

/// The Panda carries a part from low to low, at rest there while the gripper moves: points 2 to 3 and 6 to 7.
pub const PANDA_CARRY: [WayPoint<f32, 7>; 10] = [
    stop(READY, 0),
    stop([-0.70, -0.30, 0.10, -2.00, 0.05, 1.75, 0.10], 700),
    stop([-0.70, 0.05, 0.10, -2.00, 0.05, 2.10, 0.10], 550),
    stop([-0.70, 0.05, 0.10, -2.00, 0.05, 2.10, 0.10], 200),
    stop([-0.70, -0.30, 0.10, -2.00, 0.05, 1.75, 0.10], 550),
    stop([0.80, -0.20, -0.10, -2.10, -0.05, 1.90, 1.50], 1350),
    stop([0.80, 0.15, -0.10, -2.05, -0.05, 2.20, 1.50], 550),
    stop([0.80, 0.15, -0.10, -2.05, -0.05, 2.20, 1.50], 200),
    stop([0.80, -0.20, -0.10, -2.10, -0.05, 1.90, 1.50], 550),
    stop(READY, 800),
];

/// Where the SCARA's begins and ends, rad.
pub const ASIDE: [f32; 3] = [-0.9, 1.6, -0.7];

/// The SCARA serves a table: from a feeder to two places and back, at rest there for a grip.
pub const SCARA_SERVES: [WayPoint<f32, 3>; 10] = [
    stop(ASIDE, 0),
    stop([-0.4, 0.7, 0.9], 360),
    stop([-0.4, 0.7, 0.9], 80),
    stop([0.5, 1.6, -0.9], 400),
    stop([0.5, 1.6, -0.9], 80),
    stop([-0.4, 0.7, 0.9], 400),
    stop([-0.4, 0.7, 0.9], 80),
    pass([0.2, -0.1, 0.3], [2.2, -3.0, -2.5], 240),
    stop([0.6, -0.7, 0.0], 280),
    stop(ASIDE, 640),
];

/// Where the SO-101's path begins and ends, rad: folded above the table.
pub const SO101_START: [f32; 6] = [0.0, -1.2, 1.2, 0.8, 0.0, 0.2];

/// A path that the SO-101 is taught: to a part, down, the jaw closes, up, over, down, and back; ticks of 2 ms.
pub const TAUGHT: [WayPoint<f32, 6>; 8] = [
    stop(SO101_START, 0),
    stop([-0.6, -0.2, 0.5, 0.9, 0.4, 1.2], 600),
    stop([-0.6, 0.3, 0.3, 0.8, 0.4, 1.2], 350),
    stop([-0.6, 0.3, 0.3, 0.8, 0.4, 0.2], 350),
    stop([-0.6, -0.3, 0.6, 0.9, 0.4, 0.2], 350),
    stop([0.8, -0.2, 0.5, 0.9, -0.5, 0.2], 700),
    stop([0.8, 0.3, 0.2, 0.8, -0.5, 0.9], 400),
    stop(SO101_START, 850),
];

/// Ticks from the first way-point to this one.
pub const fn arrival<const N: usize>(way: &[WayPoint<f32, N>], point: usize) -> u32 {
    let (mut ticks, mut i) = (0, 0);
    while i <= point {
        ticks += way[i].ticks;
        i += 1;
    }
    ticks
}

/// Where the space arm is folded away, rad.
pub const STOWED: [f32; 6] = [0.0, -1.2, 2.4, -1.2, 0.0, 0.0];

/// The space arm reaches out for something that drifts by, pulls it in, and folds.
pub const REACH_OUT: [WayPoint<f32, 6>; 6] = [
    stop(STOWED, 0),
    stop([0.7, -0.9, 1.3, -0.4, 0.0, 0.8], 1800),
    stop([1.0, -0.3, 0.7, -0.4, 0.4, 1.2], 1400),
    stop([1.0, -0.9, 1.7, -0.8, 0.4, 1.2], 1400),
    stop([-0.9, -1.0, 1.9, -0.9, -0.3, -0.6], 2600),
    stop(STOWED, 2000),
];

/// The configuration in which the steps of a humanoid's leg begin and end: knee, pitch and roll of the ankle, rad.
pub const MID_STANCE: [f32; 3] = [0.3, -0.15, 0.0];

/// Two steps of a humanoid's leg in the air: knee, pitch and roll of the ankle. The heel rises, the leg swings, the
/// heel comes down, and the foot follows the ground; it rolls to the left in the first and to the right in the second.
pub const ANKLE_STEPS: [WayPoint<f32, 3>; 11] = [
    stop(MID_STANCE, 0),
    pass([0.75, 0.40, 0.08], [4.0, 0.0, 0.0], 220),
    pass([1.10, -0.05, 0.15], [0.0, -2.0, 0.0], 150),
    stop([0.08, -0.10, 0.06], 280),
    stop([0.30, 0.15, -0.06], 130),
    stop(MID_STANCE, 220),
    pass([0.75, 0.40, -0.08], [4.0, 0.0, 0.0], 220),
    pass([1.10, -0.05, -0.15], [0.0, -2.0, 0.0], 150),
    stop([0.08, -0.10, -0.06], 280),
    stop([0.30, 0.15, 0.06], 130),
    stop(MID_STANCE, 220),
];

/// A way-point at rest.
pub const fn stop<const N: usize>(q: [f32; N], ticks: u32) -> WayPoint<f32, N> {
    pass(q, [0.0; N], ticks)
}

/// A way-point that the arm passes at speed.
pub const fn pass<const N: usize>(q: [f32; N], qd: [f32; N], ticks: u32) -> WayPoint<f32, N> {
    WayPoint { q, qd, ticks }
}
