//! The common parts of the pictures: colours, axes, lines, rows of dots, names and legends.

mod names;
mod panels;

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{Pos, VPos};

use crate::kit::error::{Result, check, refuse_if};
use crate::kit::table::thousands;

pub use names::Names;
pub use panels::Panels;
pub use plotters::style::RGBColor;
pub use plotters::style::text_anchor::HPos;

const FONT: &str = "system-ui, Helvetica, Arial, sans-serif";
pub const INK: RGBColor = RGBColor(45, 50, 58);
pub const FAINT: RGBColor = RGBColor(228, 231, 235);
/// The colour of the background: leader lines, unnamed dots.
pub const MUTED: RGBColor = RGBColor(140, 150, 163);
pub const BLUE: RGBColor = RGBColor(27, 80, 162);
pub const ORANGE: RGBColor = RGBColor(230, 145, 0);
pub const SKY: RGBColor = RGBColor(86, 160, 211);
pub const GREEN: RGBColor = RGBColor(0, 140, 110);
pub const RED: RGBColor = RGBColor(200, 50, 90);
const GREY: RGBColor = RGBColor(96, 96, 96);
pub const PURPLE: RGBColor = RGBColor(120, 70, 150);
pub const OLIVE: RGBColor = RGBColor(150, 150, 60);
/// The colours of a chart's lines, in their order; colour-blind readers can distinguish them.
pub const COLOURS: [RGBColor; 8] = [BLUE, ORANGE, SKY, GREY, GREEN, RED, PURPLE, OLIVE];

/// Every colour that a picture may have, and what takes its place on a dark screen.
#[rustfmt::skip]
const THEME: [(RGBColor, &str); 12] = [
    (WHITE, "#0D1117"), (INK, "#E6EDF3"), (FAINT, "#2A313C"), (MUTED, "#7D8590"), (BLUE, "#4F93FF"), (ORANGE, "#F0A020"),
    (SKY, "#A8DBFF"), (GREY, "#B4B4B4"), (GREEN, "#2FBF93"), (RED, "#FF7096"), (PURPLE, "#C79BF0"), (OLIVE, "#D2D25A"),
];
/// px: the sizes of a picture's title, of a chart's, and of all other text.
pub const TITLE: i32 = 17;
pub const HEAD: i32 = 14;
pub const TEXT: i32 = 12;
/// px: from one line of a legend to the next.
const LINE: i32 = 21;

/// A picture or a part of it.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn<T> = std::result::Result<T, Box<dyn std::error::Error>>;
pub type Outcome = Drawn<()>;
type Place = (i32, i32);

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
    themed(&svg)
}

/// The picture with rules that swap its colours on a dark screen. A viewer that knows none shows it
/// as it is drawn.
fn themed(svg: &str) -> Result<String> {
    let themes = THEME.map(|(RGBColor(r, g, b), dark)| (format!("#{r:02X}{g:02X}{b:02X}"), dark));
    for colour in svg.split("=\"#").skip(1) {
        let known = |(light, _): &(String, _)| colour.starts_with(&light[1..]);
        refuse_if!(!themes.iter().any(known), "a colour of no theme: #{colour:.6}");
    }
    let rules = themes.map(|(light, dark)| {
        ["fill", "stroke"].map(|of| format!("[{of}=\"{light}\"]{{{of}:{dark}}}")).concat()
    });
    let font = format!(" font-family=\"{FONT}\"");
    let svg = svg.replace(" opacity=\"1\"", "").replace(&font, "");
    let style = rules.concat();
    let style =
        format!("{font}>\n<style>@media (prefers-color-scheme: dark) {{{style}}}</style>\n");
    Ok(svg.replacen(">\n", &style, 1))
}

fn font(size: i32) -> FontDesc<'static> {
    // The backend divides sizes by this factor.
    (FONT, 1.24 * f64::from(size)).into_font()
}

