//! The step that runs the default scene and its robot's costs on another QEMU.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::{Context, Outcome};
use crate::error::{Error, Result};
use crate::firmware;
use crate::qemu::{Qemu, Run};
use crate::shell;
use crate::toolchain::{RELEASE, release};
use crate::workspace::{self, Workspace};

/// What is built: the default scene, and the costs of its robot.
pub(super) const SCENE: &str = "ur5e";
pub(super) const COSTS: &str = "costs_ur5e";

/// The Debian whose backports have a newer QEMU.
const SUITE: &str = "bookworm";
const PACKAGE: &str = "qemu-system-arm";
const KEYS: &str = "/usr/share/keyrings/debian-archive-keyring.gpg";

pub fn qemu_10(context: &Context) -> Result<Outcome> {
    let os = std::fs::read_to_string("/etc/os-release").unwrap_or_default();
    if !os
        .lines()
        .any(|line| line == format!("VERSION_CODENAME={SUITE}"))
    {
        return Ok(Outcome::Skipped(format!(
            "not on Debian 12, whose backports have it; here is {}",
            context.tools.qemu.version
        )));
    }
    let program = match unpacked(&context.workspace) {
        Ok(program) => program,
        Err(error) => {
            return Ok(Outcome::Skipped(format!(
                "cannot be had from Debian's backports: {error}"
            )));
        }
    };
    let newer = Qemu::at(program)?;
    let meter = context.meter()?;
    let names = [SCENE, COSTS];
    let toolchain = context.tools.toolchain;
    let elves = firmware::build_bins(&context.workspace, toolchain, RELEASE, &names)?;
    let mut samples = 0;
    for (name, elf) in std::iter::zip(names, &elves) {
        let here = raw(context, &context.tools.qemu, meter, name, elf)?;
        let there = raw(context, &newer, meter, name, elf)?;
        samples += same(name, &here, &there)?;
    }
    Ok(Outcome::Passed(format!(
        "{} and {}: {samples} samples",
        context.tools.qemu.version, newer.version
    )))
}

/// The log and the meter's file of a run.
fn raw(
    context: &Context,
    qemu: &Qemu,
    meter: &Path,
    name: &str,
    elf: &Path,
) -> Result<(Vec<u8>, String)> {
    let (major, _) = release(&qemu.version);
    let out = context.workspace.output(&format!("{name}.qemu-{major}"))?;
    let run = Run {
        name,
        elf,
        meter: Some((meter, &out)),
        logs: true,
    };
    Ok((qemu.run(&run, |_| Ok(()))?, workspace::read(&out)?))
}

/// How many samples two runs have in common, which are all.
fn same(name: &str, here: &(Vec<u8>, String), there: &(Vec<u8>, String)) -> Result<usize> {
    if here.0 != there.0 {
        return Err(Error::check(format!(
            "{name}: the two QEMUs logged different bytes"
        )));
    }
    let mut lines = std::iter::zip(here.1.lines(), there.1.lines()).enumerate();
    if let Some((at, (one, other))) = lines.find(|(_, (one, other))| one != other) {
        return Err(Error::check(format!(
            "{name}: line {} of the samples is `{one}` here and `{other}` there",
            at + 1
        )));
    }
    if here.1 != there.1 {
        return Err(Error::check(format!(
            "{name}: the two QEMUs gave different numbers of samples"
        )));
    }
    Ok(here.1.lines().count().saturating_sub(1))
}

/// The newer QEMU, unpacked beside the one that is installed; it needs the same libraries.
fn unpacked(workspace: &Workspace) -> Result<PathBuf> {
    let dir = workspace.target.join("qemu-backports");
    let program = dir.join("root/usr/bin").join(PACKAGE);
    if shell::succeeds(Command::new(&program).arg("--version")) {
        return Ok(program);
    }
    for part in ["lists/partial", "archives/partial"] {
        let part = dir.join(part);
        std::fs::create_dir_all(&part).map_err(Error::file("create", &part))?;
    }
    let sources = dir.join("sources.list");
    let line =
        format!("deb [signed-by={KEYS}] http://deb.debian.org/debian {SUITE}-backports main\n");
    workspace::write(&sources, line)?;
    let apt = |arguments: &[&str]| {
        let mut command = Command::new("apt-get");
        for (option, value) in [
            ("Dir::Etc::sourcelist", sources.as_path()),
            ("Dir::Etc::sourceparts", Path::new("-")),
            ("Dir::State::lists", &dir.join("lists")),
            ("Dir::Cache", &dir),
            // It would be another user, who may not write here.
            ("APT::Sandbox::User", Path::new("root")),
        ] {
            command
                .arg("-o")
                .arg(format!("{option}={}", value.display()));
        }
        command.args(arguments).current_dir(dir.join("archives"));
        shell::capture(&mut command)
    };
    apt(&["update"])?;
    apt(&["download", &format!("{PACKAGE}/{SUITE}-backports")])?;
    let archives = dir.join("archives");
    let files = std::fs::read_dir(&archives).map_err(Error::file("read", &archives))?;
    for file in files.flatten().map(|entry| entry.path()) {
        if file.extension().is_some_and(|ending| ending == "deb") {
            shell::capture(
                Command::new("dpkg")
                    .arg("-x")
                    .arg(&file)
                    .arg(dir.join("root")),
            )?;
        }
    }
    // QEMU would otherwise load the modules of the installed one, and end.
    let modules = dir
        .join("root/usr/lib")
        .join(format!("{}-linux-gnu/qemu", std::env::consts::ARCH));
    std::fs::create_dir_all(&modules).map_err(Error::file("create", &modules))?;
    Ok(program)
}

#[cfg(test)]
mod tests {
    use super::same;

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
}
