//! The README's first lines: why one would use the library, and what each effect is worth.

use crate::kit::docs::{Page, TICK, cells};
use crate::kit::error::{Result, check};
use crate::kit::meter::CLOCK_MHZ;
use crate::kit::table::{Column, Table, thousands};
use crate::kit::workspace::{self, Workspace};
use crate::studies::scenes::render::signed;
use crate::studies::scenes::report::{Ablation, Report};

/// The page that has the figures of other libraries, which no test measures anew.
pub const PEERS: &str = "companions/laboratory/docs/peers.md";
/// The page of the cycles that a core's gates count.
pub const RTL: &str = "companions/laboratory/docs/rtl.md";
/// The page that has gravity compensation by hand beside the engine's, and the arm for which.
const COSTS: &str = crate::studies::costs::PAGE;
const BY_HAND: &str = "\n## so101\n";

const fn part(name: &'static str) -> Page<'static> {
    Page { file: "README.md", name, command: "cargo xtask demo --write-docs" }
}

pub const WHY: Page<'_> = part("why");
pub const WORTH: Page<'_> = part("worth");

/// Writes the first lines anew; after each command that writes a page from which they are composed.
pub fn write_why(workspace: &Workspace) -> Result<()> {
    WHY.write(workspace, &composed(workspace)?)
}

/// The first lines as these pages have them now, whichever compiler measured their figures.
pub fn composed(workspace: &Workspace) -> Result<String> {
    let read = |file| workspace::read(&workspace.root.join(file));
    why([&read(PEERS)?, &read(WHY.file)?, &read(TICK.file)?, &read(RTL)?, &read(COSTS)?])
}

/// From the bars of the peers' page, as it was recorded, from the README's other parts, from the
/// default scene's page and from those of gates and costs. A figure is copied, or has fewer digits
/// than there.
fn why([peers, readme, scenes, rtl, costs]: [&str; 5]) -> Result<String> {
    let (_, arm) = costs.split_once(BY_HAND).ok_or_else(|| check!("{COSTS} has no SO-101"))?;
    let arm = arm.split("\n## ").next().unwrap_or_default();
    let gravity = |row| Ok(cell(arm, row, 15)?[7].to_owned());
    let [by_hand, engine]: [Result<String>; 2] =
        ["gravity by_hand libm", "rnea engine gravity"].map(gravity);
    let (by_hand, engine) = (by_hand?, engine?);
    let wishes = wishes(readme)?;
    let range = |bar: &str| range(peers, bar);
    let inverse = range(" rnea, m4f, engine / casadi: cycles")?;
    let forward = range(" aba, m4f, engine / casadi: cycles")?;
    let host = range(", engine / pinocchio: ns")?;
    let free = range("g1_free rnea, m4f, engine / casadi: cycles")?;
    let gates = range(" rnea, gates, engine / casadi: stages_1")?;
    let tick = TICK.written(scenes)?;
    let total = cell(tick, "total", 14)?;
    let [longest, share] = [(11, "longest tick"), (13, "share")].map(|(at, what)| {
        let figure = total[at].trim_end_matches(" %").parse::<f64>();
        figure.map_err(|_| check!("{} has no {what}", TICK.file))
    });
    let (longest, share) = (longest?, share?);
    let exact = cell(tick, "feed-forward", 3)?[1];
    let ratio = exact.split_once('(').and_then(|(_, ratio)| ratio.strip_suffix(')'));
    let ratio = ratio.ok_or_else(|| check!("{} has no share of PD's error", TICK.file))?;
    // The second column of cycles is that of an FPU of one stage.
    let [counted, counted_tick] =
        ["ur5e rnea engine outside", "ur5e"].map(|row| Ok(cell(rtl, row, 7)?[2].to_owned()));
    let (counted, counted_tick): (String, String) = (counted?, counted_tick?);
    Ok(format!(
        "- Gravity compensation of an SO-101 takes {by_hand} cycles of a modelled Cortex-M4F if it \
         is written by hand with `libm`'s sines, and **{engine} by this \
         library** ([costs]({COSTS})).\n\
         - Inverse dynamics takes **{inverse} of the cycles of the best C** that CasADi generates \
         for the same robot (UR5e, Panda, iiwa 14, A1; f32,\n  \
         modelled Cortex-M4F), and {free} for the humanoid G1 with its base free. Forward dynamics \
         of the first three takes {forward} ([peers]({PEERS})).\n\
         - On the host, inverse dynamics of the same four robots takes **{host} of the time of \
         Pinocchio's C++**.\n\
         - A whole tick of a UR5e, from six encoders to six drives, takes {longest:.1} µs at \
         {CLOCK_MHZ} MHz, modelled: **{share:.1} % of a millisecond**. The arm\n  \
         then follows its reference with {ratio} of the error of PD control alone.\n\
         - Counted on a RISC-V core's gates ([CV32E40P]({RTL}), FPU of one stage): a UR5e's tick \
         takes {counted_tick} cycles, inverse dynamics {counted}; fused, {gates} of the best C's.\n\n\
         {wishes}"
    ))
}

/// The cells of the row of this name, which has this number of them.
fn cell<'a>(page: &'a str, name: &str, count: usize) -> Result<Vec<&'a str>> {
    let mut rows = page.lines().filter_map(cells);
    let row = rows.find(|row| row[0] == name && row.len() == count);
    row.ok_or_else(|| check!("no page has a row {name} of {count} cells"))
}

