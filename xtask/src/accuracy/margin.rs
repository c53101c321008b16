//! What stands around the picture of a robot: legend, yardsticks, shares of full scale.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::drawing::{INK, Outcome, Root, dashed, dot, text, whole};
use super::labels::{Canvas, spread};
use super::picture::{DOT, MEAN, Scene, WORST};
use super::point::Yardstick;
use super::words::digits;

const MEASURE: RGBColor = RGBColor(150, 45, 95);

/// Where the plot lies, and what it shows.
pub struct Seen {
    pub edges: [f64; 4],
    pub full_scale: f64,
    pub low: f64,
    pub high: f64,
}

/// Lines across, named beside the plot; and what share of full scale an error is.
pub fn yardsticks(
    root: &Root<'_>,
    scene: &Scene<'_>,
    seen: &Seen,
    height: impl Fn(f64) -> f64,
    canvas: &mut Canvas,
) -> Outcome {
    let [x0, y0, x1, y1] = seen.edges;
    let exponents = (seen.low / seen.full_scale).log10().ceil() as i32
        ..=(seen.high / seen.full_scale).log10().floor() as i32;
    for exponent in exponents {
        let y = height(seen.full_scale * 10_f64.powi(exponent));
        let tick = vec![whole([x1, y]), whole([x1 + 5.0, y])];
        root.draw(&PathElement::new(tick, INK.stroke_width(1)))?;
        let share = match exponent {
            -2..=0 => format!("{} %", 10_f64.powi(exponent + 2)),
            _ => format!("1e{exponent}"),
        };
        text(root, &share, whole([x1 + 8.0, y]), 12, &INK, HPos::Left)?;
    }
    text(
        root,
        "of full scale",
        whole([x1 + 8.0, y0 - 12.0]),
        12,
        &INK,
        HPos::Left,
    )?;
    let lines: Vec<_> = scene
        .yardsticks
        .iter()
        .filter(|it| it.error_max > seen.low)
        .collect();
    let wished: Vec<f64> = lines.iter().map(|it| height(it.error_max)).collect();
    let heights = spread(&wished, 36.0, [y0 + 16.0, y1 - 16.0]);
    for ((line, from), to) in lines.into_iter().zip(wished).zip(heights) {
        dashed(root, [x0, x1], from, MEASURE)?;
        canvas.line([x0, from], [x1, from]);
        let lead = vec![whole([x1 + 44.0, from]), whole([x1 + 56.0, to])];
        root.draw(&PathElement::new(lead, MEASURE.stroke_width(1)))?;
        let error = format!("off by {} N·m", digits(line.error_max));
        text(
            root,
            yardstick(line),
            whole([x1 + 60.0, to - 8.0]),
            14,
            &MEASURE,
            HPos::Left,
        )?;
        text(
            root,
            &error,
            whole([x1 + 60.0, to + 8.0]),
            13,
            &MEASURE,
            HPos::Left,
        )?;
    }
    Ok(())
}

/// The cause of an error, for a plot.
pub fn yardstick(line: &Yardstick) -> &str {
    match &*line.key {
        "encoder14" => "angles from a 14-bit encoder",
        "inertial1" => "inertias known to 1 %",
        "inertial5" => "inertias known to 5 %",
        "friction10" => "friction known to 10 %",
        other => other,
    }
}

/// What the colours are.
pub fn legend(root: &Root<'_>) -> Outcome {
    let (mut x, y) = (40, 78);
    for (words, colour, hollow) in [
        ("cheapest for its accuracy, by the worst tick", WORST, false),
        ("by the mean over all ticks", MEAN, true),
        ("others", DOT, false),
    ] {
        let fill = if hollow {
            colour.stroke_width(2)
        } else {
            colour.filled()
        };
        dot(root, [f64::from(x), f64::from(y)], 4, fill)?;
        text(root, words, (x + 12, y), 15, &INK, HPos::Left)?;
        x += 40 + (6.9 * words.chars().count() as f64) as i32;
    }
    let bar = vec![(x, y - 8), (x, y + 8)];
    root.draw(&PathElement::new(bar, WORST.mix(0.25).stroke_width(5)))?;
    let tick = vec![(x - 5, y), (x + 5, y)];
    root.draw(&PathElement::new(tick, WORST.stroke_width(1)))?;
    let words = "down to the root mean square, tick at 99 %";
    text(root, words, (x + 12, y), 15, &INK, HPos::Left)
}
