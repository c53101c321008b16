//! What single changes to the default cost and lose: few enough to be measured anew in every run of the tests.

use super::page::{COMMAND, FILE};
use super::point::{Kind, Point};
use super::words::{cycles, digits, name};
use crate::docs::Page;
use crate::table::{Table, thousands};

/// The part of the page that CI holds against a quick run.
pub const PAGE: Page = Page {
    file: FILE,
    name: "accuracy-single",
    command: COMMAND,
};

/// The few of them that the README shows.
pub const README: Page = Page {
    file: "README.md",
    name: "accuracy",
    command: COMMAND,
};

/// Those, of the UR5e.
const BRIEF: [&str; 6] = [
    "default",
    "trig=table",
    "model=pruned1000",
    "rate=10,between=linearised",
    "model=no_coriolis",
    "model=gravity",
];

/// What the bin `accuracy_quick` runs.
pub const KEYS: [&str; 14] = [
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

/// The README's text.
pub fn brief(points: &[Point], rustc: &str) -> String {
    let columns = [
        "UR5e",
        "worst tick, cycles",
        "mean",
        "off by up to, N·m",
        "of full scale",
    ];
    let mut table = Table::new(&columns);
    let few = |point: &&Point| {
        let (robot, kind, plant) = point.group();
        (robot, kind, plant) == ("ur5e", Kind::Inverse, "rigid") && BRIEF.contains(&&*point.key)
    };
    let mut shown: Vec<&Point> = points.iter().filter(few).collect();
    shown.sort_by(|a, b| a.error().total_cmp(&b.error()));
    for point in shown {
        let share = point.relative_max.map_or_else(|| "–".into(), digits);
        table.row([
            name(point),
            thousands(point.cycles),
            cycles(point.cycles_mean),
            digits(point.error()),
            share,
        ]);
    }
    format!("{}\nMeasured with {rustc}.", table.markdown())
}

/// The text between the markers.
pub fn text(points: &[Point], rustc: &str) -> String {
    let mut table = Table::new(&[
        "robot, what is changed",
        "insn",
        "worst tick",
        "mean",
        "max, N·m",
        "99 %",
        "RMS",
        "of full scale",
    ]);
    let single = |point: &&Point| {
        point.kind == Kind::Inverse && point.on("plant") == "rigid" && KEYS.contains(&&*point.key)
    };
    for point in points.iter().filter(single) {
        let errors = [
            point.error_max,
            point.error_p99,
            point.error_rms,
            point.relative_max,
        ];
        let figures = [
            format!("{} {}", point.robot, name(point)),
            thousands(point.instructions),
            thousands(point.cycles),
            cycles(point.cycles_mean),
        ];
        let errors = errors.map(|error| error.map_or_else(|| "–".into(), digits));
        table.row(figures.into_iter().chain(errors));
    }
    format!("{}\nMeasured with {rustc}.", table.markdown())
}
