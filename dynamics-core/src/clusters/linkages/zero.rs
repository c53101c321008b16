//! Angles of a linkage, measured from where its joints' coordinates are zero.

use core::hint::select_unpredictable;

use super::dyad::Vec2;
use crate::math::const_eval::sin_cos;
use crate::model::JointCoordinate;
use crate::scalar::Real;

/// The angle at which a joint coordinate is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Zero {
    angle: f64,
    sin: f64,
    cos: f64,
}

impl Zero {
    /// At `angle`, rad, within ±100.
    pub(super) const fn at(angle: f64) -> Self {
        assert!(angle.abs() <= 100.0, "the angle at which a joint is zero is beyond 100 rad");
        let (sin, cos) = sin_cos(angle);
        Self { angle, sin, cos }
    }

    /// (cos θ, sin θ) of the angle θ = q + zero.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn direction<R: Real>(&self, q: &JointCoordinate<R>) -> Vec2<R> {
        if self.angle == 0.0 {
            return [q.cos, q.sin];
        }
        let (s, c) = (R::from_f64(self.sin), R::from_f64(self.cos));
        [q.cos * c - q.sin * s, q.sin * c + q.cos * s]
    }

    /// q = θ − zero, within ±π, of the angle θ from the direction `from` to the direction `to`.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn coordinate<R: Real>(&self, from: Vec2<R>, to: Vec2<R>) -> JointCoordinate<R> {
        self.of([from[0] * to[0] + from[1] * to[1], from[0] * to[1] - from[1] * to[0]])
    }

    /// The same of (cos θ, sin θ).
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of<R: Real>(&self, [cos, sin]: Vec2<R>) -> JointCoordinate<R> {
        let [cos, sin] = if self.angle == 0.0 {
            [cos, sin]
        } else {
            let (s, c) = (R::from_f64(self.sin), R::from_f64(self.cos));
            [cos * c + sin * s, sin * c - cos * s]
        };
        of_unit(sin, cos)
    }
}

/// The angle within ±π of a sine and cosine.
///
/// Without a branch or a call, so that nothing of it is left where no effect reads the angle. In
/// f32 an arc tangent within 2·10⁻⁸ rad (Abramowitz & Stegun, 4.4.50); in f64 the same, the error
/// of which, δ, one step with the sine of the difference reduces to δ³/6.
#[cfg_attr(optimised, inline(always))]
pub(super) fn of_unit<R: Real>(sin: R, cos: R) -> JointCoordinate<R> {
    const ATAN: [f64; 9] = [
        1.0,
        -0.333_331_452_8,
        0.199_935_508_5,
        -0.142_088_994_4,
        0.106_562_639_3,
        -0.075_289_640_0,
        0.042_909_613_8,
        -0.016_165_736_7,
        0.002_866_225_7,
    ];
    let (s, c) = (sin.abs(), cos.abs());
    let steep = s > c;
    let (less, more) = select_unpredictable(steep, (c, s), (s, c));
    let t = less / (more + R::MIN_POSITIVE);
    let t2 = t * t;
    let terms = ATAN.iter().rev().map(|&a| R::from_f64(a));
    let rough = t * terms.fold(R::ZERO, |sum, a| sum * t2 + a);
    let [quarter, half] = [core::f64::consts::FRAC_PI_2, core::f64::consts::PI].map(R::from_f64);
    let rough = select_unpredictable(steep, quarter - rough, rough);
    let rough = select_unpredictable(cos < R::ZERO, half - rough, rough);
    let q = select_unpredictable(sin < R::ZERO, -rough, rough);
    if R::EPSILON.to_f64() > 1e-8 {
        return JointCoordinate { q, sin, cos };
    }
    let (rough_sin, rough_cos) = q.sin_cos_near();
    let q = q + (sin * rough_cos - cos * rough_sin);
    JointCoordinate { q, sin, cos }
}

#[cfg(test)]
mod tests {
    use super::of_unit;

    #[test]
    fn the_angle_of_a_sine_and_cosine_is_within_rounding() {
        let (mut double, mut single) = (0.0_f64, 0.0_f32);
        for i in -31_000..=31_000 {
            let x = f64::from(i) * 1e-4;
            double = double.max((of_unit(x.sin(), x.cos()).q - x).abs());
            let x = x as f32;
            single = single.max((of_unit(x.sin(), x.cos()).q - x).abs());
        }
        assert!(double < 7e-16 && single < 4e-7, "{double:.1e} {single:.1e}");
    }
}
