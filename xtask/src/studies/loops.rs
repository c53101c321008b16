//! The accuracy of the dynamics of robots with kinematic loops, and their drawings.

use serde::Deserialize;

use super::host_table;
use crate::kit::chart::{self, Area, BLUE, HEAD, HPos, INK, MUTED, Outcome, RED};
use crate::kit::error::{Result, check};
use crate::kit::host_bin;
use crate::studies::study::{Bench, Found};

const BIN: &str = "loops";
/// Drawings in a row, and px: a drawing with its name, the room around it, and what stands above all.
const COLUMNS: usize = 4;
const WIDE: i32 = 240;
const HIGH: i32 = 220;
const MARGIN: f64 = 30.0;
const TOP: i32 = 76;

type Point = [f64; 2];

/// A robot as the host drew it, in m.
#[derive(Deserialize)]
struct Drawing {
    name: String,
    bodies: Vec<(bool, Vec<Point>)>,
    joints: Vec<Point>,
    ground: Vec<Point>,
    closed: Vec<Point>,
}

pub fn measure(bench: &Bench<'_>) -> Result<Found> {
    const HEAD: &str = "\
| robot | quantity | error, f64 | bound | error, f32 | bound |\n\
| --- | --- | ---: | ---: | ---: | ---: |\n";
    let lines = host_bin::text(bench.workspace, BIN)?;
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
    let size = [WIDE * COLUMNS as i32, TOP + HIGH * rows as i32].map(|px| px as u32);
    chart::svg(size.into(), |root| {
        let title = "The robots with loops, drawn from their models (gears and belts, as in the last two, close at no point)";
        chart::label(root, title, (28, 24), chart::TITLE, HPos::Left)?;
        let entries = [
            ("a body", BLUE, 3),
            ("one in which another slides", MUTED, 7),
            ("where a loop is closed", RED, 5),
            ("the base", INK, 1),
        ];
        let entries = entries.map(|(name, colour, width)| (name.to_owned(), colour, width));
        chart::legend(root, entries, (28, 50))?;
        let (_, below) = root.split_vertically(TOP);
        for (drawing, area) in drawings.iter().zip(&below.split_evenly((rows, COLUMNS))) {
            draw(drawing, area)?;
        }
        Ok(())
    })
}

fn draw(drawing: &Drawing, area: &Area<'_>) -> Outcome {
    let bodies = || drawing.bodies.iter().flat_map(|(_, line)| line);
    let all = || bodies().chain(&drawing.ground);
    let ends = [0, 1].map(|axis| {
        let values = || all().map(|point| point[axis]);
        [
            values().fold(f64::INFINITY, f64::min),
            values().fold(f64::NEG_INFINITY, f64::max),
        ]
    });
    let room = [
        f64::from(WIDE) - 2.0 * MARGIN,
        f64::from(HIGH) - 2.0 * MARGIN - 24.0,
    ];
    let scale = std::iter::zip(ends, room).map(|([low, high], px)| px / (high - low).max(1e-3));
    let scale = scale.fold(f64::INFINITY, f64::min);
    let at = |point: &Point| {
        let from = |axis: usize| scale * (point[axis] - 0.5 * (ends[axis][0] + ends[axis][1]));
        (WIDE / 2 + from(0) as i32, (HIGH + 24) / 2 - from(1) as i32)
    };
    chart::label(area, &drawing.name, (WIDE / 2, 14), HEAD, HPos::Center)?;
    for (x, y) in drawing.ground.iter().map(at) {
        chart::path(
            area,
            &[(x - 14, y + 9), (x, y), (x + 14, y + 9), (x - 14, y + 9)],
            INK,
            1,
        )?;
        for x in (x - 12..x + 12).step_by(6) {
            chart::path(area, &[(x, y + 14), (x + 5, y + 9)], INK, 1)?;
        }
    }
    let (wide, narrow): (Vec<_>, Vec<_>) = drawing.bodies.iter().partition(|(slides, _)| *slides);
    for (slides, line) in wide.into_iter().chain(narrow) {
        let (colour, width) = if *slides { (MUTED, 7) } else { (BLUE, 3) };
        chart::path(
            area,
            &line.iter().map(at).collect::<Vec<_>>(),
            colour,
            width,
        )?;
    }
    for (points, colour) in [(&drawing.joints, INK), (&drawing.closed, RED)] {
        for point in points {
            chart::dot(area, at(point), 4, colour)?;
        }
    }
    Ok(())
}
