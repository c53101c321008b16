//! Engine and core against the best peer, and the bars for that.

use crate::kit::bars::{Bars, Compared};
use crate::studies::peers::PRECISIONS;
use crate::studies::peers::report::{HOST, M4F, OURS, Row};

/// CasADi's C by gcc on the target: the one with fewer cycles is the peer.
const BUILDS: [&str; 2] = ["casadi gcc", "casadi gcc -ffp-contract=off"];

/// Others, on the host, by how their names begin.
const OTHERS: [&str; 2] = ["casadi", "pinocchio"];

/// The bars of `budgets.toml` that this run has the figures for.
pub fn compared(ratios: &Bars, rows: &[Row]) -> Vec<Compared> {
    let mut all = Vec::new();
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
    use super::{HOST, M4F, Row, compared};
    use crate::kit::bars::{Bar, Bars};

    #[test]
    fn the_engine_is_checked_against_the_best_build() {
        let row = |target, peer: &str, cycles, engine| Row {
            target,
            robot: "ur5e".into(),
            algorithm: "rnea".into(),
            peer: peer.into(),
            precision: "f32".into(),
            cycles,
            code_bytes: cycles,
            ratios: [engine, None],
            ..Row::default()
        };
        let rows = [
            row(M4F, "casadi gcc", Some(1400), None),
            row(M4F, "casadi gcc -ffp-contract=off", Some(1000), None),
            row(M4F, "casadi clang", Some(10), None),
            row(M4F, "engine", Some(500), None),
            row(HOST, "casadi gcc", None, Some(0.4)),
            row(HOST, "casadi clang", None, Some(0.5)),
            row(HOST, "engine", None, Some(1.0)),
        ];
        let ratios = Bars::from([
            (
                "ur5e rnea, m4f, engine / casadi".into(),
                Bar::of([("cycles", 0.47), ("code_bytes", 0.47)]),
            ),
            ("ur5e rnea, host f32, engine / casadi".into(), Bar::of([("ns", 0.8)])),
        ]);
        let compared = compared(&ratios, &rows);
        let measured: Vec<f64> = compared.iter().map(|compared| compared.measured).collect();
        assert_eq!(measured, [0.5, 0.5, 0.5]);
        let unmet: Vec<bool> =
            compared.iter().map(|compared| compared.complaint().is_some()).collect();
        assert_eq!(unmet, [true, true, false]);
    }
}
