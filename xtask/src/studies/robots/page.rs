//! docs/robots.md: its text, and whether a row of it is today's.

use std::collections::BTreeMap;

use serde_json::Value;

use super::{Line, PAGE};
use crate::kit::error::{Result, bail, check};
use crate::kit::meter::MODEL;
use crate::kit::rows::Row;
use crate::kit::table::{Table, thousands};

/// Compares a robot's row of two pages; another compiler has other cycles and sizes.
pub fn compare(written: &str, fresh: &str, name: &str, same_compiler: bool) -> Result<()> {
    let [old, new] = [written, fresh].map(|page| cells(page, name));
    let (Some(old), Some(new)) = (old, new) else {
        bail!("{PAGE} has no line of {name}: `cargo xtask robots` rewrites it");
    };
    let measured = if same_compiler { old.len() } else { MEASURED };
    match (0..measured).find(|&i| old.get(i) != new.get(i)) {
        None => Ok(()),
        Some(i) => Err(check!(
            "{PAGE} is out of date: `cargo xtask robots` rewrites it\n  there: {}\n  now:   {}",
            old[i],
            new.get(i).map_or("", |cell| cell)
        )),
    }
}

/// The first cell that is measured.
const MEASURED: usize = 4;

/// The cells of a robot's row.
fn cells<'a>(page: &'a str, name: &str) -> Option<Vec<&'a str>> {
    let mut rows = page.lines().filter(|line| line.starts_with("| "));
    rows.find_map(|row| {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        (cells.first() == Some(&name)).then_some(cells)
    })
}

pub fn page(lines: &[Line], rustc: &str) -> String {
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
        include_str!("page.md"),
        count = count,
        model = MODEL,
        table = table.markdown(),
        refused = refused,
        estimate = estimate(lines),
        sources = sources,
        rustc = rustc,
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

#[cfg(test)]
mod tests {
    use super::compare;

    #[test]
    fn another_compiler_has_other_cycles_alone() {
        let page = |cycles: &str| format!("| so101 | 6 | – | 1e-7 | 2 | {cycles} | 3 | 4 |");
        let (old, new) = (page("990"), page("989"));
        assert!(compare(&old, &old, "so101", true).is_ok());
        assert!(compare(&old, &new, "so101", true).is_err());
        assert!(compare(&old, &new, "so101", false).is_ok());
        assert!(compare(&old, &new, "so100", true).is_err());
    }
}
