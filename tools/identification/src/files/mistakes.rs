//! Mistakes in a recording: a wrong unit, a reversed sign, shifted zeros, swapped columns, another
//! mounting.
//!
//! If no physically possible robot fits a recording, each mistake is corrected on trial and a part
//! of the recording is fitted again, at a lower rate. The mistake whose correction lowers the
//! residuals most is reported if they are near the noise then.

use crate::{OfJoint, Parameter, TickRecording};

use super::attempt::{Attempt, EXPLAINED, Estimate, Options, Task, own};
pub use super::mistake::Mistake;

/// A physical set at more than this distance from the estimate, in standard deviations, does not
/// fit.
pub const IMPOSSIBLE: f64 = 3.0;
/// Mistakes are looked for if the residuals exceed this share of the joints' largest torques.
const NOISE: f64 = 0.02;
/// A mistake is reported if its correction lowers the mean square of the residuals to this share.
const MENDED: f64 = 0.6;
/// The same of a zero, which also other centres of mass explain in part.
const MENDED_BY_ZERO: f64 = 0.85;
/// The squares of what several zeros leave count so many times: they have more freedom than one.
const SEVERAL: f64 = 1.1;
/// A correction that lowers them to this share ends the search.
const PLAIN: f64 = 0.03;
/// The unit of torque is wrong if the torques exceed those of the description, or are exceeded by
/// them, by this factor; masses of a description may be off by less.
const OTHER_UNIT: f64 = 10.0;
/// A friction below zero by this number of standard deviations indicates a reversed sign.
const REVERSED: f64 = 3.0;
/// The longest step of a zero, rad or m, and the largest number of steps.
const FARTHEST: f64 = 0.2;
const STEPS: usize = 4;
/// The smallest and the largest shift of a zero that is reported, rad or m.
const SHIFTS: [f64; 2] = [0.02, 0.5];
/// A position that changes by less is constant, rad or m.
const DEAD: f64 = 1e-9;
/// The most steps to the physical set of a trial.
const TRIAL: usize = 300;
/// The least tick of the trials, s, and the most ticks.
const TICK: f64 = 16e-3;
const TICKS: f64 = 3000.0;

/// A change of each tick and of the base.
#[derive(Clone, Copy)]
struct Correction<const V: usize> {
    /// The columns of the positions and of the torques, and their factors.
    columns: [[usize; V]; 2],
    factors: [[f64; V]; 2],
    shifts: [f64; V],
    gravity: [f64; 3],
}

impl<const V: usize> Correction<V> {
    fn of(&self, recording: &TickRecording<V>) -> TickRecording<V> {
        recording.map(|q, tau| {
            let of = |k: usize, x: [f64; V]| -> [f64; V] {
                std::array::from_fn(|j| self.factors[k][j] * x[self.columns[k][j]])
            };
            let q = of(0, q);
            (std::array::from_fn(|j| q[j] + self.shifts[j]), of(1, tau))
        })
    }
}

/// A mistake, and the fit after its correction.
struct Tried<const V: usize> {
    mistake: Mistake,
    correction: Correction<V>,
    fit: Attempt<V>,
}

impl<const V: usize> Tried<V> {
    /// What the correction leaves; several zeros have more freedom than one.
    fn cost(&self) -> f64 {
        match &self.mistake {
            Mistake::Zero { shifts } if shifts.len() > 1 => SEVERAL * self.fit.residual(),
            _ => self.fit.residual(),
        }
    }
}

/// A part of a recording at a lower rate, and the best correction so far.
struct Trials<'a, const V: usize> {
    task: Task<'a>,
    recordings: [TickRecording<V>; 2],
    names: &'a [String],
    none: Correction<V>,
    first: &'a Attempt<V>,
    best: Option<Tried<V>>,
}

/// The mistake that explains an estimate which no robot has, or residuals that the model leaves, if
/// one does.
pub(crate) fn explains<const V: usize>(
    task: Task<'_>,
    recordings: [&TickRecording<V>; 2],
    first: &Attempt<V>,
    names: &[String],
) -> Option<Mistake> {
    let (factor, reversed) = (unit(first), reversed(first));
    let is_unit = !(OTHER_UNIT.recip()..=OTHER_UNIT).contains(&factor);
    let is_possible = first.set.misfit < IMPOSSIBLE && first.residual() < NOISE.powi(2);
    if is_possible && reversed.is_empty() && !is_unit {
        return None;
    }
    let options = Options { cutoff: None, ..task.options.clone() };
    let lower = |all: &TickRecording<V>| {
        let means = (TICK / all.tick()).round().max(1.0) as usize;
        all.split((TICKS * means as f64 / all.ticks() as f64).min(1.0)).0.means(means)
    };
    let mut trials = Trials {
        task: Task { options: &options, steps: TRIAL, ..task },
        recordings: recordings.map(lower),
        names,
        none: Correction {
            columns: [std::array::from_fn(|j| j); 2],
            factors: [[1.0; V]; 2],
            shifts: [0.0; V],
            gravity: task.gravity,
        },
        first,
        best: None,
    };
    if is_unit {
        let factors = [[1.0; V], [factor.recip(); V]];
        let fit = trials.fit(&Correction { factors, ..trials.none });
        if fit.is_some_and(|fit| fit.is_explained()) {
            return Some(Mistake::Unit { factor });
        }
    }
    let before = trials.fit(&trials.none)?;
    let is_plain = |trials: &Trials<'_, V>| {
        trials.best.as_ref().is_some_and(|best| best.cost() < PLAIN * before.residual())
    };
    trials.signs(&reversed);
    // A joint whose encoder is dead moves as no other correction makes it move.
    let is_dead = recordings[0].extremes().iter().any(|[low, high, _]| high - low < DEAD);
    if !is_plain(&trials) && !is_dead {
        trials.zeros(&before);
    }
    if !is_plain(&trials) && !is_dead && !before.is_explained() {
        trials.swapped(&before);
        trials.mounted();
    }
    let mut best = trials.best.take()?;
    if !best.fit.is_explained() {
        // A delay is another mistake, and was estimated with this one.
        best.fit = trials.at(&best.correction, None)?;
    }
    let share = match best.mistake {
        Mistake::Zero { .. } => MENDED_BY_ZERO,
        _ => MENDED,
    };
    let is_lower = best.fit.residual() < share * before.residual();
    (is_lower && best.fit.is_explained()).then_some(best.mistake)
}

