//! Ways to simulate: integrators, with and without compensated state, of a double pendulum and of an arm.

use core::fmt;

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::scalar::Real;
use dynamics_core::sim::{
    EnergyProjected, Euler, Integrator, KahanState, LinearlyImplicit, RungeKutta, SemiImplicit,
};
use dynamics_core::state::State;

pub use super::let_go::{Damped, DoublePendulum, Engined, Free, LetGo, Scene};

/// The name of a way to simulate; it prints as [`super::key::Key`] does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// `euler`, `semi_implicit`, `rk4`, `energy`, `implicit_damping`.
    pub integrator: &'static str,
    /// `plain` or `compensated`.
    pub state: &'static str,
    /// `f32` or `f64`.
    pub arith: &'static str,
    /// `free`, or `damped` by viscous friction.
    pub scene: &'static str,
}

impl Key {
    /// What the library's scenes use.
    pub const DEFAULT: Self = Self {
        integrator: "semi_implicit",
        state: "plain",
        arith: "f32",
        scene: "free",
    };

    /// Axis and value, in the order of names.
    pub const fn axes(&self) -> [(&'static str, &'static str); 4] {
        [
            ("integrator", self.integrator),
            ("state", self.state),
            ("arith", self.arith),
            ("scene", self.scene),
        ]
    }
}

impl fmt::Display for Key {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        super::key::write(out, self.axes().into_iter().zip(Self::DEFAULT.axes()))
    }
}

/// A way to simulate.
pub trait Simulation<const N: usize> {
    /// Its name.
    const KEY: Key;
    /// From the robot's start.
    fn start() -> Self;
    /// One step of h seconds: what is measured.
    ///
    /// # Errors
    /// As forward dynamics.
    fn step(&mut self, h: f64) -> Result<(), NotPositiveDefinite>;
    /// q and q̇.
    fn seen(&self) -> [[f64; N]; 2];
    /// The address of the function that a step is.
    fn address() -> usize;
}

/// What is done with each way to simulate.
pub trait Visitor<const N: usize> {
    /// Takes one.
    fn simulation<S: Simulation<N>>(&mut self);
}

/// The integrators' names.
pub trait Named {
    /// On the axis `integrator`.
    const NAME: &'static str;
}

macro_rules! named {
    ($($integrator:ty = $name:literal),*) => {$(
        impl Named for $integrator {
            const NAME: &'static str = $name;
        }
    )*};
}
named!(
    Euler = "euler",
    SemiImplicit = "semi_implicit",
    RungeKutta = "rk4",
    LinearlyImplicit = "implicit_damping",
    EnergyProjected<f32> = "energy",
    EnergyProjected<f64> = "energy"
);

/// The robot T by the integrator I in the scalar R.
#[derive(Debug)]
pub struct Run<T, S: Scene<T, R, N>, I, R: Real, const N: usize, const COMPENSATED: bool> {
    mechanics: Engined<T, S::Effects>,
    integrator: I,
    motion: KahanState<R, N, COMPENSATED>,
}

impl<T, S, I, R, const N: usize, const COMPENSATED: bool> Run<T, S, I, R, N, COMPENSATED>
where
    T: LetGo<N>,
    S: Scene<T, R, N>,
    I: Integrator<R, N, N>,
    R: Real,
{
    #[inline(never)]
    fn advance(&mut self, h: R) -> Result<(), NotPositiveDefinite> {
        let step = self
            .integrator
            .step(&self.mechanics, &self.motion.state, h)?;
        self.motion.add(&step, h);
        Ok(())
    }
}

impl<T, S, I, R, const N: usize, const COMPENSATED: bool> Simulation<N>
    for Run<T, S, I, R, N, COMPENSATED>
where
    T: LetGo<N>,
    S: Scene<T, R, N>,
    I: Integrator<R, N, N> + Named,
    R: Real,
{
    const KEY: Key = Key {
        integrator: I::NAME,
        state: if COMPENSATED { "compensated" } else { "plain" },
        arith: if size_of::<R>() == 4 { "f32" } else { "f64" },
        scene: S::NAME,
    };

    fn start() -> Self {
        let mechanics = Engined::under(S::effects());
        let [q, qd] = T::START.map(|numbers| numbers.map(R::from_f64));
        let state = State {
            q,
            qd,
            qdd: [R::ZERO; N],
        };
        Self {
            integrator: I::start(&mechanics, &state),
            mechanics,
            motion: KahanState::at(state),
        }
    }

    #[inline(always)]
    fn step(&mut self, h: f64) -> Result<(), NotPositiveDefinite> {
        self.advance(R::from_f64(h))
    }

    fn seen(&self) -> [[f64; N]; 2] {
        let State { q, qd, .. } = self.motion.state;
        [q, qd].map(|numbers| numbers.map(R::to_f64))
    }

    fn address() -> usize {
        Self::advance as fn(&mut Self, R) -> Result<(), NotPositiveDefinite> as usize
    }
}

/// Shows every way to simulate the robot T to `visitor`.
pub fn every<T: LetGo<N>, const N: usize>(visitor: &mut impl Visitor<N>) {
    scalar::<T, f32, N, false>(visitor);
    scalar::<T, f32, N, true>(visitor);
    visitor.simulation::<Run<T, Free, EnergyProjected<f32>, f32, N, false>>();
    visitor.simulation::<Run<T, Free, EnergyProjected<f32>, f32, N, true>>();
    visitor.simulation::<Run<T, Free, SemiImplicit, f64, N, false>>();
    visitor.simulation::<Run<T, Free, RungeKutta, f64, N, false>>();
    visitor.simulation::<Run<T, Free, EnergyProjected<f64>, f64, N, false>>();
    visitor.simulation::<Run<T, Damped, LinearlyImplicit, f64, N, false>>();
}

fn scalar<T: LetGo<N>, R: Real, const N: usize, const COMPENSATED: bool>(
    visitor: &mut impl Visitor<N>,
) {
    visitor.simulation::<Run<T, Free, Euler, R, N, COMPENSATED>>();
    visitor.simulation::<Run<T, Free, SemiImplicit, R, N, COMPENSATED>>();
    visitor.simulation::<Run<T, Free, RungeKutta, R, N, COMPENSATED>>();
    visitor.simulation::<Run<T, Damped, SemiImplicit, R, N, COMPENSATED>>();
    visitor.simulation::<Run<T, Damped, RungeKutta, R, N, COMPENSATED>>();
    visitor.simulation::<Run<T, Damped, LinearlyImplicit, R, N, COMPENSATED>>();
}
