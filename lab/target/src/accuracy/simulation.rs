//! Ways to simulate: integrators, with and without compensated state, of a double pendulum and of
//! an arm.

use core::marker::PhantomData;

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::scalar::Real;
use dynamics_core::sim::{
    EnergyProjected, Euler, Integrator, KahanState, LinearlyImplicit, RungeKutta, SemiImplicit,
};
use dynamics_core::state::State;

use super::key::Named;
pub use super::key::Simulated as Key;
pub use super::passive_motion::{Damped, DoublePendulum, Engined, Free, PassiveMotion, Scene};

pub trait Simulation<const N: usize> {
    const KEY: Key;
    type Scalar: Real;
    fn start() -> Self;
    /// One step of h seconds.
    ///
    /// # Errors
    /// As forward dynamics.
    fn advance(&mut self, h: Self::Scalar) -> Result<(), NotPositiveDefinite>;
    /// q and q̇.
    fn measured(&self) -> [[f64; N]; 2];

    /// The step with its length from f64: what is measured.
    ///
    /// # Errors
    /// As forward dynamics.
    #[inline(always)]
    fn step(&mut self, h: f64) -> Result<(), NotPositiveDefinite> {
        self.advance(Self::Scalar::from_f64(h))
    }
    /// The address of the function that a step is.
    fn address() -> usize {
        Self::advance as fn(&mut Self, Self::Scalar) -> Result<(), NotPositiveDefinite> as usize
    }
}

/// Visits each configuration of a simulation.
pub trait Visitor<const N: usize> {
    fn simulation<S: Simulation<N>>(&mut self);
}

/// The robot T by the integrator I in the scalar R.
#[derive(Debug)]
pub struct Run<T, S, I, R, const N: usize, const COMPENSATED: bool> {
    mechanics: Engined<T, S>,
    integrator: I,
    motion: KahanState<R, N, COMPENSATED>,
}

impl<T, S, I, R, const N: usize, const COMPENSATED: bool> Simulation<N>
    for Run<T, S, I, R, N, COMPENSATED>
where
    T: PassiveMotion<N>,
    S: Scene<T, R, N>,
    I: Integrator<R, N, N> + Named,
    R: Real + Named,
{
    const KEY: Key = Key {
        integrator: I::NAME,
        state: if COMPENSATED { "compensated" } else { "plain" },
        arith: R::NAME,
        scene: S::NAME,
    };
    type Scalar = R;

    fn start() -> Self {
        let mechanics = Engined(S::effects(), PhantomData);
        let [q, qd] = T::START.map(|numbers| numbers.map(R::from_f64));
        let qdd = [R::ZERO; N];
        let state = State { q, qd, qdd };
        Self {
            integrator: I::start(&mechanics, &state),
            mechanics,
            motion: KahanState::at(state),
        }
    }

    #[inline(never)]
    fn advance(&mut self, h: R) -> Result<(), NotPositiveDefinite> {
        let at = &self.motion.state;
        let step = self.integrator.step(&self.mechanics, at, h)?;
        self.motion.add(&step, h);
        Ok(())
    }

    fn measured(&self) -> [[f64; N]; 2] {
        let State { q, qd, .. } = self.motion.state;
        [q, qd].map(|numbers| numbers.map(R::to_f64))
    }
}

macro_rules! runs {
    ($visitor:ident of $t:ident: $($scene:ty, $integrator:ty, $r:ty, $compensated:expr;)*) => {
        $($visitor.simulation::<Run<$t, $scene, $integrator, $r, N, $compensated>>();)*
    };
}

/// Shows every way to simulate the robot T to `visitor`.
pub fn every<T: PassiveMotion<N>, const N: usize>(visitor: &mut impl Visitor<N>) {
    single::<T, N, false>(visitor);
    single::<T, N, true>(visitor);
    runs! { visitor of T:
        Free, SemiImplicit, f64, false;
        Free, RungeKutta, f64, false;
        Free, EnergyProjected<f64>, f64, false;
        Damped<f64, N>, LinearlyImplicit, f64, false;
    }
}

fn single<T: PassiveMotion<N>, const N: usize, const COMPENSATED: bool>(
    visitor: &mut impl Visitor<N>,
) {
    runs! { visitor of T:
        Free, Euler, f32, COMPENSATED;
        Free, SemiImplicit, f32, COMPENSATED;
        Free, RungeKutta, f32, COMPENSATED;
        Free, EnergyProjected<f32>, f32, COMPENSATED;
        Damped<f32, N>, SemiImplicit, f32, COMPENSATED;
        Damped<f32, N>, RungeKutta, f32, COMPENSATED;
        Damped<f32, N>, LinearlyImplicit, f32, COMPENSATED;
    }
}
