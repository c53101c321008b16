//! `cargo xtask test weight` and `cargo xtask lines`: what the tests and the apparatus weigh, against the bounds in
//! `budgets.toml`, which only a page of docs/decisions raises.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::kit::elf;
use crate::kit::error::{Error, Result, check};
use crate::kit::sources::{code, lines_of_code, sources};
use crate::kit::table::{Table, thousands};
use crate::kit::workspace::{self, Workspace};

const FILE: &str = "budgets.toml";
const LIBRARY: [&str; 2] = ["dynamics-core/src/", "motion-control/src/"];
/// The laboratory, and xtask with its tests.
const APPARATUS: [&str; 2] = ["lab/", "xtask/"];

/// The purpose of a line of code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Library,
    /// Everything else that a user's machine runs, and the demo.
    Product,
    Tests,
    Apparatus,
}

impl Kind {
    const ALL: [(Self, &str); 4] = [
        (Self::Library, "library"),
        (Self::Product, "other product"),
        (Self::Tests, "tests"),
        (Self::Apparatus, "apparatus"),
    ];

    /// The kind of a file, by its path from the workspace's root.
    fn of(path: &Path) -> Self {
        let text = path.to_string_lossy().replace('\\', "/");
        let is_below = |places: &[&str]| places.iter().any(|place| text.starts_with(place));
        let is_test = |name: &str| matches!(name, "tests" | "tests.rs" | "host-tests");
        if is_below(&APPARATUS) {
            Self::Apparatus
        } else if path.iter().any(|name| is_test(&name.to_string_lossy())) {
            Self::Tests
        } else if is_below(&LIBRARY) {
            Self::Library
        } else {
            Self::Product
        }
    }
}

/// Lines of code in the order of [`Kind::ALL`].
struct Lines([usize; 4]);

impl Lines {
    fn of(root: &Path) -> Result<Self> {
        let mut lines = [0; 4];
        for path in sources(root)? {
            let source = workspace::read(&path)?;
            let kind = Kind::of(path.strip_prefix(root).unwrap_or(&path));
            let all = lines_of_code(&source);
            // The lines after `#[cfg(test)]` in a file of the product.
            let unit_tests = match kind {
                Kind::Library | Kind::Product => all - code(&source).count(),
                Kind::Tests | Kind::Apparatus => 0,
            };
            lines[kind as usize] += all - unit_tests;
            lines[Kind::Tests as usize] += unit_tests;
        }
        Ok(Self(lines))
    }

    fn table(&self) -> Table {
        let mut table = Table::new(&["kind", "lines of code"]);
        for ((_, name), lines) in Kind::ALL.iter().zip(self.0) {
            table.row([(*name).to_owned(), thousands(lines as u64)]);
        }
        table
    }
}

