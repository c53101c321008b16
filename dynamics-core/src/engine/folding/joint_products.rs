//! Products with a joint's constants, selected before LLVM: only terms that are not zero are generated. LLVM would
//! remove the others as well, but in ten times the time.

use crate::engine::compile::CompiledRobot;
use crate::engine::folding::Folded;
use crate::engine::folding::{Mat3, Sym3, Vec3};
use crate::model::Robot;
use crate::scalar::Real;

/// The rotation of a joint's frame.
const ROT: usize = 0;
/// \[p\]×.
const CROSS: usize = 1;

/// R v of joint I.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn rotate_to_parent<
    R: Real,
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const I: usize,
>(
    v: Vec3<R>,
) -> Vec3<R>
where
    T: Robot<B, Q, V>,
{
    product::<R, T, B, Q, V, ROT, I>(v)
}

/// p × v, p the offset from the origin of joint I's parent to its own.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn offset_cross<
    R: Real,
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const I: usize,
>(
    v: Vec3<R>,
    slide: Folded<R>,
) -> Vec3<R>
where
    T: Robot<B, Q, V>,
{
    let mut sum = product::<R, T, B, Q, V, CROSS, I>(v);
    if const { CompiledRobot::<T, B, Q, V>::joint(I).prismatic } {
        let axis = Vec3::constant(const { CompiledRobot::<T, B, Q, V>::joint(I).rot.z_axis });
        sum = sum + axis.scale(slide).cross(v);
    }
    sum
}

/// p × each column.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn cross_offset<
    R: Real,
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const I: usize,
>(
    Mat3([x, y, z]): Mat3<R>,
    slide: Folded<R>,
) -> Mat3<R>
where
    T: Robot<B, Q, V>,
{
    Mat3([
        offset_cross::<R, T, B, Q, V, I>(x, slide),
        offset_cross::<R, T, B, Q, V, I>(y, slide),
        offset_cross::<R, T, B, Q, V, I>(z, slide),
    ])
}

/// R M Rᵀ of joint I.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn rotate_matrix_to_parent<
    R: Real,
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const I: usize,
>(
    m: &Mat3<R>,
) -> Mat3<R>
where
    T: Robot<B, Q, V>,
{
    let half = columns_rotated::<R, T, B, Q, V, I>(*m);
    let rows = columns_rotated::<R, T, B, Q, V, I>(Mat3(half.rows()));
    Mat3(rows.rows())
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn columns_rotated<R: Real, T, const B: usize, const Q: usize, const V: usize, const I: usize>(
    Mat3([x, y, z]): Mat3<R>,
) -> Mat3<R>
where
    T: Robot<B, Q, V>,
{
    Mat3([
        rotate_to_parent::<R, T, B, Q, V, I>(x),
        rotate_to_parent::<R, T, B, Q, V, I>(y),
        rotate_to_parent::<R, T, B, Q, V, I>(z),
    ])
}

/// R S Rᵀ of joint I.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn rotate_symmetric_to_parent<
    R: Real,
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const I: usize,
>(
    s: Sym3<R>,
) -> Sym3<R>
where
    T: Robot<B, Q, V>,
{
    Sym3::of(&rotate_matrix_to_parent::<R, T, B, Q, V, I>(&Mat3(
        s.columns(),
    )))
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn product<
    R: Real,
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const M: usize,
    const I: usize,
>(
    v: Vec3<R>,
) -> Vec3<R>
where
    T: Robot<B, Q, V>,
{
    Vec3([
        row::<R, T, B, Q, V, M, I, 0>(v),
        row::<R, T, B, Q, V, M, I, 1>(v),
        row::<R, T, B, Q, V, M, I, 2>(v),
    ])
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn row<
    R: Real,
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const M: usize,
    const I: usize,
    const K: usize,
>(
    Vec3([x, y, z]): Vec3<R>,
) -> Folded<R>
where
    T: Robot<B, Q, V>,
{
    let mut sum = Folded::ZERO;
    if const { entry::<T, B, Q, V>(M, I, K, 0) != 0.0 } {
        sum = Folded::constant(const { entry::<T, B, Q, V>(M, I, K, 0) }) * x;
    }
    if const { entry::<T, B, Q, V>(M, I, K, 1) != 0.0 } {
        sum = sum + Folded::constant(const { entry::<T, B, Q, V>(M, I, K, 1) }) * y;
    }
    if const { entry::<T, B, Q, V>(M, I, K, 2) != 0.0 } {
        sum = sum + Folded::constant(const { entry::<T, B, Q, V>(M, I, K, 2) }) * z;
    }
    sum
}

/// Row k, column c of the matrix.
const fn entry<T, const B: usize, const Q: usize, const V: usize>(
    matrix: usize,
    i: usize,
    k: usize,
    c: usize,
) -> f64
where
    T: Robot<B, Q, V>,
{
    let joint = &CompiledRobot::<T, B, Q, V>::joint(i);
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
