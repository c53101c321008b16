//! The picture of the tracking: where the arm goes, and how far each law strays.

use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::error::{Error, Result};
use crate::protocol::{PLANTS, Recording, SOLD, Sample, Trajectory, WITHOUT, in_print};
use crate::workspace;

const SIZE: (u32, u32) = (1080, 820);
const FONT: &str = "system-ui, Helvetica, Arial, sans-serif";
const INK: RGBColor = RGBColor(45, 50, 58);
const FAINT: RGBColor = RGBColor(228, 231, 235);

/// One colour per law; readable to the colour-blind.
const LAW_COLOURS: [RGBColor; 4] = [
    RGBColor(0, 128, 110),
    RGBColor(230, 145, 0),
    RGBColor(200, 50, 90),
    RGBColor(86, 120, 190),
];

/// One colour per joint, from the base; a longer arm starts over.
const JOINT_COLOURS: [RGBColor; 7] = [
    RGBColor(27, 80, 162),
    RGBColor(86, 160, 211),
    RGBColor(0, 140, 120),
    RGBColor(150, 180, 50),
    RGBColor(235, 150, 30),
    RGBColor(190, 70, 120),
    RGBColor(110, 90, 170),
];

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Outcome = std::result::Result<(), Box<dyn std::error::Error>>;

/// Writes the plot as an SVG.
pub fn write(recording: &Recording, path: &Path) -> Result<()> {
    workspace::write(path, svg(recording)?)
}

/// The plot as an SVG.
pub fn svg(recording: &Recording) -> Result<String> {
    // In memory first: the backend swallows errors when it writes to a file on drop.
    let mut svg = String::new();
    draw(recording, &mut svg)
        .map_err(|e| Error::check(format!("cannot draw {}: {e}", recording.scene)))?;
    Ok(svg)
}

fn draw(recording: &Recording, svg: &mut String) -> Outcome {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, body) = root.split_vertically(58);
    head.draw(&Text::new(
        format!(
            "{}: tracking on a simulated arm, tick {} µs",
            recording.scene, recording.tick_us
        ),
        (28, 20),
        (FONT, 26, FontStyle::Bold).into_font().color(&INK),
    ))?;
    let (top, bottom) = body.split_vertically(360);
    references(recording, &top)?;
    let (left, right) = bottom.split_horizontally(SIZE.0 as i32 / 2);
    let range = error_range(recording);
    errors(
        recording,
        PLANTS[0],
        "exact model; RMS in mrad",
        range,
        &left,
    )?;
    errors(
        recording,
        PLANTS[1],
        "plant off: inertias ±3 %, friction ±10 %; RMS in mrad",
        range,
        &right,
    )?;
    root.present()?;
    Ok(())
}

/// Seconds of a tick count.
fn seconds(recording: &Recording, tick: u32) -> f64 {
    f64::from(tick) * f64::from(recording.tick_us) * 1e-6
}

fn references(recording: &Recording, area: &Area<'_>) -> Outcome {
    let Some(run) = recording.trajectory(PLANTS[0], SOLD) else {
        return Ok(());
    };
    let angles = || run.samples.iter().flat_map(|s| &s.reference).copied();
    let low = angles().fold(f64::INFINITY, f64::min);
    let high = angles().fold(f64::NEG_INFINITY, f64::max);
    let margin = 0.06 * (high - low).max(1e-3);
    let end = seconds(recording, recording.ticks);

    let names: Vec<String> = (1..=recording.joints)
        .map(|i| format!("joint {i}"))
        .collect();
    let colour = |joint: usize| JOINT_COLOURS[joint % JOINT_COLOURS.len()];
    let entries = names
        .iter()
        .enumerate()
        .map(|(i, name)| (name.as_str(), colour(i)));
    panel_head(area, "reference angles", entries, (230, 18))?;
    let mut chart = ChartBuilder::on(area)
        .margin_top(36)
        .margin_right(28)
        .margin_left(14)
        .x_label_area_size(46)
        .y_label_area_size(64)
        .build_cartesian_2d(0.0..end, low - margin..high + margin)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(FAINT)
        .axis_style(INK)
        .label_style((FONT, 15).into_font().color(&INK))
        .axis_desc_style((FONT, 16).into_font().color(&INK))
        .x_desc("time, s")
        .y_desc("angle, rad")
        .x_labels(10)
        .y_labels(7)
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_label_formatter(&|y| format!("{y:.1}"))
        .draw()?;
    for joint in 0..recording.joints {
        let points = run
            .samples
            .iter()
            .map(|s| (seconds(recording, s.tick), s.reference[joint]));
        // Wider towards the base, so that a joint shows behind another that moves alike.
        let width = 2 + (recording.joints - joint) as u32 / 2;
        chart.draw_series(LineSeries::new(points, colour(joint).stroke_width(width)))?;
    }
    Ok(())
}

