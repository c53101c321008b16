//! Pages with one table whose lines a bin of `host-reports` prints: the same bits everywhere.

use crate::kit::docs::cells;
use crate::kit::error::Result;
use crate::kit::host_bin::SHARED;
use crate::studies::study::{Bench, Found};

/// The accuracy of the two methods of forward dynamics.
pub fn eliminations(bench: &Bench<'_>) -> Result<Found> {
    const HEAD: &str = "\
| case | joints' coordinates | κ(M) | M, LᵀDL: median | worst | ABA: median | worst | worst, M / ABA | f64 |\n\
| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
    table(bench, "eliminations", HEAD)
}

fn table(bench: &Bench<'_>, bin: &str, head: &str) -> Result<Found> {
    let text = SHARED.text(bench.workspace, bin)?;
    found(head, &text.lines().collect::<Vec<_>>())
}

/// The table with these rows under its head.
pub fn found(head: &str, rows: &[&str]) -> Result<Found> {
    let measured: Vec<_> = rows.iter().copied().filter_map(cells).collect();
    Found::new(format!("{head}{}", rows.join("\n")), &measured)
}
