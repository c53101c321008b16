//! Friction that depends on the transmitted torque.

use crate::effects::hook_args::{JointState, LoadFactors};

/// Adds to the factors of one joint, or to their derivatives.
type AddFactors<E, R> = fn(&E, usize, JointState<R>, &mut LoadFactors<R>);

/// Friction of gears, in proportion to the torque that they transmit.
///
/// The hook adds to the factors a and b of the friction F = a |τ| + b τ, where τ is the torque that the motor must supply
/// for all else at the joint. As F is of first degree in τ, forward dynamics solves τ + F for τ in closed form.
#[derive(Debug)]
pub struct LoadFriction<E, R> {
    pub(in crate::effects) factors: Option<AddFactors<E, R>>,
    pub(in crate::effects) slopes: Option<AddFactors<E, R>>,
}

impl<E, R> LoadFriction<E, R> {
    /// No such friction.
    pub const NONE: Self = Self {
        factors: None,
        slopes: None,
    };

    /// Friction of the factors that `factors` adds; `slopes` adds their derivatives with respect to q̇, for
    /// [`Implicit`](crate::effects::Implicit).
    pub const fn new(factors: AddFactors<E, R>, slopes: AddFactors<E, R>) -> Self {
        Self {
            factors: Some(factors),
            slopes: Some(slopes),
        }
    }

    /// That of a forwarder.
    #[doc(hidden)]
    pub const fn forwarded(any: bool, factors: AddFactors<E, R>, slopes: AddFactors<E, R>) -> Self {
        if any {
            Self::new(factors, slopes)
        } else {
            Self::NONE
        }
    }
}
