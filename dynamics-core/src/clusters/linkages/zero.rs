//! Angles of a linkage, measured from where its joints' coordinates are zero.

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
        assert!(
            angle.abs() <= 100.0,
            "the angle at which a joint is zero is beyond 100 rad"
        );
        let (sin, cos) = sin_cos(angle);
        Self { angle, sin, cos }
    }

    /// (cos θ, sin θ) of the angle θ = q + zero.
    #[inline(always)]
    pub(super) fn direction<R: Real>(&self, q: &JointCoordinate<R>) -> Vec2<R> {
        if self.angle == 0.0 {
            return [q.cos, q.sin];
        }
        let (s, c) = (R::from_f64(self.sin), R::from_f64(self.cos));
        [q.cos * c - q.sin * s, q.sin * c + q.cos * s]
    }

    /// q = θ − zero, within ±π, of the angle θ from the direction `from` to the direction `to`.
    #[inline(always)]
    pub(super) fn coordinate<R: Real>(&self, from: Vec2<R>, to: Vec2<R>) -> JointCoordinate<R> {
        self.of([
            from[0] * to[0] + from[1] * to[1],
            from[0] * to[1] - from[1] * to[0],
        ])
    }

    /// The same of (cos θ, sin θ).
    #[inline(always)]
    pub(super) fn of<R: Real>(&self, [cos, sin]: Vec2<R>) -> JointCoordinate<R> {
        let [cos, sin] = if self.angle == 0.0 {
            [cos, sin]
        } else {
            let (s, c) = (R::from_f64(self.sin), R::from_f64(self.cos));
            [cos * c + sin * s, sin * c - cos * s]
        };
        JointCoordinate {
            q: sin.atan2(cos),
            sin,
            cos,
        }
    }
}
