//! The pictures: a robot's front with the names of its steps and of single changes, which the
//! README's table has, and the simulations.

use super::front as fronts;
use super::join::Host;
use super::names::{name, stated};
use super::page::{BRIEF_ROWS, SCENES, is_single, page_of, steps};
use super::point::{Kind, Point, of_group};
use super::robot::Robot;
use crate::kit::chart::{
    Axis, BLUE, GREEN, HEAD, HPos, INK, Line, Names, ORANGE, Plot, RED, RGBColor, SKY, TEXT, TITLE,
    dot, label, legend, lines, path, svg,
};
use crate::kit::error::Result;

/// Yardsticks in the picture; the page has all.
const MEASURES: [(&str, &str); 3] = [
    ("friction10", "friction known to 10 %"),
    ("inertial1", "inertias known to 1 %"),
    ("encoder14", "14-bit encoder"),
];
/// By integrator, with the width of its line: semi-implicit Euler and implicit damping lie on each
/// other.
const INTEGRATORS: [(&str, &str, RGBColor, u32); 5] = [
    ("euler", "explicit Euler", SKY, 2),
    ("semi_implicit", "semi-implicit Euler", GREEN, 6),
    ("rk4", "RK4", BLUE, 2),
    ("energy", "energy-preserving", ORANGE, 2),
    ("implicit_damping", "implicit damping", RED, 2),
];
/// Cycles of a second at 168 MHz: a simulation right of it is slower than what it simulates.
const REAL_TIME: f64 = 168e6;

/// The pictures of the part of the page about a robot's torques, or about the simulations: file and
/// SVG.
pub fn pictures(points: &[Point], host: &Host, robot: Robot) -> Result<Vec<(String, String)>> {
    let file = format!("docs/{}", page_of(robot).name);
    if robot == Robot::DoublePendulum {
        return Ok(vec![(file + ".svg", simulations(points)?)]);
    }
    let [name, title, ..] = robot.names();
    let own = of_group(points, (name, Kind::Inverse, ""));
    Ok(vec![(file + ".svg", front([name, title], &own, host)?)])
}

