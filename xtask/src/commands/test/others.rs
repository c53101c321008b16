//! The steps about other compilers and another QEMU than this machine's: the default scene and the costs of its
//! robot, built by Debian's compiler and by rustup's others, and run in a newer QEMU.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::Context;
use crate::commands::demo;
use crate::kit::bars::OTHER_RUSTC;
use crate::kit::error::{Error, Result, refuse_if};
use crate::kit::qemu::{Qemu, Run};
use crate::kit::scene::Scene;
use crate::kit::system::{Privilege, System};
use crate::kit::toolchain::{self, DEBIAN_PACKAGES, RELEASE, TARGET, Toolchain, release};
use crate::kit::workspace::{self, FIRMWARE, Workspace};
use crate::kit::{apt, firmware, host_bin::SHARED, rows, setup, shell};
use crate::studies::budgets;

/// The bins that are built: the default scene, and the costs of its robot.
const SCENE: &str = "ur5e";
const COSTS: &str = "costs_ur5e";

/// The Debian whose backports have a newer QEMU.
const SUITE: &str = "bookworm";
const PACKAGE: &str = "qemu-system-arm";
const KEYS: &str = "/usr/share/keyrings/debian-archive-keyring.gpg";

fn skip<T>(why: impl Into<String>) -> Result<T> {
    Err(Error::Skipped(why.into()))
}

/// The oldest compiler, as the library's manifest promises it.
const MSRV: &str = "1.88.0";

/// The library with the oldest compiler, which rustup installs if it is not there.
pub fn msrv(context: &Context) -> Result<String> {
    let list = shell::capture(Command::new("rustup").args(["toolchain", "list"]));
    let list = list.or_else(|_| skip("there is no rustup"))?;
    if !list.contains(MSRV) && !context.options.no_install {
        let install = "toolchain install --profile minimal --no-self-update".split(' ');
        shell::capture(Command::new("rustup").args(install).arg(MSRV))
            .or_else(|_| skip(format!("{MSRV} is not there")))?;
    }
    let check = "check --package dynamics-core --package motion-control --package joint-drivers --package telemetry --all-features --target-dir target/msrv".split(' ');
    let mut cargo = toolchain::rustup(MSRV, "cargo");
    shell::capture(cargo.current_dir(&context.workspace.root).args(check))?;
    Ok(format!("rustc {MSRV}"))
}

/// The target of the projects for a Pico 2; those for other boards have the firmware's.
const PICO_2: &str = "thumbv8m.main-none-eabihf";

/// The guide's programs, and the servo bus on a serial port of Embassy where the target of its chip can be had.
pub fn guide(context: &Context) -> Result<String> {
    context.cargo(&["check --package guide-firmware --target thumbv7em-none-eabihf"])?;
    if !toolchain::native_has(PICO_2) {
        setup::for_cores(context.options, &[PICO_2], &[])
            .or_else(|_| skip(format!("no {PICO_2}")))?;
    }
    context.cargo(&[format!(
        "check --package pico2-embassy --bins --target {PICO_2}"
    )])?;
    Ok(String::new())
}

/// The projects that `robot-import new` writes, of a pendulum and of an arm, two libraries for C in one program, and firmware for
/// each board.
pub fn projects(context: &Context) -> Result<String> {
    if setup::for_projects(context.options).is_err() {
        return skip("there is no arm-none-eabi-gcc, make, cmake or cc");
    }
    let lacks = || !toolchain::native_has(PICO_2);
    // Without it, the boards are left out.
    let _ = lacks().then(|| setup::for_cores(context.options, &[PICO_2], &[]));
    let boards = if lacks() { "" } else { "project::the_boards" };
    context.cargo(&[&format!(
        "test {} --test import -- --ignored --test-threads 1 project::a_pendulum project::an_arm project::two_robots_in_c {boards}",
        SHARED.words(context.full)
    )])?;
    Ok(boards.to_owned())
}

