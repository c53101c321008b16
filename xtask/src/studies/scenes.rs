//! All scenes: what a tick costs and how well it tracks, and what each effect is worth.

pub mod plot;
pub mod render;
pub mod report;

use crate::kit::docs::Page;
use crate::kit::meter::{CLOCK_MHZ, IN_FLASH, MODEL};
use crate::kit::protocol::label;
use crate::kit::table::{Column, Table, thousands};
use crate::studies::scenes::render::{milli, signed};
use crate::studies::scenes::report::{Errors, Report};

pub const PAGE: Page<'_> =
    Page { file: "docs/scenes.md", name: "scenes", command: "cargo xtask demo --all --write-docs" };
/// The cost of a tick of the default scene.
pub const TICK: Page<'_> =
    Page { file: PAGE.file, name: "demo", command: "cargo xtask demo --write-docs" };

pub fn text(reports: &[&Report]) -> String {
    let tables = tables(reports, str::to_uppercase).map(|table| table.text());
    format!("\n{}\n{}\n", tables.join("\n"), foot(reports))
}

pub fn markdown(reports: &[&Report]) -> String {
    let tables = tables(reports, |name| format!("**{name}**")).map(|table| table.markdown());
    format!("{}\n{}", tables.join("\n"), foot(reports))
}

fn foot(reports: &[&Report]) -> String {
    let rustc = reports.first().map_or("", |report| &report.rustc);
    format!("{MODEL}. {IN_FLASH}. Measured with {rustc}.")
}

fn tables(reports: &[&Report], set_off: fn(&str) -> String) -> [Table; 3] {
    let led = reports.iter().filter(|report| report.is_guided());
    [scenes(reports, set_off), worth(reports), guided(led.copied())]
}

/// A row for each scene.
fn scenes(reports: &[&Report], set_off: fn(&str) -> String) -> Table {
    let total = |report: &&Report| report.tick["total"];
    let longest = |report: &&Report| total(report).cycles.max;
    let error =
        |report: &&Report, text: String| if report.is_guided() { "–".into() } else { text };
    let columns: [Column<'_, &Report>; 10] = [
        ("scene", &|report| set_off(&report.scene)),
        ("tick, cycles", &|report| thousands(longest(report))),
        ("G474", &|report| thousands(total(report).in_flash[0].max)),
        ("of its period", &|report| {
            let period = f64::from(report.period_us) * CLOCK_MHZ;
            format!("{:.1} %", 100.0 * longest(report) as f64 / period)
        }),
        ("tick's code, B", &|report| thousands(report.tick_bytes)),
        ("flash, B", &|report| thousands(report.flash_bytes)),
        ("RAM, B", &|report| thousands(report.ram_bytes)),
        ("error RMS, mrad", &|report| error(report, milli(report.tracking.feedforward.rms_rad))),
        ("bound", &|report| format!("{:.1}", 1e3 * report.bound_rad)),
        ("of PD's", &|report| error(report, format!("{:.1} %", 100.0 * report.tracking.ratio()))),
    ];
    Table::of(reports, &columns)
}

/// A row for each effect and each other law of a scene: what is saved without it, and the error.
fn worth(reports: &[&Report]) -> Table {
    let mut table = Table::new(&["scene", "cycles", "tick's code, B", "error RMS, mrad"]);
    for report in reports.iter().filter(|report| !report.is_guided()) {
        let full = &report.tracking.feedforward;
        for worth in &report.effects {
            let saved = [worth.cycles, worth.flash_bytes];
            let cells = saved.map(|saved| signed(-saved, "−"));
            let name = format!("{} − {}", report.scene, worth.effect);
            let cells = std::iter::once(name).chain(cells);
            table.row(cells.chain([milli(worth.without.rms_rad)]));
        }
        for (law, errors) in &report.tracking.beside {
            let cycles = errors.tick_cycles as i64 - full.tick_cycles as i64;
            let name = format!("{}, {}", report.scene, label(law));
            table.row([name, signed(cycles, "−"), "–".into(), milli(errors.rms_rad)]);
        }
    }
    table
}

/// The laws of scenes whose arm a hand leads.
pub fn guided<'a>(reports: impl Iterator<Item = &'a Report>) -> Table {
    let head = ["law", "force to start, N", "of gravity's alone", "tip after release, mm"];
    let mut table = Table::new(&head);
    for report in reports {
        let (exact, off) = (&report.tracking, &report.tracking_mismatched);
        let mut row = |name: String, errors: &Errors, alone: &Errors| {
            let force = format!("{:.1}", errors.figure());
            let share = format!("{:.1} %", 100.0 * errors.figure() / alone.figure());
            table.row([name, force, share, milli(errors.max_rad)]);
        };
        row(report.scene.clone(), &exact.feedforward, &exact.pd);
        for worth in &report.effects {
            row(format!("− {}", worth.effect), &worth.without, &exact.pd);
        }
        for (law, errors) in &exact.beside {
            row(label(law), errors, &exact.pd);
        }
        row("gravity alone".into(), &exact.pd, &exact.pd);
        row("model off".into(), &off.feedforward, &off.pd);
        row("model off, gravity alone".into(), &off.pd, &off.pd);
    }
    table
}
