//! A Delta robot (Clavel, 1988) with its six rods: each on a universal joint at its crank and a ball at the platform.

use dynamics_core::loops::{BodyFrame, LoopJoint, LoopRobot, Loops};
use dynamics_core::model::{BASE, Body, Joint, Model, Robot};

/// Three cranks with motors carry a platform, which does not turn.
#[derive(Clone, Copy, Debug)]
pub struct Delta;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
/// Half of the distance between the rods of a crank, m.
const HALF: f64 = 0.03;
const ROD: f64 = 0.45;
/// cos and sin of 0, 120 and 240 degrees.
const SIDES: [(f64, f64); 3] = [
    (1.0, 0.0),
    (-0.5, 0.866_025_403_784_438_6),
    (-0.5, -0.866_025_403_784_438_6),
];

/// (x, y) of a side in the frame of the base or the platform.
const fn at(side: usize, x: f64, y: f64) -> [f64; 3] {
    let (cos, sin) = SIDES[side];
    [cos * x - sin * y, sin * x + cos * y, 0.0]
}

const fn crank(name: &'static str, side: usize) -> Body {
    Body::new(name, BASE, Joint::revolute(Y))
        .xyz(at(side, 0.2, 0.0))
        .rpy([0.0, 0.0, side as f64 * core::f64::consts::TAU / 3.0])
        .mass(0.3)
        .com([0.1, 0.0, 0.005])
        .inertia([0.0002, 0.0, 0.00001, 0.001, 0.0, 0.001])
}

const fn rod(name: &'static str, crank: usize, y: f64) -> Body {
    Body::new(name, crank, Joint::universal(Y, X))
        .xyz([0.2, y, 0.0])
        .mass(0.05)
        .com([0.0, 0.0, -0.5 * ROD])
        .inertia([0.0009, 0.0, 0.0, 0.0009, 0.0, 0.00001])
}

impl Robot<10, 22, 21> for Delta {
    const MODEL: Model<f64, 10, 22, 21> = Model::new(
        "delta",
        [
            Body::new("platform", BASE, Joint::free())
                .mass(0.4)
                .com([0.004, -0.003, -0.02])
                .inertia([0.0004, 0.00001, 0.0, 0.0004, 0.00002, 0.0006]),
            crank("crank_a", 0),
            rod("rod_a1", 1, -HALF),
            rod("rod_a2", 1, HALF),
            crank("crank_b", 1),
            rod("rod_b1", 4, -HALF),
            rod("rod_b2", 4, HALF),
            crank("crank_c", 2),
            rod("rod_c1", 7, -HALF),
            rod("rod_c2", 7, HALF),
        ],
    );
}

const fn ball(name: &'static str, side: usize, rod: usize, y: f64) -> LoopJoint {
    LoopJoint::new(
        name,
        Joint::spherical(),
        [
            BodyFrame::new(0).xyz(at(side, 0.05, y)),
            BodyFrame::new(rod).xyz([0.0, 0.0, -ROD]),
        ],
    )
}

impl LoopRobot<10, 22, 21, 6, 18, 3> for Delta {
    const LOOPS: Loops<6, 18, 3> = Loops::new(
        &Self::MODEL,
        [
            ball("ball_a1", 0, 2, -HALF),
            ball("ball_a2", 0, 3, HALF),
            ball("ball_b1", 1, 5, -HALF),
            ball("ball_b2", 1, 6, HALF),
            ball("ball_c1", 2, 8, -HALF),
            ball("ball_c2", 2, 9, HALF),
        ],
        [6, 11, 16],
    );
}
