//! Our dynamics and the C that CasADi generates for the same robots, between the meter's markers,
//! with precomputed sines and cosines. `cargo xtask peers` compiles the C and links it to this.
#![no_std]
#![no_main]

mod costs;

use core::hint::black_box;

use cortex_m_rt::entry;
use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::{JointCoordinate, Robot};
use dynamics_core::robots::{A1, Iiwa14, Panda, Ur5e};
use dynamics_core::state::{JointTrig, State, StateWithTrig};
use dynamics_core::{Core, Engine, MassMatrix};
use firmware_demo::scene::larger;
use heapless::Vec;

use costs::row::Row;
use costs::{Ask, asks, done};

/// A function of CasADi's C: its arguments are cosines, sines, and two vectors that an algorithm may not need.
type C = unsafe extern "C" fn(*const f32, *const f32, *const f32, *const f32, *mut f32);
type Scene = (Gravity, Inertia, Coriolis);
type Inverse<'a, E, const N: usize> = fn(StateWithTrig<'a, f32, N, N>, &E) -> [f32; N];
type Matrix<const N: usize> = fn(&JointTrig<f32, N>, &Scene) -> MassMatrix<f32, N>;
type Forward<'a, const N: usize> =
    fn(StateWithTrig<'a, f32, N, N>, &[f32; N], &Scene) -> Solution<N>;
type Asks<const N: usize> = [Ask<N>; STATES];
type Solution<const N: usize> = Result<[f32; N], NotPositiveDefinite>;
type Form<F> = (&'static str, F);

struct Peer {
    robot: &'static str,
    algorithm: &'static str,
    build: &'static str,
    run: C,
}

// `static PEERS: [Peer; …]`, as xtask wrote it.
include!(env!("PEERS_TABLE"));

/// Number of states on which each function is called.
const STATES: usize = 8;
/// More than any output has entries.
const MOST: usize = 128;

#[entry]
fn main() -> ! {
    robot::<Ur5e, 6, 6>();
    robot::<Panda, 7, 7>();
    robot::<Iiwa14, 7, 7>();
    tree::<A1, 16, 12>();
    done()
}

fn robot<T: Robot<B, N, N>, const B: usize, const N: usize>() {
    let asks = &asks::<T, B, N, STATES>();
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
    let asks = &asks::<T, B, N, STATES>();
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
    let run = |run: Matrix<N>, ask: &Ask<N>| run(&ask.trig, &RIGID_BODY);
    let triangle = |m: MassMatrix<f32, N>| {
        let entries = (0..N).flat_map(|i| (i..N).map(move |j| (i, j)));
        entries.map(|(i, j)| m.get(i, j)).collect()
    };
    compare::<T, _, _, B, N>(asks, "crba", forms, |run| run as usize, run, triangle);
}

/// Forward dynamics; the torque stands in the place of q̈.
fn forward<'a, T: Robot<B, N, N>, const B: usize, const N: usize>(
    asks: &'a Asks<N>,
    forms: &[Form<Forward<'a, N>>],
) {
    let run = |run: Forward<'a, N>, ask: &'a Ask<N>| {
        run(ask.trig.with(&ask.state), &ask.state.qdd, &RIGID_BODY)
    };
    let flat = |qdd: Solution<N>| qdd.unwrap_or([f32::NAN; N]).into_iter().collect();
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
    let run = |run: Inverse<'a, E, N>, ask: &'a Ask<N>| run(ask.trig.with(&ask.state), effects);
    let flat = |tau: [f32; N]| tau.into_iter().collect();
    compare::<T, _, _, B, N>(asks, algorithm, &forms, |run| run as usize, run, flat);
}

/// An algorithm: ours in their forms, the first of which is the reference, then each build of the C. The last entry of
/// each row is the largest error, relative to full scale.
fn compare<'a, T: Robot<B, N, N>, F: Copy, O, const B: usize, const N: usize>(
    asks: &'a Asks<N>,
    algorithm: &'static str,
    forms: &[Form<F>],
    address: impl Fn(F) -> usize,
    call: impl Fn(F, &'a Ask<N>) -> O,
    flat: impl Fn(O) -> Vec<f32, MOST>,
) {
    let Some(&(_, textbook)) = forms.first() else {
        return;
    };
    let expected = asks.each_ref().map(|ask| flat(call(textbook, ask)));
    let size = |numbers: &[f32]| numbers.iter().fold(0.0, |size, x| larger(size, x.abs()));
    let scale = expected
        .iter()
        .fold(0.0, |scale, row| larger(scale, size(row)));
    let report = |found: [Vec<f32, MOST>; STATES]| {
        let rows = core::iter::zip(found, &expected);
        let off = rows.flat_map(|(found, expected)| {
            let pairs = core::iter::zip(found, expected);
            pairs.map(|(a, b)| (a - b).abs()).collect::<Vec<_, MOST>>()
        });
        // NaN counts as wrong.
        defmt::println!("error {=f32}", off.fold(0.0, larger) / scale);
    };
    let row = |form| Row::of::<T, B, N>(algorithm, form, "full", false);
    for &(form, run) in forms {
        row(form).measure(address(run), asks, |ask| call(run, ask));
        report(asks.each_ref().map(|ask| flat(call(run, ask))));
    }
    let is_mine = |peer: &&Peer| (peer.robot, peer.algorithm) == (T::MODEL.name, algorithm);
    let inputs = asks.each_ref().map(|ask| {
        let turns = ask.state.q.map(JointCoordinate::revolute);
        (
            turns.map(|turn| turn.cos),
            turns.map(|turn| turn.sin),
            &ask.state,
        )
    });
    for peer in PEERS.iter().filter(is_mine) {
        let call = |(cos, sin, state): &([f32; N], [f32; N], &State<f32, N, N>),
                    out: &mut [f32; MOST]| {
            let (qd, qdd) = (state.qd.as_ptr(), state.qdd.as_ptr());
            // SAFETY: xtask's table names functions of this type, which read N numbers at most from
            // each input and write no more than N (N + 1) / 2.
            unsafe { (peer.run)(cos.as_ptr(), sin.as_ptr(), qd, qdd, out.as_mut_ptr()) }
        };
        let mut out = [0.0; MOST];
        row(peer.build).measure(peer.run as usize, &inputs, |input| call(input, &mut out));
        report(inputs.each_ref().map(|input| {
            call(input, &mut out);
            Vec::from_array(black_box(out))
        }));
    }
}
