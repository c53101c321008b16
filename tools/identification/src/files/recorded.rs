//! Positions and torques of a record at even times. Nothing in it is believed.

use std::path::Path;

use crate::TickRecording;

use super::error::{Error, Problem, Result};
use super::resample::{self, Row, Sampling, Timed};

/// The largest number that a position or a torque of an arm may be.
pub(crate) const LARGEST: f64 = 1e6;
/// The largest time, s: years after 1970.
pub(crate) const LATEST: f64 = 1e11;

/// The ticks of a file in which the controller made the torque.
#[derive(Clone, Debug, PartialEq)]
pub struct Recorded {
    /// The number of joints.
    pub joints: usize,
    /// The length of a tick, s.
    pub tick: f64,
    /// Positions and torques of consecutive ticks, joint by joint.
    pub stretches: Vec<Vec<Row>>,
    pub sampling: Sampling,
    /// Whether a torque is held until the next tick; otherwise it is that of its position.
    pub held: bool,
    /// The rows of which the stretches were made, in the order of their times.
    pub(crate) timed: Vec<Timed>,
}

/// Rows as they come.
#[derive(Default)]
pub(crate) struct Rows {
    pub times: Vec<f64>,
    pub rows: Vec<Row>,
    /// The rows before which a stretch ends.
    pub breaks: Vec<usize>,
    pub left_out: usize,
    /// The count of the row before, if there is one.
    #[cfg(feature = "files")]
    pub count: Option<i64>,
}

impl Recorded {
    /// A recording from arrays: times, s, positions, rad or m, and torques, N·m or N, row by row.
    ///
    /// # Errors
    /// [`Error`] names the row.
    pub fn of(path: &Path, times: Vec<f64>, rows: Vec<Row>) -> Result<Self> {
        let joints = rows.first().map_or(0, |row| row.0.len());
        let is_one = |(time, (q, tau)): &(&f64, &Row)| {
            let all = q.iter().chain(tau).all(|x| x.abs() <= LARGEST);
            all && time.abs() <= LATEST && [q.len(), tau.len()] == [joints; 2]
        };
        let line = times.iter().zip(&rows).position(|row| !is_one(&row));
        if let Some(line) = line.or((times.len() != rows.len()).then_some(times.len())) {
            let problem =
                Problem::Map("its numbers are not finite, or not as many as before".to_owned());
            return Err(Error::Line { path: path.to_owned(), line, problem });
        }
        let first = times.first().copied().unwrap_or(0.0);
        let times = times.into_iter().map(|time| time - first).collect();
        let whole = |problem| Error::Recording { path: path.to_owned(), problem };
        Rows { times, rows, ..Rows::default() }.made(joints, false).map_err(whole)
    }

    pub(crate) fn even(
        joints: usize,
        timed: Vec<Timed>,
        mut sampling: Sampling,
        held: bool,
    ) -> std::result::Result<Self, Problem> {
        let (tick, stretches) = resample::even(&timed, &mut sampling)?;
        Ok(Self { joints, tick, stretches, sampling, held, timed })
    }

    /// As a recording of V joints.
    ///
    /// # Errors
    /// [`Error::Identification`].
    pub fn ticks<const V: usize>(&self, path: &Path) -> Result<TickRecording<V>> {
        let array = |values: &[f64]| std::array::from_fn(|j| values[j]);
        let each = self.stretches.iter().map(|rows| {
            let pairs = rows.iter().map(|(q, tau)| (array(q), array(tau)));
            pairs.unzip()
        });
        TickRecording::try_new(each.collect(), self.tick)
            .map_err(|source| Error::Identification { path: path.to_owned(), source })
    }
}

impl Rows {
    pub fn made(self, joints: usize, held: bool) -> std::result::Result<Recorded, Problem> {
        let mut sampling = Sampling { left_out: self.left_out, ..Sampling::default() };
        let timed = resample::ordered(&self.times, self.rows, &self.breaks, &mut sampling)?;
        Recorded::even(joints, timed, sampling, held)
    }
}
