//! The measurements of the reports on the host: the bins of the package `host-reports`.

use serde::de::DeserializeOwned;

use crate::kit::error::{Result, check};
use crate::kit::shell;
use crate::kit::workspace::Workspace;

pub fn text(workspace: &Workspace, bin: &str) -> Result<String> {
    text_of(workspace, "host-reports", bin)
}

/// Runs a bin of another package and returns its output.
pub fn text_of(workspace: &Workspace, package: &str, bin: &str) -> Result<String> {
    let mut command = workspace.cargo("run");
    shell::capture(command.args(["--quiet", "--package", package, "--bin", bin]))
}

/// Runs a bin of `host-reports` and parses its JSON.
pub fn json<T: DeserializeOwned>(workspace: &Workspace, bin: &str) -> Result<T> {
    json_of(workspace, "host-reports", bin)
}

/// Runs a bin of another package and parses its JSON.
pub fn json_of<T: DeserializeOwned>(workspace: &Workspace, package: &str, bin: &str) -> Result<T> {
    serde_json::from_str(&text_of(workspace, package, bin)?)
        .map_err(|e| check!("`{bin}` printed what is not understood: {e}"))
}
