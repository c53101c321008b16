//! A function under test: checked, then timed.

use std::error::Error;
use std::hint::black_box;
use std::time::{Duration, Instant};

use dynamics_core::scalar::Real;
use serde::Serialize;

/// Rounds in which every subject runs once.
const ROUNDS: usize = 21;
/// The least time of a subject in a round: long against the clock's steps.
const TURN: Duration = Duration::from_micros(300);

/// Fills an output.
pub type Batch<R> = Box<dyn FnMut(&mut [R])>;

/// A function with its inputs.
pub struct Subject<R> {
    /// Its name in the report.
    pub peer: String,
    /// Fills the output for a batch of states.
    pub run: Batch<R>,
    /// Numbers that it writes for a state.
    pub outputs: usize,
    /// The index of the recorded number for each of its own; numbers without an index are not
    /// compared.
    pub order: Vec<Option<usize>>,
    /// Whether it is timed, or only checked.
    pub timed: bool,
}

#[derive(Serialize)]
pub struct Row<'a> {
    pub robot: &'a str,
    /// `rnea`, `bias`, `gravity`, `crba`, `aba`, `gradient` or `osim`.
    pub algorithm: &'a str,
    pub peer: &'a str,
    /// `f32` or `f64`.
    pub precision: &'a str,
    /// Largest error, relative to the full scale of the recording.
    pub error: f64,
    /// Nanoseconds a state, if it was timed.
    pub ns: Option<f64>,
}

impl<R: Real> Subject<R> {
    /// A function that is timed.
    pub fn new(peer: &str, run: Batch<R>, order: Vec<Option<usize>>) -> Self {
        Self { peer: peer.to_owned(), run, outputs: order.len(), order, timed: true }
    }

    /// The largest difference from the expected rows, relative to the full scale.
    ///
    /// # Errors
    /// It exceeds `bound`.
    pub fn check(
        &mut self,
        states: usize,
        expected: &[Vec<f64>],
        full_scale: f64,
        bound: f64,
    ) -> Result<f64, Box<dyn Error>> {
        let mut out = vec![R::from_f64(f64::NAN); states * self.outputs];
        (self.run)(&mut out);
        let mut error = 0.0;
        for (found, expected) in std::iter::zip(out.chunks(self.outputs), expected) {
            let complete = expected.len() == self.order.iter().flatten().count();
            if !complete || self.order.len() != self.outputs {
                return Err(format!("{} has {} outputs", self.peer, self.outputs).into());
            }
            for (found, at) in std::iter::zip(found, &self.order) {
                let Some(at) = *at else { continue };
                let difference = (found.to_f64() - expected[at]).abs() / full_scale;
                // A NaN counts as wrong.
                error = if difference <= error { error } else { difference };
            }
        }
        if error <= bound {
            return Ok(error);
        }
        Err(format!("{} is off by {error:.1e} of full scale", self.peer).into())
    }
}

/// The order of the entries of a peer's square matrix, by columns, in our recording, which has the
/// upper triangle by rows. `ours[i]` is our number of the peer's coordinate `i`.
pub fn square(ours: &[usize]) -> Vec<Option<usize>> {
    let n = ours.len();
    let recorded = |i: usize, j: usize| {
        let (i, j) = (ours[i].min(ours[j]), ours[i].max(ours[j]));
        i * (2 * n + 1 - i) / 2 + j - i
    };
    let columns = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    columns.map(|(i, j)| (i <= j).then(|| recorded(i, j))).collect()
}

/// The median time of each subject, ns a state; they take turns, so that what disturbs the machine
/// disturbs all alike.
pub fn interleaved<R: Real>(subjects: &mut [&mut Subject<R>], states: usize) -> Vec<f64> {
    let mut out: Vec<Vec<R>> =
        subjects.iter().map(|subject| vec![R::ZERO; states * subject.outputs]).collect();
    let mut batches = |subject: &mut Subject<R>, index: usize, count: u32| {
        let start = Instant::now();
        for _ in 0..count {
            (subject.run)(black_box(&mut out[index]));
        }
        black_box(&out[index]);
        start.elapsed()
    };
    let counts: Vec<u32> = subjects
        .iter_mut()
        .enumerate()
        .map(|(index, subject)| {
            let mut count = 1;
            while batches(subject, index, count) < TURN {
                count *= 2;
            }
            count
        })
        .collect();
    let mut times = vec![Vec::with_capacity(ROUNDS); subjects.len()];
    for _ in 0..ROUNDS {
        for (index, subject) in subjects.iter_mut().enumerate() {
            let elapsed = batches(subject, index, counts[index]);
            times[index].push(elapsed.as_secs_f64() * 1e9 / f64::from(counts[index]));
        }
    }
    let median = |mut times: Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2] / states as f64
    };
    times.into_iter().map(median).collect()
}
