//! Sequences counted by hand, against which the meter is checked.
//!
//! They are executed by `firmware-demo/src/bin/tests/meter_check.rs`, where each figure is derived
//! next to its sequence. The sums were made from the table in this crate's
//! documentation, not from what the meter said.

use crate::samples::Sample;

/// What a sequence must cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HandCounted {
    /// What is special about it.
    pub name: &'static str,
    /// What the plugin must report.
    pub sample: Sample,
}

const fn row(
    name: &'static str,
    region: u8,
    instructions: u64,
    cycles: u64,
    flops: u64,
) -> HandCounted {
    HandCounted {
        name,
        sample: Sample {
            region,
            instructions,
            cycles,
            flops,
        },
    }
}

/// In the order in which `meter_check` closes its regions.
pub const HAND_COUNTED: &[HandCounted] = &[
    row("straight line", 0, 5, 5, 0),
    row("divide", 0, 2, 13, 0),
    row("if-then", 0, 4, 4, 0),
    row("system", 0, 5, 10, 0),
    row("independent floats", 0, 4, 4, 3),
    row("chain of floats", 0, 4, 7, 3),
    row("chain of floats with a gap", 0, 3, 3, 2),
    row("sum to a core register", 0, 2, 3, 1),
    row("moved, then used", 0, 2, 2, 1),
    row("multiply-add", 0, 3, 8, 5),
    row("compare", 0, 2, 2, 0),
    row("pair to core registers", 0, 1, 2, 0),
    row("division used at once", 0, 2, 16, 2),
    row("root, then unrelated float", 0, 2, 15, 2),
    row("division half hidden", 0, 7, 15, 2),
    row("division hidden", 0, 16, 16, 2),
    row("division across a branch", 0, 3, 15, 2),
    row("loads in a row", 0, 3, 4, 0),
    row("loads apart", 0, 3, 5, 0),
    row("load through a loaded pointer", 0, 2, 5, 0),
    row("address just computed", 0, 4, 7, 0),
    row("base only updated", 0, 2, 3, 0),
    row("stores", 0, 4, 4, 0),
    row("several words", 0, 8, 30, 0),
    row("loop of ten", 0, 21, 39, 0),
    row("not taken", 0, 3, 3, 0),
    row("taken", 0, 3, 5, 0),
    row("compare and branch", 0, 3, 5, 0),
    row("call and return", 0, 4, 10, 0),
    row("call that saves registers", 0, 4, 14, 0),
    row("table branch", 0, 4, 7, 0),
    row("across a page end", 0, 4, 4, 0),
    row("result across a page end", 0, 3, 4, 2),
    row("address across a page end", 0, 3, 5, 0),
    row("longer than a block can be", 0, 600, 600, 0),
    row("device", 0, 5, 6, 0),
    row("loop over a device", 0, 13, 20, 0),
    row("interrupt", 0, 5, 7, 0),
    row("empty", 7, 0, 0, 0),
    row("innermost", 2, 1, 1, 0),
    row("middle", 1, 4, 4, 0),
    row("outermost", 0, 6, 6, 0),
    row("second phase", 1, 2, 2, 0),
    row("whole", 0, 4, 5, 0),
    row("overlapping, first", 6, 2, 2, 0),
    row("overlapping, second", 7, 3, 3, 0),
];

/// Compares the samples of a run of `meter_check` with [`HAND_COUNTED`] and returns how many agree.
///
/// # Errors
///
/// A line for each that differs, or the two numbers of samples if those differ.
pub fn check_hand_counted(samples: &[Sample]) -> Result<usize, String> {
    let differences: Vec<String> = HAND_COUNTED
        .iter()
        .zip(samples)
        .filter(|(expected, sample)| expected.sample != **sample)
        .map(|(HandCounted { name, sample: hand }, meter)| {
            format!(
                "{name}: by hand {}, by the meter {}",
                describe(hand),
                describe(meter)
            )
        })
        .collect();
    if !differences.is_empty() {
        return Err(differences.join("\n"));
    }
    if samples.len() != HAND_COUNTED.len() {
        return Err(format!(
            "{} sequences were counted by hand, {} were measured",
            HAND_COUNTED.len(),
            samples.len()
        ));
    }
    Ok(samples.len())
}

fn describe(sample: &Sample) -> String {
    let Sample {
        region,
        instructions,
        cycles,
        flops,
    } = sample;
    format!("{instructions} instructions, {cycles} cycles, {flops} flops in region {region}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn by_hand() -> Vec<Sample> {
        HAND_COUNTED.iter().map(|row| row.sample).collect()
    }

    #[test]
    fn the_table_agrees_with_itself() {
        assert_eq!(check_hand_counted(&by_hand()), Ok(HAND_COUNTED.len()));
    }

    #[test]
    fn a_difference_is_named() {
        let mut samples = by_hand();
        samples[1].cycles += 1;
        assert_eq!(
            check_hand_counted(&samples),
            Err(
                "divide: by hand 2 instructions, 13 cycles, 0 flops in region 0, \
                 by the meter 2 instructions, 14 cycles, 0 flops in region 0"
                    .into()
            )
        );
    }

    #[test]
    fn a_missing_or_extra_sample_is_noticed() {
        let mut samples = by_hand();
        samples.push(samples[0]);
        assert!(check_hand_counted(&samples).is_err());
        assert!(check_hand_counted(&samples[..samples.len() - 2]).is_err());
    }
}
