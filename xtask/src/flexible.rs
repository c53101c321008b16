//! `cargo xtask flexible`: what few modes leave out of links that bend, and how accurate their inverse dynamics is.

use std::process::ExitCode;

use serde::Deserialize;

use crate::chart::{self, Axis, HPos, Line, RGBColor};
use crate::docs::{self, Page};
use crate::error::Result;
use crate::host_bin;
use crate::output;
use crate::table::Table;
use crate::workspace::{self, Workspace};

const PAGE: Page = Page {
    file: "docs/flexible.md",
    name: "flexible",
    command: "cargo xtask flexible",
};
const PICTURE: &str = "docs/flexible.svg";
/// What is left out of, and a colour that is readable to the colour-blind.
const CURVES: [(&str, RGBColor); 3] = [
    ("tip at rest, upper link", RGBColor(27, 80, 162)),
    ("tip at rest, fore link", RGBColor(86, 160, 211)),
    ("tip in motion, upper link", RGBColor(230, 145, 0)),
];

/// What the bin prints.
#[derive(Deserialize)]
struct Measured {
    /// By 1, 2 … modes, of each of [`CURVES`].
    truncation: Vec<[f64; CURVES.len()]>,
    /// Robot, quantity, and its errors in f64 and f32.
    errors: Vec<(String, String, [f64; 2])>,
}

/// Measures and rewrites the page's tables and the picture.
pub fn run() -> Result<ExitCode> {
    let workspace = Workspace::for_reports()?;
    let measured: Measured = host_bin::json(&workspace, PAGE.name)?;
    let text = measured.markdown();
    output::line(&text)?;
    PAGE.write(&workspace, &text)?;
    workspace::write(&workspace.report(PICTURE), measured.svg()?)?;
    Ok(ExitCode::SUCCESS)
}

/// Fails unless page and picture agree with a new measurement, which gives the same bits everywhere.
pub fn check(workspace: &Workspace) -> Result<String> {
    let measured: Measured = host_bin::json(workspace, PAGE.name)?;
    PAGE.check(workspace, &measured.markdown(), None)?;
    docs::compare_picture(workspace, PICTURE, PAGE.command, &measured.svg()?, true)?;
    Ok(String::new())
}

impl Measured {
    fn markdown(&self) -> String {
        let [at_rest, fore, moving] = CURVES.map(|(name, _)| name);
        let mut truncation = Table::new(&["modes", at_rest, fore, moving]);
        for (row, modes) in self.truncation.iter().zip(1..) {
            let errors = row.iter().map(|error| format!("{error:.1e}"));
            truncation.row([format!("{modes}")].into_iter().chain(errors));
        }
        let mut errors = Table::new(&["robot", "quantity", "error, f64", "error, f32"]);
        for (robot, quantity, [double, single]) in &self.errors {
            let of = [double, single].map(|error| format!("{error:.1e}"));
            errors.row([robot.clone(), quantity.clone()].into_iter().chain(of));
        }
        format!(
            "{}\n{}",
            truncation.markdown(),
            errors.markdown().trim_end()
        )
    }

    fn svg(&self) -> Result<String> {
        let curves = CURVES.iter().enumerate();
        let lines = curves.map(|(k, &(_, colour))| Line {
            points: self
                .truncation
                .iter()
                .zip(1..)
                .map(|(row, m)| (f64::from(m), 1e6 * row[k]))
                .collect(),
            colour,
            dots: true,
        });
        let x = Axis::linear("modes m", [0.8, self.truncation.len() as f64 + 0.2], 6, 48);
        let y = Axis::decades("error, parts per million", [1e-2, 1e4], 84);
        chart::svg((720, 460), |root| {
            let title = "What m modes of a link leave out of its tip's deflection";
            chart::label(root, title, (28, 24), 20, HPos::Left)?;
            let names = CURVES.map(|(name, colour)| (name.to_owned(), colour));
            chart::legend(root, names, (98, 56))?;
            chart::lines(root, 80, [&x, &y], &lines.collect::<Vec<_>>())?;
            Ok(())
        })
    }
}
