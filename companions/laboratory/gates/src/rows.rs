//! The algorithms of a robot: inverse dynamics with derivatives, gravity, M and forward dynamics.

use core::hint::black_box;

use dynamics_core::effects::{Gravity, RIGID_BODY};
use dynamics_core::model::Robot;
use dynamics_core::state::{JointTrig, State};
use dynamics_core::{Core, Engine, MassMatrix, TreeMatrix};
use firmware_demo::digest::Digest;

#[cfg(target_os = "none")]
use semihosting::println;

use crate::counters;

/// The states on which each function is counted, and those whose torques are printed.
pub const COUNTED: usize = 4;
const STATES: usize = 16;

pub struct Ask<const N: usize> {
    pub state: State<f32, N, N>,
    pub trig: JointTrig<f32, N>,
}

/// Some states within ranges of a power of two, from a fixed seed: these numbers are exact, and
/// fused arithmetic does not change them.
pub fn asks<T: Robot<B, N, N>, const B: usize, const N: usize>() -> [Ask<N>; STATES] {
    let mut seed = 1_u32;
    let mut number = |bound: f32| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        ((seed >> 8) as i32 - (1 << 23)) as f32 * (bound / 8_388_608.0)
    };
    [(); STATES].map(|()| {
        let state = State {
            q: [(); N].map(|()| number(4.0)),
            qd: [(); N].map(|()| number(4.0)),
            qdd: [(); N].map(|()| number(8.0)),
        };
        let trig = Core::<T>::joint_trig(&state.q);
        Ask { state, trig }
    })
}

/// Prints a function's row; the function is called through its address, as a user's would be that
/// is not inlined.
fn row<A, O>(
    [robot, algorithm, form, sines]: [&str; 4],
    asks: &mut [A],
    run: fn(&mut A) -> O,
    bits: impl Fn(&A, &O, &mut Digest),
) {
    let (mut digest, mut cycles, mut instructions) = (Digest::EMPTY, 0, 0);
    // Before the first call the core has not read the robot's constants; here that costs nothing,
    // since no memory has a cache.
    for ask in &mut asks[..COUNTED] {
        let begin = counters::read();
        // The function writes it here: a copy would be counted.
        let result = black_box(run)(black_box(&mut *ask));
        let count = counters::between(begin, counters::read());
        bits(ask, &result, &mut digest);
        (cycles, instructions) = (count.cycles.max(cycles), count.instructions.max(instructions));
    }
    println!("row {robot} {algorithm} {form} {sines} {cycles} {instructions} {:016x}", digest.0);
}

/// Prints the torques of all states, in hexadecimal, and on a host those of f64 too.
fn torques<T: Robot<B, N, N>, const B: usize, const N: usize>(
    form: &str,
    asks: &[Ask<N>],
    rnea: fn(&Ask<N>) -> [f32; N],
) {
    for (at, ask) in asks.iter().enumerate() {
        let tau = black_box(rnea)(black_box(ask));
        println!(
            "torques {} {form} {at} {}",
            T::MODEL.name,
            Bits(tau.map(|tau| tau.to_bits().into()))
        );
    }
}

/// The torques in f64, from which those of f32 differ.
#[cfg(not(target_os = "none"))]
fn exact<T: Robot<B, N, N>, const B: usize, const N: usize>(asks: &[Ask<N>]) {
    for (at, Ask { state: State { q, qd, qdd }, .. }) in asks.iter().enumerate() {
        let state = State { q: q.map(f64::from), qd: qd.map(f64::from), qdd: qdd.map(f64::from) };
        let tau = Core::<T>::rnea(&state, &RIGID_BODY);
        println!("exact {} {at} {}", T::MODEL.name, Bits(tau.map(f64::to_bits)));
    }
}

/// Numbers by their bits.
struct Bits<const N: usize>([u64; N]);

impl<const N: usize> core::fmt::Display for Bits<N> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let [first, others @ ..] = &self.0[..] else { return Ok(()) };
        write!(f, "{first:x}")?;
        others.iter().try_for_each(|bits| write!(f, ",{bits:x}"))
    }
}

/// All rows of a robot.
#[inline(never)]
pub fn of<T: Robot<B, N, N>, const B: usize, const N: usize>() {
    let asks = &mut asks::<T, B, N>();
    macro_rules! rows {
        ($form:literal: $Form:ident, $forward:ident) => {
            let name = |algorithm, sines| [T::MODEL.name, algorithm, $form, sines];
            let numbers = |_: &Ask<N>, tau: &[f32; N], digest: &mut Digest| digest.add(*tau);
            row(
                name("rnea", "outside"),
                asks,
                |ask| $Form::<T>::rnea(ask.trig.with(&ask.state), &RIGID_BODY),
                numbers,
            );
            row(
                name("rnea", "inside"),
                asks,
                |ask| $Form::<T>::rnea(&ask.state, &RIGID_BODY),
                numbers,
            );
            row(
                name("gravity", "outside"),
                asks,
                |ask| $Form::<T>::rnea(ask.trig.with(&ask.state), &(Gravity::EARTH,)),
                numbers,
            );
            row(
                name("forward_dynamics", "outside"),
                asks,
                |ask| $Form::<T>::$forward(ask.trig.with(&ask.state), &ask.state.qdd, &RIGID_BODY),
                |_, qdd, digest| digest.add(qdd.unwrap_or([f32::NAN; N])),
            );
            torques::<T, B, N>($form, asks, |ask| {
                $Form::<T>::rnea(ask.trig.with(&ask.state), &RIGID_BODY)
            });
        };
    }
    rows! { "core": Core, aba }
    rows! { "engine": Engine, forward_dynamics }
    let add = |m: &MassMatrix<f32, N>, digest: &mut Digest| {
        (0..N).filter_map(|i| m.row(i)).for_each(|row| digest.add(*row));
    };
    row(
        [T::MODEL.name, "crba", "core", "outside"],
        asks,
        |ask| Core::<T>::crba(&ask.trig, &RIGID_BODY),
        |_, m, digest| add(m, digest),
    );
    // The entries of the tree alone, as in a loop, whose matrix has its zeros from the start.
    let mut with_matrix = asks.each_ref().map(|ask| (&ask.trig, TreeMatrix::ZERO));
    row(
        [T::MODEL.name, "crba", "engine", "outside"],
        &mut with_matrix,
        |(trig, m)| Engine::<T>::tree_crba(*trig, &RIGID_BODY, m),
        |(_, m), (), digest| add(&m.square(), digest),
    );
    #[cfg(not(target_os = "none"))]
    exact::<T, B, N>(asks);
}

/// The row of the derivatives of inverse dynamics.
#[inline(never)]
pub fn derivatives<T: Robot<B, N, N>, const B: usize, const N: usize>() {
    row(
        [T::MODEL.name, "rnea_derivatives", "engine", "outside"],
        &mut asks::<T, B, N>(),
        |ask| Engine::<T>::rnea_derivatives(ask.trig.with(&ask.state), &RIGID_BODY),
        |_, by, digest| by.dq.iter().chain(&by.dqd).for_each(|row| digest.add(*row)),
    );
}
