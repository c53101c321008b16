//! A Delta robot (Clavel, 1988) with its six rods: each on a universal joint at its crank and a
//! ball at the platform.

use dynamics_core::loops::{BodyFrame, LoopJoint, LoopRobot, Loops};
use dynamics_core::model::{BASE, Body, Joint, Model, Robot};

/// Three cranks with motors carry a platform, which does not turn.
#[derive(Clone, Copy, Debug)]
pub struct Delta;

/// The same with rods that lie in the plane of the platform while the cranks are level: these then
/// do not hold the platform.
#[derive(Clone, Copy, Debug)]
pub struct FlatDelta;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
/// Half of the distance between the rods of a crank, m.
const HALF: f64 = 0.03;

/// Radius of the base, lengths of a crank and a rod, radius of the platform, m.
#[derive(Clone, Copy)]
struct Size {
    base: f64,
    crank: f64,
    rod: f64,
    platform: f64,
}

const USUAL: Size = Size { base: 0.2, crank: 0.2, rod: 0.45, platform: 0.05 };
const FLAT: Size = Size { base: 0.1875, crank: 0.1875, rod: 0.3125, platform: 0.0625 };
/// cos and sin of 0, 120 and 240 degrees.
const SIDES: [(f64, f64); 3] =
    [(1.0, 0.0), (-0.5, 0.866_025_403_784_438_6), (-0.5, -0.866_025_403_784_438_6)];

/// (x, y) of a side in the frame of the base or the platform.
const fn at(side: usize, x: f64, y: f64) -> [f64; 3] {
    let (cos, sin) = SIDES[side];
    [cos * x - sin * y, sin * x + cos * y, 0.0]
}

const fn crank(name: &'static str, side: usize, size: Size) -> Body {
    Body::new(name, BASE, Joint::revolute(Y))
        .xyz(at(side, size.base, 0.0))
        .rpy([0.0, 0.0, side as f64 * core::f64::consts::TAU / 3.0])
        .mass(0.3)
        .com([0.1, 0.0, 0.005])
        .inertia([0.0002, 0.0, 0.00001, 0.001, 0.0, 0.001])
}

const fn rod(name: &'static str, crank: usize, y: f64, size: Size) -> Body {
    Body::new(name, crank, Joint::universal(Y, X))
        .xyz([size.crank, y, 0.0])
        .mass(0.05)
        .com([0.0, 0.0, -0.5 * size.rod])
        .inertia([0.0009, 0.0, 0.0, 0.0009, 0.0, 0.00001])
}

const fn tree(name: &'static str, size: Size) -> Model<f64, 10, 22, 21> {
    Model::new(
        name,
        [
            Body::new("platform", BASE, Joint::free())
                .mass(0.4)
                .com([0.004, -0.003, -0.02])
                .inertia([0.0004, 0.00001, 0.0, 0.0004, 0.00002, 0.0006]),
            crank("crank_a", 0, size),
            rod("rod_a1", 1, -HALF, size),
            rod("rod_a2", 1, HALF, size),
            crank("crank_b", 1, size),
            rod("rod_b1", 4, -HALF, size),
            rod("rod_b2", 4, HALF, size),
            crank("crank_c", 2, size),
            rod("rod_c1", 7, -HALF, size),
            rod("rod_c2", 7, HALF, size),
        ],
    )
}

const fn ball(name: &'static str, side: usize, rod: usize, y: f64, size: Size) -> LoopJoint {
    LoopJoint::new(
        name,
        Joint::spherical(),
        [
            BodyFrame::new(0).xyz(at(side, size.platform, y)),
            BodyFrame::new(rod).xyz([0.0, 0.0, -size.rod]),
        ],
    )
}

const fn balls(size: Size) -> [LoopJoint; 6] {
    [
        ball("ball_a1", 0, 2, -HALF, size),
        ball("ball_a2", 0, 3, HALF, size),
        ball("ball_b1", 1, 5, -HALF, size),
        ball("ball_b2", 1, 6, HALF, size),
        ball("ball_c1", 2, 8, -HALF, size),
        ball("ball_c2", 2, 9, HALF, size),
    ]
}

impl Robot<10, 22, 21> for Delta {
    const MODEL: Model<f64, 10, 22, 21> = tree("delta", USUAL);
}
impl LoopRobot<10, 22, 21, 6, 18, 3> for Delta {
    const LOOPS: Loops<6, 18, 3> = Loops::new(&Self::MODEL, balls(USUAL), [6, 11, 16]);
}

impl Robot<10, 22, 21> for FlatDelta {
    const MODEL: Model<f64, 10, 22, 21> = tree("flat_delta", FLAT);
}
impl LoopRobot<10, 22, 21, 6, 18, 3> for FlatDelta {
    const LOOPS: Loops<6, 18, 3> = Loops::new(&Self::MODEL, balls(FLAT), [6, 11, 16]);
}
