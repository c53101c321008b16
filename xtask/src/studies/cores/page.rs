//! The tables of `docs/boards.md`.

use super::list::{CORES, Core};
use super::run::{Replayed, Row, Torques};
use super::{Report, boards};
use crate::kit::docs::Page;
use crate::kit::error::{Result, bail, check};
use crate::kit::table::{Column, Table, thousands};

pub const PAGE: Page<'_> =
    Page { file: "docs/boards.md", name: "cores", command: "cargo xtask cores --write-docs" };

/// A core's results, and what it is.
type Line<'a> = (&'a Row, &'a Core);

impl Report {
    pub fn markdown(&self) -> Result<String> {
        let mut text = String::from(
            "The torques of every tick have the same bits on every core and on the host:\n\n",
        );
        for Torques { scene, ticks, digest } in &self.torques {
            let ticks = thousands(*ticks as u64);
            text += &format!("- `{scene}`, {ticks} ticks: digest `{digest}`\n");
        }
        let both: Vec<(&Row, &Core)> = self
            .rows
            .iter()
            .map(|row| {
                let core = CORES.iter().find(|core| core.name == row.core);
                core.map(|core| (row, core)).ok_or_else(|| check!("there is no core {}", row.core))
            })
            .collect::<Result<_>>()?;
        let scenes: Vec<&str> = self.torques.iter().map(|torques| &*torques.scene).collect();
        let [small, large] = scenes[..] else {
            bail!("two scenes were expected: {scenes:?}");
        };
        let of = |index: usize, what: fn(&Replayed) -> Option<u64>| {
            move |(row, _): &Line<'_>| what(&row.scenes[index]).map_or("–".into(), thousands)
        };
        let columns: [Column<'_, Line<'_>>; 8] = [
            ("core", &|(row, _)| row.core.into()),
            ("QEMU machine", &|(_, core)| format!("`{}`", core.machine)),
            ("target", &|(_, core)| format!("`{}`", core.target)),
            ("flags", &|(_, core)| core.shown_flags()),
            (&format!("stack written, `{small}`, B"), &of(0, |scene| Some(scene.stack))),
            ("stack, bound", &of(0, |scene| scene.bound)),
            (&format!("stack written, `{large}`, B"), &of(1, |scene| Some(scene.stack))),
            ("stack, bound", &of(1, |scene| scene.bound)),
        ];
        text += &format!("\n{}", Table::of(&both, &columns).markdown());
        text += "\nThe images of real boards, without a simulation:\n\n";
        text += &boards::markdown(&self.boards);
        text += &self.placed.text();
        text += &format!("\nMeasured with {}.\n", self.rustc);
        Ok(text)
    }
}

/// A page without the rows of other cores, without the rows of boards whose target is missing, and
/// without padding.
pub fn rows_of(page: &str, names: &[&str], missing: &[&str]) -> String {
    let is_missing = |line: &&str| {
        let mut targets = missing.iter().map(|target| format!("`{target}`"));
        line.starts_with("| `") && targets.any(|target| line.contains(&target))
    };
    let is_other = |line: &&str| {
        let mut others = CORES.iter().filter(|core| !names.contains(&core.name));
        others.any(|core| line.starts_with(&format!("| {} ", core.name)))
    };
    let squeezed = |line: &str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let is_rule = line.starts_with("| ---");
        let text = if is_rule { "| --- |".into() } else { words.join(" ") };
        text + "\n"
    };
    page.lines()
        .filter(|line| !line.is_empty() && !line.starts_with("<!--"))
        .filter(|line| !is_other(line) && !is_missing(line))
        .map(squeezed)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::rows_of;

    #[test]
    fn cores_that_did_not_run_are_not_compared() {
        let page = "Words.\n\n| core        | code |\n| ----------- | ---: |\n| Cortex-M33  |    7 \
            |\n| Cortex-M0   |  512 |\n";
        let fresh =
            "Words.\n\n| core       | code |\n| ---------- | ---: |\n| Cortex-M33 |    7 |\n";
        let names = ["Cortex-M33"];
        assert_eq!(rows_of(page, &names, &[]), rows_of(fresh, &names, &[]));
        let other = fresh.replace('7', "8");
        assert_ne!(rows_of(page, &names, &[]), rows_of(&other, &names, &[]));
    }

    #[test]
    fn boards_whose_target_is_missing_are_not_compared() {
        let core = "| Cortex-M33 | `thumbv8m` | 7 |\n";
        let page = format!("{core}| `pico2` | `thumbv8m` | 9 |\n| `nucleo` | `thumbv7em` | 3 |\n");
        let without = |missing: &[&str]| rows_of(&page, &["Cortex-M33"], missing);
        assert_eq!(without(&[]), page);
        assert_eq!(without(&["thumbv8m", "thumbv7em"]), core);
        assert!(without(&["thumbv7em"]).ends_with("| 9 |\n"));
    }
}
