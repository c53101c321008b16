//! The limits of torque with friction.
//!
//! Viscous friction is linear in ṡ = √x, and thus no half-plane of u and x. Above it is bounded by
//! the tangent at x₀, below by the chord up to the greatest x:
//!
//! ```text
//! x/√x_max ≤ √x ≤ (x + x₀)/(2 √x₀)
//! ```

use super::coefficients::Coefficients;
use super::half_plane::{HalfPlane, both};
use super::{PathLimits, TimedPathError};
use crate::entry;
use crate::reference::JointFriction;
use dynamics_core::scalar::Real;

/// The least share of a limit of torque that gravity and friction have to leave.
const LEFT: f64 = 1e-3;
/// The bound of √x touches it at no less than this x.
const LEAST_TOUCH: f64 = 1e-12;

/// Bounds of √x in a segment: at most (x + x₀)/(2 √x₀), at least x/√x_max.
pub(super) struct SegmentFriction<R> {
    /// √x₀.
    pub(super) touch: R,
    /// 1/√x_max.
    pub(super) chord: R,
}

impl<R: Real> SegmentFriction<R> {
    /// The limits of a joint's torque, which moves with these slopes at both ends of the segment.
    pub(super) fn torques<const V: usize>(
        &self,
        at: &Coefficients<R, V>,
        limits: &PathLimits<R, V>,
        j: usize,
        slopes: [R; 2],
    ) -> [HalfPlane<R>; 2] {
        let friction = limits.friction.get(j).copied().unwrap_or(JointFriction::NONE);
        let [a, b, c] = [entry(&at.a, j), entry(&at.b, j), entry(&at.c, j)];
        let torque = entry(&limits.torque, j);
        let viscous = friction.viscous * entry(&at.slope, j).abs();
        let half = R::from_f64(0.5);
        let against = [half * viscous / self.touch, friction.coulomb + half * viscous * self.touch];
        let [up, down] = directions(slopes);
        let relief = if up ^ down { friction.certain } else { R::ZERO };
        let with = [-(relief * viscous * self.chord), -(relief * friction.coulomb)];
        let [rise, fall] = [up, down].map(|opposed| if opposed { against } else { with });
        both(a, [b + rise[0], fall[0] - b], [torque - c - rise[1], torque + c - fall[1]])
    }
}

/// Whether a joint moves upwards and downwards.
fn directions<R: Real>(slopes: [R; 2]) -> [bool; 2] {
    let any = |sign: R| slopes.iter().any(|&slope| slope * sign > R::ZERO);
    [any(R::ONE), any(-R::ONE)]
}

/// x₀, with which Coulomb friction, gravity and the bound of viscous friction leave torque.
pub(super) fn least_touch<R: Real, const V: usize>(
    [from, to]: [&Coefficients<R, V>; 2],
    limits: &PathLimits<R, V>,
    touch: R,
) -> Result<R, TimedPathError> {
    let mut least = touch;
    for at in [from, to] {
        for (joint, (friction, &torque)) in limits.friction.iter().zip(&limits.torque).enumerate() {
            let [up, down] = directions([from, to].map(|at| entry(&at.slope, joint)));
            let c = entry(&at.c, joint);
            let viscous = friction.viscous * entry(&at.slope, joint).abs();
            for (signed, opposed) in [(c, up), (-c, down)] {
                let coulomb = if opposed { friction.coulomb } else { R::ZERO };
                let left = torque - (signed + coulomb);
                let enough = left > R::from_f64(LEFT) * torque;
                if !enough {
                    return Err(TimedPathError::Torque {
                        point: at.point,
                        joint,
                        needed: (signed + coulomb).to_f64(),
                        allowed: torque.to_f64(),
                    });
                }
                if opposed {
                    let rate = left / (viscous + R::MIN_POSITIVE);
                    let square = rate * rate; // infinite without viscous friction
                    least = if square < least { square } else { least };
                }
            }
        }
    }
    let floor = R::from_f64(LEAST_TOUCH);
    Ok(if least > floor { least } else { floor })
}
