//! Measurements during whole periods of an excitation.

use crate::IdentificationError;

/// Positions and torques of V joints at equal intervals, of whole periods of a motion that repeats.
///
/// The first period after the start does not belong to it: until transients have decayed the motion
/// does not repeat.
///
/// ```
/// use identification::{IdentificationError, Recording};
/// let recording = Recording::try_new(vec![[0.1]; 12], vec![[2.0]; 12], 6, 0.5)?;
/// assert_eq!((recording.periods(), recording.period()), (2, 3.0));
/// let error = Recording::try_new(vec![[0.1]; 13], vec![[2.0]; 13], 6, 0.5).expect_err("one too many");
/// assert_eq!(error, IdentificationError::NotWholePeriods { samples: 13, each: 6 });
/// # Ok::<(), IdentificationError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Recording<const V: usize> {
    /// The positions of the mean period.
    pub(crate) positions: Vec<[f64; V]>,
    pub(crate) torques: Vec<[f64; V]>,
    interval: f64,
    periods: usize,
}

impl<const V: usize> Recording<V> {
    /// Positions, rad or m, and torques, N·m or N, with this many samples in `each` period, and
    /// this interval between them, s.
    ///
    /// # Errors
    /// [`IdentificationError`] if there are not as many positions as torques, if they are not of
    /// whole periods, or if a number is not finite.
    pub fn try_new(
        positions: Vec<[f64; V]>,
        torques: Vec<[f64; V]>,
        each: usize,
        interval: f64,
    ) -> Result<Self, IdentificationError> {
        let samples = positions.len();
        if samples != torques.len() {
            let torques = torques.len();
            return Err(IdentificationError::Lengths { samples, torques });
        }
        if each == 0 || samples == 0 || !samples.is_multiple_of(each) {
            return Err(IdentificationError::NotWholePeriods { samples, each });
        }
        if !(interval > 0.0 && interval.is_finite()) {
            return Err(IdentificationError::Interval);
        }
        for (sample, (q, tau)) in positions.iter().zip(&torques).enumerate() {
            let finite = |(q, tau): (&f64, &f64)| q.is_finite() && tau.is_finite();
            if let Some(joint) = q.iter().zip(tau).position(|pair| !finite(pair)) {
                return Err(IdentificationError::NotFinite { sample, joint });
            }
        }
        Ok(Self {
            positions: mean(&positions, each),
            torques: mean(&torques, each),
            interval,
            periods: samples / each,
        })
    }

    /// The number of periods.
    #[must_use]
    pub fn periods(&self) -> usize {
        self.periods
    }

    /// The duration of a period, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.interval * self.positions.len() as f64
    }

    pub(crate) fn time(&self, sample: usize) -> f64 {
        self.interval * sample as f64
    }
}

/// The mean of the periods.
fn mean<const V: usize>(samples: &[[f64; V]], each: usize) -> Vec<[f64; V]> {
    let periods = (samples.len() / each) as f64;
    let mut sum = vec![[0.0; V]; each];
    for period in samples.chunks(each) {
        for (sum, sample) in sum.iter_mut().zip(period) {
            sum.iter_mut().zip(sample).for_each(|(sum, x)| *sum += x / periods);
        }
    }
    sum
}
