//! What each algorithm costs on a robot, form by form, effect by effect, between the meter's markers.
//! `cargo xtask costs` reads the log and cuts the meter's samples by it. One bin a robot, since each
//! specialised function takes the compiler seconds, and bins are built side by side.
//!
//! ```text
//! config ROBOT ALGORITHM FORM INPUTS TRIG JOINTS STATES ADDRESS STACK
//! done
//! ```
//!
//! TRIG is 1 if sines and cosines are computed inside; ADDRESS is the function's, and STACK the bytes
//! that it and all that it calls were seen to use.
use core::arch::asm;
use core::hint::black_box;

use cortex_m_semihosting::debug;
use dynamics_core::algorithms::{self, NotPositiveDefinite};
use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::{Robot, model};
use dynamics_core::state::{Posture, State};
use dynamics_core::{Core, Engine, MassMatrix};
use firmware_demo::{marker::measured, target};

/// States that each function is asked for.
const STATES: usize = 32;

/// Words painted below the stack pointer: more than any of these functions takes.
const DEPTH: usize = 4096;
const PAINT: u32 = 0x5eed_a51c;

/// A row of the table, as the log names it.
#[derive(Clone, Copy)]
struct Row {
    robot: &'static str,
    algorithm: &'static str,
    form: &'static str,
    inputs: &'static str,
    trig: bool,
    /// Of the function. Taking it also keeps the compiler from shaping the function to its calls.
    address: usize,
}

/// What a function may be asked for.
struct Ask<const N: usize> {
    state: State<f32, N, N>,
    posture: Posture<f32, N>,
}

type Inside<E, const N: usize> = fn(&State<f32, N, N>, &E) -> [f32; N];
type AtHand<E, const N: usize> = fn(&Posture<f32, N>, &State<f32, N, N>, &E) -> [f32; N];
/// Of forward dynamics; the torques are the state's accelerations: any will do, since the work does
/// not depend on what they move.
type Forward<const N: usize> = fn(&Ask<N>) -> Result<[f32; N], NotPositiveDefinite>;

/// Of M's factors and their solution.
type FactorSolve<const N: usize> =
    fn(&MassMatrix<f32, N>, &[f32; N]) -> Result<[f32; N], NotPositiveDefinite>;

/// From so many joints on the engine's articulated bodies take the compiler minutes.
const ABA_IS_DEAR: usize = 8;

/// Measures every row of the robot T and leaves the emulator.
pub fn run<T: Robot<B, N, N>, const B: usize, const N: usize>() -> ! {
    let asks = asks::<T, B, N>();
    inverse::<T, _, B, N>("full", &asks, &RIGID_BODY);
    inverse::<T, _, B, N>("bias", &asks, &(Gravity::EARTH, Coriolis));
    inverse::<T, _, B, N>("gravity", &asks, &(Gravity::EARTH,));
    inverse::<T, _, B, N>("no_coriolis", &asks, &(Gravity::EARTH, Inertia));
    let forward: [(bool, Forward<N>); 2] = [(true, aba::<T, B, N>), (false, aba_at::<T, B, N>)];
    for (trig, run) in forward {
        let row = Row {
            form: "core",
            ..full::<T, B, N>("aba", trig, run as usize)
        };
        measure(row, &asks, run);
    }
    matrix::<T, B, N>(&asks);
    if N < ABA_IS_DEAR {
        articulated::<T, B, N>(&asks);
    }
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}

/// A row of the engine under `RIGID_BODY`.
fn full<T: Robot<B, N, N>, const B: usize, const N: usize>(
    algorithm: &'static str,
    trig: bool,
    address: usize,
) -> Row {
    Row {
        robot: T::MODEL.name,
        algorithm,
        form: "engine",
        inputs: "full",
        trig,
        address,
    }
}

/// The engine's M, its factors, forward dynamics by them, and the Jacobian. Sines and cosines
/// inside are `rnea`'s and `aba`'s rows: one more instance of each takes the compiler long.
fn matrix<T: Robot<B, N, N>, const B: usize, const N: usize>(asks: &[Ask<N>; STATES]) {
    let crba: fn(&Posture<f32, N>, &_) -> _ = Engine::<T>::crba_at;
    let row = |algorithm, address| full::<T, B, N>(algorithm, false, address);
    measure(row("crba", crba as usize), asks, |ask| {
        crba(&ask.posture, &RIGID_BODY)
    });
    let solve: FactorSolve<N> = factor_solve::<T, B, N>;
    let m = crba(&asks[0].posture, &RIGID_BODY);
    measure(row("factor_solve", solve as usize), asks, |ask| {
        solve(black_box(&m), &ask.state.qdd)
    });
    let forward: Forward<N> = forward_at::<T, B, N>;
    measure(row("forward", forward as usize), asks, forward);
    let jacobian: fn(&Posture<f32, N>) -> _ = Engine::<T>::jacobian_at;
    measure(row("jacobian", jacobian as usize), asks, |ask| {
        jacobian(&ask.posture)
    });
}

