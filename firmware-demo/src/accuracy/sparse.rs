//! Ways that compute in every few ticks only.

use dynamics_core::Engine;
use dynamics_core::control::{Extrapolated, Held, Interpolated, Linearised};
use dynamics_core::flexible::Course;
use dynamics_core::state::State;

use super::Inverse;
use super::inverse::By;
use super::kernels::Named;
use super::key::Key;
use super::model::Modelled;
use super::robots::momentary;

/// The way W in every `TICKS`-th tick, and P in those between.
#[derive(Debug)]
pub struct Every<W, P, const TICKS: usize> {
    way: W,
    between: P,
    wait: usize,
}

/// What the ticks between those of the way W get.
pub trait Between<W: Inverse<N>, const N: usize> {
    /// On the axis `between`.
    const NAME: &'static str;
    /// It computes torques of the next computing tick.
    const AHEAD: bool = false;
    /// Before the first tick.
    fn begin(way: &mut W, first: &State<f32, N, N>) -> Self;
    /// In a tick that computes.
    fn fresh(&mut self, way: &mut W, input: &W::Input) -> [f32; N];
    /// In a tick that does not.
    fn stale(&mut self, input: &W::Input) -> [f32; N];
}

macro_rules! between {
    ($($between:ident $(<$ticks:ident>)?, $name:literal, $ahead:literal, |$way:pat_param, $first:pat_param| $start:expr;)*) => {$(
        impl<W: Inverse<N, Scalar = f32>, const N: usize $(, const $ticks: usize)?> Between<W, N>
            for $between<f32, N $(, $ticks)?>
        {
            const NAME: &'static str = $name;
            const AHEAD: bool = $ahead;
            fn begin($way: &mut W, $first: &State<f32, N, N>) -> Self {
                $start
            }
            #[inline(always)]
            fn fresh(&mut self, way: &mut W, input: &W::Input) -> [f32; N] {
                let torque = way.tick(input);
                self.renew(torque)
            }
            #[inline(always)]
            fn stale(&mut self, _: &W::Input) -> [f32; N] {
                self.coast()
            }
        }
    )*};
}
between! {
    Held, "held", false, |_, _| Self::start();
    Extrapolated<TICKS>, "extrapolated", false, |_, _| Self::start();
    Interpolated<TICKS>, "interpolated", true, |way, first| Self::start(way.tick(&W::input(&momentary(*first))));
}

/// The engine's torque and M, and between them what M makes of the accelerations.
impl<K, M, const B: usize, const N: usize, const TICKS: usize>
    Between<By<K, M, Engine<M::Robot>, B, N>, N> for Linearised<f32, N, TICKS>
where
    K: Named,
    M: Modelled<B, N>,
{
    const NAME: &'static str = "linearised";
    fn begin(_: &mut By<K, M, Engine<M::Robot>, B, N>, _: &State<f32, N, N>) -> Self {
        Self::start()
    }
    #[inline(always)]
    fn fresh(
        &mut self,
        _: &mut By<K, M, Engine<M::Robot>, B, N>,
        state: &State<f32, N, N>,
    ) -> [f32; N] {
        let posture = Engine::<M::Robot>::posture_by::<K, f32, B, N, N>(&state.q);
        let torque = Engine::<M::Robot>::rnea_at(&posture, state, &M::SCENE);
        let mass_matrix = Engine::<M::Robot>::crba_at(&posture, &M::SCENE);
        self.renew(torque, mass_matrix, &state.qdd)
    }
    #[inline(always)]
    fn stale(&mut self, state: &State<f32, N, N>) -> [f32; N] {
        self.coast(&state.qdd)
    }
}

impl<W, P, const N: usize, const TICKS: usize> Inverse<N> for Every<W, P, TICKS>
where
    W: Inverse<N, Scalar = f32>,
    P: Between<W, N>,
{
    const KEY: Key = Key {
        rate: match TICKS {
            2 => "2",
            5 => "5",
            10 => "10",
            20 => "20",
            _ => panic!("no such rate"),
        },
        between: P::NAME,
        ..W::KEY
    };
    const MEMORY: bool = true;
    const AHEAD: usize = if P::AHEAD { TICKS } else { 0 };
    type Input = W::Input;
    type Scalar = f32;

    fn start(first: &State<f32, N, N>) -> Self {
        let mut way = W::start(first);
        Self {
            between: P::begin(&mut way, first),
            way,
            wait: 0,
        }
    }
    fn input(course: &Course<f32, N, N>) -> Self::Input {
        W::input(course)
    }
    #[inline(never)]
    fn tick(&mut self, input: &Self::Input) -> [f32; N] {
        if self.wait > 0 {
            self.wait -= 1;
            return self.between.stale(input);
        }
        self.wait = TICKS - 1;
        self.between.fresh(&mut self.way, input)
    }
}