/// The room that a text takes at most, px.
pub fn wide(text: &str, size: i32) -> i32 {
    (0.6 * f64::from(size) * text.chars().count() as f64) as i32 + 1
}

/// A text whose left end, middle or right end is at a place.
pub fn label(area: &Area<'_>, text: &str, at: Place, size: i32, side: HPos) -> Outcome {
    coloured(area, text, at, (size, INK), side)
}

pub fn coloured(
    area: &Area<'_>,
    text: &str,
    at: Place,
    (size, colour): (i32, RGBColor),
    side: HPos,
) -> Outcome {
    let style = font(size).color(&colour).pos(Pos::new(side, VPos::Center));
    Ok(area.draw(&Text::new(text.to_owned(), at, style))?)
}

/// A line through these places.
pub fn path(area: &Area<'_>, places: &[Place], colour: RGBColor, width: u32) -> Outcome {
    Ok(area.draw(&PathElement::new(places, colour.stroke_width(width)))?)
}

pub fn dot(area: &Area<'_>, at: Place, radius: i32, colour: RGBColor) -> Outcome {
    Ok(area.draw(&Circle::new(at, radius, colour.filled()))?)
}

/// Names beside strokes of their colours and widths, or dots where that is 0, in as many lines as
/// they take; returns the lower edge. plotters' own legend box comes out misshapen, since the
/// widths of texts in an SVG are not known.
pub fn legend(
    area: &Area<'_>,
    entries: impl IntoIterator<Item = (String, RGBColor, u32)>,
    (left, top): Place,
) -> Drawn<u32> {
    let (mut x, mut y) = (left, top);
    for (name, colour, width) in entries {
        let room = 22 + wide(&name, TEXT);
        if x > left && x + room > area.dim_in_pixel().0 as i32 {
            (x, y) = (left, y + LINE);
        }
        match width {
            0 => dot(area, (x + 12, y), 4, colour)?,
            _ => path(area, &[(x, y), (x + 16, y)], colour, width)?,
        }
        label(area, &name, (x + 22, y), TEXT, HPos::Left)?;
        x += room + 18;
    }
    Ok((y + LINE / 2) as u32)
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
    /// With a value at every multiple of `step`, two or five times a power of ten, so that there
    /// are some `count`.
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
        let power = value.abs().log10().round();
        let is_power = (value.abs() / 10_f64.powf(power) - 1.0).abs() < 1e-9;
        if is_power && !(-3.0..5.0).contains(&power) {
            return format!("10{}", raised(power as i32));
        }
        let sign = if *value < 0.0 { "−" } else { "" };
        match value.abs() {
            large @ 1e3.. => format!("{sign}{}", thousands(large.round() as u64)),
            // Rounding errors are none of the value's digits.
            small => format!("{sign}{}", (small * 1e6).round() / 1e6),
        }
    }
}

/// A number as an exponent.
fn raised(power: i32) -> String {
    let digits: Vec<char> = "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().collect();
    let raised = |letter: char| letter.to_digit(10).map_or('⁻', |digit| digits[digit as usize]);
    power.to_string().chars().map(raised).collect()
}

pub struct Line {
    pub points: Vec<(f64, f64)>,
    pub colour: RGBColor,
    /// px; a line that another one may hide is the wider one, and comes first.
    pub width: u32,
    /// The radius of the dots at its points, of which there are few; 0 for none.
    pub dots: i32,
}

/// The axes of a chart that is drawn, and its edges in its area, px.
pub struct Plot {
    axes: [Axis; 2],
    edges: [(i32, i32); 2],
}

impl Plot {
    /// The place of a value of each axis.
    pub fn at(&self, (x, y): (f64, f64)) -> Place {
        let [across, up] = self.edges;
        (self.axes[0].map(&x, across), self.axes[1].map(&y, up))
    }

