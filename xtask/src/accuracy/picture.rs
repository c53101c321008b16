//! The picture of a robot: error against cycles of every way to compute its torques, both logarithmic.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::drawing::{
    FAINT, FONT, INK, Outcome, Root, dashed, digits_of_axis, dot, label, text, whisker, whole,
};
use super::front;
use super::labels::{Area, Canvas, spread};
use super::page::steps;
use super::point::{Point, Yardstick};
use super::words::{cycles, digits, name};
use crate::error::{Error, Result};

const SIZE: (u32, u32) = (1200, 760);
const DOT: RGBColor = RGBColor(178, 186, 196);
const WORST: RGBColor = RGBColor(27, 80, 162);
const MEAN: RGBColor = RGBColor(214, 110, 0);
const MEASURE: RGBColor = RGBColor(150, 45, 95);
const GREY: RGBColor = RGBColor(112, 120, 130);

/// Ways that are named though others are cheaper: whoever looks for them finds them.
const LANDMARKS: [&str; 9] = [
    "default",
    "form=core",
    "trig=libm",
    "trig=micromath",
    "trig=minimax3",
    "trig=minimax5",
    "arith=q31,form=core",
    "arith=f64",
    "model=params8",
];

/// px: where the plot ends and what is written beside it begins.
const RIGHT: u32 = 262;

type Chart<'a, 'b> = ChartContext<
    'a,
    SVGBackend<'b>,
    Cartesian2d<
        plotters::coord::combinators::LogCoord<f64>,
        plotters::coord::combinators::LogCoord<f64>,
    >,
>;

/// What is drawn.
pub struct Scene<'a> {
    /// The robot's name in print.
    pub title: &'a str,
    /// Its ways, of rigid joints.
    pub points: Vec<&'a Point>,
    /// Its yardsticks.
    pub yardsticks: Vec<&'a Yardstick>,
}

/// The plot as an SVG.
pub fn svg(scene: &Scene<'_>) -> Result<String> {
    let mut svg = String::new();
    draw(scene, &mut svg).map_err(|e| Error::check(format!("cannot draw {}: {e}", scene.title)))?;
    Ok(svg)
}

/// Decades around what is drawn: cycles, errors.
fn ranges(scene: &Scene<'_>) -> [[f64; 2]; 2] {
    let every = |of: fn(&Point) -> f64| scene.points.iter().map(move |point| of(point));
    let low = every(|p| p.cycles_mean).fold(f64::INFINITY, f64::min);
    let high = every(|p| p.cycles as f64).fold(1.0, f64::max);
    let most = every(Point::error)
        .filter(|e| e.is_finite())
        .fold(1e-9, f64::max);
    let default = scene.points.iter().find(|point| point.is_default());
    let floor = default.map_or(1e-6 * most, |default| default.error());
    // Errors far below what f32 rounds off are drawn on the lower edge.
    [
        [low * 0.25, high * 1.4],
        [10_f64.powf(floor.log10().floor() - 1.0), most * 3.0],
    ]
}

