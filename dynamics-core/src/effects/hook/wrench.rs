//! External wrenches, and the part of a body's state that they read.

use crate::effects::Effect;
use crate::effects::hook_args::{BodyState, BodyVelocity};
use crate::scalar::Real;
use crate::spatial::{Force, Xform};

/// Adds to the wrench on a body, as a function of `Read`.
type AddWrench<E, R, Read> = fn(&E, usize, &Read, &mut Force<R>);

/// A wrench fˣ that the environment exerts on a body.
///
/// The hook is called for each body by its place in the model's list, and adds to fˣ, about the
/// origin of the body's frame and in its coordinates, N·m and N.
#[derive(Debug)]
pub struct Wrench<E, R: Real> {
    constant: Option<fn(&E, usize, &mut Force<R>)>,
    of_pose: Option<AddWrench<E, R, Xform<R>>>,
    of_velocity: Option<AddWrench<E, R, BodyVelocity<R>>>,
    of_state: Option<AddWrench<E, R, BodyState<R>>>,
    pub(in crate::effects) is_some: bool,
    /// It is not that of an inner effect.
    is_own: bool,
    pub(in crate::effects) reads_pose: bool,
    pub(in crate::effects) reads_velocity: bool,
}

impl<E, R: Real> Wrench<E, R> {
    /// No wrench.
    pub const NONE: Self = Self {
        constant: None,
        of_pose: None,
        of_velocity: None,
        of_state: None,
        is_some: false,
        is_own: false,
        reads_pose: false,
        reads_velocity: false,
    };

    /// A wrench that depends on nothing but the effect.
    pub const fn constant(add: fn(&E, usize, &mut Force<R>)) -> Self {
        Self { constant: Some(add), is_some: true, is_own: true, ..Self::NONE }
    }

    /// A wrench that depends on the body's pose relative to the base: the coordinate transform from
    /// the base to the body's frame, its origin in base coordinates, m.
    pub const fn of_pose(add: fn(&E, usize, &Xform<R>, &mut Force<R>)) -> Self {
        Self { of_pose: Some(add), is_some: true, is_own: true, reads_pose: true, ..Self::NONE }
    }

    /// A wrench that depends on the body's velocity (which does not switch the velocity products
    /// on).
    pub const fn of_velocity(add: fn(&E, usize, &BodyVelocity<R>, &mut Force<R>)) -> Self {
        Self {
            of_velocity: Some(add),
            is_some: true,
            is_own: true,
            reads_velocity: true,
            ..Self::NONE
        }
    }

    /// A wrench that depends on the body's pose and velocity.
    pub const fn of_state(add: fn(&E, usize, &BodyState<R>, &mut Force<R>)) -> Self {
        Self {
            of_state: Some(add),
            is_some: true,
            is_own: true,
            reads_pose: true,
            reads_velocity: true,
            ..Self::NONE
        }
    }

    /// Whether an effect with this wrench has derivatives that are known, if it says so: those of a
    /// wrench of its own are not.
    #[doc(hidden)]
    pub const fn allows(&self, differentiable: bool) -> bool {
        differentiable & !self.is_own
    }

    #[doc(hidden)]
    pub const fn with<F>(self, inner: &Wrench<F, R>) -> Self {
        Self {
            is_some: self.is_some | inner.is_some,
            reads_pose: self.reads_pose | inner.reads_pose,
            reads_velocity: self.reads_velocity | inner.reads_velocity,
            ..self
        }
    }

    #[doc(hidden)]
    pub const fn through(self, on: bool, add: fn(&E, usize, &BodyState<R>, &mut Force<R>)) -> Self {
        if on & self.is_some { Self { of_state: Some(add), ..self } } else { Self::NONE }
    }
}

/// Adds the wrench of an effect on `body`: that of its hook, by what this reads.
#[doc(hidden)]
#[cfg_attr(optimised, inline(always))]
pub fn add_wrench<R: Real, E, const B: usize, const V: usize>(
    effect: &E,
    body: usize,
    at: &BodyState<R>,
    fx: &mut Force<R>,
) where
    E: Effect<R, B, V>,
{
    if let Some(add) = const { E::EXTERNAL_WRENCH.constant } {
        add(effect, body, fx);
    }
    if let Some(add) = const { E::EXTERNAL_WRENCH.of_pose } {
        add(effect, body, &at.pose, fx);
    }
    if let Some(add) = const { E::EXTERNAL_WRENCH.of_velocity } {
        let &BodyState { velocity, base, .. } = at;
        add(effect, body, &BodyVelocity { velocity, base }, fx);
    }
    if let Some(add) = const { E::EXTERNAL_WRENCH.of_state } {
        add(effect, body, at, fx);
    }
}
