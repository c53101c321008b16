//! The picture of the simulations: errors against cycles, a line per integrator through its lengths of step.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::drawing::{FAINT, FONT, INK, Outcome, Root, digits_of_axis, dot, text, whole};
use super::labels::{Area, Canvas};
use super::measure::Robot;
use super::point::{Kind, Point};
use crate::error::{Error, Result};

const SIZE: (u32, u32) = (1200, 1240);
/// Cycles of a second at 168 MHz: a simulation right of it is slower than what it simulates.
const REAL_TIME: f64 = 168e6;

/// By integrator; readable to the colour-blind.
const COLOURS: [(&str, &str, RGBColor); 5] = [
    ("euler", "explicit Euler", RGBColor(86, 160, 211)),
    (
        "semi_implicit",
        "semi-implicit Euler",
        RGBColor(0, 128, 110),
    ),
    ("rk4", "RK4", RGBColor(27, 80, 162)),
    ("energy", "energy-preserving", RGBColor(230, 145, 0)),
    (
        "implicit_damping",
        "implicit damping",
        RGBColor(200, 50, 90),
    ),
];

/// A panel's robot, its scene, and what it says.
const ROWS: [(Robot, &str, &str); 3] = [
    (Robot::DoublePendulum, "free", "double pendulum, let go"),
    (Robot::Ur5e, "free", "UR5e, let go"),
    (Robot::Ur5e, "damped", "UR5e, let go with viscous friction"),
];

/// Errors by name: what is off, and its unit.
type Quantity = (&'static str, fn(&Point) -> Option<f64>);
const QUANTITIES: [Quantity; 2] = [
    ("trajectory error in the first second, rad", |point| {
        point.error_max
    }),
    (
        "energy drift a second, of the largest kinetic energy",
        |point| point.drift,
    ),
];

/// The plot as an SVG.
pub fn svg(points: &[Point]) -> Result<String> {
    let mut svg = String::new();
    draw(points, &mut svg)
        .map_err(|e| Error::check(format!("cannot draw the simulations: {e}")))?;
    Ok(svg)
}

fn draw(points: &[Point], svg: &mut String) -> Outcome {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let head =
        "What accuracy of simulation costs: shorter steps to the right, each dot a length of step";
    text(&root, head, (28, 26), 21, &INK, HPos::Left)?;
    legend(&root)?;
    for (row, (robot, scene, title)) in ROWS.into_iter().enumerate() {
        let of = |point: &&Point| {
            (point.kind, &*point.robot, point.on("scene"))
                == (Kind::Simulation, robot.name(), scene)
        };
        let own: Vec<&Point> = points.iter().filter(of).collect();
        for (column, quantity) in QUANTITIES.into_iter().enumerate() {
            let corner = (600 * column as i32, 84 + 384 * row as i32);
            let area = root.clone().shrink(corner, (600, 380));
            panel(&area, title, quantity, &own)?;
        }
    }
    root.present()?;
    Ok(())
}

fn panel(area: &Root<'_>, title: &str, (what, of): Quantity, points: &[&Point]) -> Outcome {
    let seen = || {
        points
            .iter()
            .filter_map(|point| Some((point.cycles as f64, of(point)?)))
    };
    let (left, right) = range(seen().map(|at| at.0));
    let (low, high) = range(seen().map(|at| at.1));
    let low = low.max(1e-9 * high);
    text(
        area,
        &format!("{title}: {what}"),
        (78, 14),
        15,
        &INK,
        HPos::Left,
    )?;
    let mut chart = ChartBuilder::on(area)
        .margin_top(28)
        .margin_right(20)
        .margin_left(4)
        .margin_bottom(4)
        .x_label_area_size(44)
        .y_label_area_size(66)
        .build_cartesian_2d(
            (left * 0.7..right * 1.5).log_scale(),
            (low * 0.5..high * 2.0).log_scale(),
        )?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(FAINT)
        .axis_style(INK)
        .label_style((FONT, 14).into_font().color(&INK))
        .axis_desc_style((FONT, 14).into_font().color(&INK))
        .x_desc("modelled cycles for a simulated second")
        .x_label_formatter(&|x| short(*x))
        .y_label_formatter(&|y| digits_of_axis(*y))
        .draw()?;
    let at = |x: f64, y: f64| {
        let (x, y) = chart.backend_coord(&(x, y.max(low * 0.5)));
        [f64::from(x), f64::from(y)]
    };
    // Coordinates of a chart are those of the whole picture.
    let (dx, dy) = area.get_base_pixel();
    let here = |[x, y]: [f64; 2]| [x - f64::from(dx), y - f64::from(dy)];
    let [[x0, y0], [x1, y1]] = [
        here(at(left * 0.7, high * 2.0)),
        here(at(right * 1.5, low * 0.5)),
    ];
    let mut canvas = Canvas::new(Area([x0 + 2.0, y0 + 2.0, x1 - 2.0, y1 - 2.0]));
    if (left..right).contains(&REAL_TIME) {
        let x = here(at(REAL_TIME, low))[0];
        area.draw(&PathElement::new(
            vec![whole([x, y0]), whole([x, y1])],
            INK.mix(0.4).stroke_width(1),
        ))?;
        text(
            area,
            "real time at 168 MHz ",
            whole([x, y0 + 9.0]),
            12,
            &INK,
            HPos::Right,
        )?;
        canvas.take(Area([x - 130.0, y0, x + 4.0, y0 + 18.0]));
    }
    let mut named = Vec::new();
    for (integrator, _, colour) in COLOURS {
        for (arith, state) in [("f64", "plain"), ("f32", "plain"), ("f32", "compensated")] {
            let mut line: Vec<(u64, [f64; 2])> = points
                .iter()
                .filter(|point| {
                    [point.on("integrator"), point.on("arith"), point.on("state")]
                        == [integrator, arith, state]
                })
                .filter_map(|point| {
                    // What is below the lower edge is not drawn.
                    let error = of(point).filter(|error| *error > 0.5 * low)?;
                    let place = here(at(point.cycles as f64, error));
                    Some((point.on("step").parse().ok()?, place))
                })
                .collect();
            line.sort_unstable_by_key(|(step, _)| *step);
            let path: Vec<[f64; 2]> = line.iter().map(|(_, place)| *place).collect();
            for pair in path.windows(2) {
                stroke(area, [pair[0], pair[1]], arith, state, colour)?;
                canvas.line(pair[0], pair[1]);
            }
            for (step, place) in line {
                let fill = if state == "plain" {
                    colour.filled()
                } else {
                    colour.stroke_width(1)
                };
                dot(area, place, 3, fill)?;
                let told = integrator == "rk4" && arith == "f32" && state == "plain";
                if told && [20, 100, 1000, 10_000].contains(&step) {
                    named.push((place, step, colour));
                }
            }
        }
    }
    for (place, step, colour) in named {
        let words = if step < 1000 {
            format!("{step} µs")
        } else {
            format!("{} ms", step / 1000)
        };
        let area_of = canvas.place(place, [7.0 * words.chars().count() as f64, 12.0]);
        let [x, top, _, bottom] = area_of.0;
        text(
            area,
            &words,
            whole([x, (top + bottom) / 2.0]),
            12,
            &colour,
            HPos::Left,
        )?;
    }
    Ok(())
}

/// `100 k`, `10 M`, `1 G`.
fn short(x: f64) -> String {
    let (scale, letter) = if x < 1e6 {
        (1e3, 'k')
    } else if x < 1e9 {
        (1e6, 'M')
    } else {
        (1e9, 'G')
    };
    format!("{:.0} {letter}", x / scale)
}

fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values
        .filter(|value| *value > 0.0)
        .fold((f64::INFINITY, 1e-300), |(low, high), value| {
            (low.min(value), high.max(value))
        })
}

