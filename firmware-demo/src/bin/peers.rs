//! Our dynamics and the C that CasADi generates for the same robots, between the meter's markers,
//! with sines and cosines at hand. `cargo xtask peers` compiles the C and links it to this.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::{JointCoordinate, Robot};
use dynamics_core::robots::{A1, Iiwa14, Panda, Ur5e};
use dynamics_core::state::{JointTrig, State};
use dynamics_core::{Core, Engine, MassMatrix};
use firmware_demo::{marker::measured, scene::larger, target};

/// What CasADi's C takes: cosines, sines, and two vectors of which an algorithm may need none.
type C = unsafe extern "C" fn(*const f32, *const f32, *const f32, *const f32, *mut f32);
type Scene = (Gravity, Inertia, Coriolis);
/// What ours take.
type Inverse<E, const N: usize> = fn(&JointTrig<f32, N>, &State<f32, N, N>, &E) -> [f32; N];
type Matrix<const N: usize> = fn(&JointTrig<f32, N>, &Scene) -> MassMatrix<f32, N>;
type Forward<const N: usize> =
    fn(&JointTrig<f32, N>, &State<f32, N, N>, &[f32; N], &Scene) -> Solution<N>;
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
    inverse::<T, B, N>();
    crba::<T, B, N>(&[
        ("core", Core::<T>::crba_at),
        ("engine", Engine::<T>::crba_at),
    ]);
    forward::<T, B, N>(&[
        ("core", Core::<T>::aba_at),
        ("engine", Engine::<T>::forward_dynamics_at),
    ]);
}

/// The same of a robot of which only inverse dynamics is specialised here.
fn tree<T: Robot<B, N, N>, const B: usize, const N: usize>() {
    inverse::<T, B, N>();
    crba::<T, B, N>(&[("core", Core::<T>::crba_at)]);
    forward::<T, B, N>(&[("core", Core::<T>::aba_at)]);
}

fn inverse<T: Robot<B, N, N>, const B: usize, const N: usize>() {
    under::<T, _, B, N>("rnea", &RIGID_BODY);
    under::<T, _, B, N>("bias", &(Gravity::EARTH, Coriolis));
    under::<T, _, B, N>("gravity", &(Gravity::EARTH,));
}

fn crba<T: Robot<B, N, N>, const B: usize, const N: usize>(forms: &[Form<Matrix<N>>]) {
    let run = |run: Matrix<N>, posture: &_, _: &_| run(posture, &RIGID_BODY);
    let triangle = |m: MassMatrix<f32, N>, out: &mut [f32; MOST]| {
        let entries = (0..N).flat_map(|i| (i..N).map(move |j| (i, j)));
        for (out, (i, j)) in core::iter::zip(out, entries) {
            *out = m.get(i, j);
        }
        N * (N + 1) / 2
    };
    compare::<T, _, _, B, N>("crba", forms, |run| run as usize, run, triangle);
}

/// Forward dynamics; the torque stands in the place of q̈.
fn forward<T: Robot<B, N, N>, const B: usize, const N: usize>(forms: &[Form<Forward<N>>]) {
    let run = |run: Forward<N>, posture: &_, state: &State<f32, N, N>| {
        run(posture, state, &state.qdd, &RIGID_BODY)
    };
    let flat = |qdd: Solution<N>, out: &mut _| write(&qdd.unwrap_or([f32::NAN; N]), out);
    compare::<T, _, _, B, N>("aba", forms, |run| run as usize, run, flat);
}

/// Inverse dynamics under `effects`.
fn under<T: Robot<B, N, N>, E: Effect<f32, B, N>, const B: usize, const N: usize>(
    algorithm: &'static str,
    effects: &E,
) {
    let forms: [Form<Inverse<E, N>>; 2] = [
        ("core", Core::<T>::rnea_at),
        ("engine", Engine::<T>::rnea_at),
    ];
    let run = |run: Inverse<E, N>, posture: &_, state: &_| run(posture, state, effects);
    compare::<T, _, _, B, N>(
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
fn compare<T: Robot<B, N, N>, F: Copy, O, const B: usize, const N: usize>(
    algorithm: &'static str,
    forms: &[Form<F>],
    address: impl Fn(F) -> usize,
    call: impl Fn(F, &JointTrig<f32, N>, &State<f32, N, N>) -> O,
    flat: impl Fn(O, &mut [f32; MOST]) -> usize,
) {
    let name = T::MODEL.name;
    let states = states::<N>();
    let numbers = |found| {
        let mut out = [0.0; MOST];
        let count = flat(found, &mut out);
        Numbers(out, count)
    };
    let Some(&(_, textbook)) = forms.first() else {
        return;
    };
    let expected = states.each_ref().map(|state| {
        let posture = Core::<T>::posture(&state.q);
        numbers(call(textbook, &posture, state))
    });
    let scale = expected.iter().flat_map(Numbers::all);
    let scale = scale.fold(0.0, |scale, x| f32::max(scale, x.abs()));
    for &(form, run) in forms {
        let mut error = 0.0;
        for (state, expected) in core::iter::zip(&states, &expected) {
            let posture = black_box(Core::<T>::posture(&state.q));
            // Made opaque outside, as the peers' arguments are.
            let asked = black_box(state);
            let found = numbers(black_box(measured::<0, _>(|| call(run, &posture, asked))));
            error = larger(error, worst(found.all(), expected.all()));
        }
        report(name, algorithm, form, address(run), error / scale);
    }
    for peer in PEERS
        .iter()
        .filter(|peer| (peer.robot, peer.algorithm) == (name, algorithm))
    {
        let mut error = 0.0;
        for (state, expected) in core::iter::zip(&states, &expected) {
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

/// Some states within the joints' usual ranges.
fn states<const N: usize>() -> [State<f32, N, N>; STATES] {
    let mut seed = 1_u32;
    let mut number = |bound: f32| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 * (2.0 * bound / 16_777_216.0) - bound
    };
    [(); STATES].map(|()| State {
        q: [(); N].map(|()| number(3.0)),
        qd: [(); N].map(|()| number(3.0)),
        qdd: [(); N].map(|()| number(10.0)),
    })
}
