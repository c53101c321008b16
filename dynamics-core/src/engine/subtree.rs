//! Robots of more than 16 joints are split into one function per subtree where wrenches act on
//! bodies.
//!
//! There a humanoid of 29 joints takes fewer cycles with a function for each limb, and elsewhere
//! fewer in one function; the figures are in `docs/decisions/0013-joints-of-every-kind.md`.
//! Arguments between the functions are plain numbers; values that no effect needs are known zeros
//! in each function.

use super::acceleration_field::{AccelerationField, Wrench};
use super::compile::{Compiled, is_parent, last};
use super::folding::Folded;
use super::folding::{Mat3, Vec3};
use super::pose::Pose;
use super::reaction::Reactions;
use super::rnea::Task;
use crate::effects::{Declared, Effect};
use crate::scalar::{Real, Vector};

/// Robots of up to this number of joints are one function.
const WHOLE: usize = 16;

/// Whether a robot is split, in a scene with wrenches on bodies or without.
pub(crate) const fn has_subtree_functions<Tree: Compiled>(wrench: bool) -> bool {
    let (mut joints, mut i) = (0, 0);
    while i < Tree::JOINTS.len() {
        if Tree::JOINTS[i].first == i {
            joints += 1;
        }
        i += 1;
    }
    wrench && joints > WHOLE
}

/// Whether joint `i` of a large robot is the parent of several others.
const fn is_subtree_root<Tree: Compiled>(i: usize, wrench: bool) -> bool {
    let (mut children, mut j) = (0, 0);
    while j < Tree::JOINTS.len() {
        if is_parent::<Tree>(last::<Tree>(i), j) {
            children += 1;
        }
        j += 1;
    }
    has_subtree_functions::<Tree>(wrench) && children > 1
}

impl<Scalar, Tree, Effects, Seen, const B: usize, const Q: usize, const V: usize>
    Task<'_, Scalar, Tree, Effects, Seen, B, Q, V>
where
    Scalar: Real,
    Tree: Compiled,
    Effects: Effect<Scalar, B, V>,
    Seen: Reactions<Scalar, Tree>,
{
    /// Joint I on the base and its descendants.
    #[inline(never)]
    pub(crate) fn root_subtree<const I: usize>(&mut self) {
        let base = self.call.base();
        self.visit::<I>(&base);
    }

    /// Visits joint J on joint I, whose field is `parent`.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn visit_child<const I: usize, const J: usize>(
        &mut self,
        parent: &AccelerationField<Scalar>,
    ) -> Wrench<Scalar> {
        if const { !is_subtree_root::<Tree>(I, Effects::WRENCH) } {
            return self.visit::<J>(parent);
        }
        let ([ux, uy, uz], [x, y, z]) = (parent.u.0, parent.pose.axes.0);
        let field = SpilledField {
            rates: [parent.omega, parent.omega_products, parent.alpha].map(Vec3::get),
            u: [ux, uy, uz].map(Vec3::get),
            origin: [parent.a, parent.v].map(Vec3::get),
            pose: [x, y, z, parent.pose.origin].map(Vec3::get),
        };
        let [f, n] = self.child_subtree::<J>(&field);
        Wrench { f: Vec3::runtime(f), n: Vec3::runtime(n) }
    }

    #[inline(never)]
    fn child_subtree<const J: usize>(
        &mut self,
        parent: &SpilledField<Scalar>,
    ) -> [Scalar::Vec3; 2] {
        let ([omega, omega_products, alpha], [ux, uy, uz]) = (parent.rates, parent.u);
        let [a, v] = parent.origin;
        let [x, y, z, origin] = parent.pose.map(|v| runtime_if(Effects::BODY_POSE, v));
        let moves = Effects::VELOCITY_PRODUCTS | Effects::ACCELERATIONS | Effects::BASE_MOTION;
        let field = AccelerationField {
            omega: runtime_if(Effects::BODY_VELOCITY, omega),
            omega_products: runtime_if(Effects::VELOCITY_PRODUCTS, omega_products),
            alpha: runtime_if(moves, alpha),
            u: Mat3([runtime_if(moves, ux), runtime_if(moves, uy), runtime_if(moves, uz)]),
            a: runtime_if(moves | Effects::FIELD, a),
            v: runtime_if(Effects::BODY_VELOCITY, v),
            pose: Pose { axes: Mat3([x, y, z]), origin },
        };
        let wrench = self.visit::<J>(&field);
        [wrench.f.get(), wrench.n.get()]
    }
}

/// A field in memory: ω, ω of the velocity products, α; U's columns; a and v of the origin; axes
/// and origin.
struct SpilledField<Scalar: Real> {
    rates: [Scalar::Vec3; 3],
    u: [Scalar::Vec3; 3],
    origin: [Scalar::Vec3; 2],
    pose: [Scalar::Vec3; 4],
}

/// A vector that is a known zero unless an effect needs it.
#[cfg_attr(optimised, inline(always))]
fn runtime_if<Scalar: Real>(needed: bool, v: Scalar::Vec3) -> Vec3<Scalar> {
    let [x, y, z] = v.array();
    Vec3([
        Folded::runtime_if(needed, x),
        Folded::runtime_if(needed, y),
        Folded::runtime_if(needed, z),
    ])
}
