//! Optional hooks of an effect, as values: the type of a hook's argument is what it reads.
//!
//! An effect names such a hook by a constant of [`Effect`](super::Effect). This is the only place
//! to declare it, and its constructor determines what it reads, so that every hook is called and
//! none reads a value that was not computed:
//!
//! ```
//! use dynamics_core::effects::{Effect, hook};
//! use dynamics_core::scalar::Real;
//!
//! /// A cable pack dragged along behind the forearm: fˣ = −c v.
//! struct CableDrag<R>(R);
//! impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for CableDrag<R> {
//!     const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::of_velocity(|drag, body, at, fx| {
//!         if body == 3 {
//!             fx.lin -= at.velocity.lin * drag.0;
//!         }
//!     });
//! }
//! ```
//!
//! A hook that reads what it does not declare does not compile, here the pose:
//!
//! ```compile_fail,E0609
//! # use dynamics_core::{effects::{Effect, hook}, scalar::Real};
//! struct Buoy;
//! impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Buoy {
//!     const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::of_velocity(|_, _, at, fx| {
//!         fx.lin -= at.pose.pos; // error: no field `pose` on type `&BodyVelocity<R>`
//!     });
//! }
//! ```
//!
//! nor does one that reads the velocity under `of_pose`:
//!
//! ```compile_fail,E0609
//! # use dynamics_core::{effects::{Effect, hook}, scalar::Real};
//! struct Drag;
//! impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Drag {
//!     const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::of_pose(|_, _, pose, fx| {
//!         fx.lin -= pose.velocity.lin; // error: no field `velocity` on type `&Xform<R>`
//!     });
//! }
//! ```
//!
//! A function beside the constants is not a hook (the same for `field`, `base`, `payload`, `spin`
//! and `load_factors`):
//!
//! ```compile_fail,E0407
//! # use dynamics_core::{effects::{BodyState, Effect}, scalar::Real, spatial::Force};
//! struct Drag;
//! impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Drag {
//!     fn wrench(&self, body: usize, at: &BodyState<R>, fx: &mut Force<R>) {} // error: not a member of trait `Effect`
//! }
//! ```
//!
//! ```compile_fail,E0407
//! # use dynamics_core::{effects::Effect, scalar::Real};
//! struct Magnet;
//! impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Magnet {
//!     fn field(&self, g: &mut R::Vec3) {} // error: not a member of trait `Effect`
//! }
//! ```
//!
//! ```compile_fail,E0407
//! # use dynamics_core::{effects::Effect, scalar::Real, spatial::Motion};
//! struct Lift;
//! impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Lift {
//!     fn base(&self, velocity: &mut Motion<R>, acceleration: &mut Motion<R>) {} // error: not a member of trait `Effect`
//! }
//! ```
//!
//! ```compile_fail,E0407
//! # use dynamics_core::{effects::Effect, scalar::Real, spatial::SpatialInertia};
//! struct Ice;
//! impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Ice {
//!     fn payload(&self, body: usize, inertia: &mut SpatialInertia<R>) {} // error: not a member of trait `Effect`
//! }
//! ```
//!
//! ```compile_fail,E0407
//! # use dynamics_core::{effects::Effect, scalar::Real};
//! struct Flywheel;
//! impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Flywheel {
//!     fn spin(&self, joint: usize, coupling: &mut R) {} // error: not a member of trait `Effect`
//! }
//! ```
//!
//! ```compile_fail,E0407
//! # use dynamics_core::{effects::{Effect, JointState, LoadFactors}, scalar::Real};
//! struct Worm;
//! impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Worm {
//!     fn load_factors(&self, joint: usize, at: JointState<R>, factors: &mut LoadFactors<R>) {} // error: not a member of trait `Effect`
//! }
//! ```
//!
//! A flag cannot be set without its hook either:
//!
//! ```compile_fail,E0438
//! # use dynamics_core::{effects::Effect, scalar::Real};
//! struct Drag;
//! impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Drag {
//!     const WRENCH: bool = true; // error: not a member of trait `Effect`
//! }
//! ```
//!
//! Machine code: a hook is a constant, so that its call is a direct one; a function with
//! `#[cfg_attr(optimised, inline(always))]` in place of a closure is inlined at every level of
//! optimisation.
//!
//! A forwarder has the hooks of its effects: none, `with` each of theirs, `through` a function that
//! calls them ([`delegate_effect!`](crate::delegate_effect)). `call_hook!` calls the function of a
//! hook.

pub use load_friction::LoadFriction;
pub use regrouped::Regrouped;
#[doc(hidden)]
pub use regrouped::RegroupedInertia;
pub use wrench::Wrench;
#[doc(hidden)]
pub use wrench::add_wrench;

use crate::scalar::Real;
use crate::spatial::{Motion, SpatialInertia};

mod load_friction;
mod regrouped;
mod wrench;

/// Adds to the velocity and acceleration of the base.
type AddMotion<E, R> = fn(&E, &mut Motion<R>, &mut Motion<R>);

/// A field that accelerates every body.
#[derive(Debug)]
pub struct Field<E, R: Real> {
    #[doc(hidden)]
    pub add: Option<fn(&E, &mut R::Vec3)>,
    pub(super) is_some: bool,
    pub(super) axes: [bool; 3],
    pub(super) gravities: usize,
}

impl<E, R: Real> Field<E, R> {
    /// No field.
    pub const NONE: Self = Self { add: None, is_some: false, axes: [false; 3], gravities: 0 };