/// The plug-in for LeRobot on a simulated bus.
pub fn lerobot(context: &Context) -> Result<String> {
    context.workspace.python()?;
    let folder = "python/lerobot_teleoperator_so101_floating";
    let script = context.workspace.root.join(folder).join("test.sh");
    let scene = context.workspace.output("so101_floating.json")?;
    workspace::write(&scene, SHARED.text(&context.workspace, "so101_floating")?)?;
    let test = |words: &[&str]| {
        let mut script = Command::new(&script);
        shell::capture(script.args(words).env("SO101_FLOATING_SCENE", &scene))
    };
    test(&["--prepare"]).or_else(|error| skip(format!("LeRobot cannot be had: {error}")))?;
    Ok(test(&[])?.lines().last().unwrap_or_default().to_owned())
}

pub fn debian(context: &Context) -> Result<String> {
    if context.tools.toolchain == Toolchain::Debian {
        return skip("all of this ran with it");
    }
    if System::this() != System::Debian {
        return skip("not on Debian");
    }
    if let Some(lack) = toolchain::debian_lacks() {
        if !context.may_install_debian {
            return skip(format!("{lack}; `cargo xtask test --debian` installs it"));
        }
        if !Privilege::this().needs_no_password() {
            return skip(format!("{lack}, and may not install it"));
        }
        if !DEBIAN_PACKAGES.iter().all(|name| apt::knows(name)) {
            return skip(format!("{lack}, and apt has none"));
        }
    }
    // Whoever may install it has been asked: by --debian.
    let mut options = context.options;
    (options.yes, options.no_install) = (context.may_install_debian, false);
    let toolchain = setup::debian(options)?;
    let elf = firmware::build(&context.workspace, toolchain, SCENE)?;
    let version = toolchain.rustc_version()?;
    let spare = budgets_kept(context, &elf, &version)?;
    Ok(format!("{version}: {spare}"))
}

/// Runs the default scene and says how far it is within its budgets, as what a compiler made.
fn budgets_kept(context: &Context, elf: &Path, rustc: &str) -> Result<String> {
    let (workspace, tools, meter) = (&context.workspace, &context.tools, context.meter()?);
    let mut measured = demo::measure(workspace, tools, Scene::default(), elf, meter)?;
    measured.report.rustc = rustc.to_owned();
    budgets::check(workspace, &measured.report)
}

pub fn compilers(context: &Context) -> Result<String> {
    if shell::which("rustup").is_none() {
        return skip("there is no rustup");
    }
    let own = context.tools.toolchain.rustc_version()?;
    let list = shell::capture(Command::new("rustup").args(["toolchain", "list"]))?;
    let oldest = env!("CARGO_PKG_RUST_VERSION");
    let firsts = list.lines().filter_map(|line| line.split(' ').next());
    let mut names: Vec<&str> = firsts.collect();
    names.sort_unstable();
    // A missing toolchain is listed in the outcome.
    let mut wanted = vec![oldest, "stable"];
    wanted.retain(|wanted| !names.iter().any(|name| name.starts_with(wanted)));
    let lacks = |name| format!("{name} is not there: `rustup toolchain install {name}`");
    let mut outcomes: Vec<String> = wanted.into_iter().map(lacks).collect();
    let mut ran = false;
    let mut done = vec![own.clone()];
    for name in names {
        let version = match shell::capture(toolchain::rustup(name, "rustc").arg("--version")) {
            Ok(version) => version.trim().to_owned(),
            Err(error) => {
                outcomes.push(format!("{name}: {error}"));
                continue;
            }
        };
        if done.contains(&version) {
            continue;
        }
        if release(&version) < release(oldest) {
            outcomes.push(format!("{version} is older than {oldest}"));
            continue;
        }
        let verdict = match cores(name) {
            (false, false) => {
                let add = format!("rustup target add --toolchain {name} {TARGET}");
                format!("no core library for {TARGET}: `{add}`")
            }
            (precompiled, _) => {
                ran = true;
                built_by(context, name, &version, precompiled)?
            }
        };
        outcomes.push(format!("{version}: {verdict}"));
        done.push(version);
    }
    let outcomes = outcomes.join("; ");
    if ran {
        Ok(outcomes)
    } else {
        skip(format!("all of this ran with {own}; {outcomes}"))
    }
}

