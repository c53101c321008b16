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
pub trait LetGo<const N: usize>: Robot<N, N, N> {
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

impl LetGo<2> for DoublePendulum {
    const START: [[f64; 2]; 2] = [[1.5, 0.5], [0.0, 0.0]];
    const DAMPING: [f64; 2] = [0.5, 5.0];
}

impl LetGo<6> for Ur5e {
    const START: [[f64; 6]; 2] = [
        [0.0, -1.25, 1.0, -0.75, -1.0, 0.25],
        [0.5, 0.0, 0.0, 0.5, 0.0, 1.0],
    ];
    const DAMPING: [f64; 6] = [12.0, 12.0, 8.0, 2.0, 2.0, 1.5];
}

/// What acts on a robot that is let go.
pub trait Scene<T, R: Real, const N: usize> {
    /// On the axis `scene`.
    const NAME: &'static str;
    /// The effects.
    type Effects: Effect<R, N, N>;
    /// With their numbers.
    fn effects() -> Self::Effects;
}

macro_rules! scenes {
    ($($(#[$doc:meta])* $scene:ident, $name:literal: $effects:ty = $value:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $scene;

        impl<T: LetGo<N>, R: Real, const N: usize> Scene<T, R, N> for $scene {
            const NAME: &'static str = $name;
            type Effects = $effects;
            fn effects() -> $effects {
                $value
            }
        }
    )*};
}
type RigidBody = (Gravity, Inertia, Coriolis);
scenes! {
    /// Nothing but its weight.
    Free, "free": RigidBody = RIGID_BODY;
    /// Viscous friction too.
    Damped, "damped": (RigidBody, Viscous<R, N>) = (RIGID_BODY, Viscous(T::DAMPING.map(R::from_f64)));
}

/// A robot by the engine.
#[derive(Debug)]
pub struct Engined<T, E> {
    effects: E,
    robot: PhantomData<fn() -> T>,
}

impl<T, E> Engined<T, E> {
    /// Under these effects.
    pub fn under(effects: E) -> Self {
        Self {
            effects,
            robot: PhantomData,
        }
    }
}

impl<T, E, R: Real, const N: usize> Dynamics<R, N, N> for Engined<T, E>
where
    T: Robot<N, N, N>,
    E: Effect<R, N, N>,
{
    fn acceleration(&self, at: &State<R, N, N>) -> Result<[R; N], NotPositiveDefinite> {
        Engine::<T>::forward_dynamics(at, &[R::ZERO; N], &self.effects)
    }

    fn implicit_acceleration(
        &self,
        at: &State<R, N, N>,
        h: R,
    ) -> Result<[R; N], NotPositiveDefinite> {
        let effects = Implicit::new(&Static::<T>::NEW, at, &self.effects, h);
        Engine::<T>::forward_dynamics(at, &[R::ZERO; N], &effects)
    }

    fn energies(&self, at: &State<R, N, N>) -> (R, R) {
        (
            Core::<T>::kinetic_energy(at, &self.effects),
            Core::<T>::potential_energy(&at.q, &self.effects),
        )
    }

    fn configuration_after(&self, q: &[R; N], at: &StepIncrement<R, N>, h: R) -> [R; N] {
        at.configuration_after(&Static::<T>::NEW, q, h)
    }
}
