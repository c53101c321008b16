//! Bars: promised figures compared with measured ones.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::kit::error::{Result, refuse_if};
use crate::kit::table::{Table, thousands};

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
}

impl Bar {
    /// A bar of these figures for tests.
    pub fn of<const N: usize>(most: [(&str, f64); N]) -> Self {
        Self { most: most.map(|(figure, most)| (figure.to_owned(), most)).into() }
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
            ratio: is_ratio(key),
        })
    }

    /// Whether it is within the bar.
    pub fn is_met(&self) -> bool {
        self.measured <= self.most
    }

    /// The error if it is not within the bar.
    pub fn complaint(&self) -> Option<String> {
        let (what, [most, measured]) = (&self.what, self.numbers());
        (!self.is_met()).then(|| format!("{what} {measured} > {most}"))
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
        let verdict = if compared.is_met() { "met" } else { "missed" };
        let [most, measured] = compared.numbers();
        table.row([compared.what.clone(), most, measured, verdict.into()]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::{Bar, Bars, Compared, hold, largest, table};

    #[test]
    fn a_figure_beyond_its_bar_is_refused() {
        let bars = Bars::from([
            ("a".into(), Bar::of([("cycles", 640.0)])),
            ("a / b".into(), Bar::of([("cycles", 0.47)])),
        ]);
        let complaint =
            |key: &str, measured| Compared::of(&bars, key, "cycles", measured)?.complaint();
        assert_eq!(complaint("a", 640.0), None);
        assert_eq!(complaint("a", 641.0).unwrap(), "a: cycles 641 > 640");
        assert_eq!(complaint("a / b", 0.47), None);
        assert_eq!(complaint("a / b", 0.48).unwrap(), "a / b: cycles 0.480× > 0.470×");
        // One in a thousand is too much already.
        assert!(complaint("a / b", 0.470_5).is_some() && complaint("a / b", f64::NAN).is_some());
        assert!(Compared::of(&bars, "a / b", "code_bytes", 1.0).is_none());
        assert!(Compared::of(&bars, "a / c", "cycles", 1.0).is_none());
        assert!(hold(&bars, "a / b", [("ns", 0.16), ("cycles", 0.47)]).is_ok());
        let error = hold(&bars, "a / b", [("cycles", f64::INFINITY)]).expect_err("no bound");
        assert!(error.to_string().starts_with("bar: a / b: cycles inf"));
        let compared = [0.47, 0.48].map(|now| Compared::of(&bars, "a / b", "cycles", now).unwrap());
        let words = table(&compared).text();
        assert!(words.contains("met\n") && words.contains("missed\n"), "{words}");
    }

    #[test]
    fn a_figure_that_is_not_a_number_is_the_largest() {
        assert_eq!(largest([1.0, 3.0, 2.0].into_iter()), 3.0);
        for figures in [[f64::NAN, 1.0], [1.0, f64::NAN]] {
            assert!(largest(figures.into_iter()).is_nan());
        }
        assert_eq!(largest(std::iter::empty()), 0.0);
    }
}
