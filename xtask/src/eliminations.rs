//! `cargo xtask eliminations`: the accuracy of the two methods of forward dynamics, measured on the host.

use std::process::ExitCode;

use crate::docs::Page;
use crate::error::Result;
use crate::host_bin;
use crate::output;
use crate::workspace::Workspace;

const PAGE: Page = Page {
    file: "docs/eliminations.md",
    name: "eliminations",
    command: "cargo xtask eliminations",
};
const BIN: &str = "eliminations";

const HEAD: &str = "\
| case | joints' coordinates | κ(M) | M, LᵀDL: median | worst | ABA: median | worst | worst, M / ABA | f64 |\n\
| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";

/// Measures and rewrites the page's table.
pub fn run() -> Result<ExitCode> {
    let workspace = Workspace::for_reports()?;
    let table = generated(&workspace)?;
    output::line(&table)?;
    PAGE.write(&workspace, &table)?;
    Ok(ExitCode::SUCCESS)
}

/// Fails unless the table on the page agrees with a new measurement: f32 gives the same bits everywhere.
pub fn check(workspace: &Workspace) -> Result<()> {
    PAGE.check(workspace, &generated(workspace)?, None)
}

fn generated(workspace: &Workspace) -> Result<String> {
    let rows = host_bin::text(workspace, BIN)?;
    Ok(format!("{HEAD}{}", rows.trim_end()))
}