/// Whether a toolchain has a core library for the target, and the sources of one.
fn cores(name: &str) -> (bool, bool) {
    let printed = |what: &str| {
        let mut rustc = toolchain::rustup(name, "rustc");
        let out = shell::capture(rustc.arg("--print").args(what.split(' ')));
        out.map(|out| PathBuf::from(out.trim())).unwrap_or_default()
    };
    let libraries = printed(&format!("target-libdir --target {TARGET}"));
    let has_sources = toolchain::has_sources(&printed("sysroot"));
    (toolchain::has_core(&libraries), has_sources)
}

/// Builds the scene and the costs, runs them, and says how far the costs are from the usual compiler's.
fn built_by(context: &Context, name: &str, version: &str, precompiled: bool) -> Result<String> {
    let target = context.workspace.target.join("compilers").join(name);
    let mut command = toolchain::rustup(name, "cargo");
    command.args(["build", "--release", "--target", TARGET]);
    command.args(FIRMWARE.iter().flat_map(|name| ["--package", name]));
    command.args(["--bin", SCENE, "--bin", COSTS, "--target-dir"]);
    command.arg(&target).current_dir(&context.workspace.root);
    if !precompiled {
        command.arg("-Zbuild-std=core").env("RUSTC_BOOTSTRAP", "1");
    }
    shell::cargo(&mut command)?;
    let elf = |bin: &str| target.join(TARGET).join(RELEASE).join(bin);
    let spare = budgets_kept(context, &elf(SCENE), version)?;
    let [usual, these] =
        [context.built(COSTS)?, elf(COSTS)].map(|elf| -> Result<Vec<(String, u64)>> {
            let (rows, _) = rows::run(&context.tools, context.meter()?, COSTS, &elf)?;
            Ok(rows.iter().map(|row| (row.key(), row.cycles.max)).collect())
        });
    let worst = apart(usual?.into_iter(), these?.into_iter())?;
    let percent = 100.0 * worst;
    Ok(format!("{spare}, costs at most {percent:.2} % apart"))
}

/// The largest share by which a cost differs from the one of the same name.
fn apart(
    usual: impl Iterator<Item = (String, u64)>,
    these: impl Iterator<Item = (String, u64)>,
) -> Result<f64> {
    let mut worst = 0.0;
    for ((name, usual), (other, these)) in std::iter::zip(usual, these) {
        let share = (these as f64 / usual as f64 - 1.0).abs();
        let is_apart = name != other || share.is_nan() || share > OTHER_RUSTC;
        refuse_if!(
            is_apart,
            "`{name}` takes {usual} cycles with the usual compiler, `{other}` {these} with this one"
        );
        worst = f64::max(worst, share);
    }
    Ok(worst)
}

pub fn qemu_10(context: &Context) -> Result<String> {
    let own = &context.tools.qemu;
    let os = std::fs::read_to_string("/etc/os-release").unwrap_or_default();
    let suite = format!("VERSION_CODENAME={SUITE}");
    if !os.lines().any(|line| line == suite) {
        let here = format!("here is {}", own.version);
        return skip(format!("not on Debian 12, whose backports have it; {here}"));
    }
    let cannot = |error| Error::Skipped(format!("cannot be had from Debian's backports: {error}"));
    let newer = Qemu::at(unpacked(&context.workspace).map_err(cannot)?)?;
    let names = [SCENE, COSTS];
    let elves = firmware::build_bins(&context.workspace, context.tools.toolchain, RELEASE, &names)?;
    let mut samples = 0;
    for (name, elf) in std::iter::zip(names, &elves) {
        let here = raw(context, own, name, elf)?;
        samples += same(name, &here, &raw(context, &newer, name, elf)?)?;
    }
    let (old, new) = (&own.version, &newer.version);
    Ok(format!("{old} and {new}: {samples} samples"))
}

/// The log and the meter's file of a run.
fn raw(context: &Context, qemu: &Qemu, name: &str, elf: &Path) -> Result<(Vec<u8>, String)> {
    let (major, _) = release(&qemu.version);
    let out = context.workspace.output(&format!("{name}.qemu-{major}"))?;
    let meter = Some((context.meter()?.as_path(), out.as_path()));
    let log = qemu.run(&Run::logging(name, elf, meter), |_| Ok(()))?;
    Ok((log, workspace::read(&out)?))
}

