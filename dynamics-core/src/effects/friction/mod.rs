//! Friction of joints.

mod asymmetric;
mod coulomb;
mod load;
mod lugre;
mod presliding_load;
mod stribeck;
mod viscous;

pub use asymmetric::AsymmetricCoulomb;
pub use coulomb::{Coulomb, smooth_sign, smooth_sign_slope};
pub use load::LoadFriction;
pub use lugre::Lugre;
pub use presliding_load::PreslidingLoadFriction;
pub use stribeck::Stribeck;
pub use viscous::Viscous;
