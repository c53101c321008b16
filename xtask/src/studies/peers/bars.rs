//! Engine and core against the best peer, and the bars for that.

use crate::kit::bars::{Bars, Compared};
use crate::kit::error::{Result, check};
use crate::studies::peers::PRECISIONS;
use crate::studies::peers::gates::INSIDE;
use crate::studies::peers::report::{GATES, HOST, M4F, OURS, Row};

/// CasADi's C by gcc on the target: the one with fewer cycles is the peer.
const BUILDS: [&str; 2] = ["casadi gcc", "casadi gcc -ffp-contract=off"];

/// Others, on the host, by how their names begin.
const OTHERS: [&str; 2] = ["casadi", "pinocchio"];

/// Ours and others on the gates, each with fused arithmetic, and the ends of their names.
const ON_GATES: [([&str; 2], &str); 3] = [
    (["engine", "casadi"], ""),
    (["engine", "RobotDynamics"], INSIDE),
    (["core", "RobotDynamics"], INSIDE),
];

/// What was hoped for, in `lab/peers/bars.toml`.
pub fn read() -> Result<Bars> {
    let text = include_str!("../../../../lab/peers/bars.toml");
    toml_edit::de::from_str(text).map_err(|error| check!("lab/peers/bars.toml: {error}"))
}

/// The bars that this run has the figures for.
pub fn compared(ratios: &Bars, rows: &[Row]) -> Vec<Compared> {
    let mut all = Vec::new();
    for row in rows.iter().filter(|row| row.target == M4F && row.peer == "core") {
        let key = format!("{} {}, m4f, core", row.robot, row.algorithm);
        let cycles = row.cycles.map(|cycles| cycles as f64);
        all.extend(cycles.and_then(|cycles| Compared::of(ratios, &key, "cycles", cycles)));
    }
    for (robot, algorithm) in pairs(rows, M4F) {
        let key = format!("{robot} {algorithm}, m4f, engine / casadi");
        let of = |peer: &str| {
            rows.iter().find(|row| is_of(row, M4F, robot, algorithm, "f32") && row.peer == peer)
        };
        let best = BUILDS.iter().filter_map(|build| of(build)).min_by_key(|row| row.cycles);
        let Some((engine, best)) = of("engine").zip(best) else {
            continue;
        };
        for (figure, ours, theirs) in [
            ("cycles", engine.cycles, best.cycles),
            ("code_bytes", engine.code_bytes, best.code_bytes),
        ] {
            let pair = ours.zip(theirs);
            all.extend(
                pair.and_then(|(a, b)| Compared::of(ratios, &key, figure, a as f64 / b as f64)),
            );
        }
    }
    for (robot, algorithm) in pairs(rows, GATES[0]) {
        for ([ours, theirs], inside) in ON_GATES {
            let key = format!("{robot} {algorithm}, gates, {ours} / {theirs}");
            for (stages, target) in GATES.iter().enumerate() {
                let cycles = |peer: &str, arithmetic| {
                    let peer = format!("{peer}{arithmetic}{inside}");
                    let is_its = |row: &&Row| {
                        is_of(row, target, robot, algorithm, "f32") && row.peer == peer
                    };
                    rows.iter().find(is_its).and_then(|row| row.cycles)
                };
                let theirs = cycles(theirs, " fused").or(cycles(theirs, ""));
                let ratio = cycles(ours, " fused").zip(theirs).map(|(a, b)| a as f64 / b as f64);
                let figure = format!("stages_{stages}");
                all.extend(ratio.and_then(|ratio| Compared::of(ratios, &key, &figure, ratio)));
            }
        }
    }
    for (robot, algorithm) in pairs(rows, HOST) {
        for precision in PRECISIONS {
            for (number, ours) in OURS.iter().enumerate() {
                for other in OTHERS {
                    let key = format!("{robot} {algorithm}, host {precision}, {ours} / {other}");
                    let best = rows
                        .iter()
                        .filter(|row| is_of(row, HOST, robot, algorithm, precision))
                        .filter(|row| row.peer.starts_with(other))
                        .filter_map(|row| row.ratios[number])
                        .max_by(f64::total_cmp);
                    all.extend(best.and_then(|ratio| Compared::of(ratios, &key, "ns", ratio)));
                }
            }
        }
    }
    all
}

