//! The force of a loop joint, as wrenches on the two bodies that it joins.

use dynamics_core::algorithms::Pose;
use dynamics_core::loops::LoopJoint;
use dynamics_core::model::BASE;
use dynamics_core::spatial::Force;
use glam::{DMat3, DVec3};

/// Bodies and wrenches on them, about their origins and along their axes, of a force on the
/// successor in its loop frame; the bodies stand at `poses`. The base is left out.
pub fn wrenches(
    joint: &LoopJoint,
    force: Force<f64>,
    poses: &[Pose<f64>],
) -> impl Iterator<Item = (usize, Force<f64>)> {
    let ([p, s], [_, end]) = (joint.bodies(), joint.ends());
    let pose = |body: usize| poses.get(body).copied().unwrap_or_default();
    let (end, p_pose, s_pose) = (end.pose(), pose(p), pose(s));
    // The successor's loop frame, in the predecessor's.
    let back = p_pose.rot.transpose();
    let rot = back * s_pose.rot * end.rot;
    let pos = back * (s_pose.point(end.pos) - p_pose.pos);
    let both = [(s, at_origin(end.rot, end.pos, force)), (p, -at_origin(rot, pos, force))];
    both.into_iter().filter(|(body, _)| *body != BASE)
}

/// A wrench in a frame of this pose, about the origin of the other frame and along its axes.
fn at_origin(rot: DMat3, pos: DVec3, f: Force<f64>) -> Force<f64> {
    let lin = rot * f.lin;
    Force::new(rot * f.ang + pos.cross(lin), lin)
}
