//! The picture of the growth: instructions against bodies, both logarithmic.

use super::{ALGORITHMS, Report};
use crate::chart::{self, Axis, HPos, Line, RGBColor};
use crate::error::Result;

/// One colour an algorithm, in the order of [`ALGORITHMS`]; readable to the colour-blind.
const COLOURS: [RGBColor; ALGORITHMS.len()] = [
    RGBColor(27, 80, 162),
    RGBColor(86, 160, 211),
    RGBColor(150, 150, 60),
    RGBColor(230, 145, 0),
    RGBColor(200, 50, 90),
];

/// Where the literature has the crossing.
const LITERATURE: f64 = 9.0;

/// The plot as an SVG.
pub fn svg(report: &Report) -> Result<String> {
    let lines = ALGORITHMS.iter().zip(COLOURS).map(|((name, _), colour)| {
        let points = report.instructions(name).into_iter();
        Line {
            points: points.map(|(n, y)| (n as f64, y as f64)).collect(),
            colour,
            dots: true,
        }
    });
    let lines: Vec<Line> = lines.collect();
    let lengths: Vec<f64> = report.lengths().into_iter().map(|n| n as f64).collect();
    let all = || lines.iter().flat_map(|line| &line.points);
    let ends = |of: fn(&(f64, f64)) -> f64| {
        let [low, high] = [f64::min, f64::max].map(|pick| all().map(of).reduce(pick));
        [low.unwrap_or(1.0), high.unwrap_or(10.0)]
    };
    let [first, last] = ends(|(n, _)| *n);
    let [low, high] = ends(|(_, y)| *y);
    let mut x = Axis::decades("bodies n", [0.9 * first, 1.1 * last], 48);
    x.ticks = lengths;
    let y = Axis::decades("instructions", [0.7 * low, 1.4 * high], 84);
    chart::svg((960, 640), |root| {
        let title = "Instructions of a call against bodies of a chain (core, model at run time, Cortex-M4F)";
        chart::label(root, title, (28, 24), 20, HPos::Left)?;
        let names = ALGORITHMS.map(|(_, name)| name.to_owned());
        chart::legend(root, names.into_iter().zip(COLOURS), (98, 56))?;
        let mut plot = chart::lines(root, 98, [&x, &y], &lines)?;
        let mark = (LITERATURE, " crossing in the literature: 9", HPos::Left);
        chart::mark(root, &mut plot, mark)?;
        if let Some((_, at)) = report.crossing() {
            let here = format!("crossing here: {at:.1} ");
            chart::mark(root, &mut plot, (at, &here, HPos::Right))?;
        }
        Ok(())
    })
}
