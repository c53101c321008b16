//! The displacement of a joint: where its body is on the parent side, and what crosses the joint.
//!
//! Beyond the constant placement of the joint's frame in the parent's: RBDA (2008), table 4.1.
//! Rotations about z need a sine and a cosine; those of spherical and free joints are the matrix of
//! the unit quaternion.

use core::marker::PhantomData;

use super::compile::{Compiled, CompiledJoint, JointMotion};
use super::folding::{Folded, Mat3, Sym3, Vec3, constant_offset_cross, rotate_to_parent};
use crate::model::{JointCoordinate, near_unit, rotation};
use crate::scalar::{Matrix, Real};
use crate::trig::Kernel;

impl<T: Compiled, const I: usize> CompiledJoint<T, I> {
    /// Writes the sine and cosine, or the unit quaternion and other positions, that coordinate I
    /// brings.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn turn<R: Real, K: Kernel<R>, const Q: usize>(
        q: &[R; Q],
        turns: &mut [JointCoordinate<R>; Q],
    ) {
        if matches!(Self::MOTION, JointMotion::Spherical | JointMotion::Free) {
            let first = Self::Q;
            let unit = near_unit([q[first], q[first + 1], q[first + 2], q[first + 3]]);
            turns[first] = JointCoordinate::linear(unit[0]);
            turns[first + 1] = JointCoordinate::linear(unit[1]);
            turns[first + 2] = JointCoordinate::linear(unit[2]);
            turns[first + 3] = JointCoordinate::linear(unit[3]);
        }
        if let Some(k) = Self::POSITION {
            turns[k] = match (Self::PRISMATIC, Self::JOINT.near) {
                (true, _) => JointCoordinate::linear(q[k]),
                (false, true) => JointCoordinate::revolute_bounded::<K>(q[k]),
                (false, false) => JointCoordinate::with_kernel::<K>(q[k]),
            };
        }
    }
}

/// The displacement of one joint; what its kind does not have is a known zero.
pub(crate) struct Displacement<R, T, const I: usize> {
    /// The sine and cosine of the rotation about z.
    pub(crate) turn: JointCoordinate<R>,
    /// The translation along z, in units of length.
    pub(crate) slide: Folded<R>,
    /// The translation of a planar or free joint, in the joint's frame and in units of length.
    offset: Vec3<R>,
    /// The rotation of coordinates from the joint's frame to the body's, of a spherical or free
    /// joint.
    attitude: Mat3<R>,
    joint: PhantomData<T>,
}

