//! `cargo xtask silicon`: the cycle model beside cycles that others measured on Cortex-M4F chips.
//!
//! Their code is none of ours and is not built here: the command takes images that were built elsewhere, with
//! markers around each call, and measures them by the three readings of the manual.

mod page;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use serde::Deserialize;

use crate::kit::docs::Page;
use crate::kit::error::{Result, check, refuse_if};
use crate::kit::progress::Spinner;
use crate::kit::qemu::MACHINE;
use crate::kit::setup::{self, Options, Tools};
use crate::kit::table::plain;
use crate::kit::workspace::Workspace;
use crate::kit::{firmware, meter, output};

const PAGE: Page<'_> = Page {
    file: "docs/silicon.md",
    name: "silicon",
    command: "cargo xtask silicon --images DIR",
};
/// The published cycles, with the code that they are for.
const LIST: &str = include_str!("silicon/list.toml");
/// The readings of the manual, as the plugin takes them; the chosen one has no name.
const READINGS: [&str; 3] = [",reading=least", "", ",reading=most"];
/// The time limit of an image.
const LIMIT: Duration = Duration::from_secs(120);

#[derive(clap::Args)]
pub struct Args {
    /// The directory with NAME.elf for each image of the page
    #[arg(long, value_name = "DIR")]
    images: PathBuf,
}

/// The images, each of one source.
#[derive(Deserialize)]
struct List {
    image: Vec<Image>,
}

/// An image and where its code and the cycles come from.
#[derive(Deserialize)]
struct Image {
    name: String,
    repository: String,
    commit: String,
    licence: String,
    board: String,
    /// Whether its routines are sequences of one or two instructions, and none that does something.
    #[serde(default)]
    sequences: bool,
    /// The number of times that the overhead of a measurement, region 1, is part of a routine's published cycles.
    #[serde(default)]
    overhead: f64,
    /// In the order in which the image closes region 0.
    routine: Vec<Routine>,
}

/// A routine and its cycles on the chip.
#[derive(Deserialize)]
struct Routine {
    name: String,
    kind: String,
    published: f64,
    /// Blocks of a call, if the published cycles are those of a block.
    #[serde(default = "one")]
    per: f64,
}

fn one() -> f64 {
    1.0
}

/// The cycles of a routine by the three readings.
type Cycles = [f64; 3];

/// Measures, writes the page and prints its table.
pub fn run(options: Options, args: Args) -> Result<ExitCode> {
    let workspace = Workspace::for_reports()?;
    let tools = setup::for_demo(options)?;
    let list = list()?;
    let spinner = Spinner::start("building the cycle meter");
    let plugin = firmware::build_meter(&workspace)?;
    let measure = |image| measure(&workspace, &tools, &plugin, &args.images, image);
    let cycles = list.image.iter().map(measure).collect::<Result<Vec<_>>>()?;
    drop(spinner);
    let text = page::text(&list, &cycles);
    PAGE.write(&workspace, &text)?;
    output::print(&plain(&text))?;
    Ok(ExitCode::SUCCESS)
}

fn list() -> Result<List> {
    toml_edit::de::from_str(LIST).map_err(|error| check!("silicon/list.toml: {error}"))
}

/// The cycles of each routine of an image.
fn measure(
    workspace: &Workspace,
    tools: &Tools,
    plugin: &Path,
    dir: &Path,
    image: &Image,
) -> Result<Vec<Cycles>> {
    let elf = dir.join(format!("{}.elf", image.name));
    let out = workspace.output(&format!("silicon-{}.regions", image.name))?;
    let mut all = vec![Cycles::default(); image.routine.len()];
    for (index, reading) in READINGS.into_iter().enumerate() {
        let argument = format!("out={}{reading}", out.display());
        let machine = ["-machine", MACHINE];
        tools
            .qemu
            .text(&image.name, &machine, &elf, (plugin, &argument), LIMIT)?;
        let samples = meter::read(&out)?;
        let found = image.cycles(samples.iter().map(|one| (one.region, one.cycles)))?;
        for (cycles, found) in all.iter_mut().zip(found) {
            cycles[index] = found;
        }
    }
    Ok(all)
}

impl Image {
    /// The cycles of each routine, from those of all passages.
    fn cycles(&self, passages: impl Iterator<Item = (u8, u64)>) -> Result<Vec<f64>> {
        let (calls, others): (Vec<_>, Vec<_>) = passages.partition(|(region, _)| *region == 0);
        let (found, expected) = (calls.len(), self.routine.len());
        let name = &self.name;
        refuse_if!(
            found != expected,
            "{name}.elf passes region 0 {found} times, but has {expected} routines"
        );
        let own = others.first().map_or(0.0, |(_, cycles)| *cycles as f64);
        refuse_if!(
            others.is_empty() != (self.overhead == 0.0),
            "{name}.elf has region 1 without need, or lacks it"
        );
        let one = |((_, cycles), routine): (&(u8, u64), &Routine)| {
            (*cycles as f64 + self.overhead * own) / routine.per
        };
        Ok(calls.iter().zip(&self.routine).map(one).collect())
    }
}
