//! Proven and observed errors as an SVG, a row for each joint.

use std::fmt::Write as _;

use crate::certificate::Certificate;
use crate::function::Function;

/// Colours on a light and on a dark page; colour-blind readers can distinguish them.
const STYLE: &str = "text{font:12px system-ui,Helvetica,Arial,sans-serif;fill:#2d323a}.t{font-size:14px}.p{fill:#fff}.g{stroke:#e4e7eb}.l{stroke:#b4bac4;stroke-width:2}\
.a{fill:#1b50a2}.b{fill:#e69100}@media (prefers-color-scheme: dark){text{fill:#e6edf3}.p{fill:#0d1117}.g{stroke:#2a313c}.l{stroke:#6b7480}.a{fill:#4f93ff}.b{fill:#f0a020}}";

const ROW: f64 = 19.0;
const TOP: f64 = 66.0;
const LEFT: f64 = 110.0;
const WIDE: f64 = 340.0;
const GAP: f64 = 40.0;

/// The certificates of the first two functions side by side, a group of rows for each robot.
pub fn svg(certificates: &[Certificate]) -> String {
    let of = |function| {
        certificates
            .iter()
            .filter(move |one| one.function == function)
    };
    let mut panels: Vec<Function> = Vec::new();
    for one in certificates {
        if !panels.contains(&one.function) && panels.len() < 2 {
            panels.push(one.function);
        }
    }
    let rows_of = |function: &Function| of(*function).map(|one| one.outputs.len() + 1).sum();
    let rows: usize = panels.iter().map(rows_of).max().unwrap_or(0);
    let (width, height) = (
        LEFT + 2.0 * WIDE + GAP + 20.0,
        TOP + ROW * rows as f64 + 46.0,
    );
    let positive = certificates
        .iter()
        .flat_map(|one| &one.outputs)
        .flat_map(|output| [output.bound, output.observed])
        .filter(|x| *x > 0.0);
    let (least, most) = positive.fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
    let (first, last) = (least.log10().floor(), most.log10().ceil());
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\"><style>{STYLE}</style>\
         <rect class=\"p\" width=\"{width}\" height=\"{height}\"/>\n\
         <circle class=\"a\" cx=\"{LEFT}\" cy=\"16\" r=\"4\"/><text font-size=\"12\" x=\"{}\" y=\"20\">worst error observed</text>\
         <circle class=\"b\" cx=\"{}\" cy=\"16\" r=\"4\"/><text font-size=\"12\" x=\"{}\" y=\"20\">proven bound</text>\n",
        LEFT + 10.0,
        LEFT + 170.0,
        LEFT + 180.0,
    );
    for (panel, function) in panels.into_iter().enumerate() {
        let left = LEFT + (WIDE + GAP) * panel as f64;
        let (title, unit, part) = match function {
            Function::Rnea => ("Inverse dynamics", "N·m", "joint"),
            Function::Gravity => ("Gravity alone", "N·m", "joint"),
            one if one.is_matrix() => ("Inertia matrix", "kg·m²", "entry"),
            Function::Core => ("Inverse dynamics of the core", "N·m", "joint"),
            one if one.matrix().is_some() => ("Biases and inertia matrix", "SI units", "result"),
            _ => ("Inverse dynamics with a loop", "N·m", "joint"),
        };
        let _ = writeln!(
            svg,
            "<text class=\"t\" font-size=\"14\" x=\"{left}\" y=\"46\">{title}</text>"
        );
        let across = |x: f64| left + WIDE * (x.log10() - first) / (last - first);
        let bottom = TOP + ROW * rows as f64;
        for power in first as i32..=last as i32 {
            let x = across(10_f64.powi(power));
            let _ = writeln!(svg, "<path class=\"g\" d=\"M{x:.1} {TOP}V{bottom}\"/>");
            if power % 2 == 0 {
                let _ = writeln!(
                    svg,
                    "<text font-size=\"12\" x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">1e{power}</text>",
                    bottom + 16.0
                );
            }
        }
        let _ = writeln!(
            svg,
            "<text font-size=\"12\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">{unit}</text>",
            left + WIDE / 2.0,
            bottom + 36.0
        );
        let mut y = TOP;
        for one in of(function) {
            if panel == 0 {
                let _ = writeln!(
                    svg,
                    "<text font-size=\"12\" x=\"8\" y=\"{}\">{}</text>",
                    y + 7.0,
                    one.robot
                );
            }
            for output in &one.outputs {
                y += ROW;
                if panel == 0 {
                    let _ = writeln!(
                        svg,
                        "<text font-size=\"12\" x=\"{}\" y=\"{}\" text-anchor=\"end\">{part} {}</text>",
                        LEFT - 12.0,
                        y + 4.0,
                        output.name
                    );
                }
                if output.observed > 0.0 {
                    let [a, b] = [output.observed, output.bound].map(across);
                    let _ = writeln!(
                        svg,
                        "<path class=\"l\" d=\"M{a:.1} {y}H{b:.1}\"/><circle class=\"a\" cx=\"{a:.1}\" cy=\"{y}\" r=\"4\"/><circle class=\"b\" cx=\"{b:.1}\" cy=\"{y}\" r=\"4\"/>"
                    );
                }
            }
            y += ROW;
        }
    }
    svg + "</svg>\n"
}
