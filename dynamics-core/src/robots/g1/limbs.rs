//! Legs, waist and arms of the Unitree G1.

use core::f64::consts::PI;

use crate::model::{BASE, Body, Joint, JointLimits};
use crate::robots::welded_part::WeldedPart;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// The source's 0.52 rad in degrees.
const WAIST: f64 = 0.52 * 180.0 / PI;

/// From `lower` to `upper` degrees.
const fn limits(lower: f64, upper: f64, torque: f64, velocity: f64) -> JointLimits<f64> {
    JointLimits { lower: lower * PI / 180.0, upper: upper * PI / 180.0, velocity, torque }
}

/// Limits of a sideways joint: `inner` towards the other side, `outer` away from it.
const fn sideways(
    left: f64,
    inner: f64,
    outer: f64,
    (torque, velocity): (f64, f64),
) -> JointLimits<f64> {
    if left > 0.0 {
        limits(-inner, outer, torque, velocity)
    } else {
        limits(-outer, inner, torque, velocity)
    }
}

/// A part of the left side (`left` 1), or its mirror image (-1).
const fn part(left: f64, mass: f64, [x, y, z]: [f64; 3], i: [f64; 6]) -> WeldedPart {
    WeldedPart {
        mass,
        com: [x, left * y, z],
        inertia: [i[0], left * i[1], i[2], i[3], left * i[4], i[5]],
    }
}

