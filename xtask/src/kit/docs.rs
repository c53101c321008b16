//! The parts of pages that commands write, their pictures, and their JSON.

#[cfg(test)]
pub mod repository;

use std::process::{Command, ExitCode};

use time::OffsetDateTime;

use crate::kit::error::{Result, check};
use crate::kit::table::plain;
use crate::kit::workspace::{self, Workspace};
use crate::kit::{output, shell};

/// The part of a page that a command writes: between `<!-- NAME:begin -->` and `<!-- NAME:end -->`.
#[derive(Clone, Copy, Debug)]
pub struct Page<'a> {
    pub file: &'a str,
    /// In the markers; empty if the command writes the whole page.
    pub name: &'a str,
    pub command: &'a str,
}

impl Page<'_> {
    /// Puts a text between the markers, with the day and the commit.
    pub fn write(&self, workspace: &Workspace, text: &str) -> Result<()> {
        let path = workspace.root.join(self.file);
        let page = match self.name {
            "" => String::new(),
            _ => workspace::read(&path)?,
        };
        let text = format!("{}\n\nWritten on {}.\n", text.trim(), today_and_commit(workspace));
        workspace::write(&workspace.report(self.file), self.replaced(&page, &text)?)
    }

    /// The page with a text between the markers.
    pub fn replaced(&self, page: &str, text: &str) -> Result<String> {
        if self.name.is_empty() {
            return Ok(text.to_owned());
        }
        let marker = |which| format!("<!-- {}:{which} -->", self.name);
        let (begin, end) = (marker("begin"), marker("end"));
        let parts = page.split_once(&begin).and_then(|(before, rest)| {
            let (_, after) = rest.split_once(&end)?;
            Some((before, after))
        });
        let lacks = || check!("{} lacks the markers {begin} and {end}", self.file);
        let (before, after) = parts.ok_or_else(lacks)?;
        let note = format!("<!-- written by `{}`: do not edit -->", self.command);
        Ok(format!("{before}{begin}\n{note}\n{text}{end}{after}"))
    }
}

/// Today and the commit that is checked out.
pub fn today_and_commit(workspace: &Workspace) -> String {
    let today = OffsetDateTime::now_utc().date();
    let mut git = Command::new("git");
    git.current_dir(&workspace.root);
    match shell::capture(git.args(["describe", "--always", "--dirty"])) {
        Ok(commit) => format!("{today} at commit {}", commit.trim()),
        // An archive of the sources is no repository.
        Err(_) => format!("{today} at an unknown commit"),
    }
}

pub fn json(value: &impl serde::Serialize) -> Result<String> {
    serde_json::to_string_pretty(value).map_err(|e| check!("cannot write the JSON: {e}"))
}

/// A list of values, one a line.
pub fn json_lines(values: &[impl serde::Serialize]) -> Result<String> {
    let line =
        |value| serde_json::to_string(value).map_err(|e| check!("cannot write the JSON: {e}"));
    let lines = values.iter().map(line).collect::<Result<Vec<_>>>()?;
    Ok(format!("[\n{}\n]", lines.join(",\n")))
}

pub fn print_json(value: &impl serde::Serialize) -> Result<()> {
    output::line(&json(value)?)
}

/// Prints a report: its measurements as JSON, or its page.
pub fn show(json: bool, measurements: &impl serde::Serialize, markdown: &str) -> Result<ExitCode> {
    if json {
        print_json(measurements)?;
    } else {
        output::print(&format!("\n{}", plain(markdown)))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The words before the compiler's name on every page whose figures depend on it.
const MEASURED: &str = "Measured with ";

/// The compiler that a page's figures were measured with, if it names one.
pub fn rustc_of(page: &str) -> Option<&str> {
    let (_, after) = page.split_once(MEASURED)?;
    after.lines().next()?.trim_end().strip_suffix('.')
}

/// The cells of a line of a table.
pub fn cells(line: &str) -> Option<Vec<&str>> {
    let inside = line.strip_prefix('|')?.strip_suffix('|')?;
    Some(inside.split('|').map(str::trim).collect())
}

#[cfg(test)]
mod tests {
    use super::Page;
    use crate::kit::workspace::Workspace;

    #[test]
    fn a_part_is_written_between_its_markers() {
        const PART: Page<'_> = Page { file: "page.md", name: "demo", command: "cargo xtask demo" };
        let folder = tempfile::tempdir().expect("a folder");
        let (workspace, path) = (Workspace::at(folder.path()), folder.path().join(PART.file));
        let (begin, end) = ("By hand.\n<!-- demo:begin -->\n", "<!-- demo:end -->\nBelow.\n");
        std::fs::write(&path, format!("{begin}{end}")).expect("written");
        for text in ["The text.", "Another."] {
            PART.write(&workspace, text).expect("written");
            let page = std::fs::read_to_string(&path).expect("there");
            assert!(page.starts_with(begin) && page.ends_with(end), "{page}");
            assert!(page.contains(&format!("do not edit -->\n{text}\n\nWritten on ")), "{page}");
        }
        assert!(PART.replaced("no markers", "").is_err());
    }
}
