//! What the core's algorithms cost over models of run time as chains grow, between the meter's markers, with
//! precomputed sines and cosines. `cargo xtask growth` reads the log, which ends with `done`.
#![no_std]
#![no_main]

#[path = "costs/row.rs"]
mod row;

use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use dynamics_core::MassMatrix;
use dynamics_core::algorithms::{self, NotPositiveDefinite, ltdl, solve};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Robot};
use dynamics_core::state::{JointTrig, State};
use firmware_demo::target;
use row::Row;

/// Number of states on which each function is called: the work does not depend on them.
const STATES: usize = 2;

/// Rods that bend and twist: N bodies, one on the other.
struct Chain<const N: usize>;

impl<const N: usize> Robot<N, N, N> for Chain<N> {
    const MODEL: ArmModel<f64, N> = ArmModel::new("chain", rods());
}

/// Every number that a body has is another than zero.
const fn rods<const N: usize>() -> [Body; N] {
    let mut bodies = [Body::new("rod", BASE, Joint::fixed()); N];
    let mut i = 0;
    while i < N {
        let parent = if i == 0 { BASE } else { i - 1 };
        let axis = if i % 2 == 0 {
            [0.1, 0.2, 1.0]
        } else {
            [0.1, 1.0, 0.2]
        };
        bodies[i] = Body::new("rod", parent, Joint::revolute(axis))
            .xyz([0.02, 0.03, 0.2])
            .rpy([0.1, 0.2, 0.3])
            .mass(1.0)
            .com([0.01, 0.02, 0.1])
            .inertia([4e-3, 1e-4, 2e-4, 5e-3, 3e-4, 1e-3]);
        i += 1;
    }
    bodies
}

/// A model that the compiler knows nothing of.
type Known<const N: usize> = &'static ArmModel<f32, N>;
type Solution<const N: usize> = Result<[f32; N], NotPositiveDefinite>;

#[inline(never)]
fn rnea<const N: usize>(
    model: Known<N>,
    trig: &JointTrig<f32, N>,
    state: &State<f32, N, N>,
) -> [f32; N] {
    algorithms::rnea(model, trig.with(state), &RIGID_BODY)
}

#[inline(never)]
fn crba<const N: usize>(model: Known<N>, trig: &JointTrig<f32, N>) -> MassMatrix<f32, N> {
    algorithms::crba(model, trig, &RIGID_BODY)
}

#[inline(never)]
fn factor_solve<const N: usize>(
    model: Known<N>,
    m: &MassMatrix<f32, N>,
    tau: &[f32; N],
) -> Solution<N> {
    Ok(solve(model, &ltdl(model, m)?, tau))
}

#[inline(never)]
fn forward<const N: usize>(
    model: Known<N>,
    trig: &JointTrig<f32, N>,
    state: &State<f32, N, N>,
) -> Solution<N> {
    algorithms::forward_dynamics(model, trig.with(state), &state.qdd, &RIGID_BODY)
}

#[inline(never)]
fn aba<const N: usize>(
    model: Known<N>,
    trig: &JointTrig<f32, N>,
    state: &State<f32, N, N>,
) -> Solution<N> {
    algorithms::aba(model, trig.with(state), &state.qdd, &RIGID_BODY)
}

/// Measures every algorithm on a chain of N.
#[inline(never)]
fn chain<const N: usize>() {
    let model: Known<N> = black_box(const { &Chain::<N>::MODEL_F32 });
    let row = |algorithm| Row::of::<Chain<N>, N, N>(algorithm, "core", "full", false);
    let asks = [0.5_f32, -0.7].map(|angle| {
        let mut q = [angle; N];
        q.iter_mut().step_by(2).for_each(|q| *q = 0.3 - *q);
        let state = State {
            q,
            qd: [0.4 * angle; N],
            qdd: [1.0; N],
        };
        (JointTrig::new(model, &q), state)
    });
    let asks: &[_; STATES] = &asks;
    row("rnea").measure(
        rnea::<N> as fn(_, &_, &_) -> _ as usize,
        asks,
        |(trig, state)| rnea(model, trig, state),
    );
    row("crba").measure(crba::<N> as fn(_, &_) -> _ as usize, asks, |(trig, _)| {
        crba(model, trig)
    });
    let m = [crba(model, &asks[0].0)];
    row("factor_solve").measure(factor_solve::<N> as fn(_, &_, &_) -> _ as usize, &m, |m| {
        factor_solve(model, m, &[1.0; N])
    });
    row("forward").measure(
        forward::<N> as fn(_, &_, &_) -> _ as usize,
        asks,
        |(trig, state)| forward(model, trig, state),
    );
    row("aba").measure(
        aba::<N> as fn(_, &_, &_) -> _ as usize,
        asks,
        |(trig, state)| aba(model, trig, state),
    );
}

#[entry]
fn main() -> ! {
    chain::<2>();
    chain::<4>();
    chain::<6>();
    chain::<8>();
    chain::<9>();
    chain::<12>();
    chain::<16>();
    chain::<24>();
    chain::<32>();
    chain::<48>();
    chain::<64>();
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}
