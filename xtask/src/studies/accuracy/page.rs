//! docs/accuracy.md: fronts, what single choices cost, yardsticks, simulations.

use super::front;
use super::join::Host;
use super::names::{cycles, digits, name, stated};
use super::point::{Kind, Point, of_group};
use super::robot::Robot;
use crate::kit::docs::Page;
use crate::kit::meter::MODEL;
use crate::kit::table::{Table, thousands};

pub const FILE: &str = "docs/accuracy.md";
pub const COMMAND: &str = "cargo xtask accuracy";

/// The configurations whose generated code a test measures; those of the pictures come first.
const SINGLE: &str = "default trig=table model=pruned1000 rate=10,between=linearised model=no_coriolis model=gravity \
                      trig=minimax5 trig=minimax3 trig=minimax7 trig=incremental model=params8 rate=10 \
                      rate=10,between=interpolated trig=table3x4,form=core";

/// Those of the pictures.
pub const BRIEF_ROWS: usize = 6;

/// Whether a point is one of the first so many of them.
pub fn is_single(point: &Point, most: usize) -> bool {
    SINGLE.split(' ').take(most).any(|key| key == point.key)
}

/// A step of a front is at least so much more accurate than the one before it: others are there,
/// but not worth a word.
const STEP: f64 = 0.8;

/// The negligible error, as a share of full scale.
const ERROR: f64 = 1e-3;

/// The part of the page about a robot's torques, or about the simulations.
pub fn page_of(robot: Robot) -> Page<'static> {
    let name = match robot {
        Robot::Ur5e => "accuracy-ur5e",
        Robot::Panda => "accuracy-panda",
        Robot::A1Leg => "accuracy-a1_leg",
        Robot::DoublePendulum => "accuracy-simulation",
    };
    Page { file: FILE, name, command: COMMAND }
}

/// The points of a front, from the cheapest on, each much more accurate than the one before; the
/// default in any case.
pub fn steps<'a>(points: &[&'a Point], cost: usize) -> Vec<&'a Point> {
    let mut least = f64::INFINITY;
    let mut steps = front::front(points, cost);
    steps.retain(|point| {
        let step = point.error() <= STEP * least;
        if step {
            least = point.error();
        }
        step || point.is_default()
    });
    steps
}

/// Rows by their names, with the columns of these numbers, each with what it is called.
fn table(rows: &[(String, &Point)], first: &str, columns: &str) -> Table {
    let default = rows.iter().find(|(_, point)| point.is_default());
    let any = |of: fn(&Point) -> Option<f64>| rows.iter().any(|(_, point)| of(point).is_some());
    let is_shown = |number: usize| match number {
        PROVEN => any(|point| point.proven),
        IN_BOX => any(|point| point.error_box),
        _ => true,
    };
    let columns = columns.split("; ").filter_map(|column| {
        let (number, head) = column.split_once(' ')?;
        let number = number.parse::<usize>().ok()?;
        is_shown(number).then_some((number, head))
    });
    let (numbers, heads): (Vec<_>, Vec<_>) = columns.unzip();
    let mut table = Table::new(&[&[first], &heads[..]].concat());
    for (name, point) in rows {
        let share = |cost: usize| {
            let ratio = default.map(|(_, default)| point.costs()[cost] / default.costs()[cost]);
            ratio.map_or_else(String::new, percent)
        };
        let [max, p99, rms, relative] = point.errors().map(stated);
        let cells = [
            thousands(point.instructions),
            thousands(point.cycles),
            share(0),
            cycles(point.cycles_mean),
            share(1),
            max,
            p99,
            rms,
            relative,
            stated(point.proven),
            stated(point.error_box),
        ];
        let row = numbers.iter().map(|number| cells[*number].clone());
        table.row(std::iter::once(name.clone()).chain(row));
    }
    table
}

fn named<'a>(points: &[&'a Point]) -> Vec<(String, &'a Point)> {
    points.iter().map(|point| (name(point), *point)).collect()
}

/// These points by their robots and names.
fn of_robots<'a>(points: &'a [Point], shown: impl Fn(&Point) -> bool) -> Vec<(String, &'a Point)> {
    let shown = points.iter().filter(|point| shown(point));
    let name = |point: &'a Point| (format!("{} {}", point.robot, name(point)), point);
    shown.map(name).collect()
}

pub fn percent(ratio: f64) -> String {
    if ratio < 9.95 {
        return format!("{:.0} %", 100.0 * ratio);
    }
    format!("{ratio:.0} ×")
}

/// Columns that are left out if no point has them.
const PROVEN: usize = 9;
const IN_BOX: usize = 10;
const FRONTS: &str = "0 insn; 1 worst tick; 3 mean; 5 max error; 9 proven; 8 of full scale";
const SHARES: &str = "1 worst tick; 2 of default's; 3 mean; 4 of default's; 5 max, N·m; 9 proven, N·m; 10 in the box; 6 99 %; 7 RMS; 8 of full scale";
const PAGE: &str = "1 worst tick; 3 mean; 5 max, N·m; 9 proven, N·m";
const STEPS: &str = "1 cycles a second; 5 max, rad";
const ERRORS: &str = "5 max, N·m";

