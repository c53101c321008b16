//! The picture of the tracking, a column of charts for each joint: where the reference leads it,
//! and how far it strays under each law.

use std::path::Path;

use crate::kit::bars::largest;
use crate::kit::chart::{self, Area, Axis, HEAD, HPos, INK, Line, Outcome, TEXT};
use crate::kit::error::Result;
use crate::kit::protocol::{FEEDFORWARD, PD, PLANTS, Recording, Sample, label};
use crate::kit::workspace;

/// Samples of which one point of an error's line is the largest: more points would not be visible.
const OF_A_POINT: usize = 5;
const WIDTH: i32 = 1160;
/// The height of a row of charts, the distance between rows, and the margin for labels, pixels.
const ROWS: [i32; 3] = [210, 240, 280];
const ROOM: [u32; 2] = [62, 44];

/// Writes the plot as an SVG, if there is a reference to follow.
pub fn write(recording: &Recording, path: &Path) -> Result<()> {
    if recording.runs.iter().all(|run| run.samples.is_empty()) {
        return Ok(());
    }
    workspace::write(path, svg(recording)?)
}

pub fn svg(recording: &Recording) -> Result<String> {
    let height = 52 + ROWS.iter().sum::<i32>();
    chart::svg((WIDTH as u32, height as u32), |root| {
        // A model's number is in capitals; other scenes have words.
        let name = match &*recording.scene {
            "ur5e" => "UR5e".into(),
            other => other.replace('_', " "),
        };
        let rate = 1e3 / f64::from(recording.tick_us);
        let title = format!("{name}, simulated: tracking error of each joint, {rate} kHz");
        chart::label(root, &title, (28, 24), chart::TITLE, HPos::Left)?;
        let (_, rest) = root.split_vertically(52);
        let (references, rest) = rest.split_vertically(ROWS[0]);
        let (exact, mismatched) = rest.split_vertically(ROWS[1]);
        self::references(recording, &references)?;
        let what = "the plant is the controller's model";
        errors(recording, PLANTS[0], what, 0, &exact)?;
        let what = "the plant differs from the controller's model: inertias by up to ±3 %, \
            friction by up to ±10 %";
        errors(recording, PLANTS[1], what, ROOM[1], &mismatched)
    })
}

/// A chart for each joint, side by side, the first of which has the axis of all; `top` pixels are
/// for a head.
fn columns(
    recording: &Recording,
    area: &Area<'_>,
    (top, below): (u32, u32),
    y: &Axis,
    lines: impl Fn(usize) -> Vec<Line>,
) -> Outcome {
    let mut rest = area.clone();
    let room = y.room as i32;
    let wide = (WIDTH - room) / recording.joints.max(1) as i32;
    for joint in 0..recording.joints {
        let first = joint == 0;
        let (column, others) = rest.split_horizontally(if first { wide + room } else { wide });
        rest = others;
        let end = seconds(recording, recording.ticks);
        let mut x = Axis::linear("time, s", [0.0, end], 4, below);
        if below == 0 {
            x.name = "";
        }
        let mut y = y.clone();
        if !first {
            (y.name, y.room) = ("", 0);
        }
        chart::lines(&column, top, [&x, &y], &lines(joint))?;
    }
    Ok(())
}

fn seconds(recording: &Recording, tick: u32) -> f64 {
    f64::from(tick) * f64::from(recording.tick_us) * 1e-6
}

