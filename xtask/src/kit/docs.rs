//! The parts of pages that commands write, their pictures, and their JSON.

#[cfg(test)]
pub mod repository;
pub mod seal;
#[cfg(test)]
mod tests;

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

/// The cost of a tick of the default scene.
pub const TICK: Page<'_> =
    Page { file: "docs/scenes.md", name: "demo", command: "cargo xtask demo --write-docs" };

impl Page<'_> {
    /// Puts a text between the markers.
    pub fn write(&self, workspace: &Workspace, text: &str) -> Result<()> {
        let path = workspace.root.join(self.file);
        let page = match self.name {
            "" => String::new(),
            _ => workspace::read(&path)?,
        };
        workspace::write(&workspace.report(self.file), self.replaced(&page, text)?)
    }

    /// The page with a text between the markers.
    pub fn replaced(&self, page: &str, text: &str) -> Result<String> {
        if self.name.is_empty() {
            return Ok(seal::sealed(text));
        }
        let (before, _, after) = self.split(page)?;
        let (begin, end) = self.markers();
        let generated = self.generated(text);
        Ok(format!("{before}{begin}\n{generated}{end}{after}"))
    }

    /// Fails unless the text between the markers is this one; or close to it, if `rustc` is the
    /// compiler that its figures depend on and another one wrote them.
    pub fn check(&self, workspace: &Workspace, text: &str, rustc: Option<&str>) -> Result<()> {
        let page = workspace::read(&workspace.root.join(self.file))?;
        let written = self.written(&page)?;
        // Without one nothing but the same will do.
        let (rustc, fresh) = (rustc.unwrap_or_default(), self.generated(text));
        compare(self.file, self.command, written, &fresh, rustc)
    }

    /// The text between the markers of a page.
    pub fn written<'a>(&self, page: &'a str) -> Result<&'a str> {
        match self.name {
            "" => Ok(page),
            _ => self.split(page).map(|(_, written, _)| written),
        }
    }

    fn markers(&self) -> (String, String) {
        let marker = |which| format!("<!-- {}:{which} -->", self.name);
        (marker("begin"), marker("end"))
    }

    /// The text between the markers, with the note that a command wrote it and its sum.
    pub fn generated(&self, text: &str) -> String {
        if self.name.is_empty() {
            return text.to_owned();
        }
        seal::sealed(&format!("<!-- written by `{}`: do not edit -->\n{text}", self.command))
    }

    fn split<'a>(&self, page: &'a str) -> Result<(&'a str, &'a str, &'a str)> {
        let (begin, end) = self.markers();
        let parts = page.split_once(&begin).and_then(|(before, rest)| {
            let (inside, after) = rest.split_once(&end)?;
            Some((before, inside, after))
        });
        let lacks = || check!("{} lacks the markers {begin} and {end}", self.file);
        parts.ok_or_else(lacks)
    }
}

/// Today and the commit that is checked out, for figures that no step measures anew.
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

/// Fails unless what was written is what would be written now with the compiler `rustc`. If the
/// text names another one, only the words are compared: the step `costs` and `budgets.toml` bound
/// its figures. If it names none, or `rustc` is empty, nothing but the same will do.
pub fn compare(file: &str, command: &str, written: &str, fresh: &str, rustc: &str) -> Result<()> {
    let [written, fresh] = [written, fresh].map(seal::unsealed);
    let same_figures = rustc.is_empty() || rustc_of(written).is_none_or(|by| by == rustc);
    let compared = [written, fresh].map(|text| match same_figures {
        true => text.trim().to_owned(),
        false => words(text.trim()),
    });
    match first_difference(&compared[0], &compared[1]) {
        None => Ok(()),
        Some((old, new)) => Err(check!(
            "{file} is out of date: `{command}` rewrites it\n  there: {old}\n  now:   {new}"
        )),
    }
}

/// A page without its figures, the rules and the padding that are as wide as they are, and the name
/// of its compiler.
fn words(page: &str) -> String {
    let lines = page.lines().map(|line| {
        let end = line.find(MEASURED).map(|at| at + MEASURED.len());
        let line = without_numbers(&line[..end.unwrap_or(line.len())]);
        line.replace([' ', ':'], "").replace("-", "")
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// The cells of a line of a table.
pub fn cells(line: &str) -> Option<Vec<&str>> {
    let inside = line.strip_prefix('|')?.strip_suffix('|')?;
    Some(inside.split('|').map(str::trim).collect())
}

/// Printed in place of a missing line.
const NO_LINE: &str = "(nothing)";

/// The first lines that are not the same.
fn first_difference<'a>(old: &'a str, new: &'a str) -> Option<(&'a str, &'a str)> {
    let (mut old, mut new) = (old.lines(), new.lines());
    loop {
        match (old.next(), new.next()) {
            (None, None) => return None,
            (a, b) if a == b => {}
            (a, b) => return Some((a.unwrap_or(NO_LINE), b.unwrap_or(NO_LINE))),
        }
    }
}

/// Fails unless a picture is what would be drawn now. If its figures were measured with another
/// compiler (`same_figures` is false), its numbers may be others, but neither its words nor the
/// shapes that it is made of.
pub fn compare_picture(
    workspace: &Workspace,
    file: &str,
    command: &str,
    fresh: &str,
    same_figures: bool,
) -> Result<()> {
    let written = workspace::read(&workspace.root.join(file))?;
    let same = if same_figures {
        written == fresh
    } else {
        without_numbers(&written) == without_numbers(fresh)
    };
    if same {
        return Ok(());
    }
    Err(check!("{file} is not the picture of today's figures: `{command}` draws it anew"))
}

/// A picture with each number in it replaced by the same sign.
fn without_numbers(svg: &str) -> String {
    let mut text = String::new();
    for letter in svg.chars() {
        match letter {
            '0'..='9' | '.' | ',' | '-' | '−' if text.ends_with('#') => {}
            '0'..='9' | '-' | '−' => text.push('#'),
            other => text.push(other),
        }
    }
    text
}
