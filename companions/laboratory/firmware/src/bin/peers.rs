//! Our dynamics and the C that CasADi generates for the same robots, between the meter's markers,
//! with precomputed sines and cosines. the command `peers` compiles the C and links it to this.
#![no_std]
#![no_main]
#![allow(
    dead_code,
    unused_imports,
    reason = "xtask links some algorithms of some robots at a time"
)]

#[path = "../../../../../lab/firmware/src/bin/costs/row.rs"]
mod row;

use core::cell::UnsafeCell;
use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use dynamics_core::algorithms::frame::Local;
use dynamics_core::algorithms::{NotPositiveDefinite, OsimInverse};
use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::{JointCoordinate, OnBody, Robot};
use dynamics_core::robots::*;
use dynamics_core::scalar::Vector;
use dynamics_core::spatial::Force;
use dynamics_core::state::{JointTrig, State, StateWithTrig};
use dynamics_core::{Core, Engine, TreeMatrix};
use firmware_demo::scene::larger;
use firmware_demo::target;
use heapless::Vec;

use row::{Row, numbers};

/// A function of CasADi's C: its arguments are cosines, sines, and two vectors that an algorithm
/// may not need.
type C = unsafe extern "C" fn(*const f32, *const f32, *const f32, *const f32, *mut f32);
type Scene = (Gravity, Inertia, Coriolis);
type Inverse<'a, E, const Q: usize, const V: usize> =
    fn(StateWithTrig<'a, f32, Q, V>, &E) -> [f32; V];
type Forward<'a, const Q: usize, const V: usize> =
    fn(StateWithTrig<'a, f32, Q, V>, &[f32; V], &Scene) -> Result<[f32; V], NotPositiveDefinite>;
type Tip<const Q: usize, const BODY: usize> = fn(
    &JointTrig<f32, Q>,
    OnBody<BODY>,
    Local,
    &Scene,
) -> Result<OsimInverse<f32>, NotPositiveDefinite>;

/// C by a compiler.
struct Peer {
    build: &'static str,
    run: C,
}

// `PEERS`, the builds of the functions that `run` calls ours of, as xtask wrote them.
include!(env!("PEERS_TABLE"));

/// Number of states on which each function is called.
const STATES: usize = 8;
/// More than any output has entries.
const MOST: usize = 640;

/// The input of a measured function.
struct Ask<const Q: usize, const V: usize> {
    state: State<f32, Q, V>,
    trig: JointTrig<f32, Q>,
    /// Cosines and sines; the coordinates of a free base stand among the cosines as they are.
    cos: [f32; Q],
    sin: [f32; Q],
}

#[entry]
fn main() -> ! {
    run();
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}

/// Some states within the joints' usual ranges, from a fixed seed.
fn asks<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>() -> [Ask<Q, V>; STATES]
{
    let mut number = numbers();
    [(); STATES].map(|()| {
        let state = State {
            q: [(); Q].map(|()| number(3.0)),
            qd: [(); V].map(|()| number(3.0)),
            qdd: [(); V].map(|()| number(10.0)),
        };
        let trig = Core::<T>::joint_trig(&state.q);
        // Sine and cosine of an angle are not both zero.
        let is_angle = |at: &JointCoordinate<f32>| at.sin != 0.0 || at.cos != 0.0;
        let cos = trig.coordinates.map(|at| if is_angle(&at) { at.cos } else { at.q });
        let sin = trig.coordinates.map(|at| at.sin);
        Ask { state, trig, cos, sin }
    })
}

fn rnea<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>(peers: &[Peer]) {
    under::<T, _, B, Q, V>("rnea", &RIGID_BODY, peers);
}

fn bias<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>(peers: &[Peer]) {
    under::<T, _, B, Q, V>("bias", &(Gravity::EARTH, Coriolis), peers);
}

fn gravity<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>(peers: &[Peer]) {
    under::<T, _, B, Q, V>("gravity", &(Gravity::EARTH,), peers);
}

/// Inverse dynamics under `effects`.
fn under<T, E, const B: usize, const Q: usize, const V: usize>(
    algorithm: &'static str,
    effects: &E,
    peers: &[Peer],
) where
    T: Robot<B, Q, V>,
    E: Effect<f32, B, V>,
{
    let asks = &asks::<T, B, Q, V>();
    let forms: [Inverse<'_, E, Q, V>; 2] = [Core::<T>::rnea, Engine::<T>::rnea];
    compare(
        (Of::robot::<T, B, Q, V>(algorithm), asks, peers),
        forms.map(|run| (run, run as usize)),
        |run, ask| run(ask.trig.with(&ask.state), effects),
        |tau| tau.into_iter().collect(),
    );
}

fn crba<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>(peers: &[Peer]) {
    let asks = &asks::<T, B, Q, V>();
    let core: fn(&JointTrig<f32, Q>, &Scene) -> _ = Core::<T>::crba;
    let engine: fn(&JointTrig<f32, Q>, &Scene, &mut _) = Engine::<T>::tree_crba;
    // As in a loop, whose matrix has its zeros from the start.
    let entries = UnsafeCell::new(TreeMatrix::<T, f32, V>::ZERO);
    let triangle = |get: &dyn Fn(usize, usize) -> f32| {
        (0..V).flat_map(|i| (i..V).map(move |j| (i, j))).map(|(i, j)| get(i, j)).collect()
    };
    compare_forms(
        (Of::robot::<T, B, Q, V>("crba"), asks, peers),
        (core as usize, |ask| core(&ask.trig, &RIGID_BODY), |m| triangle(&|i, j| m.get(i, j))),
        (
            engine as usize,
            // SAFETY: no other reference exists while the function runs.
            |ask| engine(&ask.trig, &RIGID_BODY, unsafe { &mut *entries.get() }),
            |()| {
                // SAFETY: the function has returned.
                let m = unsafe { &*entries.get() }.square();
                triangle(&|i, j| m.get(i, j))
            },
        ),
    );
}

/// Forward dynamics; the torque stands in the place of q̈.
fn aba<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>(peers: &[Peer]) {
    let asks = &asks::<T, B, Q, V>();
    let forms: [Forward<'_, Q, V>; 2] = [Core::<T>::aba, Engine::<T>::forward_dynamics];
    compare(
        (Of::robot::<T, B, Q, V>("aba"), asks, peers),
        forms.map(|run| (run, run as usize)),
        |run, ask| run(ask.trig.with(&ask.state), &ask.state.qdd, &RIGID_BODY),
        |qdd| qdd.unwrap_or([f32::NAN; V]).into_iter().collect(),
    );
}

/// Λ⁻¹ of a body in its own frame.
fn osim<T, const B: usize, const Q: usize, const V: usize, const BODY: usize>(peers: &[Peer])
where
    T: Robot<B, Q, V>,
{
    let asks = &asks::<T, B, Q, V>();
    let forms: [Tip<Q, BODY>; 2] = [Core::<T>::osim_inverse, Engine::<T>::osim_inverse];
    let unit = |k: usize| {
        let e = |j| if j == k { 1.0 } else { 0.0 };
        Force::<f32>::new(Vector::new(e(0), e(1), e(2)), Vector::new(e(3), e(4), e(5)))
    };
    compare(
        (Of::robot::<T, B, Q, V>("osim"), asks, peers),
        forms.map(|run| (run, run as usize)),
        |run, ask| run(&ask.trig, OnBody::<BODY>, Local, &RIGID_BODY),
        |mobility| {
            let Ok(mobility) = mobility else {
                return Vec::new();
            };
            let column = |i| {
                let a = mobility * unit(i);
                [a.ang.array(), a.lin.array()].into_iter().flatten().skip(i)
            };
            (0..6).flat_map(column).collect()
        },
    );
}

/// A function that is compared.
#[derive(Clone, Copy)]
struct Of {
    robot: &'static str,
    algorithm: &'static str,
    joints: usize,
}

impl Of {
    fn robot<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>(
        algorithm: &'static str,
    ) -> Self {
        Self { robot: T::MODEL.name, algorithm, joints: V }
    }
}

/// An algorithm of which both of our forms have the same type.
fn compare<'a, F: Copy, O, const Q: usize, const V: usize>(
    task: (Of, &'a [Ask<Q, V>; STATES], &[Peer]),
    [core, engine]: [(F, usize); 2],
    call: impl Fn(F, &'a Ask<Q, V>) -> O,
    flat: impl Fn(O) -> Vec<f32, MOST>,
) {
    compare_forms(
        task,
        (core.1, |ask| call(core.0, ask), &flat),
        (engine.1, |ask| call(engine.0, ask), &flat),
    );
}

/// An algorithm: ours by the core, which is the reference, and by the engine, each with its
/// address and its numbers, then each build of the C. The last entry of each row is the largest error, relative to
/// full scale.
fn compare_forms<'a, O, P, const Q: usize, const V: usize>(
    (of, asks, peers): (Of, &'a [Ask<Q, V>; STATES], &[Peer]),
    core: (usize, impl Fn(&'a Ask<Q, V>) -> O, impl Fn(O) -> Vec<f32, MOST>),
    engine: (usize, impl Fn(&'a Ask<Q, V>) -> P, impl Fn(P) -> Vec<f32, MOST>),
) {
    // Another firmware has the C of this function.
    if peers.is_empty() {
        return;
    }
    let expected = |ask| core.2(core.1(ask));
    let size = |numbers: Vec<f32, MOST>| numbers.iter().fold(0.0, |size, x| larger(size, x.abs()));
    let scale = asks.iter().fold(0.0, |scale, ask| larger(scale, size(expected(ask))));
    let report = |found: &mut dyn FnMut(&'a Ask<Q, V>) -> Vec<f32, MOST>| {
        let off = asks.iter().fold(0.0, |off, ask| {
            let (found, expected) = (found(ask), expected(ask));
            // NaN counts as wrong, and so does a number that is missing.
            let missing =
                if expected.is_empty() || found.len() < expected.len() { f32::NAN } else { 0.0 };
            let pairs = core::iter::zip(&found, &expected);
            pairs.fold(larger(off, missing), |off, (a, b)| larger(off, (a - b).abs()))
        });
        defmt::println!("error {=f32}", off / scale);
    };
    let row = |form| Row {
        robot: of.robot,
        algorithm: of.algorithm,
        form,
        inputs: "full",
        trig: false,
        joints: of.joints,
    };
    row("core").measure(core.0, asks, &core.1);
    report(&mut |ask| core.2(core.1(ask)));
    row("engine").measure(engine.0, asks, &engine.1);
    report(&mut |ask| engine.2(engine.1(ask)));
    for &Peer { build, run } in peers {
        let call = |ask: &Ask<Q, V>, out: &mut [f32; MOST]| {
            let (qd, qdd) = (ask.state.qd.as_ptr(), ask.state.qdd.as_ptr());
            // SAFETY: xtask's table names functions of this type, which read Q or V numbers at most
            // from each input and write no more than V (V + 1) / 2 or 21.
            unsafe { run(ask.cos.as_ptr(), ask.sin.as_ptr(), qd, qdd, out.as_mut_ptr()) }
        };
        let mut out = [0.0; MOST];
        row(build).measure(run as usize, asks, |ask| call(ask, &mut out));
        report(&mut |ask| {
            call(ask, &mut out);
            Vec::from_array(black_box(out))
        });
    }
}
