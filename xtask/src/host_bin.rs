//! What the reports measure on the host: the bins of the package `host-reports`.

use serde::de::DeserializeOwned;

use crate::error::{Result, check};
use crate::shell;
use crate::workspace::Workspace;

/// What a bin prints.
pub fn text(workspace: &Workspace, bin: &str) -> Result<String> {
    text_of(workspace, "host-reports", bin)
}

/// What a bin of another package prints.
pub fn text_of(workspace: &Workspace, package: &str, bin: &str) -> Result<String> {
    let mut command = workspace.cargo("run");
    shell::capture(command.args(["--quiet", "--package", package, "--bin", bin]))
}

/// The same of a bin that prints JSON.
pub fn json<T: DeserializeOwned>(workspace: &Workspace, bin: &str) -> Result<T> {
    json_of(workspace, "host-reports", bin)
}

/// The same of a bin of another package.
pub fn json_of<T: DeserializeOwned>(workspace: &Workspace, package: &str, bin: &str) -> Result<T> {
    serde_json::from_str(&text_of(workspace, package, bin)?)
        .map_err(|e| check!("`{bin}` printed what is not understood: {e}"))
}
