//! Our dynamics and the C that CasADi generates for the same robots, between the meter's markers,
//! with precomputed sines and cosines. `cargo xtask peers` compiles the C and links it to this.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::{JointCoordinate, Robot};
use dynamics_core::robots::{A1, Iiwa14, Panda, Ur5e};
use dynamics_core::state::{JointTrig, State, StateWithTrig};
use dynamics_core::{Core, Engine, MassMatrix};
use firmware_demo::{marker::measured, scene::larger, target};

/// What CasADi's C takes: cosines, sines, and two vectors of which an algorithm may need none.
type C = unsafe extern "C" fn(*const f32, *const f32, *const f32, *const f32, *mut f32);
type Scene = (Gravity, Inertia, Coriolis);
/// What ours take.
type Inverse<'a, E, const N: usize> = fn(StateWithTrig<'a, f32, N, N>, &E) -> [f32; N];
type Matrix<const N: usize> = fn(&JointTrig<f32, N>, &Scene) -> MassMatrix<f32, N>;
type Forward<'a, const N: usize> =
    fn(StateWithTrig<'a, f32, N, N>, &[f32; N], &Scene) -> Solution<N>;
type Solution<const N: usize> = Result<[f32; N], NotPositiveDefinite>;
/// A form's name and function.
type Form<F> = (&'static str, F);

/// A function of the C.
struct Peer {
    robot: &'static str,
    algorithm: &'static str,
    build: &'static str,
    run: C,
}

// `static PEERS: [Peer; …]`, as xtask wrote it.
include!(env!("PEERS_TABLE"));

/// States that each function is asked for.
const STATES: usize = 8;
/// More than any output has entries.
const MOST: usize = 128;

#[entry]
fn main() -> ! {
    robot::<Ur5e, 6, 6>();
    robot::<Panda, 7, 7>();
    robot::<Iiwa14, 7, 7>();
    tree::<A1, 16, 12>();
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}

/// Everything of a robot.
fn robot<T: Robot<B, N, N>, const B: usize, const N: usize>() {
    let asks = &asks::<T, B, N>();
    inverse::<T, B, N>(asks);
    crba::<T, B, N>(
        asks,
        &[("core", Core::<T>::crba), ("engine", Engine::<T>::crba)],
    );
    forward::<T, B, N>(
        asks,
        &[
            ("core", Core::<T>::aba),
            ("engine", Engine::<T>::forward_dynamics),
        ],
    );
}

/// The same of a robot of which only inverse dynamics is specialised here.
fn tree<T: Robot<B, N, N>, const B: usize, const N: usize>() {
    let asks = &asks::<T, B, N>();
    inverse::<T, B, N>(asks);
    crba::<T, B, N>(asks, &[("core", Core::<T>::crba)]);
    forward::<T, B, N>(asks, &[("core", Core::<T>::aba)]);
}

fn inverse<T: Robot<B, N, N>, const B: usize, const N: usize>(asks: &Asks<N>) {
    under::<T, _, B, N>(asks, "rnea", &RIGID_BODY);
    under::<T, _, B, N>(asks, "bias", &(Gravity::EARTH, Coriolis));
    under::<T, _, B, N>(asks, "gravity", &(Gravity::EARTH,));
}

fn crba<T: Robot<B, N, N>, const B: usize, const N: usize>(
    asks: &Asks<N>,
    forms: &[Form<Matrix<N>>],
) {
    let run = |run: Matrix<N>, trig: &_, _: &_| run(trig, &RIGID_BODY);
    let triangle = |m: MassMatrix<f32, N>, out: &mut [f32; MOST]| {
        let entries = (0..N).flat_map(|i| (i..N).map(move |j| (i, j)));
        for (out, (i, j)) in core::iter::zip(out, entries) {
            *out = m.get(i, j);
        }
        N * (N + 1) / 2
    };
    compare::<T, _, _, B, N>(asks, "crba", forms, |run| run as usize, run, triangle);
}

/// Forward dynamics; the torque stands in the place of q̈.
fn forward<'a, T: Robot<B, N, N>, const B: usize, const N: usize>(
    asks: &'a Asks<N>,
    forms: &[Form<Forward<'a, N>>],
) {
    let run = |run: Forward<'a, N>, trig: &'a JointTrig<f32, N>, state: &'a State<f32, N, N>| {
        run(trig.with(state), &state.qdd, &RIGID_BODY)
    };
    let flat = |qdd: Solution<N>, out: &mut _| write(&qdd.unwrap_or([f32::NAN; N]), out);
    compare::<T, _, _, B, N>(asks, "aba", forms, |run| run as usize, run, flat);
}

/// Inverse dynamics under `effects`.
fn under<'a, T: Robot<B, N, N>, E: Effect<f32, B, N>, const B: usize, const N: usize>(
    asks: &'a Asks<N>,
    algorithm: &'static str,
    effects: &E,
) {
    let forms: [Form<Inverse<'a, E, N>>; 2] =
        [("core", Core::<T>::rnea), ("engine", Engine::<T>::rnea)];
    let run = |run: Inverse<'a, E, N>, trig: &'a JointTrig<f32, N>, state: &'a State<f32, N, N>| {
        run(trig.with(state), effects)
    };
    compare::<T, _, _, B, N>(
        asks,
        algorithm,
        &forms,
        |run| run as usize,
        run,
        |tau, out| write(&tau, out),
    );
}

