//! The README's first lines: why one would use the library, and what each effect is worth.

use crate::kit::docs::{Page, cells};
use crate::kit::error::{Result, check};
use crate::kit::meter::CLOCK_MHZ;
use crate::kit::table::{Column, Table, thousands};
use crate::studies::scenes::render::signed;
use crate::studies::scenes::report::{Ablation, Report};

/// The page that has the figures of other libraries, which no test measures anew.
pub const PEERS: &str = "docs/peers.md";

const fn part(name: &'static str) -> Page<'static> {
    Page {
        file: "README.md",
        name,
        command: "cargo xtask demo --write-docs",
    }
}

pub const WHY: Page<'_> = part("why");
pub const WORTH: Page<'_> = part("worth");

/// From the bars of the peers' page, as it was recorded, and from the default scene.
pub fn why(peers: &str, readme: &str, report: &Report) -> Result<String> {
    let wishes = wishes(readme, report)?;
    let range = |bar: &str| range(peers, bar);
    let inverse = range(" rnea, m4f, engine / casadi: cycles")?;
    let forward = range(" aba, m4f, engine / casadi: cycles")?;
    let host = range(", engine / pinocchio: ns")?;
    let free = range("g1_free rnea, m4f, engine / casadi: cycles")?;
    let longest = report.tick["total"].cycles.max as f64 / CLOCK_MHZ;
    let share = 100.0 * longest / f64::from(report.period_us);
    let ratio = 100.0 * report.tracking.ratio();
    Ok(format!(
        "- Inverse dynamics takes **{inverse} of the cycles of the best C** that CasADi generates for the same robot (UR5e, Panda, iiwa 14,\n  \
         A1; f32, modelled Cortex-M4F), and {free} for the humanoid G1 with its base free. Forward dynamics of the first three takes\n  \
         {forward} ([peers]({PEERS})).\n\
         - On the host, inverse dynamics of the same four robots takes **{host} of the time of Pinocchio's C++**.\n\
         - A whole tick of a UR5e, from six encoders to six drives, takes {longest:.1} µs at {CLOCK_MHZ} MHz: **{share:.1} % of a millisecond**. The arm\n  \
         then follows its reference with {ratio:.1} % of the error of PD control alone.\n\n\
         {wishes}"
    ))
}

/// The questions that the README's pictures answer, each with its figures: of accuracy and of hard cases as the README has them.
fn wishes(readme: &str, report: &Report) -> Result<String> {
    let lacks = |what: &str| check!("README.md has no {what}");
    let row = |name: &str| {
        let mut rows = readme.lines().filter_map(cells);
        let row = rows.find(|row| row[0] == name && row.len() == 5);
        row.ok_or_else(|| lacks(name))
    };
    let (all, pruned) = (row("default")?, row("pruned at 0.1 %")?);
    let full = report.tracking.feedforward.rms_rad;
    let worth = |name: &str| {
        let one = report.effects.iter().find(|one| one.effect == name);
        let one = one.ok_or_else(|| lacks(name))?;
        let times = one.without.rms_rad / full;
        Ok(format!(
            "{times:.0} times as large without {name}, which costs {} cycles",
            one.cycles
        ))
    };
    let [gravity, coriolis]: [Result<String>; 2] = ["Gravity", "Coriolis"].map(worth);
    let is_count = |line: &&str| line.split(' ').nth(1) == Some("cases");
    let hard = readme.lines().find(is_count);
    let hard = hard.ok_or_else(|| lacks("hard cases"))?;
    Ok(format!(
        "Three questions, with a picture each below:\n\n\
         1. [What does accuracy cost?](#what-accuracy-costs) Torques of a UR5e within {} N·m take {} cycles, within {} N·m {}.\n\
         2. [What is each effect worth?](#what-each-effect-is-worth-and-what-it-costs) The tracking error of a UR5e is {},\n   \
         and {}.\n\
         3. [Do hard cases stay stable?](#hard-cases-stay-stable) {}\n   \
         and naive methods are shown to fail.",
        all[3], all[1], pruned[3], pruned[1], gravity?, coriolis?, hard
    ))
}

/// The least and the greatest figure of the bars whose names contain these words, of free bases only if they are named.
fn range(page: &str, bar: &str) -> Result<String> {
    let is_free = |text: &str| text.contains("_free ");
    let figures = page
        .lines()
        .filter(|line| line.contains(bar) && is_free(line) == is_free(bar));
    let figures = figures.filter_map(|line| line.split('|').nth(3)?.trim().strip_suffix('×'));
    let figures: Vec<f64> = figures.filter_map(|figure| figure.parse().ok()).collect();
    let ends = [f64::min, f64::max].map(|pick| figures.iter().copied().reduce(pick));
    match ends {
        [Some(least), Some(most)] if least == most => Ok(format!("{least:.2}")),
        [Some(least), Some(most)] => Ok(format!("{least:.2} to {most:.2}")),
        _ => Err(check!("{PEERS} has no bar `{bar}`")),
    }
}

/// A row for each effect, the one that is worth most first.
pub fn worth(report: &Report) -> String {
    let full = report.tracking.feedforward.rms_rad;
    let mut effects: Vec<&Ablation> = report.effects.iter().collect();
    effects.sort_by(|a, b| b.without.rms_rad.total_cmp(&a.without.rms_rad));
    let columns: [Column<'_, Ablation>; 3] = [
        ("left out of the feed-forward", &|one| one.effect.clone()),
        ("tracking error", &|one| {
            format!("{:.0} ×", one.without.rms_rad / full)
        }),
        ("cycles of the tick", &|one| signed(-one.cycles, "−")),
    ];
    let longest = thousands(report.tick["total"].cycles.max);
    let table = Table::of(effects, &columns).markdown();
    format!("{table}\nA UR5e's pick and place; its tick takes {longest} cycles with all of them.")
}

#[cfg(test)]
mod tests {
    use super::range;

    const PAGE: &str = "| ur5e rnea, engine / x: cycles | 0.470× | 0.448× | met |\n\
                        | a1 rnea, engine / x: cycles | 0.470× | 0.426× | met |\n\
                        | a1_free rnea, engine / x: cycles | 0.470× | 0.333× | met |\n\
                        | a1 aba, engine / x: cycles | 0.470× | – | |\n";

    #[test]
    fn a_range_is_that_of_the_bars_of_a_name() {
        let words = range(PAGE, " rnea, engine / x: cycles").expect("two figures");
        assert_eq!(words, "0.43 to 0.45");
        let words = range(PAGE, "a1_free rnea, engine / x: cycles").expect("a figure");
        assert_eq!(words, "0.33");
        range(PAGE, " aba, engine / x: cycles").expect_err("no figure");
        range(PAGE, " crba,").expect_err("no bar");
    }
}
