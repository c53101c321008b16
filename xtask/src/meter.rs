//! What the cycle meter wrote, as statistics of each region.

use std::path::Path;

use cycle_meter::{Sample, Summary};
use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::workspace;

/// The regions' names by their number; 0 is the whole tick.
pub const REGIONS: [&str; 6] = ["total", "read", "reference", "dynamics", "safety", "write"];

/// Smallest, middle and largest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Spread {
    /// The smallest.
    pub min: u64,
    /// The median, the lower one of two.
    pub median: u64,
    /// The largest.
    pub max: u64,
}

/// The price of a region.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Cost {
    /// Instructions, exact.
    pub instructions: Spread,
    /// Modelled cycles.
    pub cycles: Spread,
}

/// Reads the file that the meter wrote.
pub fn read(path: &Path) -> Result<Vec<Sample>> {
    cycle_meter::parse_samples(&workspace::read(path)?)
        .map_err(|e| Error::check(format!("{}: {e}", path.display())))
}

/// The cost of each of [`REGIONS`], over the ticks that `counts` picks by their number.
///
/// # Errors
/// A region does not occur once in each tick, or the number of ticks is not `ticks`.
pub fn costs(
    samples: &[Sample],
    ticks: usize,
    counts: impl Fn(usize) -> bool,
) -> Result<Vec<Cost>> {
    REGIONS
        .iter()
        .enumerate()
        .map(|(number, name)| {
            let of_region: Vec<&Sample> = samples
                .iter()
                .filter(|sample| usize::from(sample.region) == number)
                .collect();
            if of_region.len() != ticks {
                return Err(Error::check(format!(
                    "the cycle meter saw region {number} ({name}) {} times in {ticks} ticks",
                    of_region.len()
                )));
            }
            let chosen = || {
                of_region
                    .iter()
                    .enumerate()
                    .filter(|(tick, _)| counts(*tick))
            };
            Ok(Cost {
                instructions: spread(chosen().map(|(_, p)| p.instructions))?,
                cycles: spread(chosen().map(|(_, p)| p.cycles))?,
            })
        })
        .collect()
}

fn spread(values: impl Iterator<Item = u64>) -> Result<Spread> {
    let Summary { min, median, max } =
        Summary::of(values).ok_or_else(|| Error::check("the cycle meter measured no tick"))?;
    Ok(Spread { min, median, max })
}

#[cfg(test)]
mod tests {
    use cycle_meter::Sample;

    use super::{REGIONS, costs};

    #[test]
    fn only_the_chosen_ticks_count() {
        let samples: Vec<Sample> = (0..4)
            .flat_map(|tick| {
                (0..REGIONS.len() as u8).map(move |region| Sample {
                    region,
                    instructions: 10 * tick,
                    cycles: 20 * tick,
                })
            })
            .collect();
        let total = costs(&samples, 4, |tick| tick < 3).expect("complete")[0];
        assert_eq!((total.instructions.median, total.cycles.max), (10, 40));
        assert!(costs(&samples, 5, |_| true).is_err());
    }
}