/// Numbers for a state, as far as there are any.
#[derive(Clone, Copy)]
struct Numbers([f32; MOST], usize);

impl Numbers {
    fn all(&self) -> &[f32] {
        self.0.get(..self.1).unwrap_or_default()
    }
}

fn write(numbers: &[f32], out: &mut [f32; MOST]) -> usize {
    for (out, number) in core::iter::zip(out, numbers) {
        *out = *number;
    }
    numbers.len()
}

/// An algorithm: ours in their forms, the first of which is what the others are held against, then each
/// build of the C.
fn compare<'a, T: Robot<B, N, N>, F: Copy, O, const B: usize, const N: usize>(
    asks: &'a Asks<N>,
    algorithm: &'static str,
    forms: &[Form<F>],
    address: impl Fn(F) -> usize,
    call: impl Fn(F, &'a JointTrig<f32, N>, &'a State<f32, N, N>) -> O,
    flat: impl Fn(O, &mut [f32; MOST]) -> usize,
) {
    let name = T::MODEL.name;
    let numbers = |found| {
        let mut out = [0.0; MOST];
        let count = flat(found, &mut out);
        Numbers(out, count)
    };
    let Some(&(_, textbook)) = forms.first() else {
        return;
    };
    let expected = asks
        .each_ref()
        .map(|(trig, state)| numbers(call(textbook, trig, state)));
    let scale = expected.iter().flat_map(Numbers::all);
    let scale = scale.fold(0.0, |scale, x| f32::max(scale, x.abs()));
    for &(form, run) in forms {
        let mut error = 0.0;
        for (asked, expected) in core::iter::zip(asks, &expected) {
            // Made opaque outside, as the peers' arguments are.
            let (trig, state) = black_box(asked);
            let found = numbers(black_box(measured::<0, _>(|| call(run, trig, state))));
            error = larger(error, worst(found.all(), expected.all()));
        }
        report(name, algorithm, form, address(run), error / scale);
    }
    for peer in PEERS
        .iter()
        .filter(|peer| (peer.robot, peer.algorithm) == (name, algorithm))
    {
        let mut error = 0.0;
        for ((_, state), expected) in core::iter::zip(asks, &expected) {
            let out = casadi(peer, state);
            error = larger(error, worst(&out, expected.all()));
        }
        report(
            name,
            algorithm,
            peer.build,
            peer.run as usize,
            error / scale,
        );
    }
}

/// What a function of the C says of a state.
fn casadi<const N: usize>(peer: &Peer, state: &State<f32, N, N>) -> [f32; MOST] {
    let cos = black_box(state.q.map(|q| JointCoordinate::revolute(q).cos));
    let sin = black_box(state.q.map(|q| JointCoordinate::revolute(q).sin));
    let (cos, sin, state) = (cos.as_ptr(), sin.as_ptr(), black_box(state));
    let (qd, qdd) = (state.qd.as_ptr(), state.qdd.as_ptr());
    let mut out = [0.0; MOST];
    let to = out.as_mut_ptr();
    // SAFETY: xtask's table names functions of this type, which read N numbers at most from
    // each input and write no more than N (N + 1) / 2.
    measured::<0, _>(|| unsafe { (peer.run)(cos, sin, qd, qdd, to) });
    black_box(out)
}

/// In the order of the meter's samples.
fn report(robot: &str, algorithm: &str, peer: &str, address: usize, error: f32) {
    // The lowest bit of a function's address says Thumb.
    let address = address & !1;
    defmt::println!(
        "peer {=str} {=str} {=usize} {=usize} {=f32} {=str}",
        robot,
        algorithm,
        STATES,
        address,
        error,
        peer
    );
}

/// NaN counts as wrong.
fn worst(found: &[f32], expected: &[f32]) -> f32 {
    core::iter::zip(found, expected).fold(0.0, |worst, (a, b)| larger(worst, (a - b).abs()))
}

/// States, each with its sines and cosines.
type Asks<const N: usize> = [(JointTrig<f32, N>, State<f32, N, N>); STATES];

/// Some states within the joints' usual ranges.
fn asks<T: Robot<B, N, N>, const B: usize, const N: usize>() -> Asks<N> {
    let mut seed = 1_u32;
    let mut number = |bound: f32| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 * (2.0 * bound / 16_777_216.0) - bound
    };
    [(); STATES].map(|()| {
        let state = State {
            q: [(); N].map(|()| number(3.0)),
            qd: [(); N].map(|()| number(3.0)),
            qdd: [(); N].map(|()| number(10.0)),
        };
        (Core::<T>::joint_trig(&state.q), state)
    })
}
