//! Effects: a scene is a tuple of them, and what it does not name is not in the machine code.
//!
//! ```
//! use dynamics_core::effects::{Coriolis, Gravity, Inertia, Viscous};
//! use dynamics_core::{Core, robots::Ur5e, state::State};
//!
//! let scene = (Gravity::EARTH, Inertia, Coriolis, Viscous([0.5_f32; 6]));
//! let state = State::at([0.0, -1.2, 1.5, 0.3, 0.0, 0.0]);
//! let full = Core::<Ur5e>::rnea(&state, &scene);
//! let gravity = Core::<Ur5e>::rnea(&state, &(Gravity::EARTH,));
//! assert_eq!(full, gravity); // at rest nothing else acts
//! ```
//!
//! | where | effects |
//! |---|---|
//! | all bodies | [`Gravity`], [`GravityVector`]; [`Inertia`], [`Coriolis`]; [`MovingBase`] |
//! | a body | [`BodyWrench`], [`WorldWrench`], [`Contact`]; [`Payload`] |
//! | a joint: friction | [`Viscous`], [`Coulomb`], [`AsymmetricCoulomb`], [`Stribeck`], [`Lugre`] |
//! | a joint: position | [`Spring`], [`EndStops`], [`Cogging`] |
//! | a motor | [`Armature`], [`GyroscopicRotors`]; [`crate::sim::Actuator`] and [`crate::drivetrain`] stand between command and joint |
//!
//! What none of them is, a user adds by an `impl` of the same trait, for core, engine and plant alike:
//!
//! ```
//! use dynamics_core::effects::{BodyState, Effect, RIGID_BODY};
//! use dynamics_core::{Core, Engine, robots::Ur5e, scalar::Real, spatial::Force, state::State};
//!
//! /// A cable pack dragged along behind the forearm: fˣ = −c v.
//! struct CableDrag<R>(R);
//!
//! impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for CableDrag<R> {
//!     const WRENCH: bool = true;
//!     const BODY_VELOCITY: bool = true;
//!
//!     fn wrench(&self, body: usize, at: &BodyState<R>, fx: &mut Force<R>) {
//!         if body == 3 {
//!             fx.lin -= at.velocity.lin * self.0;
//!         }
//!     }
//! }
//!
//! let swinging = State { qd: [0.5; 6], ..State::at([0.0_f64, -1.2, 1.5, 0.3, 0.0, 0.0]) };
//! let scene = (RIGID_BODY, CableDrag(8.0));
//! let [core, engine] = [Core::<Ur5e>::rnea(&swinging, &scene), Engine::<Ur5e>::rnea(&swinging, &scene)];
//! assert!((core[0] - engine[0]).abs() < 1e-12);
//! assert!(core[0] > Core::<Ur5e>::rnea(&swinging, &RIGID_BODY)[0]);
//! ```
//!
//! Gravity that is named twice would act twice, so that such a scene does not compile:
//!
//! ```compile_fail,E0080
//! use dynamics_core::effects::{GravityVector, RIGID_BODY};
//! use dynamics_core::{Engine, robots::Ur5e, state::State};
//! let tilted = GravityVector(glam::Vec3::new(0.0, 3.0, -9.3));
//! let _ = Engine::<Ur5e>::rnea(&State::at([0.3_f32; 6]), &(RIGID_BODY, tilted));
//! // error: the scene has several fields of gravity, whose sum would act: instead of (RIGID_BODY, GravityVector(..)) write
//! // (Inertia, Coriolis, GravityVector(..))
//! ```
//!
//! Signs are stated once, on M q̈ + C = τ: joint hooks add the torque that the motor must supply
//! (left side); body hooks add the wrench fˣ that the environment exerts on the body
//! (f + fˣ = I a + v ×* I v), which the library subtracts.

mod body;
mod delegate;
mod friction;
mod gates;
mod hook_args;
mod implicit;
mod joint;
mod query;
mod rigid_body;
mod tuple;

pub use body::{BodyWrench, Contact, ContactPoint, InvalidPayload, Payload, WorldWrench};
pub use friction::{
    AsymmetricCoulomb, Coulomb, Lugre, Stribeck, Viscous, smooth_sign, smooth_sign_slope,
};
pub use hook_args::{BodyState, JointState, TorqueDerivatives};
pub use implicit::Implicit;
pub use joint::{Armature, Cogging, EndStops, GyroscopicRotors, Spring};
pub use rigid_body::{
    Coriolis, Direction, Down, Gravity, GravityVector, Inertia, MovingBase, RIGID_BODY,
};

pub(crate) use gates::{field_axes, loads, one_gravity, only_load};
pub(crate) use query::{
    base_given, base_motion, body_inertia, body_wrench, field, gyroscopic, joint_state,
    joint_torque, joint_torques, rotor_force,
};
pub(crate) use rigid_body::Bias;

use crate::scalar::Real;
use crate::spatial::{Force, Motion, SpatialInertia};

