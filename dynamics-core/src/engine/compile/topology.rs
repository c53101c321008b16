//! Which joint supports which, and which bodies move with a joint: evaluated while compiling.

use super::compile;
use super::tree::{AT_BASE, BodyPlacement, CompiledTree, Joint, PADDING_JOINT};
use crate::model::{BASE, Robot};

/// The compiled robot `T`: its constants, and which joint supports which.
pub(crate) struct CompiledRobot<T, const B: usize, const Q: usize, const V: usize>(
    core::marker::PhantomData<T>,
);

impl<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize> CompiledRobot<T, B, Q, V> {
    pub(crate) const TREE: CompiledTree<B, V> = {
        assert!(
            V <= 32,
            "the engine takes up to 32 moving bodies; use `Core`"
        );
        compile(&T::MODEL, T::NEGLIGIBLE)
    };

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
        let places = const { &Self::TREE.places };
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
        let places = const { &Self::TREE.places };
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
