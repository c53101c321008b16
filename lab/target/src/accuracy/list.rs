//! Every way of a robot.

use dynamics_core::model::Robot;
use dynamics_core::trig::{Minimax, Table};
use dynamics_core::{Core, Engine};
use motion_control::{FirstOrderHold, Interpolator, ZeroOrderHold};

use super::form::Form;
use super::inverse::{After, By, Following, In};
use super::kernels::{Libm, Micromath};
use super::key::Named;
use super::model::{Full, GravityOnly, Modelled, NoCoriolis, Parameters, Without};
use super::multirate::{Every, EveryLinearised};
use super::{Inverse, Visitor};

macro_rules! ways {
    ($visitor:ident: $($way:ty),* $(,)?) => {
        $($visitor.way::<$way>();)*
    };
}

/// The engine on the robot of a model, in f32.
type Own<M, const B: usize, const N: usize> = In<f32, M, Engine<<M as Modelled<B, N>>::Robot>, B>;
type Kernel<K, M, const B: usize, const N: usize> =
    By<f32, K, M, Engine<<M as Modelled<B, N>>::Robot>, B>;
/// The kernel whose errors are as small as what the approximations of the model leave out.
type Coarse = Table<256, 1>;

/// Shows all of them to `visitor`, the default first.
pub fn inverse<T: Robot<B, N, N>, const B: usize, const N: usize>(visitor: &mut impl Visitor<N>) {
    forms::<Full<T>, T, B, N>(visitor);
    forms::<NoCoriolis<T>, T, B, N>(visitor);
    forms::<GravityOnly<T>, T, B, N>(visitor);
    ways! { visitor:
        Own<Parameters<T, 6>, B, N>,
        Own<Parameters<T, 8>, B, N>,
        Own<Parameters<T, 11>, B, N>,
        Own<Without<T, 1000>, B, N>,
        Own<Without<T, 100>, B, N>,
        Kernel<Coarse, Without<T, 1000>, B, N>,
        Kernel<Coarse, Without<T, 3000>, B, N>,
        Kernel<Coarse, Without<T, 10_000>, B, N>,
        Kernel<Coarse, Without<T, 30_000>, B, N>,
    }
    rates::<Kernel<Coarse, Without<T, 1000>, B, N>, N>(visitor);
    linearised::<Coarse, Without<T, 1000>, B, N>(visitor);
    rates::<Own<Full<T>, B, N>, N>(visitor);
    rates::<Kernel<Coarse, Full<T>, B, N>, N>(visitor);
    rates::<Own<GravityOnly<T>, B, N>, N>(visitor);
    linearised::<Table<128, 3>, Full<T>, B, N>(visitor);
    linearised::<Coarse, Full<T>, B, N>(visitor);
}

/// Shows the default and what single changes make of it to `visitor`: few enough to be built in a
/// minute.
pub fn single<T: Robot<B, N, N>, const B: usize, const N: usize>(visitor: &mut impl Visitor<N>) {
    ways! { visitor:
        Own<Full<T>, B, N>,
        Kernel<Minimax<5, 2>, Full<T>, B, N>,
        Kernel<Minimax<3, 2>, Full<T>, B, N>,
        Kernel<Minimax<7, 2>, Full<T>, B, N>,
        Kernel<Table<256, 1>, Full<T>, B, N>,
        Following<Full<T>, Engine<T>, B, N>,
        Own<NoCoriolis<T>, B, N>,
        Own<GravityOnly<T>, B, N>,
        Own<Parameters<T, 8>, B, N>,
        Own<Without<T, 1000>, B, N>,
        Every<Own<Full<T>, B, N>, ZeroOrderHold<f32, N>, 10>,
        Every<Own<Full<T>, B, N>, Interpolator<f32, N, 10>, 10>,
        EveryLinearised<Table<128, 3>, Full<T>, B, N, 10>,
        In<f32, Full<T>, Core<T>, B>,
    }
}

/// By every kernel, by engine and core, and in f64.
fn forms<M, T, const B: usize, const N: usize>(visitor: &mut impl Visitor<N>)
where
    M: Modelled<B, N, Robot = T>,
    T: Robot<B, N, N>,
{
    ways!(visitor: In<f32, M, Engine<T>, B>, By<f32, Table<128, 3, 4>, M, Engine<T>, B>);
    kernels::<M, Engine<T>, B, N>(visitor);
    ways!(visitor: In<f32, M, Core<T>, B>, By<f32, Table<128, 3>, M, Core<T>, B>);
    kernels::<M, Core<T>, B, N>(visitor);
}

fn kernels<M, F, const B: usize, const N: usize>(visitor: &mut impl Visitor<N>)
where
    M: Modelled<B, N>,
    F: Form<M::Robot, f32, M::Scene, B, N> + Form<M::Robot, f64, M::Scene, B, N>,
{
    ways! { visitor:
        By<f32, Minimax<7, 3>, M, F, B>,
        By<f32, Minimax<7, 2>, M, F, B>,
        By<f32, Minimax<5, 2>, M, F, B>,
        By<f32, Minimax<3, 2>, M, F, B>,
        By<f32, Table<64, 4>, M, F, B>,
        By<f32, Table<256, 2>, M, F, B>,
        By<f32, Table<256, 1>, M, F, B>,
        Following<M, F, B, N>,
        After<Libm, M, F, B>,
        After<Micromath, M, F, B>,
        In<f64, M, F, B>,
    }
}

/// Every few ticks, held, extrapolated and interpolated.
fn rates<W: Inverse<N, Scalar = f32>, const N: usize>(visitor: &mut impl Visitor<N>) {
    macro_rules! rates {
        ($($ticks:literal)*) => {$(ways! { visitor:
            Every<W, ZeroOrderHold<f32, N>, $ticks>,
            Every<W, FirstOrderHold<f32, N, $ticks>, $ticks>,
            Every<W, Interpolator<f32, N, $ticks>, $ticks>,
        })*};
    }
    rates!(2 5 10 20);
}

/// Every few ticks, by M between.
fn linearised<K, M, const B: usize, const N: usize>(visitor: &mut impl Visitor<N>)
where
    K: dynamics_core::trig::Kernel<f32> + Named,
    M: Modelled<B, N>,
{
    ways! { visitor:
        EveryLinearised<K, M, B, N, 2>,
        EveryLinearised<K, M, B, N, 5>,
        EveryLinearised<K, M, B, N, 10>,
        EveryLinearised<K, M, B, N, 20>,
    }
}
