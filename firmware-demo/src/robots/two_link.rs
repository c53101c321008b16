//! A light arm of two links that bend.

use dynamics_core::flexible::{Beam, BendingRobot, FlexibleLink, Modes, Shape};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Robot};

/// Two beams in a vertical plane: a motor at the end of the first, a gripper at that of the second.
/// Our own numbers.
#[derive(Clone, Copy, Debug, Default)]
pub struct TwoLink;

/// The upper link with the elbow's motor.
pub const UPPER: Beam = Beam::new(0.5, 0.8).bending([80.0; 2]).tip(0.3, 1e-4).damping_ratio(0.01);
/// The fore link with a gripper.
pub const FORE: Beam = Beam::new(0.4, 0.4).bending([30.0; 2]).tip(0.1, 2e-5).damping_ratio(0.01);

const fn body(name: &'static str, parent: usize, beam: &Beam) -> Body {
    Body::new(name, parent, Joint::revolute([0.0, 1.0, 0.0]))
        .mass(beam.mass())
        .com(beam.com())
        .inertia(beam.inertia())
        .limits(JointLimits { lower: -3.0, upper: 3.0, velocity: 8.0, torque: 40.0 })
}

impl Robot<2, 2, 2> for TwoLink {
    const MODEL: ArmModel<f64, 2> = ArmModel::new(
        "two_link",
        [body("upper", BASE, &UPPER), body("fore", 0, &FORE).xyz([0.5, 0.0, 0.0])],
    );
}

const fn link(beam: &Beam, body: usize, shapes: &[Shape]) -> FlexibleLink {
    match beam.link(body, shapes) {
        Ok(link) => link,
        Err(_) => panic!("the beams have lengths, masses and stiffness"),
    }
}

/// With the first bending shape of each link.
impl BendingRobot<2, 2, 2, 2> for TwoLink {
    const MODES: Modes<f64, 2> = Modes::new(
        &Self::MODEL,
        &[link(&UPPER, 0, &[Shape::BendZ(1)]), link(&FORE, 1, &[Shape::BendZ(1)])],
    );
}

/// With the first two modes of each link.
impl BendingRobot<2, 2, 2, 4> for TwoLink {
    const MODES: Modes<f64, 4> = Modes::new(
        &Self::MODEL,
        &[
            link(&UPPER, 0, &[Shape::BendZ(1), Shape::BendZ(2)]),
            link(&FORE, 1, &[Shape::BendZ(1), Shape::BendZ(2)]),
        ],
    );
}

/// The first bending shape of each link.
pub const MODES_1: Modes<f32, 2> = <TwoLink as BendingRobot<2, 2, 2, 2>>::MODES.to_f32();

/// The first two modes of each link.
pub const MODES_2: Modes<f32, 4> = <TwoLink as BendingRobot<2, 2, 2, 4>>::MODES.to_f32();

/// The same of beams that are 9.75 % softer, so that every frequency is 5 % lower.
pub const MODES_2_SOFT: Modes<f32, 4> = {
    const SOFTER: f64 = 0.95 * 0.95;
    const UPPER_SOFT: Beam = UPPER.bending([80.0 * SOFTER; 2]);
    const FORE_SOFT: Beam = FORE.bending([30.0 * SOFTER; 2]);
    Modes::new(
        &TwoLink::MODEL,
        &[
            link(&UPPER_SOFT, 0, &[Shape::BendZ(1), Shape::BendZ(2)]),
            link(&FORE_SOFT, 1, &[Shape::BendZ(1), Shape::BendZ(2)]),
        ],
    )
    .to_f32()
};
