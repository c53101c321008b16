//! `budgets.toml`: what each scene and each row of `docs/costs.md` may cost at most. Lowering a budget
//! is part of the change that earns it; `--write-budgets` writes it.

use std::collections::BTreeMap;

use indexmap::IndexMap;
use serde::Deserialize;
use toml_edit::{DocumentMut, InlineTable, Item, value};

use crate::kit::bars::{Bars, Compared, OTHER_RUSTC};
use crate::kit::error::{Result, check, refuse_if};
use crate::kit::workspace::{self, Workspace};
use crate::studies::costs::{self, TICK};
use crate::studies::scenes::report::Report;

/// The same share for flash, which contains the compiler's own library: rustc 1.99.1 takes 4.4 % more.
const OTHER_RUSTC_FLASH: f64 = 0.06;

/// The figures that bars are set for.
const BARRED: [&str; 7] = [
    "instructions",
    "cycles",
    "code_bytes",
    "stack_bytes",
    "flash_bytes",
    "ram_bytes",
    "ns",
];

const FILE: &str = "budgets.toml";

#[derive(Debug, Default, Deserialize)]
struct Budgets {
    #[serde(default)]
    bars: Bars,
    #[serde(default)]
    ratios: Bars,
    costs: Option<Rows>,
    #[serde(flatten)]
    scenes: BTreeMap<String, Budget>,
}

/// Costs by the names of the figures.
type Figures = IndexMap<String, u64>;

/// The budget of a scene, and the compiler that it was measured with.
#[derive(Debug, Deserialize)]
struct Budget {
    rustc: String,
    #[serde(flatten)]
    figures: Figures,
}

/// The budget of each row of the costs, and the compiler that they were measured with.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Rows {
    rustc: String,
    rows: BTreeMap<String, Figures>,
}

fn figures<const N: usize>(of: [(&str, u64); N]) -> Figures {
    of.map(|(what, value)| (what.to_owned(), value)).into()
}

impl Budget {
    fn measured(report: &Report) -> Self {
        let (total, dynamics) = (report.tick["total"], report.tick["dynamics"]);
        Self {
            rustc: report.rustc.clone(),
            figures: figures([
                ("tick_instructions", total.instructions.max),
                ("tick_cycles", total.cycles.max),
                ("dynamics_instructions", dynamics.instructions.max),
                ("dynamics_cycles", dynamics.cycles.max),
                ("flash_bytes", report.flash_bytes),
                ("ram_bytes", report.ram_bytes),
                ("stack_bytes", report.stack_bytes),
            ]),
        }
    }

    /// The figures that exceed this budget, in words.
    fn exceeded_by(&self, measured: &Self) -> Vec<String> {
        let is_other = self.rustc != measured.rustc;
        exceeded(&self.figures, &measured.figures, is_other)
    }

    /// Takes the place of what a file has of this scene.
    fn put(&self, scene: &str, file: &mut DocumentMut) {
        let scene = file.entry(scene).or_insert(toml_edit::table());
        scene["rustc"] = value(&self.rustc);
        for (what, most) in &self.figures {
            scene[what] = value(*most as i64);
        }
    }
}

impl Rows {
    fn measured(report: &costs::Report) -> Self {
        let rows = report.rows.iter();
        Self {
            rustc: report.rustc.clone(),
            rows: rows
                .map(|row| (row.key(), figures(row.figures())))
                .collect(),
        }
    }

    fn only(mut self, robot: &str) -> Self {
        self.rows
            .retain(|key, _| key.split(' ').next() == Some(robot));
        self
    }

    /// The figures that exceed this budget, in words, and rows without a budget or without a measurement.
    fn exceeded_by(&self, measured: &Self) -> Vec<String> {
        let is_other = self.rustc != measured.rustc;
        let mut wrong = Vec::new();
        for (key, row) in &measured.rows {
            match self.rows.get(key) {
                None => wrong.push(format!("{key}: has no budget")),
                Some(most) => wrong.extend(
                    exceeded(most, row, is_other)
                        .iter()
                        .map(|what| format!("{key}: {what}")),
                ),
            }
        }
        let all = self.rows.keys();
        let gone = all.filter(|key| !measured.rows.contains_key(*key));
        wrong.extend(gone.map(|key| format!("{key}: is no longer measured")));
        wrong
    }

    /// Takes the place of what a file has.
    fn put(&self, file: &mut DocumentMut) {
        file["costs"]["rustc"] = value(&self.rustc);
        let rows = self.rows.iter().map(|(key, row)| {
            let row = row.iter().map(|(what, most)| (what, *most as i64));
            (key, Item::Value(row.collect::<InlineTable>().into()))
        });
        file["costs"]["rows"] = Item::Table(rows.collect());
    }
}

/// The figures that are beyond what is allowed, or that only one side has, in words; whether they were measured
/// with another compiler.
fn exceeded(most: &Figures, measured: &Figures, is_other: bool) -> Vec<String> {
    let mut wrong = Vec::new();
    for (what, value) in measured {
        let more = match &**what {
            _ if !is_other => 0.0,
            "flash_bytes" => OTHER_RUSTC_FLASH,
            _ => OTHER_RUSTC,
        };
        match most.get(what) {
            None => wrong.push(format!("{what} has no budget")),
            Some(most) if *value as f64 > *most as f64 * (1.0 + more) => {
                wrong.push(format!("{what} {value} > {most}"));
            }
            Some(_) => {}
        }
    }
    let gone = most.keys().filter(|what| !measured.contains_key(*what));
    wrong.extend(gone.map(|what| format!("{what} is no figure")));
    wrong
}

