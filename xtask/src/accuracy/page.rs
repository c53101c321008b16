//! docs/accuracy.md: fronts, what single choices cost, yardsticks, simulations; and the README's few lines.

use super::front;
use super::join::{Host, Line};
use super::measure::Robot;
use super::plot;
use super::point::{Kind, Point, of_group};
use super::words::{cycles, digits, glossary, name, stated};
use crate::docs::Page;
use crate::error::{Error, Result};
use crate::report::MODEL;
use crate::table::{Table, thousands};

pub const FILE: &str = "docs/accuracy.md";
pub const COMMAND: &str = "cargo xtask accuracy";

/// A part of a page that the command writes.
const fn part(file: &'static str, name: &'static str) -> Page {
    Page {
        file,
        name,
        command: COMMAND,
    }
}

/// Single changes, which CI compares with a quick run.
pub const SINGLES: Page = part(FILE, "accuracy-single");
/// The few of them that the README shows.
pub const README: Page = part("README.md", "accuracy");

/// What the bins `accuracy_quick` run.
pub const SINGLE: [&str; 14] = [
    "default",
    "trig=minimax5",
    "trig=minimax3",
    "trig=minimax7",
    "trig=table",
    "trig=incremental",
    "model=no_coriolis",
    "model=gravity",
    "model=params8",
    "model=pruned1000",
    "rate=10",
    "rate=10,between=interpolated",
    "rate=10,between=linearised",
    "form=core",
];

/// The README's.
const BRIEF: [&str; 6] = [
    "default",
    "trig=table",
    "model=pruned1000",
    "rate=10,between=linearised",
    "model=no_coriolis",
    "model=gravity",
];

/// A step of a front is at least so much more accurate than the one before it: others are there, but not worth a word.
const STEP: f64 = 0.8;

/// The error that hardly matters, as a share of full scale, and what a point of the front may cost of the default at it:
/// its worst tick, its mean.
const ERROR: f64 = 1e-3;
const MOST: [f64; 2] = [0.85, 0.6];

/// The part of the page about a robot's torques, or about the simulations.
pub fn page_of(robot: Robot) -> Page {
    part(
        FILE,
        match robot {
            Robot::Ur5e => "accuracy-ur5e",
            Robot::Panda => "accuracy-panda",
            Robot::A1Leg => "accuracy-a1_leg",
            Robot::DoublePendulum => "accuracy-simulation",
        },
    )
}

/// The pictures of that part: file and SVG.
pub fn pictures(points: &[Point], host: &Host, robot: Robot) -> Result<Vec<(String, String)>> {
    let file = format!("docs/{}", page_of(robot).name);
    if robot == Robot::DoublePendulum {
        return Ok(vec![(format!("{file}.svg"), plot::simulations(points)?)]);
    }
    let own = of_group(points, (robot.name(), Kind::Inverse, "rigid"));
    let lines = yardsticks(host, robot);
    Ok(vec![
        (
            format!("{file}.svg"),
            plot::front(robot.title(), &own, &lines)?,
        ),
        (format!("{file}-all.svg"), plot::all(robot.title(), &own)?),
    ])
}