/// Logarithmic axes around these points, with so much room left, right and above.
fn axes(
    names: [&'static str; 2],
    points: impl Iterator<Item = (f64, f64)>,
    [left, right, above]: [f64; 3],
) -> [Axis; 2] {
    let (mut low, mut high) = ([f64::INFINITY; 2], [1e-300_f64; 2]);
    for (x, y) in points {
        low = [low[0].min(x), low[1].min(y)];
        high = [high[0].max(x), high[1].max(y)];
    }
    let low = [low[0] / left, low[1].max(1e-13 * high[1]) / 2.0];
    let mut x = Axis::decades(names[0], [low[0], high[0] * right], 46);
    if x.ticks.len() < 3 {
        let numbers =
            (-1..9).flat_map(|power| [1.0, 2.0, 5.0].map(|digit| digit * 10_f64.powi(power)));
        x.ticks = numbers.filter(|x0| (x.ends[0]..x.ends[1]).contains(x0)).collect();
    }
    [x, Axis::decades(names[1], [low[1], high[1] * above], 72)]
}

/// Points from the cheapest down as a stair.
fn stair(plot: &Plot, points: impl Iterator<Item = (f64, f64)>) -> Vec<(i32, i32)> {
    let mut corners: Vec<(i32, i32)> = Vec::new();
    for (x, y) in points.map(|point| plot.at(point)) {
        corners.extend(corners.last().map(|&(_, above)| (x, above)));
        corners.push((x, y));
    }
    corners
}

/// The front by the worst tick, with what is proven of its points, names and yardsticks.
pub fn front([robot, title]: [&str; 2], points: &[&Point], host: &Host) -> Result<String> {
    let head = format!("{title}: the cheapest inverse dynamics of each accuracy");
    let default = points.iter().find(|point| point.is_default());
    // Points that cost more than the default are in the page's tables.
    let cheap = |point: &&Point| default.is_none_or(|default| point.cycles <= default.cycles);
    let mut shown = fronts::front(points, 0);
    shown.retain(cheap);
    let is_step = |point: &&&Point| steps(&shown, 0).iter().any(|step| step.key == point.key);
    let in_table = |point: &&&Point| is_single(point, BRIEF_ROWS);
    let on = shown.iter().filter(|point| is_step(point) || in_table(point));
    let off = points.iter().filter(|point| in_table(point) && (!point.fronts[0] || !cheap(point)));
    svg((860, 720), |root| {
        label(root, &head, (28, 22), TITLE, HPos::Left)?;
        let is_proven = shown.iter().any(|point| point.proven.is_some());
        let entries = [
            ("the front", BLUE, 4),
            ("the front, proven", GREEN, 4),
            ("other single changes of the default", ORANGE, 4),
            ("errors of other causes", RED, 1),
        ];
        let entries = entries.into_iter().filter(|(_, colour, _)| is_proven || *colour != GREEN);
        let entries = entries.map(|(name, colour, width)| (name.to_owned(), colour, width));
        legend(root, entries, (90, 46))?;
        let ends = shown.iter().chain(off.clone());
        let names = [
            "cycles of the worst tick (Cortex-M4F at zero wait states, modelled; at 168 MHz 1,000 take 6 µs)",
            "largest torque error, N·m",
        ];
        let proven = |point: &&Point| Some((point.cycles as f64, point.proven?));
        let proven: Vec<(f64, f64)> = shown.iter().filter_map(proven).collect();
        // Names may be below their points.
        let below = shown.last().map(|last| (last.cycles as f64, last.error() / 4.0));
        let ends = ends.map(|point| point.place());
        let ends = ends.chain(proven.clone()).chain(below);
        let both = axes(names, ends, [1.9, 1.4, 9.0]);
        let plot = lines(root, 58, both.each_ref(), &[])?;
        let [x0, x1] = both[0].ends.map(|x| plot.at((x, 1.0)).0);
        let [y0, y1] = both[1].ends.map(|y| plot.at((1.0, y)).1);
        let mut names = Names::new([(x0, y1), (x1, y0)]);
        let twin = stair(&plot, proven.iter().copied());
        let corners = stair(&plot, shown.iter().map(|point| point.place()));
        for (stair, colour) in [(&twin, GREEN), (&corners, BLUE)] {
            path(root, stair, colour, 2)?;
            names.keep_off_line(stair);
        }
        let named: Vec<&Point> = on.copied().chain(off.copied()).collect();
        for place in proven {
            dot(root, plot.at(place), 3, GREEN)?;
            names.keep_off_dot(plot.at(place), 3);
        }
        named.iter().for_each(|point| names.keep_off_dot(plot.at(point.place()), 4));
        let yardsticks = MEASURES.iter().filter_map(|(key, what)| {
            let mut lines = host.of(Kind::Yardstick, robot);
            let error = lines.find(|line| line.point.key == *key)?.point.error_max?;
            Some((plot.at((1.0, error)).1, format!("{what}: {} N·m", stated(Some(error)))))
        });
        let yardsticks: Vec<_> = yardsticks.collect();
        for (y, _) in &yardsticks {
            for x in (x0..x1 - 6).step_by(12) {
                path(root, &[(x, *y), (x + 7, *y)], RED, 1)?;
            }
            names.keep_off_line(&[(x0, *y), (x1, *y)]);
        }
        for (y, words) in &yardsticks {
            let ends = [(x1 - 4, HPos::Right), (x0 + 4, HPos::Left)];
            let both = ends.map(|(x, side)| [-11, 11].map(|up| ((x, y + up), side)));
            names.first_free(root, (words, RED), both.as_flattened())?;
        }
        for point in &named {
            let at = plot.at(point.place());
            names.beside(root, &name(point), at, INK)?;
            let is_off = !point.fronts[0] || !cheap(point);
            dot(root, at, 4, if is_off { ORANGE } else { BLUE })?;
        }
        Ok(())
    })
}

/// Errors against cycles, a line per integrator through its lengths of step.
pub fn simulations(points: &[Point]) -> Result<String> {
    svg((1160, 840), |root| {
        let entries =
            INTEGRATORS.map(|(_, words, colour, width)| (words.to_owned(), colour, width.max(3)));
        legend(root, entries, (28, 20))?;
        let how = "A dot is a length of step, 10 ms to 20 µs. Large: f32; small: f32 with compensated sums. f64, in software, is in the tables.";
        label(root, how, (28, 44), TEXT, HPos::Left)?;
        let (_, charts) = root.split_vertically(58);
        let areas = charts.split_evenly((2, 2));
        for ((robot, scene, title), area) in SCENES.into_iter().zip(&areas) {
            let mut own = of_group(points, (robot.name(), Kind::Simulation, scene));
            own.retain(|point| point.error().is_finite() && point.on("arith") == "f32");
            own.sort_by_key(|point| point.cycles);
            let names = ["cycles for a simulated second", "largest error, rad"];
            let both = axes(names, own.iter().map(|point| point.place()), [1.4, 1.4, 2.0]);
            let states = [("plain", None), ("compensated", Some(1))];
            let of = |&(integrator, _, colour, width): &_, (state, thin): (&str, Option<u32>)| {
                let kind = [integrator, state];
                let of =
                    |point: &&&Point| ["integrator", "state"].map(|axis| point.on(axis)) == kind;
                Line {
                    points: own.iter().filter(of).map(|point| point.place()).collect(),
                    colour,
                    width: thin.unwrap_or(width),
                    dots: if thin.is_some() { 2 } else { width as i32 / 2 + 3 },
                }
            };
            let each = INTEGRATORS.iter().flat_map(|method| states.map(|state| of(method, state)));
            label(area, title, (28, 14), HEAD, HPos::Left)?;
            let plot = lines(area, 46, both.each_ref(), &each.collect::<Vec<_>>())?;
            if both[0].ends[1] > REAL_TIME {
                plot.mark(area, (REAL_TIME, "real time at 168 MHz", HPos::Right))?;
            }
        }
        Ok(())
    })
}
