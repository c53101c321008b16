//! Ways that compute in every few ticks only.

use core::marker::PhantomData;

use dynamics_core::Engine;
use dynamics_core::state::State;
use dynamics_core::trig::Kernel;
use motion_control::{FirstOrderHold, InertiaUpdate, Interpolator, ZeroOrderHold};

use super::Inverse;
use super::key::{Key, Named};
use super::model::Modelled;

/// The computation W in every `TICKS`-th tick, and P in the ticks between.
#[derive(Debug)]
pub struct Every<W, P, const TICKS: usize> {
    way: W,
    between: P,
    wait: usize,
}

/// The engine's torque and M.
#[derive(Debug)]
pub struct Linear<K, M, const B: usize>(PhantomData<(K, M)>);

/// The engine's torque and M in every `TICKS`-th tick, and between them what M makes of the
/// accelerations.
pub type EveryLinearised<K, M, const B: usize, const N: usize, const TICKS: usize> =
    Every<Linear<K, M, B>, InertiaUpdate<f32, N, TICKS>, TICKS>;

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

/// The computed quantity and the rule for the ticks between; the ticks for which it is computed
/// ahead, its key if it is computed in every tick, and what it is given; both before the first
/// tick; a tick that computes, and one that does not.
macro_rules! every {
    ($([$($generics:tt)*] $way:ty, $between:ty = $name:literal, ahead: $ahead:expr, $key:expr,
       $input:ty = |$at:ident| $given:expr, |$first:pat_param| $start:expr,
       |$self:ident, $now:ident| $fresh:expr, $stale:expr;)*) => {$(
        inverse! {
            [$($generics)*, const TICKS: usize] Every<$way, $between, TICKS>,
            Key { rate: rate(TICKS), between: $name, ..$key },
            { const MEMORY: bool = true; const AHEAD: usize = $ahead; },
            $input = |$at| $given, f32, |$first| {
                let (way, between) = $start;
                Self { way, between, wait: 0 }
            },
            #[inline(never)] |$self, $now| {
                if $self.wait > 0 {
                    $self.wait -= 1;
                    return $stale;
                }
                $self.wait = TICKS - 1;
                $fresh
            };
        }
    )*};
}
every! {
    [W: Inverse<N, Scalar = f32>] W, ZeroOrderHold<f32, N> = "held", ahead: 0, W::KEY,
        W::Input = |at| W::input(at), |first| (W::start(first), ZeroOrderHold::start()),
        |self, input| self.between.update(self.way.tick(input)), self.between.hold();
    [W: Inverse<N, Scalar = f32>] W, FirstOrderHold<f32, N, TICKS> = "extrapolated", ahead: 0, W::KEY,
        W::Input = |at| W::input(at), |first| (W::start(first), FirstOrderHold::start()),
        |self, input| self.between.update(self.way.tick(input)), self.between.hold();
    [W: Inverse<N, Scalar = f32>] W, Interpolator<f32, N, TICKS> = "interpolated", ahead: TICKS, W::KEY,
        W::Input = |at| W::input(at), |first| {
            let mut way = W::start(first);
            let torque = way.tick(&W::input(first));
            (way, Interpolator::start(torque))
        },
        |self, input| self.between.update(self.way.tick(input)), self.between.hold();
    [K: Kernel<f32> + Named, M: Modelled<B, N>, const B: usize] Linear<K, M, B>,
        InertiaUpdate<f32, N, TICKS> = "linearised", ahead: 0, Key { trig: K::NAME, model: M::NAME, ..Key::DEFAULT },
        State<f32, N, N> = |at| *at, |_| (Linear(PhantomData), InertiaUpdate::start()),
        |self, state| {
            let trig = Engine::<M::Robot, K>::joint_trig(&state.q);
            let torque = Engine::<M::Robot>::rnea(trig.with(state), &M::SCENE);
            let mass_matrix = Engine::<M::Robot>::crba(&trig, &M::SCENE);
            self.between.update(torque, mass_matrix, &state.qdd)
        }, self.between.hold(&state.qdd);
}