/// Six bodies from hip to foot; `first` is the index of the first.
pub(super) const fn leg(names: [&'static str; 6], first: usize, left: f64) -> [Body; 6] {
    let i = [
        part(
            left,
            1.35,
            [0.002741, 0.047791, -0.02606],
            [0.001811, 3.68e-5, -3.44e-5, 0.0014193, 0.000171, 0.0012812],
        ),
        part(
            left,
            1.52,
            [0.029812, -0.001045, -0.087934],
            [0.0023773, -3.8e-6, -0.0003908, 0.0024123, 1.84e-5, 0.0016595],
        ),
        part(
            left,
            1.702,
            [-0.057709, -0.010981, -0.15078],
            [0.0057774, -0.0005411, -0.0023948, 0.0076124, -0.0007072, 0.003149],
        ),
        // The mirror image would have the same xz on both sides.
        part(
            left,
            1.932,
            [0.005457, 0.003964, -0.12074],
            [0.011329, 4.82e-5, left * -4.49e-5, 0.011277, -0.0007146, 0.0015168],
        ),
        part(
            left,
            0.074,
            [-0.007269, 0.0, 0.011137],
            [8.4e-6, 0.0, -2.9e-6, 1.89e-5, 0.0, 1.26e-5],
        ),
        part(
            left,
            0.608,
            [0.026505, 0.0, -0.016425],
            [0.0002231, 2e-7, 8.91e-5, 0.0016161, -1e-7, 0.0016667],
        ),
    ];
    [
        i[0].of(Body::new(names[0], BASE, Joint::revolute(Y)))
            .xyz([0.0, left * 0.064452, -0.1027])
            .limits(limits(-145.0, 165.0, 88.0, 32.0)),
        i[1].of(Body::new(names[1], first, Joint::revolute(X)))
            .xyz([0.0, left * 0.052, -0.030465])
            .rpy([0.0, -0.1749, 0.0])
            .limits(sideways(left, 30.0, 170.0, (139.0, 20.0))),
        i[2].of(Body::new(names[2], first + 1, Joint::revolute(Z)))
            .xyz([0.025001, 0.0, -0.12412])
            .limits(limits(-158.0, 158.0, 88.0, 32.0)),
        i[3].of(Body::new(names[3], first + 2, Joint::revolute(Y)))
            .xyz([-0.078273, left * 0.0021489, -0.17734])
            .rpy([0.0, 0.1749, 0.0])
            .limits(limits(-5.0, 165.0, 139.0, 20.0)),
        i[4].of(Body::new(names[4], first + 3, Joint::revolute(Y)))
            .xyz([0.0, left * -9.4445e-5, -0.30001])
            .limits(limits(-50.0, 30.0, 35.0, 30.0)),
        i[5].of(Body::new(names[5], first + 4, Joint::revolute(X)))
            .xyz([0.0, 0.0, -0.017558])
            .limits(limits(-15.0, 15.0, 35.0, 30.0)),
    ]
}

/// Seven bodies from shoulder to palm; `first` is the index of the first, which hangs on `torso`.
pub(super) const fn arm(
    names: [&'static str; 7],
    torso: usize,
    first: usize,
    left: f64,
    y: f64,
) -> [Body; 7] {
    let palm = part(
        left,
        0.17,
        [0.05361310808, -0.0029590524, 0.00215413091],
        [
            0.00010099485234748,
            3.618590790516e-5,
            -7.4301518642e-7,
            0.00028135871571621,
            3.30189743286e-6,
            0.00021894770413514,
        ],
    );
    let i = [
        part(
            left,
            0.718,
            [0.0, 0.035892, -0.011628],
            [0.0004291, -9.2e-6, 6.4e-6, 0.000453, 2.26e-5, 0.000423],
        ),
        part(
            left,
            0.643,
            [-0.000227, 0.00727, -0.063243],
            [0.0006177, -1e-6, 8.7e-6, 0.0006912, -5.3e-6, 0.0003894],
        ),
        part(
            left,
            0.734,
            [0.010773, -0.002949, -0.072009],
            [0.0009988, 7.9e-6, 0.0001412, 0.0010605, -2.86e-5, 0.0004354],
        ),
        part(
            left,
            0.6,
            [0.064956, 0.004454, -0.010062],
            [0.0002891, 6.53e-5, 1.72e-5, 0.0004152, -5.6e-6, 0.0004197],
        ),
        part(
            left,
            0.08544498,
            [0.01713944778, 0.00053759094, 4.8864e-7],
            [
                4.821544023e-5,
                -4.24511021e-6,
                5.10599e-9,
                3.722899093e-5,
                -1.23525e-9,
                5.482106541e-5,
            ],
        ),
        part(
            left,
            0.48404956,
            [0.02299989837, -0.00111685314, -0.00111658096],
            [
                0.00016579646273,
                -1.231206746e-5,
                1.231699194e-5,
                0.0004295405741,
                8.1417712e-7,
                0.00042953697654,
            ],
        ),
        part(
            left,
            0.08457647,
            [0.02200381568, 0.00049485096, 0.00053861123],
            [
                4.929128828e-5,
                -4.5735494e-7,
                4.45867591e-6,
                5.973338134e-5,
                4.3217198e-7,
                3.928083826e-5,
            ],
        )
        .with(palm.at([0.0415, left * 0.003, 0.0])),
    ];
    let wrist = limits(-92.5, 92.5, 5.0, 22.0);
    [
        i[0].of(Body::new(names[0], torso, Joint::revolute(Y)))
            .xyz([0.0039563, y, 0.24778])
            .rpy([left * 0.27931, 5.4949e-5, left * -0.00019159])
            .limits(limits(-177.0, 153.0, 25.0, 37.0)),
        i[1].of(Body::new(names[1], first, Joint::revolute(X)))
            .xyz([0.0, left * 0.038, -0.013831])
            .rpy([left * -0.27925, 0.0, 0.0])
            .limits(sideways(left, 91.0, 129.0, (25.0, 37.0))),
        i[2].of(Body::new(names[2], first + 1, Joint::revolute(Z)))
            .xyz([0.0, left * 0.00624, -0.1032])
            .limits(limits(-150.0, 150.0, 25.0, 37.0)),
        i[3].of(Body::new(names[3], first + 2, Joint::revolute(Y)))
            .xyz([0.015783, 0.0, -0.080518])
            .limits(limits(-60.0, 120.0, 25.0, 37.0)),
        i[4].of(Body::new(names[4], first + 3, Joint::revolute(X)))
            .xyz([0.1, left * 0.00188791, -0.01])
            .limits(limits(-113.0, 113.0, 25.0, 37.0)),
        i[5].of(Body::new(names[5], first + 4, Joint::revolute(Y)))
            .xyz([0.038, 0.0, 0.0])
            .limits(wrist),
        i[6].of(Body::new(names[6], first + 5, Joint::revolute(Z)))
            .xyz([0.046, 0.0, 0.0])
            .limits(wrist),
    ]
}

/// Three bodies from waist to torso, the head welded on; `first` is the index of the first.
pub(super) const fn waist(first: usize) -> [Body; 3] {
    let head = WeldedPart {
        mass: 1.036,
        com: [0.005267, 0.000299, 0.449869],
        inertia: [0.004085051, -2.543e-6, -6.9455e-5, 0.004185212, -3.726e-6, 0.001807911],
    };
    let torso = WeldedPart {
        mass: 6.78,
        com: [0.000931, 0.000346, 0.15082],
        inertia: [0.05905, 3.3302e-5, -0.0017715, 0.047014, -2.2399e-5, 0.025652],
    };
    [
        Body::new("waist_yaw", BASE, Joint::revolute(Z))
            .mass(0.214)
            .com([0.003494, 0.000233, 0.018034])
            .inertia([0.00010673, 2.703e-6, -7.631e-6, 0.00010422, -2.01e-7, 0.0001625])
            .limits(limits(-150.0, 150.0, 88.0, 32.0)),
        Body::new("waist_roll", first, Joint::revolute(X))
            .xyz([-0.0039635, 0.0, 0.044])
            .mass(0.086)
            .com([0.0, 2.3e-5, 0.0])
            .inertia([7.079e-6, 0.0, 0.0, 6.339e-6, 0.0, 8.245e-6])
            .limits(limits(-WAIST, WAIST, 35.0, 30.0)),
        torso
            .with(head.at([0.0039635, 0.0, -0.044]))
            .of(Body::new("torso", first + 1, Joint::revolute(Y)))
            .limits(limits(-WAIST, WAIST, 35.0, 30.0)),
    ]
}