/// The lines of code by kind.
pub fn lines() -> Result<String> {
    Ok(Lines::of(&Workspace::find()?.root)?.table().text())
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Bounds {
    test_programs: u64,
    test_code_bytes: u64,
    target_bytes: u64,
    apparatus_lines: u64,
    /// What the apparatus had when its bound was found to be missed: it may not grow, and when the bound is met this goes.
    apparatus_lines_missed: Option<u64>,
}

impl Bounds {
    fn read(workspace: &Workspace) -> Result<Self> {
        #[derive(Deserialize)]
        struct Budgets {
            weight: Bounds,
        }
        let text = workspace::read(&workspace.root.join(FILE))?;
        let budgets: Budgets = toml_edit::de::from_str(&text).map_err(|e| check!("{FILE}: {e}"))?;
        Ok(budgets.weight)
    }
}

struct Weight {
    programs: u64,
    code_bytes: u64,
    target_bytes: u64,
    lines: Lines,
}

/// Fails if something weighs more than it may. `programs` are the tests' programs of the host, of an everyday run; a full run
/// builds others, and weighs the lines alone.
pub fn check(workspace: &Workspace, programs: Option<&[PathBuf]>) -> Result<String> {
    let (mut code_bytes, mut target_bytes) = (0, 0);
    if let Some(programs) = programs {
        for program in programs {
            code_bytes += elf::code_bytes(program)?;
        }
        target_bytes = bytes_below(&workspace.target)?;
    }
    let weight = Weight {
        programs: programs.map_or(0, <[_]>::len) as u64,
        code_bytes,
        target_bytes,
        lines: Lines::of(&workspace.root)?,
    };
    weight.verdict(&Bounds::read(workspace)?)
}

impl Weight {
    fn verdict(&self, bounds: &Bounds) -> Result<String> {
        let [library, _, tests, apparatus] = self.lines.0.map(|lines| lines as u64);
        let figures = [
            ("test programs", self.programs, bounds.test_programs),
            (
                "bytes of their code",
                self.code_bytes,
                bounds.test_code_bytes,
            ),
            ("bytes in target/", self.target_bytes, bounds.target_bytes),
            (
                "lines of the apparatus",
                apparatus,
                bounds
                    .apparatus_lines_missed
                    .unwrap_or(bounds.apparatus_lines),
            ),
            (
                "lines of the apparatus, those of the library",
                apparatus,
                library,
            ),
        ];
        let is_beyond = figures.iter().any(|(_, measured, most)| measured > most);
        let line = |(what, measured, most): &(&str, u64, u64)| {
            let [now, bound] = [*measured, *most].map(thousands);
            let verdict = if measured > most { "too heavy" } else { "met" };
            format!("{what}: {now} of {bound}, {verdict}")
        };
        let wanted = thousands(bounds.apparatus_lines);
        let missed = bounds.apparatus_lines_missed.map(|_| match apparatus > bounds.apparatus_lines {
            true => format!("the bound of {wanted} lines of the apparatus is missed (docs/decisions/0002-bars.md)"),
            false => format!("the bound of {wanted} lines of the apparatus is met: `apparatus_lines_missed` in {FILE} goes"),
        });
        let is_stale = missed.is_some() && apparatus <= bounds.apparatus_lines;
        let tests = format!("lines of tests: {}", thousands(tests));
        let lines = figures.iter().map(line).chain(missed).chain([tests]);
        let text = lines.collect::<Vec<_>>().join("\n");
        match is_beyond || is_stale {
            true => Err(check!("{text}")),
            false => Ok(text.replace('\n', "; ")),
        }
    }
}

/// The bytes that the files below a folder take, each once however many names it has.
fn bytes_below(folder: &Path) -> Result<u64> {
    let (mut bytes, mut seen, mut folders) = (0, BTreeSet::new(), vec![folder.to_owned()]);
    while let Some(folder) = folders.pop() {
        let entries = std::fs::read_dir(&folder).map_err(Error::file("read", &folder))?;
        for entry in entries.flatten() {
            let Ok(metadata) = entry.metadata() else {
                // Cargo has removed it meanwhile.
                continue;
            };
            if metadata.is_dir() {
                folders.push(entry.path());
            } else if seen.insert(identity(&metadata, &entry.path())) {
                bytes += metadata.len();
            }
        }
    }
    Ok(bytes)
}

/// An identity that all names of a file share.
#[cfg(unix)]
fn identity(metadata: &std::fs::Metadata, _: &Path) -> (u64, u64) {
    use std::os::unix::fs::MetadataExt;
    (metadata.dev(), metadata.ino())
}

#[cfg(not(unix))]
fn identity(_: &std::fs::Metadata, path: &Path) -> PathBuf {
    path.to_owned()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{Bounds, FILE, Kind, Lines, Weight, bytes_below, elf};
    use crate::kit::docs::repository::root;

    const BOUNDS: Bounds = Bounds {
        test_programs: 45,
        test_code_bytes: 50,
        target_bytes: 4,
        apparatus_lines: 21,
        apparatus_lines_missed: None,
    };

    fn weight() -> Weight {
        Weight {
            programs: 45,
            code_bytes: 50,
            target_bytes: 4,
            lines: Lines([21, 9, 40, 21]),
        }
    }

    #[test]
    fn each_weight_beyond_its_bound_fails() {
        assert!(weight().verdict(&BOUNDS).is_ok());
        type Add = fn(&mut Weight);
        let heavier: [(Add, &str); 5] = [
            (
                |weight| weight.programs += 1,
                "test programs: 46 of 45, too heavy",
            ),
            (
                |weight| weight.code_bytes += 1,
                "bytes of their code: 51 of 50, too heavy",
            ),
            (
                |weight| weight.target_bytes += 1,
                "bytes in target/: 5 of 4, too heavy",
            ),
            (
                |weight| weight.lines.0[3] += 1,
                "lines of the apparatus: 22 of 21, too heavy",
            ),
            (
                |weight| weight.lines.0[0] -= 1,
                "those of the library: 21 of 20, too heavy",
            ),
        ];
        for (add, complaint) in heavier {
            let mut weight = weight();
            add(&mut weight);
            let error = weight.verdict(&BOUNDS).expect_err(complaint).to_string();
            assert!(error.contains(complaint), "{error}");
        }
    }

    #[test]
    fn a_missed_bound_is_no_licence_to_grow() {
        let bounds = Bounds {
            apparatus_lines: 20,
            apparatus_lines_missed: Some(21),
            ..BOUNDS
        };
        let text = weight().verdict(&bounds).expect("no more than recorded");
        assert!(
            text.contains("20 lines of the apparatus is missed"),
            "{text}"
        );
        let mut heavier = weight();
        heavier.lines.0 = [30, 9, 40, 22];
        let error = heavier.verdict(&bounds).expect_err("grown").to_string();
        assert!(error.contains("22 of 21, too heavy"), "{error}");
        let mut lighter = weight();
        lighter.lines.0[3] = 20;
        let error = lighter.verdict(&bounds).expect_err("met").to_string();
        assert!(
            error.contains("`apparatus_lines_missed` in budgets.toml goes"),
            "{error}"
        );
    }

    #[test]
    fn the_laboratory_is_apparatus_and_a_scene_is_none() {
        for (path, kind) in [
            ("dynamics-core/src/algorithms/rnea.rs", Kind::Library),
            ("dynamics-core/src/tests.rs", Kind::Tests),
            ("dynamics-core/examples/payload.rs", Kind::Product),
            ("drivers/src/lib.rs", Kind::Product),
            ("drivers/tests/spi.rs", Kind::Tests),
            ("host-tests/src/lib.rs", Kind::Tests),
            ("lab/history/src/lib.rs", Kind::Apparatus),
            ("lab/target/src/lib.rs", Kind::Apparatus),
            ("xtask/src/kit/docs/tests.rs", Kind::Apparatus),
            ("firmware-demo/src/bin/ur5e.rs", Kind::Product),
        ] {
            assert_eq!(Kind::of(Path::new(path)), kind, "{path}");
        }
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_program_weighs_its_code_alone() {
        let program = std::env::current_exe().expect("this program");
        let file = std::fs::metadata(&program).expect("there").len();
        let code = elf::code_bytes(&program).expect("weighed");
        assert!(100_000 < code && code < file / 2, "{code} of {file}");
    }

    #[test]
    fn a_file_of_two_names_weighs_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let inside = folder.path().join("deps");
        std::fs::create_dir(&inside).expect("a folder");
        std::fs::write(inside.join("a"), [0; 1000]).expect("written");
        std::fs::hard_link(inside.join("a"), folder.path().join("b")).expect("linked");
        let bytes = bytes_below(folder.path()).expect("weighed");
        assert_eq!(bytes, if cfg!(unix) { 1000 } else { 2000 });
    }

    #[test]
    fn every_bound_names_the_decision_that_set_it() {
        let text = std::fs::read_to_string(root().join(FILE)).expect("budgets");
        let (_, weight) = text.split_once("[weight]\n").expect("bounds");
        let bounds = weight.lines().take_while(|line| line.contains('='));
        let mut count = 0;
        for bound in bounds {
            let page = bound.split_once("# decision ").expect(bound).1;
            let pages = std::fs::read_dir(root().join("docs/decisions")).expect("pages");
            let mut names = pages.flatten().map(|page| page.file_name());
            let begin = format!("{page:0>4}-");
            assert!(
                names.any(|name| name.to_string_lossy().starts_with(&begin)),
                "{bound}"
            );
            count += 1;
        }
        assert_eq!(count, 5);
    }
}
