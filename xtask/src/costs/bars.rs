//! The bars: what was promised of some rows, whatever they cost now.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::measure::Row;
use crate::bars::{Held, Ratios};

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
/// The end of the name of a bar of what effects add to a rigid body's call.
pub const ADDED: &str = " added";

/// Every figure of the bars of these rows. A row that is not there holds none, which
/// [`unknown`] tells.
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
                taken: taken as f64,
                most: most as f64,
                recorded: bar.missed.iter().any(|missed| missed == figure),
                ratio: false,
            }));
        }
    }
    all
}

/// The engine at opt-level s against itself at 3, row by row, as far as there are bars.
pub fn held_small(ratios: &Ratios, rows: &[Row], small: &[Row]) -> Vec<Held> {
    let mut all = Vec::new();
    for small in small {
        let Some(row) = rows.iter().find(|row| row.key() == small.key()) else {
            continue;
        };
        let key = format!("opt-level s / 3, {}", row.key());
        for (figure, taken, of) in [
            ("cycles", small.cycles.max, row.cycles.max),
            ("code_bytes", small.code_bytes, row.code_bytes),
        ] {
            all.extend(Held::ratio(ratios, &key, figure, taken as f64 / of as f64));
        }
    }
    all
}

/// The bars whose row is not there, in words.
pub fn unknown(bars: &Bars, rows: &[Row]) -> Vec<String> {
    bars.keys()
        .filter(|key| ![TICK, ADDED].iter().any(|end| key.ends_with(end)))
        .filter(|key| rows.iter().all(|row| row.key() != **key))
        .map(|key| format!("{key}: there is no such row"))
        .collect()
}
