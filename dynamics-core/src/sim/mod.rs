//! Time steps of a simulated robot, and its actuators.
//!
//! A robot by its description takes a step of [`semi_implicit`], [`linearly_implicit`], [`runge_kutta`] or
//! [`conserving`]: each is a door to the [`Integrator`] of its name, which steps whatever [`Mechanics`] are at hand, the
//! engine's for one, on joints of any kind. Coordinates that add up may be [`Summed`] without loss.

mod actuator;
mod conserving;
mod energy_kept;
mod euler;
mod integrator;
mod linearly_implicit;
mod mechanics;
mod rates;
mod runge_kutta;
mod summed;

pub use actuator::Actuator;
pub use conserving::conserving;
pub use energy_kept::EnergyKept;
pub use euler::{Euler, SemiImplicit, semi_implicit};
pub use integrator::{Integrator, Step};
pub use linearly_implicit::{LinearlyImplicit, linearly_implicit};
pub use mechanics::{Described, Mechanics};
pub use rates::Rates;
pub use runge_kutta::{RungeKutta, runge_kutta};
pub use summed::Summed;
