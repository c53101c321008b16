//! The costs as they were when the page was written, by which rows are bounded.

use serde::{Deserialize, Serialize};

use crate::kit::bars::{ADDED, Bars, Compared, IMAGE, OTHER_RUSTC, TICK, is_ratio};
use crate::kit::docs::json_lines;
use crate::kit::error::{Result, check, refuse_if};
use crate::kit::rows::Row;
use crate::kit::workspace::{self, Workspace};

pub const FILE: &str = "docs/costs.json";

/// A figure of today may be larger by this share than it was, with any compiler.
const CLOSE: f64 = OTHER_RUSTC;

#[derive(Serialize, Deserialize)]
pub struct Record {
    /// The compiler of the firmware.
    pub rustc: String,
    pub rows: Vec<Recorded>,
}

/// What a row costs at most.
#[derive(Clone, Serialize, Deserialize)]
pub struct Recorded {
    pub robot: String,
    pub algorithm: String,
    pub form: String,
    pub inputs: String,
    /// Whether sines and cosines are computed inside.
    pub trig: bool,
    pub instructions: u64,
    pub cycles: u64,
    /// Cycles from the flash of each of [`crate::kit::meter::CHIPS`].
    pub in_flash: [u64; 2],
    pub flops: u64,
    pub code_bytes: u64,
    pub stack_bytes: u64,
}

impl Record {
    /// The rows of the first bin that has each.
    pub fn new(rows: &[Row], rustc: String) -> Self {
        let mut record = Self { rustc, rows: Vec::new() };
        for row in rows {
            if record.find(&row.key()).is_none() {
                record.rows.push(Recorded::of(row));
            }
        }
        // Robots of two bins stand together.
        let mut robots: Vec<String> = Vec::new();
        for row in record.rows.iter().filter(|row| !row.robot.is_empty()) {
            if !robots.contains(&row.robot) {
                robots.push(row.robot.clone());
            }
        }
        record.rows.sort_by_key(|row| robots.iter().position(|robot| *robot == row.robot));
        record
    }

    pub fn read(workspace: &Workspace) -> Result<Self> {
        let text = workspace::read(&workspace.root.join(FILE))?;
        serde_json::from_str(&text).map_err(|e| check!("{FILE}: {e}"))
    }

    /// A row a line.
    pub fn json(&self) -> Result<String> {
        let rustc = serde_json::json!(self.rustc);
        Ok(format!("{{\"rustc\": {rustc}, \"rows\": {}}}\n", json_lines(&self.rows)?))
    }

    pub fn find(&self, key: &str) -> Option<&Recorded> {
        self.rows.iter().find(|row| row.key() == key)
    }
}

impl Recorded {
    pub fn of(row: &Row) -> Self {
        Self {
            robot: row.robot.clone(),
            algorithm: row.algorithm.clone(),
            form: row.form.clone(),
            inputs: row.inputs.clone(),
            trig: row.trig,
            instructions: row.instructions.max,
            cycles: row.cycles.max,
            in_flash: row.in_flash.map(|cycles| cycles.max),
            flops: row.flops,
            code_bytes: row.code_bytes,
            stack_bytes: row.stack_bytes,
        }
    }

    pub fn key(&self) -> String {
        let trig = if self.trig { " trig" } else { "" };
        format!("{} {} {} {}{trig}", self.robot, self.algorithm, self.form, self.inputs)
    }