fn draw(scene: &Scene<'_>, svg: &mut String) -> Outcome {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let head = format!("{}: what accuracy of inverse dynamics costs", scene.title);
    text(&root, &head, (28, 26), 23, &INK, HPos::Left)?;
    let said = "Each dot is a way to compute all joint torques: further left is cheaper, further down more accurate. Dashed: \
                errors that sensors and parameters bring anyway.";
    text(&root, said, (28, 50), 15, &INK, HPos::Left)?;
    legend(&root)?;
    let [[left, right], [low, high]] = ranges(scene);
    let mut chart = ChartBuilder::on(&root)
        .margin_top(104)
        .margin_right(RIGHT)
        .margin_left(10)
        .margin_bottom(8)
        .x_label_area_size(50)
        .y_label_area_size(86)
        .build_cartesian_2d((left..right).log_scale(), (low..high).log_scale())?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(FAINT)
        .axis_style(INK)
        .label_style((FONT, 15).into_font().color(&INK))
        .axis_desc_style((FONT, 16).into_font().color(&INK))
        .x_desc("cycles of a tick (Cortex-M4F at zero wait states, modelled) – cheaper to the left")
        .y_desc("largest torque error on the robot's way, N·m")
        .x_label_formatter(&|x| cycles(*x))
        .y_label_formatter(&|y| digits_of_axis(*y))
        .draw()?;
    let at = |chart: &Chart<'_, '_>, cost: f64, error: f64| {
        let (x, y) = chart.backend_coord(&(cost, error.max(low)));
        [f64::from(x), f64::from(y)]
    };
    let [x0, y0] = at(&chart, left, high);
    let [x1, y1] = at(&chart, right, low);
    let mut canvas = Canvas::new(Area([x0 + 4.0, y0 + 4.0, x1 - 4.0, y1 - 4.0]));
    let full_scale = scene.points.first().map_or(1.0, |point| point.full_scale);
    let seen = Seen {
        edges: [x0, y0, x1, y1],
        full_scale,
        low,
        high,
    };
    yardsticks(
        &root,
        scene,
        &seen,
        |error| at(&chart, left, error)[1],
        &mut canvas,
    )?;
    for point in &scene.points {
        let [x, y] = at(&chart, point.cycles as f64, point.error());
        dot(&root, [x, y], 3, DOT.filled())?;
        canvas.spare(Area([x - 2.0, y - 2.0, x + 2.0, y + 2.0]));
    }
    let mut named: Vec<([f64; 2], String, RGBColor)> = Vec::new();
    for (cost, colour) in [(1, MEAN), (0, WORST)] {
        let front = front::front(&scene.points, cost);
        let mut corners: Vec<[f64; 2]> = Vec::new();
        for point in &front {
            let [x, y] = at(&chart, point.costs()[cost], point.error());
            if let Some(&[_, above]) = corners.last() {
                corners.push([x, above]);
            }
            corners.push([x, y]);
        }
        for pair in corners.windows(2) {
            canvas.line(pair[0], pair[1]);
        }
        let path: Vec<(i32, i32)> = corners.iter().map(|&corner| whole(corner)).collect();
        root.draw(&PathElement::new(path, colour.stroke_width(2)))?;
        for point in steps(&scene.points, cost) {
            // In both fronts it stands once.
            if cost == 1 && point.fronts[0] {
                continue;
            }
            let place = at(&chart, point.costs()[cost], point.error());
            let deep = point.error() < low;
            let error = if deep {
                format!(", {} N·m", digits(point.error()))
            } else {
                String::new()
            };
            named.push((place, format!("{}{error}", name(point)), colour));
        }
        for point in front {
            let height = |error| at(&chart, point.costs()[cost], error);
            whisker(&root, point, height, &colour)?;
            canvas.line(
                height(point.error()),
                height(point.error_rms.unwrap_or(low)),
            );
            let place = at(&chart, point.costs()[cost], point.error());
            if cost == 1 {
                dot(&root, place, 4, WHITE.filled())?;
                dot(&root, place, 4, colour.stroke_width(2))?;
            } else {
                dot(&root, place, 4, colour.filled())?;
            }
        }
    }
    for point in &scene.points {
        if LANDMARKS.contains(&&*point.key)
            && !named.iter().any(|(_, words, _)| *words == name(point))
        {
            named.insert(
                0,
                (
                    at(&chart, point.cycles as f64, point.error()),
                    name(point),
                    GREY,
                ),
            );
        }
    }
    for (place, _, _) in &named {
        canvas.dot(*place, 5.0);
    }
    named.reverse();
    for (place, words, colour) in named {
        label(&root, &mut canvas, place, &words, &colour)?;
    }
    root.present()?;
    Ok(())
}

