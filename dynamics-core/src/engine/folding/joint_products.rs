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
pub(crate) fn rotate_to_parent<Scalar: Real, Tree, const I: usize>(v: Vec3<Scalar>) -> Vec3<Scalar>
where
    Tree: Compiled,
{
    product::<Scalar, Tree, ROT, I>(v)
}

/// p × v, p the offset from the origin of joint I's parent to its own, without the joint's own
/// translation.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn constant_offset_cross<Scalar: Real, Tree, const I: usize>(
    v: Vec3<Scalar>,
) -> Vec3<Scalar>
where
    Tree: Compiled,
{
    product::<Scalar, Tree, CROSS, I>(v)
}

/// R M Rᵀ of joint I.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn rotate_matrix_to_parent<Scalar: Real, Tree, const I: usize>(
    m: &Mat3<Scalar>,
) -> Mat3<Scalar>
where
    Tree: Compiled,
{
    let half = columns_rotated::<Scalar, Tree, I>(*m);
    let rows = columns_rotated::<Scalar, Tree, I>(Mat3(half.rows()));
    Mat3(rows.rows())
}

#[cfg_attr(optimised, inline(always))]
fn columns_rotated<Scalar: Real, Tree, const I: usize>(
    Mat3([x, y, z]): Mat3<Scalar>,
) -> Mat3<Scalar>
where
    Tree: Compiled,
{
    Mat3([
        rotate_to_parent::<Scalar, Tree, I>(x),
        rotate_to_parent::<Scalar, Tree, I>(y),
        rotate_to_parent::<Scalar, Tree, I>(z),
    ])
}

/// R S Rᵀ of joint I.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn rotate_symmetric_to_parent<Scalar: Real, Tree, const I: usize>(
    s: Sym3<Scalar>,
) -> Sym3<Scalar>
where
    Tree: Compiled,
{
    Sym3::of(&rotate_matrix_to_parent::<Scalar, Tree, I>(&Mat3(s.columns())))
}

#[cfg_attr(optimised, inline(always))]
fn product<Scalar: Real, Tree, const M: usize, const I: usize>(v: Vec3<Scalar>) -> Vec3<Scalar>
where
    Tree: Compiled,
{
    Vec3([
        row::<Scalar, Tree, M, I, 0>(v),
        row::<Scalar, Tree, M, I, 1>(v),
        row::<Scalar, Tree, M, I, 2>(v),
    ])
}

#[cfg_attr(optimised, inline(always))]
fn row<Scalar: Real, Tree, const M: usize, const I: usize, const K: usize>(
    Vec3([x, y, z]): Vec3<Scalar>,
) -> Folded<Scalar>
where
    Tree: Compiled,
{
    let mut sum = Folded::ZERO;
    if Entry::<Tree, M, I, K, 0>::IS_NONZERO {
        sum = Folded::constant(Entry::<Tree, M, I, K, 0>::VALUE) * x;
    }
    if Entry::<Tree, M, I, K, 1>::IS_NONZERO {
        sum = sum + Folded::constant(Entry::<Tree, M, I, K, 1>::VALUE) * y;
    }
    if Entry::<Tree, M, I, K, 2>::IS_NONZERO {
        sum = sum + Folded::constant(Entry::<Tree, M, I, K, 2>::VALUE) * z;
    }
    sum
}

/// Row K, column L of matrix M of joint I.
struct Entry<Tree, const M: usize, const I: usize, const K: usize, const L: usize>(
    core::marker::PhantomData<Tree>,
);

impl<Tree, const M: usize, const I: usize, const K: usize, const L: usize> Entry<Tree, M, I, K, L>
where
    Tree: Compiled,
{
    const VALUE: f64 = entry(CompiledJoint::<Tree, I>::JOINT, M, K, L);
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
