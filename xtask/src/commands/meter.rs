//! `cargo xtask meter ELF`: what a user's own firmware costs between its markers.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use cycle_meter::Sample;
use serde::Serialize;

use crate::kit::elf::Image;
use crate::kit::error::{Error, Result, bail, check};
use crate::kit::meter::{self, CHIPS, IN_FLASH, MODEL, Spread};
use crate::kit::progress::Spinner;
use crate::kit::qemu::{MACHINE, Run};
use crate::kit::setup::{self, Options};
use crate::kit::table::{Table, thousands};
use crate::kit::workspace::Workspace;
use crate::kit::{docs, firmware, output};

/// The instructions that mark a region, for the help and for a firmware without marks.
pub const MARKERS: &str = include_str!("markers.txt");

#[derive(clap::Args)]
pub struct Args {
    /// The firmware, with its symbols
    #[arg(value_name = "ELF")]
    elf: PathBuf,
    /// The board that QEMU emulates
    #[arg(long, default_value = MACHINE, value_name = "NAME")]
    machine: String,
    /// Stop it after this many seconds
    #[arg(long, default_value_t = 10, value_name = "N")]
    seconds: u64,
    /// The measurements as JSON on stdout; progress stays on stderr
    #[arg(long)]
    json: bool,
}

/// The cost of a region; the fields are those of the JSON.
#[derive(Debug, PartialEq, Eq, Serialize)]
struct Region {
    region: u8,
    calls: usize,
    instructions: Spread,
    cycles: Spread,
    /// The cycles from the flash of each of the chips.
    in_flash: [Spread; 2],
    flops: Spread,
}

#[derive(Debug, Serialize)]
struct Report {
    model: &'static str,
    /// Whether it ended by itself.
    ended: bool,
    regions: Vec<Region>,
    /// Functions with an instruction that a Cortex-M4F lacks, and its address.
    foreign: Vec<Foreign>,
}

/// An instruction that a Cortex-M4F lacks.
#[derive(Debug, Serialize)]
struct Foreign {
    function: String,
    address: String,
}

pub fn run(options: Options, args: &Args) -> Result<ExitCode> {
    let image = image(&args.elf)?;
    let workspace = Workspace::find()?;
    let tools = setup::for_demo(options)?;
    let name = args.elf.file_name().unwrap_or(args.elf.as_os_str());
    let name = name.to_string_lossy();
    let spinner = Spinner::start("building the cycle meter");
    let plugin = firmware::build_meter(&workspace)?;
    tools.qemu.interface(&plugin)?;
    let out = workspace.output(&format!("{name}.{}.regions", std::process::id()))?;
    let meter = Some((plugin.as_path(), out.as_path()));
    spinner.say(format!("running {name} in QEMU"));
    let limit = Duration::from_secs(args.seconds);
    let mut run = Run::logging(&name, &args.elf, meter);
    run.logs = image.has_defmt;
    let ended = tools.qemu.run_for(&args.machine, &run, limit);
    drop(spinner);
    let samples = ended.and_then(|ended| Ok((ended, meter::read(&out)?)));
    // Not there if QEMU did not start.
    let _ = std::fs::remove_file(&out);
    let (ended, samples) = samples?;
    let report =
        Report { model: MODEL, ended, regions: regions(&samples), foreign: foreign(&image) };
    if report.regions.is_empty() {
        let when = ["in its time", "before it ended"][usize::from(ended)];
        let seconds = args.seconds;
        bail!(
            "{name} has markers, but closed no region {when}: is it built for a board with flash \
             at 0x08000000, does it wait for a device that QEMU lacks, or does it need more than \
             --seconds {seconds}?"
        );
    }
    if args.json {
        docs::print_json(&report)?;
    } else {
        output::print(&report.text(&name, args.seconds))?;
    }
    let number = report.foreign.len();
    match report.foreign.first() {
        None => Ok(ExitCode::SUCCESS),
        Some(Foreign { function, address }) => Err(check!(
            "{number} instructions are none of a Cortex-M4F, the first at {address} in \
             `{function}`: build with --target thumbv7em-none-eabihf and the flags of \
             docs/guide/src/firmware.md"
        )),
    }
}

