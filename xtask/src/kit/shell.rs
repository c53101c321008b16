//! Running other programs.

use std::io::{BufRead, BufReader, IsTerminal};
use std::path::PathBuf;
use std::process::{Child, Command, ExitStatus, Stdio};

pub use crate::kit::display::display;
use crate::kit::error::{Error, Result};
use crate::kit::processes::Group;

/// Starts a command whose processes end on a signal that ends xtask.
pub fn spawn(command: &mut Command) -> Result<(Child, Group)> {
    Group::spawn(command).map_err(|e| Error::spawn(command, e))
}

/// Runs a command whose output the user watches. All of it goes to stderr, since stdout is
/// kept for `--json`.
pub fn run(command: &mut Command) -> Result<()> {
    command.stdin(Stdio::null()).stdout(std::io::stderr());
    let (mut child, _group) = spawn(command)?;
    let status = child.wait().map_err(|e| Error::spawn(command, e))?;
    succeeded(command, status)
}

/// Runs a command whose output and errors are the user's, and returns how it ended. If stdout is a
/// terminal, the command stays in the foreground group, whose programs alone may read from the
/// terminal; elsewhere it ends with xtask.
pub fn run_for_user(command: &mut Command) -> Result<ExitStatus> {
    let status = if std::io::stdout().is_terminal() {
        command.status()
    } else {
        let (mut child, _group) = spawn(command.stdin(Stdio::null()))?;
        child.wait()
    };
    status.map_err(|e| Error::spawn(command, e))
}

/// Runs a command that may ask for a password: it stays in the terminal's foreground group, whose
/// programs alone may read from it and all get what is typed to interrupt.
pub fn run_with_questions(command: &mut Command) -> Result<()> {
    let status = command.stdout(std::io::stderr()).status();
    succeeded(command, status.map_err(|e| Error::spawn(command, e))?)
}

fn succeeded(command: &Command, status: ExitStatus) -> Result<()> {
    if status.success() {
        return Ok(());
    }
    Err(Error::failed(command, status, String::new()))
}

/// Runs a command and returns its stdout; what it printed is shown only if it fails.
pub fn capture(command: &mut Command) -> Result<String> {
    let (child, _group) = spawn(heard_by(command, Stdio::piped))?;
    let out = child.wait_with_output();
    let out = out.map_err(|e| Error::spawn(command, e))?;
    let [stdout, stderr] =
        [out.stdout, out.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    if out.status.success() {
        return Ok(stdout);
    }
    let output = format!("\n{stdout}{stderr}");
    let output = output.trim_end().to_owned();
    Err(Error::failed(command, out.status, output))
}

/// Whether the command can be started and succeeds, with nothing shown.
pub fn succeeds(command: &mut Command) -> bool {
    let status = heard_by(command, Stdio::null).status();
    status.is_ok_and(|status| status.success())
}

/// A command that reads nothing, and whose output goes there.
pub fn heard_by(command: &mut Command, place: fn() -> Stdio) -> &mut Command {
    command.stdin(Stdio::null()).stdout(place()).stderr(place())
}

/// Runs a command and hands over each line that it prints as it comes, of stderr too.
pub fn follow(command: &mut Command, mut on_line: impl FnMut(&str)) -> Result<()> {
    let (reader, writer) = std::io::pipe().map_err(|e| Error::spawn(command, e))?;
    let other = writer.try_clone().map_err(|e| Error::spawn(command, e))?;
    command.stdin(Stdio::null()).stdout(writer).stderr(other);
    let (mut child, _group) = spawn(command)?;
    // The pipe ends when nobody holds it for writing.
    heard_by(command, Stdio::null);
    for line in BufReader::new(reader).lines().map_while(std::io::Result::ok) {
        on_line(&line);
    }
    let status = child.wait().map_err(|e| Error::spawn(command, e))?;
    succeeded(command, status)
}

/// The path of a program on the PATH.
pub fn which(program: &str) -> Option<PathBuf> {
    all_of(program).next()
}

/// All programs of this name on the PATH, in its order.
pub fn all_of(program: &str) -> impl Iterator<Item = PathBuf> {
    let file = format!("{program}{}", std::env::consts::EXE_SUFFIX);
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
    folders.into_iter().map(move |folder| folder.join(&file)).filter(|file| file.is_file())
}
