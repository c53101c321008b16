//! A scene without its accelerations, what inverse dynamics of forward dynamics' bias computes, and
//! without its joints.

use crate::effects::Effect;
use crate::effects::delegate::delegate_effect;
use crate::scalar::Real;

/// The effects of `E` at q̈ = 0, known while compiling.
pub(crate) struct Bias<'a, E>(pub(crate) &'a E);

delegate_effect! {
    @if [true, false, true, true]
    impl[R: Real, E: Effect<R, B, V>, const B: usize, const V: usize] Effect<R, B, V> for Bias<'_, E>,
    |this| { E => *this.0 }
}

/// The effects of `E` on bodies, without those at joints.
pub(crate) struct OfBodies<'a, E>(pub(crate) &'a E);

delegate_effect! {
    @if [true, true, false, true]
    impl[R: Real, E: Effect<R, B, V>, const B: usize, const V: usize] Effect<R, B, V> for OfBodies<'_, E>,
    |this| { E => *this.0 }
}
