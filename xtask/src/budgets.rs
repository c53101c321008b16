//! `budgets.toml`: what each scene and each row of `docs/costs.md` may cost at most. Lowering a budget
//! is part of the change that earns it; `--write-budgets` writes it.

use std::collections::BTreeMap;

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

use crate::bars::{Bars, Compared, is_ratio};
use crate::costs::{self, TICK};
use crate::error::{Error, Result, bail, check};
use crate::report::Report;
use crate::workspace::{self, Workspace};

/// What another compiler than the budgets' own may add: its code differs by a few per cent.
pub const OTHER_RUSTC: f64 = 0.03;

/// The same of a firmware's flash, a part of which is the compiler's own library: rustc 1.99.1 takes 4.4 % more.
const OTHER_RUSTC_FLASH: f64 = 0.06;

/// The figures that bars are set for.
const BARRED: [&str; 4] = ["instructions", "cycles", "code_bytes", "ns"];

const FILE: &str = "budgets.toml";

const HEADER: &str = "\
# What scenes and functions may cost at most, as measured with the named compiler (another one is given
# 3 % more). `cargo xtask test` fails when a budget is exceeded; to lower it,
# `cargo xtask demo --write-budgets` and `cargo xtask costs --write-budgets`.
";

const BARS: &str = "\
# What was promised, whatever it costs now: nobody gets more, and no command writes it.
";

const RATIOS: &str = "\
# The same of multiples: opt-level s against 3 (`costs`), long chains against short ones
# (`growth`), ours against the best build of a peer (`peers`).
";

/// The file.
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

/// What something costs, by the names of the figures.
type Figures = IndexMap<String, u64>;

/// What a scene may cost, and the compiler that it was measured with.
#[derive(Debug, Serialize, Deserialize)]
struct Budget {
    rustc: String,
    #[serde(flatten)]
    figures: Figures,
}

/// What each row of the costs may cost, and the compiler that they were measured with.
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

    /// What exceeds this budget, in words.
    fn exceeded_by(&self, measured: &Self) -> Vec<String> {
        let is_other = self.rustc != measured.rustc;
        exceeded(&self.figures, &measured.figures, is_other)
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

    /// The part of one robot.
    fn only(mut self, robot: &str) -> Self {
        self.rows
            .retain(|key, _| key.split(' ').next() == Some(robot));
        self
    }

    /// What exceeds this budget, in words; a row that has none, or is gone, is named as well.
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

    /// As TOML, a line a row.
    fn toml(&self) -> String {
        let mut text = format!("[costs]\nrustc = {:?}\n\n[costs.rows]\n", self.rustc);
        for (key, most) in &self.rows {
            let items = most.iter().map(|(what, most)| format!("{what} = {most}"));
            let items: Vec<String> = items.collect();
            text += &format!("{key:?} = {{ {} }}\n", items.join(", "));
        }
        text
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
    if !path.exists() {
        return Ok(Budgets::default());
    }
    let wrong = |why: String| check!("{}: {why}", path.display());
    let budgets: Budgets =
        toml::from_str(&workspace::read(&path)?).map_err(|e| wrong(e.to_string()))?;
    for (key, bar) in budgets.bars.iter().chain(&budgets.ratios) {
        let mut names = bar.most.keys().chain(&bar.missed);
        if let Some(name) = names.find(|name| !BARRED.contains(&&***name)) {
            return Err(wrong(format!("{key}: {name} is no figure")));
        }
    }
    Ok(budgets)
}

/// Rewrites the budget of the report's scene.
pub fn write(workspace: &Workspace, report: &Report) -> Result<()> {
    let mut budgets = read(workspace)?;
    let scene = report.scene.clone();
    budgets.scenes.insert(scene, Budget::measured(report));
    budgets.write(workspace)
}

/// Rewrites the budgets of the costs' rows.
pub fn write_costs(workspace: &Workspace, report: &costs::Report) -> Result<()> {
    let mut budgets = read(workspace)?;
    budgets.costs = Some(Rows::measured(report));
    budgets.write(workspace)
}

/// What was promised: of rows, and of pairs of rows.
pub fn bars(workspace: &Workspace) -> Result<Bars> {
    let Budgets {
        mut bars, ratios, ..
    } = read(workspace)?;
    bars.extend(ratios);
    Ok(bars)
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
    if !wrong.is_empty() {
        return Err(Error::check(wrong.join("\n")));
    }
    Ok(format!("{} rows", report.rows.len()))
}

impl Budgets {
    fn write(&self, workspace: &Workspace) -> Result<()> {
        let path = workspace.root.join(FILE);
        let bad = |e| check!("{}: {e}", path.display());
        let scenes = toml::to_string(&self.scenes).map_err(bad)?;
        let [mut bars, mut ratios] = [String::new(), String::new()];
        for (key, bar) in self.bars.iter().chain(&self.ratios) {
            let value = toml::Value::try_from(bar).map_err(bad)?;
            let section = if is_ratio(key) {
                &mut ratios
            } else {
                &mut bars
            };
            // Whole numbers as people write them.
            let value = value.to_string().replace(".0,", ",").replace(".0 }", " }");
            *section += &format!("{key:?} = {value}\n");
        }
        let costs = self.costs.as_ref().map_or_else(String::new, Rows::toml);
        workspace::write(
            &path,
            format!(
                "{HEADER}\n{scenes}\n{BARS}[bars]\n{bars}\n{RATIOS}[ratios]\n{ratios}\n{costs}"
            ),
        )
    }
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
    if !exceeded.is_empty() {
        bail!(
            "over budget: {} (budget of {}, measured with {})",
            exceeded.join(", "),
            budget.rustc,
            measured.rustc
        );
    }
    let [most, most_stack] = ["tick_cycles", "stack_bytes"].map(|what| figure(budget, what));
    let stack = figure(measured, "stack_bytes");
    Ok(format!(
        "tick {cycles} of {most} cycles, stack {stack} of {most_stack} B"
    ))
}

#[cfg(test)]
mod tests;
