//! The pictures: a robot's front with a few names, all of its ways as dots, and the simulations.

use plotters::coord::Shift;
use plotters::coord::combinators::LogCoord;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::front as fronts;
use super::join::Line;
use super::page::{SCENES, steps};
use super::point::{Kind, Point, of_group};
use super::words::{cycles, name, stated};
use crate::error::{Error, Result};

const FONT: &str = "system-ui, Helvetica, Arial, sans-serif";
const INK: RGBColor = RGBColor(45, 50, 58);
const FAINT: RGBColor = RGBColor(228, 231, 235);
const DOT: RGBColor = RGBColor(165, 174, 185);
const WORST: RGBColor = RGBColor(27, 80, 162);
const MEAN: RGBColor = RGBColor(214, 110, 0);
const MEASURE: RGBColor = RGBColor(150, 45, 95);

/// px: a line of text, and how wide a letter is.
const TEXT: i32 = 14;
const LETTER: f64 = 6.9;
/// Names at most.
const NAMES: usize = 8;
/// Yardsticks in the picture; the page has all.
const MEASURES: [(&str, &str); 3] = [
    ("friction10", "friction known to 10 %"),
    ("inertial1", "inertias known to 1 %"),
    ("encoder14", "14-bit encoder"),
];
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
/// Cycles of a second at 168 MHz: a simulation right of it is slower than what it simulates.
const REAL_TIME: f64 = 168e6;

type Outcome = std::result::Result<(), Box<dyn std::error::Error>>;
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<LogCoord<f64>, LogCoord<f64>>>;

fn svg(what: &str, size: (u32, u32), draw: impl FnOnce(&Area<'_>) -> Outcome) -> Result<String> {
    let mut svg = String::new();
    let drawn = {
        let root = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        let filled = root.fill(&WHITE).map_err(Into::into);
        filled
            .and_then(|()| draw(&root))
            .and_then(|()| Ok(root.present()?))
    };
    drawn.map_err(|e| Error::check(format!("cannot draw {what}: {e}")))?;
    Ok(svg)
}

/// Words beside a place: to its right or left, on its height.
fn text(area: &Area<'_>, words: &str, at: (i32, i32), colour: &RGBColor, side: HPos) -> Outcome {
    let font = (FONT, TEXT)
        .into_font()
        .color(colour)
        .pos(Pos::new(side, VPos::Center));
    Ok(area.draw(&Text::new(words.to_owned(), at, font))?)
}

fn line(area: &Area<'_>, path: Vec<(i32, i32)>, style: impl Into<ShapeStyle>) -> Outcome {
    Ok(area.draw(&PathElement::new(path, style.into()))?)
}

fn dot(area: &Area<'_>, at: (i32, i32), radius: i32, style: impl Into<ShapeStyle>) -> Outcome {
    Ok(area.draw(&Circle::new(at, radius, style.into()))?)
}

/// Logarithmic axes under a line of text.
fn axes<'a, 'b>(
    area: &'a Area<'b>,
    title: &str,
    [x, y]: [&str; 2],
    [[left, right], [low, high]]: [[f64; 2]; 2],
) -> std::result::Result<Chart<'a, 'b>, Box<dyn std::error::Error>> {
    text(area, title, (12, 16), &INK, HPos::Left)?;
    let mut chart = ChartBuilder::on(area)
        .margin_top(32)
        .margin_right(16)
        .x_label_area_size(44)
        .y_label_area_size(72)
        .build_cartesian_2d((left..right).log_scale(), (low..high).log_scale())?;
    let label = (FONT, TEXT).into_font().color(&INK);
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(FAINT)
        .axis_style(INK)
        .label_style(label.clone())
        .axis_desc_style(label)
        .x_desc(x)
        .y_desc(y)
        .x_label_formatter(&|x| {
            if *x < 1e5 {
                cycles(*x)
            } else {
                format!("{x:.0e}")
            }
        })
        .y_label_formatter(&|y| {
            if (0.009..1e4).contains(y) {
                format!("{}", (y * 1e3).round() / 1e3)
            } else {
                format!("{y:.0e}")
            }
        })
        .draw()?;
    Ok(chart)
}

/// The smallest and the largest.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let seen = values.filter(|value| value.is_finite() && *value > 0.0);
    seen.fold([f64::INFINITY, 1e-300], |[low, high], value| {
        [low.min(value), high.max(value)]
    })
}

