//! What each algorithm costs on a robot, form by form, effect by effect, between the meter's markers.
//! `cargo xtask costs` reads the log, rows and at last `done`, and cuts the meter's samples by it. One bin
//! a robot, since each specialised function takes the compiler seconds, and bins are built side by side.

mod forms;
mod row;

use cortex_m_semihosting::debug;
use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::Robot;
use dynamics_core::state::{Posture, State};
use dynamics_core::{Core, Engine};
use firmware_demo::target;
use forms::Forms;
use row::Row;

/// States that each function is asked for.
const STATES: usize = 32;

/// What a function may be asked for.
struct Ask<const N: usize> {
    state: State<f32, N, N>,
    posture: Posture<f32, N>,
}

type Inside<E, const N: usize> = fn(&State<f32, N, N>, &E) -> [f32; N];
type AtHand<E, const N: usize> = fn(&Posture<f32, N>, &State<f32, N, N>, &E) -> [f32; N];

/// Measures every row of the robot T and leaves the emulator.
pub fn run<T: Robot<B, N, N>, const B: usize, const N: usize>() -> ! {
    let asks = asks::<T, B, N>();
    inverse::<T, _, B, N>("full", &asks, &RIGID_BODY);
    inverse::<T, _, B, N>("bias", &asks, &(Gravity::EARTH, Coriolis));
    inverse::<T, _, B, N>("gravity", &asks, &(Gravity::EARTH,));
    inverse::<T, _, B, N>("no_coriolis", &asks, &(Gravity::EARTH, Inertia));
    let both = [Forms::core::<T, B>(), Forms::engine::<T, B>()];
    forms::measure::<T, B, N>(&asks, &both);
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
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
        let row = |trig| Row {
            robot: T::MODEL.name,
            algorithm: "rnea",
            form,
            inputs,
            trig,
            joints: N,
        };
        row(true).measure(inside as usize, asks, |ask| inside(&ask.state, effects));
        row(false).measure(at_hand as usize, asks, |ask| {
            at_hand(&ask.posture, &ask.state, effects)
        });
    }
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
