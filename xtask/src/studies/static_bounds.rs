//! `cargo xtask static`: the most cycles and the most stack of the rows of `cargo xtask costs` by their machine code: runs them, and has the
//! package `certification` bound what it finds.

use serde_json::{Value, json};

use crate::kit::error::{Result, check};
use crate::kit::progress::Spinner;
use crate::kit::rows::{self, Row};
use crate::kit::toolchain::RELEASE;
use crate::kit::{firmware, host_bin::SIMULATED, shell, workspace};
use crate::studies::costs::BINS;
use crate::studies::study::{Bench, Found};

pub fn measure(bench: &Bench<'_>) -> Result<Found> {
    let (workspace, tools) = (bench.workspace, bench.tools()?);
    let spinner = Spinner::start("building what is measured");
    let elves = firmware::build_bins(workspace, tools.toolchain, RELEASE, &BINS)?;
    let meter = firmware::build_meter(workspace)?;
    let mut certify = SIMULATED.program(workspace, "certify")?;
    let mut programs = Vec::new();
    for (bin, elf) in BINS.iter().zip(&elves) {
        spinner.say(format!("running {bin} in QEMU"));
        let rows = rows::run(tools, &meter, bin, elf)?.0;
        programs.push((elf, rows.iter().map(row).collect::<Vec<_>>()));
    }
    spinner.say("bounding".to_owned());
    let measured = workspace.target.join("static.json");
    workspace::write(&measured, json!(programs).to_string())?;
    let text = shell::capture(certify.arg("--rows").arg(&measured))?;
    let report: Value = serde_json::from_str(&text).map_err(|error| check!("certify: {error}"))?;
    let of = |name: &str| report[name].as_str().unwrap_or_default().to_owned();
    let wrong = report["wrong"].as_array().into_iter().flatten();
    Ok(Found {
        wrong: wrong
            .map(|one| one.as_str().unwrap_or_default().to_owned())
            .collect(),
        summary: of("summary"),
        rustc: Some(bench.rustc()?),
        ..Found::new(of("text"), &report)?
    })
}

/// A row as the package `certification` reads it.
fn row(row: &Row) -> Value {
    json!({
        "row": row.key(), "cycles": [row.cycles.min, row.cycles.max], "stack": row.stack_bytes,
        "function": row.address, "region": row.region,
    })
}
