//! The mass that regrouping leaves to the base: no joint's motion depends on it, but totals over
//! all bodies need it.

use core::marker::PhantomData;

use glam::{DMat3, DVec3};

use super::base_parameters::{mat_add, outer, second_moment};
use super::topology::Compiled;
use crate::math::const_eval::{add, dot, mul, mul_vec, scale, sqrt, transpose};
use crate::model::BASE;

/// Mass, first moment and second moment about the origin of the base and along its axes, in the
/// engine's units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Distribution {
    pub(crate) mass: f64,
    pub(crate) moment: DVec3,
    pub(crate) second: DMat3,
}

/// The remainder of a compiled robot of B bodies and V joints.
pub(crate) struct Remainder<T, const B: usize, const V: usize>(PhantomData<T>);

impl<T: Compiled, const B: usize, const V: usize> Remainder<T, B, V> {
    /// The bodies of the description less those of the engine: the same at all q, so that q = 0
    /// gives it.
    pub(crate) const AT_BASE: &'static Distribution = &{
        let all = described::<T, B>();
        let moving = regrouped::<T, V>();
        // Differences below the rounding of what they are of.
        let size = sqrt(dot(all.moment, all.moment));
        let second = &all.second;
        let largest = sqrt(
            dot(second.x_axis, second.x_axis)
                + dot(second.y_axis, second.y_axis)
                + dot(second.z_axis, second.z_axis),
        );
        let (a, b) = (second, &moving.second);
        Distribution {
            mass: kept(all.mass - moving.mass, all.mass),
            moment: kept_vec(add(all.moment, scale(moving.moment, -1.0)), size),
            second: DMat3::from_cols(
                kept_vec(add(a.x_axis, scale(b.x_axis, -1.0)), largest),
                kept_vec(add(a.y_axis, scale(b.y_axis, -1.0)), largest),
                kept_vec(add(a.z_axis, scale(b.z_axis, -1.0)), largest),
            ),
        }
    };
}

impl Distribution {
    pub(super) const NOTHING: Self = Self { mass: 0.0, moment: DVec3::ZERO, second: DMat3::ZERO };

    /// With a body at `pos` whose axes are the columns of `rot`.
    pub(super) const fn plus(self, body: Self, rot: &DMat3, pos: DVec3) -> Self {
        let h = mul_vec(rot, body.moment);
        let second = mul(&mul(rot, &body.second), &transpose(rot));
        let second = mat_add(&second, &mat_add(&outer(h, pos), &outer(pos, h)));
        let second = mat_add(&second, &outer(pos, scale(pos, body.mass)));
        Self {
            mass: self.mass + body.mass,
            moment: add(self.moment, add(h, scale(pos, body.mass))),
            second: mat_add(&self.second, &second),
        }
    }
}

/// All bodies of the description at q = 0.
const fn described<T: Compiled, const B: usize>() -> Distribution {
    let length = T::LENGTH;
    let (mut rots, mut places) = ([DMat3::IDENTITY; B], [DVec3::ZERO; B]);
    let (mut sum, mut i) = (Distribution::NOTHING, 0);
    while i < B {
        let link = &T::LINKS[i];
        rots[i] = transpose(&link.placement.rot);
        places[i] = link.placement.pos;
        if link.parent != BASE {
            let (rot, pos) = (&rots[link.parent], places[link.parent]);
            places[i] = add(mul_vec(rot, places[i]), pos);
            rots[i] = mul(rot, &rots[i]);
        }
        let body = Distribution {
            mass: link.inertia.mass * length * length,
            moment: scale(link.inertia.first_moment, length),
            second: second_moment(&link.inertia.rotational),
        };
        sum = sum.plus(body, &rots[i], scale(places[i], 1.0 / length));
        i += 1;
    }
    sum
}

/// The bodies of the engine at q = 0.
const fn regrouped<T: Compiled, const V: usize>() -> Distribution {
    let (mut rots, mut places) = ([DMat3::IDENTITY; V], [DVec3::ZERO; V]);
    let (mut sum, mut i) = (Distribution::NOTHING, 0);
    while i < V {
        let joint = &T::JOINTS[i];
        (rots[i], places[i]) = (joint.rot, joint.pos);
        if joint.parent != BASE {
            let (rot, pos) = (&rots[joint.parent], places[joint.parent]);
            places[i] = add(mul_vec(rot, places[i]), pos);
            rots[i] = mul(rot, &rots[i]);
        }
        let body = Distribution {
            mass: joint.mass,
            moment: joint.moment,
            second: joint.second_moment_only,
        };
        sum = sum.plus(body, &rots[i], places[i]);
        i += 1;
    }
    sum
}

/// A difference of numbers of this size, if it is more than their rounding.
const fn kept(x: f64, size: f64) -> f64 {
    if x.abs() <= 64.0 * f64::EPSILON * size { 0.0 } else { x }
}

pub(super) const fn kept_vec(v: DVec3, size: f64) -> DVec3 {
    DVec3::new(kept(v.x, size), kept(v.y, size), kept(v.z, size))
}
