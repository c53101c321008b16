//! The kinds of friction that the model lacks and the recording carries.
//!
//! Each kind is fitted beside the others on trial, Stribeck's effect at some speeds, and its torques
//! are compared with those that were not fitted: what only describes noise does not lower the
//! residuals there. A kind is reported at a joint whose residuals it lowers by a tenth, RMS.

use serde::Serialize;

use crate::TickRecording;

use super::attempt::{Attempt, JointEffect, SPEEDS, Task, bell};

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
    use JointEffect::{Asymmetric, Load, Offset, Preslide, Stribeck};
    let effects = &task.options.effects;
    let speeds = SPEEDS.map(|times| (Stribeck, Some(times * task.options.width)));
    let all = speeds.into_iter().chain([Asymmetric, Load, Offset].map(|effect| (effect, None)));
    let is_new = |(effect, _): &(JointEffect, Option<f64>)| {
        !effects.contains(effect) && !(*effect == Load && effects.contains(&Preslide))
    };
    let kinds: Vec<(JointEffect, Option<f64>)> = all.filter(is_new).collect();
    let delay = Some(attempt.fit.delay);
    let Ok(estimate) = task.estimate([whole, part], effects, attempt.stribeck, delay) else {
        return Vec::new();
    };
    let left = estimate.further([part, held], |_, sign, qd, tau| {
        let column = |(effect, speed): &(JointEffect, Option<f64>)| match (effect, speed) {
            (_, Some(speed)) => bell(sign, qd, *speed),
            (Asymmetric, _) => sign * sign,
            (Load, _) => sign * tau.abs(),
            _ => 1.0,
        };
        kinds.iter().map(column).collect()
    });
    // A part of the recording itself may be too short for the filter.
    let Ok([before, after @ ..]) = left.as_deref() else { return Vec::new() };
    let extremes = held.extremes();
    let mut found = Vec::new();
    for (j, joint) in names.iter().enumerate() {
        let share = |left: &[f64; V]| left[j] / extremes[j][2].max(1e-9);
        let of = |((effect, speed), after): (&(JointEffect, Option<f64>), &[f64; V])| Carried {
            joint: joint.clone(),
            effect: *effect,
            residuals: [before, after].map(share),
            speed: *speed,
        };
        let mut own: Vec<Carried> = kinds.iter().zip(after).map(of).collect();
        own.retain(|one| {
            let [before, after] = one.residuals;
            after < LEFT * before && before - after > LOWERED
        });
        own.sort_by(|a, b| a.residuals[1].total_cmp(&b.residuals[1]));
        // Of Stribeck's effect the best speed.
        let mut first = true;
        own.retain(|one| one.speed.is_none() || std::mem::take(&mut first));
        found.extend(own);
    }
    found
}
