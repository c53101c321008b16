//! The samples of the cycle meter, as statistics of each region.

use std::path::Path;

use cycle_meter::Sample;
pub use cycle_meter::Summary as Spread;
use serde::{Deserialize, Serialize};

use crate::kit::error::{Result, check, refuse_if};
use crate::kit::workspace;

/// The note that goes with every cycle figure.
pub const MODEL: &str = "modelled Cortex-M4F, zero-wait memory; instructions exact";

/// The chips whose flash waits, in the order of the meter's [`cycle_meter::FLASHES`].
pub const CHIPS: [&str; 2] = ["G474", "F405"];

/// The note that goes with figures of [`CHIPS`].
pub const IN_FLASH: &str = "G474, F405: the most cycles from the flash of an STM32G474 at 170 \
                            MHz, which has 4 wait states, and of an STM32F405 at 168 MHz, which \
                            has 5";

/// The clock of the STM32F405 in MHz, so cycles per µs.
pub const CLOCK_MHZ: f64 = 168.0;

/// The regions' names by their number; 0 is the whole tick.
pub const REGIONS: [&str; 6] = ["total", "read", "reference", "dynamics", "safety", "write"];

#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Cost {
    /// Instructions, exact.
    pub instructions: Spread,
    pub cycles: Spread,
    /// The cycles from the flash of each of [`CHIPS`].
    pub in_flash: [Spread; 2],
}

/// The instructions of a passage, its cycles, and those from the flash of each of [`CHIPS`].
pub type Passage = [u64; 4];

pub fn passage(sample: &Sample) -> Passage {
    let [cycles, first, second] = sample.all_cycles();
    [sample.instructions, cycles, first, second]
}

/// Reads the file that the meter wrote.
pub fn read(path: &Path) -> Result<Vec<Sample>> {
    cycle_meter::parse_samples(&workspace::read(path)?)
        .map_err(|e| check!("{}: {e}", path.display()))
}

/// The name of what a tick does outside its phases: moving their results, and its own entry.
pub const BETWEEN: &str = "between";

/// The cost of each of [`REGIONS`] and then of what is [`BETWEEN`] them, over the ticks that
/// `counts` picks by their number.
///
/// # Errors
/// A region does not occur once in each tick, or the number of ticks is not `ticks`.
pub fn costs(
    samples: &[Sample],
    ticks: usize,
    counts: impl Fn(usize) -> bool,
) -> Result<Vec<Cost>> {
    let of = |(number, name): (usize, &&str)| {
        let is_mine = |one: &&Sample| usize::from(one.region) == number;
        let mine = samples.iter().filter(is_mine);
        let mine: Vec<Passage> = mine.map(passage).collect();
        let found = mine.len();
        refuse_if!(
            found != ticks,
            "the cycle meter saw region {number} ({name}) {found} times in {ticks} ticks"
        );
        Ok(mine)
    };
    let regions = REGIONS.iter().enumerate().map(of);
    let mut regions = regions.collect::<Result<Vec<_>>>()?;
    let between = (0..ticks).map(|tick| {
        [0, 1, 2, 3].map(|which| {
            let phases: u64 = regions[1..].iter().map(|phase| phase[tick][which]).sum();
            regions[0][tick][which].saturating_sub(phases)
        })
    });
    regions.push(between.collect());
    let cost = |region: &Vec<Passage>| {
        Cost::of((0..ticks).filter(|tick| counts(*tick)).map(|tick| region[tick]))
    };
    regions.iter().map(cost).collect()
}

impl Cost {
    /// The cost of some passages through a region.
    pub fn of(passages: impl Iterator<Item = Passage> + Clone) -> Result<Self> {
        let spread = |which: usize| {
            let figures = passages.clone().map(move |passage| passage[which]);
            Spread::of(figures).ok_or_else(|| check!("the cycle meter measured nothing"))
        };
        Ok(Self {
            instructions: spread(0)?,
            cycles: spread(1)?,
            in_flash: [spread(2)?, spread(3)?],
        })
    }
}

#[cfg(test)]
mod tests {
    use cycle_meter::Sample;

    use super::{REGIONS, costs};

    #[test]
    fn only_the_chosen_ticks_count() {
        let samples: Vec<Sample> = (0..4)
            .flat_map(|tick| {
                let regions = 0..REGIONS.len() as u8;
                regions.map(move |region| Sample {
                    waits: [5 * tick, tick],
                    ..Sample::of(region, [10 * tick, 20 * tick, 0])
                })
            })
            .collect();
        let total = costs(&samples, 4, |tick| tick < 3).expect("complete")[0];
        assert_eq!((total.instructions.median, total.cycles.max), (10, 40));
        assert_eq!(total.in_flash.map(|flash| [flash.median, flash.max]), [[25, 50], [21, 42]]);
        assert!(costs(&samples, 5, |_| true).is_err());
    }

    #[test]
    fn what_is_in_no_phase_is_between_them() {
        let mut samples = [Sample { waits: [3, 0], ..Sample::of(0, [19, 39, 0]) }; REGIONS.len()];
        (0..).zip(&mut samples).for_each(|(region, one)| one.region = region);
        samples[0] = Sample { waits: [17, 4], ..Sample::of(0, [100, 210, 0]) };
        let costs = costs(&samples, 1, |_| true).expect("complete");
        let between = costs[REGIONS.len()];
        assert_eq!((between.instructions.max, between.cycles.max), (5, 15));
        assert_eq!(between.in_flash.map(|flash| flash.max), [17, 19]);
    }
}
