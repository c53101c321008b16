//! Which joint supports which, and which bodies move with a joint: evaluated while compiling.

use core::marker::PhantomData;

use super::compile;
use super::tree::{AT_BASE, BodyPlacement, CompiledTree, Joint, JointMotion, PADDING_JOINT};
use crate::model::{BASE, Link, Robot};

/// A robot as the engine computes with it: one type in place of the robot, the number of its
/// bodies, and those of its coordinates.
///
/// A joint is named by its velocity coordinate; one of several coordinates is a chain of them
/// ([`Joint`]).
pub(crate) trait Compiled {
    /// The bodies of the description.
    const LINKS: &'static [Link<f64>];
    /// The moving joints, parents first.
    const JOINTS: &'static [Joint];
    /// The placement of each body of the description.
    const PLACES: &'static [BodyPlacement];
    /// The unit of length, m.
    const LENGTH: f64;
    /// Its reciprocal, 1/m.
    const LENGTH_INV: f64 = 1.0 / Self::LENGTH;
    /// The joints that support each joint, itself among them, as bits.
    const SUPPORT: &'static [u64];
    /// Whether some chain of joints is too long for its sines and cosines to stay in registers:
    /// measured on chains of 3 (slower by 1 % if they are loaded again), 6 and 7 (faster by 1 %).
    const LOADS_SINES_AGAIN: bool = {
        let (mut longest, mut j) = (0, 0);
        while j < Self::JOINTS.len() {
            let (mut depth, mut i) = (0, j);
            while i != BASE {
                depth += 1;
                i = Self::JOINTS[Self::JOINTS[i].first].parent;
            }
            if depth > longest {
                longest = depth;
            }
            j += 1;
        }
        longest > 4
    };
}

/// The robot `T`, compiled.
pub(crate) struct CompiledRobot<T, const B: usize, const Q: usize, const V: usize>(PhantomData<T>);

impl<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize> CompiledRobot<T, B, Q, V> {
    const TREE: &'static CompiledTree<B, V> = &{
        assert!(V <= 64, "the engine takes up to 64 velocity coordinates; use `Core`");
        compile(&T::MODEL, T::NEGLIGIBLE)
    };

    /// For a robot of revolute joints alone: whether the limits of all of them are within two turns
    /// (`near`), or of none. None for every other robot, whose sines are computed joint by joint.
    pub(crate) const ALL_TURN: Option<bool> = {
        let (mut turn, mut near, mut i) = (Q == V, 0, 0);
        while i < V {
            let joint = &Self::TREE.joints[i];
            turn &= matches!(joint.motion, JointMotion::Turn) && joint.q == i;
            near += joint.near as usize;
            i += 1;
        }
        if turn && (near == 0 || near == V) { Some(near > 0) } else { None }
    };
}

impl<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize> Compiled
    for CompiledRobot<T, B, Q, V>
{
    const LINKS: &'static [Link<f64>] = &T::MODEL.links;
    const JOINTS: &'static [Joint] = &Self::TREE.joints;
    const PLACES: &'static [BodyPlacement] = &Self::TREE.places;
    const LENGTH: f64 = Self::TREE.length;
    const SUPPORT: &'static [u64] = &support(&Self::TREE.joints);
}

/// The joints that support each joint, itself among them, as bits.
pub(crate) const fn support<const V: usize>(joints: &[Joint; V]) -> [u64; V] {
    let (mut support, mut i) = ([0; V], 0);
    while i < V {
        let parent = joints[i].parent;
        support[i] = 1 << i;
        if parent != BASE {
            support[i] |= support[parent];
        }
        i += 1;
    }
    support
}

/// Whether joint `i`, or the base, is the parent of joint `j`.
pub(crate) const fn is_parent<T: Compiled>(i: usize, j: usize) -> bool {
    j < T::JOINTS.len() && T::JOINTS[j].parent == i
}

/// Whether joint `k` is joint `i` or supports it.
pub(crate) const fn supports<T: Compiled>(k: usize, i: usize) -> bool {
    let n = T::SUPPORT.len();
    k < n && i < n && T::SUPPORT[i] & (1 << k) != 0
}

/// Whether joint `k` supports joint `i`.
pub(crate) const fn is_ancestor<T: Compiled>(k: usize, i: usize) -> bool {
    k != i && supports::<T>(k, i)
}

