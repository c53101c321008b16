//! Every way of a robot.

use dynamics_core::control::{FirstOrderHold, Interpolator, ZeroOrderHold};
use dynamics_core::model::{Pruned, Robot};
use dynamics_core::scalar::Compensated;
use dynamics_core::trig::{Minimax, Table};
use dynamics_core::{Core, Engine};

use super::compliant::{Compliant, Joints, Rigid};
use super::form::Form;
use super::inverse::{After, By, Following, Shipped};
use super::kernels::{Libm, Micromath};
use super::model::{Full, GravityOnly, Modelled, NoCoriolis, Parameters, Rounded, Without};
use super::numbers::{FixedPoint, In};
use super::sparse::{Every, EveryLinearised};
use super::{Inverse, Visitor};

/// Shows all of them to `visitor`, the default first.
pub fn inverse<T, const B: usize, const N: usize>(visitor: &mut impl Visitor<N>)
where
    T: Robot<B, N, N>,
{
    forms::<Full<T>, B, N>(visitor);
    forms::<NoCoriolis<T>, B, N>(visitor);
    forms::<GravityOnly<T>, B, N>(visitor);

    visitor.way::<In<Compensated, Full<T>, Engine<T>, B>>();
    others::<Full<T>, T, B, N>(visitor);
    others::<NoCoriolis<T>, T, B, N>(visitor);
    others::<GravityOnly<T>, T, B, N>(visitor);
    rounded::<T, 6, B, N>(visitor);
    rounded::<T, 8, B, N>(visitor);
    rounded::<T, 11, B, N>(visitor);
    pruned::<T, B, N>(visitor);

    type Own<T, const B: usize> = Shipped<Full<T>, Engine<T>, B>;
    type Coarse<T, const B: usize> = By<Table<256, 1>, Full<T>, Engine<T>, B>;
    type Weight<T, const B: usize> = Shipped<GravityOnly<T>, Engine<T>, B>;
    rates::<Own<T, B>, N>(visitor);
    rates::<Coarse<T, B>, N>(visitor);
    rates::<Weight<T, B>, N>(visitor);
    linearised::<Table<128, 3>, Full<T>, B, N>(visitor);
    linearised::<Table<256, 1>, Full<T>, B, N>(visitor);
}

/// Shows the default and what single changes make of it to `visitor`: few enough to be built in a minute.
pub fn single<T, const B: usize, const N: usize>(visitor: &mut impl Visitor<N>)
where
    T: Robot<B, N, N>,
{
    type Own<M, T, const B: usize> = Shipped<M, Engine<T>, B>;
    type Kernel<K, T, const B: usize> = By<K, Full<T>, Engine<T>, B>;
    visitor.way::<Own<Full<T>, T, B>>();
    visitor.way::<Kernel<Minimax<5, 2>, T, B>>();
    visitor.way::<Kernel<Minimax<3, 2>, T, B>>();
    visitor.way::<Kernel<Minimax<7, 2>, T, B>>();
    visitor.way::<Kernel<Table<256, 1>, T, B>>();
    visitor.way::<Following<Full<T>, Engine<T>, B, N>>();
    visitor.way::<Own<NoCoriolis<T>, T, B>>();
    visitor.way::<Own<GravityOnly<T>, T, B>>();
    rounded::<T, 8, B, N>(visitor);
    visitor.way::<Shipped<Without<T, 1000>, Engine<Pruned<T, 1000>>, B>>();
    visitor.way::<Every<Own<Full<T>, T, B>, ZeroOrderHold<f32, N>, 10>>();
    visitor.way::<Every<Own<Full<T>, T, B>, Interpolator<f32, N, 10>, 10>>();
    visitor.way::<EveryLinearised<Table<128, 3>, Full<T>, B, N, 10>>();
    visitor.way::<Shipped<Full<T>, Core<T>, B>>();
}

/// By every kernel, by engine and core.
fn forms<M: Modelled<B, N>, const B: usize, const N: usize>(visitor: &mut impl Visitor<N>) {
    type E<M, const B: usize, const N: usize> = Engine<<M as Modelled<B, N>>::Robot>;
    type C<M, const B: usize, const N: usize> = Core<<M as Modelled<B, N>>::Robot>;
    visitor.way::<Shipped<M, E<M, B, N>, B>>();
    visitor.way::<By<Table<128, 3, 4>, M, E<M, B, N>, B>>();
    kernels::<M, E<M, B, N>, B, N>(visitor);
    visitor.way::<Shipped<M, C<M, B, N>, B>>();
    visitor.way::<By<Table<128, 3>, M, C<M, B, N>, B>>();
    kernels::<M, C<M, B, N>, B, N>(visitor);
}

