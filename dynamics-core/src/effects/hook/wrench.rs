//! External wrenches, and the part of a body's state that they read.

use crate::effects::hook_args::{BodyState, BodyVelocity};
use crate::scalar::Real;
use crate::spatial::{Force, Xform};

/// Adds to the wrench on a body, as a function of `Read`.
type AddWrench<E, R, Read> = fn(&E, usize, &Read, &mut Force<R>);

/// A wrench fˣ that the environment exerts on a body.
///
/// The hook is called for each body by its place in the model's list, and adds to fˣ, about the origin of the body's
/// frame and in its coordinates, N·m and N.
#[derive(Debug)]
pub struct Wrench<E, R: Real> {
    pub(in crate::effects) constant: Option<fn(&E, usize, &mut Force<R>)>,
    pub(in crate::effects) of_pose: Option<AddWrench<E, R, Xform<R>>>,
    pub(in crate::effects) of_velocity: Option<AddWrench<E, R, BodyVelocity<R>>>,
    pub(in crate::effects) of_state: Option<AddWrench<E, R, BodyState<R>>>,
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
        reads_pose: false,
        reads_velocity: false,
    };

    /// A wrench that depends on nothing but the effect.
    pub const fn constant(add: fn(&E, usize, &mut Force<R>)) -> Self {
        Self {
            constant: Some(add),
            ..Self::NONE
        }
    }

    /// A wrench that depends on the body's pose relative to the base: the coordinate transform from the base to the
    /// body's frame, its origin in base coordinates, m.
    pub const fn of_pose(add: fn(&E, usize, &Xform<R>, &mut Force<R>)) -> Self {
        Self {
            of_pose: Some(add),
            reads_pose: true,
            ..Self::NONE
        }
    }

    /// A wrench that depends on the body's velocity (which does not switch the velocity products on).
    pub const fn of_velocity(add: fn(&E, usize, &BodyVelocity<R>, &mut Force<R>)) -> Self {
        Self {
            of_velocity: Some(add),
            reads_velocity: true,
            ..Self::NONE
        }
    }

    /// A wrench that depends on the body's pose and velocity.
    pub const fn of_state(add: fn(&E, usize, &BodyState<R>, &mut Force<R>)) -> Self {
        Self {
            of_state: Some(add),
            reads_pose: true,
            reads_velocity: true,
            ..Self::NONE
        }
    }

    /// That of a forwarder.
    #[doc(hidden)]
    pub const fn forwarded(
        any: bool,
        reads_pose: bool,
        reads_velocity: bool,
        add: fn(&E, usize, &BodyState<R>, &mut Force<R>),
    ) -> Self {
        if any {
            Self {
                of_state: Some(add),
                reads_pose,
                reads_velocity,
                ..Self::NONE
            }
        } else {
            Self::NONE
        }
    }

    /// Whether there is any.
    pub(in crate::effects) const fn is_some(&self) -> bool {
        self.constant.is_some()
            | self.of_pose.is_some()
            | self.of_velocity.is_some()
            | self.of_state.is_some()
    }
}
