//! A picture of rows of dots side by side, under one legend.

use super::{Axis, HEAD, HPos, RGBColor, Row, TEXT, TITLE, label, legend, rows, svg};
use crate::kit::error::Result;

/// px: a column, a row of dots, and what is above and below the rows.
const COLUMN: i32 = 540;
const ROW: usize = 20;
const ABOVE: u32 = 40;
const BELOW: u32 = 48;

pub struct Panels {
    pub title: String,
    /// A sentence below it.
    pub note: &'static str,
    pub legend: &'static [(&'static str, RGBColor)],
    pub x: Axis,
    /// The room of the rows' names, px.
    pub names: u32,
    /// A value of the axis, and its name.
    pub mark: Option<(f64, &'static str)>,
}

impl Panels {
    /// Two panels beside each other, each with its heading, as many rows of them as there are.
    pub fn svg(&self, panels: &[(String, Vec<Row>)]) -> Result<String> {
        let most = panels.iter().map(|(_, rows)| rows.len()).max().unwrap_or(0);
        // A picture is at most as high as a screen.
        let row = ROW.min(720 / most.max(1));
        let height = ABOVE + (row * most) as u32 + BELOW;
        let lines = panels.len().div_ceil(2);
        let names = self.legend.iter();
        let names = names.map(|(name, colour)| ((*name).to_owned(), *colour, 0));
        svg((2 * COLUMN as u32, 84 + height * lines as u32), |root| {
            label(root, &self.title, (28, 24), TITLE, HPos::Left)?;
            legend(root, names, (28, 50))?;
            label(root, self.note, (28, 72), TEXT, HPos::Left)?;
            let (_, below) = root.split_vertically(84);
            for ((head, dots), area) in panels.iter().zip(&below.split_evenly((lines, 2))) {
                label(area, head, (28, 16), HEAD, HPos::Left)?;
                let mut x = self.x.clone();
                x.room = BELOW - 2;
                let plot = rows(area, ABOVE, (&x, self.names), dots)?;
                if let Some((at, name)) = self.mark {
                    plot.mark(area, (at, name, HPos::Center))?;
                }
            }
            Ok(())
        })
    }
}
