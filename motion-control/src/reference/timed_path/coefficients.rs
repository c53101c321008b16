//! The coefficients of u and x in torques and accelerations at a point of the grid.

use super::{PathLimits, TimedPathError};
use crate::entry;
use crate::reference::GeometricPath;
use dynamics_core::scalar::Real;
use dynamics_core::state::{State, all_finite};

/// a, b and c, with q′ and q″.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coefficients<R, const V: usize> {
    pub(super) a: [R; V],
    pub(super) b: [R; V],
    pub(super) c: [R; V],
    pub(super) slope: [R; V],
    pub(super) curvature: [R; V],
    /// The greatest x within the limits of speed.
    pub(super) fastest: R,
    pub(super) point: usize,
    pub(super) s: R,
}

/// The greatest x of all, where nothing limits it.
const GREATEST: f64 = 1e12;
/// Rounding in the difference of torques at opposite velocities, in units of ε and of the greatest
/// torque.
const ROUNDING: f64 = 1e3;

impl<R: Real, const V: usize> Coefficients<R, V> {
    pub(super) fn at<P: GeometricPath<R, V>>(
        path: &P,
        (point, s): (usize, R),
        limits: &PathLimits<R, V>,
        inverse_dynamics: &impl Fn(&State<R, V, V>) -> [R; V],
    ) -> Result<Self, TimedPathError> {
        let at = path.point(s);
        let (zero, backward) = ([R::ZERO; V], at.slope.map(|slope| -slope));
        let torque = |qd, qdd| inverse_dynamics(&State { q: at.q, qd, qdd });
        let (c, static_and_u) = (torque(zero, zero), torque(zero, at.slope));
        let forth = torque(at.slope, at.curvature);
        let back = torque(backward, at.curvature);
        for (joint, &sum) in static_and_u.iter().enumerate() {
            let more = [entry(&c, joint), entry(&forth, joint), entry(&back, joint)];
            let geometry = [entry(&at.slope, joint), entry(&at.curvature, joint)];
            if !(sum.is_finite() && all_finite(&more) && all_finite(&geometry)) {
                return Err(TimedPathError::NotFinite { point, joint });
            }
        }
        let largest = c
            .iter()
            .chain(&forth)
            .chain(&back)
            .fold(R::MIN_POSITIVE, |most, tau| if tau.abs() > most { tau.abs() } else { most });
        let rounding = R::from_f64(ROUNDING) * R::EPSILON * largest;
        let mut signs = forth.iter().zip(&back);
        if let Some(joint) = signs.position(|(&forth, &back)| (forth - back).abs() > rounding) {
            return Err(TimedPathError::SignOfVelocity { point, joint });
        }
        let less_c = |sum: &[R; V]| core::array::from_fn(|j| entry(sum, j) - entry(&c, j));
        Ok(Self {
            a: less_c(&static_and_u),
            b: less_c(&forth),
            c,
            slope: at.slope,
            curvature: at.curvature,
            fastest: fastest(&at.slope, limits),
            point,
            s,
        })
    }
}

/// The least (v/q′)².
fn fastest<R: Real, const V: usize>(slope: &[R; V], limits: &PathLimits<R, V>) -> R {
    let joints = slope.iter().zip(&limits.motion);
    joints.fold(R::from_f64(GREATEST), |least, (slope, limit)| {
        let rate = limit.velocity / (slope.abs() + R::MIN_POSITIVE);
        let square = rate * rate; // infinite where the joint stands still
        if square < least { square } else { least }
    })
}
