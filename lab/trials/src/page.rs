//! The parts of a page: charts and tables.

use serde::Serialize;

#[derive(Serialize)]
pub struct Shown {
    /// In Markdown.
    pub text: String,
    /// From the top to the bottom of the picture.
    pub charts: Vec<Chart>,
    /// Estimators: their names, the regions of the firmware that they take, and the share of the error that they leave.
    pub estimators: Vec<(String, &'static str, f64)>,
}

/// Lines over two axes.
#[derive(Serialize)]
pub struct Chart {
    pub title: String,
    pub x: Scale,
    pub y: Scale,
    /// Their names and points.
    pub lines: Vec<(String, Vec<(f64, f64)>)>,
    /// Whether each point has a dot.
    pub dots: bool,
}

#[derive(Serialize)]
pub struct Scale {
    /// Quantity and unit.
    pub name: &'static str,
    /// The least and the greatest value.
    pub ends: [f64; 2],
    /// Whether equal lengths are equal factors.
    pub logarithmic: bool,
}

impl Scale {
    pub fn linear(name: &'static str, ends: [f64; 2]) -> Self {
        Self {
            name,
            ends,
            logarithmic: false,
        }
    }

    pub fn decades(name: &'static str, ends: [f64; 2]) -> Self {
        Self {
            logarithmic: true,
            ..Self::linear(name, ends)
        }
    }
}

/// A table in Markdown.
pub fn table(head: &str, rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let columns = head.split('|').count();
    let rule = vec!["---"; columns].join("|");
    let mut text = format!("|{head}|\n|{rule}|\n");
    for row in rows {
        assert_eq!(row.len(), columns, "{row:?}");
        text += &format!("|{}|\n", row.join("|"));
    }
    text
}

/// A bar: its name, what is required and what was got, and whether it is met.
pub fn bar(name: &str, required: &str, got: String, met: bool) -> Vec<String> {
    let verdict = if met { "met" } else { "missed" };
    vec![name.into(), required.into(), got, verdict.into()]
}
