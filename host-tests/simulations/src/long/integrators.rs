//! The library's time steps by name, for cases that hold of each what its order promises.

use dynamics_core::effects::Effect;
use dynamics_core::model::Model;
use dynamics_core::scalar::Real;
use dynamics_core::sim::{linearly_implicit, runge_kutta, semi_implicit};
use dynamics_core::state::State;

/// A time step of the library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Integrator {
    pub name: &'static str,
    pub order: i32,
    /// The order of the energy without friction.
    pub energy_order: i32,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    SemiImplicit,
    LinearlyImplicit,
    RungeKutta,
}

pub const INTEGRATORS: [Integrator; 3] = [
    Integrator { name: "semi-implicit Euler", order: 1, energy_order: 1, kind: Kind::SemiImplicit },
    Integrator {
        name: "linearly implicit Euler",
        order: 1,
        // Its bodies move at the mean velocity of the step, as in a leapfrog.
        energy_order: 2,
        kind: Kind::LinearlyImplicit,
    },
    Integrator { name: "Runge-Kutta 4", order: 4, energy_order: 4, kind: Kind::RungeKutta },
];

impl Integrator {
    /// One step.
    ///
    /// # Panics
    /// If M is not positive definite.
    pub fn step<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        &self,
        model: &Model<R, B, Q, V>,
        state: &mut State<R, Q, V>,
        tau: &[R; V],
        scene: &mut E,
        h: R,
    ) where
        E: Effect<R, B, V>,
    {
        match self.kind {
            Kind::SemiImplicit => semi_implicit(model, state, tau, scene, h),
            Kind::LinearlyImplicit => linearly_implicit(model, state, tau, scene, h),
            Kind::RungeKutta => runge_kutta(model, state, tau, scene, h),
        }
        .unwrap_or_else(|error| panic!("{}: {error}", self.name));
    }
}
