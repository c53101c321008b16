//! Friction that depends on the transmitted torque.

use crate::effects::hook_args::{JointState, LoadFactors};

/// Adds to the factors of one joint, or to their derivatives.
type AddFactors<E, R> = fn(&E, usize, JointState<R>, &mut LoadFactors<R>);

/// Friction of gears, in proportion to the torque that they transmit.
///
/// The hook adds to the factors a and b of the friction F = a |τ| + b τ, where τ is the torque that
/// the motor must supply for all else at the joint. As F is of first degree in τ, forward dynamics
/// solves τ + F for τ in closed form.
#[derive(Debug)]
pub struct LoadFriction<E, R> {
    #[doc(hidden)]
    pub factors: Option<AddFactors<E, R>>,
    #[doc(hidden)]
    pub slopes: Option<AddFactors<E, R>>,
    pub(in crate::effects) is_some: bool,
}

impl<E, R> LoadFriction<E, R> {
    /// No such friction.
    pub const NONE: Self = Self { factors: None, slopes: None, is_some: false };

    /// Friction of the factors that `factors` adds; `slopes` adds their derivatives with respect to
    /// q̇, for [`Implicit`](crate::effects::Implicit).
    pub const fn new(factors: AddFactors<E, R>, slopes: AddFactors<E, R>) -> Self {
        Self { factors: Some(factors), slopes: Some(slopes), is_some: true }
    }

    #[doc(hidden)]
    pub const fn with<F>(self, inner: &LoadFriction<F, R>) -> Self {
        Self { is_some: self.is_some | inner.is_some, ..self }
    }

    #[doc(hidden)]
    pub const fn through(
        self,
        on: bool,
        factors: AddFactors<E, R>,
        slopes: AddFactors<E, R>,
    ) -> Self {
        if on & self.is_some { Self::new(factors, slopes) } else { Self::NONE }
    }
}
