//! Ten seconds of simulated motion: how far loops open.

use dynamics_core::algorithms::{kinetic_energy, potential_energy};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::loops::LoopRobot;
use dynamics_core::loops::{Moving, Stabilisation, assemble, constraints, forward_dynamics};
use dynamics_core::model::Static;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use host_tests::measured::{largest, within};
use loop_tests::machines::{FourBar, Machine};

/// The state after a classical Runge-Kutta step of `h` in free motion.
fn step<R: Real>(state: &State<R, 3, 3>, by: Stabilisation<R>, h: R) -> State<R, 3, 3> {
    let rate = |state: &State<R, 3, 3>| {
        let none = [R::ZERO];
        let robot = Static::<FourBar>::NEW;
        let motion = forward_dynamics(&robot, &FourBar::LOOPS, state, &none, by, &RIGID_BODY);
        (state.qd, motion.expect("accelerations").qdd)
    };
    let moved = |by: R, (v, a): &([R; 3], [R; 3])| State {
        q: std::array::from_fn(|i| state.q[i] + by * v[i]),
        qd: std::array::from_fn(|i| state.qd[i] + by * a[i]),
        qdd: [R::ZERO; 3],
    };
    let half = R::from_f64(0.5) * h;
    let first = rate(state);
    let second = rate(&moved(half, &first));
    let third = rate(&moved(half, &second));
    let last = rate(&moved(h, &third));
    let mean = |a: [R; 3], b: [R; 3], c: [R; 3], d: [R; 3]| {
        std::array::from_fn(|i| {
            (a[i] + (b[i] + c[i]) + (b[i] + c[i]) + d[i]) * R::from_f64(1.0 / 6.0)
        })
    };
    moved(h, &(mean(first.0, second.0, third.0, last.0), mean(first.1, second.1, third.1, last.1)))
}

/// The largest error of position of the loop, m and rad.
fn opening<R: Real>(state: &State<R, 3, 3>) -> f64 {
    let closing = constraints(&Static::<FourBar>::NEW, &FourBar::LOOPS, state);
    largest(closing.position.map(|error| error.abs().to_f64()))
}

fn at_rest<R: Real>() -> State<R, 3, 3> {
    let guess = FourBar::HOME.map(R::from_f64);
    let robot = Static::<FourBar>::NEW;
    let closed = assemble(&robot, &FourBar::LOOPS, &guess, Moving::Passive);
    State::at(closed.expect("it closes").q)
}

/// The largest opening of the loop in free motion at 1 ms, m and rad, and the change of energy, J.
fn opened<R: Real>(by: Stabilisation<R>) -> (f64, f64) {
    let robot = Static::<FourBar>::NEW;
    let energy = |state: &State<R, 3, 3>| {
        let kinetic = kinetic_energy(&robot, state, &RIGID_BODY);
        (kinetic + potential_energy(&robot, &state.q, &RIGID_BODY)).to_f64()
    };
    let mut state = at_rest();
    let (before, mut openings) = (energy(&state), Vec::new());
    for _ in 0..10_000 {
        state = step(&state, by, R::from_f64(1e-3));
        openings.push(opening(&state));
    }
    (largest(openings), (energy(&state) - before).abs())
}

#[test]
fn a_stabilised_loop_stays_closed() {
    let (error, energy) = opened(Stabilisation::for_step(1e-3_f64));
    let (drift, _) = opened(Stabilisation::<f64>::NONE);
    let (single, single_energy) = opened(Stabilisation::for_step(1e-3_f32));
    // The errors of the second and third line grow with time.
    within("opening in f64, stabilised, m", error, 1e-8);
    within("energy in f64, stabilised, J", energy, 8e-7);
    within("opening in f64, not stabilised, m", drift, 8e-7);
    within("opening in f32, stabilised, m", single, 6e-6);
    within("energy in f32, stabilised, J", single_energy, 6e-5);
}

#[test]
fn an_open_loop_closes_by_stabilisation() {
    let mut state = at_rest::<f64>();
    state.q[1] += 0.05;
    let before = opening(&state);
    for _ in 0..400 {
        state = step(&state, Stabilisation::for_step(1e-3), 1e-3);
    }
    within("what is left of an opening after 20 time constants", opening(&state) / before, 3e-7);
}
