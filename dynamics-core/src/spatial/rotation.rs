//! Exponentials and logarithms of rotations and rigid motions: steps on configuration manifolds.
//!
//! A unit quaternion (x, y, z, w) takes coordinates of the body to those of the parent side.
//! Murray, Li & Sastry, *A Mathematical Introduction to Robotic Manipulation* (1994), sections 2.2
//! and 2.3 and appendix A. Quaternions are arrays, not glam's type: that one is SIMD on x86 and
//! would round otherwise there than on the target.

use crate::scalar::{Real, Vector};

/// a ⊗ b. 28 flops.
pub(crate) fn product<R: Real>(a: [R; 4], b: [R; 4]) -> [R; 4] {
    let ([ax, ay, az, aw], [bx, by, bz, bw]) = (a, b);
    [
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    ]
}

/// The inverse of a unit quaternion.
pub(crate) fn conjugate<R: Real>([x, y, z, w]: [R; 4]) -> [R; 4] {
    [-x, -y, -z, w]
}

/// |p|².
pub(crate) fn squared<R: Real>([x, y, z, w]: [R; 4]) -> R {
    (x * x + y * y) + (z * z + w * w)
}

/// v rotated by p: p ⊗ v ⊗ p⁻¹, as v + 2 w (u × v) + 2 u × (u × v).
pub(crate) fn rotate<R: Real>([x, y, z, w]: [R; 4], v: R::Vec3) -> R::Vec3 {
    let u = R::Vec3::new(x, y, z);
    let t = u.cross(v) * R::from_f64(2.0);
    v + t * w + u.cross(t)
}

/// The attitude p after a rotation by the vector φ in its own frame: p ⊗ (φ sin(θ/2)/θ, cos(θ/2)),
/// θ = |φ|.
///
/// It is computed as p plus an increment, so that the rounding error is that of one sum; the error
/// of p's length, (1 −
/// |p|²)/2 of it, is corrected in each step. After ten million steps in f32, products alone give a length of 0.78 and
/// an attitude error of 0.04 rad.
pub(crate) fn so3_plus<R: Real>(p: [R; 4], phi: R::Vec3) -> [R; 4] {
    let (one, half) = (R::ONE, phi.dot(phi).sqrt() * R::from_f64(0.5));
    let (sin, cos) = half.sin_cos();
    let short = (one - squared(p)) * R::from_f64(0.5);
    let [x, y, z] = (phi * (sinc(half, sin) * R::from_f64(0.5) * (one + short))).array();
    // cos − 1 without cancellation.
    let less = if cos > R::ZERO { -(sin * sin / (one + cos)) } else { cos - one };
    let mut out = product(p, [x, y, z, less + cos * short]);
    out.iter_mut().zip(p).for_each(|(out, p)| *out += p);
    out
}

/// The rotation vector of a unit quaternion, its length at most π.
pub(crate) fn log<R: Real>(p: [R; 4]) -> R::Vec3 {
    // p and −p are the same attitude; the one with w ≥ 0 is the shorter rotation.
    let [x, y, z, w] = if p[3] < R::ZERO { p.map(|x| -x) } else { p };
    let u = R::Vec3::new(x, y, z);
    let sin = u.dot(u).sqrt();
    let half = sin.atan2(w);
    let two = R::from_f64(2.0);
    if sin > R::ZERO { u * (two * (half / sin)) } else { u * two }
}

/// The translation of exp(φ, ρ) in SE(3), in the body's frame at the start.
pub(crate) fn se3_exp_translation<R: Real>(phi: R::Vec3, rho: R::Vec3) -> R::Vec3 {
    let squared = phi.dot(phi);
    let theta = squared.sqrt();
    let half = theta * R::from_f64(0.5);
    let sinc = sinc(half, half.sin_cos().0);
    // (1 − cos θ)/θ² and (θ − sin θ)/θ³.
    let a = R::from_f64(0.5) * sinc * sinc;
    let b = if squared < R::from_f64(0.25) {
        let terms = [
            1.0 / 6.0,
            -1.0 / 120.0,
            1.0 / 5040.0,
            -1.0 / 362_880.0,
            1.0 / 39_916_800.0,
            -1.0 / 6_227_020_800.0,
        ];
        series(squared, terms)
    } else {
        (theta - theta.sin_cos().0) / (squared * theta)
    };
    let across = phi.cross(rho);
    rho + across * a + phi.cross(across) * b
}

/// log in SE(3): the (φ, ρ) of the rigid motion with this rotation and translation.
pub(crate) fn se3_log<R: Real>(turn: [R; 4], place: R::Vec3) -> (R::Vec3, R::Vec3) {
    let phi = log::<R>(turn);
    let squared = phi.dot(phi);
    // (1 − (θ/2) cot(θ/2))/θ².
    let c = if squared < R::from_f64(0.25) {
        let terms = [
            1.0 / 12.0,
            1.0 / 720.0,
            1.0 / 30_240.0,
            1.0 / 1_209_600.0,
            1.0 / 47_900_160.0,
            691.0 / 1_307_674_368_000.0,
        ];
        series(squared, terms)
    } else {
        let half = squared.sqrt() * R::from_f64(0.5);
        let (sin, cos) = half.sin_cos();
        (R::ONE - half * (cos / sin)) / squared
    };
    let across = phi.cross(place);
    (phi, place - across * R::from_f64(0.5) + phi.cross(across) * c)
}

/// sin x / x from x and sin x.
fn sinc<R: Real>(x: R, sin: R) -> R {
    if x > R::ZERO { sin / x } else { R::ONE }
}

/// t₀ + t₁ x + t₂ x² + …
fn series<R: Real, const N: usize>(x: R, terms: [f64; N]) -> R {
    let terms = terms.into_iter().rev().map(R::from_f64);
    terms.fold(R::ZERO, |sum, term| sum * x + term)
}
