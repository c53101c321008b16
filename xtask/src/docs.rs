//! The part of the README that a command writes.

use crate::budgets::OTHER_RUSTC;
use crate::error::{Error, Result};
use crate::report::Report;
use crate::workspace::{self, Workspace};

const BEGIN: &str = "<!-- demo:begin -->";
const END: &str = "<!-- demo:end -->";
const COMMAND: &str = "cargo xtask demo --write-docs";

/// Puts the report's tables between the README's markers.
pub fn write(workspace: &Workspace, report: &Report) -> Result<()> {
    let path = workspace.root.join("README.md");
    let text = workspace::read(&path)?;
    let (before, _, after) = split(&text)?;
    workspace::write(
        &path,
        format!("{before}{BEGIN}\n{}{END}{after}", generated(report)),
    )
}

/// Fails unless the README's tables are those of the report, or close to them if they were
/// written with another compiler.
pub fn check(workspace: &Workspace, report: &Report) -> Result<()> {
    let text = workspace::read(&workspace.root.join("README.md"))?;
    let (_, written, _) = split(&text)?;
    compare(
        "README.md",
        COMMAND,
        written,
        &generated(report),
        &report.rustc,
    )
}

/// Fails unless what was written is what would be written now with the compiler `rustc`, or close to
/// it if it was written with another one.
pub fn compare(file: &str, command: &str, written: &str, fresh: &str, rustc: &str) -> Result<()> {
    let same = if written.contains(rustc) {
        written.trim() == fresh.trim()
    } else {
        alike(written, fresh)
    };
    if same {
        return Ok(());
    }
    let differing = std::iter::zip(written.trim().lines(), fresh.trim().lines())
        .find(|(old, new)| old != new)
        .map(|(old, new)| format!("\n  there: {old}\n  now:   {new}"))
        .unwrap_or_default();
    Err(Error::check(format!(
        "{file} is out of date: `{command}` rewrites it{differing}"
    )))
}

fn generated(report: &Report) -> String {
    format!(
        "<!-- written by `{COMMAND}`: do not edit -->\n\n{}\n",
        report.markdown()
    )
}

fn split(text: &str) -> Result<(&str, &str, &str)> {
    let parts = || {
        let (before, rest) = text.split_once(BEGIN)?;
        let (inside, after) = rest.split_once(END)?;
        Some((before, inside, after))
    };
    parts().ok_or_else(|| Error::check(format!("README.md lacks the markers {BEGIN} and {END}")))
}

/// Whether two texts are the same but for padding, the compiler and what another compiler may
/// change in the figures.
fn alike(old: &str, new: &str) -> bool {
    let words = |text: &str| -> Vec<String> {
        text.lines()
            .filter(|line| !line.starts_with("Measured with "))
            .flat_map(str::split_whitespace)
            // The rule under a table's heading is as long as the figures are wide.
            .filter(|word| !word.contains("--") || word.contains('!'))
            .map(|word| word.trim_matches(['(', ')', ',', '.']).replace(',', ""))
            .collect()
    };
    let (old, new) = (words(old), words(new));
    old.len() == new.len()
        && std::iter::zip(old, new).all(|(old, new)| match (old.parse(), new.parse()) {
            (Ok(old), Ok(new)) => close(old, new),
            _ => old == new,
        })
}

fn close(old: f64, new: f64) -> bool {
    // A share of the tick, printed to a tenth of a per cent, moves by more than itself.
    (old - new).abs() <= f64::max(OTHER_RUSTC * old.abs(), 0.5)
}

#[cfg(test)]
mod tests {
    use super::{alike, split};

    #[test]
    fn another_compiler_may_change_figures_but_not_words() {
        let old = "| total | 1,000 |\n| ---- | ---: |\nMeasured with rustc 1.";
        assert!(alike(
            old,
            "| total | 1,020 |\n| --- | --: |\nMeasured with rustc 2."
        ));
        assert!(!alike(old, "| total | 1,040 |\n| ---- | ---: |\n"));
        assert!(!alike(old, "| read | 1,000 |\n| ---- | ---: |\n"));
    }

    #[test]
    fn a_readme_without_markers_is_an_error() {
        assert!(split("nothing").is_err());
        let text = "a<!-- demo:begin -->b<!-- demo:end -->c";
        assert!(split(text).is_ok_and(|parts| parts == ("a", "b", "c")));
    }
}
