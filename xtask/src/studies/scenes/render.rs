//! A report in print: text for a terminal, Markdown for the docs.

use std::path::Path;

use crate::kit::meter::{CHIPS, CLOCK_MHZ, Cost, IN_FLASH, MODEL};
use crate::kit::protocol::label;
use crate::kit::table::{Column, Table, thousands};
use crate::studies::scenes::guided;
use crate::studies::scenes::report::{Ablation, Errors, JointError, Report, Tracking};

impl Report {
    pub fn text(&self, plot: &Path) -> String {
        let ticks = thousands(self.ticks_measured as u64);
        let mut text = format!(
            "\nCost of a tick, feed-forward, {ticks} ticks ({MODEL})\n{IN_FLASH}\n\n{}",
            self.costs().text()
        );
        let (memory, rustc, qemu) = (self.memory(), &self.rustc, &self.qemu);
        let memory = format!("\n{memory}\n{rustc}; {qemu}; µs at {CLOCK_MHZ} MHz\n");
        if self.is_guided() {
            return text + "\n" + &guided([self].into_iter()).text() + &memory;
        }
        for (what, tracking) in self.trackings() {
            text += &format!("\n{what}\n\n{}", errors_table(tracking).text());
        }
        if !self.effects.is_empty() {
            text += &format!("\n{WORTH}\n\n{}", self.worth().text());
        }
        text += &memory;
        if let Some(gains) = &self.gains {
            let inertia = match gains.pose.ends_with("inertia") {
                true => gains.pose.clone(),
                false => format!("M's diagonal at the pose {}", gains.pose),
            };
            text += &format!(
                "Feedback in every run: ω_n {:.1} rad/s, ζ {:.2}, on {inertia}\n",
                gains.omega_n, gains.zeta
            );
        }
        let (speed, gate, plot) = (self.peak_speed, self.gate(), plot.display());
        let schedule = if self.scene == "wheel_leg_balance" { SCHEDULE } else { "" };
        text + &format!("The reference reaches {speed:.2} rad/s\n{schedule}{gate}Plot: {plot}\n")
    }

    /// For the page.
    pub fn markdown(&self) -> String {
        let percent = |errors: &Errors, tracking: &Tracking| {
            let share = 100.0 * errors.rms_rad / tracking.pd.rms_rad;
            format!("{} ({share:.1} %)", milli(errors.rms_rad))
        };
        let (exact, off) = (&self.tracking, &self.tracking_mismatched);
        let laws: Vec<_> = exact.laws().into_iter().zip(off.laws()).collect();
        let table = Table::of(
            &laws,
            &[
                ("tracking error RMS, mrad", &|((law, _), _)| label(law)),
                ("exact model", &|((_, errors), _)| percent(errors, exact)),
                ("model off", &|(_, (_, errors))| percent(errors, off)),
            ],
        );
        let mut effects: Vec<&Ablation> = self.effects.iter().collect();
        effects.sort_by(|a, b| b.without.rms_rad.total_cmp(&a.without.rms_rad));
        let full = exact.feedforward.rms_rad;
        let worth: [Column<'_, Ablation>; 3] = [
            ("left out of the feed-forward", &|one| one.effect.clone()),
            ("tracking error", &|one| format!("{:.0} ×", one.without.rms_rad / full)),
            ("cycles of the tick", &|one| signed(-one.cycles, "−")),
        ];
        format!(
            include_str!("readme.md"),
            worth = Table::of(effects, &worth).markdown(),
            ticks = thousands(self.ticks_measured as u64),
            model = MODEL,
            in_flash = IN_FLASH,
            costs = self.costs().markdown(),
            errors = table.markdown(),
            memory = self.memory(),
            rustc = self.rustc
        )
    }

    fn worth(&self) -> Table {
        let full = &self.tracking.feedforward;
        let rows = self.effects.iter().map(|worth| {
            let saved = [worth.cycles, worth.flash_bytes, worth.ram_bytes as i64];
            (&*worth.effect, saved, &worth.without)
        });
        let rows: Vec<_> = std::iter::once(("(none dropped)", [0; 3], full)).chain(rows).collect();
        Table::of(
            &rows,
            &[
                ("effect", &|(name, ..)| (*name).to_owned()),
                ("saves cycles", &|(_, [cycles, ..], _)| signed(*cycles, "-")),
                ("flash B", &|(_, [_, flash, _], _)| signed(*flash, "-")),
                ("RAM B", &|(_, [.., ram], _)| signed(*ram, "-")),
                ("error RMS, mrad", &|(.., errors)| milli(errors.rms_rad)),
                ("max", &|(.., errors)| milli(errors.max_rad)),
                ("RMS ×", &|(.., errors)| format!("{:.1}", errors.rms_rad / full.rms_rad)),
                ("safety gate", &|(.., errors)| gate(&errors.status)),
            ],
        )
    }

    /// The status of the safety gate: once, if it is the same in every run.
    fn gate(&self) -> String {
        let runs = self.trackings().into_iter().flat_map(|(what, tracking)| {
            let laws = tracking.laws().into_iter();
            laws.map(move |(law, e)| (format!("{what}, {}", label(law)), words(&e.status)))
        });
        let said: Vec<(String, String)> = runs.collect();
        match said.as_slice() {
            [(_, first), rest @ ..] if rest.iter().all(|(_, status)| status == first) => {
                format!("Safety gate in every run: {first}\n")
            }
            each => {
                each.iter().map(|(run, status)| format!("Safety gate. {run}: {status}\n")).collect()
            }
        }
    }

