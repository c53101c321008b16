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
    let tables = [false, true].map(|guided| table(reports, guided, plain).text());
    format!("\n{}\n{}\n", tables.join("\n"), foot(reports))
}

pub fn markdown(reports: &[&Report]) -> String {
    let bold = |name: &str| format!("**{name}**");
    let tables = [false, true].map(|guided| table(reports, guided, bold).markdown());
    format!("{}\n{}", tables.join("\n"), foot(reports))
}

fn foot(reports: &[&Report]) -> String {
    let rustc = reports.first().map_or("", |report| &report.rustc);
    format!("{MODEL}. {IN_FLASH}. Measured with {rustc}.")
}

/// A row per scene whose arm a hand leads, or of all others, set off from those below it: one per
/// effect, with what is saved and lost without it, and one per other law that the scene compares.
pub fn table(reports: &[&Report], guided: bool, set_off: impl Fn(&str) -> String) -> Table {
    let costs = "scene, − effect, other law|tick, cycles|G474|F405|of its period|tick's code, B|flash, B|RAM, B";
    let figures = if guided {
        "force to start, N|of gravity's alone|tip after release, mm|bound"
    } else {
        "error RMS, mrad|max|bound|of PD's"
    };
    let head = format!("{costs}|{figures}|safety gate");
    let mut table = Table::new(&head.split('|').collect::<Vec<_>>());
    for report in reports.iter().filter(|report| report.is_guided() == guided) {
        let dash = || "–".to_owned();
        let saved = |saved: i64| {
            if saved == 0 { "0".into() } else { signed_change(-saved) }
        };
        let row_of = |name: String, costs: [String; 7], errors: &Errors, pd: &Errors, bound| {
            let share = format!("{:.1} %", 100.0 * errors.figure() / pd.figure());
            let [rms, max] = [errors.rms_rad, errors.max_rad].map(milli);
            let figures = match errors.start_n {
                Some(force) => [format!("{force:.1}"), share, max, bound],
                None => [rms, max, bound, share],
            };
            let gate = std::iter::once(gate(&errors.status));
            std::iter::once(name).chain(costs).chain(figures).chain(gate)
        };
        let row =
            |name, costs, errors, bound| row_of(name, costs, errors, &report.tracking.pd, bound);
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
            // The law for a hand has its parts as numbers of run time: without them it has no other
            // code.
            let [cycles, flash] = [worth.cycles, worth.flash_bytes]
                .map(|saves| if guided { dash() } else { saved(saves) });
            let ram = saved(worth.ram_bytes.cast_signed());
            let costs = [cycles, dash(), dash(), dash(), flash, dash(), ram];
            table.row(row(less, costs, &worth.without, dash()));
        }
        for (law, errors) in &report.tracking.beside {
            let cycles = saved(longest as i64 - errors.tick_cycles as i64);
            let is_cost = |at: usize| at == 0 && !guided;
            let costs = std::array::from_fn(|at| if is_cost(at) { cycles.clone() } else { dash() });
            table.row(row(label(law), costs, errors, dash()));
        }
        let off = &report.tracking_mismatched;
        let further = [
            ("gravity alone", &report.tracking.pd, &report.tracking),
            ("model off", &off.feedforward, off),
            ("model off, gravity alone", &off.pd, off),
        ];
        for (law, errors, of) in further.into_iter().filter(|_| guided) {
            let costs = std::array::from_fn(|_| dash());
            table.row(row_of(law.into(), costs, errors, &of.pd, dash()));
        }
    }
    table
}

fn signed_change(change: i64) -> String {
    let sign = if change < 0 { '−' } else { '+' };
    format!("{sign}{}", thousands(change.unsigned_abs()))
}
