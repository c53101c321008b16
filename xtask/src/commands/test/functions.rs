//! The steps about the firmware's code: what it consists of, what it computes, and what its
//! functions cost.

use cycle_meter::Sample;

use super::{Context, others};
use crate::kit::callgraph::f32_only;
use crate::kit::elf::Image;
use crate::kit::error::{Error, Result, bail, check, refuse_if};
use crate::kit::host_bin::{self, SHARED};
use crate::kit::meter::{self, Cost};
use crate::kit::qemu::Run;
use crate::kit::{firmware, importer};

/// The least number of hard cases in QEMU.
const HARD_CASES: usize = 25;
/// Whether a symbol is `firmware_demo::scene::marked_tick`, which is there once for each control
/// law.
fn is_tick(symbol: &str) -> bool {
    symbol.contains("marked_tick")
}

/// The description of the robot that is imported.
const IMPORTED: &str = "tools/robot-import/tests/urdf/so101.urdf";

pub fn build(context: &Context) -> Result<String> {
    let (workspace, tools) = (&context.workspace, &context.tools);
    firmware::build_all(workspace, tools.toolchain)?;
    let folder = tempfile::tempdir().map_err(Error::file("create", &workspace.target))?;
    let path = workspace.root.join(IMPORTED).to_string_lossy().into_owned();
    let robot = importer::import(workspace, &[&path], folder.path().join("robot.rs"))?;
    importer::measure(workspace, tools, &[&robot])?;
    others::guide(context)?;
    Ok(workspace.bins.join(", "))
}

pub fn meter(context: &Context) -> Result<String> {
    let (_, samples) = context.metered("meter_check", false)?;
    let agreeing = cycle_meter::check_hand_counted(&samples).map_err(Error::Check)?;
    Ok(format!("{agreeing} sequences"))
}

/// The lines of a bin of the firmware in QEMU that begin so, and those of the host's bin of its
/// name; all must be the same.
fn on_both(context: &Context, name: &str, begin: &str) -> Result<Vec<String>> {
    let elf = context.built(name)?;
    let mut on_target = context.tools.qemu.lines(&Run::logging(name, &elf, None))?;
    on_target.retain(|line| line.starts_with(begin));
    host_bin::same_lines(name, &on_target, &SHARED.text(&context.workspace, name)?)?;
    Ok(on_target)
}

pub fn bits(context: &Context) -> Result<String> {
    of_hard_cases(&on_both(context, "bits", "bits ")?)
}

/// Fails unless the lines are of enough hard cases.
fn of_hard_cases(lines: &[String]) -> Result<String> {
    let hard = lines.iter().filter_map(|line| line.strip_prefix("bits hard "));
    let mut cases: Vec<_> = hard.map(|case| case.split(' ').next()).collect();
    cases.dedup();
    let (digests, count) = (lines.len(), cases.len());
    refuse_if!(count < HARD_CASES, "`bits` ran {count} of at least {HARD_CASES} hard cases");
    Ok(format!("{digests} digests, {count} hard cases among them"))
}

/// Runs of the firmware's bin `fault_runs`.
const FAULT_RUNS: usize = 100;

pub fn faults(context: &Context) -> Result<String> {
    within_limits(&on_both(context, "fault_runs", "run ")?)
}

/// Fails unless every run kept its limits.
fn within_limits(runs: &[String]) -> Result<String> {
    let mut faults = 0;
    for run in runs {
        let injected = run
            .split_once(" faults ")
            .and_then(|(run, _)| run.rsplit(' ').next()?.parse::<usize>().ok());
        let Some(injected) = injected else {
            bail!("a limit did not hold: {run}");
        };
        faults += injected;
    }
    let count = runs.len();
    refuse_if!(count != FAULT_RUNS, "`fault_runs` made {count} runs, not {FAULT_RUNS}");
    Ok(format!("{count} runs with {faults} faults"))
}

pub fn no_f64(context: &Context) -> Result<String> {
    let (mut reached, mut instructions) = (0, 0);
    for measured in context.measured()? {
        reached += f32_only(&measured.elf, is_tick)?;
        instructions += Image::read(&measured.elf)?.m4f_instructions()?;
    }
    Ok(format!("{reached} functions reached, {instructions} instructions"))
}

pub fn constant(context: &Context) -> Result<String> {
    let (lines, samples) = context.metered("constant_time", true)?;
    let mut kinds = Vec::new();
    for line in &lines {
        let words: Vec<&str> = line.split(' ').collect();
        if let [word @ ("constant" | "bounded"), name, states] = *words {
            let bad = |_| check!("the line {line:?} cannot be understood");
            kinds.push(Kind {
                name: name.to_owned(),
                states: states.parse().map_err(bad)?,
                constant: word == "constant",
            });
        }
    }
    Ok(steady(&kinds, &samples)?.join(", "))
}

