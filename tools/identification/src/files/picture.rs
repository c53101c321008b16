//! Three charts of each joint as an SVG: its torque by time, measured, by the description and by
//! what was found; what is left of it; and its friction by speed.

use std::fmt::Write as _;

use super::report::Trace;

/// The size of a chart, and the most of the picture.
const WIDTH: f64 = 470.0;
const HIGH: f64 = 260.0;
const MOST: f64 = 1500.0;
/// The room beside a chart and above and below it.
const LEFT: f64 = 64.0;
const RIGHT: f64 = 14.0;
const ABOVE: f64 = 46.0;
const BELOW: f64 = 40.0;
/// A line ends where the next point is farther away than this many of the usual distances.
const GAP: f64 = 1.8;
/// Colours on a light and on a dark page; colour-blind readers can distinguish them.
const STYLE: &str = "text{font:13px system-ui,Helvetica,Arial,sans-serif;fill:#2d323a}path{fill:none;stroke-linecap:round}.p{fill:#fff}.g{stroke:#e4e7eb}\
.a{stroke:#b4bac4}.b{stroke:#e69100}.c{stroke:#1b50a2}@media(prefers-color-scheme:dark){text{fill:#dfe3e8}.p{fill:#16191d}\
.g{stroke:#343a42}.a{stroke:#6b7480}.c{stroke:#56a0d3}}";

/// Points with a name, a class and a width; a line that lies below another is wider, so that none
/// is hidden.
struct Series<'a> {
    name: &'a str,
    style: (&'a str, f64),
    points: &'a [(f64, f64)],
    /// Points that are not joined.
    are_dots: bool,
}

/// A row of charts for each joint, from the base outward.
pub fn svg(traces: &[Trace]) -> String {
    let high = (MOST / traces.len().max(1) as f64).min(HIGH).floor();
    let [width, height] = [3.0 * WIDTH, high * traces.len() as f64];
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\"><style>{STYLE}</style><rect class=\"p\" \
         width=\"{width}\" height=\"{height}\"/>\n"
    );
    for (row, trace) in traces.iter().enumerate() {
        let line = |name, style, points| Series { name, style, points, are_dots: false };
        let pairs = trace.measured.iter().zip(&trace.after);
        let left: Vec<_> = pairs.map(|(own, found)| (own.0, own.1 - found.1)).collect();
        let dots = |name, points| Series { are_dots: true, ..line(name, ("a", 3.0), points) };
        let torques = [
            line("measured", ("a", 5.0), &trace.measured),
            line("by the description", ("b", 2.0), &trace.before),
            line("by what was found", ("c", 2.0), &trace.after),
        ];
        let friction = [
            dots("measured", &trace.friction[..]),
            line("by what was found", ("c", 2.0), &trace.curve),
        ];
        for (column, (what, unit, series)) in [
            ("torque in N·m or N", "s", &torques[..]),
            ("residual in N·m or N", "s", &[line("measured − found", ("c", 1.5), &left)]),
            ("friction in N·m or N", "rad/s or m/s", &friction[..]),
        ]
        .into_iter()
        .enumerate()
        {
            let at = [WIDTH * column as f64, high * row as f64];
            let _ = writeln!(svg, "<g transform=\"translate({} {})\">", at[0], at[1]);
            chart(&mut svg, &format!("{}, {what}", trace.joint), unit, series, high);
            svg += "</g>\n";
        }
    }
    svg + "</svg>\n"
}

fn chart(svg: &mut String, title: &str, unit: &str, series: &[Series<'_>], high: f64) {
    let all = || series.iter().flat_map(|series| series.points);
    let ends = |of: fn(&(f64, f64)) -> f64| {
        let [low, high] = [f64::min, f64::max].map(|pick| all().map(of).reduce(pick));
        let (low, high) = (low.unwrap_or(0.0), high.unwrap_or(1.0));
        [low, high.max(low + 1e-9)]
    };
    let (x, y) = (ends(|at| at.0), ends(|at| at.1));
    let (bottom, wide) = (high - BELOW, WIDTH - LEFT - RIGHT);
    let share = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
    let right = |value: f64| LEFT + wide * share(value, x);
    let up = |value: f64| bottom - (bottom - ABOVE) * share(value, y);
    let mut text = |at: [f64; 2], side: &str, text: &str| {
        let text = text.replace('&', "&amp;").replace('<', "&lt;");
        let [x, y] = at;
        let _ =
            writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{side}\">{text}</text>");
    };
    text([20.0, 16.0], "start", title);
    let mut drawn = String::new();
    for value in ticks(x) {
        text([right(value), bottom + 16.0], "middle", &label(value));
    }
    text([LEFT + wide / 2.0, bottom + 32.0], "middle", unit);
    for value in ticks(y) {
        text([LEFT - 8.0, up(value) + 4.0], "end", &label(value));
        let _ = writeln!(drawn, "<path class=\"g\" d=\"M{LEFT} {:.1}h{wide}\"/>", up(value));
    }
    for (number, Series { name, style: (class, width), points, are_dots }) in
        series.iter().enumerate()
    {
        let left = 20.0 + 148.0 * number as f64;
        text([left + 24.0, 36.0], "start", name);
        let mut path = format!("M{left} 32h18");
        let mut steps: Vec<f64> = points.windows(2).map(|pair| pair[1].0 - pair[0].0).collect();
        steps.sort_by(f64::total_cmp);
        let longest = GAP * steps.get(steps.len() / 2).copied().unwrap_or(0.0);
        let mut last = f64::NEG_INFINITY;
        for (t, value) in *points {
            let starts = *are_dots || t - last > longest;
            let _ = write!(
                path,
                "{}{:.1} {:.1}",
                if starts { 'M' } else { 'L' },
                right(*t),
                up(*value)
            );
            path += if *are_dots { "h0" } else { "" };
            last = *t;
        }
        let _ = writeln!(drawn, "<path class=\"{class}\" stroke-width=\"{width}\" d=\"{path}\"/>");
    }
    *svg += &drawn;
}

/// Some four multiples of one, two or five times a power of ten.
fn ticks([low, high]: [f64; 2]) -> impl Iterator<Item = f64> {
    let rough = (high - low) / 4.0;
    let ten = 10_f64.powf(rough.log10().floor());
    let steps = [1.0, 2.0, 5.0].map(|digit| digit * ten);
    let step = steps.into_iter().find(|step| *step >= rough).unwrap_or(10.0 * ten);
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    (first..=last).map(move |number| number as f64 * step)
}

/// Rounding errors are none of the value's digits.
fn label(value: f64) -> String {
    ((value * 1e6).round() / 1e6).to_string()
}
