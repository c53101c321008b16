//! The cost of the profiles of a user's own project: the guide's table.

use std::path::Path;
use std::time::Duration;

use cycle_meter::{Sample, Summary};

use xtask::kit::elf::Image;
use xtask::kit::error::{Error, Result, check, refuse_if};
use xtask::kit::meter::{self, CLOCK_MHZ, MODEL};
use xtask::kit::qemu::Run;
use xtask::kit::setup::Tools;
use xtask::kit::table::{Column, Table, thousands};
use xtask::kit::toolchain::TARGET;
use xtask::kit::workspace::{self, Workspace};
use xtask::kit::{firmware, importer, shell};

/// The page that has the table.
pub const PAGE: &str = "docs/guide/src/firmware.md";

const ROBOT: &str = "tools/robot-import/tests/urdf/so101.urdf";
const PROJECT: &str = "own-arm";
/// A Cortex-M4F with a memory in which the largest project has room, and its memory.x.
const MACHINE: &str = "mps2-an386";
const MEMORY: &str = "\
MEMORY
{
  FLASH : ORIGIN = 0x00000000, LENGTH = 4M
  RAM   : ORIGIN = 0x20000000, LENGTH = 4M
}
";
/// The loop of the written project over its whole motion, and the one that is measured: a tick has
/// the same work whatever the data.
const LOOPS: [&str; 2] = ["for tick in 0..outcome.ticks {", "for tick in 0..200 {"];
/// The longest run took 30 s with other work beside it.
const LIMIT: Duration = Duration::from_secs(600);
/// The period of the project's tick, µs.
const PERIOD: f64 = 1e3;

/// Profiles: the name in the table, cargo's arguments, and whether the project's compiler flags
/// act.
#[rustfmt::skip]
const PROFILES: [(&str, &str, bool); 6] = [
    ("release as written: 3, fat LTO", "--release", true),
    (WITHOUT_FLAGS, "--release", false),
    ("release at s", "--release --config profile.release.opt-level='s'", true),
    ("dev as written: 1", "", true),
    ("dev at 3", "--config profile.dev.opt-level=3", true),
    ("dev at 0", "--config profile.dev.opt-level=0", true),
];
const WITHOUT_FLAGS: &str = "release without the compiler flags";

/// The cost of a project in a profile.
#[derive(Debug)]
pub struct Profile {
    name: &'static str,
    /// Cycles of the longest tick.
    tick: u64,
    /// Cycles of inverse dynamics.
    inverse_dynamics: u64,
    /// Bytes of all functions and their literals.
    code_bytes: u64,
    ticks: usize,
}

/// Writes a project, builds it in each profile, and runs it under the meter.
pub fn measure(workspace: &Workspace, tools: &Tools) -> Result<Vec<Profile>> {
    let scratch = tempfile::tempdir().map_err(Error::file("create", &workspace.target))?;
    let folder = scratch.path().join(PROJECT);
    let of_workspace = |path: &str| workspace.root.join(path).display().to_string();
    let words = [
        folder.display().to_string(),
        format!("--robot={}", of_workspace(ROBOT)),
        format!("--library={}", of_workspace("dynamics-core")),
    ];
    importer::command(workspace, "new", &words)?;
    workspace::write(&folder.join("memory.x"), MEMORY)?;
    let report = folder.join("src/report.rs");
    let whole = workspace::read(&report)?;
    refuse_if!(!whole.contains(LOOPS[0]), "{PROJECT} has no loop over its ticks");
    workspace::write(&report, whole.replace(LOOPS[0], LOOPS[1]))?;
    let meter = firmware::build_meter(workspace)?;
    let profiles = PROFILES.iter().map(|&(name, arguments, has_flags)| {
        let target = workspace.target.join("profiles");
        let mut cargo = tools.toolchain.cargo(workspace, "build");
        cargo.args(["--bin", PROJECT, "--target-dir"]).arg(&target);
        cargo.args(arguments.split_whitespace()).current_dir(&folder);
        cargo.envs((!has_flags).then_some(("RUSTFLAGS", "")));
        shell::capture(&mut cargo)?;
        let profile = ["debug", "release"][usize::from(arguments.contains("--release"))];
        let elf = target.join(TARGET).join(profile).join(PROJECT);
        measured(tools, &meter, name, &elf)
    });
    let profiles = profiles.collect::<Result<Vec<_>>>()?;
    for one in &profiles {
        let (ticks, all) = (one.ticks, profiles[0].ticks);
        refuse_if!(ticks != all, "`{}` made {ticks} of {all} ticks", one.name);
    }
    Ok(profiles)
}

fn measured(tools: &Tools, meter: &Path, name: &'static str, elf: &Path) -> Result<Profile> {
    let regions = elf.with_extension("regions");
    workspace::write(&regions, "")?;
    let run = Run::logging(PROJECT, elf, Some((meter, &regions)));
    // A run fails if a tick takes longer than its period; all of its ticks are measured
    // nevertheless, and counted above.
    let _ = tools.qemu.run_for(MACHINE, &run, LIMIT);
    let samples = meter::read(&regions)?;
    let longest = |region| {
        let spread = Summary::of_region(&samples, region, |one: &Sample| one.cycles);
        let spread = spread.ok_or_else(|| check!("`{name}` closed no region {region}"))?;
        Ok::<_, Error>(spread.max)
    };
    let functions = Image::read(elf)?.functions;
    let shown = |exact| match name.starts_with("dev at 0") {
        true => three_digits(exact),
        false => exact,
    };
    Ok(Profile {
        name,
        tick: shown(longest(0)?),
        inverse_dynamics: shown(longest(1)?),
        code_bytes: shown(functions.iter().map(|one| one.bytes.len() as u64).sum()),
        ticks: samples.iter().filter(|one| one.region == 0).count(),
    })
}

/// A figure without optimisation, rounded to three digits.
///
/// Further digits depend on the folder of the library: hashes of its path order the functions.
fn three_digits(exact: u64) -> u64 {
    let unit = 10_u64.pow(exact.checked_ilog10().unwrap_or(0).saturating_sub(2));
    (exact + unit / 2) / unit * unit
}

/// The part of the guide's page.
pub fn markdown(profiles: &[Profile]) -> String {
    let share = |one: &Profile| 100.0 * one.tick as f64 / (CLOCK_MHZ * PERIOD);
    let columns: [Column<'_, Profile>; 5] = [
        ("profile, opt-level", &|one| one.name.into()),
        ("longest tick, cycles", &|one| thousands(one.tick)),
        ("of 1 ms at 168 MHz", &|one| format!("{:.1} %", share(one))),
        ("inverse dynamics, cycles", &|one| thousands(one.inverse_dynamics)),
        ("code, bytes", &|one| thousands(one.code_bytes)),
    ];
    format!(
        "{}\nThe project that `cargo xtask new` writes for an SO-101, of six joints, with its \
         simulation ({MODEL}).",
        Table::of(profiles, &columns).markdown()
    )
}

#[cfg(test)]
mod tests {
    use super::three_digits;

    #[test]
    fn figures_that_differ_by_the_folder_are_shown_alike() {
        assert_eq!([1_507_914, 1_507_939].map(three_digits), [1_510_000; 2]);
        assert_eq!([0, 7, 999, 1_005].map(three_digits), [0, 7, 999, 1_010]);
    }
}
