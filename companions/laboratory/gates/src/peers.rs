//! C that CasADi generates, on the states of `gates` and counted as its algorithms are, with sines
//! computed outside. The command `peers` compiles the C and links it to this.
//!
//! Behind the row of a function is `error ERROR`, its largest difference from the engine's numbers as
//! a share of the largest of these.
#![no_std]
#![no_main]

mod counters;
#[expect(dead_code, reason = "the rows of this library are those of the image without C")]
mod rows;
#[path = "../../cores/src/start.rs"]
mod start;

use core::hint::black_box;

use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::Robot;
use dynamics_core::robots::*;
use dynamics_core::state::State;
use dynamics_core::{Engine, TreeMatrix};
use firmware_demo::digest::Digest;
use firmware_demo::scene::larger;
use semihosting::println;

use rows::Ask;

/// A function of CasADi's C: its arguments are cosines, sines, and two vectors that an algorithm
/// may not need.
type C = unsafe extern "C" fn(*const f32, *const f32, *const f32, *const f32, *mut f32);

/// C by a compiler.
struct Peer {
    build: &'static str,
    run: C,
}

// The builds of the functions that `run` calls ours of, as xtask wrote them.
include!(env!("PEERS_TABLE"));

/// The numbers of a function, with zeros behind them: M of the A1 has the most.
type Numbers = [f32; 12 * 13 / 2];

/// The work of `main`.
fn work() {
    counters::calibrate();
    run();
    println!("done");
}

fn rnea<T: Robot<B, N, N>, const B: usize, const N: usize, const V: usize>(peers: &[Peer]) {
    compare::<T, B, N>("rnea", peers, |Ask { state, trig }, tau| {
        tau[..N].copy_from_slice(&Engine::<T>::rnea(trig.with(state), &RIGID_BODY));
    });
}

fn crba<T: Robot<B, N, N>, const B: usize, const N: usize, const V: usize>(peers: &[Peer]) {
    compare::<T, B, N>("crba", peers, |ask, triangle| {
        let mut m = TreeMatrix::<T, f32, N>::ZERO;
        Engine::<T>::tree_crba(&ask.trig, &RIGID_BODY, &mut m);
        let m = m.square();
        let entries = (0..N).flat_map(|i| (i..N).map(move |j| (i, j)));
        for (entry, (i, j)) in triangle.iter_mut().zip(entries) {
            *entry = m.get(i, j);
        }
    });
}

/// Forward dynamics; the torque stands in the place of q̈.
fn aba<T: Robot<B, N, N>, const B: usize, const N: usize, const V: usize>(peers: &[Peer]) {
    compare::<T, B, N>("aba", peers, |Ask { state, trig }, out| {
        let qdd = Engine::<T>::forward_dynamics(trig.with(state), &state.qdd, &RIGID_BODY);
        out[..N].copy_from_slice(&qdd.unwrap_or([f32::NAN; N]));
    });
}

fn compare<T: Robot<B, N, N>, const B: usize, const N: usize>(
    algorithm: &str,
    peers: &[Peer],
    engine: fn(&Ask<N>, &mut Numbers),
) {
    let asks = &rows::asks::<T, B, N>();
    for &Peer { build, run } in peers {
        let (mut error, mut scale, mut digest) = (0.0, 0.0, Digest::EMPTY);
        let (mut cycles, mut instructions) = (0, 0);
        for ask in &asks[..rows::COUNTED] {
            let cos = ask.trig.coordinates.map(|at| at.cos);
            let sin = ask.trig.coordinates.map(|at| at.sin);
            let State { qd, qdd, .. } = &ask.state;
            let [mut found, mut expected]: [Numbers; 2] = [[0.0; _]; 2];
            let (run, out) = (black_box(run), found.as_mut_ptr());
            let begin = counters::read();
            // SAFETY: xtask's table names functions of this type, which read N numbers at most from
            // each input and write no more than N (N + 1) / 2.
            unsafe { run(cos.as_ptr(), sin.as_ptr(), qd.as_ptr(), qdd.as_ptr(), out) };
            let count = counters::between(begin, counters::read());
            cycles = count.cycles.max(cycles);
            instructions = count.instructions.max(instructions);
            engine(ask, &mut expected);
            digest.add(found);
            for (found, expected) in found.iter().zip(expected) {
                // NaN counts as wrong.
                error = larger(error, (found - expected).abs());
                scale = larger(scale, expected.abs());
            }
        }
        let (robot, digest) = (T::MODEL.name, digest.0);
        println!("row {robot} {algorithm} {build} outside {cycles} {instructions} {digest:016x}");
        println!("error {:e}", error / scale);
    }
}
