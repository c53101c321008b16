//! All scenes in one table: what a tick costs and how well it tracks, and what each effect is
//! worth.

pub mod first_screen;
pub mod plot;
pub mod render;
pub mod report;

use crate::kit::docs::Page;
use crate::kit::meter::{CLOCK_MHZ, IN_FLASH, MODEL};
use crate::kit::protocol::label;
use crate::kit::table::{Table, thousands};
use crate::studies::scenes::render::{gate, milli};
use crate::studies::scenes::report::{Errors, Report};

pub const PAGE: Page<'_> =
    Page { file: "docs/scenes.md", name: "scenes", command: "cargo xtask demo --all --write-docs" };

pub fn text(reports: &[&Report]) -> String {
    let plain = |name: &str| name.to_uppercase();
    format!("\n{}\n{}\n", table(reports, plain).text(), foot(reports))
}

pub fn markdown(reports: &[&Report]) -> String {
    let bold = |name: &str| format!("**{name}**");
    format!("{}\n{}", table(reports, bold).markdown(), foot(reports))
}

fn foot(reports: &[&Report]) -> String {
    let rustc = reports.first().map_or("", |report| &report.rustc);
    format!("{MODEL}. {IN_FLASH}; the longest. Measured with {rustc}.")
}

/// A row per scene, set off from those below it: one per effect, with what is saved and lost
/// without it, and one per other law that the scene compares.
fn table(reports: &[&Report], set_off: impl Fn(&str) -> String) -> Table {
    let head = "scene, − effect, other law|tick, cycles|G474|F405|of its period|tick's code, B|flash, B|RAM, \
                B|error RMS, mrad|max|bound|of PD's|safety gate";
    let mut table = Table::new(&head.split('|').collect::<Vec<_>>());
    for report in reports {
        let dash = || "–".to_owned();
        let saved = |saved: i64| {
            if saved == 0 { "0".into() } else { signed_change(-saved) }
        };
        let row = |name: String, costs: [String; 7], errors: &Errors, bound: String| {
            let share = 100.0 * errors.rms_rad / report.tracking.pd.rms_rad;
            let [rms, max] = [errors.rms_rad, errors.max_rad].map(milli);
            let gate = gate(&errors.status);
            let rest = [rms, max, bound, format!("{share:.1} %"), gate];
            std::iter::once(name).chain(costs).chain(rest)
        };
        let longest = report.tick["total"].cycles.max;
        let period = f64::from(report.period_us) * CLOCK_MHZ;
        let costs = [
            thousands(longest),
            thousands(report.tick["total"].in_flash[0].max),
            thousands(report.tick["total"].in_flash[1].max),
            format!("{:.1} %", 100.0 * longest as f64 / period),
            thousands(report.tick_bytes),
            thousands(report.flash_bytes),
            thousands(report.ram_bytes),
        ];
        let bound = format!("{:.1}", 1e3 * report.bound_rad);
        let errors = &report.tracking.feedforward;
        table.row(row(set_off(&report.scene), costs, errors, bound));
        for name in &report.named {
            let less = format!("− {name}");
            let Some(worth) = report.effects.iter().find(|worth| worth.effect == *name) else {
                // The scene's law cannot do without it.
                let rest = std::iter::repeat_n(dash(), 11);
                table.row([less, "needed".to_owned()].into_iter().chain(rest));
                continue;
            };
            let [cycles, flash] = [worth.cycles, worth.flash_bytes].map(saved);
            let ram = saved(worth.ram_bytes.cast_signed());
            let costs = [cycles, dash(), dash(), dash(), flash, dash(), ram];
            table.row(row(less, costs, &worth.without, dash()));
        }
        for (law, errors) in &report.tracking.beside {
            let cycles = saved(longest as i64 - errors.tick_cycles as i64);
            let costs = std::array::from_fn(|at| if at == 0 { cycles.clone() } else { dash() });
            table.row(row(label(law), costs, errors, dash()));
        }
    }
    table
}

fn signed_change(change: i64) -> String {
    let sign = if change < 0 { '−' } else { '+' };
    format!("{sign}{}", thousands(change.unsigned_abs()))
}