/// Where the plot lies, and what it shows.
struct Seen {
    edges: [f64; 4],
    full_scale: f64,
    low: f64,
    high: f64,
}

/// Lines across, named beside the plot; and what share of full scale an error is.
fn yardsticks(
    root: &Root<'_>,
    scene: &Scene<'_>,
    seen: &Seen,
    height: impl Fn(f64) -> f64,
    canvas: &mut Canvas,
) -> Outcome {
    let [x0, y0, x1, y1] = seen.edges;
    let exponents = (seen.low / seen.full_scale).log10().ceil() as i32
        ..=(seen.high / seen.full_scale).log10().floor() as i32;
    for exponent in exponents {
        let y = height(seen.full_scale * 10_f64.powi(exponent));
        let tick = vec![whole([x1, y]), whole([x1 + 5.0, y])];
        root.draw(&PathElement::new(tick, INK.stroke_width(1)))?;
        let share = match exponent {
            -2..=0 => format!("{} %", 10_f64.powi(exponent + 2)),
            _ => format!("1e{exponent}"),
        };
        text(root, &share, whole([x1 + 8.0, y]), 12, &INK, HPos::Left)?;
    }
    text(
        root,
        "of full scale",
        whole([x1 + 8.0, y0 - 12.0]),
        12,
        &INK,
        HPos::Left,
    )?;
    let lines: Vec<_> = scene
        .yardsticks
        .iter()
        .filter(|it| it.error_max > seen.low)
        .collect();
    let wished: Vec<f64> = lines.iter().map(|it| height(it.error_max)).collect();
    let heights = spread(&wished, 36.0, [y0 + 16.0, y1 - 16.0]);
    for ((line, from), to) in lines.into_iter().zip(wished).zip(heights) {
        dashed(root, [x0, x1], from, MEASURE)?;
        canvas.line([x0, from], [x1, from]);
        let lead = vec![whole([x1 + 44.0, from]), whole([x1 + 56.0, to])];
        root.draw(&PathElement::new(lead, MEASURE.stroke_width(1)))?;
        let error = format!("off by {} N·m", digits(line.error_max));
        text(
            root,
            yardstick(line),
            whole([x1 + 60.0, to - 8.0]),
            14,
            &MEASURE,
            HPos::Left,
        )?;
        text(
            root,
            &error,
            whole([x1 + 60.0, to + 8.0]),
            13,
            &MEASURE,
            HPos::Left,
        )?;
    }
    Ok(())
}

/// The cause of an error, for a plot.
pub fn yardstick(line: &Yardstick) -> &str {
    match &*line.key {
        "encoder14" => "angles from a 14-bit encoder",
        "inertial1" => "inertias known to 1 %",
        "inertial5" => "inertias known to 5 %",
        "friction10" => "friction known to 10 %",
        other => other,
    }
}

fn legend(root: &Root<'_>) -> Outcome {
    let (mut x, y) = (40, 78);
    for (words, colour, hollow) in [
        ("cheapest for its accuracy, by the worst tick", WORST, false),
        ("by the mean over all ticks", MEAN, true),
        ("others", DOT, false),
    ] {
        let fill = if hollow {
            colour.stroke_width(2)
        } else {
            colour.filled()
        };
        dot(root, [f64::from(x), f64::from(y)], 4, fill)?;
        text(root, words, (x + 12, y), 15, &INK, HPos::Left)?;
        x += 40 + (6.9 * words.chars().count() as f64) as i32;
    }
    let bar = vec![(x, y - 8), (x, y + 8)];
    root.draw(&PathElement::new(bar, WORST.mix(0.25).stroke_width(5)))?;
    let tick = vec![(x - 5, y), (x + 5, y)];
    root.draw(&PathElement::new(tick, WORST.stroke_width(1)))?;
    let words = "down to the root mean square, tick at 99 %";
    text(root, words, (x + 12, y), 15, &INK, HPos::Left)
}
