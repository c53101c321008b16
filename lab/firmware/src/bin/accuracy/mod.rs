//! The cost of each way to compute a robot's torques, or to simulate it, between the meter's
//! markers. `cargo xtask accuracy` reads the log: rows as those of `costs`, of the algorithms
//! `inverse` and `simulation`, their inputs the key without what the target does not know. A call
//! is a tick or a step.
#![allow(dead_code, reason = "not every bin measures all")]

#[path = "../costs/row.rs"]
mod row;

use core::fmt::{Display, Write};

use cortex_m_semihosting::debug;
use dynamics_core::state::State;
use firmware_demo::target;
use fixtures::accuracy::robots::Compared;
use fixtures::accuracy::simulation::{self, PassiveMotion, Simulation};
use fixtures::accuracy::{Inverse, Visitor, list};
use heapless::String;
use row::{Row, numbers};

/// Ticks of each way: two periods of the lowest rate.
const TICKS: usize = 40;

/// Steps of each way to simulate, and their length in s: short enough for every integrator.
const STEPS: [f64; 8] = [1e-4; 8];

/// The references of a robot in some ticks.
type Courses<const N: usize> = [State<f32, N, N>; TICKS];

/// Measures each way that it visits.
pub struct Priced<const N: usize> {
    robot: &'static str,
    pub algorithm: &'static str,
    /// Anywhere, for ways that remember nothing.
    spread: Courses<N>,
    /// One after the other on the robot's way.
    course: Courses<N>,
}

/// Runs a row under the key by which the host knows all else.
#[inline(always)]
fn measure<A, T>(
    [robot, algorithm]: [&'static str; 2],
    key: impl Display,
    address: usize,
    asks: &[A],
    run: impl FnMut(&A) -> T,
) {
    let mut inputs = String::<96>::new();
    if write!(inputs, "{key}").is_err() {
        target::fail("a key is too long");
    }
    let (inputs, form, trig, joints) = (&*inputs, "any", true, 0);
    let row = Row { robot, algorithm, form, inputs, trig, joints };
    row.measure(address, asks, run);
}

impl<const N: usize> Visitor<N> for Priced<N> {
    fn way<W: Inverse<N>>(&mut self) {
        let states = match W::MEMORY {
            true => &self.course,
            false => &self.spread,
        };
        let mut way = W::start(&states[0]);
        let inputs = states.each_ref().map(W::input);
        let names = [self.robot, self.algorithm];
        measure(names, W::KEY, W::address(), &inputs, |input| way.tick(input));
    }
}

/// Measures each way to simulate the robot of this name.
struct Stepped(&'static str);

impl<const N: usize> simulation::Visitor<N> for Stepped {
    fn simulation<S: Simulation<N>>(&mut self) {
        let mut run = S::start();
        let names = [self.0, "simulation"];
        measure(names, S::KEY, S::address(), &STEPS, |&h| run.step(h));
    }
}

/// Ends the log and leaves the emulator.
pub fn done() -> ! {
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}

/// Measures every way to simulate the robot T.
pub fn simulated<T: PassiveMotion<N>, const N: usize>() {
    simulation::every::<T, N>(&mut Stepped(T::MODEL.name));
}

/// Measures every way of the robot T.
pub fn robot<T: Compared<B, N, W>, const B: usize, const N: usize, const W: usize>() -> ! {
    list::inverse::<T, B, N>(&mut states::<T, B, N, W>());
    done()
}

/// The states of the robot T, for its ways to be measured.
pub fn states<T: Compared<B, N, W>, const B: usize, const N: usize, const W: usize>() -> Priced<N> {
    let mut number = numbers();
    let spread = [(); TICKS].map(|()| {
        let [q, qd, qdd] = [3.0, 3.0, 10.0].map(|bound| [(); N].map(|()| number(bound)));
        State { q, qd, qdd }
    });
    let Ok(way) = T::way() else {
        target::fail("the robot cannot go there");
    };
    let first = way.ticks() / 4 + 1;
    let course = core::array::from_fn(|k| way.at(first + k as u32));
    let (robot, algorithm) = (T::MODEL.name, "inverse");
    Priced { robot, algorithm, spread, course }
}
