//! docs/accuracy.md: the simulations.

use super::measure::Robot;
use super::page::steps;
use super::point::{Kind, Point};
use super::words::{cycles, digits, name, sentence};
use crate::report::MODEL;
use crate::table::{Table, thousands};

/// Robots and scenes in the order of the page.
const PARTS: [(Robot, &str, &str); 4] = [
    (Robot::DoublePendulum, "free", "A double pendulum, let go"),
    (
        Robot::DoublePendulum,
        "damped",
        "A double pendulum with viscous friction, stiff at one joint",
    ),
    (Robot::Ur5e, "free", "The UR5e, let go"),
    (Robot::Ur5e, "damped", "The UR5e with viscous friction"),
];

/// The text about simulations.
pub fn text(points: &[Point], rustc: &str) -> String {
    let mut text = format!(
        "![Errors against cycles of integrators over their lengths of step](accuracy-simulation.svg)\n\n\
         Cycles are those of as many steps as make a simulated second; trajectory errors are over its first second, \
         energy drift over five, a second, as a share of the largest kinetic energy. {MODEL}.\n\n"
    );
    for (robot, scene, title) in PARTS {
        let points: Vec<&Point> = points
            .iter()
            .filter(|point| point.group() == (robot.name(), Kind::Simulation, scene))
            .collect();
        text += &format!(
            "### {title}\n\n{}{}\n",
            short_steps(&points),
            table(&points).markdown()
        );
        for point in steps(&points, 0) {
            text += &format!("- **{}.** {}\n", name(point), sentence(point));
        }
        text.push('\n');
    }
    text += &format!("Measured with {}.\n", rustc);
    text
}

fn table(points: &[&Point]) -> Table {
    let mut table = Table::new(&[
        "configuration",
        "cycles a second",
        "a step",
        "max, rad",
        "99 %",
        "RMS",
        "energy drift",
    ]);
    for point in steps(points, 0) {
        let error = |x: Option<f64>| x.map_or_else(|| "–".into(), digits);
        let steps = 1e6 / point.on("step").parse::<f64>().unwrap_or(1e6);
        table.row([
            name(point),
            thousands(point.cycles),
            cycles(point.cycles as f64 / steps),
            error(point.error_max),
            error(point.error_p99),
            error(point.error_rms),
            error(point.drift),
        ]);
    }
    table
}

/// Where shorter steps make RK4 in f32 worse, and what compensated sums repair.
fn short_steps(points: &[&Point]) -> String {
    let line = |state: &str| -> Vec<(u64, f64)> {
        let of = |point: &&&Point| {
            [point.on("integrator"), point.on("arith"), point.on("state")] == ["rk4", "f32", state]
        };
        let found = points.iter().filter(of);
        found
            .filter_map(|point| Some((point.on("step").parse().ok()?, point.error_max?)))
            .collect()
    };
    let (plain, summed) = (line("plain"), line("compensated"));
    let best = plain.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let shortest = |line: &[(u64, f64)]| line.iter().min_by_key(|(step, _)| *step).copied();
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
