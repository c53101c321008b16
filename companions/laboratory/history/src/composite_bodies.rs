//! Walker & Orin (1982), method 3: the joint-space inertia matrix H by composite rigid bodies,
//! O(n²). H is M of today.
//!
//! Links j to n move as one rigid body, of mass M_j, centre c_j and inertia E_j about it, when
//! joint j alone turns:
//!
//! ```text
//! c_j = A_j [p*_j + (m_j s_j + M_{j+1} c_{j+1}) / M_j]
//! E_j = A_j {J_j + m_j [s_j − c]² + E_{j+1} + M_{j+1} [c_{j+1} − c]²} A_jᵀ,   [r]² = r·r 1 − r rᵀ
//! F_j = z × M_j c_j,   N_j = E_j z,   f_j = F_j,   n_j = N_j + c_j × F_j
//! f_i = A_i f_{i+1},   n_i = A_i (n_{i+1} + p*_i × f_{i+1}),   H_ij = n_i · z   for i < j
//! ```
//!
//! c, the centre in frame j, is what the bracket of c_j divides by M_j. Everything with the index j
//! is in frame j − 1, whose z is the axis of joint j. Rotations are two planar ones; E is
//! symmetric, and half of it is computed.

use crate::chain::{Chain, Link, State};
use crate::matrix::{Mat, cross, plus, times};
use crate::number::Number;

/// xx, xy, xz, yy, yz, zz.
type Symmetric<T> = [T; 6];

/// H.
#[inline(never)]
pub fn method_3<T: Number, const N: usize>(chain: &Chain<T, N>, state: &State<T, N>) -> Mat<T, N> {
    let mut h = [[T::ZERO; N]; N];
    let mut composite = ([T::ZERO; 3], [T::ZERO; 6]);
    for j in (0..N).rev() {
        let link = &chain.links[j];
        let behind = chain.links.get(j + 1).map(|behind| behind.mass_from_here);
        composite = composite_of(link, behind, &composite, state.cos[j], state.sin[j]);
        let (c, e) = &composite;
        let mass = link.mass_from_here;
        let [x, y] = [-(mass * c[1]), mass * c[0]];
        let arm = [-(c[2] * y), c[2] * x, c[0] * y - c[1] * x];
        let (mut f, mut n) = ([x, y, T::ZERO], plus(&[e[2], e[4], e[5]], &arm));
        h[j][j] = n[2];
        for (i, link) in chain.links.iter().enumerate().take(j).rev() {
            let lever = plus(&n, &cross(&link.p, &f));
            n = link.turn(state.cos[i], state.sin[i], &lever);
            f = link.turn(state.cos[i], state.sin[i], &f);
            (h[i][j], h[j][i]) = (n[2], n[2]);
        }
    }
    h
}

/// c_j and E_j of a link and of what is behind it, of this mass, with its centre and inertia in
/// frame j.
#[inline(always)]
fn composite_of<T: Number>(
    link: &Link<T>,
    behind: Option<T>,
    (c, e): &([T; 3], Symmetric<T>),
    cos: T,
    sin: T,
) -> ([T; 3], Symmetric<T>) {
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = link.inertia;
    let own = [xx, xy, xz, yy, yz, zz];
    let (centre, inertia) = match behind {
        None => (link.s, own),
        Some(mass) => {
            let moment = plus(&link.first_moment, &times(c, mass));
            let centre = times(&moment, link.one_by_mass_from_here);
            let own = plus(&own, &shift(&link.s, &centre, link.mass));
            let behind = plus(e, &shift(c, &centre, mass));
            (centre, plus(&own, &behind))
        }
    };
    let centre = link.turn(cos, sin, &plus(&link.p, &centre));
    (centre, turned(link, cos, sin, &inertia))
}

/// m [a − b]²: 9 products, 6 sums.
#[inline(always)]
fn shift<T: Number>(a: &[T; 3], b: &[T; 3], mass: T) -> Symmetric<T> {
    let [x, y, z] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let [mx, my, mz] = times(&[x, y, z], mass);
    let (xx, yy, zz) = (mx * x, my * y, mz * z);
    [yy + zz, -(mx * y), -(mx * z), xx + zz, -(my * z), xx + yy]
}

/// A E Aᵀ: 40 products, 20 sums.
#[inline(always)]
fn turned<T: Number>(link: &Link<T>, cos: T, sin: T, e: &Symmetric<T>) -> Symmetric<T> {
    let [xx, xy, xz, yy, yz, zz] = *e;
    // E Aᵀ.
    let b = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]].map(|row| link.turn(cos, sin, &row));
    let (ca, sa) = (link.cos_alpha, link.sin_alpha);
    let first = link.turn(cos, sin, &[b[0][0], b[1][0], b[2][0]]);
    let y = ca * b[1][1] - sa * b[2][1];
    [
        first[0],
        first[1],
        first[2],
        sin * b[0][1] + cos * y,
        sa * b[1][1] + ca * b[2][1],
        sa * b[1][2] + ca * b[2][2],
    ]
}
