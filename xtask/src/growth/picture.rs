//! Pictures of what grows with the number of bodies, both logarithmic.

use super::{ALGORITHMS, Report};
use crate::chart::{self, Axis, HPos, Line};
use crate::error::Result;

/// Where the literature has the crossing.
const LITERATURE: f64 = 9.0;

/// A name and its costs by number of bodies.
pub type Curve = (&'static str, Vec<(usize, u64)>);
/// A number of bodies to mark, with a text at one of its sides.
type Mark = (f64, String, HPos);

/// The plot as an SVG.
pub fn svg(report: &Report) -> Result<String> {
    let curves = ALGORITHMS.map(|(name, title)| (title, report.instructions(name)));
    let literature = " crossing in the literature: 9".to_owned();
    let mut marks = vec![(LITERATURE, literature, HPos::Left)];
    if let Some((_, at)) = report.crossing() {
        marks.push((at, format!("crossing here: {at:.1} "), HPos::Right));
    }
    let title =
        "Instructions of a call against bodies of a chain (core, model at run time, Cortex-M4F)";
    curves_svg(title, "instructions", &curves, &marks)
}

/// Curves of some costs as an SVG, a legend of up to five a line above them.
pub fn curves_svg(
    title: &str,
    cost: &'static str,
    curves: &[Curve],
    marks: &[Mark],
) -> Result<String> {
    let lines = curves
        .iter()
        .zip(chart::COLOURS)
        .map(|((_, costs), colour)| Line {
            points: costs.iter().map(|(n, y)| (*n as f64, *y as f64)).collect(),
            colour,
            dots: true,
        });
    let lines: Vec<Line> = lines.collect();
    let longest = lines.iter().max_by_key(|line| line.points.len());
    let lengths = longest.map_or_else(Vec::new, |line| {
        line.points.iter().map(|(n, _)| *n).collect()
    });
    let all = || lines.iter().flat_map(|line| &line.points);
    let ends = |of: fn(&(f64, f64)) -> f64| {
        let [low, high] = [f64::min, f64::max].map(|pick| all().map(of).reduce(pick));
        [low.unwrap_or(1.0), high.unwrap_or(10.0)]
    };
    let [first, last] = ends(|(n, _)| *n);
    let [low, high] = ends(|(_, y)| *y);
    let mut x = Axis::decades("bodies n", [0.9 * first, 1.1 * last], 48);
    x.ticks = lengths;
    let y = Axis::decades(cost, [0.7 * low, 1.4 * high], 84);
    chart::svg((960, 640), |root| {
        chart::label(root, title, (28, 24), 20, HPos::Left)?;
        let names = curves
            .iter()
            .map(|(name, _)| (*name).to_owned())
            .zip(chart::COLOURS);
        let names: Vec<_> = names.collect();
        for (row, names) in names.chunks(5).enumerate() {
            chart::legend(root, names.iter().cloned(), (98, 56 + 22 * row as i32))?;
        }
        let mut plot = chart::lines(root, 98, [&x, &y], &lines)?;
        for (at, text, side) in marks {
            chart::mark(root, &mut plot, (*at, text, *side))?;
        }
        Ok(())
    })
}
