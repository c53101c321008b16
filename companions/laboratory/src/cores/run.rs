//! Builds the replay for a core, runs it, and reads what it wrote.

use std::path::PathBuf;
use std::time::Duration;

use super::list::{self, Core};
use super::walk;
use crate::MANIFEST;
use xtask::kit::elf::Image;
use xtask::kit::error::{Result, check, refuse_if};
use xtask::kit::qemu::Qemu;
use xtask::kit::shell;
use xtask::kit::toolchain::RELEASE;
use xtask::kit::workspace::Workspace;

const PACKAGE: &str = "cores";
/// The time limit of a core in QEMU.
const LIMIT: Duration = Duration::from_secs(300);

/// The bits of a scene's torques.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Torques {
    pub scene: String,
    pub ticks: usize,
    /// The digest of all torques' bits.
    pub digest: String,
}

#[derive(Debug)]
pub struct Replayed {
    pub torques: Torques,
    /// The bytes of stack that a tick wrote to, at most.
    pub stack: u64,
    /// The stack that no tick exceeds, from the machine code of a Cortex-M.
    pub bound: Option<u64>,
}

#[derive(Debug)]
pub struct Row {
    pub core: &'static str,
    /// The scenes, the small one first.
    pub scenes: Vec<Replayed>,
}

#[derive(Debug, Default, PartialEq, Eq)]
pub struct Said {
    torques: Vec<Torques>,
    stacks: Vec<u64>,
    ticks_at: Vec<u64>,
}

impl Said {
    /// From its lines.
    ///
    /// # Errors
    /// A line is not of the protocol, or the last one is not `done`.
    pub fn read(text: &str) -> Result<Self> {
        let mut said = Self::default();
        let mut is_done = false;
        for line in text.lines() {
            let bad = || check!("the line {line:?} of `{PACKAGE}` cannot be understood");
            refuse_if!(is_done, "`{PACKAGE}` went on after its end: {line:?}");
            match line.split(' ').collect::<Vec<_>>()[..] {
                ["digest", scene, ticks, digest] => said.torques.push(Torques {
                    scene: scene.into(),
                    ticks: ticks.parse().map_err(|_| bad())?,
                    digest: digest.into(),
                }),
                ["stack", _, bytes] => said.stacks.push(bytes.parse().map_err(|_| bad())?),
                ["tick", _, at] => said.ticks_at.push(at.parse().map_err(|_| bad())?),
                ["done"] => is_done = true,
                _ => return Err(bad()),
            }
        }
        refuse_if!(!is_done || said.torques.is_empty(), "`{PACKAGE}` did not end: {text:?}");
        Ok(said)
    }
}

/// The torques of this machine, which no emulator computes.
pub fn on_host(workspace: &Workspace) -> Result<Vec<Torques>> {
    let mut command = workspace.cargo("run");
    command.args(["--quiet", "--manifest-path", MANIFEST, "--package", PACKAGE]);
    command.arg("--target-dir").arg(workspace.target.join(PACKAGE));
    Ok(Said::read(&shell::capture(&mut command)?)?.torques)
}

/// Builds the bin for a core.
pub fn build(workspace: &Workspace, core: &Core) -> Result<PathBuf> {
    let mut flags: Vec<String> = core.flags.iter().map(ToString::to_string).collect();
    // Cargo calls the linker in the folder of the workspace.
    for script in [format!("machines/{}.x", core.machine), "link.x".into()] {
        flags.push(format!("-Clink-arg=-T{PACKAGE}/{script}"));
    }
    flags.extend(list::short_paths(workspace));
    // Apart from other firmware of the same targets, whose flags differ.
    let target = workspace.target.join(PACKAGE);
    let mut command = workspace.cargo("build");
    command
        .args(["--manifest-path", MANIFEST, "--profile", RELEASE])
        .args(["--package", PACKAGE])
        .args(["--target", core.target, "--target-dir"])
        .arg(&target)
        // Instead of those of `.cargo/config.toml`, which has another linker script.
        .env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}"));
    shell::capture(&mut command)?;
    Ok(target.join(core.target).join(RELEASE).join(PACKAGE))
}

/// Builds and runs the bin on a core.
pub fn measure(workspace: &Workspace, core: &Core) -> Result<Row> {
    let elf = build(workspace, core)?;
    let qemu = Qemu::first(core.qemu().0)?;
    let text = qemu.text(core.name, &core.machine_arguments(), &elf, LIMIT)?;
    let said = Said::read(&text)?;
    let image = Image::read(&elf)?;
    let count = said.torques.len();
    refuse_if!(
        [said.stacks.len(), said.ticks_at.len()] != [count; 2],
        "`{PACKAGE}` did not print stack and tick of each scene: {text:?}"
    );
    let mut scenes = Vec::new();
    for ((torques, stack), at) in said.torques.into_iter().zip(said.stacks).zip(said.ticks_at) {
        let bound = match core.is_risc_v() {
            true => None,
            false => Some(
                walk::stack(&image, at)
                    .map_err(|e| check!("{}, {}: {e}", core.name, torques.scene))?,
            ),
        };
        refuse_if!(
            bound.is_some_and(|bound| bound < stack),
            "{}, {}: a tick wrote to {stack} B of stack, more than the bound of its code, \
             {bound:?}",
            core.name,
            torques.scene
        );
        scenes.push(Replayed { torques, stack, bound });
    }
    Ok(Row { core: core.name, scenes })
}

#[cfg(test)]
mod tests {
    use super::Said;

    #[test]
    fn a_bin_that_ends_without_done_is_refused() {
        let text = "digest small 2 00ff\nstack small 200\ntick small 4096\ndone\n";
        let said = Said::read(text).expect("a protocol");
        assert_eq!((said.torques[0].ticks, &*said.torques[0].digest), (2, "00ff"));
        assert_eq!((said.stacks, said.ticks_at), (vec![200], vec![4096]));
        for bad in [
            "",
            "done\n",
            "digest small 2 00ff\n",
            "digest small two 00ff\ndone\n",
            "panicked at cores/src/main.rs\n",
            "digest small 2 00ff\ndone\nstack small 200\n",
        ] {
            assert!(Said::read(bad).is_err(), "{bad:?}");
        }
    }
}
