//! The pictures: a robot's front with a few names, all of its ways as dots, and the simulations.

use plotters::coord::combinators::LogCoord;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::front as fronts;
use super::join::Host;
use super::measure::Robot;
use super::names::{cycles, name, stated};
use super::page::{SCENES, steps};
use super::point::{Kind, Point, of_group};
use crate::kit::chart::{Area, FAINT, FONT, INK, Outcome, svg};
use crate::kit::error::Result;

const DOT: RGBColor = RGBColor(165, 174, 185);
const WORST: RGBColor = RGBColor(27, 80, 162);
const MEAN: RGBColor = RGBColor(214, 110, 0);
const MEASURE: RGBColor = RGBColor(150, 45, 95);
const GREEN: RGBColor = RGBColor(0, 128, 110);
const RED: RGBColor = RGBColor(200, 50, 90);
/// px: a line of text, and how wide a letter is.
const TEXT: i32 = 14;
const LETTER: f64 = 6.9;
/// Points of a front that have a name, beside the default.
const NAMES: usize = 7;
/// Yardsticks in the picture; the page has all.
const MEASURES: [(&str, &str); 3] = [
    ("friction10", "friction known to 10 %"),
    ("inertial1", "inertias known to 1 %"),
    ("encoder14", "14-bit encoder"),
];
/// By integrator; readable to the colour-blind.
const COLOURS: [(&str, &str, RGBColor); 5] = [
    ("euler", "explicit Euler", RGBColor(86, 160, 211)),
    ("semi_implicit", "semi-implicit Euler", GREEN),
    ("rk4", "RK4", WORST),
    ("energy", "energy-preserving", RGBColor(230, 145, 0)),
    ("implicit_damping", "implicit damping", RED),
];
/// Cycles of a second at 168 MHz: a simulation right of it is slower than what it simulates.
const REAL_TIME: f64 = 168e6;
const TICK: &str = "cycles of the worst tick (Cortex-M4F at zero wait states, modelled)";
const TORQUE: &str = "largest torque error, N·m";

type Place = (i32, i32);
type Axes = Cartesian2d<LogCoord<f64>, LogCoord<f64>>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Axes>;

/// Words to the right or left of a place.
fn text(area: &Area<'_>, words: &str, at: Place, colour: RGBColor, side: HPos) -> Outcome {
    let font = (FONT, TEXT).into_font().color(&colour);
    let style = font.pos(Pos::new(side, VPos::Center));
    Ok(area.draw(&Text::new(words.to_owned(), at, style))?)
}

fn wide(words: &str) -> i32 {
    (LETTER * words.chars().count() as f64) as i32
}

/// A line through these places, and dots on them.
fn path(area: &Area<'_>, places: &[Place], width: u32, dots: i32, colour: RGBColor) -> Outcome {
    area.draw(&PathElement::new(places, colour.stroke_width(width)))?;
    for &place in places.iter().filter(|_| dots > 0) {
        area.draw(&Circle::new(place, dots, colour.filled()))?;
    }
    Ok(())
}

