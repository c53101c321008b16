//! Our dynamics and the C that CasADi generates for the same robots, between the meter's markers,
//! with sines and cosines at hand. `cargo xtask peers` compiles the C and links it to this.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::{Robot, Turn};
use dynamics_core::robots::{A1, Iiwa14, Panda, Ur5e};
use dynamics_core::state::{Posture, State};
use dynamics_core::{Core, Engine, MassMatrix};
use firmware_demo::{marker::measured, target};

/// What CasADi's C takes: cosines, sines, and two vectors of which an algorithm may need none.
type C = unsafe extern "C" fn(*const f32, *const f32, *const f32, *const f32, *mut f32);
/// What ours take.
type Ours<E, const N: usize> = fn(&Posture<f32, N>, &State<f32, N, N>, &E) -> [f32; N];
type Forward<E, const N: usize> =
    fn(&Posture<f32, N>, &State<f32, N, N>, &[f32; N], &E) -> Result<[f32; N], NotPositiveDefinite>;

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
    robot::<A1, 16, 12>();
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}

fn robot<T: Robot<B, N, N>, const B: usize, const N: usize>() {
    let states = states::<N>();
    inputs::<T, _, B, N>("rnea", &states, &RIGID_BODY);
    inputs::<T, _, B, N>("bias", &states, &(Gravity::EARTH, Coriolis));
    inputs::<T, _, B, N>("gravity", &states, &(Gravity::EARTH,));
    matrix::<T, B, N>(&states);
    forward::<T, B, N>(&states);
}

/// M(q): the engine's against the core's inverse dynamics of one acceleration at a time.
fn matrix<T: Robot<B, N, N>, const B: usize, const N: usize>(states: &[State<f32, N, N>; STATES]) {
    let run: fn(&Posture<f32, N>, &_) -> MassMatrix<f32, N> = Engine::<T>::crba_at;
    let (mut error, mut scale) = (0.0, 0.0);
    for state in states {
        let posture = black_box(Core::<T>::posture(&state.q));
        let m = black_box(measured::<0, _>(|| run(&posture, &RIGID_BODY)));
        for joint in 0..N {
            let mut unit = State::at(state.q);
            unit.qdd[joint] = 1.0;
            let column = Core::<T>::rnea(&unit, &(Inertia,));
            scale = column.iter().fold(scale, |s, x| f32::max(s, x.abs()));
            if let Some(row) = m.row(joint) {
                error = f32::max(error, worst(row, &column));
            }
        }
    }
    let name = T::MODEL.name;
    report(name, "crba", "engine", run as usize, error / scale);
    for peer in peers(name, "crba") {
        casadi(peer, states, |_| [], 0.0);
    }
}

/// Forward dynamics: the engine's `forward` beside the articulated-body algorithm of others.
fn forward<T: Robot<B, N, N>, const B: usize, const N: usize>(states: &[State<f32, N, N>; STATES]) {
    let run: Forward<_, N> = Engine::<T>::forward_at;
    let (mut error, mut scale) = (0.0, 0.0);
    for state in states {
        let posture = black_box(Core::<T>::posture(&state.q));
        let qdd = measured::<0, _>(|| run(&posture, black_box(state), &state.qdd, &RIGID_BODY));
        let textbook = Core::<T>::aba(state, &state.qdd, &RIGID_BODY);
        let (qdd, textbook) = (black_box(qdd).ok(), textbook.ok());
        let (Some(qdd), Some(textbook)) = (qdd, textbook) else {
            error = f32::INFINITY;
            continue;
        };
        scale = textbook.iter().fold(scale, |s, x| f32::max(s, x.abs()));
        error = f32::max(error, worst(&qdd, &textbook));
    }
    let name = T::MODEL.name;
    report(name, "aba", "engine", run as usize, error / scale);
    for peer in peers(name, "aba") {
        casadi(peer, states, |_| [], 0.0);
    }
}

/// The C for a robot and an algorithm.
fn peers(robot: &str, algorithm: &str) -> impl Iterator<Item = &'static Peer> {
    PEERS
        .iter()
        .filter(move |peer| (peer.robot, peer.algorithm) == (robot, algorithm))
}

/// Inverse dynamics under `effects`: ours in both forms, then each build of the C.
fn inputs<T: Robot<B, N, N>, E: Effect<f32, B, N>, const B: usize, const N: usize>(
    algorithm: &str,
    states: &[State<f32, N, N>; STATES],
    effects: &E,
) {
    let name = T::MODEL.name;
    let textbook = |state: &_| Core::<T>::rnea(state, effects);
    let scale = states
        .iter()
        .flat_map(textbook)
        .fold(0.0, |scale, x| f32::max(scale, x.abs()));
    let forms: [(&str, Ours<E, N>); 2] = [
        ("core", Core::<T>::rnea_at),
        ("engine", Engine::<T>::rnea_at),
    ];
    for (form, run) in forms {
        let mut error = 0.0;
        for state in states {
            let posture = black_box(Core::<T>::posture(&state.q));
            // Made opaque outside, as the peers' arguments are.
            let asked = black_box(state);
            let tau = measured::<0, _>(|| run(&posture, asked, effects));
            error = f32::max(error, worst(&black_box(tau), &textbook(state)));
        }
        report(name, algorithm, form, run as usize, error / scale);
    }
    for peer in peers(name, algorithm) {
        casadi(peer, states, textbook, scale);
    }
}

/// A function of the C, with its error relative to the full `scale`; one without an answer to
/// compare with has none.
fn casadi<const N: usize, const M: usize>(
    peer: &Peer,
    states: &[State<f32, N, N>; STATES],
    expected: impl Fn(&State<f32, N, N>) -> [f32; M],
    scale: f32,
) {
    let mut error = 0.0;
    for state in states {
        let cos = black_box(state.q.map(|q| Turn::new(q).cos));
        let sin = black_box(state.q.map(|q| Turn::new(q).sin));
        let (cos, sin, state) = (cos.as_ptr(), sin.as_ptr(), black_box(state));
        let (qd, qdd) = (state.qd.as_ptr(), state.qdd.as_ptr());
        let mut out = [0.0; MOST];
        let to = out.as_mut_ptr();
        // SAFETY: xtask's table names functions of this type, which read N numbers at most from
        // each input and write no more than N (N + 1) / 2.
        measured::<0, _>(|| unsafe { (peer.run)(cos, sin, qd, qdd, to) });
        error = f32::max(error, worst(black_box(&out), &expected(state)));
    }
    let relative = if scale > 0.0 { error / scale } else { 0.0 };
    report(
        peer.robot,
        peer.algorithm,
        peer.build,
        peer.run as usize,
        relative,
    );
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
    core::iter::zip(found, expected).fold(0.0, |worst, (a, b)| {
        let error = (a - b).abs();
        if error <= worst { worst } else { error }
    })
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
