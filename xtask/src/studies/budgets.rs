//! `budgets.toml`: what each scene may cost at most, and the bars. Lowering a budget is part of the
//! change that earns it; `--write-budgets` writes it.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml_edit::{Array, DocumentMut, Item, Table, value};

use crate::kit::bars::{Bars, Compared, OTHER_RUSTC, TICK};
use crate::kit::error::{Result, check, refuse_if};
use crate::kit::workspace::{self, Workspace};
use crate::studies::scenes::report::Report;

/// The same share for flash, which contains the compiler's own library: rustc 1.99.1 takes 4.4 %
/// more.
const OTHER_RUSTC_FLASH: f64 = 0.06;

/// The figures that bars are set for.
const BARRED: [&str; 6] =
    ["instructions", "cycles", "code_bytes", "stack_bytes", "flash_bytes", "ram_bytes"];

const FILE: &str = "budgets.toml";

/// The figures of a scene in the order in which the file has them.
const FIGURES: [&str; 7] = [
    "tick_instructions",
    "tick_cycles",
    "dynamics_instructions",
    "dynamics_cycles",
    "flash_bytes",
    "ram_bytes",
    "stack_bytes",
];
type Figures = [u64; FIGURES.len()];

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Budgets {
    #[serde(default)]
    bars: Bars,
    /// By the compiler that they were measured with, then by scene.
    #[serde(default)]
    scenes: BTreeMap<String, BTreeMap<String, Figures>>,
}

impl Budgets {
    fn of(&self, scene: &str) -> Option<Budget> {
        self.scenes.iter().find_map(|(rustc, scenes)| {
            Some(Budget { rustc: rustc.clone(), figures: *scenes.get(scene)? })
        })
    }

    /// Takes the place of what there is of this scene, by whichever compiler.
    fn put(&mut self, scene: &str, budget: Budget) {
        for scenes in self.scenes.values_mut() {
            scenes.remove(scene);
        }
        self.scenes.retain(|_, scenes| !scenes.is_empty());
        let scenes = self.scenes.entry(budget.rustc).or_default();
        scenes.insert(scene.to_owned(), budget.figures);
    }

    /// Takes the place of the scenes of a file; the rest stays as it is written there.
    fn put_scenes(&self, file: &mut DocumentMut) {
        let mut compilers = Table::new();
        // The tables of the compilers have headings, and the one around them has none.
        compilers.set_implicit(true);
        for (rustc, scenes) in &self.scenes {
            let figures = |of: &Figures| of.iter().map(|most| *most as i64).collect::<Array>();
            let scenes = scenes.iter().map(|(scene, of)| (scene, value(figures(of))));
            compilers.insert(rustc, Item::Table(scenes.collect()));
        }
        file.insert("scenes", Item::Table(compilers));
    }
}

/// The budget of a scene, and the compiler that it was measured with.
#[derive(Debug)]
struct Budget {
    rustc: String,
    figures: Figures,
}

impl Budget {
    fn measured(report: &Report) -> Self {
        let (total, dynamics) = (report.tick["total"], report.tick["dynamics"]);
        Self {
            rustc: report.rustc.clone(),
            figures: [
                total.instructions.max,
                total.cycles.max,
                dynamics.instructions.max,
                dynamics.cycles.max,
                report.flash_bytes,
                report.ram_bytes,
                report.stack_bytes,
            ],
        }
    }

    /// The figures that exceed this budget, in words.
    fn exceeded_by(&self, measured: &Self) -> Vec<String> {
        let mut wrong = Vec::new();
        for (what, (most, now)) in FIGURES.iter().zip(self.figures.iter().zip(measured.figures)) {
            let more = match *what {
                _ if self.rustc == measured.rustc => 0.0,
                "flash_bytes" => OTHER_RUSTC_FLASH,
                _ => OTHER_RUSTC,
            };
            if now as f64 > *most as f64 * (1.0 + more) {
                wrong.push(format!("{what} {now} > {most}"));
            }
        }
        wrong
    }
}

fn read(workspace: &Workspace) -> Result<Budgets> {
    let path = workspace.root.join(FILE);
    let wrong = |why: String| check!("{}: {why}", path.display());
    let budgets: Budgets =
        toml_edit::de::from_str(&workspace::read(&path)?).map_err(|e| wrong(e.to_string()))?;
    for (key, bar) in &budgets.bars {
        if let Some(name) = bar.most.keys().find(|name| !BARRED.contains(&&***name)) {
            return Err(wrong(format!("{key}: {name} is no figure")));
        }
    }
    Ok(budgets)
}

/// Rewrites the budget of the report's scene.
pub fn write(workspace: &Workspace, report: &Report) -> Result<()> {
    put(workspace, &report.scene, Budget::measured(report))
}

fn put(workspace: &Workspace, scene: &str, budget: Budget) -> Result<()> {
    let mut budgets = read(workspace)?;
    budgets.put(scene, budget);
    let path = workspace.root.join(FILE);
    let file = workspace::read(&path)?.parse();
    let mut file: DocumentMut = file.map_err(|e| check!("{}: {e}", path.display()))?;
    budgets.put_scenes(&mut file);
    workspace::write(&path, file.to_string())
}

/// The bars of rows and of pairs of rows.
pub fn bars(workspace: &Workspace) -> Result<Bars> {
    Ok(read(workspace)?.bars)
}

/// Fails if the report exceeds its scene's budget; else says what there is to spare.
pub fn check(workspace: &Workspace, report: &Report) -> Result<String> {
    hold_scene(&read(workspace)?, &report.scene, &Budget::measured(report))
}

fn hold_scene(budgets: &Budgets, scene: &str, measured: &Budget) -> Result<String> {
    let budget = budgets.of(scene).ok_or_else(|| {
        check!("{FILE} has no {scene}: `cargo xtask demo --scene {scene} --write-budgets`")
    })?;
    let [_, most, .., most_stack] = budget.figures;
    let [_, cycles, .., stack] = measured.figures;
    let mut exceeded = budget.exceeded_by(measured);
    let key = format!("{scene}{TICK}");
    let bar = Compared::of(&budgets.bars, &key, "cycles", cycles as f64);
    exceeded.extend(bar.and_then(|bar| Some(format!("bar: {}", bar.complaint()?))));
    let (exceeded, ours, theirs) = (exceeded.join(", "), &budget.rustc, &measured.rustc);
    refuse_if!(
        !exceeded.is_empty(),
        "over budget: {exceeded} (budget of {ours}, measured with {theirs})"
    );
    Ok(format!("tick {cycles} of {most} cycles, stack {stack} of {most_stack} B"))
}

#[cfg(test)]
mod tests;
