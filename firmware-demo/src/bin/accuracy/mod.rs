//! What each way to compute a robot's torques costs, between the meter's markers. `cargo xtask accuracy` reads the log:
//! the rows of `costs`, of the algorithm `inverse`, their inputs the key without form and opt-level. A call is a tick.

#[path = "../costs/row.rs"]
mod row;

use core::fmt::Write;

use cortex_m_semihosting::debug;
use dynamics_core::control::WayPoint;
use dynamics_core::model::Robot;
use dynamics_core::state::State;
use firmware_demo::accuracy::{Inverse, Visitor, list};
use firmware_demo::target;
use firmware_demo::trajectories::reference;
use heapless::String;

use row::Row;

/// Ticks of each way: two periods of the lowest rate.
const TICKS: usize = 40;

/// Measures each way that it visits.
struct Priced<const N: usize> {
    robot: &'static str,
    /// Anywhere, for ways that remember nothing.
    spread: [State<f32, N, N>; TICKS],
    /// One after the other on the robot's way.
    course: [State<f32, N, N>; TICKS],
}

impl<const N: usize> Visitor<N> for Priced<N> {
    fn way<W: Inverse<N>>(&mut self) {
        let states = if W::MEMORY { &self.course } else { &self.spread };
        let mut key = String::<96>::new();
        if write!(key, "{}", W::KEY).is_err() {
            target::fail("a key is too long");
        }
        let row = Row {
            robot: self.robot,
            algorithm: "inverse",
            form: W::KEY.form,
            inputs: &key,
            trig: true,
            joints: N,
        };
        let mut way = W::start(&states[0]);
        let inputs = states.each_ref().map(W::input);
        row.measure(W::address(), &inputs, |input| way.tick(input));
    }
}

/// Measures every way of the robot T, which goes through these points, and leaves the emulator.
pub fn inverse<T: Robot<B, N, N>, const B: usize, const N: usize, const W: usize>(
    points: &[WayPoint<f32, N>; W],
) -> ! {
    let mut seed = 1_u32;
    let mut number = |bound: f32| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 * (2.0 * bound / 16_777_216.0) - bound
    };
    let spread = [(); TICKS].map(|()| State {
        q: [(); N].map(|()| number(3.0)),
        qd: [(); N].map(|()| number(3.0)),
        qdd: [(); N].map(|()| number(10.0)),
    });
    let Ok(way) = reference::<T, B, N, W>(points) else {
        target::fail("the robot cannot go there");
    };
    let mut tick = way.ticks() / 4;
    let course = [(); TICKS].map(|()| {
        tick += 1;
        way.at(tick)
    });
    list::inverse::<T, B, N>(&mut Priced {
        robot: T::MODEL.name,
        spread,
        course,
    });
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}