/// A physical effect, or a tuple of them, on a robot of B bodies and V velocity coordinates.
///
/// Every hook defaults to nothing, and what is default costs nothing. Hooks *add* to what they
/// are given: an effect that returned a zero would leave an addition behind (x + 0.0 is not x for
/// IEEE's −0.0). Sizes are part of the type, so that five friction values on six joints do not
/// compile. A hook that stands under a constant (`FIELD`, `WRENCH`, `BASE_MOTION`, `PAYLOAD`, `GYROSCOPIC_ROTORS`) is
/// not called unless its constant says so.
///
/// ```
/// use dynamics_core::effects::{Effect, JointState};
/// use dynamics_core::scalar::Real;
///
/// /// A spring of 3 N·m/rad on the first joint.
/// struct Spring;
/// impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Spring {
///     fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
///         if joint == 0 {
///             *tau += at.q * R::from_f64(3.0);
///         }
///     }
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not an effect on a robot of {B} bodies and {V} joints in `{R}`",
    label = "not an effect of this size and scalar",
    note = "effects: Gravity, GravityVector, Inertia, Coriolis, Viscous([R; V]), Coulomb {{ .. }}, \
            AsymmetricCoulomb {{ .. }}, Stribeck {{ .. }}, Lugre {{ .. }}, Spring {{ .. }}, EndStops {{ .. }}, \
            Cogging {{ .. }}, Armature([R; V]), GyroscopicRotors {{ .. }}, Payload::<_, BODY>, BodyWrench, WorldWrench, Contact, \
            MovingBase, tuples of up to 12 of them, and your own through `impl Effect`"
)]
pub trait Effect<R: Real, const B: usize, const V: usize> {
    /// It is a field that accelerates every body: `field` adds something.
    const FIELD: bool = false;
    /// Which base components of the field may differ from zero.
    const FIELD_AXES: [bool; 3] = [Self::FIELD; 3];
    /// How many fields of gravity it adds; a scene of more than one does not compile. A field that is meant to act
    /// beside gravity sets it to 0.
    const GRAVITIES: usize = Self::FIELD as usize;
    /// It asks for the products M q̈ of accelerations.
    const ACCELERATIONS: bool = false;
    /// It asks for the velocity products C(q, q̇) q̇.
    const VELOCITY_PRODUCTS: bool = false;
    /// `wrench` adds something.
    const WRENCH: bool = false;
    /// `wrench` reads the body's velocity (which does not switch the velocity products on).
    const BODY_VELOCITY: bool = false;
    /// `wrench` reads the body's pose.
    const BODY_POSE: bool = false;
    /// `base` adds something.
    const BASE_MOTION: bool = false;
    /// The bodies to which `payload` adds something.
    const PAYLOAD: [bool; B] = [false; B];
    /// `spin` adds something.
    const GYROSCOPIC_ROTORS: bool = false;

    /// Adds to the inertia of `body`, about the origin of its frame and in its coordinates.
    #[inline(always)]
    fn payload(&self, body: usize, inertia: &mut SpatialInertia<R>) {
        let _ = (body, inertia);
    }

    /// Adds to the acceleration g of free fall, in base coordinates, m/s².
    #[inline(always)]
    fn field(&self, g: &mut R::Vec3) {
        let _ = g;
    }

    /// Adds to the spatial velocity v₀ and acceleration a₀ of the base, at its origin and in its
    /// coordinates.
    #[inline(always)]
    fn base(&self, velocity: &mut Motion<R>, acceleration: &mut Motion<R>) {
        let _ = (velocity, acceleration);
    }

    /// Adds to the wrench fˣ that the environment exerts on `body`, about the origin of the
    /// body's frame and in its coordinates, N·m and N.
    #[inline(always)]
    fn wrench(&self, body: usize, at: &BodyState<R>, fx: &mut Force<R>) {
        let _ = (body, at, fx);
    }

    /// Adds to the torque τ that the motor of `joint` must supply, N·m or N.
    #[inline(always)]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        let _ = (joint, at, tau);
    }

    /// Adds to the derivatives ∂τ/∂q and ∂τ/∂q̇ of what `torque` adds, where a plant is to treat it
    /// implicitly: see [`Implicit`].
    #[inline(always)]
    fn derivatives(&self, joint: usize, at: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
        let _ = (joint, at, derivatives);
    }

    /// Moves what the effect remembers of `joint` (bristles, a motor's current) on by h seconds.
    #[inline(always)]
    fn advance(&mut self, joint: usize, at: JointState<R>, h: R) {
        let _ = (joint, at, h);
    }

    /// Adds to the inertia at `joint`, that is to M's diagonal, kg·m² or kg; `torque` adds the
    /// same times q̈.
    #[inline(always)]
    fn inertia(&self, joint: usize, diagonal: &mut R) {
        let _ = (joint, diagonal);
    }

    /// Adds to ρ I, the coupling of the rotor that spins on the parent link of `joint` with what carries
    /// it, kg·m² or kg·m; `torque` and `inertia` add its ρ² I. See [`GyroscopicRotors`].
    #[inline(always)]
    fn spin(&self, joint: usize, coupling: &mut R) {
        let _ = (joint, coupling);
    }
}
