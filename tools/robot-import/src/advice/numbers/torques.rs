//! Limits of torque: against what gravity needs within the limits of the positions, and against
//! what a joint ever needs.
//!
//! A bound of the need is the weight of all that the joint moves, at the end of its lever: first
//! moments add up along the bodies as if these were stretched out horizontally. If that is
//! beyond the limit, the worst configuration is sought. The torque of gravity is A + B sin qₖ + C
//! cos qₖ in each angle, and linear in each slide, so that the best value of one coordinate is
//! exact; in turn they climb to a maximum.

use std::f64::consts::PI;

use dynamics_core::advice::{AdvisedJoint, is_stated};
use dynamics_core::model::{BASE, JointKind, Link, Model};
use dynamics_core::scalar::{Matrix, Real, Vector};
use dynamics_core::state::manifold::neutral;

use super::NumberAdvice;

/// A limit that is more times the need, at every joint. Published arms have 0.1 to 16; with limits
/// that stand for none 20 to 5,000.
const TIMES: f64 = 20.0;
/// Standard gravity, m/s².
const G: f64 = 9.81;
/// The number of times that each coordinate is improved.
const SWEEPS: usize = 3;

/// Remarkable limits of torque.
pub(super) fn of<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
) -> impl Iterator<Item = NumberAdvice> + '_ {
    let needs = stretched(model);
    let limited = model.links.iter().zip(needs).filter(|(link, needed)| {
        let has_motor = matches!(
            link.joint.kind,
            JointKind::Revolute | JointKind::Continuous | JointKind::Prismatic
        );
        let limit = link.limits.torque.to_f64();
        has_motor && limit.is_finite() && limit > 0.0 && *needed > 0.0
    });
    let mut least = None::<(f64, NumberAdvice)>;
    for (link, needed) in limited.clone() {
        let limit = link.limits.torque.to_f64();
        let times = limit / needed;
        if least.is_none_or(|(before, _)| times < before) {
            let joint = joint(link);
            let advice = NumberAdvice::TorqueLimitsFarAbove { joint, limit, needed };
            least = Some((times, advice));
        }
    }
    let far_above = least.and_then(|(times, advice)| (times > TIMES).then_some(advice));
    let weak = limited.filter_map(move |(link, needed)| {
        let limit = link.limits.torque.to_f64();
        if needed <= limit {
            return None;
        }
        let needed = worst(model, link).to_f64();
        (needed > limit * (1.0 + 1e-6)).then_some(NumberAdvice::GravityBeyondTorque {
            joint: joint(link),
            needed,
            limit,
        })
    });
    far_above.into_iter().chain(weak)
}

fn joint<R: Real>(link: &Link<R>) -> AdvisedJoint {
    AdvisedJoint { number: link.idx_v, body: Some(link.name) }
}

/// The weight of all that each body's joint moves at its greatest lever, N·m, or N of a slide.
fn stretched<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
) -> [f64; B] {
    let length = |v: R::Vec3| {
        let [x, y, z] = v.array().map(R::to_f64);
        let squared = x * x + y * y + z * z;
        if squared > 0.0 { Real::sqrt(squared) } else { 0.0 }
    };
    let (mut masses, mut levers) = ([0.0; B], [0.0; B]);
    for (i, link) in model.links.iter().enumerate().rev() {
        let (Some(mass), Some(lever)) = (masses.get_mut(i), levers.get_mut(i)) else {
            continue;
        };
        *mass += link.inertia.mass.to_f64();
        *lever += length(link.inertia.first_moment);
        let (carried, moment) = (*mass, *lever);
        let slides = match link.joint.kind {
            JointKind::Prismatic => [link.limits.lower, link.limits.upper]
                .map(|x| x.to_f64().abs())
                .into_iter()
                .filter(|x| x.is_finite())
                .fold(0.0, f64::max),
            _ => 0.0,
        };
        if let (Some(mass), Some(lever)) =
            (masses.get_mut(link.parent), levers.get_mut(link.parent))
        {
            *mass += carried;
            *lever += moment + carried * (length(link.placement.pos) + slides);
        }
    }
    let mut needs = [0.0; B];
    for (need, (link, (mass, lever))) in
        needs.iter_mut().zip(model.links.iter().zip(masses.into_iter().zip(levers)))
    {
        *need = match link.joint.kind {
            JointKind::Prismatic => G * mass,
            _ => G * lever,
        };
    }
    needs
}

