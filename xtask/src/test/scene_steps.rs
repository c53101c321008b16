//! The steps about what the scenes do.

use super::{Context, Outcome};
use crate::budgets;
use crate::demo::{self, Measured};
use crate::docs;
use crate::error::{Error, Result};
use crate::firmware;
use crate::plot;
use crate::protocol::SOLD;
use crate::render::CLOCK_MHZ;
use crate::scene::Scene;
use crate::scenes;
use crate::setup;
use crate::system::{self, Privilege, System};
use crate::toolchain::{self, DEBIAN_PACKAGES, Toolchain};

/// How much larger than what is measured a scene's bound may be.
const SLACK: f64 = 10.0;

/// Of the default scene: the error with feed-forward as a share of PD's, with the exact model and
/// with one that is off.
const LARGEST_RATIO: [f64; 2] = [0.1, 0.2];

/// The longest tick, as a share of its period.
const LARGEST_SHARE: f64 = 0.5;

/// What the safety gate says of a run in which it changed nothing.
const PLAIN: &str = "mode Full, fault None, limited false";

pub fn runs(context: &Context) -> Result<Outcome> {
    let mut ticks = 0;
    for measured in context.measured()? {
        let name = &measured.report.scene;
        // Of the default scene no law needs the gate; elsewhere some are there to show that they do.
        let held = |law: &str| law == SOLD || *name == Scene::default().name();
        if let Some(run) = measured.recording.unlike(PLAIN, held) {
            return Err(Error::check(format!(
                "{name}: the safety gate stepped in: {run}"
            )));
        }
        let picture = context.workspace.output(&format!("{name}.svg"))?;
        plot::write(&measured.recording, &picture)?;
        ticks += measured.recording.ticks as usize * measured.recording.runs.len();
    }
    Ok(Outcome::Passed(format!("{ticks} ticks")))
}

/// The scenes that run twice: one on the engine, one on the core.
const TWICE: [Scene; 2] = [Scene::Ur5e, Scene::SpaceArm];

pub fn determinism(context: &Context) -> Result<Outcome> {
    let mut bytes = 0;
    let firsts: Vec<_> = context
        .measured()?
        .iter()
        .zip(context.scenes())
        .filter(|(_, scene)| TWICE.contains(scene))
        .collect();
    let runs: Vec<_> = firsts
        .iter()
        .map(|(first, scene)| (**scene, first.elf.clone()))
        .collect();
    let again = demo::measure_all(&context.workspace, &context.tools, context.meter()?, &runs)?;
    for ((first, _), second) in firsts.iter().zip(&again) {
        if first.raw.0 != second.raw.0 {
            return Err(Error::check(
                "two runs of the same ELF logged different bytes",
            ));
        }
        if first.raw.1 != second.raw.1 {
            return Err(Error::check("two runs of the same ELF cost differently"));
        }
        bytes += first.raw.0.len() + first.raw.1.len();
    }
    Ok(Outcome::Passed(format!("{bytes} bytes")))
}

/// The peak joint speed that the default scene must reach for its tracking to mean something, rad/s.
const LEAST_PEAK_SPEED: f64 = 1.5;

pub fn tracking(context: &Context) -> Result<Outcome> {
    let mut seen = Vec::new();
    for measured in context.measured()? {
        let report = &measured.report;
        let (max, bound) = (report.tracking.feedforward.max_rad, report.bound_rad);
        if max.is_nan() || max > bound {
            return Err(Error::check(format!(
                "{}, exact plant: feed-forward's largest error is {max:.2e} rad, more than the \
                 scene's bound of {bound:.2e}",
                report.scene
            )));
        }
        let beyond = bound > SLACK * max;
        if beyond {
            return Err(Error::check(format!(
                "{}: its bound of {bound:.2e} rad has become slack: the largest error is {max:.2e}",
                report.scene
            )));
        }
        seen.push(format!(
            "{} {:.2} of {:.2} mrad",
            report.scene,
            1e3 * max,
            1e3 * bound
        ));
        if report.scene != Scene::default().name() {
            continue;
        }
        let plants = [
            ("exact", &report.tracking),
            ("mismatched", &report.tracking_mismatched),
        ];
        for ((plant, tracking), largest) in plants.into_iter().zip(LARGEST_RATIO) {
            let ratio = tracking.ratio();
            // A ratio that is not a number fails as well.
            if ratio.is_nan() || ratio > largest {
                return Err(Error::check(format!(
                    "{}, {plant} plant: feed-forward's error is {ratio:.4} of PD's, more than \
                     {largest}",
                    report.scene
                )));
            }
            seen.push(format!("{plant} {ratio:.4}"));
        }
        let peak = measured.recording.peak_speed();
        if peak < LEAST_PEAK_SPEED {
            return Err(Error::check(format!(
                "{}: no joint is faster than {peak:.2} rad/s: too easy a trajectory",
                report.scene
            )));
        }
        seen.push(format!("peak speed {peak:.2} rad/s"));
    }
    Ok(Outcome::Passed(seen.join(", ")))
}

