//! All scenes in one table: what a tick costs and how well it tracks, and what each effect is worth.

use crate::docs::Page;
use crate::protocol::in_print;
use crate::render::{gate, milli};
use crate::report::{Errors, MODEL, Report, Worth};
use crate::table::{Table, thousands};

/// Where the table stands.
pub const PAGE: Page = Page {
    file: "docs/scenes.md",
    name: "scenes",
    command: "cargo xtask demo --all --write-docs",
};

/// For a terminal.
pub fn text(reports: &[&Report]) -> String {
    let plain = |name: &str| name.to_uppercase();
    format!("\n{}\n{}\n", table(reports, plain).text(), foot(reports))
}

/// For the docs.
pub fn markdown(reports: &[&Report]) -> String {
    let bold = |name: &str| format!("**{name}**");
    format!("{}\n{}", table(reports, bold).markdown(), foot(reports))
}

fn foot(reports: &[&Report]) -> String {
    let rustc = reports.first().map_or("", |report| &report.rustc);
    format!("{MODEL}. Measured with {rustc}.")
}

/// A row per scene, set off from those below it: one per effect, with what is saved and lost without it, and one
/// per other law that the scene compares.
fn table(reports: &[&Report], set_off: impl Fn(&str) -> String) -> Table {
    let mut table = Table::new(&[
        "scene, − effect, other law",
        "tick, cycles",
        "of its period",
        "tick's code, B",
        "flash, B",
        "RAM, B",
        "error RMS, mrad",
        "max",
        "bound",
        "of PD's",
        "safety gate",
    ]);
    for report in reports {
        table.row(whole(report, set_off(&report.scene)));
        for name in &report.named {
            let worth = report.effects.iter().find(|worth| worth.effect == *name);
            table.row(match worth {
                Some(worth) => without(worth, report),
                None => needed(name),
            });
        }
        for (law, errors) in &report.tracking.beside {
            table.row(other(law, errors, report));
        }
    }
    table
}

fn whole(report: &Report, name: String) -> Vec<String> {
    let (errors, longest) = (&report.tracking.feedforward, report.tick.total.cycles.max);
    let period = f64::from(report.period_us) * crate::render::CLOCK_MHZ;
    vec![
        name,
        thousands(longest),
        format!("{:.1} %", 100.0 * longest as f64 / period),
        thousands(report.tick_bytes),
        thousands(report.flash_bytes),
        thousands(report.ram_bytes),
        milli(errors.rms_rad),
        milli(errors.max_rad),
        format!("{:.1}", 1e3 * report.bound_rad),
        format!("{:.1} %", 100.0 * report.tracking.ratio()),
        gate(&errors.status),
    ]
}

fn without(worth: &Worth, report: &Report) -> Vec<String> {
    let mut row = lesser(
        format!("− {}", worth.effect),
        worth.cycles,
        &worth.without,
        report,
    );
    row[3] = less(worth.flash_bytes);
    row[5] = less(worth.ram_bytes.cast_signed());
    row
}

/// Another law than the scene's feed-forward.
fn other(law: &str, errors: &Errors, report: &Report) -> Vec<String> {
    let saved = report.tick.total.cycles.max as i64 - errors.tick_cycles as i64;
    lesser(in_print(law), saved, errors, report)
}

/// A law that is not the one to sell, by its name and the cycles that it saves.
fn lesser(name: String, saved: i64, errors: &Errors, report: &Report) -> Vec<String> {
    let dash = || "–".to_owned();
    vec![
        name,
        less(saved),
        dash(),
        dash(),
        dash(),
        dash(),
        milli(errors.rms_rad),
        milli(errors.max_rad),
        dash(),
        format!(
            "{:.1} %",
            100.0 * errors.rms_rad / report.tracking.pd.rms_rad
        ),
        gate(&errors.status),
    ]
}

/// What is saved, as a change.
fn less(saved: i64) -> String {
    match saved {
        0 => "0".to_owned(),
        1.. => format!("−{}", thousands(saved.unsigned_abs())),
        _ => format!("+{}", thousands(saved.unsigned_abs())),
    }
}

/// An effect that the scene's law cannot do without.
fn needed(name: &str) -> Vec<String> {
    let mut row = vec![format!("− {name}"), "needed".to_owned()];
    row.extend(std::iter::repeat_n("–".to_owned(), 9));
    row
}