/// The greatest torque of gravity along −z at a joint that was found within the limits of the
/// positions, N·m or N.
fn worst<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
    of: &Link<R>,
) -> R {
    let mut greatest = R::ZERO;
    for (sign, share) in [(1.0, 0.5), (-1.0, 0.5), (1.0, 0.25), (-1.0, 0.25)] {
        let sign = R::from_f64(sign);
        let mut q: [R; Q] = neutral(model);
        for link in &model.links {
            if let (Some(range), Some(q)) = (Range::of(link), q.get_mut(link.idx_q)) {
                *q = range.at(share);
            }
        }
        for _ in 0..SWEEPS {
            let levers = Levers::at(model, &q, of);
            levers.climb(model, &mut q, of, sign);
        }
        let found = sign * Levers::at(model, &q, of).torque;
        if found > greatest {
            greatest = found;
        }
    }
    greatest
}

/// The torque of gravity at a joint as a function of each coordinate alone, from one pass over the
/// bodies.
///
/// With up as ẑ, a hinge about n carries G ẑ · (n × h) and a slide G ẑ · m n, h the first moment
/// and m the mass of all that the joint moves. A coordinate on the way to the base turns that
/// vector, w; one further out turns the first moment of what it moves, in h · (ẑ × n).
struct Levers<R: Real, const B: usize> {
    /// Mass and first moment of all that each joint moves, in its aligned frame.
    masses: [R; B],
    moments: [R::Vec3; B],
    /// w in the frame of each body from the joint to the base; none of the others.
    turned: [Option<R::Vec3>; B],
    /// The torque of gravity at the configuration.
    torque: R,
}

impl<R: Real, const B: usize> Levers<R, B> {
    fn at<const Q: usize, const V: usize>(
        model: &Model<R, B, Q, V>,
        q: &[R; Q],
        of: &Link<R>,
    ) -> Self {
        let axis = R::Vec3::new(R::ZERO, R::ZERO, R::ONE);
        let mut all = Self {
            masses: [R::ZERO; B],
            moments: [R::Vec3::ZERO; B],
            turned: [None; B],
            torque: R::ZERO,
        };
        for (i, link) in model.links.iter().enumerate().rev() {
            let (Some(mass), Some(moment), Some(turned)) =
                (all.masses.get_mut(i), all.moments.get_mut(i), all.turned.get_mut(i))
            else {
                continue;
            };
            *mass += link.inertia.mass;
            *moment += link.inertia.first_moment;
            if link.idx_v == of.idx_v {
                *turned = Some(match link.joint.kind {
                    JointKind::Prismatic => axis * *mass,
                    _ => axis.cross(*moment),
                });
            }
            let (mass, moment, turned) = (*mass, *moment, *turned);
            let [angle, way] = at_joint(link, q);
            let in_parent = |v| link.placement.rot.transpose_mul(about_axis(angle, v));
            let origin = link.placement.pos + in_parent(axis * way);
            match all.moments.get_mut(link.parent) {
                Some(other) => *other = *other + in_parent(moment) + origin * mass,
                None => {
                    if let Some(w) = turned {
                        let [_, _, up] = in_parent(w).array();
                        all.torque = up * R::from_f64(G);
                    }
                }
            }
            if let Some(other) = all.masses.get_mut(link.parent) {
                *other += mass;
            }
            if let (Some(w), Some(other)) = (turned, all.turned.get_mut(link.parent)) {
                *other = Some(in_parent(w));
            }
        }
        all
    }

