//! Inverse dynamics, form by form, effect by effect.

use dynamics_core::algorithms::TorqueGradient;
use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::Robot;
use dynamics_core::state::{JointTrig, State, StateWithTrig};
use dynamics_core::{Core, Engine};

use super::row::{Row, numbers};
use super::{Ask, STATES, asks, done};

pub type Inside<'a, E, const N: usize> = fn(&'a State<f32, N, N>, &E) -> [f32; N];
pub type Precomputed<'a, E, const N: usize> = fn(StateWithTrig<'a, f32, N, N>, &E) -> [f32; N];

/// Measures every row of the robot T and leaves the emulator.
pub fn run<T: Robot<B, N, N>, const B: usize, const N: usize>() -> ! {
    let asks = asks::<T, B, N, STATES>();
    inverse::<T, _, B, N>("full", &asks, &RIGID_BODY);
    inverse::<T, _, B, N>("bias", &asks, &(Gravity::EARTH, Coriolis));
    inverse::<T, _, B, N>("gravity", &asks, &(Gravity::EARTH,));
    inverse::<T, _, B, N>("no_coriolis", &asks, &(Gravity::EARTH, Inertia));
    derivatives::<T, B, N>(&asks);
    done()
}

/// Inverse dynamics and its derivatives of a robot with a free base, by the engine.
pub fn free<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>() {
    let mut number = numbers();
    let asks: [(State<f32, Q, V>, JointTrig<f32, Q>); STATES] = [(); STATES].map(|()| {
        let q = [(); Q].map(|()| number(3.0));
        let [qd, qdd] = [3.0, 10.0].map(|bound| [(); V].map(|()| number(bound)));
        (State { q, qd, qdd }, Core::<T>::joint_trig(&q))
    });
    let row = |algorithm| {
        let (robot, form, inputs) = (T::MODEL.name, "engine", "full");
        Row { robot, algorithm, form, inputs, trig: false, joints: V }
    };
    let run: fn(_, &RigidBody) -> [f32; V] = Engine::<T>::rnea;
    row("rnea").measure(run as usize, &asks, |(at, trig)| run(trig.with(at), &RIGID_BODY));
    let run: fn(_, &RigidBody) -> TorqueGradient<f32, V> = Engine::<T>::rnea_derivatives;
    let row = row("rnea_derivatives");
    row.measure(run as usize, &asks, |(at, trig)| run(trig.with(at), &RIGID_BODY));
}

/// Inverse dynamics in both forms, with sines and cosines computed inside and before.
pub fn inverse<T: Robot<B, N, N>, E: Effect<f32, B, N>, const B: usize, const N: usize>(
    inputs: &'static str,
    asks: &[Ask<N>; STATES],
    effects: &E,
) {
    let forms: [(&str, Inside<'_, E, N>, Precomputed<'_, E, N>); 2] = [
        ("core", Core::<T>::rnea, Core::<T>::rnea),
        ("engine", Engine::<T>::rnea, Engine::<T>::rnea),
    ];
    for (form, inside, precomputed) in forms {
        let row = |trig| Row::of::<T, B, N>("rnea", form, inputs, trig);
        row(true).measure(inside as usize, asks, |ask| inside(&ask.state, effects));
        row(false).measure(precomputed as usize, asks, |ask| {
            precomputed(ask.trig.with(&ask.state), effects)
        });
    }
}

type Gradient<S, const N: usize> = fn(S, &RigidBody) -> TorqueGradient<f32, N>;
type RigidBody = (Gravity, Inertia, Coriolis);

/// Derivatives of inverse dynamics by the engine, with sines and cosines computed inside and
/// before.
fn derivatives<T: Robot<B, N, N>, const B: usize, const N: usize>(asks: &[Ask<N>; STATES]) {
    let row = |trig| Row::of::<T, B, N>("rnea_derivatives", "engine", "full", trig);
    let run: Gradient<&State<f32, N, N>, N> = Engine::<T>::rnea_derivatives;
    row(true).measure(run as usize, asks, |ask| run(&ask.state, &RIGID_BODY));
    let run: Gradient<StateWithTrig<'_, f32, N, N>, N> = Engine::<T>::rnea_derivatives;
    row(false).measure(run as usize, asks, |ask| run(ask.trig.with(&ask.state), &RIGID_BODY));
}
