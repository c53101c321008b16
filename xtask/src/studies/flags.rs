//! `cargo xtask flags`: what other flags of the compiler cost, and which functions of Rust's own crates a tick contains.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use addr2line::gimli::{Dwarf, EndianSlice, LittleEndian};
use object::{Object, ObjectSection};

use crate::kit::callgraph::Reach;
use crate::kit::elf::Image;
use crate::kit::error::{Error, Result, check};
use crate::kit::rows::{self, Row};
use crate::kit::table::{Table, thousands};
use crate::kit::toolchain::RELEASE;
use crate::kit::{meter, shell};
use crate::studies::study::{Bench, Found};

/// Lines of flags; the first is that of `.cargo/config.toml`.
const LINES: [(&str, Option<&str>); 4] = [
    ("fast", None),
    (
        "quiet",
        Some("-Ctarget-cpu=cortex-m4 -Cllvm-args=-misched-prera-direction=topdown"),
    ),
    (QUALIFIABLE, Some("-Ctarget-cpu=cortex-m4")),
    ("none", Some("")),
];
const QUALIFIABLE: &str = "qualifiable";
/// The linker's scripts, which stand among the flags of `.cargo/config.toml`.
const LINKER: &str = "-Clink-arg=-Tlink.x -Clink-arg=-Tdefmt.x";

const BINS: [&str; 3] = ["costs_ur5e", "forward_ur5e", "costs_panda"];
/// The scene whose tick is read.
const SCENE: &str = "ur5e";
const ALGORITHMS: [&str; 4] = ["rnea", "crba", "forward_dynamics", "aba"];
/// The sources of Rust's own crates in the paths of the debug information.
const RUST: &str = "/library/";

/// Builds the bins by each line of flags and runs them under the meter.
pub fn measure(bench: &Bench<'_>) -> Result<Found> {
    let (workspace, tools) = (bench.workspace, bench.tools()?);
    let (mut lines, mut core) = (Vec::new(), BTreeMap::new());
    for (name, flags) in LINES {
        let flags = flags.map(|flags| format!("{flags} {LINKER}"));
        let build = |bins: &[&str], debug: Option<(&str, &str)>| {
            let mut command = tools.toolchain.firmware(workspace, "build");
            command.args(["--profile", RELEASE]);
            command.args(bins.iter().flat_map(|bin| ["--bin", bin]));
            command
                .envs(flags.iter().map(|flags| ("RUSTFLAGS", flags)))
                .envs(debug);
            shell::cargo(&mut command)?;
            let elves = bins
                .iter()
                .map(|bin| tools.toolchain.elf(workspace, RELEASE, bin));
            Ok(elves.collect::<Vec<_>>())
        };
        let mut rows = rows::run_all(workspace, tools, &BINS, &build(&BINS, None)?)?.0;
        rows.retain(is_shown);
        lines.push(rows);
        if name == QUALIFIABLE {
            // Without scopes in the debug information, functions of one name could not be told apart.
            let debug = Some(("CARGO_PROFILE_RELEASE_DEBUG", "limited"));
            core = functions_of_rust(&build(&[SCENE], debug)?[0])?;
        }
    }
    let text = format!(
        "{}\nInstructions / cycles of the longest call ({}); in brackets cycles as multiples of those of the fast line.\n\n{}\nMeasured with {}.",
        table(&lines)?.markdown(),
        meter::MODEL,
        listed(&core),
        bench.rustc()?
    );
    Ok(Found {
        rustc: Some(bench.rustc()?),
        ..Found::new(text, &(&lines, &core))?
    })
}

/// Functions with their sines and cosines, of the engine, and of inverse dynamics also of the core.
fn is_shown(row: &Row) -> bool {
    let is_rnea_of_core = row.algorithm == "rnea" && row.inputs == "full";
    let algorithm = ALGORITHMS.contains(&&*row.algorithm);
    let inputs = ["full", "gravity"].contains(&&*row.inputs);
    row.trig && algorithm && inputs && (row.form == "engine" || is_rnea_of_core)
}

/// A row of each function, a column of each line of flags.
fn table(lines: &[Vec<Row>]) -> Result<Table> {
    let heads = LINES.map(|(name, _)| name);
    let mut table = Table::new(&[&["robot, algorithm, form, inputs"], &heads[..]].concat());
    for (index, fast) in lines[0].iter().enumerate() {
        let mut cells = vec![fast.key().replace(" trig", "")];
        for (line, rows) in heads.iter().zip(lines) {
            let same = rows.get(index).filter(|row| row.key() == fast.key());
            let row = same.ok_or_else(|| check!("`{}` was not measured by {line}", fast.key()))?;
            let (instructions, cycles) = (row.instructions.max, row.cycles.max);
            let multiple = cycles as f64 / fast.cycles.max as f64;
            let both = [instructions, cycles].map(thousands).join(" / ");
            cells.push(format!("{both} ({multiple:.2})"));
        }
        table.row(cells);
    }
    Ok(table)
}

