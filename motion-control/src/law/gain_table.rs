//! Gains of state feedback over one parameter, such as a leg's length or a payload.
//!
//! Between two entries the gains are interpolated linearly: Rugh & Shamma, "Research on gain
//! scheduling" (2000), section 4.

use dynamics_core::scalar::Real;

/// The place of a parameter in a [`GainTable`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum TablePlace {
    /// The gains are those of the parameter.
    Within,
    /// The parameter is below the first entry, whose gains are taken.
    Below,
    /// The parameter is above the last entry, whose gains are taken.
    Above,
    /// The parameter is not a number: the gains are those of the first entry.
    NotANumber,
}

/// Gains of U inputs by X states at P values of a parameter with equal steps between them.
///
/// A column may be that of a constant: the input at the equilibrium.
///
/// ```
/// use motion_control::law::{GainTable, TablePlace};
/// // From 0.2 m on in steps of 0.1 m.
/// const TABLE: GainTable<f32, 1, 2, 3> =
///     GainTable::new(0.2, 0.1, [[[10.0, 1.0]], [[14.0, 2.0]], [[20.0, 4.0]]]);
/// let (gains, place) = TABLE.at(0.35);
/// assert!((gains[0][0] - 17.0).abs() < 1e-4 && place == TablePlace::Within);
/// assert_eq!(TABLE.at(0.5), ([[20.0, 4.0]], TablePlace::Above));
/// assert_eq!(TABLE.at(f32::NAN), ([[10.0, 1.0]], TablePlace::NotANumber));
/// ```
///
/// A table without a step, or with a gain that is not finite, does not compile as a constant:
///
/// ```compile_fail,E0080
/// use motion_control::law::GainTable;
/// const TABLE: GainTable<f32, 1, 1, 2> = GainTable::new(0.2, 0.1, [[[1.0]], [[f32::NAN]]]);
/// ```
#[doc(alias = "gain scheduling")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GainTable<R, const U: usize, const X: usize, const P: usize> {
    first: R,
    step: R,
    gains: [[[R; X]; U]; P],
}

impl<const U: usize, const X: usize, const P: usize> GainTable<f32, U, X, P> {
    /// A table whose first entry is that of the parameter `first`.
    ///
    /// # Panics
    /// With fewer than two entries, a step that is not positive, or a number that is not finite; in
    /// a `const` this does not compile.
    pub const fn new(first: f32, step: f32, gains: [[[f32; X]; U]; P]) -> Self {
        assert!(P >= 2, "a table of gains has fewer than two entries");
        assert!(step > 0.0 && step.is_finite() && first.is_finite(), "a table has no such step");
        let mut k = 0;
        while k < P * U * X {
            assert!(gains[k / (U * X)][k / X % U][k % X].is_finite(), "a gain is not finite");
            k += 1;
        }
        Self { first, step, gains }
    }
}

impl<R: Real, const U: usize, const X: usize, const P: usize> GainTable<R, U, X, P> {
    /// The gains at a parameter, and whether they are its own.
    ///
    /// # Cost
    /// 2 U X flops and a division, with the same instructions for all data.
    ///
    /// # Errors
    /// None: beyond the table the nearest entry counts, and the place says so.
    #[inline]
    pub fn at(&self, parameter: R) -> ([[R; X]; U], TablePlace) {
        let last = R::from_f64((P - 1) as f64);
        let x = (parameter - self.first) / self.step;
        let place = if x >= R::ZERO && x <= last {
            TablePlace::Within
        } else if x < R::ZERO {
            TablePlace::Below
        } else if x > last {
            TablePlace::Above
        } else {
            TablePlace::NotANumber
        };
        let x = x.clamped(R::ZERO, last);
        let from = (x.to_u32() as usize).min(P - 2);
        let share = x - R::from_f64(from as f64);
        let mut gains = [[R::ZERO; X]; U];
        if let Some([low, high]) = self.gains.get(from..from + 2).and_then(<[_]>::first_chunk) {
            for ((row, low), high) in gains.iter_mut().zip(low).zip(high) {
                for ((gain, &low), &high) in row.iter_mut().zip(low).zip(high) {
                    *gain = low + (high - low) * share;
                }
            }
        }
        (gains, place)
    }
}
