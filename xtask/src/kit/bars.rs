//! Bars: promised figures compared with measured ones, and the record of those that are missed.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::kit::error::{Result, refuse_if};
use crate::kit::table::{Table, thousands};

/// The page that explains the missed bars.
const RECORD: &str = "decisions/0002-bars.md";

/// The share by which a cost may be larger with another compiler than the one that the budget or
/// page names.
pub const OTHER_RUSTC: f64 = 0.03;

/// The end of the name of a scene's bar.
pub const TICK: &str = " tick";
/// The end of the name of a bar of what effects add to a rigid body's call.
pub const ADDED: &str = " added";
/// The end of the name of a bar of a board's image.
pub const IMAGE: &str = " image";

/// The bars, by the name of a row or of a pair of rows.
pub type Bars = BTreeMap<String, Bar>;

/// The upper bounds of the figures of a row, or of their ratios to those of another row.
#[derive(Clone, Debug, Default, Deserialize)]
pub struct Bar {
    #[serde(flatten)]
    pub most: BTreeMap<String, f64>,
    /// The figures that are recorded as missed.
    #[serde(default)]
    pub missed: Vec<String>,
}

impl Bar {
    /// A bar of these figures for tests, none of them missed.
    pub fn of<const N: usize>(most: [(&str, f64); N]) -> Self {
        Self {
            most: most.map(|(figure, most)| (figure.to_owned(), most)).into(),
            missed: Vec::new(),
        }
    }
}

/// Whether a bar of this name is of a pair of rows.
pub fn is_ratio(key: &str) -> bool {
    key.contains(" / ")
}

/// One figure of a bar, beside what was measured.
#[derive(Clone, Debug)]
pub struct Compared {
    pub what: String,
    pub measured: f64,
    pub most: f64,
    pub recorded: bool,
    /// It is a multiple, not a number of something.
    pub ratio: bool,
}

impl Compared {
    /// The figure of the row or pair `key` as measured; nothing if no bar is set.
    pub fn of(bars: &Bars, key: &str, figure: &str, measured: f64) -> Option<Self> {
        let bar = bars.get(key)?;
        Some(Self {
            what: format!("{key}: {figure}"),
            measured,
            most: *bar.most.get(figure)?,
            recorded: bar.missed.iter().any(|missed| missed == figure),
            ratio: is_ratio(key),
        })
    }

    /// Whether it is within the bar.
    pub fn is_met(&self) -> bool {
        self.measured <= self.most
    }

    /// The error, if there is one: a bar is missed without a record, or met in spite of one.
    pub fn complaint(&self) -> Option<String> {
        let (what, [most, measured]) = (&self.what, self.numbers());
        match (self.is_met(), self.recorded) {
            (false, false) => Some(format!("{what} {measured} > {most}")),
            (true, true) => Some(format!("{what} is met now: take it off `missed`")),
            _ => None,
        }
    }

    /// The bar and what was measured, in print.
    fn numbers(&self) -> [String; 2] {
        [self.most, self.measured]
            .map(|x| if self.ratio { format!("{x:.3}×") } else { thousands(x as u64) })
    }
}

/// Fails if a figure of the row or pair `key` misses its bar; a figure without a bar is not
/// compared.
pub fn hold<const N: usize>(bars: &Bars, key: &str, figures: [(&str, f64); N]) -> Result<()> {
    for (figure, measured) in figures {
        let compared = Compared::of(bars, key, figure, measured);
        let complaint = compared.and_then(|bar| bar.complaint()).unwrap_or_default();
        refuse_if!(!complaint.is_empty(), "bar: {complaint}");
    }
    Ok(())
}

/// The largest of some figures: the one that is not a number, if there is one, which `f64::max`
/// would drop; 0 of none.
pub fn largest(figures: impl Iterator<Item = f64>) -> f64 {
    figures.fold(0.0, |a, b| if b > a || b.is_nan() { b } else { a })
}

/// The table of bars for a page.
pub fn table(compared: &[Compared]) -> Table {
    let mut table = Table::new(&["bar", "at most", "now", ""]);
    for compared in compared {
        let verdict = match (compared.is_met(), compared.recorded) {
            (true, _) => "met".to_owned(),
            (false, true) => format!("missed, see {RECORD}"),
            (false, false) => "MISSED".to_owned(),
        };
        let [most, measured] = compared.numbers();
        table.row([compared.what.clone(), most, measured, verdict]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::{Bar, Bars, Compared, hold, largest, table};

    #[test]
    fn a_bar_is_met_or_recorded() {
        let mut pair = Bar::of([("cycles", 0.47), ("ns", 0.15)]);
        pair.missed = vec!["ns".into()];
        let ratios = Bars::from([("a / b".into(), pair)]);
        let complaint =
            |figure, measured| Compared::of(&ratios, "a / b", figure, measured)?.complaint();
        assert_eq!(complaint("cycles", 0.47), None);
        let said = complaint("cycles", 0.48).unwrap();
        assert_eq!(said, "a / b: cycles 0.480× > 0.470×");
        // One in a thousand is too much already.
        assert!(complaint("cycles", 0.470_5).is_some());
        assert!(complaint("cycles", f64::NAN).is_some());
        assert_eq!(complaint("ns", 0.16), None);
        assert!(complaint("ns", 0.14).unwrap().contains("met now"));
        assert!(Compared::of(&ratios, "a / b", "code_bytes", 1.0).is_none());
        assert!(Compared::of(&ratios, "a / c", "cycles", 1.0).is_none());
        assert!(hold(&ratios, "a / b", [("ns", 0.16), ("cycles", 0.47)]).is_ok());
        let error = hold(&ratios, "a / b", [("cycles", f64::INFINITY)]).expect_err("no bound");
        assert!(error.to_string().starts_with("bar: a / b: cycles inf"));
    }

    #[test]
    fn a_figure_that_is_not_a_number_is_the_largest() {
        assert_eq!(largest([1.0, 3.0, 2.0].into_iter()), 3.0);
        for figures in [[f64::NAN, 1.0], [1.0, f64::NAN]] {
            assert!(largest(figures.into_iter()).is_nan());
        }
        assert_eq!(largest(std::iter::empty()), 0.0);
    }

    #[test]
    fn one_cycle_beyond_a_bar_is_a_miss() {
        let compared = |measured, recorded| Compared {
            what: "rnea: cycles".into(),
            measured,
            most: 640.0,
            recorded,
            ratio: false,
        };
        assert_eq!(compared(640.0, false).complaint(), None);
        let said = compared(641.0, false).complaint().unwrap();
        assert_eq!(said, "rnea: cycles 641 > 640");
        assert_eq!(compared(641.0, true).complaint(), None);
        assert!(compared(640.0, true).complaint().is_some());
        let rows = [(640.0, false), (641.0, true), (641.0, false)];
        let words = table(&rows.map(|(now, recorded)| compared(now, recorded))).text();
        for word in ["met", "missed, see", "MISSED"] {
            assert!(words.contains(word), "{word}: {words}");
        }
    }
}