/// Logarithmic axes around these points, with so much room left and right, under a title.
fn axes<'a, 'b>(
    area: &'a Area<'b>,
    [title, x, y]: [&str; 3],
    points: impl Iterator<Item = (f64, f64)>,
    room: [f64; 2],
) -> std::result::Result<Chart<'a, 'b>, Box<dyn std::error::Error>> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [1e-300_f64; 2]);
    for (x, y) in points {
        low = [low[0].min(x), low[1].min(y)];
        high = [high[0].max(x), high[1].max(y)];
    }
    let across = (low[0] / room[0]..high[0] * room[1]).log_scale();
    let up = (low[1].max(1e-9 * high[1]) / 2.0..high[1] * 2.0).log_scale();
    text(area, title, (12, 16), INK, HPos::Left)?;
    let mut builder = ChartBuilder::on(area);
    builder.margin_top(32).margin_right(16).margin_left(8);
    builder.x_label_area_size(44).y_label_area_size(72);
    let mut chart = builder.build_cartesian_2d(across, up)?;
    let label = (FONT, TEXT).into_font().color(&INK);
    let mut mesh = chart.configure_mesh();
    mesh.light_line_style(TRANSPARENT)
        .bold_line_style(FAINT)
        .axis_style(INK);
    mesh.label_style(label.clone()).axis_desc_style(label);
    let short = |x: &f64| {
        // Between powers of ten, 2, 3 and 5 have room.
        let digit = (x / 10_f64.powf(x.log10().floor() + 1e-9)).round();
        match x {
            _ if ![1.0, 2.0, 3.0, 5.0, 10.0].contains(&digit) => String::new(),
            1.0..1e5 => cycles(*x),
            _ => format!("{x:.0e}"),
        }
    };
    let error = |y: &f64| match y {
        0.009..1e4 => format!("{}", (y * 1e3).round() / 1e3),
        _ => format!("{y:.0e}"),
    };
    mesh.x_label_formatter(&short).y_label_formatter(&error);
    mesh.x_desc(x).y_desc(y).draw()?;
    drop(mesh);
    Ok(chart)
}

/// The position of a cost and an error; errors below the lower edge are drawn on it.
fn at(chart: &Chart<'_, '_>, (cost, error): (f64, f64)) -> Place {
    chart.backend_coord(&(cost, error.max(chart.y_range().start)))
}

/// A front by a cost as a stair, from the cheapest down.
fn stair(area: &Area<'_>, chart: &Chart<'_, '_>, front: &[&Point], cost: usize) -> Outcome {
    let places = front
        .iter()
        .map(|point| at(chart, (point.costs()[cost], point.error())));
    let mut corners: Vec<Place> = Vec::new();
    for (x, y) in places.clone() {
        corners.extend(corners.last().map(|&(_, above)| (x, above)));
        corners.push((x, y));
    }
    let colour = [WORST, MEAN][cost];
    path(area, &corners, 2, 0, colour)?;
    path(area, &places.collect::<Vec<_>>(), 0, 4, colour)
}

/// The front by the worst tick, with names and yardsticks.
pub fn front(robot: Robot, points: &[&Point], host: &Host) -> Result<String> {
    let title = robot.names()[1];
    let head = format!(
        "{title}: the cheapest inverse dynamics of each accuracy; dashed: errors of other causes"
    );
    let default = points.iter().find(|point| point.is_default());
    let mut shown = fronts::front(points, 0);
    // Points that cost more than the default are in the other picture.
    shown.retain(|point| default.is_none_or(|default| point.cycles <= default.cycles));
    svg((800, 520), |root| {
        let ends = shown.iter().map(|point| point.place());
        let chart = axes(root, [&head, TICK, TORQUE], ends, [1.9, 2.2])?;
        let across = chart.x_range();
        let [x0, x1] = [across.start, across.end].map(|x| at(&chart, (x, 1.0)).0);
        let mut dashed: Vec<i32> = Vec::new();
        for (key, what) in MEASURES {
            let mut yardsticks = host.of(Kind::Yardstick, robot.name());
            let yardstick = yardsticks.find(|line| line.point.key == key);
            let Some(error) = yardstick.and_then(|line| line.point.error_max) else {
                continue;
            };
            let y = at(&chart, (1.0, error)).1;
            for x in (x0..x1 - 6).step_by(12) {
                path(root, &[(x, y), (x + 7, y)], 1, 0, MEASURE)?;
            }
            // Below its line where another one is close above.
            let crowded = dashed.iter().any(|other| (y - 20..y).contains(other));
            let words = format!("{what}: {} N·m", stated(Some(error)));
            let beside = if crowded { y + 10 } else { y - 10 };
            text(root, &words, (x1 - 4, beside), MEASURE, HPos::Right)?;
            dashed.push(y);
        }
        stair(root, &chart, &shown, 0)?;
        let mut steps = steps(&shown, 0);
        steps.retain(|point| !point.is_default());
        let count = steps.len().min(NAMES);
        let named = (0..count)
            .map(|i| steps[i * steps.len() / count])
            .chain(default.copied());
        // Left of a front that falls to the right there is room; names keep clear of each other and of dashed lines.
        let mut last = i32::MIN / 2;
        for point in named {
            let (x, y) = at(&chart, point.place());
            let words = name(point);
            if x - 12 - wide(&words) < x0 {
                text(root, &words, (x + 2, y - 12), INK, HPos::Left)?;
                continue;
            }
            let mut height = y.max(last + 17);
            while let Some(line) = dashed.iter().find(|line| (height - **line).abs() < 10) {
                height = line + 10;
            }
            text(root, &words, (x - 12, height), INK, HPos::Right)?;
            if height > y + 5 {
                path(root, &[(x - 3, y + 3), (x - 10, height)], 1, 0, DOT)?;
            }
            last = height;
        }
        Ok(())
    })
}

