//! `budgets.toml`: what each scene and each row of `docs/costs.md` may cost at most. Lowering a budget
//! is part of the change that earns it; `--write-budgets` writes it.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::bars::{Held, Ratios};
use crate::costs::{self, Bars, TICK};
use crate::error::{Error, Result};
use crate::report::Report;
use crate::workspace::{self, Workspace};

/// What another compiler than the budgets' own may add: its code differs by a few per cent.
pub const OTHER_RUSTC: f64 = 0.03;

/// The same of a firmware's flash, a part of which is the compiler's own library: rustc 1.99.1 takes 4.4 % more.
const OTHER_RUSTC_FLASH: f64 = 0.06;

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
    ratios: Ratios,
    costs: Option<costs::Budget>,
    #[serde(flatten)]
    scenes: BTreeMap<String, Budget>,
}

/// What a scene may cost.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Budget {
    /// The compiler that it was measured with.
    rustc: String,
    /// Instructions of the longest tick.
    tick_instructions: u64,
    /// Modelled cycles of the longest tick.
    tick_cycles: u64,
    /// Instructions of the dynamics in the longest tick.
    dynamics_instructions: u64,
    /// Modelled cycles of the dynamics in the longest tick.
    dynamics_cycles: u64,
    /// Flash in bytes.
    flash_bytes: u64,
    /// RAM in bytes, without the stack.
    ram_bytes: u64,
    /// Peak stack in bytes.
    stack_bytes: u64,
}

impl Budget {
    fn measured(report: &Report) -> Self {
        Self {
            rustc: report.rustc.clone(),
            tick_instructions: report.tick.total.instructions.max,
            tick_cycles: report.tick.total.cycles.max,
            dynamics_instructions: report.tick.dynamics.instructions.max,
            dynamics_cycles: report.tick.dynamics.cycles.max,
            flash_bytes: report.flash_bytes,
            ram_bytes: report.ram_bytes,
            stack_bytes: report.stack_bytes,
        }
    }

    fn items(&self) -> [(&'static str, u64); 7] {
        [
            ("tick_instructions", self.tick_instructions),
            ("tick_cycles", self.tick_cycles),
            ("dynamics_instructions", self.dynamics_instructions),
            ("dynamics_cycles", self.dynamics_cycles),
            ("flash_bytes", self.flash_bytes),
            ("ram_bytes", self.ram_bytes),
            ("stack_bytes", self.stack_bytes),
        ]
    }

    /// What exceeds this budget, in words.
    fn exceeded_by(&self, measured: &Self) -> Vec<String> {
        let slack = slack(&self.rustc, &measured.rustc);
        std::iter::zip(self.items(), measured.items())
            .filter(|((what, allowed), (_, taken))| {
                let more = if slack > 0.0 && *what == "flash_bytes" {
                    OTHER_RUSTC_FLASH
                } else {
                    slack
                };
                *taken as f64 > *allowed as f64 * (1.0 + more)
            })
            .map(|((what, allowed), (_, taken))| format!("{what} {taken} > {allowed}"))
            .collect()
    }
}

/// What may be added to a budget of one compiler when another one is measured.
pub fn slack(budgeted: &str, measured: &str) -> f64 {
    if budgeted == measured {
        0.0
    } else {
        OTHER_RUSTC
    }
}

fn file(workspace: &Workspace) -> PathBuf {
    workspace.root.join("budgets.toml")
}

fn read(workspace: &Workspace) -> Result<Budgets> {
    let path = file(workspace);
    if !path.exists() {
        return Ok(Budgets::default());
    }
    toml::from_str(&workspace::read(&path)?)
        .map_err(|e| Error::check(format!("{}: {e}", path.display())))
}

/// Rewrites the budget of the report's scene.
pub fn write(workspace: &Workspace, report: &Report) -> Result<()> {
    let mut budgets = read(workspace)?;
    let scene = report.scene.clone();
    budgets.scenes.insert(scene, Budget::measured(report));
    budgets.write(workspace)
}

/// Rewrites the budgets of the costs' rows.
pub fn write_costs(workspace: &Workspace, costs: costs::Budget) -> Result<()> {
    let mut budgets = read(workspace)?;
    budgets.costs = Some(costs);
    budgets.write(workspace)
}

/// What was promised: of rows, and of pairs.
pub fn bars(workspace: &Workspace) -> Result<(Bars, Ratios)> {
    let budgets = read(workspace)?;
    Ok((budgets.bars, budgets.ratios))
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
        Error::check("budgets.toml has no [costs]: `cargo xtask costs --write-budgets`")
    })?;
    let mut wrong = budget.exceeded_by(&costs::Budget::measured(report));
    wrong.extend(report.missed().iter().map(|bar| format!("bar: {bar}")));
    if !wrong.is_empty() {
        return Err(Error::check(wrong.join("\n")));
    }
    Ok(format!("{} rows", report.rows.len()))
}

impl Budgets {
    fn write(&self, workspace: &Workspace) -> Result<()> {
        let path = file(workspace);
        let bad = |e: toml::ser::Error| Error::check(format!("{}: {e}", path.display()));
        let scenes = toml::to_string(&self.scenes).map_err(bad)?;
        let (mut bars, mut ratios) = (String::new(), String::new());
        for (key, bar) in &self.bars {
            let value = toml::Value::try_from(bar).map_err(bad)?;
            bars += &format!("{key:?} = {value}\n");
        }
        for (key, ratio) in &self.ratios {
            let value = toml::Value::try_from(ratio).map_err(bad)?;
            ratios += &format!("{key:?} = {value}\n");
        }
        let costs = self.costs.as_ref().map_or_else(String::new, |c| c.toml());
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
        Error::check(format!(
            "budgets.toml has no [{scene}]: `cargo xtask demo --scene {scene} --write-budgets`"
        ))
    })?;
    let mut exceeded = budget.exceeded_by(measured);
    let key = format!("{scene}{TICK}");
    if let Some(bar) = budgets.bars.get(&key)
        && let Some(most) = bar.cycles
    {
        let held = Held {
            what: format!("bar: {key}: cycles"),
            taken: measured.tick_cycles as f64,
            most: most as f64,
            recorded: bar.missed.iter().any(|figure| figure == "cycles"),
            ratio: false,
        };
        exceeded.extend(held.complaint());
    }
    if !exceeded.is_empty() {
        return Err(Error::check(format!(
            "over budget: {} (budget of {}, measured with {})",
            exceeded.join(", "),
            budget.rustc,
            measured.rustc
        )));
    }
    Ok(format!(
        "tick {} of {} cycles, stack {} of {} B",
        measured.tick_cycles, budget.tick_cycles, measured.stack_bytes, budget.stack_bytes
    ))
}

#[cfg(test)]
mod tests;
