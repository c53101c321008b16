//! Effects: a scene is a tuple of them, and what it does not name is not in the machine code.
//!
//! ```
//! use dynamics_core::effects::{Coriolis, Gravity, Inertia, Viscous};
//! use dynamics_core::{Core, robots::Ur5e, state::State};
//!
//! let scene = (Gravity::EARTH, Inertia, Coriolis, Viscous([0.5_f32; 6]));
//! let state = State::at([0.0, -1.2, 1.5, 0.3, 0.0, 0.0]);
//! let full = Core::<Ur5e>::rnea(&state, &scene);
//! let gravity = Core::<Ur5e>::rnea(&state, &Gravity::EARTH);
//! assert_eq!(full, gravity); // at rest nothing else acts
//! ```
//!
//! | where | effects |
//! |---|---|
//! | all bodies | [`Gravity`], [`GravityVector`]; [`Inertia`], [`Coriolis`]; [`MovingBase`]; of links that bend, [`Elasticity`] |
//! | a body | [`BodyWrench`], [`WorldWrench`], [`Contact`]; [`Payload`]; of all bodies, [`BaseParameters`] |
//! | a joint: friction | [`Viscous`], [`Coulomb`], [`AsymmetricCoulomb`], [`Stribeck`], [`Lugre`], [`LoadFriction`] |
//! | a joint: position | [`Spring`], [`EndStops`], [`Cogging`] |
//! | a motor | [`Armature`], [`GyroscopicRotors`]; [`crate::sim::Actuator`] and [`crate::drivetrain`] stand between command and joint |
//!
//! A user adds other effects by an `impl` of the same trait, for core, engine and plant alike:
//!
//! ```
//! use dynamics_core::effects::{Effect, RIGID_BODY, hook};
//! use dynamics_core::{Core, Engine, robots::Ur5e, scalar::Real, state::State};
//!
//! /// A cable pack dragged along behind the forearm: fˣ = −c v.
//! struct CableDrag<R>(R);
//!
//! impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for CableDrag<R> {
//!     const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::of_velocity(|drag, body, at, fx| {
//!         if body == 3 {
//!             fx.lin -= at.velocity.lin * drag.0;
//!         }
//!     });
//! }
//!
//! let swinging = State { qd: [0.5; 6], ..State::at([0.0_f64, -1.2, 1.5, 0.3, 0.0, 0.0]) };
//! let scene = (RIGID_BODY, CableDrag(8.0));
//! let [core, engine] = [Core::<Ur5e>::rnea(&swinging, &scene), Engine::<Ur5e>::rnea(&swinging, &scene)];
//! assert!((core[0] - engine[0]).abs() < 1e-12);
//! assert!(core[0] > Core::<Ur5e>::rnea(&swinging, &RIGID_BODY)[0]);
//! ```
//!
//! A scene that contains gravity twice does not compile:
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
mod declared;
mod delegate;
mod friction;
mod gates;
pub mod hook;
mod hook_args;
mod implicit;
mod joint;
mod load;
mod query;
mod rigid_body;
mod tuple;
mod width;

#[doc(hidden)]
pub use body::RegroupedInertia;
pub use body::{
    BaseParameters, BodyWrench, Contact, ContactPoint, InvalidPayload, Payload, WorldWrench,
};
pub use declared::Declared;
#[doc(hidden)]
pub use delegate::{Forwarder, any_of, first_name, sum};
pub use friction::{
    AsymmetricCoulomb, Coulomb, LoadFriction, Lugre, Stribeck, Viscous, smooth_sign,
    smooth_sign_slope,
};
pub use hook_args::{BodyState, BodyVelocity, JointState, LoadFactors, TorqueDerivatives};
pub use implicit::Implicit;
pub use joint::{Armature, Cogging, EndStops, GyroscopicRotors, Spring};
pub use rigid_body::{
    Coriolis, Direction, Down, Elasticity, Gravity, GravityVector, Inertia, MovingBase, RIGID_BODY,
};
pub use width::Width;

pub(crate) use gates::{
    are_of, field_axes, loads, no_base_parameters, no_gyroscopic_rotors, one_gravity, only_load,
};
pub(crate) use load::{
    add_load_slope, all_transmitted, load_friction, load_frictions, no_load_friction, transmitted,
};
pub(crate) use query::{
    base_given, base_motion, body_inertia, body_wrench, field, gyroscopic, joint_state,
    joint_torque, joint_torques, rotor_force,
};
pub(crate) use rigid_body::{Bias, OfBodies, Resting};

use crate::scalar::Real;

/// A physical effect, or a tuple of them, on a robot of B bodies and V velocity coordinates.
///
/// Every hook has an empty default, which costs nothing. Hooks *add* to their last argument: an effect that returned
/// zero would leave an addition in the machine code (x + 0.0 is not x for IEEE's −0.0). Sizes are part of the type, so
/// that five friction values on six joints do not compile. Hooks at joints are functions. Hooks that enable a part of
/// the algorithms are constants that name their function and what it reads ([`hook`]), so that a hook and its
/// declaration cannot contradict each other.
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
    note = "effects: Gravity, GravityVector, Inertia, Coriolis, Elasticity, Viscous([R; V]), Coulomb {{ .. }}, \
            AsymmetricCoulomb {{ .. }}, Stribeck {{ .. }}, Lugre {{ .. }}, LoadFriction {{ .. }}, Spring {{ .. }}, EndStops {{ .. }}, \
            Cogging {{ .. }}, Armature([R; V]), GyroscopicRotors {{ .. }}, Payload::<_, BODY>, BaseParameters, BodyWrench, WorldWrench, Contact, \
            MovingBase, tuples of up to 12 of them, and your own through `impl Effect`"
)]
pub trait Effect<R: Real, const B: usize, const V: usize>: Declared<R, B, V> {
    /// A field that accelerates every body.
    const GRAVITY_FIELD: hook::Field<Self, R> = hook::Field::NONE;
    /// A prescribed motion of the base.
    const BASE: hook::Base<Self, R> = hook::Base::NONE;
    /// A wrench fˣ that the environment exerts on a body.
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::NONE;
    /// Inertia that is fixed to bodies.
    const ADDED_INERTIA: hook::Inertia<Self, R, B> = hook::Inertia::NONE;
    /// The coupling of rotors that spin on parent links.
    const ROTOR: hook::Rotor<Self, R> = hook::Rotor::NONE;
    /// Friction of gears that depends on the torque they transmit.
    const LOAD_FRICTION: hook::LoadFriction<Self, R> = hook::LoadFriction::NONE;
    /// Base parameters that replace those of the robot's description.
    const REGROUPED: hook::Regrouped<Self, R> = hook::Regrouped::NONE;
    /// The scene has the products M q̈ of accelerations.
    const ACCELERATIONS: bool = false;
    /// The scene has the velocity products C(q, q̇) q̇.
    const VELOCITY_PRODUCTS: bool = false;
    /// The scene has the stiffness and damping of links that bend ([`crate::flexible`]).
    const ELASTICITY: bool = false;

    /// Adds to the torque τ that the motor of `joint` must supply independently of its acceleration, N·m or N.
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

    /// The inertia at `joint`, kg·m² or kg, which the library adds to M's diagonal and, times q̈, to the torque.
    #[inline(always)]
    fn inertia(&self, joint: usize) -> Option<R> {
        let _ = joint;
        None
    }

    /// Advances the effect's internal state of `joint` (bristles, a motor's current) by h seconds.
    #[inline(always)]
    fn advance(&mut self, joint: usize, at: JointState<R>, h: R) {
        let _ = (joint, at, h);
    }
}