    /// An upright line at a value of `x`, and a text above the chart at its left or right side.
    pub fn mark(&self, area: &Area<'_>, (at, text, side): (f64, &str, HPos)) -> Outcome {
        let [low, high] = self.axes[1].ends.map(|y| self.at((at, y)));
        path(area, &[low, high], INK, 1)?;
        label(area, text, (high.0, high.1 - 10), TEXT, side)
    }
}

/// Lines over two axes, `top` pixels below the area's upper edge.
pub fn lines(area: &Area<'_>, top: u32, axes: [&Axis; 2], lines: &[Line]) -> Drawn<Plot> {
    let plot = frame(area, top, axes, true)?;
    for line in lines {
        let places: Vec<Place> = line.points.iter().map(|point| plot.at(*point)).collect();
        path(area, &places, line.colour, line.width)?;
        for place in places.into_iter().filter(|_| line.dots > 0) {
            dot(area, place, line.dots, line.colour)?;
        }
    }
    Ok(plot)
}

fn frame(area: &Area<'_>, top: u32, [x, y]: [&Axis; 2], rows: bool) -> Drawn<Plot> {
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
        .label_style(font(TEXT).color(&INK))
        .axis_desc_style(font(TEXT).color(&INK))
        .x_desc(x.name)
        .y_desc(y.name)
        .x_labels(x.ticks.len())
        .y_labels(y.ticks.len());
    if !rows {
        mesh.disable_y_mesh().disable_y_axis();
    }
    mesh.draw()?;
    let (left, top) = area.get_base_pixel();
    let [low, high] = [0, 1].map(|end| chart.backend_coord(&(x.ends[end], y.ends[end])));
    Ok(Plot {
        axes: [x.clone(), y.clone()],
        edges: [(low.0 - left, high.0 - left), (low.1 - top, high.1 - top)],
    })
}

#[derive(Clone, Copy)]
pub enum Shape {
    Dot,
    Ring,
    Cross,
}

/// A name, and what stands in its row: values with their shapes, and words right of each.
pub type Row = (String, Vec<(f64, Shape, RGBColor, String)>);

/// Rows of dots over an axis, with their names in the room left of it. Dots need no zero, so the
/// axis may be logarithmic.
pub fn rows(area: &Area<'_>, top: u32, (x, room): (&Axis, u32), rows: &[Row]) -> Drawn<Plot> {
    let mut y = Axis::linear("", [0.0, rows.len() as f64], 1, room);
    y.ticks.clear();
    let plot = frame(area, top, [x, &y], false)?;
    for ((name, dots), number) in rows.iter().rev().zip(0..) {
        let at = |value| plot.at((value, f64::from(number) + 0.5));
        let [(left, middle), right] = x.ends.map(at);
        path(area, &[(left, middle), right], FAINT, 1)?;
        label(area, name, (left - 8, middle), TEXT, HPos::Right)?;
        for &(value, shape, colour, ref words) in dots {
            let (x, y) = at(value);
            match shape {
                Shape::Dot => dot(area, (x, y), 4, colour)?,
                Shape::Ring => area.draw(&Circle::new((x, y), 6, colour.stroke_width(2)))?,
                Shape::Cross => area.draw(&Cross::new((x, y), 4, colour.stroke_width(2)))?,
            }
            label(area, words, (x + 9, y), TEXT, HPos::Left)?;
        }
    }
    Ok(plot)
}

#[cfg(test)]
mod tests {
    use super::{Area, HPos, RED, RGBColor, coloured, svg};

    #[test]
    fn a_colour_without_its_dark_one_is_refused() {
        let draw = |colour| {
            let text = |root: &Area<'_>| coloured(root, "a", (9, 9), (9, colour), HPos::Left);
            svg((20, 20), text)
        };
        assert!(draw(RED).is_ok_and(|svg| svg.contains("prefers-color-scheme: dark")));
        assert!(draw(RGBColor(1, 2, 3)).is_err());
    }
}