/// The robots and algorithms of a target, each once.
fn pairs<'a>(rows: &'a [Row], target: &str) -> Vec<(&'a str, &'a str)> {
    let mut pairs = Vec::new();
    for row in rows.iter().filter(|row| row.target == target) {
        let pair = (&*row.robot, &*row.algorithm);
        if !pairs.contains(&pair) {
            pairs.push(pair);
        }
    }
    pairs
}

fn is_of(row: &Row, target: &str, robot: &str, algorithm: &str, precision: &str) -> bool {
    (row.target, &*row.robot, &*row.algorithm, &*row.precision)
        == (target, robot, algorithm, precision)
}

#[cfg(test)]
mod tests {
    use super::{GATES, HOST, M4F, Row, compared};
    use crate::kit::bars::{Bar, Bars};

    #[test]
    fn engine_and_core_are_checked_against_their_bars() {
        let row = |target, peer: &str, cycles, engine| Row {
            target,
            robot: "ur5e".into(),
            algorithm: "rnea".into(),
            peer: peer.into(),
            precision: "f32".into(),
            cycles,
            code_bytes: cycles,
            ratios: [engine, None, Some(0.125)],
            ..Row::default()
        };
        let rows = [
            row(M4F, "casadi gcc", Some(1400), None),
            row(M4F, "casadi gcc -ffp-contract=off", Some(1000), None),
            row(M4F, "casadi clang", Some(10), None),
            row(M4F, "engine", Some(500), None),
            row(M4F, "core", Some(901), None),
            row(GATES[0], "engine fused", Some(400), None),
            row(GATES[0], "casadi fused", Some(1000), None),
            row(GATES[0], "casadi separate", Some(10), None),
            row(GATES[1], "engine fused", Some(451), None),
            row(GATES[1], "casadi fused", Some(1000), None),
            row(GATES[0], "core fused, sines inside", Some(700), None),
            row(GATES[0], "RobotDynamics, sines inside", Some(1000), None),
            row(HOST, "casadi gcc", None, Some(0.4)),
            row(HOST, "casadi clang", None, Some(0.5)),
            row(HOST, "engine", None, Some(1.0)),
        ];
        let ratios = Bars::from([
            ("ur5e rnea, m4f, core".into(), Bar::of([("cycles", 900.0)])),
            (
                "ur5e rnea, m4f, engine / casadi".into(),
                Bar::of([("cycles", 0.47), ("code_bytes", 0.47)]),
            ),
            ("ur5e rnea, host f32, engine / casadi".into(), Bar::of([("ns", 0.8)])),
            ("ur5e rnea, host f32, engine fused / casadi".into(), Bar::of([("ns", 0.12)])),
            (
                "ur5e rnea, gates, engine / casadi".into(),
                Bar::of([("stages_0", 0.4), ("stages_1", 0.45), ("stages_2", 0.5)]),
            ),
            ("ur5e rnea, gates, core / RobotDynamics".into(), Bar::of([("stages_0", 0.69)])),
        ]);
        let compared = compared(&ratios, &rows);
        let measured: Vec<f64> = compared.iter().map(|compared| compared.measured).collect();
        assert_eq!(measured, [901.0, 0.5, 0.5, 0.4, 0.451, 0.7, 0.5, 0.125]);
        let unmet: Vec<bool> =
            compared.iter().map(|compared| compared.complaint().is_some()).collect();
        assert_eq!(unmet, [true, true, true, false, true, true, false, true]);
    }
}
