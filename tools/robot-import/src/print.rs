//! The report of an import as text.

use std::fmt::Write as _;

use crate::check::MOST;
use crate::description::{cut, shortened};
use crate::limits::MOST_CELL;
use crate::report::Report;
use crate::text::visible;

/// A table with columns as wide as their widest cell. A name in it is cut: those of a file have any
/// length.
fn table(rows: &[Vec<String>]) -> String {
    let shown = |row: &Vec<String>| {
        let last = row.len() - 1;
        let cells = row.iter().enumerate();
        let cell = |(k, cell): (usize, &String)| match k == last {
            true => visible(cell),
            false => cut(&visible(cell), MOST_CELL),
        };
        cells.map(cell).collect()
    };
    let rows: Vec<Vec<String>> = rows.iter().map(shown).collect();
    let columns = rows.iter().map(Vec::len).max().unwrap_or_default();
    let cell = |row: &Vec<String>, k: usize| row.get(k).map_or(0, |cell| cell.chars().count());
    let widths: Vec<usize> = (0..columns)
        .map(|k| rows.iter().map(|row| cell(row, k)).max().unwrap_or_default())
        .collect();
    let mut out = String::new();
    for row in &rows {
        let mut line = String::from(" ");
        for (text, width) in row.iter().zip(&widths) {
            let rest = width.saturating_sub(text.chars().count());
            line.extend([" ", text, &" ".repeat(rest), " "]);
        }
        out += line.trim_end();
        out.push('\n');
    }
    out
}

impl Report {
    /// The report as text.
    pub fn text(&self) -> String {
        let [bodies, _, v] = self.sizes;
        let licence = visible(self.licence.as_deref().unwrap_or("no licence stated"));
        let mut out = format!(
            "{} as `{}`: {bodies} bodies, {v} degrees of freedom, on `{}` ({}, {licence})\n\n",
            shortened(&visible(&self.name)),
            self.type_name,
            shortened(&visible(&self.base)),
            visible(&self.file)
        );
        out += &self.joints();
        if !self.loops.is_empty() {
            let _ = writeln!(out, "\nLoops: {}", visible(&self.loops.join(", ")));
        }
        if let Some(motors) = self.coupled_motors {
            let _ = writeln!(
                out,
                "\nCoupled: {motors} motors drive {v} joints through `COUPLING`, a `Transmission`; \
                 its `torque` makes the motors' torques of the joints'."
            );
        }
        if !self.exact.is_empty() || !self.exact_inertias.is_empty() {
            out += "\nRoundings made exact (`--keep-roundings` keeps them):\n";
            let rows: Vec<Vec<String>> = self
                .exact
                .iter()
                .map(|saved| {
                    let numbers = saved
                        .numbers
                        .iter()
                        .map(|(name, text, exact)| format!("{name} {text} = {exact}"));
                    vec![
                        saved.joint.clone(),
                        numbers.collect::<Vec<_>>().join(", "),
                        format!("saves about {} cycles", saved.cycles),
                    ]
                })
                .collect();
            out += &table(&rows);
            for sentence in &self.exact_inertias {
                let _ = writeln!(out, "  {}", visible(sentence));
            }
        }
        out += "\nAdvice:\n";
        if self.advice.is_empty() {
            out += "  none\n";
        }
        let rows: Vec<Vec<String>> = self
            .advice
            .iter()
            .map(|advice| {
                let line = match advice.line {
                    0 => String::new(),
                    line => format!("line {line}"),
                };
                vec![line, advice.name.clone(), advice.text.clone()]
            })
            .collect();
        out += &table(&rows);
        out + &self.checks()
    }

    fn joints(&self) -> String {
        let head = ["joint", "kind", "body", "on", "kg", "range", "N·m or N", "follows"];
        let mut rows = vec![head.map(str::to_owned).to_vec()];
        rows.extend(self.bodies.iter().map(|row| {
            vec![
                row.joint.clone(),
                row.kind.clone(),
                row.body.clone(),
                row.parent.clone(),
                format!("{:.4}", row.mass),
                row.range.map_or("no limits".to_owned(), |[lower, upper]| {
                    format!("{lower:.3} … {upper:.3}")
                }),
                row.effort.map_or(String::new(), |effort| format!("{effort}")),
                row.follows.clone().unwrap_or_default(),
            ]
        }));
        table(&rows)
    }

    fn checks(&self) -> String {
        let check = &self.check;
        let mut out = format!(
            "\nChecked at {} random states; differences are of the largest torque, {:.3} N·m:\n",
            check.states, check.full_scale
        );
        let mut rows = vec![vec![
            "Lagrange's equations of the file's links, f64".to_owned(),
            format!("{:.1e}", check.energy),
            format!("at most {MOST:.0e}"),
        ]];
        rows.push(vec![
            "exact values in place of roundings".to_owned(),
            format!("{:.1e}", check.snapping),
        ]);
        rows.push(vec!["f32 in place of f64".to_owned(), format!("{:.1e}", check.f32)]);
        if let Some(loops) = check.loops {
            rows.push(vec![
                "frames of loops on the file's links, m".to_owned(),
                format!("{loops:.1e}"),
                format!("at most {MOST:.0e}"),
            ]);
        }
        let condition = match check.condition.is_finite() {
            true => format!("{:.1e}", 10.0_f64.powf(check.condition)),
            false => "singular".to_owned(),
        };
        rows.push(vec!["condition number of M, at least".to_owned(), condition]);
        out += &table(&rows);
        if let (Some(cycles), Some(flash)) = (self.estimated_cycles, self.estimated_flash) {
            let _ = writeln!(
                out,
                "\nInverse dynamics by the engine: about {cycles} cycles on a Cortex-M4F and \
                 {flash} B of code (estimated)."
            );
        }
        out
    }
}
