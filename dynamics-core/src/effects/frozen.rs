//! An effect that derivatives count as constant.

use crate::effects::Effect;
use crate::effects::delegate::delegate_effect;
use crate::scalar::Real;

/// An effect whose torques at joints and wrenches on bodies count as constant where derivatives of
/// dynamics are computed; everywhere else the effect itself.
///
/// Cost: that of the effect; none in derivatives.
///
/// ```
/// use dynamics_core::algorithms::rnea_derivatives;
/// use dynamics_core::effects::{BodyWrench, Frozen, RIGID_BODY};
/// use dynamics_core::spatial::Force;
/// use dynamics_core::{model::Robot, robots::Ur5e, state::State};
/// let state = State::at([0.0, -1.2, 1.5, 0.3, 0.7, 0.0]);
/// let push = BodyWrench { body: 5, wrench: Force::<f64>::ZERO };
/// let by = rnea_derivatives(&Ur5e::MODEL, &state, &(RIGID_BODY, Frozen(push)));
/// assert_eq!(by, rnea_derivatives(&Ur5e::MODEL, &state, &RIGID_BODY));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frozen<E>(pub E);

delegate_effect! {
    @if [true, true, true, false]
    impl[R: Real, E: Effect<R, B, V>, const B: usize, const V: usize] Effect<R, B, V> for Frozen<E>,
    |this| { E => this.0 }, advance
}
