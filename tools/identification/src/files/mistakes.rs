//! Mistakes in a recording: a wrong unit of torque, a reversed sign, a shifted zero.
//!
//! If no physically possible robot fits a recording, each mistake is corrected on trial and the
//! recording is fitted again. The mistake whose correction lowers the residuals most is reported.

use crate::{OfJoint, Parameter, TickRecording};

use super::attempt::{Attempt, Estimate, Task, own};
pub use super::mistake::Mistake;

/// A physical set at more than this distance from the estimate, in standard deviations, does not
/// fit.
pub const IMPOSSIBLE: f64 = 3.0;
/// Mistakes are looked for if the residuals exceed this share of the joints' largest torques.
const UNEXPLAINED: f64 = 0.02;
/// A mistake is reported if its correction lowers the mean square of the residuals to this share.
const EXPLAINED: f64 = 0.6;
/// The same of a zero, which also other centres of mass explain in part.
const EXPLAINED_BY_ZERO: f64 = 0.85;
/// The unit of torque is wrong if the torques exceed those of the description, or are exceeded by
/// them, by this factor.
const OTHER_UNIT: f64 = 5.0;
/// A friction below zero by this number of standard deviations indicates a reversed sign.
const REVERSED: f64 = 3.0;
/// The longest step of a zero, rad or m, and the largest number of steps.
const FARTHEST: f64 = 0.2;
const STEPS: usize = 4;
/// The smallest and the largest shift of a zero that is reported, rad or m.
const SHIFTS: [f64; 2] = [0.01, 0.5];
/// The search for a zero ends if more than this share of the residuals remains.
const MENDED: f64 = 0.8;

/// A change of the positions and torques of a tick.
type Changed<'a, const V: usize> = &'a dyn Fn([f64; V], [f64; V]) -> ([f64; V], [f64; V]);

/// The mistake that explains an estimate which no robot has, or residuals that the model leaves, if
/// one does.
pub(crate) fn explains<const V: usize>(
    task: &Task<'_>,
    whole: &TickRecording<V>,
    part: &TickRecording<V>,
    attempt: &Attempt<V>,
    names: &[String],
) -> Option<Mistake> {
    let after = |to: Changed<'_, V>| {
        let [whole, part] = [whole, part].map(|recording| recording.map(to));
        // Nothing is explained by a zero that leads beyond the joint's limits.
        task.attempt(&whole, &part, Some(attempt)).ok().map(|corrected| (part, corrected))
    };
    let left =
        |to: Changed<'_, V>| after(to).map_or(f64::INFINITY, |(_, corrected)| corrected.residual);
    let before = attempt.residual;
    let factor = unit(attempt);
    if !(OTHER_UNIT.recip()..=OTHER_UNIT).contains(&factor)
        && left(&|q, tau| (q, tau.map(|tau| tau / factor))) < 2.0 * before
    {
        return Some(Mistake::Unit { factor });
    }
    let reversed = reversed(attempt);
    let is_possible = attempt.set.misfit < IMPOSSIBLE && before < UNEXPLAINED.powi(2);
    if is_possible && reversed.is_empty() {
        return None;
    }
    let each: Vec<Vec<usize>> = match reversed.is_empty() {
        true => (0..V).map(|joint| vec![joint]).collect(),
        false => vec![reversed],
    };
    let mut tried = Vec::new();
    for joints in each {
        let turned = |x: [f64; V]| -> [f64; V] {
            std::array::from_fn(|j| if joints.contains(&j) { -x[j] } else { x[j] })
        };
        let named: Vec<String> = joints.iter().map(|&j| names[j].clone()).collect();
        let torque = left(&|q, tau| (q, turned(tau)));
        tried.push((torque, Mistake::TorqueSign { joints: named.clone() }));
        let position = left(&|q, tau| (turned(q), tau));
        tried.push((position, Mistake::PositionSign { joints: named }));
    }
    for (joint, step) in attempt.shifts(part).into_iter().flatten().enumerate() {
        let named = |shift| Mistake::Zero { joint: names[joint].clone(), shift };
        tried.extend(zero(joint, step, before, &after).map(|(left, shift)| (left, named(shift))));
    }
    let best = tried.into_iter().min_by(|(a, _), (b, _)| a.total_cmp(b));
    let (left, mistake) = best?;
    let is_zero = matches!(mistake, Mistake::Zero { .. });
    (left < before * if is_zero { EXPLAINED_BY_ZERO } else { EXPLAINED }).then_some(mistake)
}

/// The shift of a joint's zero that leaves the least residuals, and these, by steps of Gauss and
/// Newton of which this is the first.
fn zero<const V: usize>(
    joint: usize,
    mut step: f64,
    before: f64,
    after: &impl Fn(Changed<'_, V>) -> Option<(TickRecording<V>, Attempt<V>)>,
) -> Option<(f64, f64)> {
    let (mut shift, mut left) = (0.0, before);
    for _ in 0..STEPS {
        let to = shift + step.clamp(-FARTHEST, FARTHEST);
        let corrected = after(&|mut q, tau| {
            q[joint] += to;
            (q, tau)
        });
        let Some((part, attempt)) = corrected.filter(|(_, found)| found.residual < left) else {
            break;
        };
        (shift, left) = (to, attempt.residual);
        step = attempt.shifts(&part).ok()?[joint];
        if step.abs() < 0.1 * SHIFTS[0] || left > MENDED * before {
            break;
        }
    }
    let [least, most] = SHIFTS;
    (least..=most).contains(&shift.abs()).then_some((left, shift))
}

/// The ratio of the estimated first moments of mass to the description's, by least squares
/// relative to their torques.
fn unit<const V: usize>(attempt: &Attempt<V>) -> f64 {
    let (mut product, mut square) = (0.0, 0.0);
    let Estimate { arm, found, nominal, .. } = &attempt.estimate;
    for (base, scale) in arm.scales().into_iter().enumerate() {
        let (_, own) = arm.terms(base)[0];
        let is_moment = matches!(own, Parameter::Body { place: 1..=3, .. });
        if is_moment && found.is_determined(base) {
            let [found, nominal] = [&found.base, nominal].map(|all| scale * all[base]);
            product += found * nominal;
            square += nominal * nominal;
        }
    }
    match square > 0.0 {
        true => (product / square).abs(),
        // Without gravity nothing is compared.
        false => 1.0,
    }
}

/// The joints whose friction would drive them.
fn reversed<const V: usize>(attempt: &Attempt<V>) -> Vec<usize> {
    let Estimate { arm, found, .. } = &attempt.estimate;
    let scales = arm.scales();
    let is_negative = |joint: usize, of: OfJoint| {
        let base = own(arm, joint, of);
        base.is_some_and(|base| found.base[base] < -REVERSED * found.deviations[base])
    };
    let drives = |joint: usize| {
        // One of the two is negative in a recording whose friction is of another kind.
        let kinds = [OfJoint::Viscous, OfJoint::Coulomb];
        let torque = |of| own(arm, joint, of).map(|base| found.base[base] * scales[base]);
        let sum: f64 = kinds.into_iter().filter_map(torque).sum();
        kinds.into_iter().any(|of| is_negative(joint, of)) && sum < 0.0
    };
    (0..V).filter(|&joint| drives(joint)).collect()
}
