//! Derivatives of inverse and forward dynamics, as matrices and as products with a vector.

mod forward_dynamics;
mod inverse_dynamics;
mod linearisation;
mod outward;
mod products;

pub use forward_dynamics::{AccelerationGradient, forward_dynamics_derivatives};
pub use inverse_dynamics::{TorqueGradient, rnea_derivatives};
pub use linearisation::Linearisation;
pub use products::{rnea_along, rnea_transposed};

use crate::effects::{Declared, Effect, TorqueDerivatives, joint_state};
use crate::model::{JointCoordinate, LinkView};
use crate::scalar::Real;
use crate::state::State;

/// ∂τ_k/∂q̇_k of what the effects add at coordinate k; `add` is called with each coordinate j of the
/// joint and ∂τ_k/∂q_j.
#[cfg_attr(optimised, inline(always))]
fn joint_slopes<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    effects: &E,
    (link, turns): (&LinkView<'_, R>, &[JointCoordinate<R>]),
    state: &State<R, Q, V>,
    k: usize,
    mut add: impl FnMut(usize, R),
) -> R
where
    E: Effect<R, B, V>,
{
    let mut by = TorqueDerivatives::default();
    effects.slopes(k, joint_state(link, state, k), &mut by);
    for j in link.coordinates() {
        add(j, by.dq * link.position_slope(turns, k, j));
    }
    by.dqd
}

/// The effects of a scene name the derivatives of what they add.
pub(crate) const fn named_derivatives<R: Real, E, const B: usize, const V: usize>()
where
    E: Effect<R, B, V>,
{
    // First: `Frozen` does not help against it.
    assert!(
        !(E::GYROSCOPIC_ROTORS | E::LOAD_DEPENDENT | E::ELASTICITY),
        "the derivatives of rotors that spin as bodies, of friction that depends on the load, and \
         of links that bend are not computed: use `Armature`, `Viscous` and `Coulomb`"
    );
    assert!(
        E::HAS_DERIVATIVES,
        "an effect of the scene has no derivatives: `Frozen(effect)` counts it as constant, and an \
         effect of one's own whose `slopes` are all it has sets `DIFFERENTIABLE`, one with a wrench \
         not"
    );
}