/// The questions that the README's pictures answer, each with its figures as the README's other
/// parts have them.
fn wishes(readme: &str) -> Result<String> {
    let lacks = |what: &str| check!("README.md has no {what}");
    let (all, pruned) = (cell(readme, "default", 5)?, cell(readme, "pruned at 0.1 %", 5)?);
    let effects = WORTH.written(readme)?;
    let worth = |name: &str| {
        let row = cell(effects, name, 3)?;
        let (times, cycles) = (row[1].trim_end_matches(" ×"), row[2].trim_start_matches('−'));
        Ok(format!("{times} times as large without {name}, which costs {cycles} cycles"))
    };
    let [gravity, coriolis]: [Result<String>; 2] = ["Gravity", "Coriolis"].map(worth);
    let is_count = |line: &&str| line.split(' ').nth(1) == Some("cases");
    let hard = readme.lines().find(is_count);
    let hard = hard.ok_or_else(|| lacks("hard cases"))?;
    Ok(format!(
        "Three questions, with a picture each below:\n\n\
         1. [What does accuracy cost?](#what-accuracy-costs) Torques of a UR5e within {} N·m take \
         {} cycles, modelled, within {} N·m {}.\n\
         2. [What is each effect worth?](#what-each-effect-is-worth-and-what-it-costs) The \
         tracking error of a UR5e is {},\n   \
         and {}.\n\
         3. [Do hard cases stay stable?](#hard-cases-stay-stable) {}\n   \
         and naive methods are shown to fail. One figure of a further case is beyond its bound, \
         with its reason below.",
        all[3], all[1], pruned[3], pruned[1], gravity?, coriolis?, hard
    ))
}

/// The least and the greatest figure of the bars whose names contain these words, of free bases
/// only if they are named.
fn range(page: &str, bar: &str) -> Result<String> {
    let is_free = |text: &str| text.contains("_free ");
    let figures = page.lines().filter(|line| line.contains(bar) && is_free(line) == is_free(bar));
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
        ("tracking error", &|one| format!("{:.0} ×", one.without.rms_rad / full)),
        ("cycles of the tick", &|one| signed(-one.cycles, "−")),
    ];
    let longest = thousands(report.tick["total"].cycles.max);
    let table = Table::of(effects, &columns).markdown();
    let rustc = &report.rustc;
    format!(
        "{table}\nA UR5e's pick and place; its tick takes {longest} cycles with all of them. \
         Measured with {rustc}."
    )
}

#[cfg(test)]
mod tests {
    use super::{WHY, WORTH, composed, range};
    use crate::kit::docs::repository::{read, root};
    use crate::kit::docs::{TICK, seal::unsealed};
    use crate::kit::workspace::Workspace;

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

    #[test]
    fn the_first_screen_has_the_figures_of_its_pages() {
        let text = composed(&Workspace::at(&root())).expect("the pages");
        WHY.check(&Workspace::at(&root()), &text, None)
            .expect("`cargo xtask demo --write-docs` writes it");
    }

    /// The pages with the figure of a row's cell replaced.
    fn changed(page: &str, row: &str, figure: &str) -> String {
        let line = page.lines().find(|line| line.starts_with(row)).expect("the row");
        page.replace(line, &line.replacen(figure, "9999", 1))
    }

    #[test]
    fn a_figure_that_another_page_has_not_is_refused() {
        let [peers, readme, scenes, rtl, costs] =
            [super::PEERS, WHY.file, TICK.file, super::RTL, super::COSTS].map(read);
        let why = |readme: &str, scenes: &str, rtl: &str, costs: &str| {
            super::why([&peers, readme, scenes, rtl, costs])
        };
        let now = why(&readme, &scenes, &rtl, &costs).expect("the pages");
        let cycles = |name| super::cell(&readme, name, 5).expect("a row")[1].to_owned();
        for row in ["default", "pruned at 0.1 %"] {
            let other = changed(&readme, &format!("| {row} "), &cycles(row));
            let other = why(&other, &scenes, &rtl, &costs).expect("the pages");
            assert_ne!(other, now, "{row}");
        }
        for row in ["ur5e rnea engine outside", "ur5e"] {
            let cycles = super::cell(&rtl, row, 7).expect("a row")[2];
            let other = rtl.replace(cycles, "9999");
            let other = why(&readme, &scenes, &other, &costs).expect("the pages");
            assert_ne!(other, now, "{row}");
        }
        let (_, arm) = costs.split_once(super::BY_HAND).expect("the arm");
        for row in ["gravity by_hand libm", "rnea engine gravity"] {
            let cycles = super::cell(arm, row, 15).expect("a row")[7];
            let other = costs.replace(cycles, "9999");
            assert_ne!(why(&readme, &scenes, &rtl, &other).expect("the pages"), now, "{row}");
        }
        why(&readme, &scenes, &rtl, "").expect_err("no arm");
        let gravity =
            super::cell(WORTH.written(&readme).expect("a part"), "Gravity", 3).expect("a row")[1];
        let other = changed(&readme, "| Gravity ", gravity.trim_end_matches(" ×"));
        assert_ne!(why(&other, &scenes, &rtl, &costs).expect("the pages"), now);
        let other = scenes.replace("| total ", "| all ");
        why(&readme, &other, &rtl, &costs).expect_err("no total");
        assert!(!unsealed(WHY.written(&readme).expect("a part")).contains("9999"));
    }
}
