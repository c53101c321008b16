//! The step that keeps the energy, from a state that has lost some.

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::sim::{Dynamics, EnergyProjected, Integrator, StepIncrement};
use dynamics_core::state::State;
use host_tests::measured::within;

/// A mass of 1 kg that nothing acts on.
struct Mass;

impl Dynamics<f64, 1, 1> for Mass {
    fn acceleration(&self, _: &State<f64, 1, 1>) -> Result<[f64; 1], NotPositiveDefinite> {
        Ok([0.0])
    }
    fn implicit_acceleration(
        &self,
        _: &State<f64, 1, 1>,
        _: f64,
    ) -> Result<[f64; 1], NotPositiveDefinite> {
        Ok([0.0])
    }
    fn energies(&self, at: &State<f64, 1, 1>) -> (f64, f64) {
        (0.5 * at.qd[0] * at.qd[0], 0.0)
    }
    fn configuration_after(&self, q: &[f64; 1], at: &StepIncrement<f64, 1>, h: f64) -> [f64; 1] {
        [q[0] + h * at.qd[0]]
    }
}

/// Energy that is short by 2x of itself comes back but for x³, as a speed that is corrected to
/// second order leaves it.
#[test]
fn a_step_brings_lost_energy_back_to_third_order() {
    let at = |energy: f64| State { q: [0.0], qd: [(2.0 * energy).sqrt()], qdd: [0.0] };
    for x in [-0.05, -0.01, 0.01, 0.05] {
        let mut state = at(1.0);
        let integrator = EnergyProjected::start(&Mass, &at(1.0 + 2.0 * x));
        integrator.advance(&Mass, &mut state, 1e-3).unwrap();
        let (energy, _) = Mass.energies(&state);
        let error = (energy - 1.0 - 2.0 * x).abs();
        within(&format!("energy that lacked {x}"), error, 1.3 * x.abs().powi(3));
    }
}
