//! How the engine stands against the best peer, and what it was meant to reach.

use std::fmt;

use crate::peers::report::{HOST, M4F, Row};

/// A figure and its limit.
pub struct Bar {
    /// What is measured.
    pub what: String,
    /// The figure.
    pub measured: f64,
    /// What it may be at most.
    pub limit: f64,
    /// `×` for a ratio, else what is counted.
    pub unit: &'static str,
}

impl fmt::Display for Bar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            what,
            measured,
            limit,
            unit,
        } = self;
        let verdict = if measured <= limit { "met" } else { "missed" };
        let digits = if *unit == "×" { 2 } else { 0 };
        write!(
            f,
            "{what}: {measured:.digits$} {unit}, at most {limit:.digits$}: {verdict}"
        )
    }
}

/// The bars that this run has the figures for.
pub fn of(rows: &[Row]) -> Vec<Bar> {
    let mut bars = Vec::new();
    for robot in ["ur5e", "panda", "iiwa14", "a1"] {
        on_target(rows, robot, &mut bars);
    }
    if let Some(core) = find(rows, M4F, "ur5e", "f32", "core") {
        let what = "ur5e rnea, core".to_owned();
        bars.extend(bar(
            what.clone(),
            core.cycles.map(|n| n as f64),
            2300.0,
            "cycles",
        ));
        bars.extend(bar(
            what,
            core.code_bytes.map(|n| n as f64),
            2300.0,
            "bytes",
        ));
    }
    for robot in ["ur5e", "panda"] {
        for precision in ["f32", "f64"] {
            let time = |peer: &str| best_ns(rows, robot, precision, peer);
            for (peer, limit) in [("casadi", 0.8), ("pinocchio", 0.15)] {
                let ratio = time("engine")
                    .zip(time(peer))
                    .map(|(engine, peer)| engine / peer);
                let what = format!("{robot} rnea, host {precision}, engine / best {peer}");
                bars.extend(bar(what, ratio, limit, "×"));
            }
        }
    }
    bars
}

/// Against the build with fewer cycles of those by gcc.
fn on_target(rows: &[Row], robot: &str, bars: &mut Vec<Bar>) {
    let builds = ["casadi gcc", "casadi gcc -ffp-contract=off"];
    let best = builds
        .iter()
        .filter_map(|build| find(rows, M4F, robot, "f32", build))
        .min_by_key(|row| row.cycles);
    let Some((engine, best)) = find(rows, M4F, robot, "f32", "engine").zip(best) else {
        return;
    };
    let ratio = |a: Option<u64>, b: Option<u64>| a.zip(b).map(|(a, b)| a as f64 / b as f64);
    let what = |figure| format!("{robot} rnea, engine / {}, {figure}", best.peer);
    bars.extend(bar(
        what("cycles"),
        ratio(engine.cycles, best.cycles),
        0.47,
        "×",
    ));
    bars.extend(bar(
        what("code"),
        ratio(engine.code_bytes, best.code_bytes),
        0.6,
        "×",
    ));
}

fn bar(what: String, measured: Option<f64>, limit: f64, unit: &'static str) -> Option<Bar> {
    measured.map(|measured| Bar {
        what,
        measured,
        limit,
        unit,
    })
}

/// A row of full inverse dynamics.
fn find<'a>(
    rows: &'a [Row],
    target: &str,
    robot: &str,
    precision: &str,
    peer: &str,
) -> Option<&'a Row> {
    rows.iter().find(|row| {
        (row.target, &*row.algorithm) == (target, "rnea")
            && (&*row.robot, &*row.precision, &*row.peer) == (robot, precision, peer)
    })
}

/// The shortest time on the host of the peers whose names begin so.
fn best_ns(rows: &[Row], robot: &str, precision: &str, peer: &str) -> Option<f64> {
    rows.iter()
        .filter(|row| (row.target, &*row.algorithm) == (HOST, "rnea"))
        .filter(|row| (&*row.robot, &*row.precision) == (robot, precision))
        .filter(|row| row.peer.starts_with(peer))
        .filter_map(|row| row.ns)
        .min_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::{HOST, M4F, Row, of};

    #[test]
    fn the_engine_is_held_against_the_best_build() {
        let row = |target, peer: &str, cycles, ns| Row {
            target,
            robot: "ur5e".into(),
            algorithm: "rnea".into(),
            peer: peer.into(),
            precision: "f32".into(),
            cycles,
            code_bytes: cycles,
            ns,
            ..Row::default()
        };
        let rows = [
            row(M4F, "casadi gcc", Some(1400), None),
            row(M4F, "casadi gcc -ffp-contract=off", Some(1000), None),
            row(M4F, "casadi clang", Some(10), None),
            row(M4F, "engine", Some(500), None),
            row(HOST, "casadi gcc", None, Some(50.0)),
            row(HOST, "casadi clang", None, Some(40.0)),
            row(HOST, "engine", None, Some(20.0)),
        ];
        let measured: Vec<f64> = of(&rows).iter().map(|bar| bar.measured).collect();
        assert_eq!(measured, [0.5, 0.5, 0.5]);
    }
}