/// Whether joint `k` supports joint `i`, another one, which moves its body's origin in the parent's
/// frame.
pub(crate) const fn is_slide_beyond<T: Compiled>(k: usize, i: usize) -> bool {
    if !is_ancestor::<T>(k, i) {
        return false;
    }
    let joint = &T::JOINTS[i];
    joint.first != T::JOINTS[k].first
        && (joint.prismatic || matches!(joint.motion, JointMotion::Screw))
}

/// Whether joint `i` is revolute and has no children, and the inertia left to its body is Σ =
/// diag(a, a, 0) alone.
const fn is_round<T: Compiled>(i: usize) -> bool {
    let mut k = 0;
    while k < T::JOINTS.len() {
        if is_parent::<T>(i, k) {
            return false;
        }
        k += 1;
    }
    let Joint { moment: h, second, .. } = joint::<T>(i);
    let (x, y) = (second.x_axis, second.y_axis);
    let sides = [h.x, h.y, x.y, x.z, y.z, x.x - y.y];
    // If the base moves, more than this Σ is left to a body on the base.
    let turns = matches!(joint::<T>(i).motion, JointMotion::Turn);
    let mut all = turns && joint::<T>(i).parent != BASE;
    k = 0;
    while k < sides.len() {
        all &= sides[k] == 0.0;
        k += 1;
    }
    all
}

/// The placement of a body of the description; beyond the last one, the base.
pub(crate) const fn place<T: Compiled>(body: usize) -> BodyPlacement {
    if body < T::PLACES.len() { T::PLACES[body] } else { AT_BASE }
}

/// The last coordinate of the joint of coordinate `i`: that of its body.
pub(crate) const fn last<T: Compiled>(i: usize) -> usize {
    let joint = joint::<T>(i);
    joint.first + joint.count - 1
}

/// Whether joint `i` is one of several joints in a row on parallel axes, of which the first is on
/// the joint on the base and perpendicular to it.
const fn is_parallel<T: Compiled>(i: usize) -> bool {
    let own = joint::<T>(i);
    let first = joint::<T>(own.parent);
    if own.parent == BASE || !is_turn(&own) {
        return false;
    }
    if first.parent != BASE {
        return follows(&own) && is_parallel::<T>(own.parent);
    }
    let z = own.rot.z_axis;
    let perpendicular = z.z == 0.0 && own.pos.x * z.x + own.pos.y * z.y == 0.0;
    let mut k = 0;
    while k < T::JOINTS.len() {
        if T::JOINTS[k].parent == i && follows(&T::JOINTS[k]) {
            return perpendicular && is_turn(&first);
        }
        k += 1;
    }
    false
}

/// Whether a joint turns about an axis parallel to its parent's.
const fn follows(joint: &Joint) -> bool {
    is_turn(joint) && joint.rot.z_axis.z.abs() == 1.0 && joint.pos.z == 0.0
}

const fn is_turn(joint: &Joint) -> bool {
    matches!(joint.motion, JointMotion::Turn) && joint.count == 1
}

/// The last ancestor of joint `i` that is one of them, or the base.
const fn last_parallel<T: Compiled>(i: usize) -> usize {
    let mut k = joint::<T>(i).parent;
    while k != BASE && !is_parallel::<T>(k) {
        k = joint::<T>(k).parent;
    }
    k
}

/// The spin of joint `i` without those of its children on parallel axes.
const fn own_spin<T: Compiled>(i: usize) -> f64 {
    let (mut spin, mut k) = (joint::<T>(i).spin, 0);
    while k < T::JOINTS.len() {
        if T::JOINTS[k].parent == i && is_parallel::<T>(k) {
            spin -= T::JOINTS[k].spin;
        }
        k += 1;
    }
    spin
}

/// The joint on the base that supports joint `i`.
const fn root<T: Compiled>(i: usize) -> usize {
    let mut k = i;
    while joint::<T>(k).parent != BASE {
        k = joint::<T>(k).parent;
    }
    k
}

/// The number of `loaded` bodies that move with joint `i`.
pub(crate) const fn loads<T: Compiled>(i: usize, loaded: &[bool]) -> usize {
    let (mut count, mut body) = (0, 0);
    while body < loaded.len() {
        if loaded[body] && T::PLACES[body].joint == i {
            count += 1;
        }
        body += 1;
    }
    count
}