/// f32 solid, f64 thin, compensated sums dashed.
fn stroke(
    area: &Root<'_>,
    [from, to]: [[f64; 2]; 2],
    arith: &str,
    state: &str,
    colour: RGBColor,
) -> Outcome {
    let style = if arith == "f64" {
        colour.mix(0.5).stroke_width(1)
    } else {
        colour.stroke_width(2)
    };
    if state == "plain" {
        area.draw(&PathElement::new(vec![whole(from), whole(to)], style))?;
        return Ok(());
    }
    let long = f64::hypot(to[0] - from[0], to[1] - from[1]);
    let dashes = (long / 9.0).ceil().max(1.0);
    let along = |s: f64| whole([0, 1].map(|k| from[k] + s.min(1.0) * (to[k] - from[k])));
    for dash in 0..dashes as usize {
        let begin = dash as f64 / dashes;
        let path = vec![along(begin), along(begin + 0.55 / dashes)];
        area.draw(&PathElement::new(path, style))?;
    }
    Ok(())
}

fn legend(root: &Root<'_>) -> Outcome {
    let (mut x, y) = (32.0, 56.0);
    let styles = [
        ("f32", "plain", "f32"),
        ("f32", "compensated", "f32, compensated sums"),
        ("f64", "plain", "f64"),
    ];
    let mut entry = |words: &str, arith: &str, state: &str, colour: RGBColor| -> Outcome {
        stroke(root, [[x, y], [x + 26.0, y]], arith, state, colour)?;
        text(root, words, whole([x + 32.0, y]), 14, &INK, HPos::Left)?;
        x += 54.0 + 6.6 * words.chars().count() as f64;
        Ok(())
    };
    for (_, words, colour) in COLOURS {
        entry(words, "f32", "plain", colour)?;
    }
    for (arith, state, words) in styles {
        entry(words, arith, state, INK)?;
    }
    Ok(())
}
