//! A fit of a part of a recording, with the physical set that it leaves.

use std::f64::consts::PI;
use std::path::Path;

use crate::{
    BaseModel, ExcitationLimits, Fit, Fitted, Friction, Gears, IdentificationError, OF_JOINT,
    OfJoint, Parameter, PhysicalSet, TickRecording,
};
use dynamics_core::effects::{Coriolis, Gravity, Inertia, RIGID_BODY, Width};
use dynamics_core::model::ArmModel;

use crate::physical::most_probable;

use super::delay;
use super::error::{Error, Result};
use super::robot::Robot;

/// The trust in the numbers of a description: a relative standard deviation.
const BELIEVED: f64 = 0.3;
/// The share of the highest frequency of the ticks up to which torques are compared.
const UNDER: f64 = 0.999;
/// The speeds of Stribeck's effect that are tried, relative to the width of the smooth sign.
pub(crate) const SPEEDS: [f64; 5] = [2.0, 4.0, 8.0, 16.0, 32.0];
/// The range of a joint without limits, rad, and the least speed and acceleration that are
/// compared, rad/s and rad/s².
const TURN: f64 = PI;
const SLOWEST: f64 = 0.2;
const SLOWEST_RATE: f64 = 1.0;
/// A joint that moves less rests, rad or m.
const RESTS: f64 = 1e-3;
/// By how much a joint may be beyond its limits, rad or m.
const BEYOND: f64 = 0.2;
/// The torques that are compared, relative to the largest one.
const MARGIN: f64 = 1.2;
/// The residuals of a joint with less than this share of the arm's largest torque are compared to
/// that: those of a light one are mostly of its encoder.
const LIGHT: f64 = 0.1;
/// An offset is shown by the recording from this many deviations on,
const SHOWN: f64 = 4.0;
/// and from this share of the joint's largest torque on.
const LEAST_OFFSET: f64 = 0.01;

/// The identified quantities of joints, and the way.
#[derive(Clone, Debug)]
pub struct Options {
    pub effects: Vec<JointEffect>,
    /// The width of the smooth sign of Coulomb friction, rad/s or m/s.
    pub width: f64,
    /// The frequency up to which torques are compared, Hz; if not given, 10 Hz or the highest one
    /// that the ticks allow.
    pub cutoff: Option<f64>,
    /// The share of the ticks that is held out, where there is no other recording.
    pub hold_out: f64,
}

/// An effect at joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "files", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum JointEffect {
    /// Viscous friction
    Viscous,
    /// Coulomb friction
    Coulomb,
    /// Inertia of the rotors
    Armature,
    /// Friction of gears that grows with the torque
    Load,
    /// Friction of gears that grows with the torque and holds at rest
    Preslide,
    /// A constant torque
    Offset,
    /// Friction that falls from rest to sliding
    Stribeck,
    /// Coulomb friction that differs with direction
    Asymmetric,
}

pub(crate) type Base<const V: usize> =
    BaseModel<ArmModel<f64, V>, (Gravity, Inertia, Coriolis), V, V>;

/// The results from a recording and the time of its torques.
pub(crate) struct Attempt<const V: usize> {
    pub estimate: Estimate<V>,
    pub set: PhysicalSet<V, V>,
    /// The torques of each row that the set leaves, N·m or N.
    pub left: Vec<[f64; V]>,
    /// The torque to which those of a joint are compared, N·m or N.
    pub largest: [f64; V],
    /// The root mean square at each joint of what the set leaves, relative to this torque.
    pub shares: [f64; V],
}

/// The parameters of a joint in the order of [`OfJoint`].
pub(crate) type OfOneJoint = [f64; OF_JOINT];

/// A robot, the file of its recording, and what is identified.
#[derive(Clone, Copy)]
pub(crate) struct Task<'a> {
    pub robot: &'a Robot,
    /// The direction of gravity in the frame of the base.
    pub gravity: [f64; 3],
    pub path: &'a Path,
    pub options: &'a Options,
    /// The most steps to the physical set.
    pub steps: usize,
    /// The time by which a torque belongs after its position, s, if nothing else is known.
    pub delay: f64,
}

