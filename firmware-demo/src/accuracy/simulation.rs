//! Ways to simulate: integrators, with and without compensated state, of a double pendulum and of an arm.

use core::fmt;
use core::marker::PhantomData;

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::effects::{Coriolis, Effect, Gravity, Implicit, Inertia, RIGID_BODY, Viscous};
use dynamics_core::model::{Arm, BASE, Body, Joint, Of, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;
use dynamics_core::sim::{
    EnergyKept, Euler, ImplicitDamping, Integrator, Mechanics, RungeKutta, SemiImplicit, Summed,
};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};

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
    const MODEL: Arm<f64, 2> = {
        const fn rod(name: &'static str, parent: usize) -> Body {
            Body::new(name, parent, Joint::revolute([0.0, -1.0, 0.0]))
                .mass(1.0)
                .com([0.0, 0.0, -0.25])
                .inertia([1.0 / 48.0, 0.0, 0.0, 1.0 / 48.0, 0.0, 0.0])
        }
        Arm::new(
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

/// Nothing but its weight.
#[derive(Clone, Copy, Debug)]
pub struct Free;

impl<T, R: Real, const N: usize> Scene<T, R, N> for Free {
    const NAME: &'static str = "free";
    type Effects = (Gravity, Inertia, Coriolis);
    fn effects() -> Self::Effects {
        RIGID_BODY
    }
}

/// Viscous friction too.
#[derive(Clone, Copy, Debug)]
pub struct Damped;

impl<T: LetGo<N>, R: Real, const N: usize> Scene<T, R, N> for Damped {
    const NAME: &'static str = "damped";
    type Effects = ((Gravity, Inertia, Coriolis), Viscous<R, N>);
    fn effects() -> Self::Effects {
        (RIGID_BODY, Viscous(T::DAMPING.map(R::from_f64)))
    }
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

impl<T, E, R: Real, const N: usize> Mechanics<R, N> for Engined<T, E>
where
    T: Robot<N, N, N>,
    E: Effect<R, N, N>,
{
    fn acceleration(&self, at: &State<R, N, N>) -> Result<[R; N], NotPositiveDefinite> {
        Engine::<T>::forward(at, &[R::ZERO; N], &self.effects)
    }

    fn implicit_acceleration(
        &self,
        at: &State<R, N, N>,
        h: R,
    ) -> Result<[R; N], NotPositiveDefinite> {
        let effects = Implicit::new(&Of::<T>::NEW, at, &self.effects, h);
        Engine::<T>::forward(at, &[R::ZERO; N], &effects)
    }

    fn energies(&self, at: &State<R, N, N>) -> (R, R) {
        (
            Core::<T>::kinetic_energy(at, &self.effects),
            Core::<T>::potential_energy(&at.q, &self.effects),
        )
    }
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
    ImplicitDamping = "implicit_damping",
    EnergyKept<f32> = "energy",
    EnergyKept<f64> = "energy"
);

/// The robot T by the integrator I in the scalar R.
#[derive(Debug)]
pub struct Run<T, S: Scene<T, R, N>, I, R: Real, const N: usize, const COMPENSATED: bool> {
    mechanics: Engined<T, S::Effects>,
    integrator: I,
    motion: Summed<R, N, COMPENSATED>,
}

impl<T, S, I, R, const N: usize, const COMPENSATED: bool> Run<T, S, I, R, N, COMPENSATED>
where
    T: LetGo<N>,
    S: Scene<T, R, N>,
    I: Integrator<R, N>,
    R: Real,
{
    #[inline(never)]
    fn advance(&mut self, h: R) -> Result<(), NotPositiveDefinite> {
        let step = self
            .integrator
            .step(&self.mechanics, &self.motion.state, h)?;
        self.motion.add(step);
        Ok(())
    }
}

impl<T, S, I, R, const N: usize, const COMPENSATED: bool> Simulation<N>
    for Run<T, S, I, R, N, COMPENSATED>
where
    T: LetGo<N>,
    S: Scene<T, R, N>,
    I: Integrator<R, N> + Named,
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
            motion: Summed::at(state),
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
    visitor.simulation::<Run<T, Free, EnergyKept<f32>, f32, N, false>>();
    visitor.simulation::<Run<T, Free, EnergyKept<f32>, f32, N, true>>();
    visitor.simulation::<Run<T, Free, SemiImplicit, f64, N, false>>();
    visitor.simulation::<Run<T, Free, RungeKutta, f64, N, false>>();
    visitor.simulation::<Run<T, Free, EnergyKept<f64>, f64, N, false>>();
    visitor.simulation::<Run<T, Damped, ImplicitDamping, f64, N, false>>();
}

fn scalar<T: LetGo<N>, R: Real, const N: usize, const COMPENSATED: bool>(
    visitor: &mut impl Visitor<N>,
) {
    visitor.simulation::<Run<T, Free, Euler, R, N, COMPENSATED>>();
    visitor.simulation::<Run<T, Free, SemiImplicit, R, N, COMPENSATED>>();
    visitor.simulation::<Run<T, Free, RungeKutta, R, N, COMPENSATED>>();
    visitor.simulation::<Run<T, Damped, SemiImplicit, R, N, COMPENSATED>>();
    visitor.simulation::<Run<T, Damped, RungeKutta, R, N, COMPENSATED>>();
    visitor.simulation::<Run<T, Damped, ImplicitDamping, R, N, COMPENSATED>>();
}
