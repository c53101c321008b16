//! The page of the counted cycles.

use super::row::{Row, Worst};
use super::{BUILDS, Build, Report};
use xtask::kit::error::{Result, check};
use xtask::kit::table::{Table, thousands};
use xtask::studies::accuracy::names::digits;

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
