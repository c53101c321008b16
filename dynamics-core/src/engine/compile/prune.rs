//! Base parameters whose torque is negligible become zero: the engine has no instructions for known
//! zeros.
//!
//! Each parameter is compared with the robot's largest ones by the torque that it needs while all
//! is at 1 g and turns at α = g ĥ/Σ̂, by which the largest second moment Σ̂ needs the torque ĥ g
//! that the largest first moment ĥ weighs. A second moment Σ then needs Σ α, the share Σ/Σ̂; a
//! first moment h at the end of a reach R needs h (g + α R), the share h/ĥ + h R/Σ̂.

use glam::{DMat3, DVec3};

use crate::engine::compile::Joint;
use crate::math::const_eval::{dot, sqrt};
use crate::model::BASE;

/// Sets the parameters below `share` to zero; a share of zero leaves every bit as it was.
///
/// Masses stay: behind a prismatic joint they are the joint's own inertia, elsewhere none is left.
pub(crate) const fn prune<const V: usize>(joints: &mut [Joint; V], share: f64) {
    assert!(
        share >= 0.0 && share < 1.0,
        "what is negligible is a share of the whole: not negative, and less than 1"
    );
    let (mut moment, mut second, mut i) = (0.0, 0.0, 0);
    while i < V {
        moment = largest(joints[i].moment, moment);
        second = largest_of(&joints[i].second_moment_only, second);
        i += 1;
    }
    // If all moments of one kind are zero, this threshold is zero or NaN, and nothing is left out.
    let moment = share / (1.0 / moment + reach(joints) / second);
    let second = share * second;
    i = 0;
    while i < V {
        let joint = &mut joints[i];
        joint.moment = larger_than(joint.moment, moment);
        joint.second = all_larger_than(&joint.second, second);
        joint.second_moment_only = all_larger_than(&joint.second_moment_only, second);
        i += 1;
    }
}

/// From the first joint of the longest branch to its last, m, strokes not counted.
const fn reach<const V: usize>(joints: &[Joint; V]) -> f64 {
    let (mut reaches, mut longest, mut i) = ([0.0; V], 0.0_f64, 0);
    while i < V {
        let Joint { parent, pos, .. } = joints[i];
        if parent != BASE {
            reaches[i] = reaches[parent] + sqrt(dot(pos, pos));
            longest = longest.max(reaches[i]);
        }
        i += 1;
    }
    longest
}

const fn largest(v: DVec3, other: f64) -> f64 {
    other.max(v.x.abs()).max(v.y.abs()).max(v.z.abs())
}

const fn largest_of(m: &DMat3, other: f64) -> f64 {
    largest(m.x_axis, largest(m.y_axis, largest(m.z_axis, other)))
}

const fn larger_than(v: DVec3, limit: f64) -> DVec3 {
    DVec3::new(kept(v.x, limit), kept(v.y, limit), kept(v.z, limit))
}

const fn all_larger_than(m: &DMat3, limit: f64) -> DMat3 {
    DMat3::from_cols(
        larger_than(m.x_axis, limit),
        larger_than(m.y_axis, limit),
        larger_than(m.z_axis, limit),
    )
}

const fn kept(x: f64, limit: f64) -> f64 {
    if x.abs() < limit { 0.0 } else { x }
}
