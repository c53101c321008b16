//! Recorded ticks of a motion of any kind.

use crate::IdentificationError;

/// Positions and torques of V joints in consecutive ticks, of one or several uninterrupted
/// stretches of any motion, which need not repeat.
///
/// ```
/// use identification::{IdentificationError, TickRecording};
/// let stretch = || (vec![[0.1]; 500], vec![[2.0]; 500]);
/// let recording = TickRecording::try_new(vec![stretch(), stretch()], 1e-3)?;
/// assert_eq!((recording.ticks(), recording.tick()), (1000, 1e-3));
/// let (first, last) = recording.split(0.7);
/// assert_eq!((first.ticks(), last.ticks()), (700, 300));
/// # Ok::<(), IdentificationError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TickRecording<const V: usize> {
    pub(crate) stretches: Vec<Stretch<V>>,
    tick: f64,
}

/// The positions, rad or m, and as many torques, N·m or N, of consecutive ticks.
pub type Samples<const V: usize> = (Vec<[f64; V]>, Vec<[f64; V]>);

/// Positions and torques of consecutive ticks.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stretch<const V: usize> {
    pub positions: Vec<[f64; V]>,
    pub torques: Vec<[f64; V]>,
    /// The time of its first tick, s since the start of the recording without its gaps.
    pub start: f64,
}

impl<const V: usize> TickRecording<V> {
    /// Positions, rad or m, and torques, N·m or N, of each stretch, in ticks of this length, s.
    ///
    /// # Errors
    /// [`IdentificationError`] if a stretch has not as many positions as torques, or if a number is
    /// not finite.
    pub fn try_new(stretches: Vec<Samples<V>>, tick: f64) -> Result<Self, IdentificationError> {
        if !(tick > 0.0 && tick.is_finite()) {
            return Err(IdentificationError::Interval);
        }
        let mut all = Vec::new();
        let mut before = 0;
        for (positions, torques) in stretches {
            let samples = positions.len();
            if samples != torques.len() {
                let torques = torques.len();
                return Err(IdentificationError::Lengths { samples, torques });
            }
            for (sample, (q, tau)) in positions.iter().zip(&torques).enumerate() {
                let mut pairs = q.iter().zip(tau);
                if let Some(joint) = pairs.position(|(q, tau)| !(q + tau).is_finite()) {
                    let sample = before + sample;
                    return Err(IdentificationError::NotFinite { sample, joint });
                }
            }
            all.push(Stretch { positions, torques, start: tick * before as f64 });
            before += samples;
        }
        Ok(Self { stretches: all, tick })
    }

    /// The recording with other positions and torques in each tick.
    ///
    /// ```
    /// use identification::TickRecording;
    /// let recording = TickRecording::try_new(vec![(vec![[0.1]; 500], vec![[2.0]; 500])], 1e-3)?;
    /// let reversed = recording.map(|q, tau| (q, tau.map(|tau| -tau)));
    /// assert_eq!(reversed.extremes(), recording.extremes());
    /// # Ok::<(), identification::IdentificationError>(())
    /// ```
    #[must_use]
    pub fn map(&self, mut to: impl FnMut([f64; V], [f64; V]) -> ([f64; V], [f64; V])) -> Self {
        let mut mapped = self.clone();
        for stretch in &mut mapped.stretches {
            for (q, tau) in stretch.positions.iter_mut().zip(&mut stretch.torques) {
                (*q, *tau) = to(*q, *tau);
            }
        }
        mapped
    }

    /// The number of ticks.
    #[must_use]
    pub fn ticks(&self) -> usize {
        let each = self.stretches.iter().map(|stretch| stretch.positions.len());
        each.sum()
    }

    /// The length of a tick, s.
    #[must_use]
    pub fn tick(&self) -> f64 {
        self.tick
    }

    /// The least and the greatest position of each joint, rad or m, and its greatest torque, N·m or
    /// N.
    #[must_use]
    pub fn extremes(&self) -> [[f64; 3]; V] {
        let mut found = [[f64::INFINITY, f64::NEG_INFINITY, 0.0_f64]; V];
        for stretch in &self.stretches {
            for (q, tau) in stretch.positions.iter().zip(&stretch.torques) {
                for (found, (q, tau)) in found.iter_mut().zip(q.iter().zip(tau)) {
                    *found = [found[0].min(*q), found[1].max(*q), found[2].max(tau.abs())];
                }
            }
        }
        found
    }

    /// The greatest speed and acceleration of each joint, by differences over 20 ticks, rad/s and
    /// rad/s², or with m.
    #[must_use]
    pub fn rates(&self) -> [[f64; V]; 2] {
        const APART: usize = 20;
        let h = self.tick * APART as f64;
        let mut rates = [[0.0_f64; V]; 2];
        for stretch in &self.stretches {
            for window in stretch.positions.windows(2 * APART + 1).step_by(APART / 2) {
                for j in 0..V {
                    let [a, b, c] = [0, APART, 2 * APART].map(|at| window[at][j]);
                    rates[0][j] = rates[0][j].max((c - a).abs() / (2.0 * h));
                    rates[1][j] = rates[1][j].max((c - 2.0 * b + a).abs() / (h * h));
                }
            }
        }
        rates
    }

    /// The means of so many ticks each.
    #[cfg(feature = "arrays")]
    pub(crate) fn means(&self, ticks: usize) -> Self {
        let mean = |all: &[[f64; V]]| -> [f64; V] {
            std::array::from_fn(|j| all.iter().map(|x| x[j]).sum::<f64>() / ticks as f64)
        };
        let means = |all: &[[f64; V]]| all.chunks_exact(ticks).map(mean).collect();
        let of = |all: &Stretch<V>| Stretch {
            positions: means(&all.positions),
            torques: means(&all.torques),
            start: all.start,
        };
        let stretches = self.stretches.iter().map(of).collect();
        Self { stretches, tick: self.tick * ticks as f64 }
    }

    /// Its first part, of this share of the ticks, and the rest.
    #[must_use]
    pub fn split(&self, share: f64) -> (Self, Self) {
        let mut left = (share * self.ticks() as f64).round() as usize;
        let [mut first, mut last] =
            [(); 2].map(|()| Self { stretches: Vec::new(), tick: self.tick });
        for stretch in &self.stretches {
            let at = left.min(stretch.positions.len());
            left -= at;
            let part = |range: std::ops::Range<usize>| Stretch {
                positions: stretch.positions[range.clone()].to_vec(),
                torques: stretch.torques[range.clone()].to_vec(),
                start: stretch.start + self.tick * range.start as f64,
            };
            let ends = [0..at, at..stretch.positions.len()];
            for (half, range) in [&mut first, &mut last].into_iter().zip(ends) {
                if !range.is_empty() {
                    half.stretches.push(part(range));
                }
            }
        }
        (first, last)
    }
}