/// The estimate of a part of a recording.
pub(crate) struct Estimate<const V: usize> {
    pub arm: Base<V>,
    pub bodies: [[f64; 10]; V],
    pub joints: [OfOneJoint; V],
    pub nominal: Vec<f64>,
    pub known: Vec<bool>,
    pub fit: Fit,
    pub found: Fitted<V>,
    /// The end of the search for the delay, s, if the residuals fall up to it.
    pub delay_end: Option<f64>,
}

impl Task<'_> {
    pub fn failed(&self, source: IdentificationError) -> Error {
        let path = self.path.to_owned();
        Error::Identification { path, source }
    }

    /// The limits within which the motion is compared with random ones: positions of the
    /// description, the speeds of the recording.
    pub fn limits<const V: usize>(
        &self,
        recording: &TickRecording<V>,
    ) -> Result<ExcitationLimits<V>> {
        let (robot, path) = (self.robot, self.path);
        let mut limits = ExcitationLimits {
            lower: [-TURN; V],
            upper: [TURN; V],
            velocity: [SLOWEST; V],
            acceleration: [SLOWEST_RATE; V],
            torque: [0.0; V],
        };
        let extremes = recording.extremes();
        if extremes.iter().all(|[low, high, _]| high - low < RESTS) {
            let path = path.to_owned();
            return Err(Error::AtRest { path });
        }
        let largest = extremes.iter().fold(1e-6, |most: f64, [.., tau]| most.max(*tau));
        for (j, [low, high, torque]) in extremes.into_iter().enumerate() {
            let body = &robot.imported.tree.bodies[j];
            if let Some([lower, upper]) = body.limits.position.filter(|[a, b]| a < b) {
                for position in [low, high] {
                    if position < lower - BEYOND || position > upper + BEYOND {
                        return Err(Error::Outside {
                            recording: path.to_owned(),
                            robot: robot.path.clone(),
                            joint: j,
                            name: body.joint.clone(),
                            position,
                            lower,
                            upper,
                        });
                    }
                }
                (limits.lower[j], limits.upper[j]) = (lower.max(-TURN), upper.min(TURN));
            }
            if limits.lower[j] >= limits.upper[j] {
                (limits.lower[j], limits.upper[j]) = (low - SLOWEST, high + SLOWEST);
            }
            limits.torque[j] = (MARGIN * torque).max(0.01 * largest);
        }
        let [speeds, rates] = recording.rates();
        for j in 0..V {
            limits.velocity[j] = speeds[j].max(SLOWEST);
            limits.acceleration[j] = rates[j].max(SLOWEST_RATE);
        }
        Ok(limits)
    }

    /// The base parameters with this speed of Stribeck's effect.
    pub fn base<const V: usize>(
        &self,
        whole: &TickRecording<V>,
        stribeck: Option<f64>,
    ) -> Result<Base<V>> {
        let (model, ..) = self.robot.model::<V>(self.gravity)?;
        let limits = self.limits(whole)?;
        let asymmetric = self.options.effects.contains(&JointEffect::Asymmetric);
        let friction = Friction { width: Width::new(self.options.width), stribeck, asymmetric };
        Ok(Base::<V>::new(model, RIGID_BODY, friction, limits))
    }

    /// The estimate of these base parameters, with torques so long after the positions, s;
    /// estimated if not given.
    pub fn estimate<const V: usize>(
        &self,
        arm: Base<V>,
        part: &TickRecording<V>,
        delay: Option<f64>,
    ) -> Result<Estimate<V>> {
        let (options, effects) = (self.options, &self.options.effects);
        let (_, bodies, joints) = self.robot.model::<V>(self.gravity)?;
        let largest = arm.limits.torque;
        let nominal = arm.of_all(&bodies, &joints);
        let known = known(&arm, effects);
        let tick = part.tick();
        let own = Fit::new(tick);
        let cutoff = options.cutoff.unwrap_or(own.cutoff.min(UNDER * Fit::highest(tick)));
        let mut fit = Fit { cutoff, delay: self.delay, ..own };
        let gears = effects.iter().find_map(|effect| match effect {
            JointEffect::Load => Some(Gears::Load([[0.0; 2]; V])),
            JointEffect::Preslide => Some(Gears::Presliding([[0.0; 3]; V])),
            _ => None,
        });
        let run = |fit: &Fit| fit.identify(&arm, part, &nominal, &known, gears);
        let (found, delay_end) = match delay {
            Some(delay) => {
                fit.delay = delay;
                run(&fit).map(|found| (found, None))
            }
            None => delay::least(&mut fit, tick, &largest, run),
        }
        .map_err(|source| self.failed(source))?;
        Ok(Estimate { arm, bodies, joints, nominal, known, fit, found, delay_end })
    }

    /// The base parameters with the speed of Stribeck's effect that leaves the least of the
    /// torques, if it is identified.
    pub fn best_base<const V: usize>(
        &self,
        whole: &TickRecording<V>,
        part: &TickRecording<V>,
    ) -> Result<Base<V>> {
        let plain = self.base(whole, None)?;
        if !self.options.effects.contains(&JointEffect::Stribeck) {
            return Ok(plain);
        }
        let first = self.estimate(plain, part, None)?;
        let each = SPEEDS.map(|times| {
            let arm = self.base(whole, Some(times * self.options.width))?;
            let found = self.estimate(arm.clone(), part, Some(first.fit.delay))?.found;
            Ok((found.noise.iter().map(|noise| noise.ln()).sum::<f64>(), arm))
        });
        let each = each.into_iter().collect::<Result<Vec<_>>>()?;
        let best = each.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
        Ok(best.map_or(first.arm, |(_, arm)| arm))
    }

    /// The fit of a part of a recording at this delay, s; estimated if not given.
    pub fn attempt<const V: usize>(
        &self,
        arm: Base<V>,
        part: &TickRecording<V>,
        delay: Option<f64>,
    ) -> Result<Attempt<V>> {
        let options = self.options;
        let estimate = self.estimate(arm, part, delay)?;
        let Estimate { arm, bodies, joints, nominal, known, fit, found, .. } = &estimate;
        let largest = arm.limits.torque;
        let believed = believed(arm, found, nominal, joints, &options.effects);
        let (base, root) = (&found.base, &found.root);
        let set = most_probable(base, root, arm, bodies, &believed, BELIEVED, self.steps);
        let mut set = set.map_err(|source| self.failed(source))?;
        for (j, joint) in set.joints.iter_mut().enumerate() {
            let own = own(arm, j, OfJoint::Offset).filter(|&base| !known[base]);
            let is_shown = own.is_some_and(|base| {
                found.base[base].abs() > SHOWN * found.deviations[base]
                    && found.base[base].abs() > LEAST_OFFSET * largest[j]
            });
            if !is_shown {
                joint[3] = 0.0;
            }
        }
        let after = arm.of_all(&set.bodies, &set.joints);
        let compared = fit
            .compare(arm, part, &[(&after[..], possible(found))])
            .map_err(|source| self.failed(source))?;
        let pairs = compared.measured.iter().zip(&compared.modelled[0]);
        let left: Vec<[f64; V]> =
            pairs.map(|(a, b)| std::array::from_fn(|j| a[j] - b[j])).collect();
        let most = largest.into_iter().fold(0.0, f64::max);
        let largest = largest.map(|own| own.max(LIGHT * most) / MARGIN);
        let shares = std::array::from_fn(|j| {
            let squares: f64 = left.iter().map(|left| left[j].powi(2)).sum();
            (squares / left.len() as f64).sqrt() / largest[j]
        });
        Ok(Attempt { estimate, set, left, largest, shares })
    }
}

