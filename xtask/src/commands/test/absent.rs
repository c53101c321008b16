//! The step about effects that a scene does not name.

use std::path::{Path, PathBuf};

use super::Context;
use crate::kit::bars::{ADDED, Compared};
use crate::kit::elf::Image;
use crate::kit::error::{Result, bail, check, refuse_if};
use crate::kit::qemu::Run;
use crate::kit::rows::{self, Row};
use crate::kit::toolchain::RELEASE;
use crate::kit::{firmware, same_code};
use crate::studies::budgets;

const BIN: &str = "ablation_identity";
/// The scene with LuGre friction, and the same without.
const SCENES: [&str; 2] = ["friction_named", "friction_dropped"];
/// A joint's LuGre friction: σ₀, σ₁, σ₂, F_c, F_s − F_c and its bristle; 1/v_s of all.
const LUGRE_BYTES: u64 = 4 * (6 * 6 + 1);
/// Numbers that only LuGre's exponential has, by their bits.
const LUGRE_NUMBERS: [f32; 2] = [core::f32::consts::LOG2_E, 1.428_606_8e-6];

/// Effects with nothing but defaults leave the code as it is, and one that is dropped leaves
/// nothing.
pub fn absent_effects_cost_nothing(context: &Context) -> Result<String> {
    let (workspace, tools) = (&context.workspace, &context.tools);
    let bins = [BIN, SCENES[0], SCENES[1]];
    let elves = firmware::build_bins(workspace, tools.toolchain, RELEASE, &bins)?;
    let rows = rows::measure(workspace, tools, RELEASE, &bins[..1])?;
    let image = Image::read(&elves[0])?;
    let mut outcomes = Vec::new();
    for form in ["core", "engine"] {
        let address = |inputs| row(&rows, form, inputs).map(|row| row.address);
        let (full, idle) = (address("full")?, address("idle")?);
        let instructions = same_code::same(&image, full, idle)?;
        let friction = same_code::same(&image, full, address("friction")?);
        refuse_if!(
            friction.is_ok(),
            "friction changes no instruction: the comparison sees nothing"
        );
        let folded = if full == idle { ", folded into one function" } else { "" };
        outcomes.push(format!("{form}: {instructions} instructions the same{folded}"));
    }
    let known = |inputs| row(&rows, "engine", inputs);
    let (full, friction) = (known("full_known")?, known("friction_known")?);
    outcomes.push(added(context, full, friction)?);
    outcomes.push(dropped(context, [&elves[1], &elves[2]])?);
    Ok(outcomes.join(", "))
}

/// The cost that a scene saves without LuGre friction.
fn dropped(context: &Context, elves: [&PathBuf; 2]) -> Result<String> {
    let [named, dropped] = [Image::read(elves[0])?, Image::read(elves[1])?];
    let with = effects_bytes(context, SCENES[0], elves[0])?;
    let without = effects_bytes(context, SCENES[1], elves[1])?;
    let freed = |of: fn(&Image) -> u64| of(&named).checked_sub(of(&dropped));
    let (flash, ram) = (freed(|i| i.sizes.flash), freed(|i| i.sizes.ram));
    // Tuples are padded to the 8 bytes of gravity's f64.
    let is_its_size = |bytes: &u64| (LUGRE_BYTES..LUGRE_BYTES + 8).contains(bytes);
    let shrunk = with.checked_sub(without).filter(is_its_size);
    let (Some(fewer), Some(less @ 1..), true) = (shrunk, flash, ram == shrunk) else {
        bail!(
            "LuGre friction takes {LUGRE_BYTES} B; without it the effects shrink from {with} to \
             {without} B, RAM by {ram:?} and flash by {flash:?}"
        );
    };
    for number in LUGRE_NUMBERS {
        let there = [&named, &dropped].map(|image| image.words.contains(&number.to_bits()));
        refuse_if!(
            there != [true, false],
            "{number} should be with LuGre friction and not without, but is: {there:?}"
        );
    }
    let mut names = dropped.functions.iter().flat_map(|f| &f.names);
    if let Some(name) = names.find(|name| name.contains("exp_neg") || name.contains("ugre")) {
        bail!("without LuGre there is `{name}`");
    }
    Ok(format!("LuGre dropped: {less} B of flash and {fewer} B of RAM less"))
}

fn row<'a>(rows: &'a [Row], form: &str, inputs: &str) -> Result<&'a Row> {
    let mut rows = rows.iter();
    rows.find(|row| (&*row.form, &*row.inputs) == (form, inputs))
        .ok_or_else(|| check!("`{BIN}` did not measure {form} {inputs}"))
}

/// The cost that friction and rotors add to a call, compared with the bar.
fn added(context: &Context, full: &Row, friction: &Row) -> Result<String> {
    let bars = budgets::bars(&context.workspace)?;
    let key = format!("{}{ADDED}", friction.key());
    let cycles = friction.cycles.max.saturating_sub(full.cycles.max);
    let compared = Compared::of(&bars, &key, "cycles", cycles as f64)
        .ok_or_else(|| check!("there is no bar {key:?}"))?;
    let most = compared.most;
    match compared.complaint() {
        Some(complaint) => Err(check!("bar: {complaint}")),
        None => Ok(format!("friction and rotors {cycles} of {most} cycles")),
    }
}

/// The bytes of a scene's effects, as it says itself.
fn effects_bytes(context: &Context, name: &str, elf: &Path) -> Result<u64> {
    let lines = context.tools.qemu.lines(&Run::logging(name, elf, None))?;
    let mut said = lines.iter().filter_map(|line| line.strip_prefix("effects ")?.parse().ok());
    said.next_back().ok_or_else(|| check!("`{name}` did not say how large its effects are"))
}
