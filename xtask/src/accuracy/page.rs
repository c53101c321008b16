//! docs/accuracy.md: fronts in words, what single choices cost, yardsticks.

use super::asides::{compliant, every, joints, oracle, speeds, yardsticks};
use super::bars;
use super::front;
use super::join::Host;
use super::measure::Robot;
use super::picture::{Scene, svg};
use super::point::{Kind, Point};
use super::words::{cycles, digits, glossary, name};
use crate::docs::Page;
use crate::error::Result;
use crate::report::MODEL;
use crate::table::{Table, thousands};

pub const FILE: &str = "docs/accuracy.md";
pub const COMMAND: &str = "cargo xtask accuracy";

/// A step of a front is at least so much more accurate than the one before it: others are there, but not worth a word.
const STEP: f64 = 0.8;

/// The part of the page about a robot's torques.
pub fn page_of(robot: Robot) -> Page {
    let name = match robot {
        Robot::Ur5e => "accuracy-ur5e",
        Robot::Panda => "accuracy-panda",
        Robot::A1Leg => "accuracy-a1_leg",
        Robot::DoublePendulum => "accuracy-simulation",
    };
    Page {
        file: FILE,
        name,
        command: COMMAND,
    }
}

/// The points of a front, from the cheapest on, each much more accurate than the one before; the default in any case.
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

/// A robot's ways, of rigid joints or of those that give way.
pub fn ways<'a>(points: &'a [Point], robot: Robot, plant: &str) -> Vec<&'a Point> {
    let of = |point: &&Point| {
        point.kind == Kind::Inverse && point.robot == robot.name() && point.on("plant") == plant
    };
    points.iter().filter(of).collect()
}

/// The file of the picture of a robot's torques, or of the simulations.
pub fn picture(robot: Robot) -> String {
    format!("docs/{}.svg", page_of(robot).name)
}

/// The picture of a robot's torques.
pub fn drawn(points: &[Point], host: &Host, robot: Robot) -> Result<String> {
    let all = host.yardsticks.iter();
    svg(&Scene {
        title: robot.title(),
        points: ways(points, robot, "rigid"),
        yardsticks: all.filter(|it| it.robot == robot.name()).collect(),
    })
}

/// The text about a robot's torques.
pub fn text(points: &[Point], host: &Host, robot: Robot, rustc: &str) -> String {
    let rigid = ways(points, robot, "rigid");
    let mut text = format!(
        "![Error against cycles of every way to compute torques of the {}](accuracy-{}.svg)\n\n\
         {} configurations, of which {} are on the front; full scale is {} N·m. {MODEL}.\n\n",
        robot.title(),
        robot.name(),
        rigid.len(),
        rigid.iter().filter(|point| point.front).count(),
        digits(rigid.first().map_or(0.0, |point| point.full_scale)),
    );
    text += &oracle(host, robot);
    text += &on_default(&rigid);
    text += &bars::told(&rigid);
    let heads = [
        "### The worst tick: what each step costs and gives up",
        "### The mean over ticks: what each step costs and gives up",
    ];
    for (cost, head) in heads.into_iter().enumerate() {
        let shown = shown(&rigid, cost);
        text += &format!("{head}\n\n{}\n", steps_table(&rigid, &shown).markdown());
        text += &format!("{}\n", glossary(&shown));
    }
    text += &every(&rigid);
    text += &joints(&rigid);
    text += &speeds(host, robot);
    text += &compliant(&ways(points, robot, "compliant"));
    let own = host.yardsticks.iter();
    let own: Vec<_> = own.filter(|it| it.robot == robot.name()).collect();
    text += &format!(
        "### Where accuracy stops mattering\n\n{}",
        yardsticks(&own).markdown()
    );
    text += &format!("\nMeasured with {}.\n", rustc);
    text
}

/// The steps of a front; by the mean, those that are not on the other front already.
pub fn shown<'a>(points: &[&'a Point], cost: usize) -> Vec<&'a Point> {
    let mut shown = steps(points, cost);
    shown.retain(|point| cost == 0 || !point.fronts[0] || point.is_default());
    // The default is told even where a front passes it by.
    if !shown.iter().any(|point| point.is_default()) {
        shown.extend(points.iter().filter(|point| point.is_default()));
        shown.sort_by(|a, b| a.costs()[cost].total_cmp(&b.costs()[cost]));
    }
    shown
}

/// Where the default stands.
fn on_default(rigid: &[&Point]) -> String {
    let Some(default) = rigid.iter().find(|point| point.is_default()) else {
        return String::new();
    };
    let anywhere = default.anywhere.map_or_else(String::new, |share| {
        format!(
            "; over all states anywhere it is within {} of full scale",
            digits(share)
        )
    });
    let mut text = format!(
        "The default takes {} cycles and is off by up to {} N·m along the robot's way{anywhere}. ",
        thousands(default.cycles),
        digits(default.error())
    );
    let better = rigid
        .iter()
        .filter(|p| p.cycles < default.cycles && p.error() <= 1.05 * default.error());
    text += &match better.min_by_key(|point| point.cycles) {
        Some(better) => format!(
            "As accurate (to 5 %) for less is *{}*, {} cycles, on a memory without wait states, as modelled here.\n\n",
            name(better),
            thousands(better.cycles)
        ),
        None => "Nothing as accurate costs less.\n\n".into(),
    };
    text
}

fn share(part: f64, whole: f64) -> String {
    let ratio = part / whole;
    if ratio < 9.95 {
        format!("{:.0} %", 100.0 * ratio)
    } else {
        format!("{ratio:.0} ×")
    }
}

/// Of each step the cost, its share of the default's, and errors.
fn steps_table(points: &[&Point], shown: &[&Point]) -> Table {
    let mut table = Table::new(&[
        "configuration",
        "worst tick",
        "of default's",
        "mean",
        "of default's",
        "max, N·m",
        "99 %",
        "RMS",
        "of full scale",
    ]);
    let default = points.iter().find(|point| point.is_default());
    let of_default = |of: usize, point: &Point| {
        default.map_or_else(
            || "–".into(),
            |default| share(point.costs()[of], default.costs()[of]),
        )
    };
    for point in shown {
        let error = |x: Option<f64>| x.map_or_else(|| "–".into(), digits);
        table.row([
            name(point),
            thousands(point.cycles),
            of_default(0, point),
            cycles(point.cycles_mean),
            of_default(1, point),
            error(point.error_max),
            error(point.error_p99),
            error(point.error_rms),
            error(point.relative_max),
        ]);
    }
    table
}
