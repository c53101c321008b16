//! The plugin's output file.
//!
//! ```text
//! cycle-meter 4 cortex-m4f
//! 1 390 508 308 201 64 134218012
//! 0 1204 1657 402 611 208 134217994
//! ```
//!
//! After the header, which names the version of the format and the model, one line for each region
//! that was closed, in the order of closing: region, instructions, cycles, floating-point
//! operations, the cycles waited for each of [`FLASHES`], and the address of the mark that opened
//! it. A last line `unmatched n` says that n
//! markers opened an open region or closed a closed one; such a file is refused. A region still
//! open at the exit is not in it.

use std::fmt::Write as _;

#[cfg(doc)]
use crate::FLASHES;

/// First line of a file.
pub const HEADER: &str = "cycle-meter 4 cortex-m4f";

/// One passage through a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample {
    /// 0 to 7.
    pub region: u8,
    /// Executed, exact.
    pub instructions: u64,
    /// Modelled, for memory that never waits.
    pub cycles: u64,
    /// Floating-point operations executed, exact; a multiply-accumulate is two.
    pub flops: u64,
    /// Modelled: the cycles that code in each of [`FLASHES`] takes beyond these.
    pub waits: [u64; 2],
    /// The address of the mark that opened it; 0 of one that was counted by hand.
    pub at: u32,
}

impl Sample {
    /// A passage of these instructions, cycles and floating-point operations.
    pub const fn of(region: u8, [instructions, cycles, flops]: [u64; 3]) -> Self {
        Self { region, instructions, cycles, flops, waits: [0; 2], at: 0 }
    }

    /// The same passage, wherever it was: what it waited for depends on that.
    pub const fn anywhere(self) -> Self {
        Self { waits: [0; 2], at: 0, ..self }
    }

    /// Its cycles without waits, and with those of each of [`FLASHES`].
    pub const fn all_cycles(&self) -> [u64; 3] {
        [self.cycles, self.cycles + self.waits[0], self.cycles + self.waits[1]]
    }
}

#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The first line is not [`HEADER`]; this is what stands there.
    #[error("expected the header `{HEADER}`, found `{0}`")]
    Header(String),
    /// Not a sample: number of the line, from 1, and the line.
    #[error("line {0} is not a sample: `{1}`")]
    Line(usize, String),
    /// The number of markers without a partner.
    #[error("{0} region markers have no partner")]
    Unmatched(u64),
}

/// Reads the plugin's output file.
///
/// # Errors
///
/// If the text is not such a file, or says that markers had no partner.
///
/// ```
/// let file = "cycle-meter 4 cortex-m4f\n0 70 103 48 9 3 134217994\n";
/// let samples = cycle_meter::parse_samples(file)?;
/// assert_eq!(samples[0].all_cycles(), [103, 112, 106]);
/// # Ok::<(), cycle_meter::Error>(())
/// ```
pub fn parse_samples(text: &str) -> Result<Vec<Sample>, Error> {
    let mut lines = text.lines().enumerate();
    let header = lines.next().map_or("", |(_, line)| line);
    if header != HEADER {
        return Err(Error::Header(header.into()));
    }
    lines.map(|(index, line)| sample(line, index + 1)).collect()
}

/// The sample of a line, which is the one of this number.
pub(crate) fn sample(line: &str, number: usize) -> Result<Sample, Error> {
    let malformed = || Error::Line(number, line.into());
    if let Some(count) = line.strip_prefix("unmatched ") {
        return Err(count.parse().map_or_else(|_| malformed(), Error::Unmatched));
    }
    let words = line.split(' ').map(|word| word.parse().ok());
    match words.collect::<Option<Vec<u64>>>().as_deref() {
        Some(&[region @ 0..8, a, b, c, one, two, at]) => Ok(Sample {
            waits: [one, two],
            at: at.try_into().map_err(|_| malformed())?,
            ..Sample::of(region as u8, [a, b, c])
        }),
        _ => Err(malformed()),
    }
}

/// Writes what [`parse_samples`] reads.
pub fn format_samples(samples: &[Sample], unmatched: u64) -> String {
    let mut text = format!("{HEADER}\n");
    for one in samples {
        let (region, instructions) = (one.region, one.instructions);
        let (cycles, flops, [first, second]) = (one.cycles, one.flops, one.waits);
        // Writing to a string does not fail.
        let figures = format!("{region} {instructions} {cycles} {flops} {first} {second}");
        let _ = writeln!(text, "{figures} {}", one.at);
    }
    if unmatched > 0 {
        let _ = writeln!(text, "unmatched {unmatched}");
    }
    text
}

/// Smallest, middle and largest of some values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Summary {
    pub min: u64,
    /// The middle one in order of size; of an even number the lower of the two
    /// middle ones, so that it is a measured value.
    pub median: u64,
    pub max: u64,
}

impl Summary {
    /// The summary of these values; `None` if there are none.
    pub fn of(values: impl IntoIterator<Item = u64>) -> Option<Self> {
        let mut values: Vec<u64> = values.into_iter().collect();
        values.sort_unstable();
        let max = *values.last()?;
        Some(Self { min: values[0], median: values[(values.len() - 1) / 2], max })
    }

    /// The summary of one quantity over a region's samples; `None` if the region was never closed.
    pub fn of_region(samples: &[Sample], region: u8, what: fn(&Sample) -> u64) -> Option<Self> {
        let passages = samples.iter().filter(|sample| sample.region == region);
        Self::of(passages.map(what))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAMPLES: [Sample; 2] = [
        Sample::of(1, [390, 508, 308]),
        Sample { waits: [611, 208], ..Sample::of(0, [1204, 1657, 402]) },
    ];

    #[test]
    fn what_is_written_is_read() {
        for samples in [&SAMPLES[..], &[]] {
            let text = format_samples(samples, 0);
            assert_eq!(parse_samples(&text), Ok(samples.to_vec()));
        }
        let text = format_samples(&SAMPLES, 3);
        assert_eq!(parse_samples(&text), Err(Error::Unmatched(3)));
    }

    #[test]
    fn invalid_samples_are_refused_by_line() {
        assert_eq!(parse_samples(""), Err(Error::Header(String::new())));
        for line in "/0 1 2 3 4/8 1 2 3 4 5 6/0 1 x 3 4 5 6/0 -1 2 3 4 5 6/unmatched x".split('/') {
            let read = parse_samples(&format!("{HEADER}\n{line}\n"));
            assert_eq!(read, Err(Error::Line(2, line.into())));
        }
    }

    #[test]
    fn a_summary_holds_measured_values() {
        let of = |values: &[u64]| {
            let summary = Summary::of(values.iter().copied())?;
            Some([summary.min, summary.median, summary.max])
        };
        assert_eq!(of(&[]), None);
        assert_eq!(of(&[5]), Some([5; 3]));
        assert_eq!(of(&[9, 1, 4, 2]), Some([1, 2, 9]));
        let max = |region| Summary::of_region(&SAMPLES, region, |one| one.cycles).map(|of| of.max);
        assert_eq!([1, 0, 5].map(max), [Some(508), Some(1657), None]);
    }
}
