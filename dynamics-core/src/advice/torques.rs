//! Limits of torque: against what gravity needs within the limits of the positions, and against what a joint ever needs.
//!
//! A bound of the need is the weight of all that the joint moves, at the end of its lever: first moments add up along
//! the bodies as if these were stretched out horizontally. Where that is beyond the limit, the worst configuration is
//! sought. The torque of gravity is A + B sin qₖ + C cos qₖ in each angle, and linear in each slide, so that the best
//! value of one coordinate is exact; in turn they climb to a maximum.

use super::units::is_stated;
use super::{Advice, AdvisedJoint};
use crate::algorithms::rnea;
use crate::effects::Gravity;
use crate::model::{BASE, JointKind, Link, Model};
use crate::scalar::{Real, Vector};
use crate::state::State;
use crate::state::manifold::neutral;
use core::f64::consts::PI;

/// A limit that is more times the need, at every joint. Published arms have 0.1 to 16; with limits that stand for none 20
/// to 5,000.
const TIMES: f64 = 20.0;
/// Standard gravity, m/s².
const G: f64 = 9.81;
/// How often each coordinate is improved.
const SWEEPS: usize = 3;

/// What is remarkable about the limits of torque.
pub(super) fn of<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
) -> impl Iterator<Item = Advice> + '_ {
    let needs = stretched(model);
    let limited = model.links.iter().zip(needs).filter(|(link, needed)| {
        let has_motor = matches!(
            link.joint.kind,
            JointKind::Revolute | JointKind::Continuous | JointKind::Prismatic
        );
        let limit = link.limits.torque.to_f64();
        has_motor && limit.is_finite() && limit > 0.0 && *needed > 0.0
    });
    let mut least = None::<(f64, Advice)>;
    for (link, needed) in limited.clone() {
        let limit = link.limits.torque.to_f64();
        let times = limit / needed;
        if least.is_none_or(|(before, _)| times < before) {
            let joint = joint(link);
            let advice = Advice::TorqueLimitsFarAbove {
                joint,
                limit,
                needed,
            };
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
        (needed > limit * (1.0 + 1e-6)).then_some(Advice::GravityBeyondTorque {
            joint: joint(link),
            needed,
            limit,
        })
    });
    far_above.into_iter().chain(weak)
}

fn joint<R: Real>(link: &Link<R>) -> AdvisedJoint {
    AdvisedJoint {
        number: link.idx_v,
        body: Some(link.name),
    }
}

/// The weight of all that each body's joint moves at its greatest lever, N·m, or N of a slide.
fn stretched<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
) -> [f64; B] {
    let length = |v: R::Vec3| {
        let [x, y, z] = v.array().map(R::to_f64);
        let squared = x * x + y * y + z * z;
        if squared > 0.0 {
            Real::sqrt(squared)
        } else {
            0.0
        }
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
    for (need, (link, (mass, lever))) in needs
        .iter_mut()
        .zip(model.links.iter().zip(masses.into_iter().zip(levers)))
    {
        *need = match link.joint.kind {
            JointKind::Prismatic => G * mass,
            _ => G * lever,
        };
    }
    needs
}

/// The greatest torque of gravity along −z at a joint that was found within the limits of the positions, N·m or N.
fn worst<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
    of: &Link<R>,
) -> R {
    let torque = |q: &[R; Q]| {
        let all = rnea(model, &State::at(*q), &(Gravity::EARTH,));
        all.get(of.idx_v).copied().unwrap_or_default()
    };
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
            for link in &model.links {
                if let Some(range) = Range::of(link)
                    && is_related(model, link, of)
                {
                    climb(&mut q, link.idx_q, &range, |q| sign * torque(q));
                }
            }
        }
        let found = sign * torque(&q);
        if found > greatest {
            greatest = found;
        }
    }
    greatest
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
        Some(Self {
            lower,
            upper,
            slides,
        })
    }

    fn at(&self, share: f64) -> R {
        self.lower + (self.upper - self.lower) * R::from_f64(share)
    }
}

/// Sets one coordinate to where `height` is greatest within its range.
fn climb<R: Real, const Q: usize>(
    q: &mut [R; Q],
    k: usize,
    range: &Range<R>,
    height: impl Fn(&[R; Q]) -> R,
) {
    let at = |x: R, q: &mut [R; Q]| {
        if let Some(q) = q.get_mut(k) {
            *q = x;
        }
    };
    let mut best = range.lower;
    if range.slides {
        at(range.upper, q);
        let upper = height(q);
        at(range.lower, q);
        if upper > height(q) {
            best = range.upper;
        }
        return at(best, q);
    }
    let [zero, quarter, half] = [0.0, 0.5 * PI, PI].map(|angle| {
        at(R::from_f64(angle), q);
        height(q)
    });
    let middle = R::from_f64(0.5) * (zero + half);
    let (cos, sin) = (zero - middle, quarter - middle);
    let value = |x: R| {
        let (s, c) = x.sin_cos();
        sin * s + cos * c
    };
    let top = sin.atan2(cos);
    let turn = R::from_f64(2.0 * PI);
    for candidate in [range.upper, top, top - turn, top + turn] {
        let inside = candidate >= range.lower && candidate <= range.upper;
        if inside && value(candidate) > value(best) {
            best = candidate;
        }
    }
    at(best, q);
}

/// Whether one body carries the other, or is it.
fn is_related<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
    a: &Link<R>,
    b: &Link<R>,
) -> bool {
    let carries = |below: &Link<R>, above: &Link<R>| {
        let mut at = above;
        loop {
            if at.idx_v == below.idx_v {
                return true;
            }
            match model.links.get(at.parent) {
                Some(parent) if at.parent != BASE => at = parent,
                _ => return false,
            }
        }
    };
    carries(a, b) || carries(b, a)
}
