//! Two links between two points of a plane: what four-bars and five-bars have in common.
//!
//! The intersection of two circles. Links of lengths b₁ and b₂ from the points P₁ and P₂ meet; w =
//! P₂ − P₁, b₁ e₁ − b₂ e₂ = w. With k = (w² + b₁² − b₂²) / 2 b₁ and h² = w² − k² it is e₁ = (k w +
//! h w⊥) / w². h / b₂ is the sine of the angle at which the links meet: 0 where they are in line.

use super::super::ClusterProblem;
use crate::scalar::Real;

/// A vector of the plane.
pub(super) type Vec2<R> = [R; 2];

/// a·b.
#[cfg_attr(optimised, inline(always))]
pub(super) fn dot<R: Real>(a: Vec2<R>, b: Vec2<R>) -> R {
    a[0] * b[0] + a[1] * b[1]
}

/// The h² below which rates are damped, relative to the squared lengths of which it is the
/// difference, in f64 and f32.
///
/// Rounding errors of h² are some ε, those of G some ε/h² and those of Ġ ẏ some ε/h³ of ẏ². Next to
/// change points and flat parallelograms the latter are, compared with 60 digits, at most 5·10⁻³ in
/// f64 where h² is 10⁻⁹, some 10⁻⁴ rad away, and of G 2·10⁻⁷; where h² is 10⁻¹¹ they are 1 to 5. In
/// f32 they are 0.3 and 3·10⁻³ where h² is 256 ε, 10⁻² rad away; to have 5·10⁻³ there, too, the
/// range would have to be four times as wide.
const SINGULAR: (f64, f32) = (1e-9, 256.0 * f32::EPSILON);

/// The amount by which rounding may bring h² below zero, relative to the same: 256 roundings.
const ROUNDING: (f64, f32) = (256.0 * f64::EPSILON, 256.0 * f32::EPSILON);

/// The second over the first: exactly 1 in f32, where they are one constant.
const BELOW: (f64, f32) = (ROUNDING.0 / SINGULAR.0, ROUNDING.1 / SINGULAR.1);

/// √h² on one of two branches, and its damped reciprocal.
#[derive(Clone, Copy)]
pub(super) struct Root<R> {
    pub(super) h: R,
    pub(super) h_inv: R,
    pub(super) singular: bool,
}

/// √`h2`, of the sign of `branch`, `h2` being a difference of squares of the size `scale`; nothing
/// where it is negative beyond rounding.
///
/// Below [`SINGULAR`] of `scale` the reciprocal is h over that instead of h / h²: it is continuous
/// and bounded.
#[cfg_attr(optimised, inline(always))]
pub(super) fn root<R: Real>(h2: R, scale: R, branch: Branch) -> Result<Root<R>, ClusterProblem> {
    let least = scale * R::select(SINGULAR.0, SINGULAR.1);
    let (size, size_inv, singular) = if h2 > least {
        let inv = h2.rsqrt();
        (h2 * inv, inv, false)
    } else {
        let size = near_zero(h2, least)?;
        (size, size / least, true)
    };
    let (h, h_inv) = match branch {
        Branch::Positive => (size, size_inv),
        Branch::Negative => (-size, -size_inv),
    };
    Ok(Root { h, h_inv, singular })
}

/// √h² of an h² that is not above `least`.
#[cold]
#[inline(never)]
fn near_zero<R: Real>(h2: R, least: R) -> Result<R, ClusterProblem> {
    if h2 >= -(least * R::select(BELOW.0, BELOW.1)) {
        Ok(if h2 > R::ZERO { h2.sqrt() } else { R::ZERO })
    } else if h2.is_finite() {
        Err(ClusterProblem::CannotClose)
    } else {
        Err(ClusterProblem::NotFinite)
    }
}

/// Which of the two ways to assemble a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Branch {
    /// Counterclockwise: the documentation of each linkage has its meaning.
    Positive,
    /// Clockwise.
    Negative,
}

/// The two links' directions, and what their rates follow from.
#[derive(Clone, Copy)]
pub(super) struct Dyad<R> {
    /// e₁.
    pub(super) e1: Vec2<R>,
    /// b₂ e₂, m.
    pub(super) b2_e2: Vec2<R>,
    /// h⁻¹, 1/m, damped.
    pub(super) h_inv: R,
    pub(super) singular: bool,
}

/// The lengths of a dyad, with what follows from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lengths {
    pub(super) b1: f64,
    pub(super) b2: f64,
    half_inv: f64,
    difference: f64,
    /// The scale of the rounding errors of h², m².
    scale: f64,
}

impl Lengths {
    /// b₁ and b₂ in m, and the largest of the lengths that w is the difference of.
    pub(super) const fn new(b1: f64, b2: f64, reach: f64) -> Self {
        assert!(
            b1 > 0.0 && b1.is_finite() && b2 > 0.0 && b2.is_finite(),
            "a link's length is not positive"
        );
        let longer = if b1 > b2 { b1 } else { b2 };
        Self {
            scale: longer * if longer > reach { longer } else { reach },
            b1,
            b2,
            half_inv: 0.5 / b1,
            difference: b1 * b1 - b2 * b2,
        }
    }
}

impl<R: Real> Dyad<R> {
    /// The links that close w.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn close(
        w: Vec2<R>,
        lengths: &Lengths,
        branch: Branch,
    ) -> Result<Self, ClusterProblem> {
        let [b1, half_inv, difference] =
            [lengths.b1, lengths.half_inv, lengths.difference].map(R::from_f64);
        let scale = R::from_f64(lengths.scale);
        let w2 = dot(w, w);
        let k = (w2 + difference) * half_inv;
        let Root { h, h_inv, singular } = root(w2 - k * k, scale, branch)?;
        let e1 = if singular && w2 <= scale * R::EPSILON {
            // The points coincide, and any direction closes the loop.
            [R::ONE, R::ZERO]
        } else {
            let w2_inv = R::ONE / w2;
            let (k, h) = (k * w2_inv, h * w2_inv);
            [k * w[0] - h * w[1], k * w[1] + h * w[0]]
        };
        Ok(Self { e1, b2_e2: [b1 * e1[0] - w[0], b1 * e1[1] - w[1]], h_inv, singular })
    }

    /// Both links' rates at which w changes by `wd`: b₁ ω₁ e₁⊥ − b₂ ω₂ e₂⊥ = ẇ. Their accelerations
    /// of ẅ + b₁ ω₁² e₁ − b₂ ω₂² e₂.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn rates(&self, lengths: &Lengths, wd: Vec2<R>) -> [R; 2] {
        let b1_inv = R::from_f64(1.0 / lengths.b1);
        [dot(wd, self.b2_e2) * (self.h_inv * b1_inv), dot(wd, self.e1) * self.h_inv]
    }

    /// b₁ ω₁² e₁ − b₂ ω₂² e₂.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn centripetal(&self, lengths: &Lengths, [o1, o2]: [R; 2]) -> Vec2<R> {
        let (first, second) = (o1 * o1 * R::from_f64(lengths.b1), o2 * o2);
        [0, 1].map(|i| first * self.e1[i] - second * self.b2_e2[i])
    }
}
