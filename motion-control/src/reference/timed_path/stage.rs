//! The linear program of a segment: limits of u and x at both of its ends.
//!
//! Every limit is a half-plane α u + β x ≤ γ with γ ≥ 0. Fourier and Motzkin's elimination of u:
//! each pair of α_p ≥ 0 and α_q < 0 gives (β_p |α_q| + β_q α_p) x ≤ γ_p |α_q| + γ_q α_p, and the
//! least bound of all pairs is the greatest x. No sum on the right cancels, and where an α vanishes
//! its half-plane becomes a bound of x alone: points of zero inertia are no special case.

use super::coefficients::Coefficients;
use super::friction::{SegmentFriction, least_touch};
use super::half_plane::{HalfPlane, both};
use super::{PathLimits, TimedPathError};
use crate::entry;
use dynamics_core::scalar::Real;

/// The limits within a segment, with u and with x at its begin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stage<R, const V: usize> {
    /// Torques at the begin and at the end, and accelerations there; upper and lower limits of each
    /// joint.
    joints: [[[HalfPlane<R>; 2]; V]; 4],
    /// 0 ≤ x + 2 Δ u ≤ the greatest x at the end.
    next: [HalfPlane<R>; 2],
    /// The greatest x within the limits of speed.
    fastest: R,
    /// 2 Δ.
    across: R,
}

impl<R: Real, const V: usize> Stage<R, V> {
    /// The limits between two points of the grid, where x at the second one may be up to `next`;
    /// the bound of viscous friction is tight at `touch`, if this leaves half of the torque.
    pub(super) fn new(
        [from, to]: [&Coefficients<R, V>; 2],
        limits: &PathLimits<R, V>,
        next: R,
        touch: R,
    ) -> Result<Self, TimedPathError> {
        let step = to.s - from.s;
        let across = step + step;
        let mut fastest = from.fastest;
        fastest = if to.fastest > fastest { to.fastest } else { fastest };
        let friction = SegmentFriction {
            touch: least_touch([from, to], limits, touch)?.sqrt(),
            chord: R::ONE / fastest.sqrt(),
        };
        let torques = |at: &Coefficients<R, V>| {
            core::array::from_fn(|j| {
                let slopes = [from, to].map(|at| entry(&at.slope, j));
                friction.torques(at, limits, j, slopes)
            })
        };
        let accelerations = |at: &Coefficients<R, V>| {
            core::array::from_fn(|j| {
                let [alpha, beta] = [entry(&at.slope, j), entry(&at.curvature, j)];
                let limit = limits.motion.get(j).map_or(R::ZERO, |limit| limit.acceleration);
                both(alpha, [beta, -beta], [limit, limit])
            })
        };
        let at_end = |limits: [[HalfPlane<R>; 2]; V]| {
            limits.map(|pair| pair.map(|limit| limit.at_end(across)))
        };
        Ok(Self {
            joints: [
                torques(from),
                at_end(torques(to)),
                accelerations(from),
                at_end(accelerations(to)),
            ],
            next: both(across, [R::ONE, -R::ONE], [next, R::ZERO]),
            fastest: from.fastest,
            across,
        })
    }

    /// 2 Δ.
    pub(super) fn across(&self) -> R {
        self.across
    }

    fn limits(&self) -> impl Iterator<Item = &HalfPlane<R>> {
        let joints = self.joints.as_flattened().as_flattened();
        joints.iter().chain(&self.next)
    }

    /// The greatest x from which some u is within all limits.
    pub(super) fn largest_x(&self) -> R {
        let mut least = self.fastest;
        for p in self.limits().filter(|p| p.alpha >= R::ZERO) {
            for q in self.limits().filter(|q| q.alpha < R::ZERO) {
                let beta = q.beta * p.alpha - p.beta * q.alpha;
                let gamma = q.gamma * p.alpha - p.gamma * q.alpha;
                // gamma/beta < least, without a division where it is not the least.
                if (beta > R::ZERO) & (gamma < least * beta) {
                    least = gamma / beta;
                }
            }
        }
        least
    }

    /// The greatest u at this x.
    pub(super) fn largest_u(&self, x: R) -> R {
        let unlimited = R::ONE / R::ZERO;
        let (mut upper, mut lower) = (unlimited, -unlimited);
        for limit in self.limits() {
            let left = limit.gamma - limit.beta * x;
            if limit.alpha > R::ZERO && left < upper * limit.alpha {
                upper = left / limit.alpha;
            } else if limit.alpha < R::ZERO && left < lower * limit.alpha {
                lower = left / limit.alpha;
            }
        }
        // By rounding alone the upper one may be below.
        if upper < lower { R::from_f64(0.5) * (upper + lower) } else { upper }
    }
}