impl<R: Real, T: Compiled, const I: usize> Displacement<R, T, I> {
    /// The displacement of joint I.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn of<const Q: usize>(turns: &[JointCoordinate<R>; Q]) -> Self {
        let turn = turns[CompiledJoint::<T, I>::Q];
        let length_inv = Folded::constant(T::LENGTH_INV);
        let mut at = Self {
            turn,
            slide: Folded::ZERO,
            offset: Vec3::ZERO,
            attitude: Mat3::ZERO,
            joint: PhantomData,
        };
        match CompiledJoint::<T, I>::MOTION {
            JointMotion::Turn | JointMotion::Still => {}
            JointMotion::Slide => at.slide = Folded::runtime(turn.q) * length_inv,
            JointMotion::Screw => {
                let pitch = Folded::constant(CompiledJoint::<T, I>::JOINT.pitch);
                at.slide = Folded::runtime(turn.q) * pitch;
            }
            JointMotion::Planar => {
                let first = CompiledJoint::<T, I>::Q + 1;
                let (x, y) = (position(turns, first), position(turns, first + 1));
                at.offset = Vec3([x, y, Folded::ZERO]).scale(length_inv);
            }
            JointMotion::Spherical => at.attitude = attitude(turns, CompiledJoint::<T, I>::Q),
            JointMotion::Free => {
                at.attitude = attitude(turns, CompiledJoint::<T, I>::Q);
                let first = CompiledJoint::<T, I>::Q + 4;
                at.offset = Vec3([
                    position(turns, first),
                    position(turns, first + 1),
                    position(turns, first + 2),
                ])
                .scale(length_inv);
            }
        }
        at
    }

    /// The same with a sine and cosine that are loaded again.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn with_turn(self, turn: JointCoordinate<R>) -> Self {
        Self { turn, ..self }
    }

    /// From the parent's frame to the body's: `rot` is the constant rotation of the joint's frame.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn enter(&self, rot: &Mat3<R>, v: Vec3<R>) -> Vec3<R> {
        let v = rot.transpose_mul(v);
        match CompiledJoint::<T, I>::MOTION {
            JointMotion::Turn | JointMotion::Screw | JointMotion::Planar => {
                let (sin, cos) = self.sin_cos();
                v.turn_back(sin, cos)
            }
            JointMotion::Spherical | JointMotion::Free => self.attitude.mul(v),
            JointMotion::Slide | JointMotion::Still => v,
        }
    }

    /// From the body's frame to the joint's.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn leave(&self, v: Vec3<R>) -> Vec3<R> {
        match CompiledJoint::<T, I>::MOTION {
            JointMotion::Turn | JointMotion::Screw | JointMotion::Planar => {
                let (sin, cos) = self.sin_cos();
                v.turn(sin, cos)
            }
            JointMotion::Spherical | JointMotion::Free => self.attitude.transpose_mul(v),
            JointMotion::Slide | JointMotion::Still => v,
        }
    }

    /// The same of a symmetric matrix.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn leave_symmetric(&self, s: Sym3<R>) -> Sym3<R> {
        match CompiledJoint::<T, I>::MOTION {
            JointMotion::Turn | JointMotion::Screw | JointMotion::Planar => {
                let (sin, cos) = self.sin_cos();
                s.turn(sin, cos)
            }
            JointMotion::Spherical | JointMotion::Free => {
                Sym3::of(&self.leave_both(&Mat3(s.columns())))
            }
            JointMotion::Slide | JointMotion::Still => s,
        }
    }

    /// The same of any matrix.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn leave_matrix(&self, m: &Mat3<R>) -> Mat3<R> {
        match CompiledJoint::<T, I>::MOTION {
            JointMotion::Turn | JointMotion::Screw | JointMotion::Planar => {
                let (sin, cos) = self.sin_cos();
                m.rotated_about_z(sin, cos)
            }
            JointMotion::Spherical | JointMotion::Free => self.leave_both(m),
            JointMotion::Slide | JointMotion::Still => *m,
        }
    }

    /// Eᵀ M E.
    #[cfg_attr(optimised, inline(always))]
    fn leave_both(&self, m: &Mat3<R>) -> Mat3<R> {
        let [x, y, z] = m.0;
        let half = Mat3([self.leave(x), self.leave(y), self.leave(z)]);
        let [x, y, z] = half.rows();
        let rows = Mat3([self.leave(x), self.leave(y), self.leave(z)]);
        Mat3(rows.rows())
    }

    /// The body's axes along those of the frame of which `joint` holds the axes of the joint's
    /// frame.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn axes(&self, joint: &Mat3<R>) -> Mat3<R> {
        let [x, y, z] = joint.0;
        match CompiledJoint::<T, I>::MOTION {
            JointMotion::Turn | JointMotion::Screw | JointMotion::Planar => {
                let (sin, cos) = self.sin_cos();
                Mat3([x.scale(cos) + y.scale(sin), y.scale(cos) - x.scale(sin), z])
            }
            JointMotion::Spherical | JointMotion::Free => {
                let [x, y, z] = self.attitude.rows();
                Mat3([joint.mul(x), joint.mul(y), joint.mul(z)])
            }
            JointMotion::Slide | JointMotion::Still => Mat3([x, y, z]),
        }
    }

    /// The translation in the frame of which `joint` holds the axes of the joint's frame, in units
    /// of length.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn along(&self, joint: &Mat3<R>) -> Vec3<R> {
        match CompiledJoint::<T, I>::MOTION {
            JointMotion::Slide | JointMotion::Screw => joint.0[2].scale(self.slide),
            JointMotion::Planar | JointMotion::Free => joint.mul(self.offset),
            JointMotion::Turn | JointMotion::Spherical | JointMotion::Still => Vec3::ZERO,
        }
    }

    /// The translation in the frame of the parent, in units of length.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn shift(&self) -> Vec3<R> {
        match CompiledJoint::<T, I>::MOTION {
            JointMotion::Slide | JointMotion::Screw => {
                Vec3::constant(CompiledJoint::<T, I>::JOINT.rot.z_axis).scale(self.slide)
            }
            JointMotion::Planar | JointMotion::Free => rotate_to_parent::<R, T, I>(self.offset),
            JointMotion::Turn | JointMotion::Spherical | JointMotion::Still => Vec3::ZERO,
        }
    }

    #[cfg_attr(optimised, inline(always))]
    fn sin_cos(&self) -> (Folded<R>, Folded<R>) {
        (Folded::runtime(self.turn.sin), Folded::runtime(self.turn.cos))
    }
}

/// p × v, p the offset from the origin of joint I's parent to its own.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn offset_cross<R: Real, T, const I: usize>(
    v: Vec3<R>,
    at: &Displacement<R, T, I>,
) -> Vec3<R>
where
    T: Compiled,
{
    let mut sum = constant_offset_cross::<R, T, I>(v);
    if CompiledJoint::<T, I>::SHIFTS {
        sum = sum + at.shift().cross(v);
    }
    sum
}

/// p × each column.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn cross_offset<R: Real, T, const I: usize>(
    Mat3([x, y, z]): Mat3<R>,
    at: &Displacement<R, T, I>,
) -> Mat3<R>
where
    T: Compiled,
{
    Mat3([offset_cross(x, at), offset_cross(y, at), offset_cross(z, at)])
}

/// The position of the number `k`.
#[cfg_attr(optimised, inline(always))]
fn position<R: Real, const Q: usize>(turns: &[JointCoordinate<R>; Q], k: usize) -> Folded<R> {
    Folded::runtime(turns[k].q)
}

/// The matrix of the unit quaternion whose coordinates begin at `first`.
#[cfg_attr(optimised, inline(always))]
fn attitude<R: Real, const Q: usize>(turns: &[JointCoordinate<R>; Q], first: usize) -> Mat3<R> {
    let q = [first, first + 1, first + 2, first + 3].map(|k| turns[k].q);
    let [x, y, z] = rotation(q).cols().map(Vec3::runtime);
    Mat3([x, y, z])
}
