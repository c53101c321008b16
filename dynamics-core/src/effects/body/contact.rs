//! Compliant contact of points with a plane: a spring and damper without adhesion, and friction
//! within a cone.
//!
//! At the depth p below the plane, with the velocity v_n out of the plane and v_t along it: f_n =
//! max(0, k p − b c v_n), f_t = −μ f_n v_t / √(v_t² + w²), c growing from 0 to 1 with the depth.
//! The friction never leaves its cone,
//! |f_t| ≤ μ f_n, and creeps below the speed w instead of sticking. Hunt & Crossley (1975); Haessig & Friedland, "On
//! the modeling and simulation of friction" (1991).

use super::wrench::absent;
use crate::effects::{BodyState, Effect, Width, hook, smooth_sign};
use crate::scalar::positive_part;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::Force;

/// A point of a body that may touch the plane.
#[doc(alias = "foot")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPoint<R: Real> {
    /// The body's place in the model's list.
    pub body: usize,
    /// The point in the body's frame, m.
    pub point: R::Vec3,
}

/// Contact of P points with a plane of the base; the space above the plane is free.
///
/// The plane is fixed to the base and moves with it: on a
/// [`MovingBase`](crate::effects::MovingBase) speeds are those relative to the deck. A point on a
/// body that the robot does not have makes every torque NaN.
///
/// Explicit: a step of h seconds is stable while k < M/h² and b < M/h, M the effective mass at a
/// point. Cost: pose and velocity of the bodies, and some 110 flops per point, with the same
/// instructions on the ground and in the air.
///
/// ```
/// use dynamics_core::effects::{Contact, ContactPoint, Width};
/// use dynamics_core::{Core, robots::Ur5e, state::State};
/// use glam::DVec3;
/// let tip = ContactPoint { body: 5, point: DVec3::ZERO };
/// let mut table = Contact {
///     points: [tip], normal: DVec3::Z, height: -1.0,
///     stiffness: 1e4, damping: 100.0, damping_depth: Width::new(1e-3), friction: 0.5, slip_tolerance: 1e-3,
/// };
/// let reaching = State::at([0.0_f64; 6]);
/// assert_eq!(Core::<Ur5e>::rnea(&reaching, &table), [0.0; 6]); // above it
/// table.height = 0.2;
/// assert!(Core::<Ur5e>::rnea(&reaching, &table)[1] > 100.0); // the motor presses the tip into the table
/// ```
#[doc(alias = "ground")]
#[doc(alias = "penalty contact")]
#[doc(alias = "friction cone")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<R: Real, const P: usize> {
    /// The points.
    pub points: [ContactPoint<R>; P],
    /// Unit normal of the plane in base coordinates, out of the ground.
    pub normal: R::Vec3,
    /// Height of the plane along its normal above the base's origin, m.
    pub height: R,
    /// Stiffness k, N/m.
    pub stiffness: R,
    /// Damping b along the normal, N·s/m.
    pub damping: R,
    /// The depth from which on the damping has its full value, m.
    pub damping_depth: Width<R>,
    /// Coefficient of friction μ.
    pub friction: R,
    /// Speed w below which friction fades, m/s; not 0.
    pub slip_tolerance: R,
}

impl<R: Real, const P: usize> Contact<R, P> {
    /// The force of the ground on a point at `place` that moves with `velocity`, in base
    /// coordinates, N.
    #[cfg_attr(optimised, inline(always))]
    pub fn force(&self, place: R::Vec3, velocity: R::Vec3) -> R::Vec3 {
        let n = self.normal;
        let (depth, out) = (positive_part(self.height - n.dot(place)), n.dot(velocity));
        let b = self.damping * smooth_sign(depth * self.damping_depth.inverse());
        let press = positive_part(self.stiffness * depth - b * out);
        let slip = velocity - n * out;
        let speed_inv = (slip.dot(slip) + self.slip_tolerance * self.slip_tolerance).rsqrt();
        n * press - slip * (self.friction * press * speed_inv)
    }
}

impl<R: Real, const P: usize, const B: usize, const V: usize> Effect<R, B, V> for Contact<R, P> {
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::of_state(Self::add_to::<B>);
}

impl<R: Real, const P: usize> Contact<R, P> {
    /// Adds fˣ on `body` of a robot of B bodies.
    #[cfg_attr(optimised, inline(always))]
    fn add_to<const B: usize>(&self, body: usize, at: &BodyState<R>, fx: &mut Force<R>) {
        let (rot, v) = (at.pose.rot, at.velocity);
        for contact in &self.points {
            if contact.body == body {
                let place = at.pose.pos + rot.transpose_mul(contact.point);
                let mut velocity = rot.transpose_mul(v.lin + v.ang.cross(contact.point));
                if let Some(base) = at.base {
                    velocity -= base.lin + base.ang.cross(place);
                }
                let f = rot * self.force(place, velocity);
                *fx += Force::new(contact.point.cross(f), f);
            } else if contact.body >= B {
                *fx += absent();
            }
        }
    }
}
