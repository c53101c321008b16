//! Which joint supports which, and which bodies move with a joint: evaluated while compiling.

use super::compile;
use super::tree::{AT_BASE, BodyPlacement, CompiledTree, Joint, PADDING_JOINT};
use crate::model::{BASE, Robot};

/// The compiled robot `T`: its constants, and which joint supports which.
pub(crate) struct CompiledRobot<T, const B: usize, const Q: usize, const V: usize>(
    core::marker::PhantomData<T>,
);

impl<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize> CompiledRobot<T, B, Q, V> {
    pub(crate) const TREE: &'static CompiledTree<B, V> = &{
        assert!(
            V <= 32,
            "the engine takes up to 32 moving bodies; use `Core`"
        );
        compile(&T::MODEL, T::NEGLIGIBLE)
    };

    /// The unit of length, m.
    pub(crate) const LENGTH: f64 = Self::TREE.length;

    /// Its reciprocal, 1/m.
    pub(crate) const LENGTH_INV: f64 = 1.0 / Self::TREE.length;

    /// λ of each joint, or [`BASE`].
    pub(crate) const PARENTS: [usize; V] = {
        let (mut parents, mut i) = ([BASE; V], 0);
        while i < V {
            parents[i] = Self::TREE.joints[i].parent;
            i += 1;
        }
        parents
    };

    /// The joints that support each joint, itself among them, as bits.
    const SUPPORT: [u32; V] = {
        let (mut support, mut i) = ([0; V], 0);
        while i < V {
            let parent = Self::PARENTS[i];
            support[i] = 1 << i;
            if parent != BASE {
                support[i] |= support[parent];
            }
            i += 1;
        }
        support
    };

    /// Whether some chain of joints is too long for its sines and cosines to stay in registers: measured on chains of 3 (slower
    /// by 1 % if they are loaded again), 6 and 7 (faster by 1 %).
    pub(crate) const LOADS_SINES_AGAIN: bool = {
        let (mut longest, mut j) = (0, 0);
        while j < V {
            let depth = Self::SUPPORT[j].count_ones();
            if depth > longest {
                longest = depth;
            }
            j += 1;
        }
        longest > 4
    };

    /// Whether joint `i`, or the base, is the parent of joint `j`.
    pub(crate) const fn is_parent(i: usize, j: usize) -> bool {
        j < V && Self::PARENTS[j] == i
    }

    /// Whether joint `k` is joint `i` or supports it.
    pub(crate) const fn supports(k: usize, i: usize) -> bool {
        k < V && i < V && Self::SUPPORT[i] & (1 << k) != 0
    }

    /// Whether joint `k` supports joint `i`.
    pub(crate) const fn is_ancestor(k: usize, i: usize) -> bool {
        k != i && Self::supports(k, i)
    }

    /// The placement of a body of the description; beyond the last one, the base.
    pub(crate) const fn place(body: usize) -> BodyPlacement {
        if body < B {
            Self::TREE.places[body]
        } else {
            AT_BASE
        }
    }

    /// How many of the bodies that are `loaded` move with joint `i`.
    pub(crate) const fn loads(i: usize, loaded: &[bool; B]) -> usize {
        let (mut count, mut body) = (0, 0);
        while body < B {
            if loaded[body] && Self::place(body).joint == i {
                count += 1;
            }
            body += 1;
        }
        count
    }

    /// The `k`-th of them, or B.
    pub(crate) const fn load(i: usize, k: usize, loaded: &[bool; B]) -> usize {
        let (mut count, mut body) = (0, 0);
        while body < B {
            if loaded[body] && Self::place(body).joint == i {
                if count == k {
                    return body;
                }
                count += 1;
            }
            body += 1;
        }
        B
    }

    /// How many bodies move with joint `i` as one.
    pub(crate) const fn bodies_on(i: usize) -> usize {
        let places = &Self::TREE.places;
        let (mut count, mut body) = (0, 0);
        while body < B {
            if places[body].joint == i {
                count += 1;
            }
            body += 1;
        }
        count
    }

    /// The `k`-th body that moves with joint `i`, and its placement; beyond the last one, the base.
    pub(crate) const fn body_on(i: usize, k: usize) -> (usize, BodyPlacement) {
        let places = &Self::TREE.places;
        let (mut count, mut body) = (0, 0);
        while body < B {
            if places[body].joint == i {
                if count == k {
                    return (body, places[body]);
                }
                count += 1;
            }
            body += 1;
        }
        (B, AT_BASE)
    }

    /// Joint `i`; beyond the last one, the padding joint.
    pub(crate) const fn joint(i: usize) -> Joint {
        if i < V {
            Self::TREE.joints[i]
        } else {
            PADDING_JOINT
        }
    }

    /// The parent of joint `i`, or the padding joint.
    pub(crate) const fn parent_of(i: usize) -> Joint {
        Self::joint(Self::joint(i).parent)
    }
}

