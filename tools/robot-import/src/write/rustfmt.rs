//! The format of Rust files.

use std::io::Write as _;
use std::process::{Command, Stdio};

/// A file as rustfmt formats it; as it is, if there is no rustfmt.
pub fn formatted(source: &str) -> String {
    run_rustfmt(source).ok().flatten().unwrap_or_else(|| source.to_owned())
}

fn run_rustfmt(source: &str) -> std::io::Result<Option<String>> {
    // Not the current folder: a `rust-toolchain.toml` beside a description names the program that
    // runs, and a `rustfmt.toml` its settings.
    let folder = tempfile::tempdir()?;
    let mut child = Command::new("rustfmt")
        .args(["--edition", "2024"])
        .current_dir(folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()?;
    let stdin = child.stdin.take();
    // Written beside the reading: a file is larger than a pipe's buffer.
    let text = source.to_owned();
    let writer =
        std::thread::spawn(move || stdin.map(|mut stdin| stdin.write_all(text.as_bytes())));
    let output = child.wait_with_output()?;
    let _ = writer.join();
    Ok(output.status.success().then(|| String::from_utf8_lossy(&output.stdout).into_owned()))
}
