//! The common parts of the pictures: axes, lines, bars and legends.

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{Pos, VPos};

use crate::kit::error::{Result, check};

pub use plotters::style::RGBColor;
pub use plotters::style::text_anchor::HPos;

pub const FONT: &str = "system-ui, Helvetica, Arial, sans-serif";
pub const INK: RGBColor = RGBColor(45, 50, 58);
pub const FAINT: RGBColor = RGBColor(228, 231, 235);
/// The colours of a chart's lines, in their order; colour-blind readers can distinguish them.
pub const COLOURS: [RGBColor; 8] = [
    RGBColor(27, 80, 162),
    RGBColor(230, 145, 0),
    RGBColor(86, 160, 211),
    RGBColor(60, 60, 60),
    RGBColor(0, 140, 110),
    RGBColor(200, 50, 90),
    RGBColor(120, 70, 150),
    RGBColor(150, 150, 60),
];

/// A picture or a part of it.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub type Outcome = std::result::Result<(), Box<dyn std::error::Error>>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Axis, Axis>>;

pub fn svg(size: (u32, u32), draw: impl FnOnce(&Area<'_>) -> Outcome) -> Result<String> {
    // In memory first: the backend swallows errors when it writes to a file on drop.
    let mut svg = String::new();
    let drawn = (|| {
        let root = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        root.fill(&WHITE)?;
        draw(&root)?;
        Ok(root.present()?)
    })();
    drawn.map_err(|e: Box<dyn std::error::Error>| check!("cannot draw a picture: {e}"))?;
    Ok(svg)
}

/// A text whose left end, middle or right end is at a place.
pub fn label(area: &Area<'_>, text: &str, at: (i32, i32), size: i32, side: HPos) -> Outcome {
    let font = (FONT, size).into_font().color(&INK);
    area.draw(&Text::new(text, at, font.pos(Pos::new(side, VPos::Center))))?;
    Ok(())
}

/// Names beside strokes of their colours, from left to right: plotters' own legend box comes out misshapen,
/// since the widths of texts in an SVG are not known.
pub fn legend(
    area: &Area<'_>,
    entries: impl IntoIterator<Item = (String, RGBColor)>,
    (mut x, y): (i32, i32),
) -> Outcome {
    for (name, colour) in entries {
        let line = vec![(x, y), (x + 16, y)];
        area.draw(&PathElement::new(line, colour.stroke_width(4)))?;
        label(area, &name, (x + 22, y), 15, HPos::Left)?;
        x += 48 + 8 * name.chars().count() as i32;
    }
    Ok(())
}

/// One of a chart's two axes.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Quantity and unit; nothing where another chart's axis has them.
    pub name: &'static str,
    /// The least and the greatest value.
    pub ends: [f64; 2],
    /// The values that are labelled.
    pub ticks: Vec<f64>,
    /// Whether equal lengths are equal factors.
    pub logarithmic: bool,
    /// The room for values and name, pixels; none for nothing.
    pub room: u32,
}

impl Axis {
    /// With a value at every multiple of `step`, two or five times a power of ten, so that there are some `count`.
    pub fn linear(name: &'static str, ends: [f64; 2], count: usize, room: u32) -> Self {
        let rough = (ends[1] - ends[0]) / count as f64;
        let ten = 10_f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|digit| digit * ten);
        let step = step.into_iter().find(|step| *step >= rough);
        let step = step.unwrap_or(10.0 * ten);
        let numbers = (ends[0] / step).ceil() as i64..=(ends[1] / step).floor() as i64;
        Self {
            name,
            ends,
            ticks: numbers.map(|number| number as f64 * step).collect(),
            logarithmic: false,
            room,
        }
    }

    /// With a value at every power of ten.
    pub fn decades(name: &'static str, ends: [f64; 2], room: u32) -> Self {
        let [low, high] = ends.map(f64::log10);
        let powers = (low - 1e-9).ceil() as i32..=(high + 1e-9).floor() as i32;
        Self {
            name,
            ends,
            ticks: powers.map(|power| 10_f64.powi(power)).collect(),
            logarithmic: true,
            room,
        }
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        let [low, high] = self.ends;
        let places = [low, high, value.clamp(low, high)];
        let [low, high, at] = places.map(|x| if self.logarithmic { x.log10() } else { x });
        from + (f64::from(to - from) * (at - low) / (high - low)).round() as i32
    }

    fn key_points<H: KeyPointHint>(&self, _: H) -> Vec<f64> {
        self.ticks.clone()
    }

    fn range(&self) -> Range<f64> {
        self.ends[0]..self.ends[1]
    }
}

impl ValueFormatter<f64> for Axis {
    fn format(value: &f64) -> String {
        // Rounding errors are none of the value's digits.
        ((value * 1e6).round() / 1e6).to_string()
    }
}

pub struct Line {
    pub points: Vec<(f64, f64)>,
    pub colour: RGBColor,
    /// Whether each point has a dot: there are few of them, and lines only lead from one to the next.
    pub dots: bool,
}

/// Lines over two axes, `top` pixels below the area's upper edge.
pub fn lines<'a, 'b>(
    area: &'a Area<'b>,
    top: u32,
    [x, y]: [&Axis; 2],
    lines: &[Line],
) -> std::result::Result<Chart<'a, 'b>, Box<dyn std::error::Error>>
where
    'b: 'a,
{
    let mut chart = frame(area, top, [x, y], true)?;
    for line in lines {
        let points = line.points.iter().copied();
        let stroke = line.colour.stroke_width(2);
        chart.draw_series(LineSeries::new(points.clone(), stroke))?;
        if line.dots {
            chart.draw_series(points.map(|at| Circle::new(at, 3, line.colour.filled())))?;
        }
    }
    Ok(chart)
}

