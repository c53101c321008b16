//! A recording of ticks as filtered rows of a model, a few of them in each second.

use dynamics_core::state::State;

use crate::low_pass::LowPass;
use crate::ticks::Stretch;
use crate::{IdentificationError, TickRecording};

/// The positions pass up to this times the frequency up to which rows and torques do.
const POSITIONS: f64 = 2.5;
/// Rows for each period of the highest frequency.
const ROWS: f64 = 4.0;
/// The least standard deviation of a filter, in ticks, that samples it well.
const NARROWEST: f64 = 1.5;

/// Columns of a model and the measured torque, both through the same filter.
pub(crate) struct Reduced<const V: usize> {
    /// The time of each row, s.
    pub times: Vec<f64>,
    pub states: Vec<State<f64, V, V>>,
    /// The rows of each joint: the columns, then the torque.
    pub rows: [Vec<f64>; V],
}

/// The filters of a recording.
pub(crate) struct Filters {
    positions: LowPass,
    rows: LowPass,
    /// Ticks from one row to the next.
    step: usize,
}

impl Filters {
    /// For torques that belong `delay` after their positions, s, up to this frequency, Hz.
    pub fn new(cutoff: f64, delay: f64, tick: f64) -> Result<Self, IdentificationError> {
        let width = LowPass::width(POSITIONS * cutoff * tick);
        if !(width >= NARROWEST && width.is_finite()) {
            return Err(IdentificationError::Cutoff { cutoff, most: Self::highest(tick) });
        }
        Ok(Self {
            positions: LowPass::new(width, delay / tick),
            rows: LowPass::new(LowPass::width(cutoff * tick), 0.0),
            step: (1.0 / (ROWS * cutoff * tick)).floor().max(1.0) as usize,
        })
    }

    /// The highest frequency for such ticks, Hz.
    pub fn highest(tick: f64) -> f64 {
        LowPass::width(POSITIONS * tick) / NARROWEST
    }

    /// The time from one row to the next, s.
    pub fn seconds(&self, tick: f64) -> f64 {
        tick * self.step as f64
    }

    /// The rows of a recording by a function that has the columns of each joint at a state, which
    /// is given the stretch at its first state.
    pub fn reduce<const V: usize>(
        &self,
        recording: &TickRecording<V>,
        mut columns: impl FnMut(&State<f64, V, V>, Option<&Stretch<V>>) -> [Vec<f64>; V],
    ) -> Reduced<V> {
        let mut reduced =
            Reduced { times: Vec::new(), states: Vec::new(), rows: [const { Vec::new() }; V] };
        for stretch in &recording.stretches {
            self.add(stretch, recording.tick(), &mut columns, &mut reduced);
        }
        reduced
    }

    fn add<const V: usize>(
        &self,
        stretch: &Stretch<V>,
        tick: f64,
        columns: &mut impl FnMut(&State<f64, V, V>, Option<&Stretch<V>>) -> [Vec<f64>; V],
        into: &mut Reduced<V>,
    ) {
        let (inner, outer) = (self.positions.reach, self.rows.reach);
        // The first tick that has a state, and the middle of the first window of states.
        let samples = stretch.positions.len();
        let Some(windows) = samples.checked_sub(2 * (inner + outer) + 1) else {
            return;
        };
        let (rows, before) = (windows / self.step + 1, into.times.len());
        let mut width = 0;
        for k in 0..=2 * outer + (rows - 1) * self.step {
            let middle = k + inner;
            let [q, qd, qdd] = self.positions.state(&stretch.positions[k..=middle + inner]);
            let state = State { q, qd: qd.map(|x| x / tick), qdd: qdd.map(|x| x / (tick * tick)) };
            let mut all = columns(&state, (k == 0).then_some(stretch));
            for (all, tau) in all.iter_mut().zip(&stretch.torques[middle]) {
                all.push(*tau);
            }
            width = all.first().map_or(0, Vec::len);
            // Row r takes the ticks from r·step to r·step + 2·outer.
            let first = k.saturating_sub(2 * outer).div_ceil(self.step);
            for row in first..=(k / self.step).min(rows - 1) {
                let place = k - row * self.step;
                if place == 0 {
                    into.rows.iter_mut().for_each(|rows| rows.resize(rows.len() + width, 0.0));
                }
                if place == outer {
                    into.states.push(state);
                    into.times.push(stretch.start + tick * middle as f64);
                }
                let weight = self.rows.weight(place);
                let at = (before + row) * width;
                for (rows, all) in into.rows.iter_mut().zip(&all) {
                    let sums = rows[at..at + width].iter_mut().zip(all);
                    sums.for_each(|(sum, x)| *sum += weight * x);
                }
            }
        }
        debug_assert!(into.rows.iter().all(|rows| rows.len() == into.times.len() * width));
    }
}
