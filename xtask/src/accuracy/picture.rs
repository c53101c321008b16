//! The picture of a robot: error against cycles of every way to compute its torques, both logarithmic.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::drawing::{
    FAINT, FONT, INK, Outcome, Root, digits_of_axis, dot, label, text, whisker, whole,
};
use super::front;
use super::labels::{Area, Canvas};
use super::margin::{Seen, legend, yardsticks};
use super::page::steps;
use super::point::{Point, Yardstick};
use super::words::{cycles, digits, name};
use crate::error::{Error, Result};

const SIZE: (u32, u32) = (1200, 760);
pub const DOT: RGBColor = RGBColor(178, 186, 196);
pub const WORST: RGBColor = RGBColor(27, 80, 162);
pub const MEAN: RGBColor = RGBColor(214, 110, 0);
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
                errors that sensors and parameters bring anyway. Small numbers: the page.";
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
            let colour = if point.is_default() { INK } else { GREY };
            let place = at(&chart, point.cycles as f64, point.error());
            named.insert(0, (place, name(point), colour));
        }
    }
    for (place, _, _) in &named {
        canvas.dot(*place, 5.0);
    }
    named.reverse();
    for (place, words, colour) in named {
        label(&root, &mut canvas, place, &words, &colour)?;
    }
    numbers(&root, &mut canvas, scene, |point, cost| {
        at(&chart, point.costs()[cost], point.error())
    })?;
    root.present()?;
    Ok(())
}

/// The rest of the fronts by number: the page has them all.
fn numbers(
    root: &Root<'_>,
    canvas: &mut Canvas,
    scene: &Scene<'_>,
    at: impl Fn(&Point, usize) -> [f64; 2],
) -> Outcome {
    let named = [0, 1].map(|cost| steps(&scene.points, cost));
    let is_named = |point: &Point| named.iter().flatten().any(|it| it.key == point.key);
    for (i, point) in front::numbered(&scene.points).into_iter().enumerate() {
        if is_named(point) {
            continue;
        }
        let (cost, colour) = if point.fronts[0] {
            (0, WORST)
        } else {
            (1, MEAN)
        };
        let place = at(point, cost);
        let words = (i + 1).to_string();
        let wide = 0.55 * f64::from(NUMBER) * words.len() as f64;
        let [left, top, _, bottom] = canvas.place(place, [wide, f64::from(NUMBER)]).0;
        let middle = whole([left, f64::midpoint(top, bottom)]);
        text(root, &words, middle, NUMBER, &colour, HPos::Left)?;
    }
    Ok(())
}

/// px: how high numbers are.
const NUMBER: i32 = 10;