fn frame<'a, 'b>(
    area: &'a Area<'b>,
    top: u32,
    [x, y]: [&Axis; 2],
    rows: bool,
) -> std::result::Result<Chart<'a, 'b>, Box<dyn std::error::Error>> {
    let mut chart = ChartBuilder::on(area)
        .margin_top(top)
        .margin_right(18)
        .margin_left(if y.room > 0 { 8 } else { 0 })
        .x_label_area_size(x.room)
        .y_label_area_size(y.room)
        .build_cartesian_2d(x.clone(), y.clone())?;
    let mut mesh = chart.configure_mesh();
    mesh.light_line_style(TRANSPARENT)
        .bold_line_style(FAINT)
        .axis_style(INK)
        .label_style((FONT, 14).into_font().color(&INK))
        .axis_desc_style((FONT, 15).into_font().color(&INK))
        .x_desc(x.name)
        .y_desc(y.name)
        .x_labels(x.ticks.len())
        .y_labels(y.ticks.len());
    if !rows {
        mesh.disable_y_mesh().disable_y_axis();
    }
    mesh.draw()?;
    Ok(chart)
}

/// The position of a point of a chart in its area, pixels.
fn place(area: &Area<'_>, chart: &Chart<'_, '_>, at: (f64, f64)) -> (i32, i32) {
    let ((x, y), (columns, rows)) = (chart.backend_coord(&at), area.get_pixel_range());
    (x - columns.start, y - rows.start)
}

/// An upright line at a value of `x`, and a text above the chart at its left or right side.
pub fn mark(
    area: &Area<'_>,
    chart: &mut Chart<'_, '_>,
    (at, text, side): (f64, &str, HPos),
) -> Outcome {
    let ends = chart.y_range();
    let ends = [(at, ends.start), (at, ends.end)];
    chart.draw_series(LineSeries::new(ends, INK.stroke_width(1)))?;
    let (left, top) = place(area, chart, ends[1]);
    label(area, text, (left, top - 10), 14, side)
}

/// Bars from zero, or from the axis' beginning, with their values behind them: row by row some of the colours.
pub fn bars(
    area: &Area<'_>,
    top: u32,
    x: &Axis,
    colours: &[RGBColor],
    rows: &[Vec<Option<(f64, String)>>],
) -> Outcome {
    let mut y = Axis::linear("", [0.0, rows.len() as f64], 1, 0);
    y.ticks.clear();
    let mut chart = frame(area, top, [x, &y], false)?;
    let start = x.ends[0].max(0.0);
    for (number, row) in rows.iter().rev().enumerate() {
        let high = 0.8 / row.len() as f64;
        for (index, (bar, colour)) in row.iter().zip(colours).enumerate() {
            let Some((value, words)) = bar else { continue };
            let upper = number as f64 + 0.9 - high * index as f64;
            let end = value.max(start);
            let corners = [(start, upper), (end, upper - high)];
            chart.draw_series([Rectangle::new(corners, colour.filled())])?;
            let beside = (end, upper - high / 2.0);
            let (left, middle) = place(area, &chart, beside);
            label(area, words, (left + 5, middle), 12, HPos::Left)?;
        }
    }
    Ok(())
}

/// A name and its costs by number of bodies.
pub type Curve = (&'static str, Vec<(usize, u64)>);
/// A number of bodies to mark, with a text at one of its sides.
type Mark = (f64, String, HPos);

/// Curves of some costs as an SVG, a legend of up to five a line above them.
pub fn curves(title: &str, cost: &'static str, curves: &[Curve], marks: &[Mark]) -> Result<String> {
    let drawn = curves.iter().zip(COLOURS).map(|((_, costs), colour)| Line {
        points: costs.iter().map(|(n, y)| (*n as f64, *y as f64)).collect(),
        colour,
        dots: true,
    });
    let drawn: Vec<Line> = drawn.collect();
    let longest = drawn.iter().max_by_key(|line| line.points.len());
    let lengths = longest.map_or_else(Vec::new, |line| {
        line.points.iter().map(|(n, _)| *n).collect()
    });
    let all = || drawn.iter().flat_map(|line| &line.points);
    let ends = |of: fn(&(f64, f64)) -> f64| {
        let [low, high] = [f64::min, f64::max].map(|pick| all().map(of).reduce(pick));
        [low.unwrap_or(1.0), high.unwrap_or(10.0)]
    };
    let [first, last] = ends(|(n, _)| *n);
    let [low, high] = ends(|(_, y)| *y);
    let mut x = Axis::decades("bodies n", [0.9 * first, 1.1 * last], 48);
    x.ticks = lengths;
    let y = Axis::decades(cost, [0.7 * low, 1.4 * high], 84);
    svg((960, 640), |root| {
        label(root, title, (28, 24), 20, HPos::Left)?;
        let names = curves
            .iter()
            .map(|(name, _)| (*name).to_owned())
            .zip(COLOURS);
        let names: Vec<_> = names.collect();
        for (row, names) in names.chunks(5).enumerate() {
            legend(root, names.iter().cloned(), (98, 56 + 22 * row as i32))?;
        }
        let mut plot = lines(root, 98, [&x, &y], &drawn)?;
        for (at, text, side) in marks {
            mark(root, &mut plot, (*at, text, *side))?;
        }
        Ok(())
    })
}
