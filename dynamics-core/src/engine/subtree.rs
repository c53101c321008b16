//! Robots of more than 16 joints are split into one function per subtree where wrenches act on
//! bodies.
//!
//! There a humanoid of 29 joints takes fewer cycles with a function for each limb, and elsewhere
//! fewer in one function; the figures are in `docs/decisions/0013-joints-of-every-kind.md`.
//! Arguments between the functions are plain numbers; values that no effect needs are known zeros
//! in each function.

use super::acceleration_field::{AccelerationField, Wrench};
use super::compile::{Compiled, has_subtree_functions, is_parent, last};
use super::folding::Folded;
use super::folding::{Mat3, Vec3};
use super::pose::Pose;
use super::reaction::Reactions;
use super::rnea::Task;
use crate::effects::{Declared, Effect};
use crate::scalar::{Real, Vector};

/// Whether joint `i` of a large robot is the parent of several others.
const fn is_subtree_root<T: Compiled>(i: usize, wrench: bool) -> bool {
    let (mut children, mut j) = (0, 0);
    while j < T::JOINTS.len() {
        if is_parent::<T>(last::<T>(i), j) {
            children += 1;
        }
        j += 1;
    }
    has_subtree_functions::<T>(wrench) && children > 1
}

impl<R, T, E, Seen, const B: usize, const Q: usize, const V: usize> Task<'_, R, T, E, Seen, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
    Seen: Reactions<R, T>,
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
        parent: &AccelerationField<R>,
    ) -> Wrench<R> {
        if const { !is_subtree_root::<T>(I, E::WRENCH) } {
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
    fn child_subtree<const J: usize>(&mut self, parent: &SpilledField<R>) -> [R::Vec3; 2] {
        let ([omega, omega_products, alpha], [ux, uy, uz]) = (parent.rates, parent.u);
        let [a, v] = parent.origin;
        let [x, y, z, origin] = parent.pose.map(|v| runtime_if(E::BODY_POSE, v));
        let moves = E::VELOCITY_PRODUCTS | E::ACCELERATIONS | E::BASE_MOTION;
        let field = AccelerationField {
            omega: runtime_if(E::BODY_VELOCITY, omega),
            omega_products: runtime_if(E::VELOCITY_PRODUCTS, omega_products),
            alpha: runtime_if(moves, alpha),
            u: Mat3([runtime_if(moves, ux), runtime_if(moves, uy), runtime_if(moves, uz)]),
            a: runtime_if(moves | E::FIELD, a),
            v: runtime_if(E::BODY_VELOCITY, v),
            pose: Pose { axes: Mat3([x, y, z]), origin },
        };
        let wrench = self.visit::<J>(&field);
        [wrench.f.get(), wrench.n.get()]
    }
}

/// A field in memory: ω, ω of the velocity products, α; U's columns; a and v of the origin; axes
/// and origin.
struct SpilledField<R: Real> {
    rates: [R::Vec3; 3],
    u: [R::Vec3; 3],
    origin: [R::Vec3; 2],
    pose: [R::Vec3; 4],
}

/// A vector that is a known zero unless an effect needs it.
#[cfg_attr(optimised, inline(always))]
fn runtime_if<R: Real>(needed: bool, v: R::Vec3) -> Vec3<R> {
    let [x, y, z] = v.array();
    Vec3([
        Folded::runtime_if(needed, x),
        Folded::runtime_if(needed, y),
        Folded::runtime_if(needed, z),
    ])
}