/// A front by a cost as a stair, from the cheapest down.
fn stair(area: &Area<'_>, front: &[(i32, i32)], colour: RGBColor) -> Outcome {
    let mut corners: Vec<(i32, i32)> = Vec::new();
    for &(x, y) in front {
        corners.extend(corners.last().map(|&(_, above)| (x, above)));
        corners.push((x, y));
    }
    line(area, corners, colour.stroke_width(2))?;
    front
        .iter()
        .try_for_each(|&at| dot(area, at, 4, colour.filled()))
}

const CYCLES: &str = "cycles of the worst tick (Cortex-M4F at zero wait states, modelled)";
const TORQUE: &str = "largest torque error, N·m";

/// The front by the worst tick, with names and yardsticks.
pub fn front(title: &str, points: &[&Point], yardsticks: &[&Line]) -> Result<String> {
    let head = format!(
        "{title}: the cheapest inverse dynamics of each accuracy; dashed: errors from other causes"
    );
    svg(title, (800, 520), |root| {
        let default = points.iter().find(|point| point.is_default());
        let [most, floor] = default.map_or([f64::INFINITY, 0.0], |p| {
            [1.05 * p.cycles as f64, p.error()]
        });
        let mut shown = fronts::front(points, 0);
        shown.retain(|point| point.cycles as f64 <= most && point.error() >= 0.1 * floor);
        let [left, right] = range(shown.iter().map(|point| point.cycles as f64));
        let [low, high] = range(shown.iter().map(|point| point.error()));
        let ranges = [[left * 0.55, right * 2.2], [low * 0.3, high * 3.0]];
        let chart = axes(root, &head, [CYCLES, TORQUE], ranges)?;
        let at = |x: f64, y: f64| chart.backend_coord(&(x, y));
        let (x0, _) = at(ranges[0][0], low);
        let (x1, _) = at(ranges[0][1], low);
        let mut taken: Vec<i32> = Vec::new();
        let lines = MEASURES.iter().filter_map(|(key, what)| {
            let line = yardsticks.iter().find(|line| line.key == *key)?;
            Some((what, line.errors.error_max?))
        });
        for (what, error) in lines {
            let (_, y) = at(left, error);
            for dash in (x0..x1).step_by(12) {
                line(
                    root,
                    vec![(dash, y), ((dash + 7).min(x1), y)],
                    MEASURE.stroke_width(1),
                )?;
            }
            // Below its line where another one is close above.
            let crowded = taken.iter().any(|other| (y - 18..y).contains(other));
            let words = format!("{what}: {} N·m", stated(Some(error)));
            text(
                root,
                &words,
                (x1 - 4, if crowded { y + 10 } else { y - 10 }),
                &MEASURE,
                HPos::Right,
            )?;
            taken.push(y);
        }
        let path: Vec<_> = shown
            .iter()
            .map(|point| at(point.cycles as f64, point.error()))
            .collect();
        stair(root, &path, WORST)?;
        // Left of a front that falls to the right there is room; names keep clear of each other and of dashed lines.
        let mut named = steps(&shown, 0);
        named.retain(|point| !point.is_default());
        let places = named.len();
        let spare = NAMES - 1;
        let mut named: Vec<&Point> = (0..places.min(spare))
            .map(|i| named[i * places / places.min(spare)])
            .collect();
        named.extend(default);
        let mut above = i32::MIN / 2;
        for point in named {
            let (x, y) = at(point.cycles as f64, point.error());
            let words = name(point);
            let wide = (LETTER * words.chars().count() as f64) as i32;
            if x - 12 - wide < x0 {
                text(root, &words, (x + 2, y - 12), &INK, HPos::Left)?;
                continue;
            }
            let mut height = y.max(above + 17);
            while let Some(dashed) = taken.iter().find(|dashed| (height - **dashed).abs() < 9) {
                height = dashed + 9;
            }
            text(root, &words, (x - 12, height), &INK, HPos::Right)?;
            if height > y + 5 {
                line(
                    root,
                    vec![(x - 3, y + 3), (x - 10, height)],
                    INK.mix(0.5).stroke_width(1),
                )?;
            }
            above = height;
        }
        Ok(())
    })
}

