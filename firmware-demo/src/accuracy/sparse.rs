//! Ways that compute in every few ticks only.

use core::marker::PhantomData;

use dynamics_core::Engine;
use dynamics_core::control::{FirstOrderHold, InertiaUpdate, Interpolator, ZeroOrderHold};
use dynamics_core::drivetrain::ElasticReference;
use dynamics_core::state::State;

use super::Inverse;
use super::inverse::By;
use super::kernels::Named;
use super::key::Key;
use super::model::Modelled;
use super::robots::momentary;

/// The computation W in every `TICKS`-th tick, and P in the ticks between.
#[derive(Debug)]
pub struct Every<W, P, const TICKS: usize> {
    way: W,
    between: P,
    wait: usize,
}

/// The engine's torque and M in every `TICKS`-th tick, and between them what M makes of the accelerations.
#[derive(Debug)]
pub struct EveryLinearised<K, M, const B: usize, const N: usize, const TICKS: usize> {
    between: InertiaUpdate<f32, N, TICKS>,
    wait: usize,
    names: PhantomData<(K, M)>,
}

/// What the ticks between get.
pub trait Between<const N: usize> {
    /// On the axis `between`.
    const NAME: &'static str;
    /// It computes torques of the next computing tick.
    const AHEAD: bool = false;
    /// Before the first tick, which has this torque.
    fn begin(first: [f32; N]) -> Self;
    /// In a tick that has computed the torque.
    fn fresh(&mut self, torque: [f32; N]) -> [f32; N];
    /// In a tick that has not.
    fn stale(&mut self) -> [f32; N];
}

macro_rules! between {
    ($($between:ident $(<$ticks:ident>)?, $name:literal, $ahead:literal, |$first:pat_param| $start:expr;)*) => {$(
        impl<const N: usize $(, const $ticks: usize)?> Between<N> for $between<f32, N $(, $ticks)?> {
            const NAME: &'static str = $name;
            const AHEAD: bool = $ahead;
            fn begin($first: [f32; N]) -> Self {
                $start
            }
            #[inline(always)]
            fn fresh(&mut self, torque: [f32; N]) -> [f32; N] {
                self.update(torque)
            }
            #[inline(always)]
            fn stale(&mut self) -> [f32; N] {
                self.hold()
            }
        }
    )*};
}
between! {
    ZeroOrderHold, "held", false, |_| Self::start();
    FirstOrderHold<TICKS>, "extrapolated", false, |_| Self::start();
    Interpolator<TICKS>, "interpolated", true, |first| Self::start(first);
}

/// On the axis `rate`.
const fn rate(ticks: usize) -> &'static str {
    match ticks {
        2 => "2",
        5 => "5",
        10 => "10",
        20 => "20",
        _ => panic!("no such rate"),
    }
}

impl<W, P, const N: usize, const TICKS: usize> Inverse<N> for Every<W, P, TICKS>
where
    W: Inverse<N, Scalar = f32>,
    P: Between<N>,
{
    const KEY: Key = Key {
        rate: rate(TICKS),
        between: P::NAME,
        ..W::KEY
    };
    const MEMORY: bool = true;
    const AHEAD: usize = if P::AHEAD { TICKS } else { 0 };
    type Input = W::Input;
    type Scalar = f32;

    fn start(first: &State<f32, N, N>) -> Self {
        let mut way = W::start(first);
        let torque = way.tick(&W::input(&momentary(*first)));
        Self {
            way,
            between: P::begin(torque),
            wait: 0,
        }
    }
    fn input(course: &ElasticReference<f32, N, N>) -> Self::Input {
        W::input(course)
    }
    #[inline(never)]
    fn tick(&mut self, input: &Self::Input) -> [f32; N] {
        if self.wait > 0 {
            self.wait -= 1;
            return self.between.stale();
        }
        self.wait = TICKS - 1;
        let torque = self.way.tick(input);
        self.between.fresh(torque)
    }
}

impl<K, M, const B: usize, const N: usize, const TICKS: usize> Inverse<N>
    for EveryLinearised<K, M, B, N, TICKS>
where
    K: Named,
    M: Modelled<B, N>,
{
    const KEY: Key = Key {
        rate: rate(TICKS),
        between: "linearised",
        ..By::<K, M, Engine<M::Robot>, B, N>::KEY
    };
    const MEMORY: bool = true;
    type Input = State<f32, N, N>;
    type Scalar = f32;

    fn start(_: &State<f32, N, N>) -> Self {
        Self {
            between: InertiaUpdate::start(),
            wait: 0,
            names: PhantomData,
        }
    }
    fn input(course: &ElasticReference<f32, N, N>) -> Self::Input {
        course.state
    }
    #[inline(never)]
    fn tick(&mut self, state: &Self::Input) -> [f32; N] {
        if self.wait > 0 {
            self.wait -= 1;
            return self.between.hold(&state.qdd);
        }
        self.wait = TICKS - 1;
        let trig = Engine::<M::Robot, K>::joint_trig(&state.q);
        let torque = Engine::<M::Robot>::rnea(trig.with(state), &M::SCENE);
        let mass_matrix = Engine::<M::Robot>::crba(&trig, &M::SCENE);
        self.between.update(torque, mass_matrix, &state.qdd)
    }
}
