//! The bars: what was promised of some rows, whatever they cost now.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::measure::Row;

/// The bars by the rows' names.
pub type Bars = BTreeMap<String, Bar>;

/// What a row was promised to take at most.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bar {
    /// Instructions of the longest call.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub instructions: Option<u64>,
    /// Modelled cycles of the longest call.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cycles: Option<u64>,
    /// Code in bytes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub code_bytes: Option<u64>,
    /// The figures that docs/decisions/0002-bars.md records as missed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub missed: Vec<String>,
}

/// The end of the name of a scene's bar.
pub const TICK: &str = " tick";

/// One figure of a bar, beside what was measured.
pub struct Held {
    /// Row and figure.
    pub what: String,
    /// What was measured.
    pub taken: u64,
    /// The bar.
    pub most: u64,
    /// It is recorded as missed.
    pub recorded: bool,
}

impl Held {
    /// Whether it is within the bar.
    pub fn is_met(&self) -> bool {
        self.taken <= self.most
    }

    /// What is wrong, if anything: a bar is missed without a record, or met in spite of one.
    pub fn complaint(&self) -> Option<String> {
        let Self {
            what, taken, most, ..
        } = self;
        match (self.is_met(), self.recorded) {
            (false, false) => Some(format!("{what} {taken} > {most}")),
            (true, true) => Some(format!("{what} is met now: take it off `missed`")),
            _ => None,
        }
    }
}

/// Every figure of the bars of these rows. A row that is not there holds none, which
/// [`missed`] tells.
pub fn held(bars: &Bars, rows: &[Row]) -> Vec<Held> {
    let mut all = Vec::new();
    for (key, bar) in bars {
        let Some(row) = rows.iter().find(|row| row.key() == *key) else {
            continue;
        };
        for (figure, most, taken) in [
            ("instructions", bar.instructions, row.instructions.max),
            ("cycles", bar.cycles, row.cycles.max),
            ("code_bytes", bar.code_bytes, row.code_bytes),
        ] {
            all.extend(most.map(|most| Held {
                what: format!("{key}: {figure}"),
                taken,
                most,
                recorded: bar.missed.iter().any(|missed| missed == figure),
            }));
        }
    }
    all
}

/// The bars that are not as `budgets.toml` has them, or whose row is not there, in words.
pub fn missed(bars: &Bars, rows: &[Row]) -> Vec<String> {
    let held = held(bars, rows);
    let unmet = held.iter().filter_map(Held::complaint);
    let unknown = bars
        .keys()
        .filter(|key| !key.ends_with(TICK) && rows.iter().all(|row| row.key() != **key))
        .map(|key| format!("{key}: there is no such row"));
    unmet.chain(unknown).collect()
}
