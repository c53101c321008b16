//! An external wrench on one body: f + fˣ = I a + v ×* I v. Featherstone & Orin (2000), (5).

use crate::effects::{Effect, hook};
use crate::scalar::{Real, Vector};
use crate::spatial::{Force, Xform};

/// The wrench of an effect on a body that the robot does not have: not a number, so that the
/// torques show it.
#[cfg_attr(optimised, inline(always))]
pub(super) fn absent<R: Real>() -> Force<R> {
    let none = R::from_f64(f64::NAN);
    let none = R::Vec3::new(none, none, none);
    Force::new(none, none)
}

/// A wrench on `body`, about the origin of the body's frame and in its coordinates, N·m and N.
///
/// It rotates with the body: a thruster, a screwdriver. Cost: 6 flops.
///
/// ```
/// use dynamics_core::effects::BodyWrench;
/// use dynamics_core::{Core, robots::Ur5e, spatial::Force, state::State};
/// use glam::DVec3;
/// // The last motor holds against a couple about its axis.
/// let twist = BodyWrench { body: 5, wrench: Force::new(DVec3::Z * 2.0, DVec3::ZERO) };
/// assert!((Core::<Ur5e>::rnea(&State::at([0.3_f64; 6]), &twist)[5] + 2.0).abs() < 1e-15);
/// ```
#[doc(alias = "external force")]
#[doc(alias = "fext")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyWrench<R: Real> {
    /// The body's place in the model's list; that of a body which the robot does not have makes
    /// every torque NaN.
    pub body: usize,
    /// The wrench of the environment on it.
    pub wrench: Force<R>,
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for BodyWrench<R> {
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::constant(Self::add_to::<B>);
}

impl<R: Real> BodyWrench<R> {
    /// Adds fˣ on `body` of a robot of B bodies.
    #[cfg_attr(optimised, inline(always))]
    fn add_to<const B: usize>(&self, body: usize, fx: &mut Force<R>) {
        if body == self.body {
            *fx += self.wrench;
        } else if self.body >= B {
            *fx += absent();
        }
    }
}

/// A wrench on `body`, about the origin of the body's frame but along the axes of the base, N·m and
/// N.
///
/// It keeps its direction: wind, a rope over a far pulley. Cost: the body's pose, and 36 flops.
///
/// ```
/// use dynamics_core::effects::{Gravity, WorldWrench};
/// use dynamics_core::{Core, robots::Ur5e, spatial::Force, state::State};
/// use glam::DVec3;
/// // A balloon at the wrist takes load off the shoulder.
/// let lift = WorldWrench { body: 5, wrench: Force::new(DVec3::ZERO, DVec3::Z * 20.0) };
/// let at = State::at([0.3_f64; 6]);
/// let [with, without] = [Core::<Ur5e>::rnea(&at, &(Gravity::EARTH, lift)), Core::<Ur5e>::rnea(&at, &Gravity::EARTH)];
/// assert!(with[1].abs() < without[1].abs() - 10.0 && (with[0] - without[0]).abs() < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldWrench<R: Real> {
    /// The body's place in the model's list; that of a body which the robot does not have makes
    /// every torque NaN.
    pub body: usize,
    /// The wrench of the environment on it, along the axes of the base.
    pub wrench: Force<R>,
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for WorldWrench<R> {
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::of_pose(Self::add_to::<B>);
}

impl<R: Real> WorldWrench<R> {
    /// Adds fˣ on `body` of a robot of B bodies.
    #[cfg_attr(optimised, inline(always))]
    fn add_to<const B: usize>(&self, body: usize, pose: &Xform<R>, fx: &mut Force<R>) {
        if body == self.body {
            *fx += Force::new(pose.rot * self.wrench.ang, pose.rot * self.wrench.lin);
        } else if self.body >= B {
            *fx += absent();
        }
    }
}
