//! What each row may cost: what it cost when the budget was written.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::report::Report;
use crate::budgets::slack;

/// Every row's budget, and the compiler that it was measured with.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Budget {
    rustc: String,
    rows: BTreeMap<String, Most>,
}

/// What a row may cost.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Most {
    instructions: u64,
    cycles: u64,
    code_bytes: u64,
    stack_bytes: u64,
}

impl Most {
    fn items(&self) -> [(&'static str, u64); 4] {
        [
            ("instructions", self.instructions),
            ("cycles", self.cycles),
            ("code_bytes", self.code_bytes),
            ("stack_bytes", self.stack_bytes),
        ]
    }
}

impl Budget {
    /// What was measured.
    pub fn measured(report: &Report) -> Self {
        let rows = report.rows.iter().map(|row| {
            let most = Most {
                instructions: row.instructions.max,
                cycles: row.cycles.max,
                code_bytes: row.code_bytes,
                stack_bytes: row.stack_bytes,
            };
            (row.key(), most)
        });
        Self {
            rustc: report.rustc.clone(),
            rows: rows.collect(),
        }
    }

    /// The part of one robot.
    pub fn only(mut self, robot: &str) -> Self {
        self.rows
            .retain(|key, _| key.split(' ').next() == Some(robot));
        self
    }

    /// What exceeds this budget, in words; a row that has none, or is gone, is told as well.
    pub fn exceeded_by(&self, measured: &Self) -> Vec<String> {
        let more = 1.0 + slack(&self.rustc, &measured.rustc);
        let mut exceeded = Vec::new();
        for (key, taken) in &measured.rows {
            let Some(most) = self.rows.get(key) else {
                exceeded.push(format!("{key}: has no budget"));
                continue;
            };
            for ((what, most), (_, taken)) in most.items().into_iter().zip(taken.items()) {
                if taken as f64 > most as f64 * more {
                    exceeded.push(format!("{key}: {what} {taken} > {most}"));
                }
            }
        }
        let gone = self
            .rows
            .keys()
            .filter(|key| !measured.rows.contains_key(*key));
        exceeded.extend(gone.map(|key| format!("{key}: is no longer measured")));
        exceeded
    }

    /// As TOML, a line a row.
    pub fn toml(&self) -> String {
        let mut text = format!("[costs]\nrustc = {:?}\n\n[costs.rows]\n", self.rustc);
        for (key, most) in &self.rows {
            let items = most.items().map(|(what, most)| format!("{what} = {most}"));
            text += &format!("{key:?} = {{ {} }}\n", items.join(", "));
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::Budget;

    fn budget(rustc: &str, key: &str, cycles: u64) -> Budget {
        let text = format!(
            "rustc = {rustc:?}\n[rows]\n{key:?} = {{ instructions = 9, cycles = {cycles}, \
             code_bytes = 9, stack_bytes = 9 }}\n"
        );
        toml::from_str(&text).expect("TOML")
    }

    #[test]
    fn what_is_written_is_read() {
        let text = budget("rustc 1", "ur5e rnea core full", 1000).toml();
        let value: toml::Table = toml::from_str(&text).expect("TOML");
        let again: Budget = value["costs"].clone().try_into().expect("a budget");
        assert_eq!(again.toml(), text);
    }

    #[test]
    fn the_budget_of_one_robot_misses_no_row_of_another() {
        let both = budget("rustc 1", "ur5e rnea core full", 9).only("ur5e");
        let measured = budget("rustc 1", "ur5e aba core full", 9);
        let wrong = both.exceeded_by(&measured).join("; ");
        assert!(
            wrong.contains("ur5e rnea core full: is no longer measured"),
            "{wrong}"
        );
        let other = budget("rustc 1", "ur5e10 rnea core full", 9).only("ur5e");
        let wrong = other.exceeded_by(&measured);
        assert_eq!(wrong, ["ur5e aba core full: has no budget"]);
    }

    #[test]
    fn a_row_over_budget_is_named() {
        let ours = budget("rustc 1", "a", 1000);
        assert!(ours.exceeded_by(&budget("rustc 1", "a", 1000)).is_empty());
        assert!(ours.exceeded_by(&budget("rustc 2", "a", 1030)).is_empty());
        assert_eq!(
            ours.exceeded_by(&budget("rustc 1", "a", 1001)),
            ["a: cycles 1001 > 1000"]
        );
        assert_eq!(
            ours.exceeded_by(&budget("rustc 1", "b", 1)),
            ["b: has no budget", "a: is no longer measured"]
        );
    }
}
