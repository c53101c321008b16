//! Parameters that bodies can have, beside an estimate that need not be: the set that is stored.
//!
//! A body of density ≥ 0 has a pseudo-inertia J = ∫ (r, 1)(r, 1)ᵀ dm = \[Σ h; hᵀ m\] ⪰ 0, Σ = ½
//! tr(Ī) 1 − Ī, and each J ≻ 0 is that of a body: Wensing, Kim & Slotine, "Linear matrix
//! inequalities for physically consistent inertial parameter identification" (2018). These J are a
//! convex cone. The segment between two points of a convex set is in it, so that bisection
//! finds how far a stored set may follow the estimate; Rucker & Wensing, "Smooth parameterization
//! of rigid-body inertia" (2022), instead estimate within the cone, which is not linear.

use core::fmt;

use super::selection::{SelectedParameters, bodies, pseudo_inertia};
use dynamics_core::scalar::Real;

#[cfg(test)]
mod tests;

/// The share of the nominal pseudo-inertias, frictions and armatures that a stored set keeps in all
/// directions.
const MARGIN: f64 = 0.05;

/// The steps of the bisection: 2⁻¹⁰ of the segment.
const STEPS: usize = 10;

/// A body or a joint whose nominal parameters none can have.
///
/// ```
/// use motion_control::estimate::{ImpossibleParameters, PhysicalParameters};
/// let point = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
/// let error = PhysicalParameters::<f64, 1, 10>::try_new(point).expect_err("a point mass has no extent");
/// assert_eq!(error, ImpossibleParameters::Body { body: 0 });
/// assert_eq!(error.to_string(), "body 0: its pseudo-inertia is not finite and positive definite");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ImpossibleParameters {
    /// The pseudo-inertia of a body is not finite and positive definite, nor zero.
    Body {
        /// The body.
        body: usize,
    },
    /// A parameter of a joint is negative or not finite.
    Joint {
        /// Its place among the parameters of the joints.
        parameter: usize,
    },
}

impl fmt::Display for ImpossibleParameters {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Body { body } => {
                write!(out, "body {body}: its pseudo-inertia is not finite and positive definite")
            }
            Self::Joint { parameter } => {
                write!(out, "parameter {parameter} of the joints is negative or not finite")
            }
        }
    }
}

impl core::error::Error for ImpossibleParameters {}

/// The N parameters of B bodies and their joints, possible at all times: what the model of the next
/// start is made of.
///
/// The first 10 B are those of the bodies, in the order of
/// [`SpatialInertia::parameters`](dynamics_core::spatial::SpatialInertia::parameters); the others,
/// frictions and armatures, are at least zero. A body whose ten nominal parameters are all zero,
/// such as the frame of a tool, stays so; a point mass is impossible.
///
/// ```
/// use dynamics_core::algorithms::inertial_parameters;
/// use motion_control::estimate::PhysicalParameters;
/// use dynamics_core::{model::Robot, robots::Ur5e};
/// let mut nominal = [0.1_f64; 66]; // and one friction a joint
/// let bodies = inertial_parameters(&Ur5e::MODEL, &());
/// nominal.iter_mut().zip(bodies.as_flattened()).for_each(|(x, phi)| *x = *phi);
/// let mut stored: PhysicalParameters<f64, 6, 66> = PhysicalParameters::try_new(nominal)?;
/// let mut without_mass = nominal;
/// without_mass[0] = -1.0;
/// let share = stored.follow(&without_mass);
/// assert!(share < 1.0 && stored.parameters()[0] > 0.0);
/// # Ok::<(), motion_control::estimate::ImpossibleParameters>(())
/// ```
#[doc(alias = "pseudo-inertia")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhysicalParameters<R, const B: usize, const N: usize> {
    pub(super) nominal: [R; N],
    pub(super) stored: [R; N],
}