/// The largest residuals that a robot of another kind leaves at a joint, relative to its largest
/// torque,
pub(crate) const EXPLAINED: f64 = 0.06;
/// and those from which on nothing is offered to paste.
pub(crate) const UNEXPLAINED: f64 = 0.12;

impl<const V: usize> Attempt<V> {
    /// The mean squares of the residuals relative to the joints' largest torques, summed.
    pub fn residual(&self) -> f64 {
        self.shares.iter().map(|share| share * share).sum()
    }

    /// Whether the residuals are near the noise.
    pub fn is_explained(&self) -> bool {
        self.shares.iter().all(|share| *share <= EXPLAINED)
    }
}

/// Stribeck's effect per excess.
pub(crate) fn bell(sign: f64, qd: f64, speed: f64) -> f64 {
    sign * (-(qd / speed).powi(2)).exp()
}

/// The friction of the gears that a gear can have.
pub(crate) fn possible<const V: usize>(found: &Fitted<V>) -> Option<Gears<V>> {
    let [gears, _] = found.gears?;
    Some(gears.map(|j, k| match (gears.joint(j), k) {
        (&[mu, ..], 0) | (&[_, mu], 1) => mu.clamp(0.0, 0.95),
        (&[mu, d, _], 1) => {
            let mu = mu.clamp(0.0, 0.95);
            d.clamp(-mu.min(0.98 - mu), mu.min(0.98 - mu))
        }
        (own, _) => own[k],
    }))
}