    /// A field of gravity, which adds to the acceleration g of free fall, in base coordinates,
    /// m/s². A scene of several does not compile.
    pub const fn gravity(add: fn(&E, &mut R::Vec3)) -> Self {
        Self { add: Some(add), is_some: true, axes: [true; 3], gravities: 1 }
    }

    /// The same field, of which only these base components may differ from zero; others are
    /// ignored.
    #[must_use]
    pub const fn along(self, axes: [bool; 3]) -> Self {
        let [x, y, z] = self.axes;
        Self { axes: [x & axes[0], y & axes[1], z & axes[2]], ..self }
    }

    #[doc(hidden)]
    pub const fn with<F>(self, inner: &Field<F, R>) -> Self {
        Self {
            add: self.add,
            is_some: self.is_some | inner.is_some,
            axes: either(self.axes, inner.axes),
            gravities: self.gravities + inner.gravities,
        }
    }

    #[doc(hidden)]
    pub const fn through(self, on: bool, add: fn(&E, &mut R::Vec3)) -> Self {
        if on & self.is_some { Self { add: Some(add), ..self } } else { Self::NONE }
    }
}

/// A prescribed motion of the base.
#[derive(Debug)]
pub struct Base<E, R: Real> {
    #[doc(hidden)]
    pub add: Option<AddMotion<E, R>>,
    pub(super) is_some: bool,
}

impl<E, R: Real> Base<E, R> {
    /// A base that no effect moves.
    pub const NONE: Self = Self { add: None, is_some: false };

    /// Adds to the spatial velocity v₀ and acceleration a₀ of the base, at its origin and in its
    /// coordinates.
    pub const fn moving(add: fn(&E, &mut Motion<R>, &mut Motion<R>)) -> Self {
        Self { add: Some(add), is_some: true }
    }

    #[doc(hidden)]
    pub const fn with<F>(self, inner: &Base<F, R>) -> Self {
        Self { is_some: self.is_some | inner.is_some, ..self }
    }

    #[doc(hidden)]
    pub const fn through(self, on: bool, add: fn(&E, &mut Motion<R>, &mut Motion<R>)) -> Self {
        if on & self.is_some { Self::moving(add) } else { Self::NONE }
    }
}

/// Inertia that is fixed to bodies.
#[derive(Debug)]
pub struct Inertia<E, R: Real, const B: usize> {
    #[doc(hidden)]
    pub add: Option<fn(&E, usize, &mut SpatialInertia<R>)>,
    pub(super) is_some: bool,
    pub(super) bodies: [bool; B],
    /// A number of a body that the robot does not have.
    pub(super) no_body: Option<usize>,
}

impl<E, R: Real, const B: usize> Inertia<E, R, B> {
    /// None.
    pub const NONE: Self = Self { add: None, is_some: false, bodies: [false; B], no_body: None };

    /// Adds to the inertia of the bodies that are marked, about the origin of a body's frame and in
    /// its coordinates; for others the hook is not called.
    pub const fn on(bodies: [bool; B], add: fn(&E, usize, &mut SpatialInertia<R>)) -> Self {
        Self { add: Some(add), is_some: true, bodies, no_body: None }
    }

    /// Adds to the inertia of one body; a scene in which the robot does not have it does not
    /// compile.
    pub(in crate::effects) const fn on_body(
        body: usize,
        add: fn(&E, usize, &mut SpatialInertia<R>),
    ) -> Self {
        let mut hook = Self::on([false; B], add);
        if body < B {
            hook.bodies[body] = true;
        } else {
            hook.no_body = Some(body);
        }
        hook
    }

    #[doc(hidden)]
    pub const fn with<F>(self, inner: &Inertia<F, R, B>) -> Self {
        Self {
            add: self.add,
            is_some: self.is_some | inner.is_some,
            bodies: either(self.bodies, inner.bodies),
            no_body: match self.no_body {
                Some(body) => Some(body),
                None => inner.no_body,
            },
        }
    }

    #[doc(hidden)]
    pub const fn through(self, on: bool, add: fn(&E, usize, &mut SpatialInertia<R>)) -> Self {
        if on & self.is_some { Self { add: Some(add), ..self } } else { Self::NONE }
    }
}

/// The coupling of rotors that spin on parent links.
#[derive(Debug)]
pub struct Rotor<E, R> {
    #[doc(hidden)]
    pub add: Option<fn(&E, usize, &mut R)>,
    pub(super) is_some: bool,
}

impl<E, R> Rotor<E, R> {
    /// No rotor that spins as a body.
    pub const NONE: Self = Self { add: None, is_some: false };

    /// Adds to ρ I, the coupling of the rotor that spins on the parent link of a joint with what
    /// carries it, kg·m² or kg·m; [`inertia`](super::Effect::inertia) has its ρ² I. See
    /// [`GyroscopicRotors`](super::GyroscopicRotors).
    pub const fn coupling(add: fn(&E, usize, &mut R)) -> Self {
        Self { add: Some(add), is_some: true }
    }

    #[doc(hidden)]
    pub const fn with<F>(self, inner: &Rotor<F, R>) -> Self {
        Self { is_some: self.is_some | inner.is_some, ..self }
    }

    #[doc(hidden)]
    pub const fn through(self, on: bool, add: fn(&E, usize, &mut R)) -> Self {
        if on & self.is_some { Self::coupling(add) } else { Self::NONE }
    }
}

/// a ∨ b, one by one.
const fn either<const N: usize>(mut a: [bool; N], b: [bool; N]) -> [bool; N] {
    let mut i = 0;
    while i < N {
        a[i] |= b[i];
        i += 1;
    }
    a
}