/// The `k`-th of them, or the number of all bodies.
pub(crate) const fn load<T: Compiled>(i: usize, k: usize, loaded: &[bool]) -> usize {
    let (mut count, mut body) = (0, 0);
    while body < loaded.len() {
        if loaded[body] && T::PLACES[body].joint == i {
            if count == k {
                return body;
            }
            count += 1;
        }
        body += 1;
    }
    loaded.len()
}

/// The number of bodies that move with joint `i` as one.
const fn bodies_on<T: Compiled>(i: usize) -> usize {
    let (mut count, mut body) = (0, 0);
    while body < T::PLACES.len() {
        if T::PLACES[body].joint == i {
            count += 1;
        }
        body += 1;
    }
    count
}

/// The `k`-th body that moves with joint `i`, and its placement; beyond the last one, the base.
const fn body_on<T: Compiled>(i: usize, k: usize) -> (usize, BodyPlacement) {
    let (mut count, mut body) = (0, 0);
    while body < T::PLACES.len() {
        if T::PLACES[body].joint == i {
            if count == k {
                return (body, T::PLACES[body]);
            }
            count += 1;
        }
        body += 1;
    }
    (body, AT_BASE)
}

/// Joint `i`; beyond the last one, the padding joint.
pub(crate) const fn joint<T: Compiled>(i: usize) -> Joint {
    if i < T::JOINTS.len() { T::JOINTS[i] } else { PADDING_JOINT }
}

/// Joint I of a compiled robot, by constants with names: the compiler evaluates them once, and an
/// inline `const` block in each instance of the function around it, of which there is one for each
/// scalar, set of effects and joint.
pub(crate) struct CompiledJoint<T, const I: usize>(PhantomData<T>);

impl<T: Compiled, const I: usize> CompiledJoint<T, I> {
    /// The joint; beyond the last one, the padding joint.
    pub(crate) const JOINT: &'static Joint = &joint::<T>(I);
    /// Whether its velocity is that of a translation.
    pub(crate) const PRISMATIC: bool = Self::JOINT.prismatic;
    /// The motion that it gives the body.
    pub(crate) const MOTION: JointMotion = Self::JOINT.motion;
    /// Whether it is revolute: only the sine and cosine of its position matter.
    pub(crate) const IS_TURN: bool = matches!(Self::MOTION, JointMotion::Turn);
    /// Whether it moves the body's origin in the parent's frame.
    pub(crate) const SHIFTS: bool = matches!(
        Self::MOTION,
        JointMotion::Slide | JointMotion::Screw | JointMotion::Planar | JointMotion::Free
    );
    /// The number of coordinates that move the body at once.
    pub(crate) const COUNT: usize = Self::JOINT.count;
    /// The index of the first of their positions.
    pub(crate) const Q: usize = Self::JOINT.q;
    /// The position that belongs to the velocity, if any.
    pub(crate) const POSITION: Option<usize> = Self::JOINT.position;
    /// The first of them.
    pub(crate) const FIRST: &'static Joint = &joint::<T>(Self::JOINT.first);
    /// The last of them, by whose number the body is known.
    pub(crate) const LAST: usize = if I < T::JOINTS.len() { last::<T>(I) } else { I };
    /// The same, with the inertia of the body.
    pub(crate) const BODY: &'static Joint = &joint::<T>(Self::LAST);
    /// The parent, or the padding joint.
    pub(crate) const PARENT: &'static Joint = &joint::<T>(Self::JOINT.parent);
    /// The first coordinate of the parent's joint, or the padding joint.
    pub(crate) const PARENT_FIRST: &'static Joint = &joint::<T>(Self::PARENT.first);
    /// Whether its parent is the base.
    pub(crate) const IS_ON_BASE: bool = is_parent::<T>(BASE, I);
    /// The number of bodies that move with it as one.
    pub(crate) const BODIES: usize = bodies_on::<T>(Self::LAST);
    /// Whether it is a last joint, and what regrouping left to its body is the same after any turn.
    pub(crate) const IS_ROUND: bool = is_round::<T>(I);
    /// Whether it is one of several joints in a row on parallel axes, perpendicular to that of the
    /// joint on the base.
    pub(crate) const IS_PARALLEL: bool = is_parallel::<T>(I);
    /// Whether CRBA multiplies its wrench by the motion of the joint on the base in the frame of
    /// one of them.
    pub(crate) const MEETS_ROOT: bool = Self::IS_PARALLEL || last_parallel::<T>(I) != BASE;
    /// The inertia that only its own rotation feels, without the part that it shares with children
    /// on parallel axes.
    pub(crate) const OWN_SPIN: f64 = own_spin::<T>(I);
    /// Whether its parent is the joint on the base.
    pub(crate) const PARENT_ON_BASE: bool =
        Self::JOINT.parent != BASE && Self::PARENT.parent == BASE;
    /// The number of entries in the rows of M before its own, up to their diagonals.
    pub(crate) const ROW: usize = {
        let (mut entries, mut i) = (0, 0);
        while i < I && i < T::SUPPORT.len() {
            entries += T::SUPPORT[i].count_ones() as usize;
            i += 1;
        }
        entries
    };
    /// The joint on the base that supports it.
    pub(crate) const ROOT: usize = root::<T>(I);
}