    /// Sets each coordinate in turn, from the base outward, to where the torque is greatest.
    fn climb<const Q: usize, const V: usize>(
        &self,
        model: &Model<R, B, Q, V>,
        q: &mut [R; Q],
        of: &Link<R>,
        sign: R,
    ) {
        let axis = R::Vec3::new(R::ZERO, R::ZERO, R::ONE);
        // The row of a body from the joint to the base up, for one further out ẑ × n, in its frame;
        // none of the others.
        let mut known: [Option<R::Vec3>; B] = [None; B];
        for (i, link) in model.links.iter().enumerate() {
            let (on_way, mass, moment) =
                match (self.turned.get(i), self.masses.get(i), self.moments.get(i)) {
                    (Some(turned), Some(mass), Some(moment)) => (*turned, *mass, *moment),
                    _ => continue,
                };
            let from = match (link.parent, on_way) {
                (BASE, Some(_)) => Some(axis),
                (parent, _) => known.get(parent).copied().flatten(),
            };
            let Some(from) = from else {
                continue;
            };
            let before = link.placement.rot * from;
            let lever = on_way.unwrap_or(moment);
            let ([x, y, z], [a, b, _]) = (before.array(), lever.array());
            if let (Some(range), Some(q)) = (Range::of(link), q.get_mut(link.idx_q)) {
                *q = match (range.slides, on_way) {
                    (false, _) => range.best(sign * (x * a + y * b), sign * (y * a - x * b)),
                    // One on the way turns nothing.
                    (true, None) if sign * z * mass > R::ZERO => range.upper,
                    (true, _) => range.lower,
                };
            }
            let [angle, _] = at_joint(link, q);
            let after = about_axis(-angle, before);
            let is_joint = link.idx_v == of.idx_v;
            if let Some(own) = known.get_mut(i) {
                *own = match (is_joint, link.joint.kind) {
                    (false, _) => Some(after),
                    // A motion further out does not change the force at a slide.
                    (true, JointKind::Prismatic) => None,
                    (true, _) => Some(after.cross(axis)),
                };
            }
        }
    }
}

/// Angle about, and way along, the axis of a joint of one coordinate; others stand at their neutral
/// positions.
fn at_joint<R: Real, const Q: usize>(link: &Link<R>, q: &[R; Q]) -> [R; 2] {
    let x = q.get(link.idx_q).copied().unwrap_or_default();
    match link.joint.kind {
        JointKind::Revolute | JointKind::Continuous => [x, R::ZERO],
        JointKind::Prismatic => [R::ZERO, x],
        _ => [R::ZERO; 2],
    }
}

/// A vector that is turned about z.
fn about_axis<R: Real>(angle: R, v: R::Vec3) -> R::Vec3 {
    let (sin, cos) = angle.sin_cos();
    let [x, y, z] = v.array();
    R::Vec3::new(cos * x - sin * y, sin * x + cos * y, z)
}

/// The positions of a joint of one coordinate.
struct Range<R> {
    lower: R,
    upper: R,
    slides: bool,
}

impl<R: Real> Range<R> {
    fn of(link: &Link<R>) -> Option<Self> {
        let slides = match link.joint.kind {
            JointKind::Revolute | JointKind::Continuous => false,
            JointKind::Prismatic => true,
            _ => return None,
        };
        let within = is_stated(link.limits.lower.to_f64()) || link.limits.lower == R::ZERO;
        let within =
            within && (is_stated(link.limits.upper.to_f64()) || link.limits.upper == R::ZERO);
        let half = if slides { 0.0 } else { PI };
        let [lower, upper] = if within {
            [link.limits.lower, link.limits.upper]
        } else {
            [R::from_f64(-half), R::from_f64(half)]
        };
        Some(Self { lower, upper, slides })
    }

    fn at(&self, share: f64) -> R {
        self.lower + (self.upper - self.lower) * R::from_f64(share)
    }