    fn figures(&self) -> [(&'static str, f64); 4] {
        [
            ("instructions", self.instructions),
            ("cycles", self.cycles),
            ("code_bytes", self.code_bytes),
            ("stack_bytes", self.stack_bytes),
        ]
        .map(|(name, figure)| (name, figure as f64))
    }
}

/// Fails unless every row is recorded and costs hardly more today, and every bar of rows holds.
pub fn hold(record: &Record, rows: &[Row], bars: &Bars) -> Result<()> {
    let rows: Vec<Recorded> = rows.iter().map(Recorded::of).collect();
    let mut wrong = Vec::new();
    for row in &rows {
        let key = row.key();
        let Some(old) = record.find(&key) else {
            wrong.push(format!("{key}: {FILE} does not have it"));
            continue;
        };
        for ((what, old), (_, now)) in old.figures().into_iter().zip(row.figures()) {
            if now > old * (1.0 + CLOSE) {
                let more = 100.0 * CLOSE;
                wrong
                    .push(format!("{key}: {what} {now}, recorded {old}: more than {more} % above"));
            }
        }
    }
    let others = [TICK, ADDED, IMAGE];
    for key in bars.keys().filter(|key| !others.iter().any(|end| key.ends_with(end))) {
        let Some(figures) = figures(&rows, key) else {
            wrong.push(format!("bar: {key}: there is no such row"));
            continue;
        };
        let compared = figures.into_iter();
        let compared = compared.filter_map(|(what, now)| Compared::of(bars, key, what, now));
        wrong.extend(compared.filter_map(|bar| Some(format!("bar: {}", bar.complaint()?))));
    }
    refuse_if!(
        !wrong.is_empty(),
        "{}\n`cargo xtask costs` records what is meant to cost more",
        wrong.join("\n")
    );
    Ok(())
}

/// The figures of a row, or of a pair of rows their ratios.
fn figures(rows: &[Recorded], key: &str) -> Option<[(&'static str, f64); 4]> {
    let of = |key: &str| rows.iter().find(|row| row.key() == key).map(Recorded::figures);
    let Some((key, base)) = key.split_once(" / ").filter(|_| is_ratio(key)) else {
        return of(key);
    };
    let (mut figures, base) = (of(key)?, of(base)?);
    figures.iter_mut().zip(base).for_each(|((_, figure), (_, base))| *figure /= base);
    Some(figures)
}

#[cfg(test)]
mod tests {
    use super::{Record, hold};
    use crate::kit::bars::{Bar, Bars};
    use crate::kit::docs::repository::root;
    use crate::kit::rows::Row;
    use crate::kit::workspace::Workspace;

    fn row(name: &str, cost: u64) -> Row {
        Row {
            code_bytes: cost,
            stack_bytes: cost,
            ..Row::sample(["arm", name, "core", "full"], cost)
        }
    }

    /// What is said of rows of today beside recorded ones of 1000, with a bar.
    fn said(rows: &[Row], bar: Option<(&str, f64)>) -> String {
        let record = Record::new(&[row("rnea", 1000), row("aba", 1000)], "rustc".into());
        let bar = bar.map(|(key, most)| (key.to_owned(), Bar::of([("cycles", most)])));
        let held = hold(&record, rows, &Bars::from_iter(bar));
        held.err().map_or(String::new(), |why| why.to_string())
    }

    #[test]
    fn a_row_may_cost_less_and_three_per_cent_more() {
        for cost in [10, 1000, 1030] {
            assert_eq!(said(&[row("rnea", cost)], None), "");
        }
        let over = said(&[row("rnea", 1031)], None);
        for what in ["instructions", "cycles", "code_bytes", "stack_bytes"] {
            let words =
                format!("arm rnea core full trig: {what} 1031, recorded 1000: more than 3 %");
            assert!(over.contains(&words), "{over}");
        }
        assert!(said(&[row("crba", 1)], None).contains("docs/costs.json does not have it"));
    }

    #[test]
    fn bars_of_rows_and_of_pairs_hold() {
        let rows = [row("rnea", 1000), row("aba", 1000)];
        let [rnea, aba] = ["arm rnea core full trig", "arm aba core full trig"];
        let pair = format!("{rnea} / {aba}");
        for (key, most) in [(rnea, 1000.0), (&pair, 1.0), ("arm tick", 1.0), ("arm added", 1.0)] {
            assert_eq!(said(&rows, Some((key, most))), "", "{key}");
        }
        assert!(said(&rows, Some((rnea, 999.0))).contains("cycles 1,000 > 999"));
        assert!(said(&rows, Some((&pair, 0.999))).contains("1.000× > 0.999×"));
        assert!(said(&rows[..1], Some((&pair, 1.0))).contains("there is no such row"));
        assert!(said(&rows, Some(("leg rnea", 1.0))).contains("there is no such row"));
    }

    #[test]
    fn a_row_of_two_bins_is_recorded_once_beside_its_robots_others() {
        let of = |robot: &str, cost| Row::sample([robot, "rnea", "core", "full"], cost);
        let other = Row::sample(["arm", "aba", "core", "full"], 3);
        let record = Record::new(&[of("arm", 1), of("leg", 2), of("arm", 9), other], String::new());
        let found: Vec<_> = record.rows.iter().map(|row| (&*row.robot, row.cycles)).collect();
        assert_eq!(found, [("arm", 1), ("arm", 3), ("leg", 2)]);
        let text = record.json().expect("JSON");
        let read: Record = serde_json::from_str(&text).expect("the same");
        assert_eq!((read.json().expect("JSON"), text.lines().count()), (text, 5));
        assert!(Record::read(&Workspace::at(&root())).expect("the record").rows.len() > 200);
    }
}
