//! What leaving out the velocity products loses, against the joints' speed: a slow arm does not need them.

use std::f64::consts::PI;

use dynamics_core::effects::{Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::Robot;
use dynamics_core::{Core, Engine};
use host_tests::random::random_numbers;
use serde_json::json;

use super::inverse::drawn;
use super::statistics::{Errors, widened};

/// rad/s: every joint's speed lies within ± this.
const SPEEDS: [f64; 7] = [0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 3.0];

/// States of each.
const STATES: usize = 1000;

/// Prints a line for each speed.
pub fn print<T: Robot<B, N, N>, const B: usize, const N: usize>(full_scale: f64) {
    let mut random = random_numbers();
    for speed in SPEEDS {
        let errors = Errors::of((0..STATES).map(|_| {
            let state = drawn::<N>(&mut random, [PI, speed, 10.0]);
            let without = Engine::<T>::rnea(&state, &(Gravity::EARTH, Inertia));
            let truth = Core::<T>::rnea(&widened(&state), &RIGID_BODY);
            (without.map(f64::from), truth)
        }));
        let line = json!({"key": "model=no_coriolis", "speed": speed});
        errors.print(T::MODEL.name, "speed", [full_scale, 0.0], line);
    }
}
