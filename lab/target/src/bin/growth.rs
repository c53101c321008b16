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

/// Functions that are called as they are measured: their arguments behind the model, and what they do.
macro_rules! functions {
    ($($name:ident($model:ident $(, $argument:ident: $type:ty)+) -> $result:ty = $call:expr;)+) => {$(
        #[inline(never)]
        fn $name<const N: usize>($model: Known<N> $(, $argument: $type)+) -> $result {
            $call
        }
    )+};
}

functions! {
    rnea(model, trig: &JointTrig<f32, N>, state: &State<f32, N, N>) -> [f32; N]
        = algorithms::rnea(model, trig.with(state), &RIGID_BODY);
    crba(model, trig: &JointTrig<f32, N>) -> MassMatrix<f32, N>
        = algorithms::crba(model, trig, &RIGID_BODY);
    factor_solve(model, m: &MassMatrix<f32, N>, tau: &[f32; N]) -> Solution<N>
        = Ok(solve(model, &ltdl(model, m)?, tau));
    forward_dynamics(model, trig: &JointTrig<f32, N>, state: &State<f32, N, N>) -> Solution<N>
        = algorithms::forward_dynamics(model, trig.with(state), &state.qdd, &RIGID_BODY);
    aba(model, trig: &JointTrig<f32, N>, state: &State<f32, N, N>) -> Solution<N>
        = algorithms::aba(model, trig.with(state), &state.qdd, &RIGID_BODY);
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
    macro_rules! measure {
        ($name:ident on $inputs:expr, ($($input:tt)*) => $($argument:expr),+) => {
            let run: fn(Known<N>, $(measure!(any $argument)),+) -> _ = $name::<N>;
            row(stringify!($name)).measure(run as usize, $inputs, |$($input)*| $name(model, $($argument),+));
        };
        (any $argument:expr) => { &_ };
    }
    measure!(rnea on asks, ((trig, state)) => trig, state);
    measure!(crba on asks, ((trig, _)) => trig);
    let m = [crba(model, &asks[0].0)];
    measure!(factor_solve on &m, (m) => m, &[1.0; N]);
    measure!(forward_dynamics on asks, ((trig, state)) => trig, state);
    measure!(aba on asks, ((trig, state)) => trig, state);
}

#[entry]
fn main() -> ! {
    macro_rules! chains {
        ($($n:literal)*) => { $(chain::<$n>();)* };
    }
    chains!(2 4 6 8 9 12 16 24 32 64);
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}