fn yardsticks(host: &Host, robot: Robot) -> Vec<&Line> {
    host.yardsticks
        .iter()
        .filter(|line| line.robot == robot.name())
        .collect()
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

/// A column: its head, and a point's cell, which the default may be needed for.
type Column = (&'static str, fn(&Point, Option<&Point>) -> String);
const NAME: Column = ("configuration", |point, _| name(point));
const OF_ROBOT: Column = ("robot, what is changed", |point, _| {
    format!("{} {}", point.robot, name(point))
});
const INSN: Column = ("insn", |point, _| thousands(point.instructions));
const WORST: Column = ("worst tick", |point, _| thousands(point.cycles));
const MEAN: Column = ("mean", |point, _| cycles(point.cycles_mean));
const MAX: Column = ("max, N·m", |point, _| stated(point.errors.error_max));
const P99: Column = ("99 %", |point, _| stated(point.errors.error_p99));
const RMS: Column = ("RMS", |point, _| stated(point.errors.error_rms));
const SHARE: Column = ("of full scale", |point, _| {
    stated(point.errors.relative_max)
});
const WORST_SHARE: Column = ("of default's", |point, default| share(point, default, 0));
const MEAN_SHARE: Column = ("of default's", |point, default| share(point, default, 1));
const FRONT: Column = ("front", |point, _| {
    match point.fronts {
        [true, true] => "both",
        [true, false] => "worst tick",
        [false, true] => "mean",
        _ => "none",
    }
    .into()
});
const SECOND: Column = ("cycles a second", |point, _| thousands(point.cycles));
const A_STEP: Column = ("a step", |point, _| {
    let steps = 1e6 / point.on("step").parse::<f64>().unwrap_or(1e6);
    cycles(point.cycles as f64 / steps)
});
const ANGLE: Column = ("max, rad", |point, _| stated(point.errors.error_max));
const DRIFT: Column = ("energy drift", |point, _| stated(point.drift));

fn share(point: &Point, default: Option<&Point>, cost: usize) -> String {
    default.map_or_else(
        || "–".into(),
        |default| percent(point.costs()[cost] / default.costs()[cost]),
    )
}

fn percent(ratio: f64) -> String {
    if ratio < 9.95 {
        format!("{:.0} %", 100.0 * ratio)
    } else {
        format!("{ratio:.0} ×")
    }
}

/// These points, a row each.
pub fn table(points: &[&Point], columns: &[Column]) -> Table {
    let default = points.iter().copied().find(|point| point.is_default());
    let heads: Vec<&str> = columns.iter().map(|column| column.0).collect();
    let mut table = Table::new(&heads);
    for point in points {
        table.row(columns.iter().map(|column| column.1(point, default)));
    }
    table
}

/// The fronts, for a terminal.
pub fn terminal(points: &[Point]) -> String {
    let on: Vec<&Point> = points.iter().filter(|point| point.front).collect();
    table(
        &on,
        &[OF_ROBOT, INSN, WORST, MEAN, ("max error", MAX.1), SHARE],
    )
    .text()
}

/// Single changes to the default.
pub fn singles(points: &[Point], rustc: &str) -> String {
    let few: Vec<&Point> = points
        .iter()
        .filter(|point| SINGLE.contains(&&*point.key))
        .collect();
    let table = table(&few, &[OF_ROBOT, INSN, WORST, MEAN, MAX, P99, RMS, SHARE]);
    format!("{}\nMeasured with {rustc}.", table.markdown())
}

/// The README's.
pub fn brief(points: &[Point], rustc: &str) -> String {
    let mut few = of_group(points, ("ur5e", Kind::Inverse, "rigid"));
    few.retain(|point| BRIEF.contains(&&*point.key));
    few.sort_by(|a, b| a.error().total_cmp(&b.error()));
    let columns = [
        ("UR5e", NAME.1),
        ("worst tick, cycles", WORST.1),
        MEAN,
        ("largest error, N·m", MAX.1),
        SHARE,
    ];
    format!(
        "{}\nMeasured with {rustc}.",
        table(&few, &columns).markdown()
    )
}

/// The text about a robot's torques, or about simulations.
pub fn text(points: &[Point], host: &Host, robot: Robot, rustc: &str) -> String {
    let text = match robot {
        Robot::DoublePendulum => simulations(points),
        _ => torques(points, host, robot),
    };
    format!("{text}Measured with {rustc}.\n")
}

fn torques(points: &[Point], host: &Host, robot: Robot) -> String {
    let rigid = of_group(points, (robot.name(), Kind::Inverse, "rigid"));
    let (title, part) = (robot.title(), page_of(robot).name);
    let oracle = host.oracles.iter().find(|line| line.robot == robot.name());
    let mut text = format!(
        "![Front of error against cycles of inverse dynamics of the {title}]({part}.svg)\n\n{} configurations, of which {} \
         are on a front ([picture of all]({part}-all.svg)); {MODEL}.\n\n",
        rigid.len(),
        rigid.iter().filter(|point| point.front).count(),
    );
    text += &oracle.map_or_else(String::new, |line| {
        format!(
            "Full scale is {} N·m. The f64 that errors are measured from is off by at most {} of it from Pinocchio {} on \
             {} states, and by at most {} from 50 digits on {}.\n\n",
            digits(line.full_scale),
            stated(line.errors.relative_max),
            line.pinocchio,
            line.states,
            digits(line.from_50_digits),
            line.sample
        )
    });
    text += &on_default(&rigid, host.anywhere(robot.name()));
    if let Some([(worst, worst_share), (mean, mean_share)]) = cheapest(&rigid) {
        text += &format!(
            "Within {} of full scale, the cheapest worst tick is {} of the default's (*{}*) and the cheapest mean {} \
             (*{}*).\n\n",
            digits(ERROR),
            percent(worst_share),
            name(worst),
            percent(mean_share),
            name(mean)
        );
    }
    let shown = shown(&rigid);
    let columns = [
        NAME,
        FRONT,
        WORST,
        WORST_SHARE,
        MEAN,
        MEAN_SHARE,
        MAX,
        P99,
        RMS,
        SHARE,
    ];
    text += &format!(
        "### The fronts: what each step costs and gives up\n\n{}\n{}\n",
        table(&shown, &columns).markdown(),
        glossary(&shown)
    );
    let mut speeds = Table::new(&["joints as fast as, rad/s", "max, N·m", "of full scale"]);
    for line in host.speeds.iter().filter(|line| line.robot == robot.name()) {
        let Line { errors, speed, .. } = line;
        speeds.row([
            digits(*speed),
            stated(errors.error_max),
            stated(errors.relative_max),
        ]);
    }
    text += &format!(
        "### Without Coriolis: how slow is slow enough\n\n{}\n",
        speeds.markdown()
    );
    text += &compliant(&of_group(
        points,
        (robot.name(), Kind::Inverse, "compliant"),
    ));
    let mut off = Table::new(&["what is off", "max, N·m", "99 %", "RMS", "of full scale"]);
    for line in yardsticks(host, robot) {
        let e = line.errors;
        let errors = [e.error_max, e.error_p99, e.error_rms, e.relative_max].map(stated);
        off.row([line.what.clone()].into_iter().chain(errors));
    }
    text + &format!("### Where accuracy stops mattering\n\n{}\n", off.markdown())
}

/// The steps of both fronts and the default, the cheapest first.
fn shown<'a>(points: &[&'a Point]) -> Vec<&'a Point> {
    let mut shown = steps(points, 0);
    shown.extend(
        steps(points, 1)
            .into_iter()
            .filter(|point| !point.fronts[0]),
    );
    shown.extend(points.iter().filter(|point| point.is_default()));
    shown.sort_by(|a, b| (a.cycles, &a.key).cmp(&(b.cycles, &b.key)));
    shown.dedup_by_key(|point| &point.key);
    shown
}

