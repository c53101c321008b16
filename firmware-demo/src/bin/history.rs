//! What the ancestors cost over chains of different lengths, and today's core and engine on the same chains, between
//! the meter's markers, with precomputed sines and cosines. `cargo xtask history` reads the log, which ends with
//! `done`.
#![no_std]
#![no_main]

#[path = "costs/row.rs"]
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
type Torques<const N: usize> = fn(&Chain<f32, N>, &Motion<N>) -> [f32; N];
type Inertia<const N: usize> = fn(&Chain<f32, N>, &Motion<N>) -> [[f32; N]; N];

struct Ask<const N: usize> {
    state: State<f32, N, N>,
    trig: JointTrig<f32, N>,
    motion: Motion<N>,
}

impl<const N: usize> Ask<N> {
    fn new(model: &Model<N>, angle: f64) -> Self {
        let mut q = [angle; N];
        q.iter_mut().step_by(2).for_each(|q| *q = 0.3 - *q);
        let (qd, qdd) = ([0.4 * angle; N], [1.0; N]);
        let [single, qd_single, qdd_single] = [q, qd, qdd].map(|list| list.map(|x| x as f32));
        let state = State {
            q: single,
            qd: qd_single,
            qdd: qdd_single,
        };
        let trig = JointTrig::new(model, &state.q);
        Self {
            state,
            trig,
            motion: Motion::new(&q, &qd, &qdd),
        }
    }
}

#[inline(never)]
fn core_rnea<const N: usize>(model: &Model<N>, ask: &Ask<N>) -> [f32; N] {
    algorithms::rnea(model, ask.trig.with(&ask.state), &RIGID_BODY)
}

#[inline(never)]
fn core_crba<const N: usize>(model: &Model<N>, ask: &Ask<N>) -> MassMatrix<f32, N> {
    algorithms::crba(model, &ask.trig, &RIGID_BODY)
}

#[inline(never)]
fn method_4<const N: usize>(chain: &Chain<f32, N>, motion: &Motion<N>) -> [f32; N] {
    history::walker_orin::solve(chain, motion, &[1.0; N], (N, 0.0)).0
}

fn row<const N: usize>(algorithm: &'static str, form: &'static str) -> Row<'static> {
    Row::of::<Rods<N>, N, N>(algorithm, form, "full", false)
}

/// Measures every algorithm on a chain of N.
#[inline(never)]
fn chain<const N: usize>() {
    let model: &Model<N> = black_box(const { &Rods::<N>::MODEL_F32 });
    let chain = &black_box(Chain::default());
    let asks: &[Ask<N>; STATES] = &[0.5, -0.7].map(|angle| Ask::new(model, angle));
    let torques: [(_, Torques<N>); 7] = [
        ("uicker_kahn", history::uicker_kahn::torques),
        ("waters", history::waters::torques),
        ("hollerbach_4", history::hollerbach_4::torques),
        ("hollerbach_3", history::hollerbach_3::torques),
        ("luh_walker_paul", history::luh_walker_paul::torques),
        ("balafoutis_patel", history::balafoutis_patel::torques),
        ("method_4", method_4),
    ];
    for (name, run) in torques {
        row::<N>(name, "ancestor").measure(run as usize, asks, |ask| run(chain, &ask.motion));
    }
    let inertias: [(_, Inertia<N>); 3] = [
        ("method_1", history::walker_orin::method_1),
        ("method_2", history::walker_orin::method_2),
        ("method_3", history::composite_bodies::method_3),
    ];
    for (name, run) in inertias {
        row::<N>(name, "ancestor").measure(run as usize, asks, |ask| run(chain, &ask.motion));
    }
    let (rnea, crba): (fn(_, &_) -> _, fn(_, &_) -> _) = (core_rnea::<N>, core_crba::<N>);
    row::<N>("rnea", "core").measure(rnea as usize, asks, |ask| rnea(model, ask));
    row::<N>("crba", "core").measure(crba as usize, asks, |ask| crba(model, ask));
}

#[inline(never)]
fn engine_rnea(ask: &Ask<6>) -> [f32; 6] {
    Engine::<Rods<6>>::rnea(ask.trig.with(&ask.state), &RIGID_BODY)
}

#[inline(never)]
fn engine_crba(ask: &Ask<6>) -> MassMatrix<f32, 6> {
    Engine::<Rods<6>>::crba(&ask.trig, &RIGID_BODY)
}

#[entry]
fn main() -> ! {
    macro_rules! chains {
        ($($n:literal)*) => { $(chain::<$n>();)* };
    }
    chains!(2 3 4 6 8 10 12);
    let model = const { &Rods::<6>::MODEL_F32 };
    let asks: &[Ask<6>; STATES] = &[0.5, -0.7].map(|angle| Ask::new(model, angle));
    let (rnea, crba): (fn(&_) -> _, fn(&_) -> _) = (engine_rnea, engine_crba);
    row::<6>("engine_rnea", "engine").measure(rnea as usize, asks, rnea);
    row::<6>("engine_crba", "engine").measure(crba as usize, asks, crba);
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}