/// The largest absolute error of any joint in mrad.
fn worst(sample: &Sample) -> f64 {
    std::iter::zip(&sample.reference, &sample.angle)
        .map(|(reference, angle)| 1e3 * (reference - angle).abs())
        .fold(0.0, f64::max)
}

/// Whole decades around what both panels show, but no more than five.
fn error_range(recording: &Recording) -> (f64, f64) {
    let mut values: Vec<f64> = recording
        .runs
        .iter()
        .filter(|((_, law), _)| !law.starts_with(WITHOUT))
        .flat_map(|(_, run): (_, &Trajectory)| run.samples.iter().map(worst))
        .filter(|error| *error > 0.0)
        .collect();
    values.sort_by(f64::total_cmp);
    let (Some(&high), Some(&low)) = (values.last(), values.get(values.len() / 50)) else {
        return (0.1, 10.0);
    };
    let top = 10f64.powf(high.log10().ceil());
    (
        10f64.powf(low.log10().floor()).clamp(top * 1e-5, top * 0.1),
        top,
    )
}

fn errors(
    recording: &Recording,
    plant: &str,
    title: &str,
    (low, high): (f64, f64),
    area: &Area<'_>,
) -> Outcome {
    let laws = recording.laws(plant);
    let names: Vec<String> = laws
        .iter()
        .map(|law| {
            let rms = recording.trajectory(plant, law).and_then(|run| run.total);
            let name = in_print(law);
            rms.map_or(name.clone(), |rms| format!("{name} ({})", short(1e3 * rms)))
        })
        .collect();
    let entries = std::iter::zip(names.iter().map(String::as_str), LAW_COLOURS);
    panel_head(area, title, entries, (80, 40))?;
    let end = seconds(recording, recording.ticks);
    let mut chart = ChartBuilder::on(area)
        .margin_top(60)
        .margin_right(28)
        .margin_left(14)
        .margin_bottom(6)
        .x_label_area_size(46)
        .y_label_area_size(64)
        .build_cartesian_2d(0.0..end, (low..high).log_scale())?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(FAINT)
        .axis_style(INK)
        .label_style((FONT, 15).into_font().color(&INK))
        .axis_desc_style((FONT, 16).into_font().color(&INK))
        .x_desc("time, s")
        .y_desc("largest |error|, mrad")
        .x_labels(10)
        .y_labels(((high / low).log10().round() as usize) + 1)
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_label_formatter(&|y| format!("{y}"))
        .draw()?;
    // The worst first, so that the best is drawn on top.
    for (law, colour) in std::iter::zip(laws, LAW_COLOURS)
        .collect::<Vec<_>>()
        .into_iter()
        .rev()
    {
        let Some(run) = recording.trajectory(plant, law) else {
            continue;
        };
        let points = run
            .samples
            .iter()
            .map(|s| (seconds(recording, s.tick), worst(s).clamp(low, high)));
        chart.draw_series(LineSeries::new(points, colour.stroke_width(2)))?;
    }
    Ok(())
}

/// Three digits of a number, for people.
fn short(value: f64) -> String {
    let decimals = (2.0 - value.abs().max(1e-3).log10().floor()).clamp(0.0, 4.0);
    format!("{value:.*}", decimals as usize)
}

/// A title, and a legend beside or below it: plotters' own legend box comes out misshapen,
/// since the widths of texts in an SVG are not known.
fn panel_head<'n>(
    area: &Area<'_>,
    title: &str,
    entries: impl Iterator<Item = (&'n str, RGBColor)>,
    (left, y): (i32, i32),
) -> Outcome {
    let font = |size: i32| (FONT, size).into_font().color(&INK);
    let middle = Pos::new(HPos::Left, VPos::Center);
    area.draw(&Text::new(title.to_owned(), (80, 18), font(17).pos(middle)))?;
    let mut x = left;
    for (name, colour) in entries {
        let line = vec![(x, y), (x + 16, y)];
        area.draw(&PathElement::new(line, colour.stroke_width(3)))?;
        area.draw(&Text::new(
            name.to_owned(),
            (x + 22, y),
            font(15).pos(middle),
        ))?;
        x += 44 + 7 * name.chars().count() as i32;
    }
    Ok(())
}
