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

use crate::effects::{Declared, Effect};
use crate::scalar::Real;

/// The effects of a scene name the derivatives of what they add.
pub(crate) const fn named_derivatives<R: Real, E, const B: usize, const V: usize>()
where
    E: Effect<R, B, V>,
{
    assert!(
        !E::WRENCH,
        "an effect of the scene has a wrench on a body, whose derivatives it cannot name: leave it \
         out of the scene whose derivatives are computed"
    );
    assert!(
        !(E::GYROSCOPIC_ROTORS | E::LOAD_DEPENDENT | E::ELASTICITY),
        "the derivatives of rotors that spin as bodies, of friction that depends on the load, and \
         of links that bend are not computed: use `Armature`, `Viscous` and `Coulomb`"
    );
}
