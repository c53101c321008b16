//! Planar linkages, described in space: a loop joint that turns about y then has three redundant
//! rows.

use dynamics_core::loops::{BodyFrame, LoopJoint, LoopRobot, Loops};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};

const Y: [f64; 3] = [0.0, 1.0, 0.0];

/// Lengths of crank, coupler, rocker and ground of the four-bar linkage, m: the crank turns without
/// end.
pub const FOUR_BAR: [f64; 4] = [0.2, 0.5, 0.4, 0.6];

/// A four-bar linkage in which the crank has a motor.
#[derive(Clone, Copy, Debug)]
pub struct FourBar;

/// A four-bar linkage whose opposite sides are equal: at zero all links are in line.
#[derive(Clone, Copy, Debug)]
pub struct Parallelogram;

/// Two cranks whose couplers meet at a point, both with a motor.
#[derive(Clone, Copy, Debug)]
pub struct FiveBar;

/// The same with a third motor, at the root of a coupler.
#[derive(Clone, Copy, Debug)]
pub struct ThreeMotors;

const fn bar(name: &'static str, parent: usize, x: f64, mass: f64, length: f64) -> Body {
    let moment = mass * length * length / 12.0;
    Body::new(name, parent, Joint::revolute(Y))
        .xyz([x, 0.0, 0.0])
        .mass(mass)
        .com([0.5 * length, 0.01, 0.02])
        .inertia([0.001, 0.0002, 0.0001, moment, 0.0003, moment])
}

const fn meets(name: &'static str, [p, s]: [(usize, f64); 2]) -> LoopJoint {
    LoopJoint::new(
        name,
        Joint::revolute(Y),
        [BodyFrame::new(p.0).xyz([p.1, 0.0, 0.0]), BodyFrame::new(s.0).xyz([s.1, 0.0, 0.0])],
    )
}

const fn four_bar(name: &'static str, [a, b, c, d]: [f64; 4]) -> ArmModel<f64, 3> {
    Model::new(
        name,
        [
            bar("crank", BASE, 0.0, 0.5, a),
            bar("coupler", 0, a, 1.0, b),
            bar("rocker", BASE, d, 0.8, c),
        ],
    )
}

impl Robot<3, 3, 3> for FourBar {
    const MODEL: ArmModel<f64, 3> = four_bar("four_bar", FOUR_BAR);
}
impl LoopRobot<3, 3, 3, 1, 5, 1> for FourBar {
    const LOOPS: Loops<1, 5, 1> = {
        let [_, b, c, _] = FOUR_BAR;
        Loops::new(&Self::MODEL, [meets("joint", [(1, b), (2, c)])], [0])
    };
}

impl Robot<3, 3, 3> for Parallelogram {
    const MODEL: ArmModel<f64, 3> = four_bar("parallelogram", [0.3, 0.5, 0.3, 0.5]);
}
impl LoopRobot<3, 3, 3, 1, 5, 1> for Parallelogram {
    const LOOPS: Loops<1, 5, 1> =
        Loops::new(&Self::MODEL, [meets("far_corner", [(1, 0.5), (2, 0.3)])], [0]);
}

const fn five_bar(name: &'static str) -> ArmModel<f64, 4> {
    Model::new(
        name,
        [
            bar("left_crank", BASE, -0.1, 0.5, 0.25),
            bar("left_coupler", 0, 0.25, 0.7, 0.4),
            bar("right_crank", BASE, 0.1, 0.5, 0.25),
            bar("right_coupler", 2, 0.25, 0.7, 0.4),
        ],
    )
}

impl Robot<4, 4, 4> for FiveBar {
    const MODEL: ArmModel<f64, 4> = five_bar("five_bar");
}
impl LoopRobot<4, 4, 4, 1, 5, 2> for FiveBar {
    const LOOPS: Loops<1, 5, 2> =
        Loops::new(&Self::MODEL, [meets("tip", [(1, 0.4), (3, 0.4)])], [0, 2]);
}

impl Robot<4, 4, 4> for ThreeMotors {
    const MODEL: ArmModel<f64, 4> = five_bar("three_motors");
}
impl LoopRobot<4, 4, 4, 1, 5, 3> for ThreeMotors {
    const LOOPS: Loops<1, 5, 3> =
        Loops::new(&Self::MODEL, [meets("tip", [(1, 0.4), (3, 0.4)])], [0, 1, 2]);
}
