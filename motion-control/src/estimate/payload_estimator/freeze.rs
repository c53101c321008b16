//! An estimate of a load that is frozen, and the one that may replace it.

use super::factors::{Factors, dot};
use super::{FREEZES, PARAMETERS, PayloadEstimator, RATE, RejectedMeasurement, THAWS};
use crate::entry;
use dynamics_core::scalar::Real;

/// The ticks after which another estimate may replace a frozen one: 16 time constants of its mean square.
const OTHER: u32 = 1024;
/// The ticks from which on its mean square counts.
const FIRST: u32 = 256;

/// A freeze.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Freeze<R> {
    /// The frozen parameters.
    parameters: [R; PARAMETERS],
    /// The mean square of the innovations of the estimate that began with the freeze, and its ticks.
    level: R,
    ticks: u32,
}

impl<R: Real, const V: usize> PayloadEstimator<R, V> {
    /// Freezes the estimate, and begins another one in the second set of factors.
    #[cold]
    pub(super) fn freeze(&mut self) {
        let factors = self.factors();
        let parameters = factors.solve(factors.rows.map(|[.., d]| d));
        self.begin(parameters);
    }

    /// Begins another estimate beside these frozen parameters.
    fn begin(&mut self, parameters: [R; PARAMETERS]) {
        *self.other() = Factors::of(self.start);
        self.freeze = Some(Freeze {
            parameters,
            level: self.most,
            ticks: 0,
        });
    }

    #[inline(always)]
    fn other(&mut self) -> &mut Factors<R> {
        let [first, second] = &mut self.factors;
        if self.second { first } else { second }
    }

    /// Whether no parameter of the other estimate is beyond the limit of its deviation before the first tick.
    fn other_is_expected(&mut self) -> bool {
        let (most, start) = (self.most, self.start);
        let other = self.other();
        let parameters = other.solve(other.rows.map(|[.., d]| d));
        parameters
            .iter()
            .zip(start)
            .all(|(x, start)| *x * *x * start <= most)
    }

    /// A tick of a frozen estimate.
    #[cold]
    #[inline(never)]
    pub(super) fn frozen_tick<const N: usize>(
        &mut self,
        columns: &mut [[R; N]; PARAMETERS + 1],
    ) -> Result<(), RejectedMeasurement> {
        let (most, rate) = (self.most, R::from_f64(RATE));
        let bounded = |square: R| if square <= most { square } else { most };
        let thaws = most * R::from_f64(THAWS);
        let Some(mut freeze) = self.freeze else {
            return Ok(());
        };
        let [y @ .., z] = &*columns;
        let mut error = *z;
        for (y, parameter) in y.iter().zip(&freeze.parameters) {
            error = core::array::from_fn(|i| entry(&error, i) - entry(y, i) * *parameter);
        }
        let share = R::from_f64(const { 1.0 / (if N == 0 { 1 } else { N }) as f64 });
        self.level += (bounded(dot(&error, &error) * share) - self.level) * rate;

        let forgetting = self.forgetting;
        let other = self.other();
        let before = *other;
        let innovation = other.transform(&before, forgetting, columns);
        freeze.level += (bounded(innovation) - freeze.level) * rate;
        freeze.ticks = freeze.ticks.saturating_add(1);
        self.freeze = Some(freeze);
        if self.level <= thaws {
            self.freeze = None;
        } else if (freeze.ticks >= OTHER) & (freeze.level <= thaws) && self.other_is_expected() {
            (self.second, self.level, self.freeze) = (!self.second, freeze.level, None);
        } else if (freeze.ticks >= FIRST) & (freeze.level > most * R::from_f64(FREEZES)) {
            // It has ticks of a fault.
            self.begin(freeze.parameters);
        }
        Err(RejectedMeasurement::Frozen)
    }
}