/// Work that was done on this many states.
struct Kind {
    name: String,
    states: usize,
    /// Whether it must cost the same each time; else its maximum is reported.
    constant: bool,
}

/// The instructions of each kind of work.
fn steady(kinds: &[Kind], mut samples: &[Sample]) -> Result<Vec<String>> {
    let (mut costs, mut unsteady) = (Vec::new(), false);
    for kind in kinds {
        let (mine, rest) = samples
            .split_at_checked(kind.states)
            .ok_or_else(|| check!("the cycle meter saw fewer calls than were made"))?;
        samples = rest;
        let cost = Cost::of(mine.iter().map(meter::passage))?;
        let (name, least, most) = (&kind.name, cost.instructions.min, cost.instructions.max);
        unsteady |= kind.constant && least != most;
        costs.push(match least == most {
            true => format!("{name} {most}"),
            false => format!("{name} {least} to {most}"),
        });
    }
    refuse_if!(
        kinds.is_empty() || !samples.is_empty(),
        "the cycle meter saw more calls than were made"
    );
    refuse_if!(unsteady, "the instructions depend on the data: {}", costs.join(", "));
    Ok(costs)
}

#[cfg(test)]
mod tests {
    use cycle_meter::Sample;

    use super::{Kind, steady};
    use crate::kit::elf::{is_f64, is_panic};
    use crate::kit::host_bin::same_lines;

    #[test]
    fn panics_and_f64_are_known_by_their_symbols() {
        for symbol in [
            "_ZN4core9panicking5panic17h0123456789abcdefE",
            "_RNvNtCs1_4core9panicking9panic_fmt",
            "_ZN4core6option13unwrap_failed17h0123456789abcdefE",
            "_ZN4core5slice5index24slice_end_index_len_fail17h0123456789abcdefE",
            "_ZN4core5slice5index16slice_index_fail17h0123456789abcdefE",
        ] {
            assert!(is_panic(symbol), "{symbol}");
        }
        assert!(!is_panic("_ZN13dynamics_core7control10supervisor4pass17hE"));
        let f64s =
            "__aeabi_dadd __muldf3 __extendsfdf2 __fixdfsi sinf rem_pio2 _ZN4libm4math5k_cosf17hE";
        assert!(f64s.split(' ').all(is_f64));
        let others = "_ZN4libm4math5atanf5atanf17hE __aeabi_fadd __aeabi_memcpy \
            _ZN13dynamics_core4trig7sin_cosE";
        assert!(!others.split(' ').any(is_f64));
    }

    #[test]
    fn a_differing_or_missing_line_is_named() {
        let lines: Vec<String> = (0..25).map(|k| format!("bits hard {k} a 0{k:x}")).collect();
        let host = lines.join("\n");
        let same = |there: &[String], here: &str| same_lines("bits", there, here);
        assert!(same(&lines, &host).is_ok());
        assert!(same(&lines[..24], &host).is_err() && same(&[], "").is_err());
        let other = host.replace("7 a 07", "7 a 06");
        let error = same(&lines, &other).expect_err("another bit").to_string();
        assert!(error.contains("host: bits hard 7 a 06"), "{error}");
        assert!(super::of_hard_cases(&lines).is_ok());
        assert!(super::of_hard_cases(&lines[..24]).is_err());
    }

    #[test]
    fn a_failing_or_missing_run_fails_the_step() {
        let line = |k| format!("run {k} pendulum 7 faults 0{k:x}");
        let mut runs: Vec<String> = (0..100).map(line).collect();
        let said = super::within_limits(&runs).unwrap();
        assert_eq!(said, "100 runs with 700 faults");
        assert!(super::within_limits(&runs[..99]).is_err());
        runs[3] = "run 3 pendulum joint 0: speed 4 rad/s".into();
        let error = super::within_limits(&runs).expect_err("too fast");
        assert!(error.to_string().contains("limit"), "{error}");
    }

    #[test]
    fn work_that_varies_is_named() {
        let samples = [5, 5, 7, 8].map(|instructions| Sample::of(0, [instructions, 10, 0]));
        let kind = |name: &str, constant| Kind { name: name.into(), states: 2, constant };
        let kinds = [kind("law", true), kind("gate", true)];
        let message = steady(&kinds, &samples).expect_err("varies").to_string();
        assert!(message.contains("law 5, gate 7 to 8"), "{message}");
        let costs = steady(&kinds[..1], &samples[..2]).expect("steady");
        assert_eq!(costs, ["law 5"]);
        let bounded = [kind("law", true), kind("reentry", false)];
        let costs = steady(&bounded, &samples).expect("steady but for the bounded");
        assert_eq!(costs, ["law 5", "reentry 7 to 8"]);
        assert!(steady(&kinds[..1], &samples).is_err());
        assert!(steady(&kinds, &samples[..3]).is_err());
    }
}
