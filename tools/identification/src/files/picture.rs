//! The torques of each joint by time as an SVG: measured, by the description, and by what was
//! found.

use std::fmt::Write as _;

use super::report::Trace;

/// The size of a chart, and the most of the picture.
const WIDTH: f64 = 600.0;
const HIGH: f64 = 300.0;
const MOST: f64 = 900.0;
/// The room left of a chart and above and below it.
const LEFT: f64 = 64.0;
const ABOVE: f64 = 46.0;
const BELOW: f64 = 40.0;
/// The lines: name, class and width. A line that lies below another is wider, so that none is
/// hidden.
const LINES: [(&str, &str, u32); 3] =
    [("measured", "a", 5), ("by the description", "b", 2), ("by what was found", "c", 2)];
/// Colours on a light and on a dark page; colour-blind readers can distinguish them.
const STYLE: &str = "text{font:13px system-ui,Helvetica,Arial,sans-serif;fill:#2d323a}path{fill:none}.p{fill:#fff}.g{stroke:#e4e7eb}\
.a{stroke:#b4bac4}.b{stroke:#e69100}.c{stroke:#1b50a2}@media(prefers-color-scheme:dark){text{fill:#dfe3e8}.p{fill:#16191d}\
.g{stroke:#343a42}.a{stroke:#6b7480}.c{stroke:#56a0d3}}";

/// A chart for each joint, from the base outward.
pub fn svg(traces: &[Trace]) -> String {
    let columns = if traces.len() > 3 { 2 } else { 1 };
    let rows = traces.len().div_ceil(columns).max(1);
    let high = (MOST / rows as f64).min(HIGH).floor();
    let [width, height] = [WIDTH * columns as f64, high * rows as f64];
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\"><style>{STYLE}</style><rect class=\"p\" \
         width=\"{width}\" height=\"{height}\"/>\n"
    );
    for (number, trace) in traces.iter().enumerate() {
        let (column, row) = (number % columns, number / columns);
        let at = [WIDTH * column as f64, high * row as f64];
        let _ = writeln!(svg, "<g transform=\"translate({} {})\">", at[0], at[1]);
        chart(&mut svg, trace, high);
        svg += "</g>\n";
    }
    svg + "</svg>\n"
}

fn chart(svg: &mut String, trace: &Trace, high: f64) {
    let lines = [&trace.measured, &trace.before, &trace.after];
    let all = || lines.iter().flat_map(|points| points.iter());
    let ends = |of: fn(&(f64, f64)) -> f64| {
        let [low, high] = [f64::min, f64::max].map(|pick| all().map(of).reduce(pick));
        let (low, high) = (low.unwrap_or(0.0), high.unwrap_or(1.0));
        [low, high.max(low + 1e-9)]
    };
    let (x, y) = (ends(|at| at.0), ends(|at| at.1));
    let bottom = high - BELOW;
    let share = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
    let right = |value: f64| LEFT + (WIDTH - LEFT - 20.0) * share(value, x);
    let up = |value: f64| bottom - (bottom - ABOVE) * share(value, y);
    let mut text = |at: [f64; 2], side: &str, text: &str| {
        let text = text.replace('&', "&amp;").replace('<', "&lt;");
        let [x, y] = at;
        let _ =
            writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{side}\">{text}</text>");
    };
    text([20.0, 16.0], "start", &format!("{}, torque in N·m or N", trace.joint));
    let mut drawn = String::new();
    for (number, (name, class, width)) in LINES.into_iter().enumerate() {
        let left = LEFT + 150.0 * number as f64;
        text([left + 24.0, 36.0], "start", name);
        let _ = writeln!(
            drawn,
            "<path class=\"{class}\" stroke-width=\"{width}\" d=\"M{left} 32h18\"/>"
        );
    }
    for value in ticks(x) {
        text([right(value), bottom + 16.0], "middle", &label(value));
    }
    text([(LEFT + WIDTH) / 2.0, bottom + 32.0], "middle", "s");
    for value in ticks(y) {
        text([LEFT - 8.0, up(value) + 4.0], "end", &label(value));
        let (left, wide) = (LEFT, WIDTH - LEFT - 20.0);
        let _ = writeln!(drawn, "<path class=\"g\" d=\"M{left} {:.1}h{wide}\"/>", up(value));
    }
    for (points, (_, class, width)) in lines.iter().zip(LINES) {
        let places = points.iter().map(|(t, tau)| format!("{:.1} {:.1}", right(*t), up(*tau)));
        let path = places.collect::<Vec<_>>().join("L");
        let _ = writeln!(drawn, "<path class=\"{class}\" stroke-width=\"{width}\" d=\"M{path}\"/>");
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