/// All ways, by what the worst tick costs, and both fronts.
pub fn all(title: &str, points: &[&Point]) -> Result<String> {
    let head = format!(
        "{title}: every way; fronts by the worst tick (blue) and by the mean over ticks (orange)"
    );
    svg(title, (800, 520), |root| {
        let x = range(points.iter().flat_map(|point| point.costs()));
        let y = range(points.iter().map(|point| point.error()));
        let chart = axes(
            root,
            &head,
            ["cycles of a tick", TORQUE],
            [x, y].map(|[a, b]| [a * 0.6, b * 1.7]),
        )?;
        for point in points.iter().filter(|point| point.error().is_finite()) {
            dot(
                root,
                chart.backend_coord(&(point.cycles as f64, point.error())),
                2,
                DOT.filled(),
            )?;
        }
        for (cost, colour) in [(1, MEAN), (0, WORST)] {
            let front = fronts::front(points, cost);
            let place = |point: &&Point| chart.backend_coord(&(point.costs()[cost], point.error()));
            stair(root, &front.iter().map(place).collect::<Vec<_>>(), colour)?;
        }
        Ok(())
    })
}

/// Errors against cycles, a line per integrator through its lengths of step.
pub fn simulations(points: &[Point]) -> Result<String> {
    svg("the simulations", (800, 1300), |root| {
        let (mut x, mut y) = (12, 16);
        for (_, words, colour) in COLOURS {
            line(root, vec![(x, y), (x + 22, y)], colour.stroke_width(3))?;
            text(root, words, (x + 28, y), &INK, HPos::Left)?;
            x += 44 + (LETTER * words.chars().count() as f64) as i32;
        }
        y += 22;
        let how = "filled: f32; rings: f32 with compensated sums; thin: f64. Each dot is a length of step, 10 ms to 20 µs.";
        text(root, how, (12, y), &INK, HPos::Left)?;
        for (row, (robot, scene, title)) in SCENES.into_iter().enumerate() {
            let area = root.clone().shrink((0, 50 + 310 * row as i32), (800, 305));
            let own = of_group(points, (robot.name(), Kind::Simulation, scene));
            panel(root, &area, title, &own)?;
        }
        Ok(())
    })
}

fn panel(root: &Area<'_>, area: &Area<'_>, title: &str, points: &[&Point]) -> Outcome {
    let [left, right] = range(points.iter().map(|point| point.cycles as f64));
    let [low, high] = range(points.iter().map(|point| point.error()));
    let low = low.max(1e-9 * high);
    let names = ["cycles for a simulated second", "largest error, rad"];
    let chart = axes(
        area,
        title,
        names,
        [[left * 0.7, right * 1.5], [low * 0.5, high * 2.0]],
    )?;
    // Coordinates of a chart are those of the whole picture.
    let at = |x: f64, y: f64| chart.backend_coord(&(x, y));
    if (left..right).contains(&REAL_TIME) {
        let (x, top) = at(REAL_TIME, high);
        line(
            root,
            vec![(x, top), (x, at(REAL_TIME, low).1)],
            INK.mix(0.4).stroke_width(1),
        )?;
        text(
            root,
            "real time at 168 MHz",
            (x + 5, top - 4),
            &INK,
            HPos::Left,
        )?;
    }
    for (integrator, _, colour) in COLOURS {
        for (arith, state, wide, radius) in [
            ("f64", "plain", 1, 2),
            ("f32", "plain", 2, 3),
            ("f32", "compensated", 2, 5),
        ] {
            let of = |point: &&&Point| {
                // What is below the lower edge is not drawn.
                let drawn = point.error().is_finite() && point.error() > 0.5 * low;
                drawn
                    && [point.on("integrator"), point.on("arith"), point.on("state")]
                        == [integrator, arith, state]
            };
            let mut own: Vec<_> = points.iter().filter(of).collect();
            own.sort_by_key(|point| point.cycles);
            let path: Vec<_> = own
                .iter()
                .map(|point| at(point.cycles as f64, point.error()))
                .collect();
            for &place in &path {
                let style = if state == "plain" {
                    colour.filled()
                } else {
                    colour.stroke_width(1)
                };
                dot(
                    root,
                    place,
                    if state == "plain" { radius } else { 5 },
                    style,
                )?;
            }
            line(root, path, colour.stroke_width(wide))?;
        }
    }
    Ok(())
}
