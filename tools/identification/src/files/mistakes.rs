//! Mistakes in a recording: a wrong unit, a reversed sign, shifted zeros, swapped columns, a joint
//! whose torques are late, another mounting.
//!
//! If no physically possible robot fits a recording, each mistake is corrected on trial and the
//! recording is fitted again. The mistake whose correction lowers the residuals most is reported if
//! they are near the noise then.

use crate::{OfJoint, Parameter, TickRecording};

use super::attempt::{Attempt, Estimate, Like, Task, own};
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
/// The squares of what several zeros leave count so many times: they have more freedom than one.
const SEVERAL: f64 = 1.5;
/// The time by which the torques of a single joint are moved for the first comparison, s.
const LATE: f64 = 0.02;
/// A correction that lowers them to this share ends the search.
const PLAIN: f64 = 0.03;
/// A correction that lowers the squares of the residuals to this share has its own delay.
const NEARLY: f64 = 0.25;
/// The search for a zero ends if more than this share of the residuals remains.
const MENDED: f64 = 0.8;

/// A change of a recording.
type Change<'a, const V: usize> = &'a dyn Fn(&TickRecording<V>) -> TickRecording<V>;
/// A change of the positions and torques of a tick.
type Changed<'a, const V: usize> = &'a dyn Fn([f64; V], [f64; V]) -> ([f64; V], [f64; V]);

/// A recording, its fit, and what was tried to explain what the fit leaves.
pub(crate) struct Trials<'a, const V: usize> {
    pub task: Task<'a>,
    pub whole: &'a TickRecording<V>,
    pub part: &'a TickRecording<V>,
    pub first: &'a Attempt<V>,
    pub names: &'a [String],
    /// The squares of the residuals with each correction, the largest share, and whether it
    /// explains the recording.
    tried: Vec<(f64, f64, bool, Mistake)>,
}

