//! Rows at uneven times onto an even grid, and what was left out for it.
//!
//! Between four samples runs the cubic through them, with an error of at most 3/128 (ω h)⁴ of an
//! amplitude at the frequency ω and intervals h: Hildebrand, "Introduction to Numerical Analysis"
//! (1974), section 3.2.

use std::f64::consts::TAU;

use serde::Serialize;

use super::error::Problem;

/// Rows that are off the grid by less than this share of an interval are taken as they are.
const EVEN: f64 = 0.01;
/// Up to this many intervals between two samples are bridged.
const BRIDGED: f64 = 3.5;
/// The intervals of samples that show a motion, s.
const INTERVALS: std::ops::RangeInclusive<f64> = 2e-5..=0.5;
/// The largest jitter, RMS, of an interval, and the largest share of times that go back.
const JITTER: f64 = 0.4;
const BACKWARD: f64 = 0.01;

/// Positions and torques of a tick.
pub type Row = (Vec<f64>, Vec<f64>);

/// The rows of a record that were left out, and how it was made even.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Sampling {
    /// Rows on hold or stopped, and rows that lack a number.
    pub left_out: usize,
    /// Rows with the time of the row before, and rows with an earlier one.
    pub duplicates: usize,
    pub backward: usize,
    /// Gaps between stretches, and their duration, s.
    pub gaps: usize,
    pub gap_seconds: f64,
    /// Samples that are missing between others and were interpolated.
    pub bridged: usize,
    /// By how much intervals differ from the mean one, relative to it: RMS and the largest.
    pub jitter: [f64; 2],
    /// Whether samples were interpolated.
    pub is_resampled: bool,
}

impl Sampling {
    /// The largest change of a position and a torque at a frequency by the interpolation, relative
    /// to its amplitude; of intervals without and with missing samples.
    pub fn error(&self, cutoff: f64, interval: f64) -> [f64; 2] {
        let at = |intervals: f64| 3.0 / 128.0 * (TAU * cutoff * interval * intervals).powi(4);
        [at(1.0 + self.jitter[1]), if self.bridged > 0 { at(BRIDGED) } else { 0.0 }]
    }
}

/// Rows with their times, s, in order.
pub type Timed = Vec<(f64, Row)>;

/// Stretches of rows in the order of their times. A stretch ends before each row of `breaks`.
pub fn ordered(
    times: &[f64],
    rows: Vec<Row>,
    breaks: &[usize],
    sampling: &mut Sampling,
) -> Result<Vec<Timed>, Problem> {
    let mut stretches: Vec<Timed> = Vec::new();
    let (count, mut breaks) = (rows.len(), breaks.iter().peekable());
    for (at, (time, row)) in times.iter().zip(rows).enumerate() {
        let ends = breaks.next_if(|next| **next <= at).is_some();
        while breaks.next_if(|next| **next <= at).is_some() {}
        match stretches.last_mut().filter(|_| !ends) {
            None => stretches.push(vec![(*time, row)]),
            Some(stretch) => match stretch.last() {
                Some((last, _)) if last == time => sampling.duplicates += 1,
                Some((last, _)) if last > time => sampling.backward += 1,
                _ => stretch.push((*time, row)),
            },
        }
    }
    if sampling.backward as f64 > BACKWARD * count as f64 {
        return Err(Problem::Backward { backward: sampling.backward, rows: count });
    }
    Ok(stretches)
}

/// The interval, s, and stretches of rows at this interval.
pub fn even(stretches: &[Timed], sampling: &mut Sampling) -> Result<(f64, Vec<Vec<Row>>), Problem> {
    let pairs = || stretches.iter().flat_map(|stretch| stretch.windows(2));
    let mut each: Vec<f64> = pairs().map(|pair| pair[1].0 - pair[0].0).collect();
    if each.is_empty() {
        return Err(Problem::NoTick);
    }
    let middle = each.len() / 2;
    let median = *each.select_nth_unstable_by(middle, f64::total_cmp).1;
    if !INTERVALS.contains(&median) {
        return Err(Problem::Rate(median));
    }
    let near: Vec<f64> = each.into_iter().filter(|each| *each < BRIDGED * median).collect();
    let whole = |each: &f64| (each / median).round().max(1.0);
    let interval = near.iter().sum::<f64>() / near.iter().map(whole).sum::<f64>();
    let off = |each: &f64| (each / interval - whole(each)).abs();
    let square = near.iter().map(|each| off(each).powi(2)).sum::<f64>();
    sampling.jitter =
        [(square / near.len() as f64).sqrt(), near.iter().map(off).fold(0.0, f64::max)];
    if sampling.jitter[0] > JITTER {
        return Err(Problem::Jitter { interval, jitter: 100.0 * sampling.jitter[0] });
    }
    let mut all = Vec::new();
    for stretch in stretches {
        for part in stretch.chunk_by(|a, b| b.0 - a.0 < BRIDGED * interval) {
            all.push(part);
        }
        for pair in stretch.windows(2) {
            let missing = (pair[1].0 - pair[0].0) / interval - 1.0;
            match missing + 1.0 < BRIDGED {
                true => sampling.bridged += missing.round().max(0.0) as usize,
                false => sampling.gap_seconds += missing * interval,
            }
        }
    }
    sampling.gaps = all.len() - 1;
    let is_even = |part: &&[(f64, Row)]| {
        let place = |(k, (time, _)): (usize, &(f64, Row))| (time - part[0].0) / interval - k as f64;
        part.iter().enumerate().map(place).all(|off| off.abs() < EVEN)
    };
    sampling.is_resampled = !all.iter().all(is_even);
    let made = |part: &[(f64, Row)]| match sampling.is_resampled {
        true => interpolated(part, interval),
        false => part.iter().map(|(_, row)| row.clone()).collect(),
    };
    Ok((interval, all.into_iter().map(made).collect()))
}

/// The rows of the grid between the first sample and the last one.
fn interpolated(part: &[(f64, Row)], interval: f64) -> Vec<Row> {
    let (start, end) = (part[0].0, part[part.len() - 1].0);
    let (count, mut before) = (((end - start) / interval + 1e-6) as usize, 0);
    let row = |k: usize| {
        let time = start + interval * k as f64;
        while before + 2 < part.len() && part[before + 1].0 <= time {
            before += 1;
        }
        let first = before.saturating_sub(1).min(part.len().saturating_sub(4));
        let nodes = &part[first..(first + 4).min(part.len())];
        let weight = |i: usize| -> f64 {
            let others = nodes.iter().enumerate().filter(|(other, _)| *other != i);
            others.map(|(_, (at, _))| (time - at) / (nodes[i].0 - at)).product()
        };
        let weights: Vec<f64> = (0..nodes.len()).map(weight).collect();
        let of = |pick: fn(&Row) -> &Vec<f64>| -> Vec<f64> {
            let joint =
                |j: usize| weights.iter().zip(nodes).map(|(w, (_, row))| w * pick(row)[j]).sum();
            (0..pick(&nodes[0].1).len()).map(joint).collect()
        };
        (of(|row| &row.0), of(|row| &row.1))
    };
    (0..=count).map(row).collect()
}
