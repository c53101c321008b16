//! A report in print: text for a terminal, Markdown for the docs.

use std::path::Path;

use crate::protocol::in_print;
use crate::report::{Errors, MODEL, Report, Tracking};
use crate::table::{Table, thousands};

/// The clock of the STM32F405 in MHz, so cycles per µs.
pub const CLOCK_MHZ: f64 = 168.0;

impl Report {
    /// For a terminal.
    pub fn text(&self, plot: &Path) -> String {
        let mut text = format!(
            "\nCost of a tick, feed-forward, {} ticks ({MODEL})\n\n{}",
            thousands(self.ticks_measured as u64),
            self.costs().text()
        );
        for (what, tracking) in self.trackings() {
            text += &format!("\n{what}\n\n{}", errors_table(tracking).text());
        }
        if !self.effects.is_empty() {
            text += &format!("\n{WORTH}\n\n{}", self.worth().text());
        }
        text += &format!("\n{}\n{}\n", self.memory(), self.provenance());
        text += &self.feedback();
        text += &self.gate();
        text + &format!("Plot: {}\n", plot.display())
    }

    /// For the README.
    pub fn markdown(&self) -> String {
        let mut text = format!(
            "Cost of a tick with feed-forward, {} ticks ({MODEL}):\n\n{}",
            thousands(self.ticks_measured as u64),
            self.costs().markdown()
        );
        let mut table = Table::new(&["tracking error RMS, mrad", "exact model", "model off"]);
        let percent = |errors: &Errors, pd: &Errors| {
            format!(
                "{} ({:.1} %)",
                milli(errors.rms_rad),
                100.0 * errors.rms_rad / pd.rms_rad
            )
        };
        let (exact, off) = (&self.tracking, &self.tracking_mismatched);
        for ((law, errors), (_, errors_off)) in exact.laws().into_iter().zip(off.laws()) {
            table.row([
                in_print(law),
                percent(errors, &exact.pd),
                percent(errors_off, &off.pd),
            ]);
        }
        text += &format!(
            "\nIn brackets the share of PD's error. \"Model off\": the plant's inertias differ by \
             up to ±3 % and its friction by up to ±10 %.\n\n{}",
            table.markdown()
        );
        text + &format!("\n{}.\nMeasured with {}.\n", self.memory(), self.rustc)
    }

    /// A row per effect.
    fn worth(&self) -> Table {
        let mut table = Table::new(&[
            "effect",
            "saves cycles",
            "flash B",
            "RAM B",
            "error RMS, mrad",
            "max",
            "RMS ×",
            "safety gate",
        ]);
        let full = &self.tracking.feedforward;
        let row = |name: &str, saved: [i64; 3], errors: &Errors| {
            let saved = saved.map(|n| {
                if n < 0 {
                    format!("-{}", thousands(n.unsigned_abs()))
                } else {
                    thousands(n as u64)
                }
            });
            std::iter::once(name.to_owned())
                .chain(saved)
                .chain([
                    milli(errors.rms_rad),
                    milli(errors.max_rad),
                    format!("{:.1}", errors.rms_rad / full.rms_rad),
                    gate(&errors.status),
                ])
                .collect::<Vec<_>>()
        };
        table.row(row("(none dropped)", [0; 3], full));
        for worth in &self.effects {
            let saved = [worth.cycles, worth.flash_bytes, worth.ram_bytes as i64];
            table.row(row(&worth.effect, saved, &worth.without));
        }
        table
    }

    /// What the laws have in common.
    fn feedback(&self) -> String {
        let gains = self.gains.as_ref().map_or_else(String::new, |gains| {
            format!(
                "Feedback in every run: ω_n {:.1} rad/s, ζ {:.2}, on M's diagonal at the pose {}\n",
                gains.omega_n, gains.zeta, gains.pose
            )
        });
        format!(
            "{gains}The reference reaches {:.2} rad/s\n",
            self.peak_speed
        )
    }