/// The fronts, for a terminal.
pub fn terminal(points: &[Point]) -> String {
    let on = of_robots(points, |point| point.front);
    table(&on, "robot, configuration", FRONTS).text()
}

/// Every way of one robot, for a terminal.
pub fn every(points: &[Point]) -> String {
    let all: Vec<&Point> = points.iter().collect();
    table(&named(&all), "configuration", SHARES).text()
}

/// The text about a robot's torques, or about simulations.
pub fn text(points: &[Point], host: &Host, robot: Robot, rustc: &str) -> String {
    let text = match robot {
        Robot::DoublePendulum => simulations(points),
        _ => torques(points, host, robot),
    };
    format!("{text}Measured with {rustc}.")
}

fn torques(points: &[Point], host: &Host, robot: Robot) -> String {
    let rigid = of_group(points, (robot.name(), Kind::Inverse, ""));
    let (title, part) = (robot.names()[1], page_of(robot).name);
    let mut text = format!(
        "![Front of error against cycles of inverse dynamics of the {title}]({part}.svg)\n\n{} configurations, of which {} \
         are on a front; {MODEL}.\n\n",
        rigid.len(),
        rigid.iter().filter(|point| point.front).count(),
    );
    for line in host.of(Kind::Oracle, robot.name()) {
        let [scale, precise] = [line.full_scale, line.from_50_digits].map(digits);
        let [off, anywhere] = [line.point.relative_max, host.anywhere(robot.name())].map(stated);
        text += &format!(
            "Full scale is {scale} N·m. The reference in f64 is off by at most {off} of it from Pinocchio {}, {precise} from \
             50 digits; over all states anywhere the default is within {anywhere}.\n\n",
            line.pinocchio
        );
    }
    if let Some([worst, mean]) = cheapest(&rigid) {
        let [(worst, tick), (mean, ticks)] =
            [worst, mean].map(|(point, share)| (name(point), percent(share)));
        let error = digits(ERROR);
        text += &format!(
            "Within {error} of full scale, the cheapest worst tick is {tick} of the default's (*{worst}*) and the \
             cheapest mean {ticks} (*{mean}*).\n\n"
        );
    }
    // The steps of both fronts, and what the picture names beside them.
    let mut shown: Vec<&Point> = [0, 1].into_iter().flat_map(|cost| steps(&rigid, cost)).collect();
    shown.extend(rigid.iter().filter(|point| is_single(point, BRIEF_ROWS)));
    shown.sort_by(|a, b| a.cycles.cmp(&b.cycles).then(a.key.cmp(&b.key)));
    shown.dedup_by_key(|point| &point.key);
    text += &format!("{}\n", table(&named(&shown), "configuration", PAGE).markdown());
    let others = host.of(Kind::Yardstick, robot.name());
    let others: Vec<_> = others.map(|line| (line.what.clone(), &line.point)).collect();
    text + &section("Where accuracy stops mattering", &others, "what is off", ERRORS)
}

fn section(head: &str, rows: &[(String, &Point)], first: &str, columns: &str) -> String {
    format!("### {head}\n\n{}\n", table(rows, first, columns).markdown())
}

/// The cheapest within [`ERROR`], by the worst tick and by the mean, each with its share of the
/// default's cost.
fn cheapest<'a>(points: &[&'a Point]) -> Option<[(&'a Point, f64); 2]> {
    let default = points.iter().find(|point| point.is_default())?;
    let of = |cost: usize| {
        let within = |point: &&Point| point.relative_max.is_some_and(|share| share <= ERROR);
        let point = front::front(points, cost).into_iter().find(within)?;
        Some((point, point.costs()[cost] / default.costs()[cost]))
    };
    Some([of(0)?, of(1)?])
}

/// Robots and scenes in the order of the page and of its picture.
pub const SCENES: [(Robot, &str, &str); 4] = [
    (Robot::DoublePendulum, "free", "A double pendulum, let go"),
    (
        Robot::DoublePendulum,
        "damped",
        "A double pendulum with viscous friction, stiff at one joint",
    ),
    (Robot::Ur5e, "free", "The UR5e, let go"),
    (Robot::Ur5e, "damped", "The UR5e with viscous friction"),
];

fn simulations(points: &[Point]) -> String {
    let mut text = format!(
        "![Errors against cycles of integrators over their lengths of step](accuracy-simulation.svg)\n\n\
         Cycles are those of a simulated second; errors are over its first second. f64 and the energy's \
         drift are in the record alone. {MODEL}.\n\n"
    );
    for (robot, scene, title) in SCENES {
        let mut own = of_group(points, (robot.name(), Kind::Simulation, scene));
        own.retain(|point| point.on("arith") == "f32");
        let steps = steps(&own, 0);
        text += &section(title, &named(&steps), "configuration", STEPS);
    }
    text
}