fn references(recording: &Recording, area: &Area<'_>) -> Outcome {
    let Some(run) = recording.trajectory(PLANTS[0], FEEDFORWARD) else {
        return Ok(());
    };
    chart::label(area, "reference", (ROOM[0] as i32, 12), HEAD, HPos::Left)?;
    let wide = (WIDTH - ROOM[0] as i32) / recording.joints.max(1) as i32;
    for joint in 0..recording.joints as i32 {
        let middle = ROOM[0] as i32 + wide * joint + wide / 2;
        let name = format!("joint {}", joint + 1);
        chart::label(area, &name, (middle, 32), TEXT, HPos::Center)?;
    }
    let angles = || run.samples.iter().flat_map(|s| &s.reference).copied();
    let [low, high] = [f64::min, f64::max].map(|pick| angles().reduce(pick).unwrap_or(0.0));
    let margin = 0.06 * (high - low).max(1e-3);
    let y = Axis::linear("rad", [low - margin, high + margin], 5, ROOM[0]);
    columns(recording, area, (44, 0), &y, |joint| {
        let points = run.samples.iter();
        let points = points.map(|s| (seconds(recording, s.tick), s.reference[joint]));
        vec![Line { points: points.collect(), colour: INK, width: 2, dots: 0 }]
    })
}

/// The largest absolute error of a joint in some samples, mrad.
fn worst(samples: &[Sample], joint: usize) -> f64 {
    let errors = samples.iter().map(|s| s.reference[joint] - s.angle[joint]);
    largest(errors.map(|error| 1e3 * error.abs()))
}

/// Whole decades around what all charts show, but no more than five.
fn error_range(recording: &Recording) -> [f64; 2] {
    let shown = PLANTS.iter().flat_map(|plant| {
        let laws = recording.laws(plant).into_iter();
        laws.filter_map(|law| recording.trajectory(plant, law))
    });
    let joints = 0..recording.joints;
    let mut values: Vec<f64> = shown
        .flat_map(|run| run.samples.chunks(OF_A_POINT))
        .flat_map(|samples| joints.clone().map(|joint| worst(samples, joint)))
        .filter(|error| *error > 0.0)
        .collect();
    values.sort_by(f64::total_cmp);
    let (Some(high), Some(low)) = (values.last(), values.get(values.len() / 50)) else {
        return [0.1, 10.0];
    };
    let top = 10_f64.powf(high.log10().ceil());
    let low = 10_f64.powf(low.log10().floor());
    [low.clamp(top * 1e-5, top * 0.1), top]
}

fn errors(recording: &Recording, plant: &str, what: &str, below: u32, area: &Area<'_>) -> Outcome {
    let laws = recording.laws(plant);
    let entries = laws.iter().zip(chart::COLOURS).map(|(law, colour)| {
        let run = recording.trajectory(plant, law);
        let rms = short(run.map_or(f64::NAN, |run| 1e3 * run.total));
        (format!("{}: {rms} mrad RMS", label(law)), colour, width(law))
    });
    let left = ROOM[0] as i32;
    let head = format!("error where {what}");
    chart::label(area, &head, (left, 16), HEAD, HPos::Left)?;
    chart::legend(area, entries, (left, 38))?;
    let y = Axis::decades("|error|, mrad", error_range(recording), ROOM[0]);
    columns(recording, area, (54, below), &y, |joint| {
        let colours = laws.iter().zip(chart::COLOURS);
        // The worst first, so that the best is drawn on top.
        let runs = colours.rev().filter_map(|(law, colour)| {
            Some((recording.trajectory(plant, law)?, colour, width(law)))
        });
        let line = |(run, colour, width): (&crate::kit::protocol::Trajectory, _, _)| {
            let points = run.samples.chunks(OF_A_POINT);
            let points = points.map(|s| (seconds(recording, s[0].tick), worst(s, joint)));
            Line { points: points.collect(), colour, width, dots: 0 }
        };
        runs.map(line).collect()
    })
}

/// If gravity has no torque, a law of gravity is PD alone: that is the wide line, so that it is
/// seen below the other.
fn width(law: &str) -> u32 {
    if law == PD { 5 } else { 2 }
}

/// Three digits of a number, for people.
fn short(value: f64) -> String {
    let decimals = (2.0 - value.abs().max(1e-3).log10().floor()).clamp(0.0, 4.0);
    format!("{value:.*}", decimals as usize)
}
