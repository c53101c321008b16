//! The bodies between a loop frame and an ancestor. RBDA (2008), section 8.2.

use crate::model::{JointCoordinate, RobotModel};
use crate::scalar::{Matrix, Real};
use crate::spatial::{Motion, Xform};

/// A frame relative to an ancestor of its body, in its own coordinates.
pub(super) struct Chain<R: Real> {
    /// From the ancestor's aligned frame.
    pub(super) x: Xform<R>,
    pub(super) v: Motion<R>,
    /// The acceleration at q̈ = 0.
    pub(super) a: Motion<R>,
}

/// Inward from a frame on body `at` to `ancestor`, setting the columns of the Jacobian of the frame.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn climb<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    (turns, qd): (&[JointCoordinate<R>; Q], &[R; V]),
    (mut at, frame): (usize, Xform<R>),
    ancestor: usize,
    columns: &mut [Motion<R>; V],
) -> Chain<R>
where
    D: RobotModel<R, B, Q, V>,
{
    let (mut x, mut v, mut a) = (frame, Motion::ZERO, Motion::ZERO);
    while at != ancestor {
        let Some(link) = robot.link(at) else {
            break;
        };
        for (k, coordinate) in link.coordinates().enumerate() {
            if let Some(column) = columns.get_mut(coordinate) {
                *column = x * link.column(turns, k);
            }
        }
        let joint = x * link.motion(turns, qd);
        let apparent = link.plus_velocity_product(Motion::ZERO, turns, qd, Motion::ZERO);
        // The frame moves by v relative to this body, and so does the joint's axis in the frame's coordinates.
        a += x * apparent - v.cross(joint);
        v += joint;
        x = x * link.xform(turns);
        at = link.parent;
    }
    Chain { x, v, a }
}

/// The nearest body that carries both, or the base.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn common_ancestor<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    mut p: usize,
    mut s: usize,
) -> usize
where
    D: RobotModel<R, B, Q, V>,
{
    let links = &robot.model().links;
    while p != s {
        // A parent is listed before its children, the base before all.
        let later = if p.wrapping_add(1) < s.wrapping_add(1) {
            &mut s
        } else {
            &mut p
        };
        let Some(link) = links.get(*later) else {
            break;
        };
        *later = link.parent;
    }
    p
}

/// X⁻¹
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn inverse<R: Real>(x: &Xform<R>) -> Xform<R> {
    Xform {
        rot: x.rot.transpose(),
        pos: -(x.rot * x.pos),
    }
}
