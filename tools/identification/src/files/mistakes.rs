//! Mistakes in a recording: a wrong unit of torque, a reversed sign, a shifted zero.
//!
//! If no physically possible robot fits a recording, each mistake is corrected on trial and the
//! recording is fitted again. The mistake whose correction lowers the residuals most is reported.

use crate::{OfJoint, Parameter, TickRecording};

use super::attempt::{Attempt, Task, own};
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
/// The distance of the three points of a parabola, rad or m.
const SHIFT: f64 = 0.05;
/// The smallest and the largest shift of a zero that is reported, rad or m.
const SHIFTS: [f64; 2] = [0.01, 0.5];
/// The largest number of parabolas for the zero of a joint.
const PARABOLAS: usize = 4;
/// The search for a zero ends if more than this share of the residuals remains.
const MENDED: f64 = 0.8;

/// The corrections of a recording, joint by joint.
#[derive(Clone, Copy)]
struct Correction<const V: usize> {
    torque: [f64; V],
    position: [f64; V],
    shift: [f64; V],
}

impl<const V: usize> Correction<V> {
    const NONE: Self = Self { torque: [1.0; V], position: [1.0; V], shift: [0.0; V] };

    fn of(&self, recording: &TickRecording<V>) -> TickRecording<V> {
        recording.map(|q, tau| {
            (
                std::array::from_fn(|j| self.position[j] * q[j] + self.shift[j]),
                std::array::from_fn(|j| self.torque[j] * tau[j]),
            )
        })
    }
}

/// The mistake that explains an estimate which no robot has, or residuals that the model leaves, if
/// one does.
pub(crate) fn explains<const V: usize>(
    task: &Task<'_>,
    whole: &TickRecording<V>,
    part: &TickRecording<V>,
    attempt: &Attempt<V>,
    names: &[String],
) -> Option<Mistake> {
    let after = |correction: Correction<V>| {
        let [whole, part] = [whole, part].map(|recording| correction.of(recording));
        let corrected = task.attempt(&whole, &part, Some(attempt));
        // Nothing is explained by a zero that leads beyond the joint's limits.
        corrected.map_or(f64::INFINITY, |corrected| corrected.residual)
    };
    let before = attempt.residual;
    let factor = unit(attempt);
    if !(OTHER_UNIT.recip()..=OTHER_UNIT).contains(&factor) {
        let same = Correction { torque: [1.0 / factor; V], ..Correction::NONE };
        if after(same) < 2.0 * before {
            return Some(Mistake::Unit { factor });
        }
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
        let signs = std::array::from_fn(|j| if joints.contains(&j) { -1.0 } else { 1.0 });
        let joints: Vec<String> = joints.iter().map(|&j| names[j].clone()).collect();
        let torque = Correction { torque: signs, ..Correction::NONE };
        let position = Correction { position: signs, ..Correction::NONE };
        let named = joints.clone();
        tried.push((after(torque), Mistake::TorqueSign { joints }));
        tried.push((after(position), Mistake::PositionSign { joints: named }));
    }
    tried.extend((0..V).filter_map(|joint| zero(joint, names, before, &after)));
    let best = tried.into_iter().min_by(|(a, _), (b, _)| a.total_cmp(b));
    let most = |mistake: &Mistake| match mistake {
        Mistake::Zero { .. } => EXPLAINED_BY_ZERO,
        _ => EXPLAINED,
    };
    best.filter(|(left, mistake)| *left < most(mistake) * before).map(|(_, mistake)| mistake)
}

/// The shift of a joint's zero that leaves the least residuals: the minimum of the parabola through
/// three of them.
fn zero<const V: usize>(
    joint: usize,
    names: &[String],
    before: f64,
    after: &impl Fn(Correction<V>) -> f64,
) -> Option<(f64, Mistake)> {
    let at = |shift: f64| {
        let mut correction = Correction::NONE;
        correction.shift[joint] = shift;
        after(correction)
    };
    let (mut shift, mut left) = (0.0, before);
    for _ in 0..PARABOLAS {
        let [back, ahead] = [shift - SHIFT, shift + SHIFT].map(at);
        let bend = back - 2.0 * left + ahead;
        let change = 0.5 * SHIFT * (back - ahead) / bend;
        // If the residuals are no parabola, or one side is beyond the limits, the better side is
        // tried.
        let change = match bend > 0.0 && change.is_finite() {
            true => change.clamp(-2.0 * SHIFT, 2.0 * SHIFT),
            false => SHIFT * if back < ahead { -1.0 } else { 1.0 },
        };
        let next = at(shift + change);
        if next >= left {
            break;
        }
        (shift, left) = (shift + change, next);
        if change.abs() < 0.1 * SHIFT || left > MENDED * before {
            break;
        }
    }
    let [least, most] = SHIFTS;
    let joint = names[joint].clone();
    (least..=most).contains(&shift.abs()).then_some((left, Mistake::Zero { joint, shift }))
}

/// The ratio of the estimated first moments of mass to the description's, by least squares
/// relative to their torques.
fn unit<const V: usize>(attempt: &Attempt<V>) -> f64 {
    let (mut product, mut square) = (0.0, 0.0);
    for (base, scale) in attempt.arm.scales().into_iter().enumerate() {
        let (_, own) = attempt.arm.terms(base)[0];
        let is_moment = matches!(own, Parameter::Body { place: 1..=3, .. });
        if is_moment && attempt.found.is_determined(base) {
            let [found, nominal] =
                [&attempt.found.base, &attempt.nominal].map(|all| scale * all[base]);
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
    let (found, scales) = (&attempt.found, attempt.arm.scales());
    let is_negative = |joint: usize, of: OfJoint| {
        let base = own(&attempt.arm, joint, of);
        base.is_some_and(|base| found.base[base] < -REVERSED * found.deviations[base])
    };
    let drives = |joint: usize| {
        // One of the two is negative in a recording whose friction is of another kind.
        let kinds = [OfJoint::Viscous, OfJoint::Coulomb];
        let torque = |of| own(&attempt.arm, joint, of).map(|base| found.base[base] * scales[base]);
        let sum: f64 = kinds.into_iter().filter_map(torque).sum();
        kinds.into_iter().any(|of| is_negative(joint, of)) && sum < 0.0
    };
    (0..V).filter(|&joint| drives(joint)).collect()
}
