//! Walker & Orin (1982): methods 1, 2 and 4 for the joint-space inertia matrix H, O(n²). H is M of
//! today.
//!
//! Column j of H is the torque of a unit acceleration of joint j, with all speeds and gravity zero.
//!
//! - Method 1: all torques of each column, by [`crate::luh_walker_paul`] without its velocity
//!   terms.
//! - Method 2: only what turns and only one triangle: links before j are at rest, and H is
//!   symmetric.
//! - Method 3: [`crate::composite_bodies`].
//! - Method 4: no H; H q̈ = τ by conjugate gradients, with H p as in method 1.

use core::array::from_fn;

use crate::chain::{Chain, State};
use crate::luh_walker_paul::inward;
use crate::matrix::{Mat, cross, dot, mul_vec, plus, times, transpose_mul_vec};
use crate::number::Number;

/// H p: the torques of accelerations at rest and without gravity; the joints before `first` have
/// none, and their torques are not computed.
#[inline(always)]
fn product<T: Number, const N: usize>(
    chain: &Chain<T, N>,
    a: &[Mat<T, 3>; N],
    p: &[T; N],
    first: usize,
) -> [T; N] {
    let zero = [T::ZERO; 3];
    let mut wrench = [(zero, zero); N];
    let (mut wd, mut vd) = (zero, zero);
    for (i, link) in chain.links.iter().enumerate().skip(first) {
        if i == first {
            wd = times(&a[i][2], p[i]);
            vd = cross(&wd, &link.p);
        } else {
            wd = transpose_mul_vec(&a[i], &[wd[0], wd[1], wd[2] + p[i]]);
            vd = plus(&cross(&wd, &link.p), &transpose_mul_vec(&a[i], &vd));
        }
        let com = plus(&cross(&wd, &link.s), &vd);
        wrench[i] = (times(&com, link.mass), mul_vec(&link.inertia, &wd));
    }
    inward(&chain.links, a, &wrench, first)
}

/// All A_i.
#[inline(always)]
fn rotations<T: Number, const N: usize>(
    chain: &Chain<T, N>,
    state: &State<T, N>,
) -> [Mat<T, 3>; N] {
    from_fn(|i| chain.links[i].rotation(state.cos[i], state.sin[i]))
}

/// H by method 1.
#[inline(never)]
pub fn method_1<T: Number, const N: usize>(chain: &Chain<T, N>, state: &State<T, N>) -> Mat<T, N> {
    let a = rotations(chain, state);
    let unit = |j| from_fn(|i| T::of(f64::from(u8::from(i == j))));
    from_fn(|j| product(chain, &a, &unit(j), 0))
}

/// H by method 2.
#[inline(never)]
pub fn method_2<T: Number, const N: usize>(chain: &Chain<T, N>, state: &State<T, N>) -> Mat<T, N> {
    let a = rotations(chain, state);
    let unit = |j| from_fn(|i| T::of(f64::from(u8::from(i == j))));
    let columns: Mat<T, N> = from_fn(|j| product(chain, &a, &unit(j), j));
    from_fn(|i| from_fn(|j| columns[i.min(j)][i.max(j)]))
}

/// The accelerations of torques of 1 N·m by method 4, in as many steps as there are joints.
#[inline(never)]
pub fn method_4<T: Number + PartialOrd, const N: usize>(
    chain: &Chain<T, N>,
    state: &State<T, N>,
) -> [T; N] {
    solve(chain, state, &[T::of(1.0); N], (N, T::ZERO)).0
}

/// The accelerations by method 4, and after how many steps the residual was below `tolerance` of
/// its beginning. As many steps as joints suffice without rounding errors.
#[inline(always)]
pub fn solve<T: Number + PartialOrd, const N: usize>(
    chain: &Chain<T, N>,
    state: &State<T, N>,
    tau: &[T; N],
    (most, tolerance): (usize, T),
) -> ([T; N], usize) {
    let a = rotations(chain, state);
    let mut qdd = [T::ZERO; N];
    let (mut residual, mut p) = (*tau, *tau);
    let mut size = dot(&residual, &residual);
    let enough = size * tolerance * tolerance;
    for step in 0..most {
        if size <= enough {
            return (qdd, step);
        }
        let image = product(chain, &a, &p, 0);
        let length = size / dot(&p, &image);
        qdd = plus(&qdd, &times(&p, length));
        residual = from_fn(|i| residual[i] - length * image[i]);
        let next = dot(&residual, &residual);
        p = plus(&residual, &times(&p, next / size));
        size = next;
    }
    (qdd, most)
}
