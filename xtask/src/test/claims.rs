//! The claims that only a full run tests, read from the sources: they are not compiled in an everyday run.

use std::path::{Path, PathBuf};

use crate::error::{Error, Result};
use crate::workspace;

/// What stands before such a test.
const GATE: &str = "#[cfg(feature = \"full\")]";

/// The test programs under a folder with the tests of theirs that only a full run takes, in alphabetical order.
pub fn full_only(folder: &Path) -> Result<Vec<(String, String)>> {
    let mut claims = Vec::new();
    for path in sources(folder)? {
        let program = path
            .strip_prefix(folder)
            .ok()
            .and_then(|rest| rest.iter().next());
        let program = program.map_or_else(String::new, |name| {
            Path::new(name).with_extension("").display().to_string()
        });
        let gated = gated(&workspace::read(&path)?);
        claims.extend(gated.into_iter().map(|test| (program.clone(), test)));
    }
    claims.sort();
    Ok(claims)
}

/// Every source file under a folder.
fn sources(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(Error::file("read", folder))? {
        let path = entry.map_err(Error::file("read", folder))?.path();
        if path.is_dir() {
            found.extend(sources(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    Ok(found)
}

/// The names of the tests in a source that stand behind the gate.
fn gated(source: &str) -> Vec<String> {
    let mut lines = source.lines().map(str::trim);
    let mut names = Vec::new();
    while let Some(line) = lines.next() {
        if line != GATE {
            continue;
        }
        let mut is_test = false;
        for line in lines.by_ref().take(4) {
            is_test |= line == "#[test]";
            if let Some(rest) = line.strip_prefix("fn ") {
                let name = rest.split(['(', '<']).next().unwrap_or_default();
                names.extend(is_test.then(|| name.to_owned()));
                break;
            }
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::{GATE, gated};

    #[test]
    fn a_test_behind_the_gate_is_named_and_nothing_else() {
        let source = format!(
            "#[test]\nfn always() {{}}\n\n{GATE}\n#[test]\nfn on_every_robot() {{\n}}\n{GATE}\nfn no_test() {{}}\n{GATE}\nuse x;\n"
        );
        assert_eq!(gated(&source), ["on_every_robot"]);
    }
}
