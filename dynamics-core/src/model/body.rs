//! The description of a body, in the conventions of URDF.

use super::error::Problem;
use super::joint::Joint;
use super::possible::ImpossibleInertia;
use crate::math::const_eval as m;
use crate::scalar::Real;
use crate::spatial::SpatialInertia;
use glam::{DMat3, DVec3};

/// The parent of a body whose joint is on the fixed base.
pub const BASE: usize = usize::MAX;

/// The limits of a joint, as given by its drive and mechanics.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct JointLimits<R> {
    /// Least position, rad or m.
    pub lower: R,
    /// Greatest position, rad or m.
    pub upper: R,
    /// Greatest speed, rad/s or m/s.
    pub velocity: R,
    /// Greatest torque or force, N·m or N.
    pub torque: R,
}

impl JointLimits<f64> {
    /// No limits.
    pub const NONE: Self = Self {
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
        velocity: f64::INFINITY,
        torque: f64::INFINITY,
    };

    /// Whether all positions lie within two turns, ±4π: for revolute joints with such limits the
    /// engine takes [`crate::trig::sin_cos_near`], whose range leaves a margin for overshoot.
    pub(crate) const fn within_two_turns(&self) -> bool {
        const FOUR_PI: f64 = 4.0 * core::f64::consts::PI;
        self.lower >= -FOUR_PI && self.upper <= FOUR_PI
    }
}

/// A body and the joint to its parent, in URDF's conventions, SI units and f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    pub(super) name: &'static str,
    pub(super) parent: usize,
    pub(super) joint: Joint<f64>,
    pub(super) position: [f64; 3],
    pub(super) rotation: DMat3,
    /// The largest of roll, pitch and yaw, rad.
    pub(super) largest_angle: f64,
    pub(super) mass: f64,
    pub(super) com: [f64; 3],
    pub(super) inertia: [f64; 6],
    /// Whether the inertia is computed with although a moment is negative.
    pub(super) as_published: bool,
    pub(super) limits: JointLimits<f64>,
}

impl Body {
    /// A massless body on `joint`, at its parent's origin. `parent` is an index in the model's
    /// list, or [`BASE`].
    pub const fn new(name: &'static str, parent: usize, joint: Joint<f64>) -> Self {
        Self {
            name,
            parent,
            joint,
            position: [0.0; 3],
            rotation: DMat3::IDENTITY,
            largest_angle: 0.0,
            mass: 0.0,
            com: [0.0; 3],
            inertia: [0.0; 6],
            as_published: false,
            limits: JointLimits::NONE,
        }
    }

    /// Origin of the body's frame in the parent's frame at q = 0, m.
    pub const fn xyz(mut self, position: [f64; 3]) -> Self {
        self.position = position;
        self
    }

    /// Attitude of the body's frame in the parent's at q = 0: roll, pitch, yaw about the parent's
    /// fixed axes, rad; within ±2π each, so that most angles in degrees are rejected.
    pub const fn rpy(mut self, rpy: [f64; 3]) -> Self {
        self.largest_angle = rpy[0].abs().max(rpy[1].abs()).max(rpy[2].abs());
        self.rotation = m::rotation(m::sin_cos(rpy[0]), m::sin_cos(rpy[1]), m::sin_cos(rpy[2]));
        self
    }

    /// As [`Body::rpy`], in quarter turns: exact zeros and ones, which the engine exploits.
    pub const fn quarter_turns(mut self, rpy: [i32; 3]) -> Self {
        self.largest_angle = 0.0;
        self.rotation = m::rotation(m::quarter(rpy[0]), m::quarter(rpy[1]), m::quarter(rpy[2]));
        self
    }

    /// Mass, kg.
    pub const fn mass(mut self, mass: f64) -> Self {
        self.mass = mass;
        self
    }

    /// Centre of mass in the body's frame, m.
    pub const fn com(mut self, com: [f64; 3]) -> Self {
        self.com = com;
        self
    }

    /// Rotational inertia about the centre of mass, along the body's axes: xx, xy, xz, yy, yz, zz
    /// in kg·m².
    ///
    /// [`Model::new`](super::Model::new) refuses one with a negative principal moment, by which a
    /// kinetic energy would be negative. Moments of which one exceeds the sum of the two others,
    /// which no body has either, the advice of the crate `robot-import` names.
    ///
    /// ```compile_fail,E0080
    /// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
    /// const ROD: Body = Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(2.0);
    /// // As xx, yy, zz, xy, xz, yz:
    /// const ARM: ArmModel<f64, 1> = Model::new("arm", [ROD.inertia([0.03, 0.03, 0.001, 0.0, 0.0, 0.0])]);
    /// // error: body `rod`: in the order xx, xy, xz, yy, yz, zz its inertia has a negative principal moment, in the order xx, yy, zz,
    /// // xy, xz, yz it has none: -1.85e-2 kg·m²
    /// # let _ = ARM;
    /// ```
    pub const fn inertia(mut self, inertia: [f64; 6]) -> Self {
        (self.inertia, self.as_published) = (inertia, false);
        self
    }

    /// As [`Body::inertia`], of published numbers with a negative moment that are to be computed
    /// with all the same.
    ///
    /// ```
    /// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
    /// const ROD: Body = Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(2.0);
    /// const ARM: ArmModel<f64, 1> = Model::new("arm", [ROD.inertia_as_published([0.01, 0.0, 0.0, 0.01, 0.0, -0.001])]);
    /// assert_eq!(ARM.links[0].inertia.mass, 2.0); // it compiles
    /// ```
    pub const fn inertia_as_published(mut self, inertia: [f64; 6]) -> Self {
        (self.inertia, self.as_published) = (inertia, true);
        self
    }

