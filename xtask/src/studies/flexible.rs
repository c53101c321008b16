//! The truncation error of few modes of links that bend, and the accuracy of their inverse dynamics.

use serde::{Deserialize, Serialize};

use crate::kit::chart::{self, Axis, BLUE, HPos, Line, ORANGE, RGBColor, SKY};
use crate::kit::error::Result;
use crate::kit::host_bin;
use crate::kit::table::Table;
use crate::studies::study::{Bench, Found};

/// The curves and their colours.
const CURVES: [(&str, RGBColor); 3] = [
    ("tip at rest, upper link", BLUE),
    ("tip at rest, fore link", SKY),
    ("tip in motion, upper link", ORANGE),
];

#[derive(Deserialize, Serialize)]
struct Measured {
    /// By 1, 2 … modes, of each of [`CURVES`].
    truncation: Vec<[f64; CURVES.len()]>,
    /// Robot, quantity, and its errors in f64 and f32.
    errors: Vec<(String, String, [f64; 2])>,
}

/// Measures on the host, which gives the same bits everywhere.
pub fn measure(bench: &Bench<'_>) -> Result<Found> {
    let measured: Measured = host_bin::json(bench.workspace, "flexible")?;
    Ok(Found {
        picture: Some(measured.svg()?),
        ..Found::new(measured.markdown(), &measured)?
    })
}

impl Measured {
    fn markdown(&self) -> String {
        let digits = |error: &f64| format!("{error:.1e}");
        let [at_rest, fore, moving] = CURVES.map(|(name, _)| name);
        let mut truncation = Table::new(&["modes", at_rest, fore, moving]);
        for (row, modes) in self.truncation.iter().zip(1_u8..) {
            let [a, b, c] = row.each_ref().map(digits);
            truncation.row([modes.to_string(), a, b, c]);
        }
        let mut errors = Table::new(&["robot", "quantity", "error, f64", "error, f32"]);
        for (robot, quantity, [double, single]) in self.errors.clone() {
            errors.row([robot, quantity, digits(&double), digits(&single)]);
        }
        let errors = errors.markdown();
        format!("{}\n{}", truncation.markdown(), errors.trim_end())
    }

    fn svg(&self) -> Result<String> {
        let rows = || self.truncation.iter().zip(1_u8..);
        let lines = CURVES.iter().enumerate().map(|(k, &(_, colour))| Line {
            points: rows().map(|(row, m)| (m.into(), 1e6 * row[k])).collect(),
            colour,
            width: 2,
            dots: 3,
        });
        let x = Axis::linear("modes m", [0.8, self.truncation.len() as f64 + 0.2], 6, 48);
        let y = Axis::decades("error, parts per million", [1e-2, 1e4], 84);
        chart::svg((720, 460), |root| {
            let title = "What m modes of a link leave out of its tip's deflection";
            chart::label(root, title, (28, 24), chart::TITLE, HPos::Left)?;
            let names = CURVES.map(|(name, colour)| (name.to_owned(), colour, 4));
            let below = chart::legend(root, names, (98, 56))?;
            chart::lines(root, below + 8, [&x, &y], &lines.collect::<Vec<_>>())?;
            Ok(())
        })
    }
}
