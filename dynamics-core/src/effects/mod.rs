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
//! | a joint: friction | [`Viscous`], [`Coulomb`], [`AsymmetricCoulomb`], [`Stribeck`], [`Lugre`], [`LoadFriction`], [`PreslidingLoadFriction`] |
//! | a joint: position | [`Spring`], [`EndStops`], [`Cogging`]; in any state [`ConstantTorque`] |
//! | a motor | [`Armature`], [`GyroscopicRotors`]; [`crate::sim::Actuator`] and [`crate::drivetrain`] stand between command and joint |
//! | where derivatives are computed | [`Frozen`] counts an effect as constant |
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
//! A scene that contains gravity twice does not compile, nor does one that contains another effect
//! twice that cannot mean two things ([`Once`] has the list):
//!
//! ```compile_fail,E0080
//! use dynamics_core::effects::{GravityVector, RIGID_BODY};
//! use dynamics_core::{Engine, glam::Vec3, robots::Ur5e, state::State};
//! let tilted = GravityVector(Vec3::new(0.0, 3.0, -9.3));
//! let _ = Engine::<Ur5e>::rnea(&State::at([0.3_f32; 6]), &(RIGID_BODY, tilted));
//! // error: the scene has several fields of gravity, whose sum would act: instead of (RIGID_BODY, GravityVector(..)) write
//! // (Inertia, Coriolis, GravityVector(..))
//! ```
//!
//! This call is checked by a full build, whose error names it in a note. A scene that is a constant
//! is checked by `cargo check` and rust-analyzer, too, at its own line, if
//! [`Engine::scene_f32`](crate::Engine::scene_f32) or its sisters for f64 and for
//! [`Core`](crate::Core) return it:
//!
//! ```
//! use dynamics_core::effects::{Coriolis, Gravity, Inertia, Viscous};
//! use dynamics_core::{Engine, robots::Ur5e};
//! const SCENE: (Gravity, Inertia, Coriolis, Viscous<f32, 6>) =
//!     Engine::<Ur5e>::scene_f32((Gravity::EARTH, Inertia, Coriolis, Viscous([0.5; 6])));
//! # assert_eq!(SCENE.3, Viscous([0.5; 6]));
//! ```
//!
//! Nor does an effect without a hook compile:
//!
//! ```compile_fail,E0080
//! use dynamics_core::effects::Effect;
//! use dynamics_core::{Core, robots::Ur5e, scalar::Real, state::State};
//! struct Drag;
//! impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Drag {}
//! let _ = Core::<Ur5e>::rnea(&State::at([0.3_f32; 6]), &Drag);
//! // error: this effect has neither a hook among the constants of `Effect` nor the function `torque`: it would do nothing.
//! // note: the above error was encountered while instantiating `fn <Drag as Effect<f32, 6, 6>>::torque`
//! ```
//!
//! Signs are stated once, on M q̈ + C = τ: joint hooks add the torque that the motor must supply
//! (left side); body hooks add the wrench fˣ that the environment exerts on the body
//! (f + fˣ = I a + v ×* I v), which the library subtracts.

mod body;
mod declared;
mod delegate;
mod friction;
mod frozen;
mod gates;
pub mod hook;
mod hook_args;
mod implicit;
mod joint;
mod load;
mod mean_velocity;
pub(crate) mod once;
mod query;
mod rigid_body;
mod tuple;
mod width;

pub use body::{
    BaseParameters, BodyWrench, Contact, ContactPoint, InvalidPayload, Payload, WorldWrench,
};
#[doc(hidden)]
pub use delegate::{Forwarder, sum};
pub use friction::{
    AsymmetricCoulomb, Coulomb, LoadFriction, Lugre, PreslidingLoadFriction, Stribeck, Viscous,
    smooth_sign, smooth_sign_slope,
};
pub use frozen::Frozen;
#[doc(hidden)]
pub use hook::RegroupedInertia;
pub use hook_args::{BodyState, BodyVelocity, JointState, LoadFactors, TorqueDerivatives};
pub use implicit::Implicit;
pub use joint::{Armature, Cogging, ConstantTorque, EndStops, GyroscopicRotors, Spring};
pub(crate) use mean_velocity::AtMeanVelocity;
pub use once::Once;
pub use rigid_body::{
    Coriolis, Direction, Down, Elasticity, Gravity, GravityVector, Inertia, MovingBase, RIGID_BODY,
};
pub use width::Width;

#[doc(hidden)]
pub use declared::Declared;
pub(crate) use delegate::call_hook;
pub(crate) use gates::{
    Scene, are_of, field_axes, loads, meaning, no_gyroscopic_rotors, of_core, only_load,
};
#[doc(hidden)]
pub use load::load_friction;
pub(crate) use load::{
    add_load_slope, all_transmitted, load_frictions, no_load_friction, transmitted,
};
#[doc(hidden)]
pub use query::payload_mass;
pub(crate) use query::{
    add_inertia, add_joint_torque_rates, base_given, base_motion, body_inertia, body_wrench, field,
    gyroscopic, joint_state, joint_torque, joint_torques, rotor_force,
};
pub(crate) use rigid_body::{Bias, OfBodies, Resting};

