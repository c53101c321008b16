//! Time steps of a simulated robot, and its actuators.
//!
//! The functions advance a robot by its description by one step: [`semi_implicit`],
//! [`linearly_implicit()`], [`runge_kutta()`] or [`momentum_preserving()`]: each calls the
//! [`Integrator`] of its name, which advances any [`Dynamics`], for example those of the engine, on
//! joints of any kind. [`KahanState`] sums coordinates without loss.

mod actuator;
mod dynamics;
mod energy_projected;
mod euler;
mod integrator;
mod kahan_state;
mod linearly_implicit;
mod momentum_preserving;
mod runge_kutta;
mod step_increment;

pub use actuator::Actuator;
pub use dynamics::{Dynamics, ModelDynamics};
pub use energy_projected::EnergyProjected;
pub use euler::{Euler, SemiImplicit, semi_implicit};
pub use integrator::{Integrator, Step};
pub use kahan_state::KahanState;
pub use linearly_implicit::{LinearlyImplicit, linearly_implicit};
pub use momentum_preserving::momentum_preserving;
pub use runge_kutta::{RungeKutta, runge_kutta};
pub use step_increment::StepIncrement;
