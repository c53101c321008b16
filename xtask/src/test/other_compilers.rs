//! The step that builds the default scene and its robot's costs with rustup's other compilers.

use std::path::PathBuf;
use std::process::Command;

use super::other_machines::{COSTS, SCENE};
use super::{Context, Outcome};
use crate::budgets::{self, OTHER_RUSTC};
use crate::costs;
use crate::demo;
use crate::error::{Error, Result};
use crate::firmware;
use crate::scene::Scene;
use crate::shell;
use crate::toolchain::{self, RELEASE, TARGET, release};
use crate::workspace::FIRMWARE;

pub fn compilers(context: &Context) -> Result<Outcome> {
    if shell::which("rustup").is_none() {
        return Ok(Outcome::Skipped("there is no rustup".into()));
    }
    let own = context.tools.toolchain.rustc_version()?;
    let list = shell::capture(Command::new("rustup").args(["toolchain", "list"]))?;
    let oldest = env!("CARGO_PKG_RUST_VERSION");
    let mut names: Vec<&str> = list
        .lines()
        .filter_map(|line| line.split(' ').next())
        .collect();
    // What should be there stands in the outcome if it is not.
    let is_there = |wanted: &str| names.iter().any(|name| name.starts_with(wanted));
    let mut seen: Vec<String> = [oldest, "stable"]
        .into_iter()
        .filter(|wanted| !is_there(wanted))
        .map(|wanted| format!("{wanted} is not there: `rustup toolchain install {wanted}`"))
        .collect();
    names.sort_unstable();
    let mut ran = false;
    let mut done = vec![own.clone()];
    for name in names {
        let compiler = match Compiler::find(name) {
            Ok(compiler) => compiler,
            Err(error) => {
                seen.push(format!("{name}: {error}"));
                continue;
            }
        };
        if done.contains(&compiler.version) {
            continue;
        }
        if release(&compiler.version) < release(oldest) {
            seen.push(format!("{} is older than {oldest}", compiler.version));
            continue;
        }
        done.push(compiler.version.clone());
        seen.push(match compiler.lack() {
            Some(lack) => format!("{}: {lack}", compiler.version),
            None => {
                ran = true;
                compiler.run(context)?
            }
        });
    }
    let seen = seen.join("; ");
    Ok(if ran {
        Outcome::Passed(seen)
    } else {
        Outcome::Skipped(format!("all of this ran with {own}; {seen}"))
    })
}

/// A toolchain of rustup's.
struct Compiler<'a> {
    name: &'a str,
    version: String,
}

impl<'a> Compiler<'a> {
    fn find(name: &'a str) -> Result<Self> {
        let version = shell::capture(rustup_run(name, "rustc").arg("--version"))?;
        Ok(Self {
            name,
            version: version.trim().to_owned(),
        })
    }

    /// Why it cannot build the firmware.
    fn lack(&self) -> Option<String> {
        let (precompiled, sources) = self.cores();
        (!precompiled && !sources).then(|| {
            format!(
                "no core library for {TARGET}: `rustup target add --toolchain {} {TARGET}`",
                self.name
            )
        })
    }

    /// Whether it has a core library for the target, and the sources of one.
    fn cores(&self) -> (bool, bool) {
        let printed = |what: &[&str]| {
            let out = shell::capture(rustup_run(self.name, "rustc").arg("--print").args(what));
            out.map(|out| PathBuf::from(out.trim())).unwrap_or_default()
        };
        let libraries = printed(&["target-libdir", "--target", TARGET]);
        let sources = printed(&["sysroot"]).join("lib/rustlib/src/rust/library/core/Cargo.toml");
        (toolchain::has_core(&libraries), sources.is_file())
    }

    /// Builds the scene and the costs, runs them, and says how far the costs are from the usual compiler's.
    fn run(&self, context: &Context) -> Result<String> {
        let target = context.workspace.target.join("compilers").join(self.name);
        let mut command = rustup_run(self.name, "cargo");
        command.args([
            "build",
            "--release",
            "--package",
            FIRMWARE,
            "--target",
            TARGET,
        ]);
        command.args(["--bin", SCENE, "--bin", COSTS, "--target-dir"]);
        command.arg(&target).current_dir(&context.workspace.root);
        if !self.cores().0 {
            command.arg("-Zbuild-std=core").env("RUSTC_BOOTSTRAP", "1");
        }
        shell::cargo(&mut command)?;
        let elf = |bin: &str| target.join(TARGET).join(RELEASE).join(bin);
        let (tools, meter) = (&context.tools, context.meter()?);
        let toolchain = tools.toolchain;
        let scene = Scene::default();
        let mut measured = demo::measure(
            &context.workspace,
            tools,
            scene,
            toolchain,
            &elf(SCENE),
            meter,
        )?;
        measured.report.rustc.clone_from(&self.version);
        let spare = budgets::check(&context.workspace, &measured.report)?;
        let usual = firmware::build(&context.workspace, toolchain, COSTS)?;
        let (usual, _) = costs::run_bin(tools, meter, COSTS, &usual)?;
        let (these, _) = costs::run_bin(tools, meter, COSTS, &elf(COSTS))?;
        let rows = these.iter().map(|row| (row.key(), row.cycles.max));
        let worst = apart(usual.iter().map(|row| (row.key(), row.cycles.max)), rows)?;
        Ok(format!(
            "{}: {spare}, costs at most {:.2} % apart",
            self.version,
            100.0 * worst
        ))
    }
}

/// The largest share by which a cost differs from the one of the same name.
fn apart(
    usual: impl Iterator<Item = (String, u64)>,
    these: impl Iterator<Item = (String, u64)>,
) -> Result<f64> {
    let mut worst = 0.0;
    for ((name, usual), (other, these)) in std::iter::zip(usual, these) {
        let share = (these as f64 / usual as f64 - 1.0).abs();
        if name != other || share.is_nan() || share > OTHER_RUSTC {
            return Err(Error::check(format!(
                "`{name}` takes {usual} cycles with the usual compiler, `{other}` {these} with this one"
            )));
        }
        worst = f64::max(worst, share);
    }
    Ok(worst)
}

/// A program of a toolchain, rid of what the cargo that started xtask left in the environment.
fn rustup_run(toolchain: &str, program: &str) -> Command {
    let mut command = Command::new("rustup");
    command.args(["run", toolchain, program]);
    for name in [
        "CARGO",
        "LD_LIBRARY_PATH",
        "RUSTC",
        "RUSTDOC",
        "RUSTUP_TOOLCHAIN",
        "RUST_RECURSION_COUNT",
    ] {
        command.env_remove(name);
    }
    command
}

#[cfg(test)]
mod tests {
    use super::apart;

    #[test]
    fn a_cost_that_moved_too_far_is_found() {
        let rows = |cycles: u64| [("rnea".to_owned(), 1000), ("crba".to_owned(), cycles)];
        let far = |cycles| apart(rows(1000).into_iter(), rows(cycles).into_iter());
        assert!((far(1004).expect("close") - 0.004).abs() < 1e-12);
        let error = far(1100).expect_err("too far").to_string();
        assert!(error.contains("`crba` takes 1000"), "{error}");
    }
}