use crate::scalar::Real;

/// A physical effect, or a tuple of them, on a robot of B bodies and V velocity coordinates.
///
/// Every hook has an empty default, which costs nothing; but an effect has at least one constant
/// hook or the function [`torque`](Effect::torque). (An effect without either is found when the
/// default of `torque` is compiled: the one place where the compiler knows that it was not written.
/// An effect whose only hook is `inertia` or `advance`, or that is to do nothing, writes an empty
/// `torque`.) Hooks *add* to their last argument: an effect that returned zero would leave an
/// addition in the machine code (x + 0.0 is not x for IEEE's −0.0). Sizes are part of the type, so
/// that five friction values on six joints do not compile. Hooks at joints are functions. Hooks
/// that enable a part of the algorithms are constants that name their function and what it reads
/// ([`hook`]), so that a hook and its declaration cannot contradict each other.
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
    note = "effects: Gravity, GravityVector, Inertia, Coriolis, Elasticity, Viscous([R; V]), \
            Coulomb {{ .. }}, AsymmetricCoulomb {{ .. }}, Stribeck {{ .. }}, Lugre {{ .. }}, \
            LoadFriction {{ .. }}, PreslidingLoadFriction {{ .. }}, Spring {{ .. }}, EndStops {{ .. \
            }}, Cogging {{ .. }}, ConstantTorque([R; V]), Armature([R; V]), GyroscopicRotors {{ \
            .. }}, Payload::<_, BODY>, BaseParameters, BodyWrench, WorldWrench, Contact, \
            MovingBase, tuples of up to 12 of them, and your own through `impl Effect`"
)]
pub trait Effect<R: Real, const B: usize, const V: usize>: Sized {
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
    /// What the effect adds has derivatives that are known: of what `torque` adds, those of
    /// `slopes`. A scene with an effect of which this is false does not compile where derivatives
    /// of dynamics are computed; [`Frozen`] counts it as constant. A wrench on a body has none, so
    /// that an effect with one does not compile there, whatever it says:
    ///
    /// ```compile_fail,E0080
    /// use dynamics_core::algorithms::rnea_derivatives;
    /// use dynamics_core::effects::{Effect, hook};
    /// use dynamics_core::{model::Robot, robots::Ur5e, state::State};
    /// struct Wind;
    /// impl<const B: usize, const V: usize> Effect<f64, B, V> for Wind {
    ///     const DIFFERENTIABLE: bool = true;
    ///     const EXTERNAL_WRENCH: hook::Wrench<Self, f64> =
    ///         hook::Wrench::of_velocity(|_, _, at, fx| fx.lin -= at.velocity.lin);
    /// }
    /// let by = rnea_derivatives(&Ur5e::MODEL, &State::at([0.0; 6]), &Wind);
    /// ```
    const DIFFERENTIABLE: bool = false;
    /// A scene may contain this effect once: a scene with two does not compile. Any number of times
    /// for an effect of one's own, unless it takes this constant from one of the library, such as
    /// `<Viscous<R, V> as Effect<R, B, V>>::ONCE`.
    const ONCE: Once = Once::NONE;

    /// Adds to the torque τ that the motor of `joint` must supply independently of its
    /// acceleration, N·m or N.
    #[cfg_attr(optimised, inline(always))]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        const { gates::has_hook::<R, Self, B, V>() };
        let _ = (joint, at, tau);
    }

    /// Adds to the derivatives ∂τ/∂q and ∂τ/∂q̇ of what `torque` adds, where a plant is to treat it
    /// implicitly: see [`Implicit`].
    #[cfg_attr(optimised, inline(always))]
    fn derivatives(&self, joint: usize, at: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
        let _ = (joint, at, derivatives);
    }

    /// Adds to ∂τ/∂q and ∂τ/∂q̇ of what `torque` adds, for the derivatives of dynamics: those of
    /// `derivatives`, unless these leave out what an implicit step would not be the stabler for.
    #[cfg_attr(optimised, inline(always))]
    fn slopes(&self, joint: usize, at: JointState<R>, slopes: &mut TorqueDerivatives<R>) {
        self.derivatives(joint, at, slopes);
    }

    /// The inertia at `joint`, kg·m² or kg, which the library adds to M's diagonal and, times q̈,
    /// to the torque.
    #[cfg_attr(optimised, inline(always))]
    fn inertia(&self, joint: usize) -> Option<R> {
        let _ = joint;
        None
    }

    /// Advances the effect's internal state of `joint` (bristles, a motor's current) by h seconds.
    #[cfg_attr(optimised, inline(always))]
    fn advance(&mut self, joint: usize, at: JointState<R>, h: R) {
        let _ = (joint, at, h);
    }
}
