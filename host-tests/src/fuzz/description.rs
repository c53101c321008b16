//! Descriptions: what is accepted has finite numbers and can be computed with.

use super::bytes::Bytes;
use dynamics_core::algorithms::{aba, crba, rnea};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model};
use dynamics_core::scalar::{Matrix, Vector};
use dynamics_core::state::State;

const BODIES: usize = 4;

/// A description of four bodies.
///
/// # Panics
/// If a robot that was accepted has a number that is not finite, in f64.
pub fn description(bytes: &[u8]) {
    let from = &mut Bytes(bytes);
    let bodies = core::array::from_fn(|i| body(from, i));
    let Ok(model) = Model::try_new("fuzzed", bodies) else {
        return;
    };
    let model: ArmModel<f64, BODIES> = model;
    for (i, link) in model.links.iter().enumerate() {
        let (placement, inertia) = (&link.placement, &link.inertia);
        let vectors = placement.rot.cols().into_iter().chain(inertia.rotational.cols());
        let mut vectors = vectors.chain([placement.pos, inertia.first_moment, link.joint.axis]);
        assert!(vectors.all(|v| v.array().iter().all(|x| x.is_finite())), "{i}: {link:?}");
        assert!(link.parent == BASE || link.parent < i);
        let _ = model.in_link_frame(i);
    }
    let _ = model.check(1e-9);
    let state = State { q: from.numbers(), qd: from.numbers(), qdd: from.numbers() };
    let tau = rnea(&model, &state, &RIGID_BODY);
    let _ = (crba(&model, &state.q, &RIGID_BODY), aba(&model, &state, &tau, &RIGID_BODY));
}

fn body(from: &mut Bytes<'_>, index: usize) -> Body {
    let parent = match from.below(8) {
        0 => BASE,
        1 => usize::from(from.byte()),
        _ => index.wrapping_sub(1),
    };
    // Numbers that spoil it come seldom enough that some descriptions are accepted.
    let rare = from.byte() < 64;
    let mut number = || if rare { from.wide() } else { from.ordinary() };
    let mut three = || [number(), number(), number()];
    let (axis, at, turn, com) = (three(), three(), three(), three());
    let [moments, products, other] = [three(), three(), three()];
    let [mass, pitch, speed] = other;
    let limits = JointLimits {
        lower: other[1].min(other[2]),
        upper: other[1].max(other[2]),
        velocity: speed,
        ..JointLimits::NONE
    };
    let joint = match from.below(16) {
        0 => Joint::fixed(),
        1 => Joint::spherical(),
        2 => Joint::universal(axis, at),
        3..6 => Joint::prismatic(axis),
        6 => Joint::helical(axis, pitch),
        7 => Joint::continuous(axis),
        _ => Joint::revolute(axis),
    };
    let body = Body::new("body", parent, joint).xyz(at).com(com);
    let body = if from.byte().is_multiple_of(2) {
        body.rpy(turn)
    } else {
        body.quarter_turns([turn[0] as i32, 1, -7])
    };
    let body = body.mass(if rare { mass } else { mass.abs() });
    let [xx, yy, zz] = moments;
    let [xy, xz, yz] = products;
    let inertia = [xx, xy, xz, yy, yz, zz];
    // A body without them refuses most of these, and the rest of the description would not be read.
    let body = if rare { body.inertia(inertia) } else { body.inertia_as_published(inertia) };
    if from.byte().is_multiple_of(4) { body.limits(limits) } else { body }
}
