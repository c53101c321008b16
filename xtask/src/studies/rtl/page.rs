//! The page of the counted cycles, and its picture.

use super::Report;
use super::row::Row;
use crate::kit::chart::{Axis, BLUE, GREEN, ORANGE, Panels, RED, SKY, Shape};
use crate::kit::error::{Result, check};
use crate::kit::table::{Table, thousands};

/// The robots, in the order of the page.
const ROBOTS: [&str; 5] = ["ur5e", "panda", "iiwa14", "xarm7", "a1"];

/// The row of this name.
fn of<'a>(rows: &'a [Row], name: &[&str], contracted: bool) -> Option<&'a Row> {
    rows.iter().find(|row| row.name == name && row.contracted == contracted)
}

/// The cycles of an FPU of one stage, for the step of the tests.
pub fn summary(rows: &[Row]) -> Result<String> {
    let cycles = |name: &[&str]| {
        let row = of(rows, name, false).and_then(|row| row.cycles.get(1));
        row.map(|cycles| thousands(*cycles)).ok_or_else(|| check!("no row {name:?}"))
    };
    let rnea = cycles(&["ur5e", "rnea", "engine", "outside"])?;
    let tick = cycles(&["ur5e"])?;
    Ok(format!("a UR5e's inverse dynamics {rnea} cycles, its tick {tick}"))
}

impl Report {
    pub fn markdown(&self) -> Result<String> {
        let (mut algorithms, mut ticks): (Vec<_>, Vec<_>) = (Vec::new(), Vec::new());
        for row in self.rows.iter().filter(|row| !row.contracted) {
            let fused = self.rows.iter().find(|other| other.contracted && other.name == row.name);
            let fused = fused.ok_or_else(|| check!("{:?} was not built contracted", row.name))?;
            let list = if row.name.len() == 1 { &mut ticks } else { &mut algorithms };
            list.push((row, fused));
        }
        let table = |lines: &[(&Row, &Row)], head: &str| {
            let cycles =
                |row: &Row, at: usize| row.cycles.get(at).map_or("–".into(), |c| thousands(*c));
            Table::of(
                lines,
                &[
                    (head, &|(row, _)| row.name.join(" ")),
                    ("instructions", &|(row, _)| thousands(row.instructions)),
                    ("cycles: 0 stages", &|(row, _)| cycles(row, 0)),
                    ("1 stage", &|(row, _)| cycles(row, 1)),
                    ("2 stages", &|(row, _)| cycles(row, 2)),
                    ("contracted: instructions", &|(_, row)| thousands(row.instructions)),
                    ("cycles: 0 stages", &|(_, row)| cycles(row, 0)),
                    ("1 stage", &|(_, row)| cycles(row, 1)),
                    ("2 stages", &|(_, row)| cycles(row, 2)),
                ],
            )
            .markdown()
        };
        Ok(format!(
            include_str!("page.md"),
            algorithms = table(&algorithms, "robot, algorithm, form, sines"),
            ticks = table(&ticks, "scene"),
            rustc = self.rustc,
        ))
    }
}

/// Inverse dynamics of each robot by core and engine, for each latency.
pub fn svg(rows: &[Row]) -> Result<String> {
    let panels = ["engine", "core"].map(|form| {
        let robots = ROBOTS.iter().flat_map(|robot| {
            ["outside", "inside"].map(|sines| {
                let name = [robot, "rnea", form, sines];
                let dot = |at: usize, contracted, shape, colour| {
                    let cycles = *of(rows, &name, contracted)?.cycles.get(at)?;
                    Some((cycles as f64, shape, colour, String::new()))
                };
                let dots = [
                    dot(0, false, Shape::Dot, SKY),
                    dot(1, false, Shape::Dot, BLUE),
                    dot(2, false, Shape::Dot, RED),
                    dot(1, true, Shape::Ring, GREEN),
                    dot(2, true, Shape::Ring, ORANGE),
                ];
                (format!("{robot}, sines {sines}"), dots.into_iter().flatten().collect())
            })
        });
        (format!("{form}: inverse dynamics"), robots.collect())
    });
    let mut x = Axis::decades("counted cycles", [5e2, 1.7e4], 0);
    x.ticks = [500.0, 1e3, 2e3, 5e3, 1e4].into();
    Panels {
        title: "Cycles that the core counts, by the stages of its floating-point unit".into(),
        note: "CV32E40P from its register-transfer source, f32, memory that never waits.",
        legend: &[
            ("0 stages", SKY),
            ("1 stage", BLUE),
            ("2 stages", RED),
            ("1 stage, contracted", GREEN),
            ("2 stages, contracted", ORANGE),
        ],
        x,
        names: 176,
        mark: None,
    }
    .svg(&panels)
}

#[cfg(test)]
mod tests {
    use super::super::row::Row;
    use super::{Report, summary};

    fn row(name: &[&str], contracted: bool) -> Row {
        let name = name.iter().map(ToString::to_string).collect();
        Row { name, contracted, cycles: vec![1000, 1100, 2000], instructions: 900 }
    }

    #[test]
    fn the_page_has_the_figures_of_both_builds() {
        let name = ["ur5e", "rnea", "engine", "outside"];
        let mut rows = vec![row(&name, false), row(&["ur5e"], false)];
        rows.extend([row(&name, true), row(&["ur5e"], true)]);
        rows[2].cycles[1] = 777;
        assert!(summary(&rows).expect("both rows").contains("1,100 cycles"));
        let mut report = Report { rows, rustc: "rustc 1".into() };
        let page = report.markdown().expect("a page");
        assert!(page.contains("777") && page.contains("1,100"), "{page}");
        report.rows.truncate(2);
        report.markdown().map(drop).expect_err("no contracted rows");
        report.rows.truncate(1);
        summary(&report.rows).expect_err("no tick");
    }
}
