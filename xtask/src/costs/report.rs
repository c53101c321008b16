//! The rows in print.

use super::bars::{Bars, held, held_small, unknown};
use super::measure::Row;
use crate::bars::{self, Held, Ratios};
use crate::render::CLOCK_MHZ;
use crate::report::MODEL;
use crate::table::{Table, thousands};

/// The least arithmetic known for a general arm of six joints, flops: Balafoutis; McMillan & Orin.
const FLOORS: [(&str, u64); 3] = [("rnea", 836), ("crba", 855), ("aba", 2067)];
const FLOOR_JOINTS: usize = 6;

/// Of the section on forward dynamics.
const WAYS: &str = "\
`forward`: bias, CRBA, factors, solution; `aba`: articulated bodies; sines and cosines at hand. The core's two \
lines over the length of a chain are in `docs/growth.md`; which is less accurate where, in \
`docs/eliminations.md`. The engine folds more of M than of articulated inertias.";

/// Everything that is printed.
pub struct Report {
    /// What was measured.
    pub rows: Vec<Row>,
    /// The engine's rows of the UR5e at opt-level s.
    pub small: Vec<Row>,
    /// What was promised.
    pub bars: Bars,
    /// What was promised of opt-level s, among others.
    pub ratios: Ratios,
    /// The compiler of the firmware.
    pub rustc: String,
}

impl Report {
    /// For a terminal.
    pub fn text(&self) -> String {
        let mut text = format!("\nCost of a call ({MODEL})\n");
        for (robot, table) in self.tables() {
            text += &format!("\n{robot}\n\n{}", table.text());
        }
        text += &format!("\nTwo ways of forward dynamics\n\n{}", self.ways().text());
        text += &format!("\nur5e at opt-level s\n\n{}", self.small_table().text());
        text += &format!("\nBars\n\n{}", bars::table(&self.held()).text());
        text + &format!("\n{}; µs at {CLOCK_MHZ} MHz\n", self.rustc)
    }

    /// For the docs.
    pub fn markdown(&self) -> String {
        let mut text = format!(
            "# Costs\n\n\
             <!-- written by `{}`: do not edit -->\n\n\
             What a call costs, its passing of arguments included, over 32 random states: {MODEL}, µs at \
             {CLOCK_MHZ} MHz.\n\n\
             - form: `core`, the textbook loop over the model; `engine`, specialised to the robot\n\
             - inputs, the effects named: `full`: gravity, inertia and velocity products; `bias`: gravity and \
             velocity products; `gravity`: gravity alone; `no_coriolis`: gravity and inertia\n\
             - sin/cos: whether they are computed inside, or at hand\n\
             - flops: sums, products, quotients and roots executed; a multiply-accumulate is two\n\
             - of floor: flops as a share of the least arithmetic known for a general arm of six joints, sines \
             and cosines aside (RNEA {}, CRBA {}, ABA {})\n\
             - `crba`: M; `factor_solve`: M's factors and one solution, M at hand; `forward`: bias, M, its \
             factors and the solution; `aba`: the same by articulated bodies; `jacobian`: of the last body\n\
             - code: instructions and literals of the function and of all that it calls, in bytes, without the \
             robot's constants in memory and without library functions of trigonometry\n\
             - stack: bytes that it and all that it calls write to\n",
            super::COMMAND,
            thousands(FLOORS[0].1),
            thousands(FLOORS[1].1),
            thousands(FLOORS[2].1),
        );
        for (robot, table) in self.tables() {
            text += &format!("\n## {robot}\n\n{}", table.markdown());
        }
        text += &format!(
            "\n## Two ways of forward dynamics\n\n{WAYS}\n\n{}",
            self.ways().markdown()
        );
        text += &format!(
            "\n## ur5e at opt-level s\n\nThe whole firmware built for size.\n\n{}",
            self.small_table().markdown()
        );
        text += &format!(
            "\n## Bars\n\nWhat was promised, from `budgets.toml`.\n\n{}",
            bars::table(&self.held()).markdown()
        );
        text + &format!("\nMeasured with {}.\n", self.rustc)
    }

