//! `cargo xtask flags`: what other flags of the compiler and other profiles cost, and which
//! functions of Rust's own crates a tick contains.

mod profiles;

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
    ("quiet", Some("-Ctarget-cpu=cortex-m4 -Cllvm-args=-misched-prera-direction=topdown")),
    (QUALIFIABLE, Some("-Ctarget-cpu=cortex-m4")),
    ("none", Some("")),
];
const QUALIFIABLE: &str = "qualifiable";
/// The linker's scripts, which stand among the flags of `.cargo/config.toml`.
const LINKER: &str = "-Clink-arg=-Tlink.x -Clink-arg=-Tdefmt.x";

/// The program with the calls of inverse dynamics.
const BIN: &str = "costs_ur5e";
/// The scene whose tick is read.
const SCENE: &str = "ur5e";
/// The sources of Rust's own crates in the paths of the debug information.
const RUST: &str = "/library/";

/// Builds the program by each line of flags and runs it under the meter.
pub fn measure(bench: &Bench<'_>) -> Result<Found> {
    let (workspace, tools) = (bench.workspace, bench.tools()?);
    let profiles = profiles::measure(workspace, tools)?;
    let (mut lines, mut core) = (Vec::new(), BTreeMap::new());
    for (name, flags) in LINES {
        let flags = flags.map(|flags| format!("{flags} {LINKER}"));
        // Without scopes in the debug information, functions of one name could not be told apart.
        let has_list = name == QUALIFIABLE;
        let debug = has_list.then_some(("CARGO_PROFILE_RELEASE_DEBUG", "limited"));
        let build = |bin: &str| {
            let mut command = tools.toolchain.firmware(workspace, "build");
            command.args(["--profile", RELEASE, "--bin", bin]);
            command.envs(flags.iter().map(|flags| ("RUSTFLAGS", flags))).envs(debug);
            shell::capture(&mut command)?;
            Ok(tools.toolchain.elf(workspace, RELEASE, bin))
        };
        let mut rows = rows::run_all(workspace, tools, &[BIN], &[build(BIN)?])?.0;
        rows.retain(is_shown);
        lines.push(rows);
        if has_list {
            core = functions_of_rust(&build(SCENE)?)?;
        }
    }
    let text = format!(
        "{}\nInstructions / cycles of the longest call ({}); in brackets cycles as multiples of \
         those of the fast line.\n\n{}\nMeasured with {}.",
        table(&lines)?.markdown(),
        meter::MODEL,
        listed(&core),
        bench.rustc()?
    );
    let guide = profiles::markdown(&profiles, &bench.rustc()?);
    Ok(Found {
        brief: Some((profiles::PAGE, guide)),
        ..Found::new(text, &(&lines, &core, &profiles))?
    })
}

/// Inverse dynamics by core and engine, and of gravity alone by the engine, with sines and cosines.
fn is_shown(row: &Row) -> bool {
    let is_gravity = row.form == "engine" && row.inputs == "gravity";
    row.algorithm == "rnea" && row.trig && (row.inputs == "full" || is_gravity)
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

/// By source file, the functions of Rust's own crates whose code a tick contains: those that were
/// inlined into it too.
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
        let mut frames = context.find_frames(one.address).skip_all_loads().map_err(wrong)?;
        while let Some(frame) = frames.next().map_err(wrong)? {
            let path = frame.location.and_then(|at| at.file);
            let path = path.and_then(|path| path.split_once(RUST));
            let Some(((_, path), function)) = path.zip(frame.function) else {
                continue;
            };
            let name = function.demangle().map_err(wrong)?;
            // If the compiler has merged instructions, a function of another crate may have a
            // line of this one.
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
    use super::profiles::{PAGE, WITHOUT_FLAGS};
    use crate::kit::docs::repository::{read, rows_of};

    fn number(cell: &str) -> f64 {
        cell.replace(',', "").parse().expect("a figure")
    }

    /// The cycles of a cell of the table of flags.
    fn cycles(cell: &str) -> f64 {
        let (_, cycles) = cell.split_once(" / ").expect("two figures");
        let (cycles, _) = cycles.split_once(" (").expect("a multiple");
        number(cycles)
    }

    /// By how much the first figures of pairs exceed the second: `37 to 39 %`.
    fn excess(pairs: &[[f64; 2]]) -> String {
        let mut all: Vec<f64> =
            pairs.iter().map(|[more, less]| 100.0 * (more / less - 1.0)).collect();
        all.sort_by(f64::total_cmp);
        match [all[0], all[all.len() - 1]].map(|percent| format!("{percent:.0}")) {
            [least, most] if least == most => format!("{least} %"),
            [least, most] => format!("{least} to {most} %"),
        }
    }

    #[test]
    fn pages_and_templates_say_what_the_tables_do() {
        let (flags, guide) = (read("docs/flags.md"), read(PAGE));
        let rows = rows_of(&flags);
        let [fast, quiet, qualifiable, none] = [1, 2, 3, 4];
        let pairs = |end: &str, [more, less]: [usize; 2]| -> Vec<[f64; 2]> {
            let rows = rows.iter().filter(|row| row.len() == 5 && row[0].ends_with(end));
            rows.map(|row| [cycles(row[more]), cycles(row[less])]).collect()
        };
        let profiles = rows_of(&guide);
        // The guide's prose says which profiles keep the period.
        let in_time = profiles.iter().filter(|row| row.len() == 5).map(|row| {
            let share = row[2].trim_end_matches(" %");
            assert_eq!(row[0].starts_with("dev at 0"), number(share) > 100.0, "{row:?}");
        });
        assert_eq!(in_time.count(), 6);
        let of_profile = |name: &str, column: usize| {
            let row = profiles.iter().find(|row| row[0].starts_with(name));
            number(row.expect("the profile")[column])
        };
        let multiple = |column: usize| {
            let rows = rows.iter().filter(|row| row.len() == 5);
            rows.map(|row| cycles(row[column]) / cycles(row[fast])).fold(0.0, f64::max)
        };
        let project =
            |column| [WITHOUT_FLAGS, "release as written"].map(|name| of_profile(name, column));
        let full = [pairs("rnea engine full", [none, quiet]), vec![project(3)]].concat();
        let gravity = excess(&pairs("engine gravity", [none, quiet]));
        let all = [" full", " gravity"].map(|end| pairs(end, [quiet, fast])).concat();
        let without = format!("inverse dynamics takes {} more cycles", excess(&full));
        let tick = format!("a tick takes {} more cycles", excess(&[project(1)]));
        let template = |kind| format!("tools/robot-import/template/{kind}/.cargo/config.toml");
        for (file, said) in [
            ("README.md", &without),
            (&*template("c"), &without),
            (&*template("rust"), &without),
            (&*template("rust"), &tick),
            (PAGE, &without),
            (PAGE, &tick),
            (
                "docs/flags.md",
                &format!("takes up to {:.1} times the cycles", multiple(qualifiable)),
            ),
            ("docs/flags.md", &format!("without any flag up to {:.1} times", multiple(none))),
            (PAGE, &format!("of gravity alone {gravity}")),
            (PAGE, &format!("a call takes {} more cycles", excess(&all))),
        ] {
            let text = read(file).replace('#', "");
            let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(text.contains(said), "{file} does not say: {said}");
        }
    }
}
