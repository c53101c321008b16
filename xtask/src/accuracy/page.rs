//! docs/accuracy.md: fronts in words, what single choices cost, yardsticks.

use super::bars;
use super::front;
use super::measure::{Measured, Robot};
use super::picture::yardstick;
use super::point::{Kind, Point, Yardstick};
use super::words::{cycles, digits, name, sentence};
use crate::docs::Page;
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

/// The text about a robot's torques.
pub fn text(measured: &Measured, robot: Robot) -> String {
    let rigid = ways(&measured.points, robot, "rigid");
    let mut text = format!(
        "![Error against cycles of every way to compute torques of the {}](accuracy-{}.svg)\n\n\
         {} configurations, of which {} are on the front; full scale is {} N·m. {MODEL}.\n\n",
        robot.title(),
        robot.name(),
        rigid.len(),
        rigid.iter().filter(|point| point.front).count(),
        digits(rigid.first().map_or(0.0, |point| point.full_scale)),
    );
    text += &on_default(&rigid);
    text += &bars::told(&rigid);
    let heads = [
        "### The worst tick: what each step costs and gives up",
        "### The mean over ticks: what each step costs and gives up",
    ];
    for (cost, head) in heads.into_iter().enumerate() {
        let shown = shown(&rigid, cost);
        text += &format!("{head}\n\n{}\n", steps_table(&rigid, &shown).markdown());
        for point in shown {
            text += &format!("- **{}.** {}\n", name(point), sentence(point));
        }
        text.push('\n');
    }
    text += &joints(&rigid);
    text += &speeds(measured, robot);
    text += &compliant(&ways(&measured.points, robot, "compliant"));
    let own = measured.host.yardsticks.iter();
    let own: Vec<_> = own.filter(|it| it.robot == robot.name()).collect();
    text += &format!(
        "### Where accuracy stops mattering\n\n{}",
        yardsticks(&own).markdown()
    );
    text += &format!("\nMeasured with {}.\n", measured.rustc);
    text
}

/// The steps of a front; by the mean, those that are not on the other front already.
fn shown<'a>(points: &[&'a Point], cost: usize) -> Vec<&'a Point> {
    let mut shown = steps(points, cost);
    shown.retain(|point| cost == 0 || !point.fronts[0] || point.is_default());
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

/// Errors joint by joint, folded away.
fn joints(points: &[&Point]) -> String {
    let count = points.first().map_or(0, |point| point.joints.len());
    let heads: Vec<String> = (1..=count).map(|joint| format!("joint {joint}")).collect();
    let heads: Vec<&str> = ["configuration"]
        .into_iter()
        .chain(heads.iter().map(String::as_str))
        .collect();
    let mut table = Table::new(&heads);
    let mut shown = steps(points, 0);
    shown.extend(
        steps(points, 1)
            .into_iter()
            .filter(|point| !point.fronts[0]),
    );
    for point in shown {
        let each = point.joints.iter().map(|joint| {
            format!(
                "{} / {} / {}",
                digits(joint.max),
                digits(joint.p99),
                digits(joint.rms)
            )
        });
        table.row([name(point)].into_iter().chain(each));
    }
    format!(
        "<details><summary>Joint by joint: max / 99 % / RMS, N·m</summary>\n\n{}\n</details>\n\n",
        table.markdown()
    )
}

/// The ways to the motors of joints that give way.
fn compliant(points: &[&Point]) -> String {
    let slow = points
        .iter()
        .find(|point| point.on("model") == "compliant" && point.on("opt") == "3");
    let fast = points
        .iter()
        .find(|point| point.on("model") == "rigid" && point.on("opt") == "3");
    let (Some(slow), Some(fast)) = (slow, fast) else {
        return String::new();
    };
    format!(
        "### Joints that give way\n\nOn joints as springy as harmonic drives, along a smooth swing: taken for rigid, \
         the motors' torques cost {} cycles and are off by up to {} N·m; computed with their springs, {} cycles \
         and {} N·m.\n\n",
        thousands(fast.cycles),
        digits(fast.error()),
        thousands(slow.cycles),
        digits(slow.error())
    )
}

/// What leaving out velocity products loses at which speeds.
fn speeds(measured: &Measured, robot: Robot) -> String {
    let own = measured
        .host
        .speeds
        .iter()
        .filter(|it| it.robot == robot.name());
    let mut table = Table::new(&["joints as fast as, rad/s", "max, N·m", "of full scale"]);
    for it in own {
        table.row([
            digits(it.speed),
            digits(it.error_max),
            digits(it.relative_max),
        ]);
    }
    format!(
        "### Without Coriolis: how slow is slow enough\n\n{}\n",
        table.markdown()
    )
}

fn yardsticks(own: &[&Yardstick]) -> Table {
    let mut table = Table::new(&["what is off", "max, N·m", "99 %", "RMS", "of full scale"]);
    for line in own {
        let what = match &*line.what {
            "" => yardstick(line).to_owned(),
            what => what.to_owned(),
        };
        let errors = [
            line.error_max,
            line.error_p99,
            line.error_rms,
            line.relative_max,
        ];
        table.row([what].into_iter().chain(errors.map(digits)));
    }
    table
}