    /// A table for each robot.
    fn tables(&self) -> Vec<(&str, Table)> {
        let mut tables: Vec<(&str, Table)> = Vec::new();
        for row in &self.rows {
            if tables.last().is_none_or(|(robot, _)| *robot != row.robot) {
                let table = Table::new(&[
                    "algorithm, form, inputs",
                    "sin/cos",
                    "insn min",
                    "median",
                    "max",
                    "cycles min",
                    "median",
                    "max",
                    "µs",
                    "flops",
                    "of floor",
                    "code",
                    "stack",
                ]);
                tables.push((&row.robot, table));
            }
            if let Some((_, table)) = tables.last_mut() {
                table.row(cells(row));
            }
        }
        tables
    }

    /// Every bar that there is a figure for.
    fn held(&self) -> Vec<Held> {
        let mut all = held(&self.bars, &self.rows);
        all.extend(held_small(&self.ratios, &self.rows, &self.small));
        all
    }

    /// The bars that are not as `budgets.toml` has them, or whose row is not there, in words.
    pub fn missed(&self) -> Vec<String> {
        let held = self.held();
        let unmet = held.iter().filter_map(Held::complaint);
        unmet.chain(unknown(&self.bars, &self.rows)).collect()
    }

    /// By M and its factors, and by articulated bodies.
    fn ways(&self) -> Table {
        let mut table = Table::new(&[
            "robot, form",
            "joints",
            "forward: cycles",
            "aba: cycles",
            "aba / forward",
            "shorter",
        ]);
        for row in &self.rows {
            let of = |other: &&Row| {
                (&other.robot, &other.form, other.trig, &*other.algorithm)
                    == (&row.robot, &row.form, row.trig, "aba")
            };
            let aba = self.rows.iter().find(of).map(|row| row.cycles.max);
            let (true, Some(aba)) = (row.algorithm == "forward" && !row.trig, aba) else {
                continue;
            };
            let forward = row.cycles.max;
            let shorter = if aba < forward { "aba" } else { "forward" };
            table.row([
                format!("{} {}", row.robot, row.form),
                row.joints.to_string(),
                thousands(forward),
                thousands(aba),
                format!("{:.2}", aba as f64 / forward as f64),
                shorter.to_owned(),
            ]);
        }
        table
    }

    /// opt-level s beside 3.
    fn small_table(&self) -> Table {
        let mut table = Table::new(&[
            "algorithm, form, inputs",
            "sin/cos",
            "cycles at s",
            "at 3",
            "s / 3",
            "code at s",
            "at 3",
            "s / 3",
        ]);
        for small in &self.small {
            let Some(row) = self.rows.iter().find(|row| row.key() == small.key()) else {
                continue;
            };
            let mut line = cells(small)[..2].to_vec();
            for (small, row) in [
                (small.cycles.max, row.cycles.max),
                (small.code_bytes, row.code_bytes),
            ] {
                let ratio = format!("{:.3}", small as f64 / row as f64);
                line.extend([thousands(small), thousands(row), ratio]);
            }
            table.row(line);
        }
        table
    }
}

fn cells(row: &Row) -> Vec<String> {
    let (i, c) = (row.instructions, row.cycles);
    let mut cells = vec![
        format!("{} {} {}", row.algorithm, row.form, row.inputs),
        if row.trig { "inside" } else { "at hand" }.to_owned(),
    ];
    cells.extend([i.min, i.median, i.max, c.min, c.median, c.max].map(thousands));
    cells.push(format!("{:.2}", c.max as f64 / CLOCK_MHZ));
    cells.push(thousands(row.flops));
    cells.push(floor_share(row).map_or_else(String::new, |share| format!("{share:.2}")));
    cells.extend([row.code_bytes, row.stack_bytes].map(thousands));
    cells
}

/// Flops as a share of the floor, where there is one: for what the floor computes.
fn floor_share(row: &Row) -> Option<f64> {
    let (_, floor) = FLOORS
        .iter()
        .find(|(algorithm, _)| *algorithm == row.algorithm)?;
    let comparable = row.joints == FLOOR_JOINTS && row.inputs == "full" && !row.trig;
    comparable.then(|| row.flops as f64 / *floor as f64)
}
