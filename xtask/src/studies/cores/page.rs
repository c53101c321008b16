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
