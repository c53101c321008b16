//! The picture of all cases: how near to its bound the worst error of each is, and how far beyond it a naive way.

use super::{Row, Suite};
use crate::kit::chart::{self, Axis, BLUE, HPos, ORANGE, RED, Shape, TEXT, TITLE};
use crate::kit::error::Result;

/// px: a row, a column, the names in it, what stands above the rows, and the axis below them.
const ROW: usize = 20;
const COLUMN: i32 = 540;
const NAMES: u32 = 292;
const TOP: u32 = 104;
const BELOW: u32 = 46;

pub fn svg(suite: &Suite) -> Result<String> {
    let half = suite.cases.len().div_ceil(2);
    let height = TOP + (ROW * half) as u32 + BELOW + 4;
    chart::svg((2 * COLUMN as u32, height), |root| {
        let title = format!(
            "{} hard cases: the worst error of each against its bound",
            suite.cases.len()
        );
        chart::label(root, &title, (28, 24), TITLE, HPos::Left)?;
        let entries = [
            ("f32", BLUE),
            ("f64", ORANGE),
            ("a naive way, computed for comparison", RED),
        ];
        let entries = entries.map(|(name, colour)| (name.to_owned(), colour, 5));
        chart::legend(root, entries, (28, 50))?;
        let how = "At the left edge: no error at all, or below a hundredth of the bound. At the right edge: a million times the bound, \
                   or more, or no number.";
        chart::label(root, how, (28, 72), TEXT, HPos::Left)?;
        let mut x = Axis::decades("error / bound", [1e-2, 1e6], BELOW);
        x.ticks = [1e-2, 1.0, 1e2, 1e4, 1e6].into();
        let (left, right) = root.split_horizontally(COLUMN);
        for (area, cases) in [left, right].iter().zip(suite.cases.chunks(half)) {
            let rows = cases.iter().map(|case| {
                let of = |which, shape, colour| {
                    let share = suite.worst(case, which).map(Row::share)?;
                    Some((share, shape, colour, String::new()))
                };
                let dots = [
                    of("f32", Shape::Dot, BLUE),
                    of("f64", Shape::Ring, ORANGE),
                    of("naive", Shape::Cross, RED),
                ];
                let dots = dots.into_iter().flatten().collect();
                (format!("{} {}", case.number, case.name), dots)
            });
            let rows: Vec<_> = rows.collect();
            let mut chart = chart::rows(area, TOP, (&x, NAMES), &rows)?;
            chart::mark(area, &mut chart, (1.0, "bound", HPos::Center))?;
        }
        Ok(())
    })
}