impl<const V: usize> Trials<'_, V> {
    /// The fit after a correction at this delay.
    fn at(&self, correction: &Correction<V>, delay: Option<f64>) -> Option<Attempt<V>> {
        let [whole, part] = self.recordings.each_ref().map(|all| correction.of(all));
        let task = Task { gravity: correction.gravity, ..self.task };
        // Nothing is explained by what leads beyond the joints' limits.
        task.limits(&whole).ok()?;
        let first = &self.first.estimate.arm;
        let is_same = correction.gravity == self.none.gravity
            && correction.columns == self.none.columns
            && correction.factors.as_flattened().iter().all(|factor| factor.abs() == 1.0);
        let arm = match is_same {
            true => first.clone(),
            false => task.base(&whole, first.friction.stribeck).ok()?,
        };
        task.attempt(arm, &part, delay).ok()
    }

    /// The same without a delay, or with that of the first fit.
    fn fit(&self, correction: &Correction<V>) -> Option<Attempt<V>> {
        let mut delays = vec![self.task.delay, self.first.estimate.fit.delay];
        delays.dedup();
        let fits = delays.into_iter().filter_map(|delay| self.at(correction, Some(delay)));
        fits.min_by(|a, b| a.residual().total_cmp(&b.residual()))
    }

    fn add(&mut self, mistake: Mistake, correction: Correction<V>) {
        if let Some(fit) = self.fit(&correction) {
            self.keep(Tried { mistake, correction, fit });
        }
    }

    fn keep(&mut self, tried: Tried<V>) {
        if self.best.as_ref().is_none_or(|best| tried.cost() < best.cost()) {
            self.best = Some(tried);
        }
    }

    /// The torques or the positions of joints with the other sign.
    fn signs(&mut self, reversed: &[usize]) {
        let each: Vec<Vec<usize>> = match reversed.is_empty() {
            true => (0..V).map(|joint| vec![joint]).collect(),
            false => vec![reversed.to_vec()],
        };
        for (joints, k) in each.iter().flat_map(|joints| [(joints, 1), (joints, 0)]) {
            let mut correction = self.none;
            joints.iter().for_each(|&j| correction.factors[k][j] = -1.0);
            let joints = joints.iter().map(|&j| self.names[j].clone()).collect();
            let mistake = match k {
                1 => Mistake::TorqueSign { joints },
                _ => Mistake::PositionSign { joints },
            };
            self.add(mistake, correction);
        }
    }

    /// The zero of the joint whose zero explains most, and those of all together, by steps of Gauss
    /// and Newton.
    fn zeros(&mut self, before: &Attempt<V>) {
        for mut among in [(0..V).map(Some).collect(), vec![None]] {
            let (mut correction, mut best) = (self.none, None::<Attempt<V>>);
            for _ in 0..STEPS {
                let last = best.as_ref().unwrap_or(before);
                let part = correction.of(&self.recordings[1]);
                let Ok((only, step)) = last.shifts(&part, &among) else { break };
                if step.iter().all(|step| step.abs() < 0.05 * SHIFTS[0]) {
                    break;
                }
                let mut next = correction;
                let steps = next.shifts.iter_mut().zip(step);
                steps.for_each(|(shift, step)| *shift += step.clamp(-FARTHEST, FARTHEST));
                let Some(fit) = self.fit(&next).filter(|fit| fit.residual() < last.residual())
                else {
                    break;
                };
                (correction, best, among) = (next, Some(fit), vec![only]);
            }
            let named = correction.shifts.into_iter().zip(self.names);
            let named = named.filter(|(shift, _)| shift.abs() >= SHIFTS[0]);
            let shifts: Vec<_> = named.map(|(shift, name)| (name.clone(), shift)).collect();
            let is_near = correction.shifts.iter().all(|shift| shift.abs() <= SHIFTS[1]);
            if let Some(fit) = best.filter(|_| is_near && !shifts.is_empty()) {
                self.keep(Tried { mistake: Mistake::Zero { shifts }, correction, fit });
            }
        }
    }

    /// Two torques, or two positions, in each other's columns.
    fn swapped(&mut self, before: &Attempt<V>) {
        let bad: Vec<usize> = (0..V).filter(|&j| before.shares[j] > EXPLAINED).collect();
        for (at, &b) in bad.iter().enumerate() {
            for (&a, are_torques) in bad[..at].iter().flat_map(|a| [(a, true), (a, false)]) {
                let mut correction = self.none;
                correction.columns[usize::from(are_torques)].swap(a, b);
                let joints = [a, b].map(|j| self.names[j].clone());
                self.add(Mistake::Swapped { joints, are_torques }, correction);
            }
        }
    }

    /// The base on a wall or a ceiling.
    fn mounted(&mut self) {
        for (axis, sign) in (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
            let mut gravity = [0.0; 3];
            gravity[axis] = sign;
            if gravity != self.task.gravity {
                self.add(Mistake::Mounting { gravity }, Correction { gravity, ..self.none });
            }
        }
    }
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
