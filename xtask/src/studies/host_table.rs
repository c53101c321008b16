//! Pages with one table whose lines a bin of `host-reports` prints: the same bits everywhere.

use crate::kit::docs::cells;
use crate::kit::error::Result;
use crate::kit::host_bin;
use crate::studies::study::{Bench, Found};

/// The accuracy of the two methods of forward dynamics.
pub fn eliminations(bench: &Bench<'_>) -> Result<Found> {
    const HEAD: &str = "\
| case | joints' coordinates | κ(M) | M, LᵀDL: median | worst | ABA: median | worst | worst, M / ABA | f64 |\n\
| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
    table(bench, "eliminations", HEAD)
}

/// The accuracy of the dynamics of robots with kinematic loops.
pub fn loops(bench: &Bench<'_>) -> Result<Found> {
    const HEAD: &str = "\
| robot | quantity | error, f64 | bound | error, f32 | bound |\n\
| --- | --- | ---: | ---: | ---: | ---: |\n";
    table(bench, "loops", HEAD)
}

fn table(bench: &Bench<'_>, bin: &str, head: &str) -> Result<Found> {
    let rows = host_bin::text(bench.workspace, bin)?;
    let measured: Vec<_> = rows.lines().filter_map(cells).collect();
    Found::new(format!("{head}{}", rows.trim_end()), &measured)
}