/// By source file, the functions of Rust's own crates whose code a tick contains: those that were inlined into it too.
fn functions_of_rust(elf: &Path) -> Result<BTreeMap<String, BTreeSet<String>>> {
    let wrong = |error| check!("the debug information of {}: {error}", elf.display());
    let bytes = std::fs::read(elf).map_err(Error::file("read", elf))?;
    let file = object::File::parse(&*bytes).map_err(|e| check!("{}: {e}", elf.display()))?;
    let section = |name: &str| file.section_by_name(name)?.data().ok();
    let dwarf = Dwarf::load(|id| {
        let data = section(id.name()).unwrap_or_default();
        Ok(EndianSlice::new(data, LittleEndian))
    });
    let context = addr2line::Context::from_dwarf(dwarf.map_err(wrong)?).map_err(wrong)?;
    let image = Image::read(elf)?;
    let reach = Reach::of(&image, |f| f.is_named(|name| name.contains("marked_tick")))?;
    let mut found: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for one in reach.functions().flat_map(|(f, _)| f.instructions()) {
        let mut frames = context
            .find_frames(one.address)
            .skip_all_loads()
            .map_err(wrong)?;
        while let Some(frame) = frames.next().map_err(wrong)? {
            let path = frame.location.and_then(|at| at.file);
            let path = path.and_then(|path| path.split_once(RUST));
            let Some(((_, path), function)) = path.zip(frame.function) else {
                continue;
            };
            let name = function.demangle().map_err(wrong)?;
            // Where the compiler has merged instructions, a function of another crate may have a line of this one.
            let is_core = name.starts_with("core::") || name.starts_with('<');
            if is_core || !path.starts_with("core/") {
                let names = found.entry(path.replace("/src/", "/")).or_default();
                names.insert(name.into_owned());
            }
        }
    }
    Ok(found)
}

/// An item of a list for each source.
fn listed(core: &BTreeMap<String, BTreeSet<String>>) -> String {
    let items = core.iter().map(|(file, names)| {
        let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
        format!("- `{file}`: {}\n", names.join(", "))
    });
    items.collect()
}

#[cfg(test)]
mod tests {
    use crate::kit::docs::repository::{read, rows_of};

    /// The cycles of a cell of the table.
    fn cycles(cell: &str) -> f64 {
        let (_, cycles) = cell.split_once(" / ").expect("two figures");
        let (cycles, _) = cycles.split_once(" (").expect("a multiple");
        cycles.replace(',', "").parse().expect("a figure")
    }

    /// By how much the cycles of one column exceed those of another, in the rows that are chosen: `9 to 11 %`.
    fn excess(rows: &[Vec<&str>], of: usize, over: usize, chosen: fn(&str) -> bool) -> String {
        let rows = rows.iter().filter(|row| chosen(row[0]));
        let excess = rows.map(|row| 100.0 * (cycles(row[of]) / cycles(row[over]) - 1.0));
        let excess: Vec<f64> = excess.collect();
        let least = excess.iter().copied().fold(f64::INFINITY, f64::min);
        let most = excess.iter().copied().fold(0.0, f64::max);
        format!("{least:.0} to {most:.0} %")
    }

    #[test]
    fn pages_and_templates_have_the_prices_of_the_table() {
        const QUIET: usize = 2;
        let page = read("docs/flags.md");
        let rows = rows_of(&page);
        let full = excess(&rows, 4, QUIET, |row| row.ends_with("rnea engine full"));
        let gravity = excess(&rows, 4, QUIET, |row| row.ends_with("engine gravity"));
        let quiet = excess(&rows, QUIET, 1, |row| {
            row.contains(" full") || row.contains(" gravity")
        });
        let without = format!("inverse dynamics takes {full} more cycles");
        for (file, said) in [
            ("README.md", vec![without.clone()]),
            (
                "robot-import/template/rust/.cargo/config.toml",
                vec![without.clone()],
            ),
            (
                "robot-import/template/c/.cargo/config.toml",
                vec![without.clone()],
            ),
            (
                "docs/guide/src/firmware.md",
                vec![
                    without,
                    format!("of gravity alone {gravity}"),
                    format!("a call takes {quiet} more cycles"),
                ],
            ),
        ] {
            let text = read(file).split_whitespace().collect::<Vec<_>>().join(" ");
            for said in said {
                assert!(text.contains(&said), "{file} does not say: {said}");
            }
        }
    }
}
