//! One measurement of a hard case.

use serde::Serialize;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// The error is within its bound.
    Pass,
    Fail,
    /// A naive alternative breaks the bound, as is to be shown.
    Shown,
}

/// One line of docs/hard-cases.md.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    pub case: String,
    pub number: u32,
    pub quantity: String,
    /// `f32` or `f64`.
    pub scalar: &'static str,
    /// Relative to full scale unless the quantity says otherwise; not finite if nothing came out.
    pub error: f64,
    pub bound: f64,
    /// Condition number of what is solved, where something is.
    pub condition: Option<f64>,
    pub verdict: Verdict,
    /// Whether the bound comes from measuring, and so may not lie far above.
    #[serde(skip)]
    measured: bool,
}

impl Row {
    /// An error whose bound was set by measuring: at most ten times the measured error.
    pub fn measured(
        quantity: impl Into<String>,
        scalar: &'static str,
        error: f64,
        bound: f64,
    ) -> Self {
        let verdict = if error <= bound { Verdict::Pass } else { Verdict::Fail };
        Self {
            case: String::new(),
            number: 0,
            quantity: quantity.into(),
            scalar,
            error,
            bound,
            condition: None,
            verdict,
            measured: true,
        }
    }

    /// An error whose bound was stated beforehand, by theory or demand.
    pub fn stated(
        quantity: impl Into<String>,
        scalar: &'static str,
        error: f64,
        bound: f64,
    ) -> Self {
        Self { measured: false, ..Self::measured(quantity, scalar, error, bound) }
    }

    /// A claim that holds or does not: no error, or one of 1.
    pub fn claim(quantity: impl Into<String>, scalar: &'static str, holds: bool) -> Self {
        Self::stated(quantity, scalar, if holds { 0.0 } else { 1.0 }, 0.0)
    }

    /// A naive alternative, which has to break the bound.
    pub fn naive(
        quantity: impl Into<String>,
        scalar: &'static str,
        error: f64,
        bound: f64,
    ) -> Self {
        let row = Self::stated(quantity, scalar, error, bound);
        let verdict = match row.verdict {
            Verdict::Pass => Verdict::Fail,
            _ => Verdict::Shown,
        };
        Self { verdict, ..row }
    }

    /// The same row, with the condition number of what was solved.
    #[must_use]
    pub fn of_condition(self, condition: f64) -> Self {
        Self { condition: Some(condition), ..self }
    }

    /// Whether the row is as it has to be.
    ///
    /// # Errors
    /// It fails, a naive alternative does not, or a measured bound lies more than ten times too
    /// high.
    pub fn demand(&self) -> Result<(), String> {
        let Self { quantity, scalar, error, bound, .. } = self;
        let place = format!("{quantity} in {scalar}: error {error:.2e}, bound {bound:.2e}");
        if self.verdict == Verdict::Fail {
            return Err(format!("{place}: fails"));
        }
        if self.verdict == Verdict::Pass && self.measured && error * 10.0 < *bound {
            return Err(format!("{place}: slack by more than ten times, lower it"));
        }
        Ok(())
    }
}