impl<R: Real, const B: usize, const N: usize> PhysicalParameters<R, B, N> {
    /// The nominal parameters, which are stored first.
    ///
    /// # Errors
    /// [`ImpossibleParameters`] names the body or the parameter.
    pub fn try_new(nominal: [R; N]) -> Result<Self, ImpossibleParameters> {
        let new = Self { nominal, stored: nominal };
        let body = bodies::<R, B>(&nominal).position(|body| !is_body(body, body));
        if let Some(body) = body {
            return Err(ImpossibleParameters::Body { body });
        }
        let mut joints = nominal.iter().skip(10 * B);
        match joints.position(|x| !x.is_finite() | (*x < R::ZERO)) {
            Some(parameter) => Err(ImpossibleParameters::Joint { parameter }),
            None => Ok(new),
        }
    }

    /// The stored parameters.
    #[must_use]
    pub fn parameters(&self) -> &[R; N] {
        &self.stored
    }

    /// Moves the stored set to the nominal parameters with the smallest change that gives the
    /// estimate, as [`Self::follow`]. Outside the tick.
    ///
    /// The estimate of zero with which an estimator starts gives the nominal parameters: a set that
    /// was read from a record is kept until the
    /// [`deviations`](super::ParameterEstimator::deviations) are small again.
    pub fn update<const P: usize>(
        &mut self,
        base: &SelectedParameters<R, P, N>,
        estimate: &[R; P],
    ) -> R {
        let change = base.change(estimate);
        let mut candidate = self.nominal;
        candidate.iter_mut().zip(change).for_each(|(x, change)| *x += change);
        self.follow(&candidate)
    }

    /// Moves the stored set towards a candidate, as far as every body keeps a margin of its nominal
    /// pseudo-inertia, and returns the share: one if the candidate is stored, zero if nothing has
    /// changed. Outside the tick: some 3,000 flops a body.
    pub fn follow(&mut self, candidate: &[R; N]) -> R {
        if self.is_possible(candidate) {
            self.stored = *candidate;
            return R::ONE;
        }
        let (mut share, mut step) = (R::ZERO, R::ONE);
        let start = self.stored;
        for _ in 0..STEPS {
            step *= R::from_f64(0.5);
            let at = share + step;
            let tried = core::array::from_fn(|i| {
                let (from, to) = (crate::entry(&start, i), crate::entry(candidate, i));
                from + (to - from) * at
            });
            if self.is_possible(&tried) {
                (share, self.stored) = (at, tried);
            }
        }
        share
    }

    /// Whether each pseudo-inertia less its margin is positive definite, or zero as the nominal
    /// one, and each parameter of a joint at least its margin. A NaN is not possible.
    pub(super) fn is_possible(&self, tried: &[R; N]) -> bool {
        let margin = R::from_f64(MARGIN);
        let less: [R; N] = core::array::from_fn(|i| {
            crate::entry(tried, i) - margin * crate::entry(&self.nominal, i)
        });
        let finite = dynamics_core::state::all_finite(&less);
        let mut pairs = bodies::<R, B>(&less).zip(bodies::<R, B>(&self.nominal));
        let bodies = pairs.all(|(body, nominal)| is_body(body, nominal));
        finite && bodies && less.iter().skip(10 * B).all(|x| *x >= R::ZERO)
    }
}

/// Whether a body with this nominal one can have these parameters: one without mass and inertia
/// remains so.
fn is_body<R: Real>(body: &[R; 10], nominal: &[R; 10]) -> bool {
    if nominal.iter().all(|x| *x == R::ZERO) {
        body == nominal
    } else {
        is_positive(pseudo_inertia(body))
    }
}

/// Whether all pivots of the elimination are positive and finite, from the mass upwards.
fn is_positive<R: Real>(mut a: [[R; 4]; 4]) -> bool {
    for k in (0..4).rev() {
        let pivot = a[k];
        let positive = (pivot[k] > R::ZERO) & pivot[k].is_finite();
        if !positive {
            return false;
        }
        for row in a.iter_mut().take(k) {
            let share = row[k] / pivot[k];
            for (x, p) in row.iter_mut().zip(pivot) {
                *x -= share * p;
            }
        }
    }
    true
}
