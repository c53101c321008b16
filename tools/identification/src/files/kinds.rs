//! The kinds of friction that the model lacks and the recording carries.
//!
//! Each kind is fitted beside the others on trial, Stribeck's effect at some speeds, and its torques
//! are compared with those that were not fitted: what only describes noise does not lower the
//! residuals there. A kind is reported at a joint whose residuals it lowers by a tenth, RMS.

use serde::Serialize;

use crate::{Comparison, TickRecording};

use super::attempt::{Attempt, Estimate, JointEffect, SPEEDS, Task, possible};

/// A kind is reported that leaves less than this of the residuals,
const LEFT: f64 = 0.9;
/// and lowers them by more than this share of the joint's largest torque.
const LOWERED: f64 = 1e-3;

/// A kind of friction at a joint.
#[derive(Clone, Debug, Serialize)]
pub struct Carried {
    pub joint: String,
    pub effect: JointEffect,
    /// The residuals of torques that were not fitted without it and with it, RMS, relative to the
    /// joint's largest torque.
    pub residuals: [f64; 2],
    /// The speed of Stribeck's effect, rad/s or m/s.
    pub speed: Option<f64>,
}

/// The kinds that are not identified, joint by joint, with the best one first.
pub(crate) fn carried<const V: usize>(
    task: &Task<'_>,
    [whole, part, held]: [&TickRecording<V>; 3],
    attempt: &Attempt<V>,
    names: &[String],
) -> Vec<Carried> {
    let effects = &task.options.effects;
    let with = |effect: Option<JointEffect>, stribeck: Option<f64>| -> Option<[f64; V]> {
        let all: Vec<JointEffect> = effects.iter().copied().chain(effect).collect();
        let found = task.estimate([whole, part], &all, stribeck, Some(attempt.fit.delay)).ok()?;
        residuals(&found, held)
    };
    let Some(before) = with(None, attempt.stribeck).filter(|_| held.ticks() > 0) else {
        return Vec::new();
    };
    let speeds = SPEEDS.map(|times| (JointEffect::Stribeck, Some(times * task.options.width)));
    let others = [JointEffect::Asymmetric, JointEffect::Load, JointEffect::Offset];
    let all = speeds.into_iter().chain(others.map(|effect| (effect, attempt.stribeck)));
    let is_new = |(effect, _): &(JointEffect, Option<f64>)| {
        let is_gear = *effect == JointEffect::Load && effects.contains(&JointEffect::Preslide);
        !is_gear && !effects.contains(effect)
    };
    let mut found: Vec<Carried> = Vec::new();
    for (effect, speed) in all.filter(is_new) {
        let Some(after) = with(Some(effect), speed) else { continue };
        for (j, joint) in names.iter().enumerate() {
            let residuals = [before[j], after[j]];
            if after[j] < LEFT * before[j] && before[j] - after[j] > LOWERED {
                let speed = speed.filter(|_| effect == JointEffect::Stribeck);
                found.push(Carried { joint: joint.clone(), effect, residuals, speed });
            }
        }
    }
    let place = |one: &Carried| names.iter().position(|name| *name == one.joint);
    found.sort_by(|a, b| (place(a).cmp(&place(b))).then(a.residuals[1].total_cmp(&b.residuals[1])));
    // Of a kind at several speeds the best one.
    let mut seen = Vec::new();
    found.retain(|one| {
        let own = (one.joint.clone(), one.effect);
        let is_first = !seen.contains(&own);
        seen.push(own);
        is_first
    });
    found
}

/// Of each joint what an estimate leaves of the torques, RMS, relative to the largest one.
fn residuals<const V: usize>(of: &Estimate<V>, held: &TickRecording<V>) -> Option<[f64; V]> {
    let model = [(&of.found.base[..], possible(&of.found))];
    let Comparison { measured, modelled, .. } = of.fit.compare(&of.arm, held, &model).ok()?;
    let share = |j: usize| {
        let pairs = measured.iter().zip(&modelled[0]);
        let square = pairs.map(|(a, b)| (a[j] - b[j]).powi(2)).sum::<f64>();
        let largest = measured.iter().map(|tau| tau[j].abs()).fold(1e-9, f64::max);
        (square / measured.len() as f64).sqrt() / largest
    };
    Some(std::array::from_fn(share))
}
