//! Sequences counted by hand, against which the meter is checked.
//!
//! They are executed by `lab/firmware/src/bin/tests/meter_check.rs`, where each figure is derived
//! next to its sequence. The sums were made from the table in this crate's
//! documentation, not from what the meter said.

use crate::samples::{Sample, sample};

/// The required cost of each sequence, beside the reason for it.
const HAND_COUNTED: &str = include_str!("hand_counted.txt");

fn by_hand() -> impl Iterator<Item = (&'static str, Sample)> {
    let rows = HAND_COUNTED.lines().filter_map(|line| line.split_once(": "));
    rows.filter_map(|(name, figures)| Some((name, sample(&format!("{figures} 0 0 0"), 0).ok()?)))
}

/// Compares the samples of a run of `meter_check` with those counted by hand and returns how many
/// agree.
///
/// # Errors
///
/// A line for each that differs, or the two numbers of samples if those differ.
pub fn check_hand_counted(samples: &[Sample]) -> Result<usize, String> {
    let pairs = by_hand().zip(samples.iter().map(|sample| sample.anywhere()));
    let differences: Vec<String> = pairs
        .filter(|((_, hand), meter)| hand != meter)
        .map(|((name, hand), meter)| format!("{name}: by hand {hand:?}, by the meter {meter:?}"))
        .collect();
    if !differences.is_empty() {
        return Err(differences.join("\n"));
    }
    let counted = by_hand().count();
    if samples.len() != counted {
        let measured = samples.len();
        return Err(format!("{counted} sequences were counted by hand, {measured} were measured"));
    }
    Ok(counted)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_agrees_with_itself_and_with_no_other() {
        let rows = HAND_COUNTED.lines().filter(|line| !line.starts_with('#'));
        let mut samples: Vec<Sample> = by_hand().map(|(_, sample)| sample).collect();
        assert_eq!(check_hand_counted(&samples), Ok(rows.count()));
        assert!(check_hand_counted(&samples[1..]).is_err());
        assert!(check_hand_counted(&samples[..samples.len() - 1]).is_err());
        assert!(check_hand_counted(&[&*samples, &samples[..1]].concat()).is_err());
        samples[1].cycles += 1;
        let said = "divide: by hand Sample \
                    { region: 0, instructions: 2, cycles: 13, flops: 0, waits: [0, 0], at: 0 }, by the meter \
                    Sample { region: 0, instructions: 2, cycles: 14, flops: 0, waits: [0, 0], at: 0 }";
        assert_eq!(check_hand_counted(&samples), Err(said.into()));
    }
}
