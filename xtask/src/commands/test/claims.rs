//! The claims that only a full run tests, read from the sources: they are not compiled in an
//! everyday run.

use std::path::Path;

use crate::kit::error::Result;
use crate::kit::sources::sources;
use crate::kit::workspace;

/// The attribute of such a test.
const GATE: &str = "#[cfg(feature = \"full\")]";
/// The attribute of a file of such tests.
const FILE_GATE: &str = "#![cfg(feature = \"full\")]";

/// The test programs under a folder with the tests of theirs that only a full run takes, in
/// alphabetical order.
pub fn full_only(folder: &Path) -> Result<Vec<(String, String)>> {
    let mut claims = Vec::new();
    for path in sources(folder)? {
        let inside = path.strip_prefix(folder).unwrap_or(&path);
        let program = inside
            .iter()
            .next()
            .map(|name| Path::new(name).with_extension(""));
        let program = program.unwrap_or_default().display().to_string();
        let gated = gated(&workspace::read(&path)?);
        claims.extend(gated.into_iter().map(|test| (program.clone(), test)));
    }
    claims.sort();
    Ok(claims)
}

/// The names of the tests in a source that stand behind the gate, and of those that go further
/// behind it.
fn gated(source: &str) -> Vec<String> {
    let (mut names, mut test, mut is_test, mut whole) = (Vec::new(), None, false, false);
    let all = source.lines().any(|line| line == FILE_GATE);
    for line in source.lines() {
        match line.trim() {
            "#[test]" => (is_test, whole) = (true, whole | all),
            // Outside every function: a test, or something that only such tests use.
            GATE if line == GATE => whole = true,
            GATE => names.extend(test.take().map(|name| format!("{name}: further robots"))),
            code if code.starts_with("fn ") && line == code => {
                let name = code[3..]
                    .split(['(', '<'])
                    .next()
                    .unwrap_or_default()
                    .to_owned();
                match (is_test, whole) {
                    (true, true) => names.push(name),
                    (true, false) => test = Some(name),
                    (false, _) => test = None,
                }
                (is_test, whole) = (false, false);
            }
            code if line == code && !code.starts_with('#') => (is_test, whole) = (false, false),
            _ => {}
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::{FILE_GATE, GATE, gated};

    #[test]
    fn a_test_behind_the_gate_is_named_and_nothing_else() {
        let source = format!(
            "#[test]\nfn always() {{\n}}\n\n{GATE}\n#[test]\nfn on_every_robot() \
             {{\n}}\n{GATE}\nfn no_test() {{\n}}\n\
             {GATE}\nconst X: u8 = 1;\n#[test]\nfn in_part() \
             {{\n    a();\n    {GATE}\n    {{\n        b();\n    }}\n}}\n"
        );
        let expected = ["on_every_robot", "in_part: further robots"];
        assert_eq!(gated(&source), expected);
        let file = format!("{FILE_GATE}\n#[test]\nfn one() {{\n}}\n#[test]\nfn two() {{\n}}\n");
        assert_eq!(gated(&file), ["one", "two"]);
    }
}
