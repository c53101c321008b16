//! The states at which the arms are evaluated.

use super::Numbers;

/// Joints anywhere, moving as arms move; drawn once.
pub const COMMON: [Numbers; 4] = [
    [
        [-1.092, -2.165, 0.936, -2.651, 0.222, -0.833],
        [-2.652, 0.045, -2.775, -0.398, -2.581, -2.456],
        [-1.51, 6.537, -7.524, -5.535, 2.549, 8.954],
    ],
    [
        [0.478, -0.641, 2.953, -2.811, 2.223, -1.304],
        [-2.134, -2.293, -1.149, 1.897, -1.916, 0.49],
        [2.778, -2.552, 0.955, -8.744, -8.808, -5.881],
    ],
    [
        [1.118, -0.449, -1.152, 0.53, -0.29, -1.241],
        [1.766, 1.194, -1.535, 0.447, 0.151, 2.251],
        [4.589, -4.241, 9.603, -7.639, -1.638, 5.143],
    ],
    [
        [-2.158, -0.068, -2.857, 1.043, 1.64, 0.453],
        [2.253, -1.118, 1.172, 0.566, 0.479, -0.263],
        [6.799, 8.894, -0.518, 3.283, -8.787, 4.03],
    ],
];

/// As [`COMMON`], the joints turning at ±1000 rad/s, accelerations as large as what that brings
/// about.
pub const FAST: [Numbers; 4] = {
    let (mut states, mut k) = (COMMON, 0);
    while k < states.len() {
        let mut i = 0;
        while i < super::N {
            states[k][1][i] = if states[k][1][i] < 0.0 { -1e3 } else { 1e3 };
            states[k][2][i] *= 1e5;
            i += 1;
        }
        k += 1;
    }
    states
};

/// As [`COMMON`], for an arm 2⁻⁴ as long, whose pendulums swing 2² as fast.
pub const QUICK: [Numbers; 4] = paced(4.0);

/// As [`COMMON`], for an arm 2⁴ as long.
pub const SLOW: [Numbers; 4] = paced(0.25);

/// As [`COMMON`], faster by this factor.
const fn paced(by: f32) -> [Numbers; 4] {
    let (mut states, mut k) = (COMMON, 0);
    while k < states.len() {
        let mut i = 0;
        while i < super::N {
            states[k][1][i] *= by;
            states[k][2][i] *= by * by;
            i += 1;
        }
        k += 1;
    }
    states
}

/// As [`COMMON`], the joints at +75° and −75° by turns, and the other way round.
pub const ZIGZAG: [Numbers; 2] = {
    const TURN: f32 = 75.0 * (core::f32::consts::PI / 180.0);
    let mut states = [COMMON[0], COMMON[1]];
    let mut i = 0;
    while i < super::N {
        states[0][0][i] = if i % 2 == 0 { TURN } else { -TURN };
        states[1][0][i] = -states[0][0][i];
        i += 1;
    }
    states
};

/// As [`COMMON`], the joints at k π/2, and a unit in the last place beside it.
pub const QUARTERS: [Numbers; 6] = {
    // k of each joint, in two poses.
    const TURNS: [[i32; super::N]; 2] = [[1, -1, 2, -3, 0, 5], [-2, 3, 1, 4, -1, -4]];
    let (mut states, mut k) = ([COMMON[0]; 6], 0);
    while k < states.len() {
        states[k] = COMMON[k % 4];
        let mut i = 0;
        while i < super::N {
            let quarter = (TURNS[k / 3][i] as f64 * core::f64::consts::FRAC_PI_2) as f32;
            states[k][0][i] = match k % 3 {
                0 => quarter,
                1 => quarter.next_up(),
                _ => quarter.next_down(),
            };
            i += 1;
        }
        k += 1;
    }
    states
};

/// As [`COMMON`], each joint at the remainder of 10⁶ rad after whole turns, counted in integers.
pub const REMAINDERS: [Numbers; 4] = {
    let (mut states, mut k) = (COMMON, 0);
    while k < states.len() {
        let mut i = 0;
        while i < super::N {
            states[k][0][i] = remainder(counts(k, i));
            i += 1;
        }
        k += 1;
    }
    states
};

/// The counts of joint `i` in state `k`: about ±10⁶ rad on an encoder of 12 bits a turn.
pub const fn counts(k: usize, i: usize) -> i32 {
    let counts = 651_898_647 + 7919 * (k as i32 * 6 + i as i32);
    if i.is_multiple_of(2) { counts } else { -counts }
}

/// The angle within ±π of a number of counts, 4096 a turn.
pub const fn remainder(counts: i32) -> f32 {
    const PER_COUNT: f32 = (core::f64::consts::TAU / 4096.0) as f32;
    ((counts << 20) >> 20) as f32 * PER_COUNT
}