/// The base parameter that is this parameter of a joint.
pub(crate) fn own<const V: usize>(arm: &Base<V>, joint: usize, of: OfJoint) -> Option<usize> {
    let parameter = Parameter::Joint { joint, of };
    (0..arm.len()).find(|&base| arm.terms(base)[0].1 == parameter)
}

/// Which base parameters are those of the description: effects that are not identified.
fn known<const V: usize>(arm: &Base<V>, effects: &[JointEffect]) -> Vec<bool> {
    let is_left_out = |(_, parameter): &(f64, Parameter)| match parameter {
        Parameter::Body { .. } => false,
        Parameter::Joint { of, .. } => !effects.contains(&match of {
            OfJoint::Viscous => JointEffect::Viscous,
            OfJoint::Coulomb => JointEffect::Coulomb,
            OfJoint::Armature => JointEffect::Armature,
            OfJoint::Offset => JointEffect::Offset,
            OfJoint::Stribeck => JointEffect::Stribeck,
            OfJoint::Asymmetry => JointEffect::Asymmetric,
        }),
    };
    let all = 0..arm.len();
    all.map(|base| arm.terms(base).iter().all(is_left_out)).collect()
}

/// The parameters of the joints around which the physical set is looked for: of an effect that the
/// description lacks, the estimate.
fn believed<const V: usize>(
    arm: &Base<V>,
    found: &Fitted<V>,
    nominal: &[f64],
    joints: &[OfOneJoint; V],
    effects: &[JointEffect],
) -> [OfOneJoint; V] {
    let mut believed = *joints;
    let kinds = [
        (OfJoint::Viscous, JointEffect::Viscous),
        (OfJoint::Coulomb, JointEffect::Coulomb),
        (OfJoint::Armature, JointEffect::Armature),
        (OfJoint::Stribeck, JointEffect::Stribeck),
    ];
    let is_wanted = |of| kinds.iter().any(|(one, effect)| *one == of && effects.contains(effect));
    for (base, nominal) in nominal.iter().enumerate() {
        for (factor, parameter) in arm.terms(base) {
            let Parameter::Joint { joint, of } = parameter else {
                continue;
            };
            // The knowledge that the motion adds to the description, also to the sum of an armature
            // and inertias.
            let more = (found.base[base] - nominal) / factor;
            let place = &mut believed[joint][of as usize];
            // One that the recording does not distinguish from none stays none.
            if is_wanted(of)
                && *place == 0.0
                && more > 2.0 * (found.deviations[base] / factor).abs()
            {
                *place = more;
            }
        }
    }
    believed
}
