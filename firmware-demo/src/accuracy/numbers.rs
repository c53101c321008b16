//! Ways in other numbers than f32.

use core::marker::PhantomData;

use dynamics_core::drivetrain::ElasticReference;
use dynamics_core::effects::Effect;
use dynamics_core::scalar::{Compensated, Fixed, HalfTurns, Native, Real};
use dynamics_core::state::{JointTrig, State};
use dynamics_core::{Core, Engine};

use super::Inverse;
use super::form::Form;
use super::key::Key;
use super::model::{InUnits, Modelled, Units};

/// A scalar with a name.
pub trait Number: Real {
    /// On the axis `arith`.
    const NAME: &'static str;
    /// The same number.
    fn of(x: f32) -> Self;
}

impl Number for f64 {
    const NAME: &'static str = "f64";
    fn of(x: f32) -> Self {
        Self::from(x)
    }
}

impl Number for Compensated {
    const NAME: &'static str = "compensated";
    fn of(x: f32) -> Self {
        Self::from(x)
    }
}

/// As the library ships it, in the scalar R, with its own sines and cosines: f64, which this processor computes in
/// software, or f32 with the rounding errors carried along.
#[derive(Debug)]
pub struct In<R, M, F, const B: usize>(PhantomData<(R, M, F)>);

impl<R, M, F, const B: usize, const N: usize> Inverse<N> for In<R, M, F, B>
where
    R: Number,
    M: Modelled<B, N>,
    M::Scene: Effect<R, B, N>,
    F: Form<M::Robot>,
{
    const KEY: Key = Key {
        arith: R::NAME,
        model: M::NAME,
        form: F::NAME,
        ..Key::DEFAULT
    };
    type Input = State<R, N, N>;
    type Output = [R; N];

    fn start(_: &State<f32, N, N>) -> Self {
        Self(PhantomData)
    }
    fn input(course: &ElasticReference<f32, N, N>) -> Self::Input {
        let State { q, qd, qdd } = course.state;
        State {
            q: q.map(R::of),
            qd: qd.map(R::of),
            qdd: qdd.map(R::of),
        }
    }
    #[inline(always)]
    fn tick(&mut self, state: &Self::Input) -> [R; N] {
        F::rnea::<Native, _, _, _, _, _>(state, &M::SCENE)
    }
    fn torque(output: &[R; N]) -> [f64; N] {
        output.map(R::to_f64)
    }
    fn address() -> usize {
        F::address::<Native, R, M::Scene, B, N>()
    }
}

/// In fixed point, by the core: angles come in half turns, rates and accelerations in the robot's [`Units`], as
/// drives of this kind count them.
#[derive(Debug)]
pub struct FixedPoint<T, M, const B: usize>(PhantomData<(T, M)>);

impl<T, M, const B: usize, const N: usize> Inverse<N> for FixedPoint<T, M, B>
where
    T: dynamics_core::model::Robot<B, N, N>,
    M: Modelled<B, N, Robot = T>,
{
    const KEY: Key = Key {
        arith: "q31",
        model: M::NAME,
        form: "core",
        ..Key::DEFAULT
    };
    type Input = State<Fixed, N, N>;
    type Output = [Fixed; N];

    fn start(_: &State<f32, N, N>) -> Self {
        Self(PhantomData)
    }
    fn input(course: &ElasticReference<f32, N, N>) -> Self::Input {
        let State { q, qd, qdd } = course.state;
        let time = const { Units::of(&T::MODEL).time };
        State {
            q: q.map(|q| {
                let half_turns = f64::from(q) / core::f64::consts::PI;
                // Whole turns are none.
                let turns = (half_turns * 0.5 + 0.5 * half_turns.signum()) as i32;
                Fixed::from_f64(half_turns - 2.0 * f64::from(turns))
            }),
            qd: qd.map(|qd| Fixed::from_f64(f64::from(qd) * time)),
            qdd: qdd.map(|qdd| Fixed::from_f64(f64::from(qdd) * time * time)),
        }
    }
    #[inline(never)]
    fn tick(&mut self, state: &Self::Input) -> [Fixed; N] {
        let trig: JointTrig<Fixed, N> = Engine::<InUnits<T>, HalfTurns>::joint_trig(&state.q);
        Core::<InUnits<T>>::rnea(trig.with(state), &M::IN_UNITS)
    }
    fn torque(output: &[Fixed; N]) -> [f64; N] {
        let unit = const { Units::of(&T::MODEL).torque() };
        output.map(|tau| tau.to_f64() * unit)
    }
    fn address() -> usize {
        Self::tick as fn(&mut Self, &Self::Input) -> Self::Output as usize
    }
}
