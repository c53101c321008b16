//! A configuration as the algorithms use it: angles with their sines and cosines, quaternions at
//! unit length.

use crate::scalar::{Matrix, Real, Vector};
use crate::trig::Kernel;

/// A position coordinate as the algorithms use it: q, with the sine and cosine of an angle.
///
/// ```
/// use dynamics_core::model::JointCoordinate;
/// assert_eq!(JointCoordinate::revolute(0.0_f32), JointCoordinate { q: 0.0, sin: 0.0, cos: 1.0 });
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointCoordinate<R> {
    /// Position, rad or m; of a quaternion a component of it at unit length.
    pub q: R,
    /// sin q of an angle.
    pub sin: R,
    /// cos q of an angle.
    pub cos: R,
}

impl<R: Real> JointCoordinate<R> {
    /// A rotation by q rad.
    #[cfg_attr(optimised, inline(always))]
    pub fn revolute(q: R) -> Self {
        let (sin, cos) = q.sin_cos();
        Self { q, sin, cos }
    }

    /// A rotation by q rad, its sine and cosine by the kernel K.
    #[cfg_attr(optimised, inline(always))]
    pub fn with_kernel<K: Kernel<R>>(q: R) -> Self {
        let (sin, cos) = K::sin_cos(q);
        Self { q, sin, cos }
    }

    /// A rotation by q rad, |q| ≤ 100, its sine and cosine by the kernel K.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn revolute_bounded<K: Kernel<R>>(q: R) -> Self {
        let (sin, cos) = K::sin_cos_near(q);
        Self { q, sin, cos }
    }

    /// Rotations by all of q, each with the bits of [`Self::with_kernel`], or of
    /// [`Self::revolute_bounded`] if `NEAR`.
    ///
    /// A loop of sines alone is one that compilers vectorise, as they do not where each is followed
    /// by other work.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn of_all<K: Kernel<R>, const NEAR: bool, const Q: usize>(q: &[R; Q]) -> [Self; Q] {
        // For seven and eight joints, with LLVM 22: in f32 straight-line code of four becomes
        // vectors, in f64 a loop that is too long to be unrolled. For other numbers of joints the
        // plain loop takes less time.
        match (Q, size_of::<R>()) {
            (7 | 8, 4) => return by_fours::<R, K, NEAR, 1, Q>(q),
            (7 | 8, 8) => return by_fours::<R, K, NEAR, 2, Q>(q),
            _ => {}
        }
        let mut sines = [[R::ZERO; 2]; Q];
        for (pair, &q) in sines.iter_mut().zip(q) {
            let (sin, cos) = sin_cos::<R, K, NEAR>(q);
            *pair = [sin, cos];
        }
        let mut turns = [Self::default(); Q];
        for ((turn, &q), [sin, cos]) in turns.iter_mut().zip(q).zip(sines) {
            *turn = Self { q, sin, cos };
        }
        turns
    }

    /// A coordinate that is not an angle.
    #[cfg_attr(optimised, inline(always))]
    pub fn linear(q: R) -> Self {
        Self { q, ..Self::default() }
    }

    /// Rz(q)ᵀ E for every column of E: from the frame before the turn into the one after. 18 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn about_z(self, e: &R::Mat3) -> R::Mat3 {
        let [x, y, z] = e.cols().map(|column| {
            let [x, y, z] = column.array();
            let (s, c) = (self.sin, self.cos);
            R::Vec3::new(c * x + s * y, c * y - s * x, z)
        });
        R::Mat3::from_cols(x, y, z)
    }

    /// The same about x. 18 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn about_x(self, e: &R::Mat3) -> R::Mat3 {
        let [x, y, z] = e.cols().map(|column| {
            let [x, y, z] = column.array();
            let (s, c) = (self.sin, self.cos);
            R::Vec3::new(x, c * y + s * z, c * z - s * y)
        });
        R::Mat3::from_cols(x, y, z)
    }
}

/// The rotation of coordinates into a body whose attitude is the unit quaternion (x, y, z, w).
/// RBDA (4.12). 30 flops.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn rotation<R: Real>([x, y, z, w]: [R; 4]) -> R::Mat3 {
    let (x2, y2, z2) = (x + x, y + y, z + z);
    let (xx, yy, zz) = (x * x2, y * y2, z * z2);
    let (xy, xz, yz) = (x * y2, x * z2, y * z2);
    let (wx, wy, wz) = (w * x2, w * y2, w * z2);
    let one = R::ONE;
    R::Mat3::from_cols(
        R::Vec3::new(one - (yy + zz), xy - wz, xz + wy),
        R::Vec3::new(xy + wz, one - (xx + zz), yz - wx),
        R::Vec3::new(xz - wy, yz + wx, one - (xx + yy)),
    )
}