    /// The joint's limits.
    pub const fn limits(mut self, limits: JointLimits<f64>) -> Self {
        self.limits = limits;
        self
    }

    pub(super) const fn problem(&self, index: usize) -> Option<Problem> {
        if self.parent != BASE && self.parent >= index {
            return Some(Problem::Parent);
        }
        if let Some(problem) = self.joint.problem() {
            return Some(problem);
        }
        if !(self.mass >= 0.0 && self.mass.is_finite()) {
            return Some(Problem::Mass(self.mass));
        }
        let mut i = 0;
        while i < 6 {
            let finite = self.inertia[i].is_finite()
                && self.com[i % 3].is_finite()
                && self.position[i % 3].is_finite();
            if !finite {
                return Some(Problem::NotFinite);
            }
            i += 1;
        }
        if self.largest_angle.is_finite() && self.largest_angle > WHOLE_TURN {
            return Some(Problem::Angle);
        }
        let com = m::vec3(self.com);
        if !(self.mass * m::dot(com, com)).is_finite() || !is_rotation(&self.rotation) {
            return Some(Problem::NotFinite);
        }
        if !self.as_published
            && let Some(problem) = negative(self.inertia)
        {
            return Some(problem);
        }
        let limits = &self.limits;
        // Comparisons that a NaN fails too.
        if !(limits.lower <= limits.upper && limits.velocity >= 0.0 && limits.torque >= 0.0) {
            return Some(Problem::Limits);
        }
        None
    }
}

/// 2π, rounded up to four digits.
const WHOLE_TURN: f64 = 6.284;

/// The share of its largest moment by which a moment may be below zero: the rounding of a
/// description's digits.
const ROUNDING: f64 = 1e-3;

/// The negative moment of an inertia in the order of [`Body::inertia`], and whether another order
/// is the reason.
///
/// With moments that break the triangle inequality alone no kinetic energy is negative, and every
/// result is that of the numbers: those of the published PUMA 560 do by 0.087 of the largest, those
/// of other published robots by up to 1.0, and so do those of a wheel of which only the moment
/// about its axis is given.
const fn negative(inertia: [f64; 6]) -> Option<Problem> {
    let moment = match ImpossibleInertia::of(inertia, ROUNDING) {
        Some(found) if found.moment < 0.0 => found.moment,
        _ => return None,
    };
    let [xx, yy, zz, xy, xz, yz] = inertia;
    match ImpossibleInertia::of([xx, xy, xz, yy, yz, zz], ROUNDING) {
        None => Some(Problem::InertiaOrder(moment)),
        Some(_) => Some(Problem::NegativeMoment(moment)),
    }
}

/// Whether the columns have unit length: an angle that is not finite, or beyond all reduction,
/// makes an attitude that is not a rotation.
const fn is_rotation(r: &DMat3) -> bool {
    is_unit(r.x_axis) && is_unit(r.y_axis) && is_unit(r.z_axis)
}

const fn is_unit(v: DVec3) -> bool {
    (m::dot(v, v) - 1.0).abs() < 1e-9
}

/// By how much an inertia's matrix and its transpose differ, relative to its largest entry.
pub(super) fn asymmetry<R: Real>(inertia: &SpatialInertia<R>) -> f64 {
    use crate::scalar::{Matrix, Vector};
    let a = inertia.rotational.cols().map(|c| c.array().map(R::to_f64));
    let [[_, xy, xz], [yx, _, yz], [zx, zy, _]] = a;
    let apart = [xy - yx, xz - zx, yz - zy].map(f64::abs);
    let largest = |size: f64, x: f64| if x.abs() <= size { size } else { x.abs() };
    let size = a.as_flattened().iter().copied().fold(0.0, largest);
    let apart = apart.into_iter().fold(0.0, largest);
    if apart == 0.0 { 0.0 } else { apart / size }
}

/// Whether there is inertia without mass.
pub(super) fn is_massless<R: Real>(inertia: &SpatialInertia<R>) -> bool {
    use crate::scalar::{Matrix, Vector};
    let some = |v: &R::Vec3| v.array().iter().any(|&x| x != R::ZERO);
    inertia.mass == R::ZERO
        && (some(&inertia.first_moment) || inertia.rotational.cols().iter().any(some))
}

/// Why no body has an inertia, if it is by more than `relative` of the largest moment; its axis if
/// AXIS is true.
#[doc(hidden)]
pub fn impossible<R: Real, const AXIS: bool>(
    inertia: &SpatialInertia<R>,
    relative: f64,
) -> Option<ImpossibleInertia> {
    use crate::scalar::{Matrix, Vector};
    let (mass, h) = (inertia.mass.to_f64(), inertia.first_moment.array().map(R::to_f64));
    let mut a = inertia.rotational.cols().map(|c| c.array().map(R::to_f64));
    let hh = h.iter().map(|x| x * x).sum::<f64>();
    let largest = a.as_flattened().iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    // The rounding error of the moments about the centre of mass.
    let noise = 8.0 * R::EPSILON.to_f64() * largest;
    if mass > 0.0 {
        for (i, (row, hi)) in a.iter_mut().zip(h).enumerate() {
            for (j, (entry, hj)) in row.iter_mut().zip(h).enumerate() {
                *entry -= (if i == j { hh } else { 0.0 } - hi * hj) / mass;
            }
        }
    }
    ImpossibleInertia::beyond::<AXIS>(a, relative, noise)
}
