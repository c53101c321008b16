//! The inertia beyond a cut between a body and its parent, of which the wrench in its joint
//! follows: the bodies that move with its joint and are carried by it, and beside them what
//! regrouping passes to these.

use core::marker::PhantomData;

use glam::{DMat3, DVec3};

use super::base_parameters::{passed, second_moment};
use super::remainder::{Distribution, kept_vec};
use super::topology::{Compiled, CompiledJoint, is_parent, joint, last, place};
use super::tree::{BodyPlacement, Joint, JointMotion, PADDING_JOINT};
use crate::math::const_eval::{dot, mul, scale, sqrt, transpose};
use crate::model::{BASE, Bodies, JointKind};

/// The cut between the K-th body of the list and its parent, beside joint I or the base.
pub(crate) struct Cut<T, List, const N: usize, const I: usize, const K: usize>(
    PhantomData<(T, List)>,
);

impl<T: Compiled, List: Bodies<N>, const N: usize, const I: usize, const K: usize>
    Cut<T, List, N, I, K>
{
    const BODY: usize = if K < N { List::NUMBERS[K] } else { BASE };
    /// The place of the body.
    pub(crate) const PLACE: &'static BodyPlacement = {
        assert!(
            K >= N || Self::BODY < T::PLACES.len(),
            "a named body is one that the robot does not have: bodies are numbered from 0"
        );
        &place::<T>(Self::BODY)
    };
    const LAST: usize = CompiledJoint::<T, I>::LAST;
    /// Whether there is such a body, and it moves with the joint, or stands on the base.
    pub(crate) const IS_ON_JOINT: bool = K < N && Self::PLACE.joint == Self::LAST;
    /// Whether there is such a body, and the joint is on it or on what it carries as one with it.
    pub(crate) const CARRIES_JOINT: bool =
        K < N && is_parent::<T>(Self::PLACE.joint, I) && is_joint_beyond::<T>(Self::BODY, I);
    /// Whether everything that moves with the joint is beyond the cut, and what regrouping left to
    /// it is all that its joint does not pass on: on the base, less is left.
    pub(crate) const IS_WHOLE: bool =
        joint::<T>(joint::<T>(I).first).parent != BASE && is_whole::<T>(Self::BODY, Self::LAST);
    /// The parameters that the joint passes to its parent.
    pub(crate) const PASSED: &'static Distribution = &if Self::IS_ON_JOINT {
        passed_by(carried::<T>(Self::LAST, BASE), joint::<T>(I).motion)
    } else {
        Distribution::NOTHING
    };
    /// The parameters whose couple about the joint's origin is that of these about the body's, which
    /// is on the joint's axis where all is beyond the cut: h − m p and Σ − h pᵀ.
    pub(crate) const PASSED_ABOUT_BODY: &'static Distribution = &{
        let (mut about, z) = (*Self::PASSED, Self::PLACE.pos.z);
        about.second.z_axis.z -= about.moment.z * z;
        about.moment.z -= about.mass * z;
        about
    };
    /// Those beyond the cut, without what is left beyond the joints there.
    pub(crate) const CARRIED: &'static Distribution = &if Self::IS_ON_JOINT {
        carried::<T>(Self::LAST, Self::BODY)
    } else {
        Distribution::NOTHING
    };
    /// Whether a body is beyond the cut, for each body.
    pub(crate) const fn is_beyond(body: usize) -> bool {
        K < N && body < T::LINKS.len() && is_beyond::<T>(Self::BODY, body)
    }
}

/// Whether everything that moves with joint `l` is beyond those of these bodies that do.
pub(crate) const fn are_whole<T: Compiled>(bodies: &[usize], l: usize) -> bool {
    let (mut whole, mut k) = (true, 0);
    while k < bodies.len() {
        whole &= place::<T>(bodies[k]).joint != l || is_whole::<T>(bodies[k], l);
        k += 1;
    }
    whole
}

/// Whether everything that moves with joint `l` is beyond `body`.
const fn is_whole<T: Compiled>(body: usize, l: usize) -> bool {
    let (mut whole, mut k) = (true, 0);
    while k < T::PLACES.len() {
        whole &= T::PLACES[k].joint != l || is_beyond::<T>(body, k);
        k += 1;
    }
    whole
}

/// Whether body `k` is `body`, or is carried by it; all are beyond the base.
const fn is_beyond<T: Compiled>(body: usize, mut k: usize) -> bool {
    while body != BASE && k != BASE && k > body {
        k = T::LINKS[k].parent;
    }
    body == BASE || k == body
}

/// Whether joint `j` is beyond `body`.
const fn is_joint_beyond<T: Compiled>(body: usize, j: usize) -> bool {
    let mut k = 0;
    while k < T::LINKS.len() {
        let link = &T::LINKS[k];
        if link.idx_v == j && !matches!(link.joint.kind, JointKind::Fixed) {
            return is_beyond::<T>(body, k);
        }
        k += 1;
    }
    // The second coordinate of two: its parent has no body.
    body == BASE
}

/// The bodies on coordinate `l` beyond `body`, with what the joints on them pass to them.
const fn carried<T: Compiled>(l: usize, body: usize) -> Distribution {
    let (length, mut sum, mut k) = (T::LENGTH, Distribution::NOTHING, 0);
    while k < T::PLACES.len() {
        let BodyPlacement { joint, rot, pos } = T::PLACES[k];
        if joint == l && is_beyond::<T>(body, k) {
            let link = &T::LINKS[k];
            let own = Distribution {
                mass: link.inertia.mass * length * length,
                moment: scale(link.inertia.first_moment, length),
                second: second_moment(&link.inertia.rotational),
            };
            sum = sum.plus(own, &mul(&rot, &transpose(&link.to_joint_frame)), pos);
        }
        k += 1;
    }
    let mut j = 0;
    while j < T::JOINTS.len() {
        let by = &T::JOINTS[j];
        if by.parent == l && by.first == j && is_joint_beyond::<T>(body, j) {
            let all = carried::<T>(last::<T>(j), BASE);
            sum = sum.plus(passed_by(all, by.motion), &by.rot, by.pos);
        }
        j += 1;
    }
    let size = sqrt(dot(sum.moment, sum.moment));
    let DMat3 { x_axis: x, y_axis: y, z_axis: z } = sum.second;
    let largest = sqrt(dot(x, x) + dot(y, y) + dot(z, z));
    let second = DMat3::from_cols(kept_vec(x, largest), kept_vec(y, largest), kept_vec(z, largest));
    Distribution { mass: sum.mass, moment: kept_vec(sum.moment, size), second }
}

/// The part of this body's parameters that its joint passes to the parent.
const fn passed_by(body: Distribution, motion: JointMotion) -> Distribution {
    let Distribution { mass, moment, second } = body;
    let mut left = Joint { mass, moment, second, ..PADDING_JOINT };
    let passed = passed(&mut left, motion);
    let moment = DVec3::new(0.0, 0.0, passed.rod);
    Distribution { mass: passed.mass, moment, second: passed.spread }
}
