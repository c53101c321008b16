//! Whether a distribution of mass can have an inertia about its centre of mass.
//!
//! The principal moments a ≤ b ≤ c are not negative and obey the triangle inequality c ≤ a + b: the
//! second moments Σ = ½ tr(I) 1 − I are then not negative either (Wensing, Kim and Slotine 2018).

use core::fmt;

use super::Problem;
use crate::spatial::symmetric::{Eigen, eigen};

/// An inertia about the centre of mass that no distribution of mass has.
///
/// ```
/// use dynamics_core::model::ImpossibleInertia;
/// assert_eq!(ImpossibleInertia::of([0.02, 0.0, 0.0, 0.02, 0.0, 0.04], 1e-3), None); // a disc
/// let found = ImpossibleInertia::of([0.02, 0.0, 0.0, 0.02, 0.0, 0.05], 1e-3).expect("no body has it");
/// assert_eq!(
///     found.to_string(),
///     "the moment of inertia about (0.00, 0.00, 1.00) exceeds the sum of the two others by 20.0 % of the largest: no \
///      body has it"
/// );
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct ImpossibleInertia {
    /// The principal axis of the moment that is negative, or else of the largest one.
    pub axis: [f64; 3],
    /// The moment of inertia about it, kg·m².
    pub moment: f64,
    /// By how much the largest moment exceeds the sum of the others, or the least one is below
    /// zero, relative to the largest.
    pub excess: f64,
}

impl ImpossibleInertia {
    /// The defect of xx, xy, xz, yy, yz, zz, kg·m², if it exceeds the bound by more than `relative`
    /// of the largest moment.
    pub const fn of([xx, xy, xz, yy, yz, zz]: [f64; 6], relative: f64) -> Option<Self> {
        Self::beyond::<true>([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], relative, 0.0)
    }

    /// The nearest inertia that a body may have, in the Frobenius norm: that of the second moments
    /// without their negative eigenvalues.
    ///
    /// ```
    /// use dynamics_core::model::ImpossibleInertia;
    /// let [xx, .., yy, _, zz] = ImpossibleInertia::nearest([1.0, 0.0, 0.0, 1.0, 0.0, 2.5]);
    /// assert_eq!([xx, yy, zz], [1.25, 1.25, 2.5]);
    /// ```
    pub fn nearest([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> [f64; 6] {
        let Eigen { values, vectors } = eigen::<true>([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
        let half = 0.5 * (xx + yy + zz);
        let second = values.map(|moment| if moment < half { half - moment } else { 0.0 });
        let sum: f64 = second.iter().sum();
        let entry = |i: usize, j: usize| {
            let each = second.iter().zip(&vectors);
            let of = |axis: &[f64; 3], i: usize| axis.get(i).copied().unwrap_or_default();
            let product: f64 = each.map(|(x, axis)| x * of(axis, i) * of(axis, j)).sum();
            if i == j { sum - product } else { -product }
        };
        [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].map(|(i, j)| entry(i, j))
    }

    /// As [`ImpossibleInertia::of`], but nothing for what does not exceed `noise`, kg·m²: a point
    /// mass has no moments but that. Without AXIS the axis is not computed, which is code that a
    /// firmware with checks alone does not have.
    pub(crate) const fn beyond<const AXIS: bool>(
        about_com: [[f64; 3]; 3],
        relative: f64,
        noise: f64,
    ) -> Option<Self> {
        let Eigen { values, vectors } = eigen::<AXIS>(about_com);
        let (mut least, mut most, mut i) = (0, 0, 1);
        while i < 3 {
            if values[i] < values[least] {
                least = i;
            }
            if values[i] > values[most] {
                most = i;
            }
            i += 1;
        }
        let (below, above) = (-values[least], values[most]);
        let scale = above.abs().max(below.abs());
        let sum = values[0] + values[1] + values[2];
        let triangle = 2.0 * above - sum;
        let amount = if below > triangle { below } else { triangle };
        // Written so that a NaN is impossible.
        if amount <= noise || amount <= relative * scale {
            return None;
        }
        let at = if below > relative * scale { least } else { most };
        Some(Self { axis: vectors[at], moment: values[at], excess: amount / scale })
    }

    /// The same as the problem of a body.
    pub(crate) const fn problem(&self) -> Problem {
        if self.moment < 0.0 {
            Problem::NegativeMoment(self.moment)
        } else {
            Problem::Triangle(self.excess)
        }
    }
}

impl fmt::Display for ImpossibleInertia {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        // The direction of the axis with more positive components, and without −0.
        let sign = if self.axis.iter().sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
        let [x, y, z] = self.axis.map(|x| if x.abs() < 5e-3 { 0.0 } else { sign * x });
        write!(out, "the moment of inertia about ({x:.2}, {y:.2}, {z:.2}) ")?;
        if self.moment < 0.0 {
            let moment = self.moment;
            write!(out, "is {moment:.3e} kg·m², and none is negative: no body has it")
        } else {
            let percent = 100.0 * self.excess;
            write!(
                out,
                "exceeds the sum of the two others by {percent:.1} % of the largest: no body has it"
            )
        }
    }
}
