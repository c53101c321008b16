//! The states at which the linkages are evaluated.

use super::Start;

/// A crank's angle, rate and acceleration, and guesses of coupler and rocker.
const fn crank(angle: f32, [rate, accel]: [f32; 2], guess: [f32; 2]) -> Start<3> {
    [
        [angle, guess[0], guess[1]],
        [rate, 0.0, 0.0],
        [accel, 0.0, 0.0],
    ]
}

/// A crank anywhere, moving as machines move.
pub(super) const PLAIN: [Start<3>; 4] = [
    crank(-1.0, [2.5, -6.0], [2.15, 2.39]),
    crank(0.5, [-1.75, 8.0], [0.242, 1.782]),
    crank(2.25, [1.25, 5.5], [-1.86, 2.266]),
    crank(-2.5, [-2.0, -9.25], [-3.1, 2.658]),
];

/// The same at ±1000 rad/s, accelerations as large as what that brings about.
pub(super) const FAST: [Start<3>; 4] = {
    let (mut states, mut k) = (PLAIN, 0);
    while k < states.len() {
        states[k][1][0] = if states[k][1][0] < 0.0 { -1e3 } else { 1e3 };
        states[k][2][0] *= 1e5;
        k += 1;
    }
    states
};

/// A crank that has turned 1600 times.
pub(super) const TURNS: [Start<3>; 2] = [
    crank(9999.5, [2.5, -6.0], [-2.2, 2.4]),
    crank(-9999.25, [-1.75, 8.0], [-2.97, 2.648]),
];

/// A parallelogram so far from flat; its coupler keeps its direction.
pub(super) const fn parallelogram(angle: f32) -> [Start<3>; 2] {
    let at = [angle, -angle, angle];
    [
        [at, [1.0, -1.0, 1.0], [2.0, -2.0, 2.0]],
        [at, [-2.0, 2.0, -2.0], [5.0, -5.0, 5.0]],
    ]
}

/// Near a change point at 0, where coupler and rocker turn by 0.0883 and 0.7208 of the crank's
/// angle.
pub(super) const fn changing(angle: f32) -> [Start<3>; 2] {
    let guess = [-0.911_706 * angle, 0.720_785 * angle];
    [
        crank(angle, [1.0, 2.0], guess),
        crank(angle, [-2.0, 5.0], guess),
    ]
}

/// At a change point and still.
pub(super) const AT_REST: [Start<3>; 1] = [[[0.0; 3], [0.0; 3], [2.0, 0.0, 0.0]]];

/// A crank that points away from a rocker, beyond what the coupler bridges.
pub(super) const OUT_OF_REACH: [Start<3>; 2] = [
    crank(3.0, [1.0, 1.0], [3.0, 3.0]),
    crank(-2.0, [1.0, 1.0], [0.5, 0.5]),
];

/// States of the linkage with a crank of 1 mm.
pub(super) const THIN: [Start<3>; 4] = [
    crank(-1.0, [2.5, -6.0], [1.016, 1.546]),
    crank(0.5, [-1.75, 8.0], [-0.485, 1.523]),
    crank(2.25, [1.25, 5.5], [-2.235, 1.617]),
    crank(-2.5, [-2.0, -9.25], [2.516, 1.629]),
];

/// A slider-crank so far from its dead point.
pub(super) const fn slider(angle: f32) -> [Start<3>; 2] {
    let at = [angle, -1.25 * angle, 0.625 - 0.078_125 * angle * angle];
    // At the dead point these are the rates of closed loops.
    [
        [at, [1.0, -1.25, 0.0], [2.0, 0.0, 0.0]],
        [at, [-2.0, 2.5, 0.0], [5.0, 0.0, 0.0]],
    ]
}

/// States of the rig with three motors.
pub(super) const RIG: [Start<4>; 4] = [
    rig([-2.25, 1.542, -0.875, -1.549], [2.5, -1.0], [-6.0, 3.0]),
    rig([-2.0, 1.175, -1.0, -1.247], [-1.75, 2.0], [8.0, 5.0]),
    rig([-2.5, 1.562, -1.25, -1.282], [1.25, 1.5], [5.5, -7.0]),
    rig([-1.75, 1.203, -0.5, -1.613], [-2.0, -1.5], [-9.25, 2.5]),
];

const fn rig(q: [f32; 4], [a, b]: [f32; 2], [c, d]: [f32; 2]) -> Start<4> {
    [q, [a, 0.0, b, 0.0], [c, 0.0, d, 0.0]]
}
