//! The steps about what the scenes do.

use super::Context;
use crate::commands::demo;
use crate::kit::error::{Result, check, refuse_if};
use crate::kit::meter::CLOCK_MHZ;
use crate::kit::protocol::FEEDFORWARD;
use crate::kit::scene::Scene;
use crate::studies::budgets;
use crate::studies::scenes::plot;

/// The largest ratio of a scene's bound to the measured error.
const SLACK: f64 = 10.0;

/// The scenes whose feed-forward is held against PD alone.
const HELD: [&str; 2] = ["ur5e", "delta_pick"];

/// The largest error with feed-forward in these scenes as a share of PD's: with the exact model,
/// and with one that is off.
const LARGEST_RATIO: [f64; 2] = [0.1, 0.2];

/// The longest tick, as a share of its period.
const LARGEST_SHARE: f64 = 0.5;

/// The status of the safety gate in a run in which it changed nothing.
const PLAIN: &str = "mode Full, fault None, limited false";

/// The peak joint speed that the default scene must reach for its tracking to mean something,
/// rad/s.
const LEAST_PEAK_SPEED: f64 = 1.5;

/// The scene that runs twice: its laws are of the core and of the engine.
const TWICE: &str = "direct_drive";

pub fn runs(context: &Context) -> Result<String> {
    let mut ticks = 0;
    for measured in context.measured()? {
        let name = &measured.report.scene;
        // No law of the default scene needs the gate; other scenes have laws that show the need of
        // it.
        let is_checked = |law: &str| law == FEEDFORWARD || *name == Scene::default().name();
        let other = measured.recording.differing_status(PLAIN, is_checked);
        let run = other.as_deref().unwrap_or_default();
        refuse_if!(!run.is_empty(), "{name}: the safety gate stepped in: {run}");
        let picture = context.workspace.output(&format!("{name}.svg"))?;
        plot::write(&measured.recording, &picture)?;
        ticks += measured.recording.ticks as usize * measured.recording.runs.len();
    }
    let again = if context.full { twice(context)? } else { "" };
    Ok(format!("{ticks} ticks{again}; {}", tracking(context)?))
}

/// Fails unless two runs of a scene give the same bytes.
fn twice(context: &Context) -> Result<&'static str> {
    let (workspace, tools, meter) = (&context.workspace, &context.tools, context.meter()?);
    let mut scenes = context.measured()?.iter().zip(context.scenes());
    let found = scenes.find(|(_, scene)| scene.name() == TWICE);
    let (first, scene) = found.ok_or_else(|| check!("`{TWICE}` is not measured"))?;
    let again = demo::measure(workspace, tools, *scene, &first.elf, &meter)?;
    let ((log, costs), (log_again, costs_again)) = (&first.raw, &again.raw);
    refuse_if!(log != log_again, "two runs logged different bytes");
    refuse_if!(costs != costs_again, "two runs cost differently");
    Ok(", twice the same")
}

fn tracking(context: &Context) -> Result<String> {
    let mut outcomes = Vec::new();
    for measured in context.measured()? {
        let report = &measured.report;
        let (name, tracking) = (&report.scene, &report.tracking);
        let (max, bound) = (tracking.feedforward.max_rad, report.bound_rad);
        refuse_if!(
            max.is_nan() || max > bound,
            "{name}, exact plant: feed-forward's largest error is {max:.2e} rad, more than the \
                 scene's bound of {bound:.2e}"
        );
        // The distances of an arm that sticks scatter by more.
        refuse_if!(
            !report.is_guided() && bound > SLACK * max,
            "{name}: its bound of {bound:.2e} rad has become slack: the largest error is {max:.2e}"
        );
        let [max, bound] = [max, bound].map(|rad| format!("{:.2}", 1e3 * rad));
        let unit = if report.is_guided() { "mm" } else { "mrad" };
        outcomes.push(format!("{name} {max} of {bound} {unit}"));
        if !HELD.contains(&&**name) {
            continue;
        }
        let mismatched = &report.tracking_mismatched;
        let plants = [("exact", tracking), ("mismatched", mismatched)];
        for ((plant, tracking), largest) in plants.into_iter().zip(LARGEST_RATIO) {
            let ratio = tracking.ratio();
            // A ratio that is not a number fails as well.
            refuse_if!(
                ratio.is_nan() || ratio > largest,
                "{name}, {plant} plant: feed-forward's error is {ratio:.4} of PD's, more than \
                 {largest}"
            );
            outcomes.push(format!("{plant} {ratio:.4}"));
        }
        if name != Scene::default().name() {
            continue;
        }
        let peak = measured.recording.peak_speed();
        refuse_if!(
            peak < LEAST_PEAK_SPEED,
            "{name}: no joint is faster than {peak:.2} rad/s: too easy a trajectory"
        );
        outcomes.push(format!("peak speed {peak:.2} rad/s"));
    }
    Ok(outcomes.join(", "))
}

pub fn budgets(context: &Context) -> Result<String> {
    let mut outcomes = Vec::new();
    for measured in context.measured()? {
        let (report, longest) = (&measured.report, measured.report.tick["total"].cycles.max);
        let share = longest as f64 / (f64::from(report.period_us) * CLOCK_MHZ);
        let (name, percent) = (&report.scene, 100.0 * share);
        refuse_if!(
            share > LARGEST_SHARE,
            "{name}: the longest tick takes {longest} modelled cycles, {percent:.0} % of its period"
        );
        outcomes.push(budgets::check(&context.workspace, report)?);
    }
    Ok(outcomes.join("; "))
}

#[cfg(test)]
mod tests {
    use super::{HELD, Scene, TWICE};

    #[test]
    fn scenes_that_steps_name_exist() {
        let exists = |name: &&str| Scene::all().iter().any(|scene| scene.name() == *name);
        assert!(HELD.iter().chain([&TWICE]).all(exists));
    }
}
