//! The picture of the growth: instructions against bodies, both logarithmic.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::{ALGORITHMS, Report};
use crate::error::{Error, Result};

const SIZE: (u32, u32) = (960, 640);
const FONT: &str = "system-ui, Helvetica, Arial, sans-serif";
const INK: RGBColor = RGBColor(45, 50, 58);
const FAINT: RGBColor = RGBColor(228, 231, 235);

/// One colour an algorithm, in the order of [`ALGORITHMS`]; readable to the colour-blind.
const COLOURS: [RGBColor; ALGORITHMS.len()] = [
    RGBColor(27, 80, 162),
    RGBColor(86, 160, 211),
    RGBColor(150, 150, 60),
    RGBColor(230, 145, 0),
    RGBColor(200, 50, 90),
];

/// Where the literature has the crossing.
const LITERATURE: f64 = 9.0;

type Outcome = std::result::Result<(), Box<dyn std::error::Error>>;

/// The plot as an SVG.
pub fn svg(report: &Report) -> Result<String> {
    let mut svg = String::new();
    draw(report, &mut svg).map_err(|e| Error::check(format!("cannot draw the growth: {e}")))?;
    Ok(svg)
}

fn draw(report: &Report, svg: &mut String) -> Outcome {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let middle = Pos::new(HPos::Left, VPos::Center);
    let font = |size: i32| (FONT, size).into_font().color(&INK).pos(middle);
    root.draw(&Text::new(
        "Instructions of a call against bodies of a chain (core, model of run time, Cortex-M4F)",
        (28, 24),
        font(20),
    ))?;
    legend(&root)?;
    let lines = ALGORITHMS.map(|(name, _)| report.instructions(name));
    let all = || lines.iter().flatten();
    let (low, high) = all().fold((u64::MAX, 0), |(low, high), (_, y)| {
        (low.min(*y), high.max(*y))
    });
    let (first, last) = all().fold((usize::MAX, 1), |(first, last), (n, _)| {
        (first.min(*n), last.max(*n))
    });
    let (first, last) = (first as f64 * 0.9, last as f64 * 1.1);
    let (low, high) = (low as f64 * 0.7, high as f64 * 1.4);
    let ticks = report.lengths().iter().map(|&n| n as f64).collect();
    let mut chart = ChartBuilder::on(&root)
        .margin_top(78)
        .margin_right(28)
        .margin_left(14)
        .margin_bottom(8)
        .x_label_area_size(48)
        .y_label_area_size(84)
        .build_cartesian_2d(
            (first..last).log_scale().with_key_points(ticks),
            (low..high).log_scale(),
        )?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(FAINT)
        .axis_style(INK)
        .label_style((FONT, 15).into_font().color(&INK))
        .axis_desc_style((FONT, 16).into_font().color(&INK))
        .x_desc("bodies n")
        .y_desc("instructions")
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_label_formatter(&|y| format!("{y:.0}"))
        .draw()?;
    let mut marks = vec![(LITERATURE, "literature: 9".to_owned(), 0.95)];
    if let Some((_, at)) = report.crossing() {
        marks.push((at, format!("here: {at:.1}"), 0.5));
    }
    for (at, name, height) in marks {
        chart.draw_series(LineSeries::new(
            [(at, low), (at, high)],
            INK.stroke_width(1),
        ))?;
        let y = low * (high / low).powf(height);
        let label = Text::new(format!(" {name}"), (at, y), font(14));
        chart.draw_series([label])?;
    }
    for (line, colour) in lines.iter().zip(COLOURS) {
        let points = line.iter().map(|&(n, y)| (n as f64, y as f64));
        chart.draw_series(LineSeries::new(points.clone(), colour.stroke_width(2)))?;
        chart.draw_series(points.map(|at| Circle::new(at, 3, colour.filled())))?;
    }
    root.present()?;
    Ok(())
}

fn legend(root: &DrawingArea<SVGBackend<'_>, Shift>) -> Outcome {
    let middle = Pos::new(HPos::Left, VPos::Center);
    let (mut x, y) = (98, 56);
    for ((_, name), colour) in ALGORITHMS.into_iter().zip(COLOURS) {
        root.draw(&PathElement::new(
            vec![(x, y), (x + 16, y)],
            colour.stroke_width(3),
        ))?;
        let font = (FONT, 15).into_font().color(&INK).pos(middle);
        root.draw(&Text::new(name, (x + 22, y), font))?;
        x += 48 + 8 * name.chars().count() as i32;
    }
    Ok(())
}
