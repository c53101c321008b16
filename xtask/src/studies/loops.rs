//! The accuracy of the dynamics of robots with kinematic loops, and their drawings.

use serde::Deserialize;

use super::host_table;
use crate::kit::chart::{self, BLUE, HEAD, HPos, INK, MUTED, RED, RGBColor};
use crate::kit::error::{Result, check};
use crate::kit::host_bin::SHARED;
use crate::studies::study::{Bench, Found};

const BIN: &str = "loops";
/// Drawings in a row, and px: a cell of one, its square in the cell, and what stands above all.
const COLUMNS: usize = 4;
const CELL: [i32; 2] = [240, 220];
const SIDE: i32 = 160;
const TOP: i32 = 76;

/// A robot as the host drew it: the parts of the drawing in their order, from 0 to 1 to the right and up.
#[derive(Deserialize)]
struct Drawing {
    name: String,
    parts: Vec<(String, Vec<[f64; 2]>)>,
}

/// The kinds of parts with their colour, and the width of lines; 0 of dots.
const PARTS: [(&str, &str, RGBColor, u32); 5] = [
    ("body", "a body", BLUE, 3),
    ("cylinder", "one in which another slides", MUTED, 7),
    ("base", "on the base", INK, 1),
    ("joint", "a joint that turns", INK, 0),
    ("closure", "where a loop is closed", RED, 0),
];

pub fn measure(bench: &Bench<'_>) -> Result<Found> {
    const HEAD: &str = "\
| robot | quantity | error, f64 | bound | error, f32 | bound |\n\
| --- | --- | ---: | ---: | ---: | ---: |\n";
    let lines = SHARED.text(bench.workspace, BIN)?;
    let (rows, drawn): (Vec<&str>, Vec<&str>) =
        lines.lines().partition(|line| line.starts_with('|'));
    let drawings = drawn.iter().map(|line| serde_json::from_str(line));
    let drawings: std::result::Result<Vec<Drawing>, _> = drawings.collect();
    let drawings = drawings.map_err(|e| check!("`{BIN}` drew what is not understood: {e}"))?;
    Ok(Found {
        picture: Some(svg(&drawings)?),
        ..host_table::found(HEAD, &rows)?
    })
}

fn svg(drawings: &[Drawing]) -> Result<String> {
    let rows = drawings.len().div_ceil(COLUMNS);
    let size = [CELL[0] * COLUMNS as i32, TOP + CELL[1] * rows as i32].map(|px| px as u32);
    chart::svg(size.into(), |root| {
        let title = "The robots with loops, drawn from their models (gears and belts, as in the last two, close at no point)";
        chart::label(root, title, (28, 24), HEAD, HPos::Left)?;
        let names = PARTS.map(|(_, words, colour, width)| (words.to_owned(), colour, width));
        chart::legend(root, names, (28, 50))?;
        let (_, below) = root.split_vertically(TOP);
        for (drawing, area) in drawings.iter().zip(&below.split_evenly((rows, COLUMNS))) {
            chart::label(area, &drawing.name, (CELL[0] / 2, 14), HEAD, HPos::Center)?;
            for (kind, points) in &drawing.parts {
                let px = |x: f64| (f64::from(SIDE) * x) as i32;
                let at = |[x, y]: &[f64; 2]| ((CELL[0] - SIDE) / 2 + px(*x), CELL[1] - 20 - px(*y));
                let points: Vec<_> = points.iter().map(at).collect();
                let part = PARTS.iter().find(|part| part.0 == kind);
                let (.., colour, width) =
                    part.ok_or_else(|| format!("a part of no kind: {kind}"))?;
                match width {
                    0 => chart::dot(area, points[0], 4, *colour)?,
                    _ => chart::path(area, &points, *colour, *width)?,
                }
            }
        }
        Ok(())
    })
}
