//! `cargo xtask eliminations`: which way of forward dynamics is less accurate where, measured on the host.

use std::process::ExitCode;

use crate::error::{Error, Result};
use crate::shell;
use crate::workspace::{self, Workspace};

const PAGE: &str = "docs/eliminations.md";
const COMMAND: &str = "cargo xtask eliminations";
const BIN: &str = "eliminations";
const BEGIN: &str = "<!-- eliminations:begin -->";
const END: &str = "<!-- eliminations:end -->";

const HEAD: &str = "\
| case | joints' coordinates | κ(M) | M, LᵀDL: median | worst | ABA: median | worst | worst, M / ABA | f64 |\n\
| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";

/// Measures and rewrites the page's table.
pub fn run() -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    let path = workspace.root.join(PAGE);
    let text = workspace::read(&path)?;
    let (before, _, after) = split(&text)?;
    let table = generated(&workspace)?;
    print!("{table}");
    workspace::write(&path, format!("{before}{BEGIN}\n{table}{END}{after}"))?;
    Ok(ExitCode::SUCCESS)
}

/// Fails unless the page's table is what would be measured now: f32 gives the same bits everywhere.
pub fn check(workspace: &Workspace) -> Result<()> {
    let text = workspace::read(&workspace.root.join(PAGE))?;
    let (_, written, _) = split(&text)?;
    if written.trim() == generated(workspace)?.trim() {
        return Ok(());
    }
    Err(Error::check(format!(
        "{PAGE} is out of date: `{COMMAND}` rewrites it"
    )))
}

fn generated(workspace: &Workspace) -> Result<String> {
    let mut command = workspace.cargo("run");
    command.args(["--quiet", "--package", "host-tests", "--bin", BIN]);
    let lines = shell::capture(&mut command)?;
    Ok(format!(
        "<!-- written by `{COMMAND}`: do not edit -->\n\n{HEAD}{lines}\n"
    ))
}

fn split(text: &str) -> Result<(&str, &str, &str)> {
    let parts = || {
        let (before, rest) = text.split_once(BEGIN)?;
        let (inside, after) = rest.split_once(END)?;
        Some((before, inside, after))
    };
    parts().ok_or_else(|| Error::check(format!("{PAGE} lacks the markers {BEGIN} and {END}")))
}
