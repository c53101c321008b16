//! What each way to compute a robot's torques costs, between the meter's markers. `cargo xtask accuracy` reads the log:
//! the rows of `costs`, of the algorithm `inverse`, their inputs the key without form and opt-level. A call is a tick.

#[path = "../costs/row.rs"]
mod row;

use core::fmt::Write;

use cortex_m_semihosting::debug;
use dynamics_core::drivetrain::ElasticReference;
use dynamics_core::state::State;
use firmware_demo::accuracy::robots::{Compared, momentary};
use firmware_demo::accuracy::{Inverse, Visitor};
use firmware_demo::target;
use heapless::String;

use row::Row;

/// Ticks of each way: two periods of the lowest rate.
pub const TICKS: usize = 40;

/// Measures each way that it visits.
pub struct Priced<const N: usize> {
    robot: &'static str,
    /// What the log calls them.
    pub algorithm: &'static str,
    /// Anywhere, for ways that remember nothing.
    pub spread: [ElasticReference<f32, N, N>; TICKS],
    /// One after the other on the robot's way.
    pub course: [ElasticReference<f32, N, N>; TICKS],
}

impl<const N: usize> Visitor<N> for Priced<N> {
    fn way<W: Inverse<N>>(&mut self) {
        let states = if W::MEMORY {
            &self.course
        } else {
            &self.spread
        };
        let mut key = String::<96>::new();
        if write!(key, "{}", W::KEY).is_err() {
            target::fail("a key is too long");
        }
        let row = Row {
            robot: self.robot,
            algorithm: self.algorithm,
            form: W::KEY.form,
            inputs: &key,
            trig: true,
            joints: N,
        };
        let mut way = W::start(&states[0].state);
        let inputs = states.each_ref().map(W::input);
        row.measure(W::address(), &inputs, |input| way.tick(input));
    }
}

/// Ends the log and leaves the emulator.
pub fn done() -> ! {
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}

/// Measures every way of the robot T.
#[allow(dead_code, reason = "not every bin measures all")]
pub fn rigid<T: Compared<B, N, W>, const B: usize, const N: usize, const W: usize>() -> Priced<N> {
    let mut priced = states::<T, B, N, W>();
    T::rigid(&mut priced);
    priced
}

/// The states of the robot T, for its ways to be measured.
pub fn states<T: Compared<B, N, W>, const B: usize, const N: usize, const W: usize>() -> Priced<N> {
    let mut seed = 1_u32;
    let mut number = |bound: f32| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 * (2.0 * bound / 16_777_216.0) - bound
    };
    let spread = [(); TICKS].map(|()| {
        momentary(State {
            q: [(); N].map(|()| number(3.0)),
            qd: [(); N].map(|()| number(3.0)),
            qdd: [(); N].map(|()| number(10.0)),
        })
    });
    let Ok(way) = T::way() else {
        target::fail("the robot cannot go there");
    };
    let mut tick = way.ticks() / 4;
    let course = [(); TICKS].map(|()| {
        tick += 1;
        momentary(way.at(tick))
    });
    Priced {
        robot: T::MODEL.name,
        algorithm: "inverse",
        spread,
        course,
    }
}