impl<'a, const V: usize> Trials<'a, V> {
    pub fn new(
        task: Task<'a>,
        [whole, part]: [&'a TickRecording<V>; 2],
        first: &'a Attempt<V>,
        names: &'a [String],
    ) -> Self {
        Self { task, whole, part, first, names, tried: Vec::new() }
    }

    /// The mistake that explains an estimate which no robot has, or residuals that the model
    /// leaves, if one does.
    pub fn explains(&mut self) -> Option<Mistake> {
        let first = self.first;
        let factor = unit(first);
        if is_unit(first, factor) {
            self.each(Mistake::Unit { factor }, &|q, tau| (q, tau.map(|tau| tau / factor)));
            if first.is_explained() {
                return Some(Mistake::Unit { factor });
            }
        }
        let reversed = reversed(first);
        let is_possible = first.set.misfit < IMPOSSIBLE && first.residual() < UNEXPLAINED.powi(2);
        if is_possible && reversed.is_empty() {
            return None;
        }
        let steps: [&dyn Fn(&mut Self); 5] = [
            &|all| all.signs(&reversed),
            &Self::zeros,
            &Self::late,
            &Self::swapped,
            &Self::mounted,
        ];
        // A correction that leaves more may hide another mistake, and the search goes on.
        for step in steps {
            step(self);
            if let Some((_, mistake)) = self.best().filter(|(left, _)| *left < PLAIN) {
                return Some(mistake);
            }
        }
        self.best().map(|(_, mistake)| mistake)
    }

    /// The fit after a change, with the delay of the first fit and without one.
    fn after(&self, task: Task<'_>, to: Change<'_, V>) -> Option<(TickRecording<V>, Attempt<V>)> {
        let [whole, part] = [self.whole, self.part].map(to);
        let own = self.first.estimate.fit.delay;
        let mut delays = vec![own, if task.held { 0.5 * part.tick() } else { 0.0 }];
        delays.dedup();
        let fit = |delay| {
            let like = Like { stribeck: self.first.stribeck, delay: Some(delay) };
            // Nothing is explained by what leads beyond the joints' limits.
            task.attempt(&whole, &part, Some(like)).ok()
        };
        let fits = delays.into_iter().filter_map(fit);
        let best = fits.min_by(|a, b| a.residual().total_cmp(&b.residual()))?;
        Some((part, best))
    }

    fn add(&mut self, mistake: Mistake, found: Option<&Attempt<V>>) {
        self.tried.extend(found.map(|found| {
            let worst = found.shares.into_iter().fold(0.0, f64::max);
            (found.residual(), worst, found.is_explained(), mistake)
        }));
    }

    /// A change in each tick; with the delay that it has, if it lowers the residuals by far and
    /// leaves more than noise.
    fn each(&mut self, mistake: Mistake, to: Changed<'_, V>) {
        let to = |recording: &TickRecording<V>| recording.map(to);
        let Some((part, mut found)) = self.after(self.task, &to) else { return };
        if found.residual() < NEARLY * self.first.residual() && !found.is_explained() {
            let like = Like { stribeck: self.first.stribeck, delay: None };
            found = self.task.attempt(&to(self.whole), &part, Some(like)).unwrap_or(found);
        }
        self.add(mistake, Some(&found));
    }

    /// The torques or the positions of joints with the other sign.
    fn signs(&mut self, reversed: &[usize]) {
        let each: Vec<Vec<usize>> = match reversed.is_empty() {
            true => (0..V).map(|joint| vec![joint]).collect(),
            false => vec![reversed.to_vec()],
        };
        for joints in each {
            let turned = |x: [f64; V]| -> [f64; V] {
                std::array::from_fn(|j| if joints.contains(&j) { -x[j] } else { x[j] })
            };
            let named: Vec<String> = joints.iter().map(|&j| self.names[j].clone()).collect();
            let torque = Mistake::TorqueSign { joints: named.clone() };
            self.each(torque, &|q, tau| (q, turned(tau)));
            self.each(Mistake::PositionSign { joints: named }, &|q, tau| (turned(q), tau));
        }
    }

    /// The zero of each joint, and those of all together.
    fn zeros(&mut self) {
        let [least, most] = SHIFTS;
        for only in (0..V).map(Some).chain([None]) {
            let Some((shift, found)) = self.shifted(only) else { continue };
            let named = shift.iter().zip(self.names).filter(|(shift, _)| shift.abs() >= least);
            let shifts: Vec<(String, f64)> = named.map(|(s, name)| (name.clone(), *s)).collect();
            if shifts.is_empty() || shift.iter().any(|shift| shift.abs() > most) {
                continue;
            }
            let mistake = match &shifts[..] {
                [(joint, shift)] => Mistake::Zero { joint: joint.clone(), shift: *shift },
                _ => Mistake::Zeros { shifts },
            };
            self.add(mistake, Some(&found));
        }
    }

    /// The shifts of the zero of a joint, or of all, that leave the least residuals, by steps of
    /// Gauss and Newton.
    fn shifted(&self, only: Option<usize>) -> Option<([f64; V], Attempt<V>)> {
        let before = self.first.residual();
        let (mut shift, mut best) = ([0.0; V], None);
        let (mut left, mut step) = (before, self.first.shifts(self.part, only).ok()?);
        for _ in 0..STEPS {
            let to: [f64; V] =
                std::array::from_fn(|j| shift[j] + step[j].clamp(-FARTHEST, FARTHEST));
            let moved = |q: [f64; V], tau| (std::array::from_fn(|j| q[j] + to[j]), tau);
            let corrected = self.after(self.task, &|recording| recording.map(moved));
            let Some((part, found)) = corrected.filter(|(_, found)| found.residual() < left) else {
                break;
            };
            (shift, left) = (to, found.residual());
            let next = found.shifts(&part, only);
            best = Some(found);
            step = next.ok()?;
            if step.iter().all(|step| step.abs() < 0.1 * SHIFTS[0]) || left > MENDED * before {
                break;
            }
        }
        best.map(|best| (shift, best))
    }

    /// The torques of one joint earlier or later: the minimum of a parabola.
    fn late(&mut self) {
        let before = self.first.residual();
        let worst = self.first.shares.into_iter().fold(0.0, f64::max);
        for joint in (0..V).filter(|&joint| self.first.shares[joint] > 0.5 * worst) {
            let ticks = |seconds: f64| (seconds / self.part.tick()).round() as isize;
            let moved = |ticks: isize| self.after(self.task, &|all| all.later(joint, ticks));
            let square = |ticks| moved(ticks).map(|(_, found)| found.residual());
            let step = ticks(LATE).max(1);
            let Some([late, early]) = square(step).zip(square(-step)).map(<[f64; 2]>::from) else {
                continue;
            };
            let bend = (early - 2.0 * before + late).max(f64::MIN_POSITIVE);
            let place = (0.5 * (early - late) / bend).clamp(-2.0, 2.0);
            let by = (place * step as f64).round() as isize;
            let found = moved(by).filter(|_| by != 0);
            let (joint, seconds) = (self.names[joint].clone(), self.part.tick() * by as f64);
            self.add(Mistake::Late { joint, seconds }, found.as_ref().map(|(_, found)| found));
        }
    }

    /// Two torques, or two positions, in each other's columns, and radians that a map takes as
    /// degrees.
    fn swapped(&mut self) {
        if self.first.is_explained() {
            return;
        }
        self.each(Mistake::Radians, &|q, tau| (q.map(f64::to_degrees), tau));
        let is_bad = |joint: &usize| self.first.shares[*joint] > super::attempt::EXPLAINED;
        let bad: Vec<usize> = (0..V).filter(is_bad).collect();
        for (&a, &b) in
            bad.iter().flat_map(|b| bad.iter().take_while(|a| *a < b).map(move |a| (a, b)))
        {
            for are_torques in [true, false] {
                let swap = |mut x: [f64; V], is_wanted: bool| {
                    if is_wanted {
                        x.swap(a, b);
                    }
                    x
                };
                let joints = [a, b].map(|j| self.names[j].clone());
                self.each(Mistake::Swapped { joints, are_torques }, &|q, tau| {
                    (swap(q, !are_torques), swap(tau, are_torques))
                });
            }
        }
    }

    /// The base on a wall or a ceiling.
    fn mounted(&mut self) {
        if self.first.is_explained() {
            return;
        }
        for (axis, sign) in (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
            let mut gravity = [0.0; 3];
            gravity[axis] = sign;
            if gravity != self.task.gravity {
                let task = Task { gravity, ..self.task };
                let found = self.after(task, &TickRecording::clone);
                self.add(Mistake::Mounting { gravity }, found.as_ref().map(|(_, found)| found));
            }
        }
    }

    /// The correction with the least residuals, and the share of their squares that it leaves, if
    /// they are near the noise.
    fn best(&self) -> Option<(f64, Mistake)> {
        let several = |mistake: &Mistake| matches!(mistake, Mistake::Zeros { .. });
        let cost = |(left, _, _, mistake): &&(f64, f64, bool, Mistake)| {
            left * if several(mistake) { SEVERAL } else { 1.0 }
        };
        let (left, _, is_explained, mistake) =
            self.tried.iter().min_by(|a, b| cost(a).total_cmp(&cost(b)))?;
        let share = match mistake {
            Mistake::Zero { .. } | Mistake::Zeros { .. } => EXPLAINED_BY_ZERO,
            _ => EXPLAINED,
        };
        let is_lower = *left < share * self.first.residual();
        (is_lower && *is_explained).then(|| (left / self.first.residual(), mistake.clone()))
    }

    /// The largest share of a torque that the best correction of each kind leaves.
    pub fn kinds(&self) -> Vec<(String, f64)> {
        let mut kinds: Vec<(String, f64)> = Vec::new();
        for (_, worst, _, mistake) in &self.tried {
            // The name in the JSON.
            let all = serde_json::to_value(mistake).unwrap_or_default();
            let kind = all["kind"].as_str().unwrap_or_default().replace('_', " ");
            match kinds.iter_mut().find(|(own, _)| *own == kind) {
                Some((_, least)) => *least = least.min(*worst),
                None => kinds.push((kind, *worst)),
            }
        }
        kinds
    }
}

/// Whether a ratio of the estimate's moments of mass to the description's is that of a unit: the
/// frictions that the description has are then off by it, too.
fn is_unit<const V: usize>(attempt: &Attempt<V>, factor: f64) -> bool {
    let bound = match frictions(attempt) {
        Some(friction) if (friction.ln() - factor.ln()).abs() > friction.ln().abs() => {
            return false;
        }
        Some(_) => OTHER_UNIT,
        None => 2.0 * OTHER_UNIT,
    };
    !(bound.recip()..=bound).contains(&factor)
}

/// The ratio of the estimated frictions to the description's, if it has some.
fn frictions<const V: usize>(attempt: &Attempt<V>) -> Option<f64> {
    let Estimate { arm, found, nominal, .. } = &attempt.estimate;
    let scales = arm.scales();
    let all = (0..V).flat_map(|j| [OfJoint::Viscous, OfJoint::Coulomb].map(|of| own(arm, j, of)));
    let sum = |of: &[f64]| -> f64 {
        all.clone().flatten().map(|base| (scales[base] * of[base]).abs()).sum()
    };
    let [found, nominal] = [&found.base, nominal].map(|of| sum(of));
    (nominal > 0.0 && found > 0.0).then(|| found / nominal)
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
