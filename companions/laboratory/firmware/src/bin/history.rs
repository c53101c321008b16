//! The cost of the ancestors over chains of different lengths, and of today's core and engine on
//! the same chains, between the meter's markers, with precomputed sines and cosines. `cargo xtask
//! history` reads the log, which ends with `done`.
#![no_std]
#![no_main]

#[path = "../../../../../lab/firmware/src/bin/costs/row.rs"]
mod row;

use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{ArmModel, Robot};
use dynamics_core::state::{JointTrig, State};
use dynamics_core::{Engine, MassMatrix, algorithms};
use firmware_demo::target;
use history::chain::{Chain, Rods};
use row::Row;

/// Number of states on which each function is called: the work does not depend on them.
const STATES: usize = 2;

type Model<const N: usize> = ArmModel<f32, N>;
type Motion<const N: usize> = history::State<f32, N>;
type Ask<const N: usize> = (State<f32, N, N>, JointTrig<f32, N>, Motion<N>);

fn ask<const N: usize>(angle: f32) -> Ask<N> {
    let mut q = [angle; N];
    q.iter_mut().step_by(2).for_each(|q| *q = 0.3 - *q);
    let (qd, qdd) = ([0.4 * angle; N], [1.0; N]);
    let trig = JointTrig::new(const { &Rods::<N>::MODEL_F32 }, &q);
    let doubles = [q, qd, qdd].map(|list| list.map(f64::from));
    let motion = Motion::new(&doubles[0], &doubles[1], &doubles[2]);
    (State { q, qd, qdd }, trig, motion)
}

#[inline(never)]
fn rnea<const N: usize>(model: &Model<N>, (state, trig, _): &Ask<N>) -> [f32; N] {
    algorithms::rnea(model, trig.with(state), &RIGID_BODY)
}

#[inline(never)]
fn crba<const N: usize>(model: &Model<N>, (_, trig, _): &Ask<N>) -> MassMatrix<f32, N> {
    algorithms::crba(model, trig, &RIGID_BODY)
}

/// The engine has the chain compiled into it.
#[inline(never)]
fn engine_rnea<const N: usize>(_: &Model<N>, (state, trig, _): &Ask<N>) -> [f32; N] {
    Engine::<Rods<N>>::rnea(trig.with(state), &RIGID_BODY)
}

#[inline(never)]
fn engine_crba<const N: usize>(_: &Model<N>, (_, trig, _): &Ask<N>) -> MassMatrix<f32, N> {
    Engine::<Rods<N>>::crba(trig, &RIGID_BODY)
}

/// Measures functions of a chain or model and of a part of each ask, each under its name.
macro_rules! measure {
    ($n:tt, $chain:ident: $chain_type:ty, $asks:ident, $ask:pat => $part:ident: $part_type:ty,
     $($name:ident = $run:path;)+) => {$(
        let run: fn(&$chain_type, &$part_type) -> _ = $run;
        let row = Row::of::<Rods<$n>, $n, $n>(stringify!($name), "history", "full", false);
        row.measure(run as usize, $asks, |$ask| $run($chain, $part));
    )+};
}

/// Measures every algorithm on a chain of N, but for the engine's.
#[inline(never)]
fn chain<const N: usize>() {
    let chain: &Chain<f32, N> = &black_box(Chain::default());
    let asks: &[Ask<N>; STATES] = &[0.5, -0.7].map(ask);
    measure! { N, chain: Chain<f32, N>, asks, (_, _, motion) => motion: Motion<N>,
        uicker_kahn = history::uicker_kahn::torques;
        waters = history::waters::torques;
        hollerbach_4 = history::hollerbach_4::torques;
        hollerbach_3 = history::hollerbach_3::torques;
        luh_walker_paul = history::luh_walker_paul::torques;
        balafoutis_patel = history::balafoutis_patel::torques;
        method_1 = history::walker_orin::method_1;
        method_2 = history::walker_orin::method_2;
        method_3 = history::composite_bodies::method_3;
        method_4 = history::walker_orin::method_4;
    }
    let model: &Model<N> = black_box(const { &Rods::<N>::MODEL_F32 });
    measure! { N, model: Model<N>, asks, ask => ask: Ask<N>, rnea = rnea; crba = crba; }
}

#[entry]
fn main() -> ! {
    macro_rules! chains {
        ($($n:literal)*) => { $(chain::<$n>();)* };
    }
    chains!(2 3 4 6 8 10 12);
    let model = const { &Rods::<6>::MODEL_F32 };
    let asks: &[Ask<6>; STATES] = &[0.5, -0.7].map(ask);
    measure! { 6, model: Model<6>, asks, ask => ask: Ask<6>,
        engine_rnea = engine_rnea;
        engine_crba = engine_crba;
    }
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}
