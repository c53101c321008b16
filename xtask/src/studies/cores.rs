//! `cargo xtask cores`: the control loop of two scenes on four cores that QEMU emulates. The
//! torques must have the same bits on all of them and on the host, and the stack of a tick a bound.

mod boards;
mod frame;
mod list;
mod page;
mod placed;
mod run;
mod walk;

use std::process::ExitCode;

use serde::Serialize;

use crate::kit::bars;
use crate::kit::error::{Error, Result, bail, check, refuse_if};
use crate::kit::progress::Spinner;
use crate::kit::setup::{self, Options};
use crate::kit::toolchain::Toolchain;
use crate::kit::workspace::Workspace;
use crate::kit::{docs, output};
use crate::studies::budgets;
use crate::studies::study::Bench;
use boards::Board;
pub use list::{CORES, Core, short_paths};
use page::PAGE;
use placed::Placed;
use run::{Row, Torques};

#[derive(Clone, Copy, clap::Args)]
pub struct Args {
    /// The measurements as JSON on stdout; progress stays on stderr
    #[arg(long)]
    json: bool,
    /// Rewrite the tables of docs/boards.md; needs every core
    #[arg(long)]
    write_docs: bool,
}

#[derive(Serialize)]
struct Report {
    /// The torques of the host, which are those of every core.
    torques: Vec<Torques>,
    rows: Vec<Row>,
    boards: Vec<Board>,
    placed: Placed,
    rustc: String,
}

/// Builds and runs every core that can be, prints what the others lack, and writes the page if
/// wanted.
pub fn run(options: Options, args: Args) -> Result<ExitCode> {
    let workspace = Workspace::for_reports()?;
    setup::for_demo(options)?;
    let mut cores = Vec::new();
    for core in &CORES {
        match core.missing().as_slice() {
            [] => cores.push(core),
            commands => {
                let how = commands.join("\n    ");
                output::note(&format!("skipped: {}; it needs\n    {how}", core.name));
            }
        }
    }
    let boards = boards::missing();
    for target in &boards {
        output::note(&format!(
            "skipped: images of boards; they need\n    rustup target add {target}"
        ));
    }
    refuse_if!(
        args.write_docs && (cores.len() < CORES.len() || !boards.is_empty()),
        "the page has every core and every board, and some are missing here"
    );
    let report = Report::measure(&workspace, &cores)?;
    let text = report.markdown()?;
    if args.write_docs {
        PAGE.write(&workspace, &text)?;
    }
    docs::show(args.json, &report, &text)
}

/// Fails unless the cores compute the host's torques, with as much stack as the page says.
///
/// # Errors
/// Also [`Error::Skipped`], if none of them can be run here.
pub fn check(bench: &Bench<'_>) -> Result<String> {
    let (workspace, options) = (bench.workspace, bench.options);
    let (mut targets, packages) = list::needed();
    targets.extend(boards::missing());
    targets.sort_unstable();
    targets.dedup();
    // A core whose tools cannot be installed is skipped below, with the missing tools named.
    let _ = setup::for_cores(options, &targets, &packages);
    let (cores, lacking): (Vec<&Core>, Vec<&Core>) =
        CORES.iter().partition(|core| core.missing().is_empty());
    let boards = boards::missing();
    let add = |target: &&str| format!("rustup target add {target}");
    let lacks = lacking.iter().flat_map(|core| core.missing());
    let lacks: Vec<String> = lacks.chain(boards.iter().map(add)).collect();
    if cores.is_empty() {
        return Err(Error::Skipped(format!("not installed: {}", lacks.join(", "))));
    }
    Report::measure(workspace, &cores)?;
    let names: Vec<&str> = cores.iter().map(|core| core.name).collect();
    let skipped = lacks.iter().map(|lack| format!("; skipped: {lack}"));
    Ok(format!("{}{}", names.join(", "), skipped.collect::<String>()))
}

/// Fails unless a core computes the same bits as the host.
fn same_bits(core: &str, torques: &[&Torques], host: &[Torques]) -> Result<()> {
    refuse_if!(
        torques.len() != host.len(),
        "{core} runs {} scenes and the host {}",
        torques.len(),
        host.len()
    );
    for (there, here) in std::iter::zip(torques, host) {
        if *there != here {
            bail!(
                "{core} computes other torques than the host:\n  {core}: {there:?}\n  host: \
                 {here:?}"
            );
        }
    }
    Ok(())
}

impl Report {
    fn measure(workspace: &Workspace, cores: &[&Core]) -> Result<Self> {
        let torques = run::on_host(workspace)?;
        let bars = budgets::bars(workspace)?;
        let mut rows = Vec::new();
        for core in cores {
            let _spinner = Spinner::start(&format!("{} in QEMU", core.name));
            let row = run::measure(workspace, core)?;
            let mine: Vec<&Torques> = row.scenes.iter().map(|scene| &scene.torques).collect();
            same_bits(core.name, &mine, &torques)?;
            for scene in &row.scenes {
                let (tick, stack) =
                    (format!("{} tick", scene.torques.scene), scene.bound.unwrap_or(scene.stack));
                bars::hold(&bars, &tick, [("stack_bytes", stack as f64)])
                    .map_err(|error| check!("{}, {error}", core.name))?;
            }
            rows.push(row);
        }
        Ok(Self {
            torques,
            rows,
            boards: boards::measure(workspace, &bars)?,
            placed: Placed::measure(workspace, &bars)?,
            rustc: Toolchain::Native.rustc_version()?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Torques, same_bits};

    fn torques(scene: &str, digest: &str) -> Torques {
        Torques { scene: scene.into(), ticks: 10, digest: digest.into() }
    }

    #[test]
    fn a_core_whose_torques_differ_in_a_bit_is_refused() {
        let host = [torques("small", "00ff"), torques("ur5e", "12ab")];
        let [small, ur5e] = &host;
        assert!(same_bits("M33", &[small, ur5e], &host).is_ok());
        let other = torques("ur5e", "12aa");
        let error = same_bits("M33", &[small, &other], &host).expect_err("another bit");
        assert!(error.to_string().contains("12aa"), "{error}");
        assert!(same_bits("M33", &[small], &host).is_err());
        let shorter = Torques { ticks: 9, ..ur5e.clone() };
        assert!(same_bits("M33", &[small, &shorter], &host).is_err());
    }
}
