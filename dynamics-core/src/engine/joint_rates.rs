//! The rates of a joint as its body's field needs them.

use super::compile::{Compiled, CompiledJoint, Joint, JointMotion};
use super::displacement::Displacement;
use super::folding::{Folded, Mat3, Vec3};
use crate::scalar::Real;

/// Rates of a joint, in units of length; zero where no effect needs them.
#[derive(Clone, Copy)]
pub(crate) struct JointRates<R> {
    pub(crate) velocity: Folded<R>,
    /// The velocity in the velocity products.
    pub(crate) omega_products: Folded<R>,
    pub(crate) accel: Folded<R>,
}

/// Rates of a planar, spherical or free joint, rotations and translations, in units of length; zero
/// where no effect needs them.
#[derive(Clone, Copy)]
pub(crate) struct SeveralRates<R> {
    pub(crate) velocity: Twist<R>,
    /// The velocity in the velocity products.
    pub(crate) products: Twist<R>,
    pub(crate) accel: Twist<R>,
}

/// Components of a motion along the axes of a body, in units of length.
#[derive(Clone, Copy)]
pub(crate) struct Twist<R> {
    pub(crate) ang: Vec3<R>,
    pub(crate) lin: Vec3<R>,
}

impl<R: Real> Twist<R> {
    pub(crate) const ZERO: Self = Self { ang: Vec3::ZERO, lin: Vec3::ZERO };

    /// The motion of a joint's body at this rate of its coordinate.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn along(joint: &Joint, length_inv: f64, rate: Folded<R>) -> Self {
        let mut motion = Self::ZERO;
        if joint.prismatic {
            motion.lin.0[joint.axis] = rate * Folded::constant(length_inv);
        } else {
            motion.ang.0[joint.axis] = rate;
        }
        if matches!(joint.motion, JointMotion::Screw) {
            motion.lin.0[2] = rate * Folded::constant(joint.pitch);
        }
        motion
    }

    /// A motion of the parent as one of the body behind joint I.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn carried<T: Compiled, const I: usize>(&self, at: &Displacement<R, T, I>) -> Self {
        let joint = CompiledJoint::<T, I>::JOINT;
        let rot = Mat3::constant(&joint.rot);
        let p = Vec3::constant(joint.pos) + at.shift();
        Self { ang: at.enter(&rot, self.ang), lin: at.enter(&rot, self.lin + self.ang.cross(p)) }
    }

    /// The motion of joint I, a planar, spherical or free one, of all `rates`; zero unless it is
    /// needed.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn of<T: Compiled, const V: usize, const I: usize>(
        rates: &[R; V],
        needed: bool,
    ) -> Self {
        let zero = Folded::ZERO;
        let length_inv = Folded::constant(T::LENGTH_INV);
        let (ang, lin) = match CompiledJoint::<T, I>::MOTION {
            JointMotion::Planar => (
                [zero, zero, rate(rates, I, needed)],
                [rate(rates, I + 1, needed), rate(rates, I + 2, needed), zero],
            ),
            JointMotion::Spherical => (three(rates, I, needed), [zero; 3]),
            _ => (three(rates, I, needed), three(rates, I + 3, needed)),
        };
        Self { ang: Vec3(ang), lin: Vec3(lin).scale(length_inv) }
    }
}

#[cfg_attr(optimised, inline(always))]
fn three<R: Real, const V: usize>(rates: &[R; V], first: usize, needed: bool) -> [Folded<R>; 3] {
    [rate(rates, first, needed), rate(rates, first + 1, needed), rate(rates, first + 2, needed)]
}

#[cfg_attr(optimised, inline(always))]
fn rate<R: Real, const V: usize>(rates: &[R; V], k: usize, needed: bool) -> Folded<R> {
    Folded::runtime_if(needed, rates[k])
}
