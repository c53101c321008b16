//! What the program prints, and the rows of the page.

use serde::Serialize;

use crate::kit::error::{Result, bail, check, refuse_if};

/// A line of the program: of an algorithm or of a tick.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Line {
    /// Robot, algorithm, form and sines; or the scene alone.
    name: Vec<String>,
    cycles: u64,
    instructions: u64,
    digest: String,
}

/// All that the program printed.
#[derive(Debug)]
pub struct Said(Vec<Line>);

/// An algorithm or a tick, with the cycles for each latency of the FPU.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Robot, algorithm, form and sines; or the scene alone.
    pub name: Vec<String>,
    /// Whether sums of products are contracted.
    pub contracted: bool,
    pub cycles: Vec<u64>,
    pub instructions: u64,
}

impl Said {
    /// From its lines.
    ///
    /// # Errors
    /// A line is not of the protocol, or the last one is not `done`.
    pub fn read(text: &str) -> Result<Self> {
        let mut lines = Vec::new();
        let mut is_done = false;
        for line in text.lines() {
            let bad = || check!("the line {line:?} of `gates` cannot be understood");
            refuse_if!(is_done, "`gates` went on after its end: {line:?}");
            let words: Vec<&str> = line.split(' ').collect();
            let (name, counts) = match words[..] {
                ["done"] => {
                    is_done = true;
                    continue;
                }
                ["row", ..] if words.len() == 8 => words[1..].split_at(4),
                ["tick", ..] if words.len() == 5 => words[1..].split_at(1),
                _ => return Err(bad()),
            };
            let number = |at: usize| counts[at].parse().map_err(|_| bad());
            lines.push(Line {
                name: name.iter().map(ToString::to_string).collect(),
                cycles: number(0)?,
                instructions: number(1)?,
                digest: counts[2].into(),
            });
        }
        refuse_if!(!is_done || lines.is_empty(), "`gates` did not end: {text:?}");
        Ok(Self(lines))
    }
}

/// Fails unless two processors compute the same bits in every line.
pub fn same_bits(one: &str, a: &Said, other: &str, b: &Said) -> Result<()> {
    refuse_if!(a.0.len() != b.0.len(), "{one} prints other lines than {other}");
    for (a, b) in a.0.iter().zip(&b.0) {
        if (&a.name, &a.digest) != (&b.name, &b.digest) {
            bail!(
                "{one} computes other bits than {other}: {} {}, {} {}",
                a.name.join(" "),
                a.digest,
                b.name.join(" "),
                b.digest
            );
        }
    }
    Ok(())
}

/// One row for the lines of all latencies, whose instructions must be the same.
pub fn joined(said: &[Said], contracted: bool) -> Result<Vec<Row>> {
    let Some((first, others)) = said.split_first() else {
        return Ok(Vec::new());
    };
    let rows = first.0.iter().enumerate().map(|(at, line)| {
        let others = others.iter().filter_map(|said| said.0.get(at));
        let all: Vec<&Line> = std::iter::once(line).chain(others).collect();
        let is_same = |other: &&Line| other.instructions == line.instructions;
        refuse_if!(!all.iter().all(is_same), "{:?} executes other instructions", line.name);
        Ok(Row {
            name: line.name.clone(),
            contracted,
            cycles: all.iter().map(|line| line.cycles).collect(),
            instructions: line.instructions,
        })
    });
    rows.collect()
}

#[cfg(test)]
mod tests {
    use super::{Said, joined, same_bits};

    const TEXT: &str = "row ur5e rnea core inside 12 10 00ff\ntick ur5e 30 20 12ab\ndone\n";

    #[test]
    fn a_program_that_ends_without_done_is_refused() {
        Said::read(TEXT).expect("a protocol");
        for bad in ["", "done\n", &TEXT[..TEXT.len() - 5], &TEXT.replace("12 10", "12 x")] {
            Said::read(bad).expect_err(bad);
        }
    }

    #[test]
    fn another_bit_or_another_path_is_refused() {
        let said = |text: &str| Said::read(text).expect("a protocol");
        let other = said(&TEXT.replace("12ab", "12aa"));
        same_bits("a", &said(TEXT), "b", &said(TEXT)).expect("the same");
        same_bits("a", &said(TEXT), "b", &other).expect_err("another bit");
        let slower = said(&TEXT.replace("ur5e 30", "ur5e 40"));
        let rows = joined(&[said(TEXT), slower], false).expect("the same instructions");
        assert_eq!(rows[1].cycles, [30, 40]);
        let longer = said(&TEXT.replace("30 20", "30 21"));
        joined(&[said(TEXT), longer], false).expect_err("other instructions");
    }
}
