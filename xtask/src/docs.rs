//! The parts of pages that commands write, and their JSON.

use crate::budgets::OTHER_RUSTC;
use crate::error::{Error, Result};
use crate::output;
use crate::workspace::{self, Workspace};

/// The part of a page that a command writes: between `<!-- NAME:begin -->` and `<!-- NAME:end -->`.
pub struct Page {
    /// The file.
    pub file: &'static str,
    /// In the markers.
    pub name: &'static str,
    /// What writes it.
    pub command: &'static str,
}

/// The README's tables.
pub const README: Page = Page {
    file: "README.md",
    name: "demo",
    command: "cargo xtask demo --write-docs",
};

impl Page {
    /// Puts a text between the markers.
    pub fn write(&self, workspace: &Workspace, text: &str) -> Result<()> {
        let path = workspace.root.join(self.file);
        let page = workspace::read(&path)?;
        workspace::write(&workspace.report(self.file), self.replaced(&page, text)?)
    }

    /// The page with a text between the markers.
    pub fn replaced(&self, page: &str, text: &str) -> Result<String> {
        let (before, _, after) = self.split(page)?;
        let (begin, end) = self.markers();
        let generated = self.generated(text);
        Ok(format!("{before}{begin}\n{generated}{end}{after}"))
    }

    /// Fails unless the text between the markers is this one; or close to it, if `rustc` is the compiler that
    /// its figures depend on and another one wrote them.
    pub fn check(&self, workspace: &Workspace, text: &str, rustc: Option<&str>) -> Result<()> {
        let page = workspace::read(&workspace.root.join(self.file))?;
        let (_, written, _) = self.split(&page)?;
        // An empty name is in every text: nothing but the same will do.
        let rustc = rustc.unwrap_or_default();
        compare(
            self.file,
            self.command,
            written,
            &self.generated(text),
            rustc,
        )
    }

    fn markers(&self) -> (String, String) {
        let marker = |which| format!("<!-- {}:{which} -->", self.name);
        (marker("begin"), marker("end"))
    }

    fn generated(&self, text: &str) -> String {
        format!(
            "<!-- written by `{}`: do not edit -->\n\n{text}\n",
            self.command
        )
    }

    fn split<'a>(&self, page: &'a str) -> Result<(&'a str, &'a str, &'a str)> {
        let (begin, end) = self.markers();
        let parts = || {
            let (before, rest) = page.split_once(&begin)?;
            let (inside, after) = rest.split_once(&end)?;
            Some((before, inside, after))
        };
        let lacks = || Error::check(format!("{} lacks the markers {begin} and {end}", self.file));
        parts().ok_or_else(lacks)
    }
}

/// Prints measurements as JSON.
pub fn print_json(value: &impl serde::Serialize) -> Result<()> {
    let text = serde_json::to_string_pretty(value)
        .map_err(|e| Error::check(format!("cannot write the JSON: {e}")))?;
    output::line(&text)?;
    Ok(())
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
    use super::{README, alike};

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
        assert!(README.split("nothing").is_err());
        let text = "a<!-- demo:begin -->b<!-- demo:end -->c";
        assert!(
            README
                .split(text)
                .is_ok_and(|parts| parts == ("a", "b", "c"))
        );
    }
}