/// Inverse dynamics in both forms, with sines and cosines inside and at hand.
fn inverse<T: Robot<B, N, N>, E: Effect<f32, B, N>, const B: usize, const N: usize>(
    inputs: &'static str,
    asks: &[Ask<N>; STATES],
    effects: &E,
) {
    let forms: [(&str, Inside<E, N>, AtHand<E, N>); 2] = [
        ("core", Core::<T>::rnea, Core::<T>::rnea_at),
        ("engine", Engine::<T>::rnea, Engine::<T>::rnea_at),
    ];
    for (form, inside, at_hand) in forms {
        let row = Row {
            robot: T::MODEL.name,
            algorithm: "rnea",
            form,
            inputs,
            trig: true,
            address: inside as usize,
        };
        measure(row, asks, |ask| inside(&ask.state, effects));
        let row = Row {
            trig: false,
            address: at_hand as usize,
            ..row
        };
        measure(row, asks, |ask| at_hand(&ask.posture, &ask.state, effects));
    }
}

#[inline(never)]
fn aba<T: Robot<B, N, N>, const B: usize, const N: usize>(
    ask: &Ask<N>,
) -> Result<[f32; N], NotPositiveDefinite> {
    algorithms::aba(
        model::<f32, T, B, N, N>(),
        &ask.state,
        &ask.state.qdd,
        &RIGID_BODY,
    )
}

#[inline(never)]
fn aba_at<T: Robot<B, N, N>, const B: usize, const N: usize>(
    ask: &Ask<N>,
) -> Result<[f32; N], NotPositiveDefinite> {
    algorithms::aba_at(
        model::<f32, T, B, N, N>(),
        &ask.posture,
        &ask.state,
        &ask.state.qdd,
        &RIGID_BODY,
    )
}

/// The engine's articulated bodies, with sines and cosines at hand.
fn articulated<T: Robot<B, N, N>, const B: usize, const N: usize>(asks: &[Ask<N>; STATES]) {
    let run: Forward<N> = articulated_at::<T, B, N>;
    measure(full::<T, B, N>("aba", false, run as usize), asks, run);
}

#[inline(never)]
fn forward_at<T: Robot<B, N, N>, const B: usize, const N: usize>(
    ask: &Ask<N>,
) -> Result<[f32; N], NotPositiveDefinite> {
    Engine::<T>::forward_at(&ask.posture, &ask.state, &ask.state.qdd, &RIGID_BODY)
}

#[inline(never)]
fn articulated_at<T: Robot<B, N, N>, const B: usize, const N: usize>(
    ask: &Ask<N>,
) -> Result<[f32; N], NotPositiveDefinite> {
    Engine::<T>::aba_at(&ask.posture, &ask.state, &ask.state.qdd, &RIGID_BODY)
}

#[inline(never)]
fn factor_solve<T: Robot<B, N, N>, const B: usize, const N: usize>(
    m: &MassMatrix<f32, N>,
    tau: &[f32; N],
) -> Result<[f32; N], NotPositiveDefinite> {
    Ok(Engine::<T>::solve(&Engine::<T>::factor(m)?, tau))
}

/// Logs a row, then runs its function once for each state in region 0.
#[inline(always)]
fn measure<T, const N: usize>(row: Row, asks: &[Ask<N>; STATES], run: impl Fn(&Ask<N>) -> T) {
    let stack = asks
        .iter()
        .map(|ask| stack_of(|| run(black_box(ask))))
        .max();
    defmt::println!(
        "config {=str} {=str} {=str} {=str} {=u8} {=usize} {=usize} {=usize} {=usize}",
        row.robot,
        row.algorithm,
        row.form,
        row.inputs,
        u8::from(row.trig),
        N,
        STATES,
        // The lowest bit of a function's address says Thumb.
        row.address & !1,
        stack.unwrap_or_default()
    );
    for ask in asks {
        let ask = black_box(ask);
        black_box(measured::<0, _>(|| run(ask)));
    }
}

/// Bytes of stack that a call writes to.
#[inline(always)]
fn stack_of<T>(run: impl FnOnce() -> T) -> usize {
    let sp: *mut u32;
    // SAFETY: reads a register.
    unsafe { asm!("mov {}, sp", out(reg) sp, options(nomem, nostack, preserves_flags)) };
    for word in 1..=DEPTH {
        // SAFETY: RAM below the stack pointer, aligned, which nobody uses: no interrupt is enabled.
        unsafe { sp.sub(word).write_volatile(PAINT) };
    }
    black_box(run());
    // SAFETY: the same words.
    let painted = |word: &usize| unsafe { sp.sub(*word).read_volatile() } == PAINT;
    let untouched = (1..=DEPTH).rev().take_while(painted).count();
    (DEPTH - untouched) * size_of::<u32>()
}

/// Some states within the joints' usual ranges, from a fixed seed.
fn asks<T: Robot<B, N, N>, const B: usize, const N: usize>() -> [Ask<N>; STATES] {
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
        let posture = Core::<T>::posture(&state.q);
        Ask { state, posture }
    })
}
