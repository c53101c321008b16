//! Robots that are let go: a double pendulum and an arm, with and without friction.

use core::marker::PhantomData;

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::effects::{Coriolis, Effect, Gravity, Implicit, Inertia, RIGID_BODY, Viscous};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Robot, Static};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;
use dynamics_core::sim::{Dynamics, StepIncrement};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};

/// A robot that is let go.
pub trait PassiveMotion<const N: usize>: Robot<N, N, N> {
    /// q and q̇ at the start, exact in f32.
    const START: [[f64; N]; 2];
    /// Viscous friction of the scene `damped`, N·m·s/rad.
    const DAMPING: [f64; N];
}

/// Two rods of 1 kg and 0.5 m in a vertical plane.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum;

impl Robot<2, 2, 2> for DoublePendulum {
    const MODEL: ArmModel<f64, 2> = {
        const fn rod(name: &'static str, parent: usize) -> Body {
            Body::new(name, parent, Joint::revolute([0.0, -1.0, 0.0]))
                .mass(1.0)
                .com([0.0, 0.0, -0.25])
                .inertia([1.0 / 48.0, 0.0, 0.0, 1.0 / 48.0, 0.0, 0.0])
        }
        ArmModel::new(
            "double_pendulum",
            [rod("upper", BASE), rod("lower", 0).xyz([0.0, 0.0, -0.5])],
        )
    };
}

impl PassiveMotion<2> for DoublePendulum {
    const START: [[f64; 2]; 2] = [[1.5, 0.5], [0.0, 0.0]];
    const DAMPING: [f64; 2] = [0.5, 5.0];
}

impl PassiveMotion<6> for Ur5e {
    const START: [[f64; 6]; 2] = [
        [0.0, -1.25, 1.0, -0.75, -1.0, 0.25],
        [0.5, 0.0, 0.0, 0.5, 0.0, 1.0],
    ];
    const DAMPING: [f64; 6] = [12.0, 12.0, 8.0, 2.0, 2.0, 1.5];
}

/// The robot under its weight alone.
pub type Free = (Gravity, Inertia, Coriolis);
pub type Damped<R, const N: usize> = (Free, Viscous<R, N>);

/// The effects on a robot that is let go.
pub trait Scene<T, R: Real, const N: usize>: Effect<R, N, N> {
    /// On the axis `scene`.
    const NAME: &'static str;
    fn effects() -> Self;
}

impl<T, R: Real, const N: usize> Scene<T, R, N> for Free {
    const NAME: &'static str = "free";
    fn effects() -> Self {
        RIGID_BODY
    }
}

impl<T: PassiveMotion<N>, R: Real, const N: usize> Scene<T, R, N> for Damped<R, N> {
    const NAME: &'static str = "damped";
    fn effects() -> Self {
        (RIGID_BODY, Viscous(T::DAMPING.map(R::from_f64)))
    }
}

/// A robot by the engine, under these effects.
#[derive(Debug)]
pub struct Engined<T, E>(pub E, pub PhantomData<fn() -> T>);

impl<T, E, R: Real, const N: usize> Dynamics<R, N, N> for Engined<T, E>
where
    T: Robot<N, N, N>,
    E: Effect<R, N, N>,
{
    fn acceleration(&self, at: &State<R, N, N>) -> Result<[R; N], NotPositiveDefinite> {
        Engine::<T>::forward_dynamics(at, &[R::ZERO; N], &self.0)
    }

    fn implicit_acceleration(
        &self,
        at: &State<R, N, N>,
        h: R,
    ) -> Result<[R; N], NotPositiveDefinite> {
        let effects = Implicit::new(&Static::<T>::NEW, at, &self.0, h);
        Engine::<T>::forward_dynamics(at, &[R::ZERO; N], &effects)
    }

    fn energies(&self, at: &State<R, N, N>) -> (R, R) {
        let kinetic = Core::<T>::kinetic_energy(at, &self.0);
        (kinetic, Core::<T>::potential_energy(&at.q, &self.0))
    }

    fn configuration_after(&self, q: &[R; N], at: &StepIncrement<R, N>, h: R) -> [R; N] {
        at.configuration_after(&Static::<T>::NEW, q, h)
    }
}
