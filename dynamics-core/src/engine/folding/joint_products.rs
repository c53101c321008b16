//! Products with a joint's constants, selected before LLVM: only terms that are not zero are
//! generated. LLVM would remove the others as well, but in ten times the time.

use crate::engine::compile::{Compiled, CompiledJoint, Joint};
use crate::engine::folding::Folded;
use crate::engine::folding::{Mat3, Sym3, Vec3};
use crate::scalar::Real;

/// The rotation of a joint's frame.
const ROT: usize = 0;
/// \[p\]×.
const CROSS: usize = 1;

/// R v of joint I.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn rotate_to_parent<R: Real, T, const I: usize>(v: Vec3<R>) -> Vec3<R>
where
    T: Compiled,
{
    product::<R, T, ROT, I>(v)
}

/// p × v, p the offset from the origin of joint I's parent to its own, without the joint's own
/// translation.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn constant_offset_cross<R: Real, T, const I: usize>(v: Vec3<R>) -> Vec3<R>
where
    T: Compiled,
{
    product::<R, T, CROSS, I>(v)
}

/// R M Rᵀ of joint I.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn rotate_matrix_to_parent<R: Real, T, const I: usize>(m: &Mat3<R>) -> Mat3<R>
where
    T: Compiled,
{
    let half = columns_rotated::<R, T, I>(*m);
    let rows = columns_rotated::<R, T, I>(Mat3(half.rows()));
    Mat3(rows.rows())
}

#[cfg_attr(optimised, inline(always))]
fn columns_rotated<R: Real, T, const I: usize>(Mat3([x, y, z]): Mat3<R>) -> Mat3<R>
where
    T: Compiled,
{
    Mat3([
        rotate_to_parent::<R, T, I>(x),
        rotate_to_parent::<R, T, I>(y),
        rotate_to_parent::<R, T, I>(z),
    ])
}

/// R S Rᵀ of joint I.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn rotate_symmetric_to_parent<R: Real, T, const I: usize>(s: Sym3<R>) -> Sym3<R>
where
    T: Compiled,
{
    Sym3::of(&rotate_matrix_to_parent::<R, T, I>(&Mat3(s.columns())))
}

#[cfg_attr(optimised, inline(always))]
fn product<R: Real, T, const M: usize, const I: usize>(v: Vec3<R>) -> Vec3<R>
where
    T: Compiled,
{
    Vec3([row::<R, T, M, I, 0>(v), row::<R, T, M, I, 1>(v), row::<R, T, M, I, 2>(v)])
}

#[cfg_attr(optimised, inline(always))]
fn row<R: Real, T, const M: usize, const I: usize, const K: usize>(
    Vec3([x, y, z]): Vec3<R>,
) -> Folded<R>
where
    T: Compiled,
{
    let mut sum = Folded::ZERO;
    if Entry::<T, M, I, K, 0>::IS_NONZERO {
        sum = Folded::constant(Entry::<T, M, I, K, 0>::VALUE) * x;
    }
    if Entry::<T, M, I, K, 1>::IS_NONZERO {
        sum = sum + Folded::constant(Entry::<T, M, I, K, 1>::VALUE) * y;
    }
    if Entry::<T, M, I, K, 2>::IS_NONZERO {
        sum = sum + Folded::constant(Entry::<T, M, I, K, 2>::VALUE) * z;
    }
    sum
}

/// Row K, column L of matrix M of joint I.
struct Entry<T, const M: usize, const I: usize, const K: usize, const L: usize>(
    core::marker::PhantomData<T>,
);

impl<T, const M: usize, const I: usize, const K: usize, const L: usize> Entry<T, M, I, K, L>
where
    T: Compiled,
{
    const VALUE: f64 = entry(CompiledJoint::<T, I>::JOINT, M, K, L);
    const IS_NONZERO: bool = Self::VALUE != 0.0;
}

/// Row k, column c of a matrix of a joint.
const fn entry(joint: &Joint, matrix: usize, k: usize, c: usize) -> f64 {
    if matrix == ROT {
        let column = match c {
            0 => joint.rot.x_axis,
            1 => joint.rot.y_axis,
            _ => joint.rot.z_axis,
        };
        return match k {
            0 => column.x,
            1 => column.y,
            _ => column.z,
        };
    }
    let p = joint.pos;
    match (k, c) {
        (0, 1) => -p.z,
        (1, 0) => p.z,
        (0, 2) => p.y,
        (2, 0) => -p.y,
        (1, 2) => -p.x,
        (2, 1) => p.x,
        _ => 0.0,
    }
}
