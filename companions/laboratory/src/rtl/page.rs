//! The page of the counted cycles, and its picture.

use super::row::{Row, Worst};
use super::{BUILDS, Build, Report};
use xtask::kit::chart::{Axis, BLUE, GREEN, ORANGE, Panels, RED, SKY, Shape};
use xtask::kit::error::{Result, check};
use xtask::kit::table::{Table, thousands};
use xtask::studies::accuracy::names::digits;

/// The robots, in the order of the page.
const ROBOTS: [&str; 5] = ["ur5e", "panda", "iiwa14", "xarm7", "a1"];

/// The cycles of the row of this name, by the number of stages.
fn cycles(rows: &[Row], name: &[&str], build: Build, stages: usize) -> Option<u64> {
    let row = rows.iter().find(|row| row.name == name && row.build == build)?;
    row.cycles.get(stages).copied()
}

impl Report {
    /// The tables of algorithms and of ticks.
    pub fn tables(&self) -> [String; 2] {
        let scheduled = self.rows.iter().filter(|row| row.build == Build::Scheduled);
        let (algorithms, ticks): (Vec<&Row>, Vec<&Row>) =
            scheduled.partition(|row| row.name.len() > 1);
        let table = |rows: &[&Row], head: &str| {
            let cell = |row: &Row, build, stages| {
                let name: Vec<&str> = row.name.iter().map(String::as_str).collect();
                cycles(&self.rows, &name, build, stages).map_or("–".into(), thousands)
            };
            let mut table = Table::new(&[
                head,
                "scheduled: 0 stages",
                "1 stage",
                "2 stages",
                "fused: 0 stages",
                "1 stage",
                "2 stages",
            ]);
            for row in rows {
                let builds =
                    BUILDS.iter().flat_map(|build| [0, 1, 2].map(|stages| (*build, stages)));
                let cells = builds.map(|(build, stages)| cell(row, build, stages));
                table.row(std::iter::once(row.name.join(" ")).chain(cells));
            }
            table.markdown()
        };
        [table(&algorithms, "robot, algorithm, form, sines"), table(&ticks, "scene")]
    }

    /// The errors of torques by both arithmetics.
    pub fn errors(&self) -> Result<String> {
        let mut table = Table::new(&[
            "robot, form",
            "separate, N·m",
            "fused, N·m",
            "separate, of the largest torque",
            "fused",
        ]);
        for one in self.errors.iter().filter(|one| one.build == Build::Scheduled) {
            let is_its = |other: &&Worst| other.build == Build::Fused && other.name == one.name;
            let other = self.errors.iter().find(is_its);
            let other = other.ok_or_else(|| check!("{:?} was not built fused", one.name))?;
            let errors = [one.error, other.error].map(digits);
            let shares = [one, other].map(|worst| digits(worst.error / worst.largest));
            let name = std::iter::once(one.name.join(" "));
            table.row(name.chain(errors).chain(shares));
        }
        Ok(table.markdown())
    }
}

/// Inverse dynamics of each robot by core and engine, for each latency.
pub fn svg(rows: &[Row]) -> Result<String> {
    let panels = ["engine", "core"].map(|form| {
        let robots = ROBOTS.iter().flat_map(|robot| {
            ["outside", "inside"].map(|sines| {
                let name = [robot, "rnea", form, sines];
                let dot = |stages, build, shape, colour| {
                    let cycles = cycles(rows, &name, build, stages)?;
                    Some((cycles as f64, shape, colour, String::new()))
                };
                let dots = [
                    dot(0, Build::Scheduled, Shape::Dot, SKY),
                    dot(1, Build::Scheduled, Shape::Dot, BLUE),
                    dot(2, Build::Scheduled, Shape::Dot, RED),
                    dot(1, Build::Fused, Shape::Ring, GREEN),
                    dot(2, Build::Fused, Shape::Ring, ORANGE),
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
            ("1 stage, fused", GREEN),
            ("2 stages, fused", ORANGE),
        ],
        x,
        names: 176,
        mark: None,
    }
    .svg(&panels)
}

#[cfg(test)]
mod tests {
    use super::super::row::{Row, Worst};
    use super::{Build, Report};

    #[test]
    fn the_page_has_the_figures_of_each_build() {
        let names = [vec!["ur5e", "rnea", "engine", "outside"], vec!["ur5e"]];
        let rows = names.iter().flat_map(|name| {
            let builds = [(Build::Scheduled, 2), (Build::Fused, 3)];
            builds.map(|(build, thousands)| Row {
                name: name.iter().map(ToString::to_string).collect(),
                build,
                cycles: [7, 8, 9].map(|stages| 1000 * thousands + stages).into(),
            })
        });
        let errors = [(Build::Scheduled, 5e-6), (Build::Fused, 3e-6)].map(|(build, error)| Worst {
            name: vec!["ur5e".into(), "core".into()],
            build,
            error,
            largest: 100.0,
        });
        let errors = errors.into();
        let mut report = Report { rows: rows.collect(), errors };
        let page = |report: &Report| report.tables().concat() + &report.errors().expect("pairs");
        let text = page(&report);
        let all = ["2,007", "2,008", "2,009", "3,007", "3,008", "3,009"];
        assert!(all.iter().all(|cycles| text.matches(cycles).count() == 2), "{text}");
        assert!(text.contains("5.0e-6") && text.contains("3.0e-8"), "{text}");
        report.rows.pop();
        assert_eq!(page(&report).matches("3,008").count(), 1);
        report.errors.pop();
        report.errors().expect_err("no fused arithmetic");
    }
}