/// Joints I and J of a compiled robot.
pub(crate) struct JointPair<T, const I: usize, const J: usize>(PhantomData<T>);

impl<T: Compiled, const I: usize, const J: usize> JointPair<T, I, J> {
    /// Whether J's wrench, in the frame of I's parent, meets the motion of the joint on the base
    /// there.
    pub(crate) const IS_MEETING: bool = !CompiledJoint::<T, J>::IS_PARALLEL
        && last_parallel::<T>(J) != BASE
        && last_parallel::<T>(J) == CompiledJoint::<T, I>::JOINT.parent;
    /// Whether I is the parent of J.
    pub(crate) const IS_PARENT: bool = is_parent::<T>(I, J);
    /// Whether the body of joint I is the parent of J.
    pub(crate) const IS_CHILD: bool = is_parent::<T>(CompiledJoint::<T, I>::LAST, J);
    /// Whether J is one of the coordinates that move the body of joint I at once.
    pub(crate) const IS_COORDINATE: bool =
        I < T::JOINTS.len() && J < T::JOINTS.len() && T::JOINTS[I].first == T::JOINTS[J].first;
    /// Whether I is J or supports it.
    pub(crate) const SUPPORTS: bool = supports::<T>(I, J);
    /// Whether I supports J.
    pub(crate) const IS_ANCESTOR: bool = is_ancestor::<T>(I, J);
    /// Whether I supports J, which moves its body's origin in the frame of I.
    pub(crate) const IS_SLIDE_BEYOND: bool = is_slide_beyond::<T>(I, J);
    /// Whether more than J bodies move with joint I.
    pub(crate) const HAS_BODY: bool = Self::BODY.0 < T::PLACES.len();
    /// The J-th body that moves with joint I, and its placement; beyond the last one, the base.
    pub(crate) const BODY: &'static (usize, BodyPlacement) =
        &body_on::<T>(CompiledJoint::<T, I>::LAST, J);
}

/// Joint I of a compiled robot, and a body of the description.
pub(crate) struct JointAndBody<T, const I: usize, const BODY: usize>(PhantomData<T>);

impl<T: Compiled, const I: usize, const BODY: usize> JointAndBody<T, I, BODY> {
    /// The placement of the body.
    pub(crate) const PLACE: &'static BodyPlacement = &place::<T>(BODY);
    /// Whether the body moves with the joint as one.
    pub(crate) const IS_ON_JOINT: bool = Self::PLACE.joint == I;
    /// Whether the joint moves the body.
    pub(crate) const SUPPORTS: bool = supports::<T>(I, Self::PLACE.joint);
}

/// Robots of up to this number of joints are one function.
const WHOLE: usize = 16;

/// Whether a robot is split, in a scene with wrenches on bodies or without.
pub(crate) const fn has_subtree_functions<T: Compiled>(wrench: bool) -> bool {
    let (mut joints, mut i) = (0, 0);
    while i < T::JOINTS.len() {
        if T::JOINTS[i].first == i {
            joints += 1;
        }
        i += 1;
    }
    wrench && joints > WHOLE
}
