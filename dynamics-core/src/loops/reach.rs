//! Loops that close at no configuration, as far as their lengths say so.

use super::error::LoopProblem;
use super::loop_joint::LoopJoint;
use crate::math::const_eval as m;
use crate::model::JointKind::{self, *};
use crate::model::{BASE, Model};
use glam::DVec3;

/// Rounding errors of lengths, relative: a loop that closes only when it is stretched out is one.
const ROUNDING: f64 = 1e-12;

/// The links of a loop as the sides of a polygon, whose corners are the origins of its joints.
struct Polygon {
    perimeter: f64,
    longest: f64,
    /// Every joint turns about its corner, so that the sides keep their lengths.
    rigid: bool,
    coordinates: usize,
}

/// Whether the loop has no joint that moves, or a side that is longer than all others together.
pub(super) const fn problem<const B: usize, const Q: usize, const V: usize>(
    joint: &LoopJoint,
    model: &Model<f64, B, Q, V>,
) -> Option<LoopProblem> {
    let mut polygon =
        Polygon { perimeter: 0.0, longest: 0.0, rigid: turns(joint.joint.kind), coordinates: 0 };
    let [mut p, mut s] = joint.bodies();
    // A corner on the body reached, in its aligned frame.
    let mut corners = [m::vec3(joint.ends[0].position), m::vec3(joint.ends[1].position)];
    let mut end = 0;
    while end < 2 {
        let body = if end == 0 { p } else { s };
        if body != BASE {
            corners[end] = m::mul_vec(&model.links[body].to_joint_frame, corners[end]);
        }
        end += 1;
    }
    while p != s {
        // A parent is listed before its children, the base before all.
        let end = (p.wrapping_add(1) < s.wrapping_add(1)) as usize;
        let link = &model.links[if end == 0 { p } else { s }];
        let (_, count) = link.joint.kind.coordinates();
        polygon = polygon.with(corners[end]);
        polygon.coordinates += count;
        polygon.rigid &= turns(link.joint.kind);
        corners[end] = link.placement.pos;
        if end == 0 {
            p = link.parent;
        } else {
            s = link.parent;
        }
    }
    polygon = polygon.with(m::add(corners[0], m::scale(corners[1], -1.0)));
    if polygon.coordinates == 0 {
        return Some(LoopProblem::Rigid);
    }
    let rest = polygon.perimeter - polygon.longest;
    let tolerance = ROUNDING * polygon.perimeter;
    if polygon.rigid && polygon.longest > rest + tolerance {
        return Some(LoopProblem::OutOfReach);
    }
    None
}

impl Polygon {
    const fn with(mut self, side: DVec3) -> Self {
        let length = m::sqrt(m::dot(side, side));
        self.perimeter += length;
        self.longest = self.longest.max(length);
        self
    }
}

/// Whether a joint leaves the origins of its two frames in one place.
const fn turns(kind: JointKind) -> bool {
    matches!(kind, Revolute | Continuous | Universal | Spherical | Fixed)
}
