//! `cargo xtask play`: the page of docs/play, whose scripts build and test it.

use std::process::{Command, ExitCode};

use crate::kit::error::{Error, Result};
use crate::kit::setup::{self, Options};
use crate::kit::workspace::Workspace;
use crate::kit::{host_bin::SHARED, shell, toolchain, workspace};

/// The target of the library in a browser.
const WASM: &str = "wasm32-unknown-unknown";
/// The tools that build the page, and those that test it besides, with Debian's packages.
const BUILD: [(&str, &str); 2] = [("node", "nodejs"), ("wasm-opt", "binaryen")];
const TEST: [(&str, &str); 2] = [("npm", "npm"), ("chromium", "chromium")];

/// A script of a folder of docs, and what it needs.
fn script(
    workspace: &Workspace,
    options: Options,
    name: &str,
    tools: &[(&'static str, &'static str)],
) -> Result<Command> {
    setup::for_programs(options, "the page of docs/play", tools)?;
    if !toolchain::native_has(WASM) {
        setup::for_cores(options, &[WASM], &[])?;
    }
    let mut node = Command::new("node");
    node.env("CARGO_TARGET_DIR", &workspace.target);
    node.arg(workspace.root.join("docs").join(name));
    Ok(node)
}

/// Builds by a script.
pub fn run(options: Options, name: &str) -> Result<ExitCode> {
    let mut node = script(&Workspace::find()?, options, name, &BUILD)?;
    shell::run(&mut node).map(|()| ExitCode::SUCCESS)
}

/// Holds the page to its bars in headless Chromium; returns its figures.
pub fn check(workspace: &Workspace, options: Options) -> Result<String> {
    let bits = workspace.output("play.bits")?;
    workspace::write(&bits, SHARED.text(workspace, "bits")?)?;
    let mut node = test(workspace, options, "play/test/play.mjs")?;
    last_line(node.arg("--host-bits").arg(&bits))
}

/// A script that tests; the step is skipped where its programs are not there and may not be
/// installed.
fn test(workspace: &Workspace, options: Options, name: &str) -> Result<Command> {
    let skip = |why: Error| Error::Skipped(why.to_string());
    let node = script(workspace, options, name, &[BUILD, TEST].concat()).map_err(skip)?;
    let old = "process.exit(+(parseInt(process.versions.node) < 20))";
    shell::capture(Command::new("node").args(["-e", old]))
        .map_err(|_| Error::Skipped("node is older than 20, which drives the browser".into()))?;
    Ok(node)
}

fn last_line(node: &mut Command) -> Result<String> {
    let printed = shell::capture(node)?;
    Ok(printed.lines().last().unwrap_or_default().to_owned())
}
