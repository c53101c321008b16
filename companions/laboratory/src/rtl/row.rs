//! What the program prints, and the rows of the page.

use super::Build;
use xtask::kit::error::{Result, bail, check, refuse_if};

/// A line of the program: of an algorithm or of a tick.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Line {
    /// Robot, algorithm, form and sines; or the scene alone.
    name: Vec<String>,
    cycles: u64,
    instructions: u64,
    digest: String,
}

/// Torques: robot, form and state, or robot and state of those in f64.
#[derive(Clone, Debug)]
struct Torques {
    name: Vec<String>,
    bits: Vec<u64>,
}

/// All that the program printed.
#[derive(Debug)]
pub struct Said {
    lines: Vec<Line>,
    torques: Vec<Torques>,
    exact: Vec<Torques>,
}

/// The largest error of a robot's torques, and the largest torque, in N·m.
#[derive(Clone, Debug)]
pub struct Worst {
    /// Robot and form.
    pub name: Vec<String>,
    pub build: Build,
    pub error: f64,
    pub largest: f64,
}

/// An algorithm or a tick, with the cycles for each latency of the FPU.
#[derive(Clone, Debug)]
pub struct Row {
    /// Robot, algorithm, form and sines; or the scene alone.
    pub name: Vec<String>,
    pub build: Build,
    pub cycles: Vec<u64>,
}

impl Said {
    /// From its lines.
    ///
    /// # Errors
    /// A line is not of the protocol, or the last one is not `done`.
    pub fn read(text: &str) -> Result<Self> {
        let (mut lines, mut torques, mut exact) = (Vec::new(), Vec::new(), Vec::new());
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
                ["torques", ref name @ .., bits] if name.len() == 3 => {
                    torques.push(Torques::read(name, bits).ok_or_else(bad)?);
                    continue;
                }
                ["exact", ref name @ .., bits] if name.len() == 2 => {
                    exact.push(Torques::read(name, bits).ok_or_else(bad)?);
                    continue;
                }
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
        Ok(Self { lines, torques, exact })
    }
}

impl Torques {
    fn read(name: &[&str], bits: &str) -> Option<Self> {
        let bits = bits.split(',').map(|bits| u64::from_str_radix(bits, 16).ok());
        let name = name.iter().map(ToString::to_string).collect();
        Some(Self { name, bits: bits.collect::<Option<_>>()? })
    }
}

/// The largest error of each robot and form, from the torques in f64 that the host printed.
///
/// # Errors
/// It did not print those of a state.
pub fn worst(said: &Said, host: &Said, build: Build) -> Result<Vec<Worst>> {
    let mut all: Vec<Worst> = Vec::new();
    for torques in &said.torques {
        let [robot, form, state] = &torques.name[..] else {
            bail!("no form of torques: {:?}", torques.name);
        };
        let exact = host.exact.iter().find(|exact| exact.name == [&**robot, &**state]);
        let exact = exact.filter(|exact| exact.bits.len() == torques.bits.len());
        let exact = exact.ok_or_else(|| check!("no exact torques of {robot}, state {state}"))?;
        let name = vec![robot.clone(), form.clone()];
        if all.last().is_none_or(|last| last.name != name) {
            all.push(Worst { name, build, error: 0.0, largest: 0.0 });
        }
        let Some(worst) = all.last_mut() else { continue };
        for (tau, exact) in torques.bits.iter().zip(&exact.bits) {
            let bits = u32::try_from(*tau).map_err(|_| check!("{robot} has torques beyond f32"))?;
            let (tau, exact) = (f64::from(f32::from_bits(bits)), f64::from_bits(*exact));
            let error = (tau - exact).abs();
            refuse_if!(!error.is_finite(), "{robot} {form} has no torque in state {state}");
            worst.error = worst.error.max(error);
            worst.largest = worst.largest.max(exact.abs());
        }
    }
    Ok(all)
}

/// Fails unless `a` has the bits that `b` has in its line of the same name.
pub fn same_bits(one: &str, a: &Said, other: &str, b: &Said) -> Result<()> {
    for line in &a.lines {
        let name = line.name.join(" ");
        let found = b.lines.iter().find(|found| found.name == line.name);
        let theirs = &found.ok_or_else(|| check!("{other} has no {name}"))?.digest;
        let ours = &line.digest;
        if ours != theirs {
            bail!("{one} computes other bits than {other}: {name} {ours}, not {theirs}");
        }
    }
    Ok(())
}

/// One row for the lines of all latencies, whose instructions must be the same.
pub fn joined(said: &[Said], build: Build) -> Result<Vec<Row>> {
    let Some((first, others)) = said.split_first() else {
        return Ok(Vec::new());
    };
    let rows = first.lines.iter().enumerate().map(|(at, line)| {
        let others = others.iter().filter_map(|said| said.lines.get(at));
        let all: Vec<&Line> = std::iter::once(line).chain(others).collect();
        let is_same = |other: &&Line| other.instructions == line.instructions;
        refuse_if!(!all.iter().all(is_same), "{:?} executes other instructions", line.name);
        Ok(Row {
            name: line.name.clone(),
            build,
            cycles: all.iter().map(|line| line.cycles).collect(),
        })
    });
    rows.collect()
}

#[cfg(test)]
mod tests {
    use super::{Build, Said, joined, same_bits, worst};

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
        let fewer = said("tick ur5e 30 20 12ab\ndone\n");
        same_bits("a", &fewer, "b", &said(TEXT)).expect("a part");
        same_bits("a", &said(TEXT), "b", &fewer).expect_err("a missing line");
        let slower = said(&TEXT.replace("ur5e 30", "ur5e 40"));
        let rows = joined(&[said(TEXT), slower], Build::Scheduled).expect("the same instructions");
        assert_eq!(rows[1].cycles, [30, 40]);
        let longer = said(&TEXT.replace("30 20", "30 21"));
        joined(&[said(TEXT), longer], Build::Scheduled).expect_err("other instructions");
    }
    #[test]
    fn an_error_is_counted_from_the_torques_in_f64() {
        let said = |text: &str| Said::read(&(text.to_owned() + TEXT)).expect("a protocol");
        // 1.0 and 2.0 in f32; 1.5 and -3.0 in f64.
        let image = said("torques ur5e core 0 3f800000,40000000\n");
        let host = said("exact ur5e 0 3ff8000000000000,c008000000000000\n");
        let worst_of = |image, host| worst(image, host, Build::Fused);
        let all = worst_of(&image, &host).expect("torques");
        assert_eq!((all.len(), all[0].error, all[0].largest), (1, 5.0, 3.0));
        worst_of(&image, &image).expect_err("none in f64");
        let no_number = said("torques ur5e core 0 7fc00000,40000000\n");
        worst_of(&no_number, &host).expect_err("NaN");
        Said::read("torques ur5e core 0 x\ndone\n").expect_err("no number");
    }
}