/// The picture of all configurations by the cost of the worst tick, with both fronts.
pub fn all(robot: Robot, points: &[&Point]) -> Result<String> {
    let title = robot.names()[1];
    let head = format!(
        "{title}: every way; fronts by the worst tick (blue) and by the mean over ticks (orange)"
    );
    let finite = points.iter().filter(|point| point.error().is_finite());
    svg((800, 520), |root| {
        let both = finite
            .clone()
            .flat_map(|point| point.costs().map(|cost| (cost, point.error())));
        let chart = axes(root, [&head, "cycles of a tick", TORQUE], both, [1.7, 1.7])?;
        for point in finite {
            let place = at(&chart, point.place());
            path(root, &[place], 0, 2, DOT)?;
        }
        stair(root, &chart, &fronts::front(points, 1), 1)?;
        stair(root, &chart, &fronts::front(points, 0), 0)
    })
}

/// Errors against cycles, a line per integrator through its lengths of step.
pub fn simulations(points: &[Point]) -> Result<String> {
    svg((800, 1300), |root| {
        let mut x = 12;
        for (_, words, colour) in COLOURS {
            path(root, &[(x, 16), (x + 22, 16)], 3, 0, colour)?;
            text(root, words, (x + 28, 16), INK, HPos::Left)?;
            x += 44 + wide(words);
        }
        let how = "large dots: f32; small dots: f32 with compensated sums; no dots: f64. A dot is a length of step, 10 ms to 20 µs.";
        text(root, how, (12, 38), INK, HPos::Left)?;
        for (row, (robot, scene, title)) in SCENES.into_iter().enumerate() {
            let area = root.clone().shrink((0, 50 + 310 * row as i32), (800, 305));
            let own = of_group(points, (robot.name(), Kind::Simulation, scene));
            let finite = || own.iter().filter(|point| point.error().is_finite());
            let names = [title, "cycles for a simulated second", "largest error, rad"];
            let ends = finite().map(|point| point.place());
            let chart = axes(&area, names, ends, [1.4, 1.4])?;
            // Coordinates of a chart are those of the whole picture.
            let (x, y) =
                chart.backend_coord(&(REAL_TIME, finite().map(|p| p.error()).fold(0.0, f64::max)));
            if x < 780 {
                path(root, &[(x, y), (x, y + 200)], 1, 0, DOT)?;
                text(root, "real time at 168 MHz", (x - 5, y), INK, HPos::Right)?;
            }
            for (integrator, _, colour) in COLOURS {
                for (arith, state, width, dots) in [
                    ("f64", "plain", 1, 0),
                    ("f32", "plain", 2, 4),
                    ("f32", "compensated", 1, 2),
                ] {
                    let kind = [integrator, arith, state];
                    let of = |point: &&&Point| {
                        ["integrator", "arith", "state"].map(|axis| point.on(axis)) == kind
                    };
                    let mut line: Vec<_> = finite().filter(of).collect();
                    line.sort_by_key(|point| point.cycles);
                    let places = line.iter().map(|p| at(&chart, p.place()));
                    path(root, &places.collect::<Vec<_>>(), width, dots, colour)?;
                }
            }
        }
        Ok(())
    })
}
