//! A platform on six legs (Gough; Stewart, 1965): universal joints at the base, slides with motors,
//! balls at the platform.

use dynamics_core::loops::{BodyFrame, LoopJoint, LoopRobot, Loops};
use dynamics_core::model::{BASE, Body, Joint, Model, Robot};
use firmware_demo::robots::{ABOVE, BELOW};

use super::Machine;

/// A platform on six legs of variable length.
#[derive(Clone, Copy, Debug)]
pub struct Stewart;

/// The same with a platform that is the base at 0.6 of its size, and not turned: it is singular in
/// every pose (Ma & Angeles, 1991).
#[derive(Clone, Copy, Debug)]
pub struct SimilarStewart;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

const fn cylinder(name: &'static str, leg: usize) -> Body {
    let (cos, sin) = BELOW[leg];
    Body::new(name, BASE, Joint::universal(X, Y))
        .xyz([0.5 * cos, 0.5 * sin, 0.0])
        .mass(1.5)
        .com([0.002, 0.0, 0.2])
        .inertia([0.02, 0.0, 0.0001, 0.02, 0.0, 0.001])
}

const fn rod(name: &'static str, cylinder: usize) -> Body {
    Body::new(name, cylinder, Joint::prismatic(Z))
        .xyz([0.0, 0.0, 0.4])
        .mass(0.8)
        .com([0.0, 0.001, 0.15])
        .inertia([0.01, 0.0, 0.0, 0.01, 0.0001, 0.0005])
}

const fn tree(name: &'static str) -> Model<f64, 13, 25, 24> {
    Model::new(
        name,
        [
            Body::new("platform", BASE, Joint::free())
                .mass(10.0)
                .com([0.02, -0.01, 0.05])
                .inertia([0.4, 0.01, 0.0, 0.4, 0.02, 0.7]),
            cylinder("cylinder_a", 0),
            rod("rod_a", 1),
            cylinder("cylinder_b", 1),
            rod("rod_b", 3),
            cylinder("cylinder_c", 2),
            rod("rod_c", 5),
            cylinder("cylinder_d", 3),
            rod("rod_d", 7),
            cylinder("cylinder_e", 4),
            rod("rod_e", 9),
            cylinder("cylinder_f", 5),
            rod("rod_f", 11),
        ],
    )
}

const fn ball(name: &'static str, leg: usize, (cos, sin): (f64, f64)) -> LoopJoint {
    LoopJoint::new(
        name,
        Joint::spherical(),
        [
            BodyFrame::new(0).xyz([0.3 * cos, 0.3 * sin, 0.0]),
            BodyFrame::new(2 + 2 * leg).xyz([0.0, 0.0, 0.4]),
        ],
    )
}

const fn loops(model: &Model<f64, 13, 25, 24>, on: &[(f64, f64); 6]) -> Loops<6, 18, 6> {
    Loops::new(
        model,
        [
            ball("ball_a", 0, on[0]),
            ball("ball_b", 1, on[1]),
            ball("ball_c", 2, on[2]),
            ball("ball_d", 3, on[3]),
            ball("ball_e", 4, on[4]),
            ball("ball_f", 5, on[5]),
        ],
        [8, 11, 14, 17, 20, 23],
    )
}

impl Robot<13, 25, 24> for Stewart {
    const MODEL: Model<f64, 13, 25, 24> = tree("stewart");
}
impl LoopRobot<13, 25, 24, 6, 18, 6> for Stewart {
    const LOOPS: Loops<6, 18, 6> = loops(&Self::MODEL, &ABOVE);
}

impl Robot<13, 25, 24> for SimilarStewart {
    const MODEL: Model<f64, 13, 25, 24> = tree("similar_stewart");
}
impl LoopRobot<13, 25, 24, 6, 18, 6> for SimilarStewart {
    const LOOPS: Loops<6, 18, 6> = loops(&Self::MODEL, &BELOW);
}

impl Machine<13, 25, 24, 6, 18, 6> for Stewart {
    const HOME: [f64; 25] = {
        let mut home = [0.0; 25];
        (home[3], home[6]) = (1.0, 0.8);
        home
    };
    const RANGE: f64 = 0.1;
    const ACTUATED_Q: [usize; 6] = [9, 12, 15, 18, 21, 24];
}