fn kernels<M, F, const B: usize, const N: usize>(visitor: &mut impl Visitor<N>)
where
    M: Modelled<B, N>,
    F: Form<M::Robot>,
{
    visitor.way::<By<Minimax<7, 3>, M, F, B>>();
    visitor.way::<By<Minimax<7, 2>, M, F, B>>();
    visitor.way::<By<Minimax<5, 2>, M, F, B>>();
    visitor.way::<By<Minimax<3, 2>, M, F, B>>();
    visitor.way::<By<Table<64, 4>, M, F, B>>();
    visitor.way::<By<Table<256, 2>, M, F, B>>();
    visitor.way::<By<Table<256, 1>, M, F, B>>();
    visitor.way::<Following<M, F, B, N>>();
    visitor.way::<After<Libm, M, F, B>>();
    visitor.way::<After<Micromath, M, F, B>>();
    visitor.way::<In<f64, M, F, B>>();
}

/// In other numbers, by the core.
fn others<M, T, const B: usize, const N: usize>(visitor: &mut impl Visitor<N>)
where
    M: Modelled<B, N, Robot = T>,
    T: Robot<B, N, N>,
{
    visitor.way::<In<Compensated, M, Core<T>, B>>();
    visitor.way::<FixedPoint<T, M, B>>();
}

/// With parameters of a few bits.
fn rounded<T, const BITS: u32, const B: usize, const N: usize>(visitor: &mut impl Visitor<N>)
where
    T: Robot<B, N, N>,
{
    visitor.way::<Shipped<Parameters<T, BITS>, Engine<Rounded<T, BITS>>, B>>();
}

/// Without what takes little torque, each share by the kernels whose errors are as small.
fn pruned<T, const B: usize, const N: usize>(visitor: &mut impl Visitor<N>)
where
    T: Robot<B, N, N>,
{
    type Own<T, const PPM: u32, const B: usize> =
        Shipped<Without<T, PPM>, Engine<Pruned<T, PPM>>, B>;
    type Kernel<K, T, const PPM: u32, const B: usize> =
        By<K, Without<T, PPM>, Engine<Pruned<T, PPM>>, B>;
    visitor.way::<Own<T, 1000, B>>();
    visitor.way::<Own<T, 100, B>>();
    visitor.way::<Kernel<Table<256, 1>, T, 1000, B>>();
    visitor.way::<Kernel<Table<256, 1>, T, 3000, B>>();
    visitor.way::<Kernel<Table<256, 1>, T, 10_000, B>>();
    visitor.way::<Kernel<Table<256, 1>, T, 30_000, B>>();
    rates::<Kernel<Table<256, 1>, T, 1000, B>, N>(visitor);
    linearised::<Table<256, 1>, Without<T, 1000>, B, N>(visitor);
}

/// Shows those of the same arm on joints that give way to `visitor`.
pub fn compliant<T, const N: usize>(visitor: &mut impl Visitor<N>)
where
    T: Robot<N, N, N> + Joints<N>,
{
    visitor.way::<Compliant<T, N>>();
    visitor.way::<Rigid<T, N>>();
}

/// Every few ticks, held, extrapolated and interpolated.
fn rates<W: Inverse<N, Output = [f32; N]>, const N: usize>(visitor: &mut impl Visitor<N>) {
    rate::<W, N, 2>(visitor);
    rate::<W, N, 5>(visitor);
    rate::<W, N, 10>(visitor);
    rate::<W, N, 20>(visitor);
}

fn rate<W, const N: usize, const TICKS: usize>(visitor: &mut impl Visitor<N>)
where
    W: Inverse<N, Output = [f32; N]>,
{
    visitor.way::<Every<W, ZeroOrderHold<f32, N>, TICKS>>();
    visitor.way::<Every<W, FirstOrderHold<f32, N, TICKS>, TICKS>>();
    visitor.way::<Every<W, Interpolator<f32, N, TICKS>, TICKS>>();
}

/// Every few ticks, by M between.
fn linearised<K, M, const B: usize, const N: usize>(visitor: &mut impl Visitor<N>)
where
    K: super::kernels::Named,
    M: Modelled<B, N>,
{
    visitor.way::<EveryLinearised<K, M, B, N, 2>>();
    visitor.way::<EveryLinearised<K, M, B, N, 5>>();
    visitor.way::<EveryLinearised<K, M, B, N, 10>>();
    visitor.way::<EveryLinearised<K, M, B, N, 20>>();
}
