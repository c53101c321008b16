//! The robots in print.

use std::collections::BTreeMap;

use serde_json::Value;

use super::Line;
use xtask::kit::rows::Row;
use xtask::kit::table::{Table, thousands};

pub fn markdown(lines: &[Line]) -> String {
    let mut table = Table::new(&[
        "robot",
        "joints",
        "advice",
        "f32 error",
        "core, cycles",
        "engine, cycles",
        "core, B",
        "engine, B",
    ]);
    let mut sources = String::new();
    let mut refused = String::new();
    for line in lines {
        sources += &format!("- `{}`: {}\n", line.name, line.source);
        let Some(report) = &line.report else {
            let reason = line.refused.as_deref().unwrap_or_default();
            refused += &format!("- `{}`: {}\n", line.name, reason.trim());
            continue;
        };
        let number =
            |value: &Value| value.as_f64().map_or("–".to_owned(), |x| format!("{x:.1e}"));
        let figure = |form: &str, of: fn(&Row) -> u64| {
            let row = line.rows.iter().find(|row| row.form == form);
            row.map_or("–".to_owned(), |row| thousands(of(row)))
        };
        table.row([
            line.name.clone(),
            report["sizes"][2].to_string(),
            topics(&report["advice"]),
            number(&report["check"]["f32"]),
            figure("core", |row| row.cycles.max),
            figure("engine", |row| row.cycles.max),
            figure("core", |row| row.code_bytes),
            figure("engine", |row| row.code_bytes),
        ]);
    }
    if refused.is_empty() {
        refused = "None.\n".to_owned();
    }
    let count = lines.iter().filter(|line| line.report.is_some()).count();
    format!(
        "{count} robots agree. The cycles of the engine that `robot-import` estimates without QEMU \
         are off by {}.\n\n{}\n## Refused\n\n{refused}\n## Sources\n\n{sources}",
        estimate(lines),
        table.markdown()
    )
}

/// The errors of the importer's estimates of the engine's cycles.
fn estimate(lines: &[Line]) -> String {
    let errors = lines.iter().filter_map(|line| {
        let row = line.rows.iter().find(|row| row.form == "engine")?;
        let estimated = line.report.as_ref()?["estimated_cycles"].as_f64()?;
        Some(estimated / row.cycles.max as f64 - 1.0)
    });
    let errors: Vec<f64> = errors.collect();
    let squares: f64 = errors.iter().map(|error| error * error).sum();
    let most = errors.iter().fold(0.0, |most: f64, error| most.max(error.abs()));
    let rms = (squares / errors.len().max(1) as f64).sqrt();
    format!("{:.0} % (RMS), {:.0} % at most", 100.0 * rms, 100.0 * most)
}

/// The number of pieces of advice on each topic.
fn topics(advice: &Value) -> String {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for one in advice.as_array().into_iter().flatten() {
        *counts.entry(one["topic"].as_str().unwrap_or_default()).or_default() += 1;
    }
    let words: Vec<String> =
        counts.iter().map(|(topic, count)| format!("{count} {topic}")).collect();
    match words.is_empty() {
        true => "–".to_owned(),
        false => words.join(", "),
    }
}
