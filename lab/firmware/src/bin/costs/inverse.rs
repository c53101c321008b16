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

/// [`both`] of the function of this name.
macro_rules! rows {
    ($function:ident, $names:expr, $asks:expr, $effects:expr) => {
        $crate::costs::inverse::both::<T, _, _, B, N>(
            $names,
            ($asks, $effects),
            [Core::<T>::$function, Engine::<T>::$function],
            [Core::<T>::$function, Engine::<T>::$function],
        )
    };
}
pub(super) use rows;

/// Measures every row of the robot T and leaves the emulator.
pub fn run<T: Robot<B, N, N>, const B: usize, const N: usize>() -> ! {
    let asks = asks::<T, B, N, STATES>();
    inverse::<T, _, B, N>("full", &asks, &RIGID_BODY);
    inverse::<T, _, B, N>("bias", &asks, &(Gravity::EARTH, Coriolis));
    inverse::<T, _, B, N>("gravity", &asks, &(Gravity::EARTH,));
    inverse::<T, _, B, N>("no_coriolis", &asks, &(Gravity::EARTH, Inertia));
    rows!(rnea_derivatives, ["rnea_derivatives", "full"], &asks, &RIGID_BODY);
    done()
}

/// States of a robot with joints of several coordinates.
fn free_asks<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>()
-> [(State<f32, Q, V>, JointTrig<f32, Q>); STATES] {
    let mut number = numbers();
    [(); STATES].map(|()| {
        let q = [(); Q].map(|()| number(3.0));
        let [qd, qdd] = [3.0, 10.0].map(|bound| [(); V].map(|()| number(bound)));
        (State { q, qd, qdd }, Core::<T>::joint_trig(&q))
    })
}

fn free_row<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>(
    algorithm: &'static str,
) -> Row<'static> {
    let (robot, form, inputs) = (T::MODEL.name, "engine", "full");
    Row { robot, algorithm, form, inputs, trig: false, joints: V }
}

/// Its inverse dynamics, by the engine.
pub fn free_torques<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>() {
    let run: fn(_, &RigidBody) -> [f32; V] = Engine::<T>::rnea;
    let asks = free_asks::<T, B, Q, V>();
    free_row::<T, B, Q, V>("rnea")
        .measure(run as usize, &asks, |(at, trig)| run(trig.with(at), &RIGID_BODY));
}

/// And their derivatives.
pub fn free<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>() {
    free_torques::<T, B, Q, V>();
    let run: fn(_, &RigidBody) -> TorqueGradient<f32, V> = Engine::<T>::rnea_derivatives;
    let asks = free_asks::<T, B, Q, V>();
    free_row::<T, B, Q, V>("rnea_derivatives")
        .measure(run as usize, &asks, |(at, trig)| run(trig.with(at), &RIGID_BODY));
}

/// Inverse dynamics in both forms.
pub fn inverse<T: Robot<B, N, N>, E: Effect<f32, B, N>, const B: usize, const N: usize>(
    inputs: &'static str,
    asks: &[Ask<N>; STATES],
    effects: &E,
) {
    rows!(rnea, ["rnea", inputs], asks, effects);
}

pub type RigidBody = (Gravity, Inertia, Coriolis);

/// A function of core and engine, with sines and cosines computed inside and before.
pub fn both<'a, T: Robot<B, N, N>, E, Out, const B: usize, const N: usize>(
    [algorithm, inputs]: [&'static str; 2],
    (asks, effects): (&'a [Ask<N>; STATES], &E),
    inside: [fn(&'a State<f32, N, N>, &E) -> Out; 2],
    before: [fn(StateWithTrig<'a, f32, N, N>, &E) -> Out; 2],
) {
    for (form, (inside, before)) in
        ["core", "engine"].into_iter().zip(inside.into_iter().zip(before))
    {
        let row = |trig| Row::of::<T, B, N>(algorithm, form, inputs, trig);
        row(true).measure(inside as usize, asks, |ask| inside(&ask.state, effects));
        row(false).measure(before as usize, asks, |ask| before(ask.trig.with(&ask.state), effects));
    }
}