pub fn cycles(context: &Context) -> Result<Outcome> {
    let mut seen = Vec::new();
    for measured in context.measured()? {
        let (report, longest) = (&measured.report, measured.report.tick["total"].cycles.max);
        let period = f64::from(report.period_us) * CLOCK_MHZ;
        let share = longest as f64 / period;
        if share > LARGEST_SHARE {
            return Err(Error::check(format!(
                "{}: the longest tick takes {longest} modelled cycles, {:.0} % of its period",
                report.scene,
                100.0 * share
            )));
        }
        seen.push(format!("{} {longest}", report.scene));
    }
    Ok(Outcome::Passed(seen.join(", ")))
}

pub fn budgets(context: &Context) -> Result<Outcome> {
    let spare = context
        .measured()?
        .iter()
        .map(|measured| budgets::check(&context.workspace, &measured.report))
        .collect::<Result<Vec<_>>>()?;
    Ok(Outcome::Passed(spare.join("; ")))
}

pub fn readme(context: &Context) -> Result<Outcome> {
    let workspace = &context.workspace;
    for Measured {
        report, recording, ..
    } in context.measured()?
    {
        // The README shows the default scene alone.
        if report.scene == Scene::default().name() {
            docs::README.check(workspace, &report.markdown(), Some(&report.rustc))?;
            // What the scene does is the same to the bit, whatever compiled it.
            let picture = plot::svg(recording)?;
            docs::compare_picture(
                workspace,
                demo::PICTURE,
                docs::README.command,
                &picture,
                true,
            )?;
        }
    }
    if !context.full {
        return Ok(Outcome::Passed("README.md alone".into()));
    }
    let reports: Vec<_> = context.measured()?.iter().map(|one| &one.report).collect();
    let rustc = reports.first().map(|report| report.rustc.as_str());
    scenes::PAGE.check(workspace, &scenes::markdown(&reports), rustc)?;
    Outcome::PASSED
}

pub fn debian(context: &Context) -> Result<Outcome> {
    if context.tools.toolchain == Toolchain::Debian {
        return Ok(Outcome::Skipped("all of this ran with it".into()));
    }
    if System::this() != System::Debian {
        return Ok(Outcome::Skipped("not on Debian".into()));
    }
    if let Some(lack) = toolchain::debian_lacks() {
        if !context.may_install_debian {
            return Ok(Outcome::Skipped(format!(
                "{lack}; `cargo xtask test --debian` installs it"
            )));
        }
        let allowed = Privilege::this().needs_no_password();
        if context.options.no_install || !allowed {
            return Ok(Outcome::Skipped(format!("{lack}, and may not install it")));
        }
        if !DEBIAN_PACKAGES.iter().all(|name| system::apt_knows(name)) {
            return Ok(Outcome::Skipped(format!("{lack}, and apt has none")));
        }
    }
    let options = setup::Options {
        // Whoever may install it has been asked: by --debian.
        yes: context.may_install_debian,
        ..context.options
    };
    let toolchain = setup::debian(options)?;
    let scene = Scene::default();
    let elf = firmware::build(&context.workspace, toolchain, scene.name())?;
    let measured = demo::measure(
        &context.workspace,
        &context.tools,
        scene,
        toolchain,
        &elf,
        context.meter()?,
    )?;
    let spare = budgets::check(&context.workspace, &measured.report)?;
    Ok(Outcome::Passed(format!(
        "{}: {spare}",
        measured.report.rustc
    )))
}
