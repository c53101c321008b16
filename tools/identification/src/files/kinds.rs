//! The kinds of friction that the model lacks and the recording carries.
//!
//! The residual torque of a joint is fitted by each kind, Stribeck's effect at some
//! speeds, together with changes of its viscous and Coulomb friction and of its offset, and compared
//! with torques that were not fitted: what only describes noise does not lower the residuals there.

use dynamics_core::effects::smooth_sign;
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use crate::Comparison;

use super::attempt::{JointEffect, Options, SPEEDS, bell};

/// A kind is reported that leaves less than this of the residuals,
const LEFT: f64 = 0.9;
/// and lowers them by more than this share of the joint's largest torque.
const LOWERED: f64 = 1e-3;

/// A kind of friction at a joint.
#[derive(Clone, Debug, Serialize)]
pub struct FrictionKind {
    pub joint: String,
    pub effect: JointEffect,
    /// The residuals of torques that were not fitted without it and with it, RMS, relative to the
    /// joint's largest torque.
    pub residuals: [f64; 2],
    /// The speed of Stribeck's effect, rad/s or m/s.
    pub speed: Option<f64>,
}

/// The kinds that are not identified, joint by joint, with the best one first, by torques that were
/// fitted and others beside those of a description and of what was found.
pub(crate) fn carried<const V: usize>(
    options: &Options,
    [fitted, held]: [&Comparison<V>; 2],
    names: &[String],
) -> Vec<FrictionKind> {
    use JointEffect::{Asymmetric, Load, Preslide, Stribeck};
    let speeds = SPEEDS.map(|times| (Stribeck, Some(times * options.width)));
    let all = speeds.into_iter().chain([(Asymmetric, None), (Load, None)]);
    let is_known = |effect| options.effects.contains(&effect);
    let kinds =
        all.filter(|(effect, _)| !(is_known(*effect) || *effect == Load && is_known(Preslide)));
    let kinds: Vec<(JointEffect, Option<f64>)> = kinds.collect();
    let mut found = Vec::new();
    for (j, joint) in names.iter().enumerate() {
        // The residual torques, and the columns of smooth sign, speed, offset and a kind.
        let equations = |of: &Comparison<V>, kind: Option<(JointEffect, Option<f64>)>| {
            let mut rows = DMatrix::zeros(of.times.len(), 4);
            let left = |k: usize| of.measured[k][j] - of.modelled[1][k][j];
            for (k, speed) in of.speeds.iter().enumerate() {
                let (qd, sign) = (speed[j], smooth_sign(speed[j] / options.width));
                let own = match kind {
                    Some((_, Some(speed))) => bell(sign, qd, speed),
                    Some((Load, _)) => sign * of.modelled[1][k][j].abs(),
                    Some(_) => sign * sign,
                    None => 0.0,
                };
                rows.row_mut(k).copy_from_slice(&[sign, qd, 1.0, own]);
            }
            (rows, DVector::from_fn(of.times.len(), |k, _| left(k)))
        };
        let largest = held.measured.iter().map(|tau| tau[j].abs()).fold(1e-9, f64::max);
        let share = |kind| {
            let (rows, left) = equations(fitted, kind);
            let by =
                rows.svd(true, true).solve(&left, 1e-9 * left.len() as f64).unwrap_or_default();
            let (rows, left) = equations(held, kind);
            (left - rows * by).norm() / (held.times.len() as f64).sqrt() / largest
        };
        let before = share(None);
        let of = |&(effect, speed)| FrictionKind {
            joint: joint.clone(),
            effect,
            residuals: [before, share(Some((effect, speed)))],
            speed,
        };
        let mut own: Vec<FrictionKind> = kinds.iter().map(of).collect();
        own.retain(|one| one.residuals[1] < (LEFT * before).min(before - LOWERED));
        own.sort_by(|a, b| a.residuals[1].total_cmp(&b.residuals[1]));
        // The best speed of Stribeck's effect.
        let mut first = true;
        own.retain(|one| one.speed.is_none() || std::mem::take(&mut first));
        found.extend(own);
    }
    found
}