/// The number of samples of two runs; an error if one differs.
fn same(name: &str, here: &(Vec<u8>, String), there: &(Vec<u8>, String)) -> Result<usize> {
    refuse_if!(
        here.0 != there.0,
        "{name}: the two QEMUs logged different bytes"
    );
    let [these, those] = [&here.1, &there.1].map(|samples| samples.lines().collect::<Vec<_>>());
    for (at, (one, other)) in std::iter::zip(&these, &those).enumerate() {
        let line = at + 1;
        refuse_if!(
            one != other,
            "{name}: line {line} of the samples is `{one}` here and `{other}` there"
        );
    }
    let is_other = these.len() != those.len();
    refuse_if!(
        is_other,
        "{name}: the two QEMUs gave different numbers of samples"
    );
    Ok(these.len().saturating_sub(1))
}

/// The newer QEMU, unpacked beside the one that is installed; it needs the same libraries.
fn unpacked(workspace: &Workspace) -> Result<PathBuf> {
    let dir = workspace.target.join("qemu-backports");
    let root = dir.join("root");
    let program = root.join("usr/bin").join(PACKAGE);
    if shell::succeeds(Command::new(&program).arg("--version")) {
        return Ok(program);
    }
    for part in ["lists/partial", "archives/partial"] {
        let part = dir.join(part);
        std::fs::create_dir_all(&part).map_err(Error::file("create", &part))?;
    }
    let (sources, archives) = (dir.join("sources.list"), dir.join("archives"));
    let line =
        format!("deb [signed-by={KEYS}] http://deb.debian.org/debian {SUITE}-backports main\n");
    workspace::write(&sources, line)?;
    let options = [
        format!("Dir::Etc::sourcelist={}", sources.display()),
        "Dir::Etc::sourceparts=-".into(),
        format!("Dir::State::lists={}", dir.join("lists").display()),
        format!("Dir::Cache={}", dir.display()),
        // Another user, as whom apt-get would work otherwise, may not write here.
        "APT::Sandbox::User=root".into(),
    ];
    let options: Vec<String> = options
        .into_iter()
        .flat_map(|option| ["-o".into(), option])
        .collect();
    shell::capture(Command::new("apt-get").args(&options).arg("update"))?;
    let package = format!("{PACKAGE}/{SUITE}-backports");
    apt::unpack(&root, &archives, &[package], &options)?;
    Ok(program)
}

#[cfg(test)]
mod tests {
    use super::{apart, same};

    #[test]
    fn a_cost_that_moved_too_far_is_found() {
        let rows = |cycles: u64| [("rnea".to_owned(), 1000), ("crba".to_owned(), cycles)];
        let far = |cycles| apart(rows(1000).into_iter(), rows(cycles).into_iter());
        assert!((far(1004).expect("close") - 0.004).abs() < 1e-12);
        let error = far(1100).expect_err("too far").to_string();
        assert!(error.contains("`crba` takes 1000"), "{error}");
    }

    #[test]
    fn one_sample_that_differs_is_found() {
        let run = |log: &[u8], samples: &str| (log.to_vec(), samples.to_owned());
        let here = run(b"log", "head\n0 1 2 3\n0 1 2 4\n");
        assert_eq!(same("x", &here, &here).expect("the same"), 2);
        for (there, why) in [
            (run(b"lag", "head\n0 1 2 3\n0 1 2 4\n"), "different bytes"),
            (run(b"log", "head\n0 1 2 3\n0 1 2 5\n"), "line 3"),
            (run(b"log", "head\n0 1 2 3\n"), "different numbers"),
        ] {
            let error = same("x", &here, &there).expect_err(why).to_string();
            assert!(error.contains(why), "{error}");
        }
    }

    #[test]
    fn the_oldest_compiler_is_the_one_that_the_manifest_promises() {
        let manifest = include_str!("../../../../dynamics-core/Cargo.toml");
        let promised = super::MSRV.trim_end_matches(".0");
        assert!(manifest.contains(&format!("rust-version = \"{promised}\"")));
    }
}
