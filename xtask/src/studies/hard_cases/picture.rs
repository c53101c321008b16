//! The picture of all cases: how near to its bound the worst error of each is, and how far beyond
//! it a naive way.

use super::{Row, Suite};
use crate::kit::chart::{Axis, BLUE, ORANGE, Panels, RED, Shape};
use crate::kit::error::Result;

pub fn svg(suite: &Suite) -> Result<String> {
    let count = suite.cases.len();
    let mut x = Axis::decades("error / bound", [1e-2, 1e6], 0);
    x.ticks = [1e-2, 1.0, 1e2, 1e4, 1e6].into();
    let columns = suite.cases.chunks(count.div_ceil(2)).map(|cases| {
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
        (String::new(), rows.collect())
    });
    Panels {
        title: format!("{count} hard cases: the worst error of each against its bound"),
        note: "At the left edge: no error at all, or below a hundredth of the bound. At the right \
               edge: a million times the bound, or more, or no number.",
        legend: &[("f32", BLUE), ("f64", ORANGE), ("a naive way, computed for comparison", RED)],
        x,
        names: 292,
        mark: Some((1.0, "bound")),
    }
    .svg(&columns.collect::<Vec<_>>())
}