    /// What the safety gate said: once, if it said the same of every run.
    fn gate(&self) -> String {
        let said: Vec<(String, String)> =
            self.trackings()
                .into_iter()
                .flat_map(|(what, tracking)| {
                    tracking.laws().into_iter().map(move |(law, e)| {
                        (format!("{what}, {}", in_print(law)), words(&e.status))
                    })
                })
                .collect();
        match said.as_slice() {
            [(_, first), rest @ ..] if rest.iter().all(|(_, status)| status == first) => {
                format!("Safety gate in every run: {first}\n")
            }
            each => each
                .iter()
                .map(|(run, status)| format!("Safety gate. {run}: {status}\n"))
                .collect(),
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
        let mut table = Table::new(&[
            "phase",
            "insn min",
            "median",
            "max",
            "cycles min",
            "median",
            "max",
            "µs median",
            "µs max",
            "of the work",
            &format!("of {} ms", f64::from(self.period_us) / 1e3),
        ]);
        let whole = self.tick.total.cycles.median as f64;
        for (name, cost) in self.tick.phases() {
            let (i, c) = (cost.instructions, cost.cycles);
            let counts = [i.min, i.median, i.max, c.min, c.median, c.max].map(thousands);
            let times = [c.median, c.max].map(|n| format!("{:.2}", n as f64 / CLOCK_MHZ));
            let (median, longest) = (c.median as f64, c.max as f64);
            let shares = [
                format!("{:.1} %", 100.0 * median / whole),
                format!(
                    "{:.2} %",
                    100.0 * longest / CLOCK_MHZ / f64::from(self.period_us)
                ),
            ];
            table.row(
                std::iter::once(name.to_owned())
                    .chain(counts)
                    .chain(times)
                    .chain(shares),
            );
        }
        table
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

    fn provenance(&self) -> String {
        format!("{}; {}; µs at {CLOCK_MHZ} MHz", self.rustc, self.qemu)
    }
}

/// A row per law: RMS and maximum of each joint and of all, the ratio to PD, and the longest tick.
fn errors_table(tracking: &Tracking) -> Table {
    let joints = tracking.pd.per_joint.len();
    let joint_names: Vec<String> = (1..=joints).map(|joint| format!("joint {joint}")).collect();
    let head: Vec<&str> = std::iter::once("mrad")
        .chain(joint_names.iter().map(String::as_str))
        .chain(["all", "of PD", "tick cycles"])
        .collect();
    let mut table = Table::new(&head);
    type Pick = fn(&Errors) -> (f64, Vec<f64>);
    let kinds: [(&str, Pick); 2] = [
        ("RMS", |e| {
            (e.rms_rad, e.per_joint.iter().map(|j| j.rms_rad).collect())
        }),
        ("max", |e| {
            (e.max_rad, e.per_joint.iter().map(|j| j.max_rad).collect())
        }),
    ];
    for (kind, pick) in kinds {
        let (pd, _) = pick(&tracking.pd);
        for (law, errors) in tracking.laws() {
            let (all, each) = pick(errors);
            table.row(
                std::iter::once(format!("{} {kind}", in_print(law)))
                    .chain(each.into_iter().map(milli))
                    .chain([milli(all), format!("{:.1} %", 100.0 * all / pd)])
                    .chain([thousands(errors.tick_cycles)]),
            );
        }
    }
    table
}

/// What the table of effects shows.
const WORTH: &str = "What each effect is worth: saved in the longest tick, in the tick's code and in the plant's RAM \
     by dropping it, and the error then, exact model";

/// The safety gate's status in a word or two.
pub fn gate(status: &str) -> String {
    let said = words(status);
    let changed = said
        .split(", ")
        .filter(|part| !["the full law", "no fault", "no limit reached"].contains(part));
    let changed: Vec<&str> = changed.collect();
    if changed.is_empty() {
        "silent".into()
    } else {
        changed.join(", ")
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
    fn a_status_is_told_in_words() {
        for (logged, told) in [
            (
                "mode Full, fault None, limited false",
                "the full law, no fault, no limit reached",
            ),
            (
                "mode Hold, fault Some(Encoder { joint: 2 }), limited true",
                "brought to rest, fault: Encoder of joint 2, torque or its rate limited",
            ),
            (
                "mode Stopped, fault Some(Stale), limited false",
                "stopped on the brake, fault: Stale, no limit reached",
            ),
            (
                "mode Stopped, fault Some(External), limited false",
                "stopped on the brake, fault: External, no limit reached",
            ),
        ] {
            assert_eq!(words(logged), told);
        }
    }
}
