//! The control loop of two scenes on four cores that QEMU emulates. The torques must have the same
//! bits on all of them and on the host, and the stack of a tick a bound.

mod boards;
mod frame;
mod list;
mod page;
mod placed;
mod run;
mod walk;

use xtask::kit::bars;
use xtask::kit::error::{Result, bail, check, refuse_if};
use xtask::kit::progress::Spinner;
use xtask::studies::budgets;
use xtask::studies::study::Bench;

use crate::page::Part;
use boards::Board;
pub use list::{CORES, Core, risc_v, set_up, short_paths};
use placed::Placed;
use run::{Row, Torques};

/// The page of cores and boards.
const PAGE: &str = "companions/laboratory/docs/boards.md";

struct Report {
    /// The torques of the host, which are those of every core.
    torques: Vec<Torques>,
    rows: Vec<Row>,
    boards: Vec<Board>,
    placed: Placed,
}

/// Builds and runs every core, and builds every image.
///
/// # Errors
/// Among others, a core computes another bit than the host, or a stack or an image is beyond its bar.
pub fn measure(bench: &Bench<'_>) -> Result<Vec<Part>> {
    let cores: Vec<&Core> = CORES.iter().collect();
    set_up(bench.options, &cores, &boards::targets())?;
    let text = Report::measure(bench)?.markdown()?;
    Ok(vec![Part { file: PAGE, name: "cores", text }])
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
    fn measure(bench: &Bench<'_>) -> Result<Self> {
        let workspace = bench.workspace;
        let torques = run::on_host(workspace)?;
        let bars = budgets::bars(workspace)?;
        let mut rows = Vec::new();
        for core in &CORES {
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
            placed: Placed::measure(bench)?,
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