    /// The angle within the range at which cos cos x + sin sin x is greatest.
    fn best(&self, cos: R, sin: R) -> R {
        let value = |x: R| {
            let (s, c) = x.sin_cos();
            sin * s + cos * c
        };
        let (top, turn) = (sin.atan2(cos), R::from_f64(2.0 * PI));
        let mut best = self.lower;
        for candidate in [self.upper, top, top - turn, top + turn] {
            let inside = candidate >= self.lower && candidate <= self.upper;
            if inside && value(candidate) > value(best) {
                best = candidate;
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dynamics_core::algorithms::rnea;
    use dynamics_core::effects::Gravity;
    use dynamics_core::model::{ArmModel, Body, Joint, JointLimits, Robot};
    use dynamics_core::robots::Ur5e;
    use dynamics_core::state::State;

    /// The torque of a joint that inverse dynamics gives, climbed with in the same order.
    fn climbed<const N: usize>(model: &ArmModel<f64, N>, of: &Link<f64>) -> f64 {
        let torque = |q: &[f64; N]| rnea(model, &State::at(*q), &(Gravity::EARTH,))[of.idx_v];
        let mut greatest = 0.0_f64;
        for (sign, share) in [(1.0, 0.5), (-1.0, 0.5), (1.0, 0.25), (-1.0, 0.25)] {
            let mut q = [0.0; N];
            for link in &model.links {
                q[link.idx_q] = Range::of(link).map_or(0.0, |range| range.at(share));
            }
            for _ in 0..SWEEPS {
                for link in &model.links {
                    let Some(range) = Range::of(link) else {
                        continue;
                    };
                    let height = |x: f64| {
                        let mut q = q;
                        q[link.idx_q] = x;
                        sign * torque(&q)
                    };
                    let [zero, quarter, half] = [0.0, 0.5 * PI, PI].map(height);
                    let middle = 0.5 * (zero + half);
                    let best = match range.slides {
                        true if height(range.upper) > height(range.lower) => range.upper,
                        true => range.lower,
                        false => range.best(zero - middle, quarter - middle),
                    };
                    q[link.idx_q] = best;
                }
            }
            greatest = greatest.max(sign * torque(&q));
        }
        greatest
    }

    /// Hinges and slides on two branches, about turned axes.
    fn branched() -> ArmModel<f64, 5> {
        let limits = |lower, upper| JointLimits { lower, upper, velocity: 1.0, torque: 1.0 };
        let body = |parent, joint| {
            Body::new("body", parent, joint)
                .xyz([0.1, -0.2, 0.3])
                .rpy([0.3, -0.5, 0.7])
                .mass(1.5)
                .com([0.05, 0.1, -0.2])
        };
        ArmModel::new(
            "branched",
            [
                body(BASE, Joint::revolute([0.0, 1.0, 0.0])).limits(limits(-1.0, 2.0)),
                body(0, Joint::prismatic([1.0, 0.0, 0.0])).limits(limits(-0.4, 0.3)),
                body(1, Joint::continuous([0.6, 0.0, 0.8])),
                body(0, Joint::revolute([0.0, 0.0, 1.0])).limits(limits(-0.2, 0.9)),
                body(3, Joint::prismatic([0.0, 0.6, -0.8])).limits(limits(0.0, 0.5)),
            ],
        )
    }

    // Directions without influence are found by its own rounding; from there they can climb to
    // different maxima.
    #[test]
    fn one_pass_climbs_as_high_as_inverse_dynamics() {
        fn all<const N: usize>(model: &ArmModel<f64, N>) {
            for link in &model.links {
                let q = core::array::from_fn(|i| 0.7 - 0.45 * i as f64);
                let [own, expected] = [
                    Levers::at(model, &q, link).torque,
                    rnea(model, &State::at(q), &(Gravity::EARTH,))[link.idx_v],
                ];
                assert!((own - expected).abs() < 1e-12, "{own} {expected}");
                let (found, climbed) = (worst(model, link), climbed(model, link));
                assert!(found > climbed * 0.999 - 1e-9, "{}: {found} {climbed}", link.idx_v);
            }
        }
        all(&Ur5e::MODEL);
        all(&branched());
    }
}
