//! Ways that arms go where no scene does.

use firmware_demo::trajectories::{READY, pass, stop};
use motion_control::WayPoint;

pub const PANDA_PICK_AND_PLACE: [WayPoint<f32, 7>; 7] = [
    stop(READY, 0),
    stop([-0.70, -0.30, 0.10, -2.00, 0.05, 1.75, 0.10], 1200),
    stop([-0.70, 0.05, 0.10, -2.00, 0.05, 2.10, 0.10], 700),
    stop([-0.70, -0.30, 0.10, -2.00, 0.05, 1.75, 0.10], 700),
    stop([0.80, -0.20, -0.10, -2.10, -0.05, 1.90, 1.50], 1600),
    stop([0.80, 0.15, -0.10, -2.05, -0.05, 2.20, 1.50], 700),
    stop(READY, 1600),
];

/// The standing posture of a quadruped's leg, rad.
const STANDING: [f32; 3] = [0.0, 0.8, -1.6];

/// Two steps of a quadruped's leg at a trot, one turned outwards: lifted, put ahead, drawn back
/// under the body.
pub const LEG_STEPS: [WayPoint<f32, 3>; 7] = [
    stop(STANDING, 0),
    pass([0.05, 0.95, -2.20], [0.0, -4.0, 0.0], 120),
    stop([0.0, 0.55, -1.50], 120),
    stop(STANDING, 240),
    pass([0.25, 0.95, -2.20], [0.0, -4.0, 0.0], 120),
    stop([0.20, 0.55, -1.50], 120),
    stop(STANDING, 240),
];