/// Where the default stands.
fn on_default(rigid: &[&Point], anywhere: Option<f64>) -> String {
    let Some(default) = rigid.iter().find(|point| point.is_default()) else {
        return String::new();
    };
    let as_good = |p: &&&Point| p.cycles < default.cycles && p.error() <= 1.05 * default.error();
    let better = rigid
        .iter()
        .filter(as_good)
        .min_by_key(|point| point.cycles);
    let better = better.map_or_else(
        || "Nothing as accurate costs less.".into(),
        |better| {
            format!(
                "As accurate (to 5 %) for less is *{}*, {} cycles.",
                name(better),
                thousands(better.cycles)
            )
        },
    );
    format!(
        "The default takes {} cycles and is off by up to {} N·m along the robot's way; over all states anywhere it is \
         within {} of full scale. {better}\n\n",
        thousands(default.cycles),
        digits(default.error()),
        stated(anywhere)
    )
}

/// The cheapest within [`ERROR`], by the worst tick and by the mean, each with its share of the default's cost.
fn cheapest<'a>(points: &[&'a Point]) -> Option<[(&'a Point, f64); 2]> {
    let default = points.iter().find(|point| point.is_default())?;
    let of = |cost: usize| {
        let within = |point: &&Point| {
            point
                .errors
                .relative_max
                .is_some_and(|share| share <= ERROR)
        };
        let point = front::front(points, cost).into_iter().find(within)?;
        Some((point, point.costs()[cost] / default.costs()[cost]))
    };
    Some([of(0)?, of(1)?])
}

/// Fails unless an error that hardly matters saves as much as was promised; else says how much.
pub fn check_bars(points: &[&Point]) -> Result<String> {
    let cheapest = cheapest(points);
    let seen =
        cheapest.ok_or_else(|| Error::check("nothing on the front is within the bar's error"))?;
    let [worst, mean] = seen.map(|(_, share)| share);
    let saved = format!("{worst:.3} of the worst tick, {mean:.3} of the mean");
    if worst > MOST[0] || mean > MOST[1] {
        return Err(Error::check(format!(
            "bar: within {ERROR} of full scale, the cheapest takes {saved} of the default's; at most {MOST:?}"
        )));
    }
    Ok(saved)
}

/// The ways to the motors of joints that give way.
fn compliant(points: &[&Point]) -> String {
    let of = |model: &str| {
        let mut found = points.iter().filter(|point| point.on("opt") == "3");
        found.find(|point| point.on("model") == model)
    };
    let (Some(slow), Some(fast)) = (of("compliant"), of("rigid")) else {
        return String::new();
    };
    format!(
        "### Elastic joints\n\nOn joints as elastic as harmonic drives, along a smooth swing: taken for rigid, the motors' \
         torques cost {} cycles and are off by up to {} N·m; computed with their springs, {} cycles and {} N·m.\n\n",
        thousands(fast.cycles),
        digits(fast.error()),
        thousands(slow.cycles),
        digits(slow.error())
    )
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
         Cycles are those of as many steps as make a simulated second; trajectory errors are over its first second, \
         energy drift over five, a second, as a share of the largest kinetic energy. {MODEL}.\n\n"
    );
    let mut all = Vec::new();
    for (robot, scene, title) in SCENES {
        let points = of_group(points, (robot.name(), Kind::Simulation, scene));
        let steps = steps(&points, 0);
        let table = table(&steps, &[NAME, SECOND, A_STEP, ANGLE, P99, RMS, DRIFT]);
        text += &format!(
            "### {title}\n\n{}{}\n",
            short_steps(&points),
            table.markdown()
        );
        all.extend(steps);
    }
    text + &glossary(&all) + "\n"
}

/// Where shorter steps make RK4 in f32 worse, and what compensated sums repair.
fn short_steps(points: &[&Point]) -> String {
    let line = |state: &str| -> Vec<(u64, f64)> {
        let of = |point: &&&Point| {
            [point.on("integrator"), point.on("arith"), point.on("state")] == ["rk4", "f32", state]
        };
        let point =
            |point: &&Point| Some((point.on("step").parse().ok()?, point.errors.error_max?));
        points.iter().filter(of).filter_map(point).collect()
    };
    let (plain, summed) = (line("plain"), line("compensated"));
    let shortest = |line: &[(u64, f64)]| line.iter().min_by_key(|(step, _)| *step).copied();
    let best = plain.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let (Some(best), Some(short), Some(repaired)) = (best, shortest(&plain), shortest(&summed))
    else {
        return String::new();
    };
    if short.1 < 2.0 * best.1 {
        return String::new();
    }
    format!(
        "RK4 in f32 is best at steps of {} µs, off by {} rad; at {} µs it is off by {} rad, since every step rounds. \
         Compensated sums bring that to {} rad.\n\n",
        thousands(best.0),
        digits(best.1),
        short.0,
        digits(short.1),
        digits(repaired.1)
    )
}
