//! How the engine stands against the best peer, and what was promised of that.

use crate::bars::{Held, Ratios};
use crate::peers::report::{HOST, M4F, Row};

/// CasADi's C by gcc on the target: the one with fewer cycles is the peer.
const BUILDS: [&str; 2] = ["casadi gcc", "casadi gcc -ffp-contract=off"];

/// The bars of `budgets.toml` that this run has the figures for.
pub fn held(ratios: &Ratios, rows: &[Row]) -> Vec<Held> {
    let mut all = Vec::new();
    for robot in ["ur5e", "panda", "iiwa14", "a1"] {
        let key = format!("{robot} rnea, m4f, engine / casadi");
        let best = BUILDS
            .iter()
            .filter_map(|build| find(rows, M4F, robot, "f32", build))
            .min_by_key(|row| row.cycles);
        let Some((engine, best)) = find(rows, M4F, robot, "f32", "engine").zip(best) else {
            continue;
        };
        for (figure, ours, theirs) in [
            ("cycles", engine.cycles, best.cycles),
            ("code_bytes", engine.code_bytes, best.code_bytes),
        ] {
            let pair = ours.zip(theirs);
            all.extend(
                pair.and_then(|(a, b)| Held::ratio(ratios, &key, figure, a as f64 / b as f64)),
            );
        }
    }
    for robot in ["ur5e", "panda"] {
        for precision in ["f32", "f64"] {
            let time = |peer: &str| best_ns(rows, robot, precision, peer);
            for peer in ["casadi", "pinocchio"] {
                let key = format!("{robot} rnea, host {precision}, engine / {peer}");
                let pair = time("engine").zip(time(peer));
                all.extend(pair.and_then(|(a, b)| Held::ratio(ratios, &key, "ns", a / b)));
            }
        }
    }
    all
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
    use super::{HOST, M4F, Row, held};
    use crate::bars::{Ratio, Ratios};

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
        let pair = |cycles, ns| Ratio {
            cycles,
            code_bytes: cycles,
            ns,
            ..Ratio::default()
        };
        let ratios = Ratios::from([
            (
                "ur5e rnea, m4f, engine / casadi".into(),
                pair(Some(0.47), None),
            ),
            (
                "ur5e rnea, host f32, engine / casadi".into(),
                pair(None, Some(0.8)),
            ),
        ]);
        let held = held(&ratios, &rows);
        let measured: Vec<f64> = held.iter().map(|held| held.taken).collect();
        assert_eq!(measured, [0.5, 0.5, 0.5]);
        let unmet: Vec<bool> = held.iter().map(|held| held.complaint().is_some()).collect();
        assert_eq!(unmet, [true, true, false]);
    }
}
