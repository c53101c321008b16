//! The rounding error of the pivots of forward dynamics, relative to the largest inertia that each
//! joint could move, and the joints whose pivots do not exceed it.
//!
//! As in [`crate::algorithms`], m, |h| and ∫ r² dm of a joint and its descendants, as if they lay
//! in one line away from it. Turns do not change them, so that they are constants of the robot;
//! slides and a payload add to them.

use super::call::Call;
use super::compile::{
    Compiled, CompiledJoint, JointMotion, JointPair, is_slide_beyond, joint, place, supports,
};
use super::{Index, only_if};
use crate::algorithms::NotPositiveDefinite;
use crate::effects::{Declared, Effect, RegroupedInertia, add_inertia, call_hook};
use crate::model::{BASE, JointKind, Link};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::SpatialInertia;
use glam::DVec3;

/// The number of its own roundings that a pivot must exceed: up to 3.1 were measured for
/// articulated bodies and 12 of LᵀDL where M is singular, and no fewer than 51 where it is regular
/// (a rope of ten light rods with a weight at its end, in f32).
const ROUNDINGS: f64 = 16.0;

/// Mass, kg, largest first moment, kg·m, and largest ∫ r² dm, kg·m², of a joint and its
/// descendants, about its origin.
#[derive(Clone, Copy)]
struct Size {
    mass: f64,
    moment: f64,
    second: f64,
}

const NOTHING: Size = Size { mass: 0.0, moment: 0.0, second: 0.0 };

/// Carries the constants of a robot.
struct Sizes<T, const B: usize, const V: usize>(core::marker::PhantomData<T>);

impl<T: Compiled, const B: usize, const V: usize> Sizes<T, B, V> {
    const ALL: [Size; V] = sizes::<B, V>(T::LINKS);

    /// The size of joint `i`; beyond the last joint, zero.
    const fn of(i: usize) -> Size {
        if i < V { Self::ALL[i] } else { NOTHING }
    }
}

const fn sizes<const B: usize, const V: usize>(links: &[Link<f64>]) -> [Size; V] {
    let (mut bodies, mut joints) = ([NOTHING; B], [NOTHING; V]);
    let mut i = B;
    while i > 0 {
        i -= 1;
        let link = &links[i];
        let own = &link.inertia;
        let mut size = bodies[i];
        size.mass += own.mass;
        size.moment += length(own.first_moment);
        size.second +=
            0.5 * (own.rotational.x_axis.x + own.rotational.y_axis.y + own.rotational.z_axis.z);
        if !matches!(link.joint.kind, JointKind::Fixed) {
            let mut k = 0;
            while k < link.joint.kind.coordinates().1 {
                joints[link.idx_v + k] = size;
                k += 1;
            }
        }
        if link.parent != BASE {
            let (r, parent) = (length(link.placement.pos), &mut bodies[link.parent]);
            let moment = size.moment + r * size.mass;
            parent.mass += size.mass;
            parent.moment += moment;
            parent.second += size.second + r * (size.moment + moment);
        }
    }
    joints
}

/// The longest distance of the origin of `body` from that of the body on joint `i`, an ancestor, m.
const fn reach(links: &[Link<f64>], i: usize, mut body: usize) -> f64 {
    let mut sum = 0.0;
    while body < links.len() {
        let link = &links[body];
        if link.idx_v <= i && i < link.idx_v + link.joint.kind.coordinates().1 {
            break;
        }
        sum += length(link.placement.pos);
        body = link.parent;
    }
    sum
}

/// The `k`-th of the bodies with a payload that joint `i` or a descendant moves, or the number of
/// all bodies.
const fn load<T: Compiled>(i: usize, k: usize, loaded: &[bool]) -> usize {
    let (mut count, mut body) = (0, 0);
    while body < loaded.len() {
        if loaded[body] && supports::<T>(i, place::<T>(body).joint) {
            if count == k {
                return body;
            }
            count += 1;
        }
        body += 1;
    }
    loaded.len()
}

const fn length(v: DVec3) -> f64 {
    v.x.abs() + v.y.abs() + v.z.abs()
}

/// The joints whose pivots are only rounding errors, as bits. Noting one takes no branch, so that
/// the compiler can place it among the arithmetic of the next pivot.
#[derive(Clone, Copy, Default)]
pub(crate) struct Singular(u32);