fn read(workspace: &Workspace) -> Result<Budgets> {
    let path = workspace.root.join(FILE);
    let wrong = |why: String| check!("{}: {why}", path.display());
    let budgets: Budgets =
        toml_edit::de::from_str(&workspace::read(&path)?).map_err(|e| wrong(e.to_string()))?;
    for (key, bar) in budgets.bars.iter().chain(&budgets.ratios) {
        let mut names = bar.most.keys().chain(&bar.missed);
        if let Some(name) = names.find(|name| !BARRED.contains(&&***name)) {
            return Err(wrong(format!("{key}: {name} is no figure")));
        }
    }
    Ok(budgets)
}

/// Changes the file; what is not concerned stays as it is written there.
fn change(workspace: &Workspace, put: impl FnOnce(&mut DocumentMut)) -> Result<()> {
    let path = workspace.root.join(FILE);
    let file = workspace::read(&path)?.parse();
    let mut file = file.map_err(|e| check!("{}: {e}", path.display()))?;
    put(&mut file);
    workspace::write(&path, file.to_string())
}

/// Rewrites the budget of the report's scene.
pub fn write(workspace: &Workspace, report: &Report) -> Result<()> {
    let budget = Budget::measured(report);
    change(workspace, |file| budget.put(&report.scene, file))
}

/// Rewrites the budgets of the costs' rows.
pub fn write_costs(workspace: &Workspace, report: &costs::Report) -> Result<()> {
    change(workspace, |file| Rows::measured(report).put(file))
}

/// The bars of rows and of pairs of rows.
pub fn bars(workspace: &Workspace) -> Result<Bars> {
    let Budgets {
        mut bars, ratios, ..
    } = read(workspace)?;
    bars.extend(ratios);
    Ok(bars)
}

/// The cycles that a row of the costs may take.
pub fn cycles(workspace: &Workspace, row: &str) -> Result<u64> {
    let costs = read(workspace)?.costs;
    let figures = costs.as_ref().and_then(|costs| costs.rows.get(row));
    let cycles = figures.and_then(|figures| figures.get("cycles"));
    cycles
        .copied()
        .ok_or_else(|| check!("no region and no row of the costs is named `{row}`"))
}

/// Fails if a row of the costs exceeds its budget or misses its bar; else says how many rows hold. With a
/// robot: the report has the rows of this one alone.
pub fn check_costs(
    workspace: &Workspace,
    report: &costs::Report,
    robot: Option<&str>,
) -> Result<String> {
    let mut budgets = read(workspace)?;
    if let Some(robot) = robot {
        budgets.costs = budgets.costs.map(|costs| costs.only(robot));
    }
    hold_costs(&budgets, report)
}

fn hold_costs(budgets: &Budgets, report: &costs::Report) -> Result<String> {
    let budget = budgets.costs.as_ref().ok_or_else(|| {
        check!("budgets.toml has no [costs]: `cargo xtask costs --write-budgets`")
    })?;
    let mut wrong = budget.exceeded_by(&Rows::measured(report));
    wrong.extend(report.missed().iter().map(|bar| format!("bar: {bar}")));
    refuse_if!(!wrong.is_empty(), "{}", wrong.join("\n"));
    Ok(format!("{} rows", report.rows.len()))
}

/// Fails if the report exceeds its scene's budget; else says what there is to spare.
pub fn check(workspace: &Workspace, report: &Report) -> Result<String> {
    hold_scene(&read(workspace)?, &report.scene, &Budget::measured(report))
}

fn hold_scene(budgets: &Budgets, scene: &str, measured: &Budget) -> Result<String> {
    let budget = budgets.scenes.get(scene).ok_or_else(|| {
        check!("budgets.toml has no [{scene}]: `cargo xtask demo --scene {scene} --write-budgets`")
    })?;
    let figure = |budget: &Budget, what: &str| budget.figures.get(what).copied().unwrap_or(0);
    let cycles = figure(measured, "tick_cycles");
    let mut exceeded = budget.exceeded_by(measured);
    let key = format!("{scene}{TICK}");
    let bar = Compared::of(&budgets.bars, &key, "cycles", cycles as f64);
    exceeded.extend(bar.and_then(|bar| Some(format!("bar: {}", bar.complaint()?))));
    let (exceeded, ours, theirs) = (exceeded.join(", "), &budget.rustc, &measured.rustc);
    refuse_if!(
        !exceeded.is_empty(),
        "over budget: {exceeded} (budget of {ours}, measured with {theirs})"
    );
    let [most, most_stack] = ["tick_cycles", "stack_bytes"].map(|what| figure(budget, what));
    let stack = figure(measured, "stack_bytes");
    Ok(format!(
        "tick {cycles} of {most} cycles, stack {stack} of {most_stack} B"
    ))
}

#[cfg(test)]
mod tests;
