//! What a step of each way to simulate costs, between the meter's markers: the rows of `costs`, of the algorithm
//! `simulation`, their inputs the key without step length and opt-level. `cargo xtask accuracy` reads the log.
#![no_std]
#![no_main]

#[path = "costs/row.rs"]
mod row;

use core::fmt::Write;

use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use dynamics_core::robots::Ur5e;
use firmware_demo::accuracy::simulation::{DoublePendulum, LetGo, Simulation, Visitor, every};
use firmware_demo::target;
use heapless::String;
use row::Row;

/// Steps of each.
const STEPS: usize = 8;

/// s: short enough for every integrator, so that no number grows beyond measure.
const STEP: f64 = 1e-4;

/// Measures each way that it visits.
struct Priced(&'static str);

impl<const N: usize> Visitor<N> for Priced {
    fn simulation<S: Simulation<N>>(&mut self) {
        let mut key = String::<96>::new();
        if write!(key, "{}", S::KEY).is_err() {
            target::fail("a key is too long");
        }
        let row = Row {
            robot: self.0,
            algorithm: "simulation",
            form: "engine",
            inputs: &key,
            trig: true,
            joints: N,
        };
        let mut run = S::start();
        row.measure(S::address(), &[STEP; STEPS], |&h| run.step(h));
    }
}

fn robot<T: LetGo<N>, const N: usize>() {
    every::<T, N>(&mut Priced(T::MODEL.name));
}

#[entry]
fn main() -> ! {
    robot::<DoublePendulum, 2>();
    robot::<Ur5e, 6>();
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}