/// Joint I of the compiled robot `T`, by constants with names: the compiler evaluates them once, and an inline `const` block
/// in each instance of the function around it, of which there is one for each scalar, set of effects and joint.
pub(crate) struct CompiledJoint<T, const B: usize, const Q: usize, const V: usize, const I: usize>(
    core::marker::PhantomData<T>,
);

impl<T, const B: usize, const Q: usize, const V: usize, const I: usize> CompiledJoint<T, B, Q, V, I>
where
    T: Robot<B, Q, V>,
{
    /// The joint; beyond the last one, the padding joint.
    pub(crate) const JOINT: &'static Joint = &CompiledRobot::<T, B, Q, V>::joint(I);
    /// Whether it is prismatic.
    pub(crate) const PRISMATIC: bool = Self::JOINT.prismatic;
    /// Its parent, or the padding joint.
    pub(crate) const PARENT: &'static Joint = &CompiledRobot::<T, B, Q, V>::parent_of(I);
    /// Whether its parent is the base.
    pub(crate) const IS_ON_BASE: bool = CompiledRobot::<T, B, Q, V>::is_parent(BASE, I);
    /// How many bodies move with it as one.
    pub(crate) const BODIES: usize = CompiledRobot::<T, B, Q, V>::bodies_on(I);
}

/// Joints I and J of the compiled robot `T`.
pub(crate) struct JointPair<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const I: usize,
    const J: usize,
>(core::marker::PhantomData<T>);

impl<T, const B: usize, const Q: usize, const V: usize, const I: usize, const J: usize>
    JointPair<T, B, Q, V, I, J>
where
    T: Robot<B, Q, V>,
{
    /// Whether I is the parent of J.
    pub(crate) const IS_PARENT: bool = CompiledRobot::<T, B, Q, V>::is_parent(I, J);
    /// Whether I is J or supports it.
    pub(crate) const SUPPORTS: bool = CompiledRobot::<T, B, Q, V>::supports(I, J);
    /// Whether I supports J.
    pub(crate) const IS_ANCESTOR: bool = CompiledRobot::<T, B, Q, V>::is_ancestor(I, J);
    /// Whether I supports J, which is prismatic.
    pub(crate) const IS_SLIDE_BEYOND: bool =
        Self::IS_ANCESTOR && CompiledJoint::<T, B, Q, V, J>::PRISMATIC;
    /// Whether more than J bodies move with joint I.
    pub(crate) const HAS_BODY: bool = Self::BODY.0 < B;
    /// The J-th body that moves with joint I, and its placement; beyond the last one, the base.
    pub(crate) const BODY: &'static (usize, BodyPlacement) =
        &CompiledRobot::<T, B, Q, V>::body_on(I, J);
}

/// Joint I of the compiled robot `T`, and a body of the description.
pub(crate) struct JointAndBody<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const I: usize,
    const BODY: usize,
>(core::marker::PhantomData<T>);

impl<T, const B: usize, const Q: usize, const V: usize, const I: usize, const BODY: usize>
    JointAndBody<T, B, Q, V, I, BODY>
where
    T: Robot<B, Q, V>,
{
    /// The placement of the body.
    pub(crate) const PLACE: &'static BodyPlacement = &CompiledRobot::<T, B, Q, V>::place(BODY);
    /// Whether the body moves with the joint as one.
    pub(crate) const IS_ON_JOINT: bool = Self::PLACE.joint == I;
    /// Whether the joint moves the body.
    pub(crate) const SUPPORTS: bool = CompiledRobot::<T, B, Q, V>::supports(I, Self::PLACE.joint);
}