/// A quaternion at unit length. One that has drifted, |p|² = 1 + ε with |ε| < 1/8, by one step of
/// Newton's iteration for 1/|p|: no root, no division; its length is then 1 to 3ε²/8. Any other by
/// its length; [`rotation`] interprets the quaternion zero as no rotation. 29 flops.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn near_unit<R: Real>(p: [R; 4]) -> [R; 4] {
    let [x, y, z, w] = p;
    let squared = (x * x + y * y) + (z * z + w * w);
    let near = R::from_f64(1.5) - R::from_f64(0.5) * squared;
    let drifted = (squared - R::ONE).abs() < R::from_f64(0.125);
    let scale = core::hint::select_unpredictable(drifted, near, squared.rsqrt());
    p.map(|x| x * scale)
}

/// Rotations by all of q: four angles of each of W places at a time, of which the last place may
/// overlap the one before it.
#[cfg_attr(optimised, inline(always))]
fn by_fours<R: Real, K: Kernel<R>, const NEAR: bool, const W: usize, const Q: usize>(
    q: &[R; Q],
) -> [JointCoordinate<R>; Q] {
    let (mut sines, mut cosines) = ([R::ZERO; Q], [R::ZERO; Q]);
    let mut first = 0;
    while first < Q {
        let mut places = [([R::ZERO; 4], [R::ZERO; 4], [R::ZERO; 4]); W];
        let at = |w: usize| (first + 4 * w).min(Q - 4);
        for (w, (angles, ..)) in places.iter_mut().enumerate() {
            angles.copy_from_slice(&q[at(w)..at(w) + 4]);
        }
        for i in 0..4 {
            for (angles, sin, cos) in &mut places {
                (sin[i], cos[i]) = sin_cos::<R, K, NEAR>(angles[i]);
            }
        }
        for (w, (_, sin, cos)) in places.iter().enumerate() {
            sines[at(w)..at(w) + 4].copy_from_slice(sin);
            cosines[at(w)..at(w) + 4].copy_from_slice(cos);
        }
        first += 4 * W;
    }
    let mut turns = [JointCoordinate::default(); Q];
    for (((turn, &q), sin), cos) in turns.iter_mut().zip(q).zip(sines).zip(cosines) {
        *turn = JointCoordinate { q, sin, cos };
    }
    turns
}

/// (sin q, cos q), of a joint that stays within ±100 rad if `NEAR`.
#[cfg_attr(optimised, inline(always))]
fn sin_cos<R: Real, K: Kernel<R>, const NEAR: bool>(q: R) -> (R, R) {
    if NEAR { K::sin_cos_near(q) } else { K::sin_cos(q) }
}

#[cfg(test)]
mod tests {
    use super::JointCoordinate;
    use crate::scalar::{Native, Real};
    use crate::state::JointTrig;
    use crate::{Engine, model::Robot, robots::Ur5e};

    fn bits<R: Real>(turn: JointCoordinate<R>) -> [u64; 3] {
        [turn.q, turn.sin, turn.cos].map(|x| x.to_f64().to_bits())
    }

    fn same_bits<R: Real, const N: usize>(q: [R; N]) {
        let together = JointCoordinate::of_all::<Native, false, N>(&q);
        let alone = q.map(JointCoordinate::with_kernel::<Native>);
        assert_eq!(together.map(bits), alone.map(bits));
        let together = JointCoordinate::of_all::<Native, true, N>(&q);
        let alone = q.map(JointCoordinate::revolute_bounded::<Native>);
        assert_eq!(together.map(bits), alone.map(bits));
    }

    fn in_both<const N: usize>(q: [f64; N]) {
        same_bits(q);
        same_bits(q.map(|q| q as f32));
    }

    #[test]
    fn sines_of_all_joints_together_have_the_bits_of_each_alone() {
        let [a, b, c, d, e, f, g, h] = [0.0, -0.0, 1.3, -2.9, 3.1, 99.0, -1e9, f64::MAX];
        in_both([a, b, c]);
        in_both([a, b, c, d, e, f]);
        in_both([a, b, c, d, e, f, g]);
        in_both([h, g, f, e, d, c, b, a]);
        in_both([1e9, -3e9, 1e5, 7e7, h, 0.1, -0.7, e, a, b, c, d]);
    }

    #[test]
    fn the_engine_reduces_only_angles_that_limits_allow() {
        let q = [0.0, -0.0, 1.3, -2.9, 7e7, 3e4_f32];
        let [any, near] = [
            q.map(JointCoordinate::with_kernel::<Native>),
            q.map(JointCoordinate::revolute_bounded::<Native>),
        ];
        let [any, near] = [any.map(bits), near.map(bits)];
        assert_eq!(JointTrig::new(&Ur5e::MODEL_F32, &q).coordinates.map(bits), any);
        assert_eq!(Engine::<Ur5e>::joint_trig(&q).coordinates.map(bits), near);
        assert_ne!(any, near);
    }
}
