//! `cargo xtask lines`: how many lines of code the library has and how many the tooling; the product stays larger
//! than its apparatus.

use std::path::{Path, PathBuf};

use crate::error::{Error, Result, check};
use crate::scene::{Scene, Trial};
use crate::table::{Table, thousands};
use crate::workspace::{self, Workspace};

/// The most that the tooling may have: what it has today. The bar is 11,000 (docs/decisions/0002).
const MOST: usize = 19_678;
/// Where the bins of the firmware are; those of scenes are the demo's.
const BINS: &str = "firmware-demo/src/bin/";
/// The library and the parts of the tooling, by the beginnings of their files' paths.
const LIBRARY: &str = "dynamics-core/src/";
#[rustfmt::skip]
const TOOLING: [&str; 8] = [
    "xtask/src/", "cores/src/", "host-tests/cycle-meter/src/", "host-tests/reports/", "host-tests/peers/",
    "host-tests/mutants/",
    "firmware-demo/src/accuracy", BINS,
];

/// The lines of the library and of each part of the tooling.
struct Counts(usize, Vec<usize>);

/// Prints the lines of each part.
pub fn text() -> Result<String> {
    let Counts(library, tooling) = Counts::of(&Workspace::find()?.root)?;
    let mut table = Table::new(&["part", "lines of code"]);
    let mut row = |part: &str, lines: usize| table.row([part.into(), thousands(lines as u64)]);
    row(LIBRARY, library);
    std::iter::zip(TOOLING, &tooling).for_each(|(part, lines)| row(part, *lines));
    row("tooling, all", tooling.iter().sum());
    row("tooling, at most", MOST);
    Ok(table.text())
}

/// Fails if the tooling has more lines than it may or as many as the library.
pub fn check(root: &Path) -> Result<String> {
    Counts::of(root)?.verdict()
}

impl Counts {
    fn of(root: &Path) -> Result<Self> {
        let files = sources(root)?;
        let count = |place: &str| {
            let below = |path: &&PathBuf| is_below(path.strip_prefix(root).unwrap_or(path), place);
            let lines = files
                .iter()
                .filter(below)
                .map(|path| Ok(code(&workspace::read(path)?).count()));
            match lines.sum::<Result<usize>>()? {
                0 => Err(check!("{place} has no lines of code to count")),
                lines => Ok(lines),
            }
        };
        let tooling = TOOLING.into_iter().map(count);
        Ok(Self(count(LIBRARY)?, tooling.collect::<Result<_>>()?))
    }

    fn verdict(&self) -> Result<String> {
        let (library, tooling) = (self.0, self.1.iter().sum::<usize>());
        let counts = format!("tooling {tooling}, at most {MOST}; library {library}");
        if tooling <= MOST && tooling < library {
            return Ok(counts);
        }
        Err(check!("the tooling has too many lines of code: {counts}"))
    }
}

/// Whether a path belongs to a place: no tests, no examples, and of the bins none of a scene's.
fn is_below(path: &Path, place: &str) -> bool {
    let text = path.to_string_lossy().replace('\\', "/");
    let mut names = path.iter().map(|name| name.to_string_lossy());
    let is_other = names.any(|name| matches!(&*name, "tests" | "tests.rs" | "examples"));
    let bin = text
        .strip_prefix(BINS)
        .and_then(|rest| rest.split(['/', '.']).next());
    let scenes = Scene::all().iter().map(|scene| scene.name());
    let trials = Trial::all().iter().map(|trial| trial.name());
    let is_scene = bin.is_some_and(|bin| scenes.chain(trials).any(|name| name == bin));
    text.starts_with(place) && !is_other && !is_scene
}

/// Every Rust source below a folder, without what cargo builds and git keeps.
pub fn sources(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(Error::file("read", folder))? {
        let path = entry.map_err(Error::file("read", folder))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() && name != "target" && !name.starts_with('.') {
            found.extend(sources(&path)?);
        } else if name.ends_with(".rs") {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

/// The lines of code of a source that rustfmt has written, with their numbers from 1: none that are blank, comments,
/// or of an item behind `#[cfg(test)]`.
pub fn code(source: &str) -> impl Iterator<Item = (usize, &str)> {
    enum Test {
        /// Its attribute stands at this depth; the item has not opened its brace yet.
        Announced(usize),
        /// It ends with the brace at this depth.
        Open(usize),
    }
    let mut test = None;
    let lines = source.lines().zip(1..).map(|(line, number)| (number, line));
    lines.filter(move |(_, line)| {
        let words = line.trim();
        let depth = line.len() - line.trim_start().len();
        match test {
            None if words.starts_with("#[cfg(test)]") => test = Some(Test::Announced(depth)),
            None => return !words.is_empty() && !words.starts_with("//"),
            Some(Test::Announced(from)) if words.ends_with('{') => test = Some(Test::Open(from)),
            Some(Test::Announced(from)) if depth == from && words.ends_with([';', '}']) => {
                test = None
            }
            Some(Test::Open(from)) if depth == from && words.starts_with('}') => test = None,
            Some(_) => {}
        }
        false
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{BINS, Counts, MOST, code, is_below};

    #[test]
    fn blanks_comments_and_tests_are_not_counted() {
        let source = "//! A module.\n\nuse a::B;\n#[cfg(test)]\nuse c::D;\n\n/// A function.\nfn f() {\n    // Why.\n    \
                      g(); // so\n}\n\n#[cfg(test)]\n#[derive(Debug)]\nstruct S {\n    a: u8,\n}\n#[cfg(test)]\nmod tests \
                      {\n    #[test]\n    fn t() {\n    }\n}\nfn last() {}\n";
        let lines: Vec<(usize, &str)> = code(source).collect();
        let expected = [
            (3, "use a::B;"),
            (8, "fn f() {"),
            (10, "    g(); // so"),
            (11, "}"),
            (24, "fn last() {}"),
        ];
        assert_eq!(lines, expected);
    }

    #[test]
    fn tests_examples_and_bins_of_scenes_are_no_tooling() {
        let of = |path: &str, place| is_below(Path::new(path), place);
        assert!(of("xtask/src/lines.rs", "xtask/src/"));
        assert!(!of("xtask/src/docs/tests.rs", "xtask/src/"));
        assert!(!of("xtask/src/docs/tests/pages.rs", "xtask/src/"));
        assert!(!of("dynamics-core/examples/payload.rs", "dynamics-core/"));
        assert!(of("firmware-demo/src/bin/bits.rs", BINS));
        assert!(!of("firmware-demo/src/bin/ur5e.rs", BINS));
    }

    #[test]
    fn tooling_beyond_its_bound_or_as_large_as_the_library_is_refused() {
        let verdict = |library, tooling| Counts(library, vec![tooling, 5]).verdict();
        assert!(verdict(20_000, MOST - 5).is_ok());
        let error = verdict(20_000, MOST - 4).expect_err("too many").to_string();
        let counts = format!("tooling {}, at most {MOST}; library 20000", MOST + 1);
        assert!(error.contains(&counts), "{error}");
        assert!(verdict(9_000, 8_994).is_ok());
        assert!(verdict(9_000, 8_995).is_err());
    }
}
