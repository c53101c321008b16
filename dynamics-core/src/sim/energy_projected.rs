//! A time step that conserves the energy of a robot without friction and drives.

use super::step_increment::add_scaled;
use super::{Dynamics, Integrator, RungeKutta, Step};
use crate::scalar::Real;
use crate::state::State;

/// [`RungeKutta`], then q̇ is scaled so that T + U has its initial value: the projection on
/// constant energy that is orthogonal in M. For motions without friction and drives.
///
/// Hairer, Lubich & Wanner, *Geometric Numerical Integration* (2006), section IV.4.
#[derive(Clone, Copy, Debug, Default)]
pub struct EnergyProjected<R> {
    /// T + U, J.
    energy: R,
}

impl<R: Real, const Q: usize, const V: usize> Integrator<R, Q, V> for EnergyProjected<R> {
    fn start(mechanics: &impl Dynamics<R, Q, V>, at: &State<R, Q, V>) -> Self {
        let (kinetic, potential) = mechanics.energies(at);
        Self { energy: kinetic + potential }
    }

    fn step(&self, robot: &impl Dynamics<R, Q, V>, at: &State<R, Q, V>, h: R) -> Step<R, V> {
        let mut rates = RungeKutta.step(robot, at, h)?;
        let end = rates.end(robot, at, h);
        let (kinetic, potential) = robot.energies(&end);
        // √(1 + 2x) − 1 of a small x to second order; near rest there is nothing to scale.
        let x = (self.energy - potential - kinetic) * R::from_f64(0.5) / kinetic;
        if x.abs() < R::from_f64(0.1) {
            let share = x - R::from_f64(0.5) * x * x;
            rates.qdd = add_scaled(rates.qdd, share / h, &end.qd);
        }
        Ok(rates)
    }
}