/// The ELF, if it is one that can be measured.
fn image(elf: &Path) -> Result<Image> {
    let wrong = |what: &str| Err(check!("{}: {what}", elf.display()));
    let bytes = std::fs::read(elf).map_err(Error::file("read", elf))?;
    if !bytes.starts_with(b"\x7fELF") {
        return wrong(
            "this is no ELF file: give the one that cargo builds, \
             target/thumbv7em-none-eabihf/release/NAME, not a .bin or .hex made of it",
        );
    }
    let image = Image::read(elf)?;
    if !image.is_arm {
        return wrong(
            "this is for another processor: build it with --target thumbv7em-none-eabihf",
        );
    }
    if image.functions.is_empty() {
        return wrong("it has no symbols of functions: build it without `strip`");
    }
    if !image.instructions().any(|(_, one)| one.insn.is_marker()) {
        return wrong(&format!("it has no markers.\n\n{MARKERS}"));
    }
    Ok(image)
}

fn regions(samples: &[Sample]) -> Vec<Region> {
    let of = |region: u8| {
        let spread = |what| Spread::of_region(samples, region, what);
        Some(Region {
            region,
            calls: samples.iter().filter(|one| one.region == region).count(),
            instructions: spread(|one| one.instructions)?,
            cycles: spread(|one| one.cycles)?,
            in_flash: [spread(|one| one.all_cycles()[1])?, spread(|one| one.all_cycles()[2])?],
            flops: spread(|one| one.flops)?,
        })
    };
    (0..8).filter_map(of).collect()
}

fn foreign(image: &Image) -> Vec<Foreign> {
    let foreign = image.instructions().filter(|(_, one)| one.is_beyond_m4f());
    let named = foreign.map(|(function, one)| Foreign {
        function: function.names.join(" = "),
        address: format!("{:#x}", one.address),
    });
    named.collect()
}

impl Report {
    fn text(&self, name: &str, seconds: u64) -> String {
        let [first, second] = CHIPS;
        let head = format!(
            "region,calls,insn min,median,max,cycles min,median,max,{first} median,max,\
             {second} median,max,flops max"
        );
        let mut table = Table::new(&head.split(',').collect::<Vec<_>>());
        for region in &self.regions {
            let mut figures = vec![region.calls as u64];
            for spread in [region.instructions, region.cycles] {
                figures.extend([spread.min, spread.median, spread.max]);
            }
            figures.extend(region.in_flash.iter().flat_map(|flash| [flash.median, flash.max]));
            figures.push(region.flops.max);
            let cells = figures.into_iter().map(thousands);
            table.row(std::iter::once(region.region.to_string()).chain(cells));
        }
        let stopped = format!(", stopped after {seconds} s");
        let end = if self.ended { "" } else { &stopped };
        let mut text = format!("{name}{end} ({}; {IN_FLASH})\n\n{}", self.model, table.text());
        for Foreign { function, address } in &self.foreign {
            text += &format!("  not of a Cortex-M4F: {address} in `{function}`\n");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use cycle_meter::Sample;

    use super::regions;

    #[test]
    fn each_region_has_its_own_line() {
        let sample = |region, cycles| Sample::of(region, [10, cycles, 3]);
        let regions = regions(&[sample(0, 12), sample(3, 7), sample(0, 20), sample(0, 13)]);
        assert_eq!(regions.len(), 2);
        let cycles = regions[0].cycles;
        assert_eq!((cycles.min, cycles.median, cycles.max), (12, 13, 20));
        assert_eq!((regions[0].calls, regions[1].region), (3, 3));
    }
}