impl Singular {
    /// Whether a joint was noted.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn is_any(self) -> bool {
        self.0 != 0
    }

    /// Notes joint J unless its pivot is a number and more than `noise`.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn note<R: Real, const J: usize>(&mut self, pivot: R, noise: R) {
        let exceeds = pivot > noise;
        self.0 |= u32::from(!exceeds) << J;
    }

    /// The error of the outermost joint that was noted.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn outermost(self) -> Result<(), NotPositiveDefinite> {
        match self.0.checked_ilog2() {
            None => Ok(()),
            Some(joint) => Err(NotPositiveDefinite { joint: joint as usize }),
        }
    }
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// The pivots that rounding may leave of a singular M: of each joint, kg·m² or kg.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn noise(self) -> [R; V] {
        let mut noise = [R::ZERO; V];
        for_each_joint!(
            J,
            Index::<J, V>::IS_BELOW,
            pivot_noise = Self::pivot_noise::<J> as fn(_) -> _,
            {
                noise[J] = pivot_noise(self);
            }
        );
        noise
    }

    /// Whether the pivots of forward dynamics exceed their noise in any state, of joints on a
    /// parent: of numbers, only a NaN does not.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn certain(self) -> [bool; V] {
        let mut certain = [false; V];
        for_each_joint!(J, {
            if Index::<J, V>::IS_BELOW {
                certain[J] = const { Self::is_certain(J) } && self.effects.inertia(J).is_none();
            }
        });
        certain
    }

    /// The same of joint `i` without its rotor, by the inertia of its body alone.
    const fn is_certain(i: usize) -> bool {
        let joint = joint::<T>(i);
        let size = Sizes::<T, B, V>::of(i);
        let most = if joint.prismatic { size.mass } else { size.second };
        // The rounding errors of f32, and as much again for those of the pivot.
        let noise = 2.0 * ROUNDINGS * f32::EPSILON as f64 * most + f32::MIN_POSITIVE as f64;
        joint.parent != BASE
            && joint.alone > noise
            && E::BASE_PARAMETERS == 0
            && load::<T>(i, 0, &E::PAYLOAD) == B
            && !slides_beyond::<T>(i)
    }

    /// The same of joint I. A pivot that exceeds it has a finite reciprocal: neither the smallest
    /// numbers nor, of an infinite inertia, infinity does.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn pivot_noise<const I: usize>(self) -> R {
        let mut size = self.largest_inertia::<I>();
        add_inertia(self.effects, I, &mut size);
        size * (R::EPSILON * R::from_f64(ROUNDINGS)) + R::MIN_POSITIVE
    }

    /// The largest inertia that joint I could move, without its rotor's: a constant of robots
    /// without slides and payload.
    #[cfg_attr(optimised, inline(always))]
    fn largest_inertia<const I: usize>(self) -> R {
        let own = const { Sizes::<T, B, V>::of(I) };
        let [mut mass, mut moment, mut second] =
            [own.mass, own.moment, own.second].map(R::from_f64);
        if const { E::BASE_PARAMETERS > 0 } {
            let mut body = RegroupedInertia::default();
            call_hook!(E::REGROUPED.load, self.effects, I, &mut body);
            [mass, moment, second] = body.size;
        }
        let prismatic = CompiledJoint::<T, I>::PRISMATIC;
        let mut size = if prismatic { mass } else { second };
        let mut slides = R::ZERO;
        if !prismatic {
            for_each_joint!(K, {
                if JointPair::<T, I, K>::IS_SLIDE_BEYOND {
                    slides += self.slide::<K>();
                }
            });
            if const { slides_beyond::<T>(I) } {
                size += slides * (moment + moment + slides * mass);
            }
        }
        if const { load::<T>(I, 0, &E::PAYLOAD) < B }
            && let Some(payloads_added) = const {
                only_if(
                    load::<T>(I, 0, &E::PAYLOAD) < B,
                    Self::payloads_added::<I> as fn(_, _, _) -> _,
                )
            }
        {
            size = payloads_added(self, size, slides);
        }
        size
    }

    /// The distance by which coordinate I has moved its body's origin, m.
    #[cfg_attr(optimised, inline(always))]
    fn slide<const I: usize>(self) -> R {
        let joint = CompiledJoint::<T, I>::JOINT;
        let q = match CompiledJoint::<T, I>::POSITION {
            Some(position) => self.turns[position].q.abs(),
            None => R::ZERO,
        };
        match CompiledJoint::<T, I>::MOTION {
            JointMotion::Screw => q * R::from_f64((joint.pitch * T::LENGTH).abs()),
            _ => q,
        }
    }

    /// Adds the payloads that joint I moves to the inertia that it could move.
    #[cfg_attr(optimised, inline(always))]
    fn payloads_added<const I: usize>(self, mut size: R, slides: R) -> R {
        const {
            assert!(
                load::<T>(I, 32, &E::PAYLOAD) == B,
                "the engine takes up to 32 bodies with payloads; use `Core`"
            )
        };
        for_each_joint!(K, {
            let body = const { load::<T>(I, K, &E::PAYLOAD) };
            if body < B {
                let mut payload = SpatialInertia::ZERO;
                call_hook!(E::ADDED_INERTIA.add, self.effects, body, &mut payload);
                size += if CompiledJoint::<T, I>::PRISMATIC {
                    payload.mass
                } else {
                    let reach = const { reach(T::LINKS, I, load::<T>(I, K, &E::PAYLOAD)) };
                    of_load(&payload, slides + R::from_f64(reach))
                };
            }
        });
        size
    }
}

/// The largest inertia of a payload about an axis that is no further than `reach` from its body's
/// origin.
#[cfg_attr(optimised, inline(always))]
fn of_load<R: Real>(load: &SpatialInertia<R>, reach: R) -> R {
    let [x, y, z] = load.rotational.cols().map(Vector::array);
    let [hx, hy, hz] = load.first_moment.array();
    let moment = hx.abs() + hy.abs() + hz.abs();
    (x[0] + y[1] + z[2]) * R::from_f64(0.5) + reach * (moment + moment + reach * load.mass)
}

/// Whether joint `i` has a descendant that slides.
const fn slides_beyond<T: Compiled>(i: usize) -> bool {
    let mut k = 0;
    while k < T::JOINTS.len() {
        if is_slide_beyond::<T>(i, k) {
            return true;
        }
        k += 1;
    }
    false
}