    fn trackings(&self) -> [(&'static str, &Tracking); 2] {
        [
            ("Tracking error, exact model", &self.tracking),
            (
                "Tracking error, plant's inertias off by up to ±3 %, friction by up to ±10 %",
                &self.tracking_mismatched,
            ),
        ]
    }

    fn costs(&self) -> Table {
        let period = f64::from(self.period_us);
        let microseconds = |cost: &Cost| cost.cycles.max as f64 / CLOCK_MHZ;
        let of_period = format!("of {} ms", period / 1e3);
        let parts = self.tick.iter().skip(1).chain(self.tick.first());
        let parts: Vec<_> = parts.collect();
        let columns: [Column<'_, (&String, &Cost)>; 7] = [
            ("phase", &|(name, _)| (*name).clone()),
            ("insn", &|(_, cost)| thousands(cost.instructions.max)),
            ("cycles", &|(_, cost)| thousands(cost.cycles.max)),
            (CHIPS[0], &|(_, cost)| thousands(cost.in_flash[0].max)),
            (CHIPS[1], &|(_, cost)| thousands(cost.in_flash[1].max)),
            ("µs", &|(_, cost)| format!("{:.2}", microseconds(cost))),
            (&of_period, &|(_, cost)| format!("{:.2} %", 100.0 * microseconds(cost) / period)),
        ];
        Table::of(&parts, &columns)
    }

    fn memory(&self) -> String {
        format!(
            "Flash {} B (of which {} B are the tick's code), RAM {} B, peak stack {} B",
            thousands(self.flash_bytes),
            thousands(self.tick_bytes),
            thousands(self.ram_bytes),
            thousands(self.stack_bytes)
        )
    }
}

/// A row per law: RMS and maximum of each joint and of all, the ratio to PD, and the longest tick.
fn errors_table(tracking: &Tracking) -> Table {
    let joints = tracking.pd.per_joint.len();
    let joints: Vec<String> = (1..=joints).map(|joint| format!("joint {joint}")).collect();
    let names = joints.iter().map(String::as_str);
    let head = std::iter::once("mrad").chain(names).chain(["all", "of PD", "tick cycles"]);
    let mut table = Table::new(&head.collect::<Vec<_>>());
    type Pick = (fn(&Errors) -> f64, fn(&JointError) -> f64);
    let kinds: [(&str, Pick); 2] =
        [("RMS", (|e| e.rms_rad, |j| j.rms_rad)), ("max", (|e| e.max_rad, |j| j.max_rad))];
    for (kind, (all, each)) in kinds {
        for (law, errors) in tracking.laws() {
            let mut cells = vec![format!("{} {kind}", label(law))];
            cells.extend(errors.per_joint.iter().map(|joint| milli(each(joint))));
            cells.push(milli(all(errors)));
            cells.push(format!("{:.1} %", 100.0 * all(errors) / all(&tracking.pd)));
            cells.push(thousands(errors.tick_cycles));
            table.row(cells);
        }
    }
    table
}

/// A number with its sign in print, if that is a minus.
pub fn signed(number: i64, minus: &str) -> String {
    let sign = if number < 0 { minus } else { "" };
    format!("{sign}{}", thousands(number.unsigned_abs()))
}

/// The meaning of the rows of a scene with a schedule, by docs/guide/src/balancing.md.
const SCHEDULE: &str = "Errors are the pitch; PD has the gains of 0.22 m alone. The schedule counts \
     for harder pushes: 125 N in place of 84 N on legs of 0.34 m\n";

/// The caption of the table of effects.
const WORTH: &str = "What each effect is worth: saved in the longest tick, in the tick's code and \
     in the plant's RAM by dropping it, and the error then, exact model";

/// The safety gate's status in a word or two.
pub fn gate(status: &str) -> String {
    let said = words(status);
    let usual = ["the full law", "no fault", "no limit reached"];
    let changed: Vec<&str> = said.split(", ").filter(|part| !usual.contains(part)).collect();
    match changed.as_slice() {
        [] => "silent".into(),
        changed => changed.join(", "),
    }
}

/// The safety gate's status in words, from `mode Full, fault None, limited false`.
fn words(status: &str) -> String {
    let mut text = status.to_owned();
    for (logged, plain) in [
        ("mode Full", "the full law"),
        ("mode Hold", "brought to rest"),
        ("mode Stopped", "stopped on the brake"),
        ("fault None", "no fault"),
        ("limited false", "no limit reached"),
        ("limited true", "torque or its rate limited"),
        ("fault Some(", "fault: "),
        (" }),", ","),
        ("),", ","),
        (" { joint: ", " of joint "),
    ] {
        text = text.replace(logged, plain);
    }
    text
}

pub fn milli(radians: f64) -> String {
    format!("{:.3}", 1e3 * radians)
}

#[cfg(test)]
mod tests {
    use super::words;

    #[test]
    fn a_status_is_written_in_words() {
        let cases = [
            "mode Full, fault None, limited false → the full law, no fault, no limit reached",
            "mode Hold, fault Some(Encoder { joint: 2 }), limited true → brought to rest, fault: \
             Encoder of joint 2, torque or its rate limited",
            "mode Stopped, fault Some(Stale), limited false → stopped on the brake, fault: Stale, \
             no limit reached",
        ];
        for (logged, expected) in cases.iter().filter_map(|case| case.split_once(" → ")) {
            assert_eq!(words(logged), expected);
        }
    }
}
