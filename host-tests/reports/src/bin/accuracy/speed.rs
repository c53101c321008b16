//! What leaving out the velocity products loses, against the joints' speed: a slow arm does not need them.

use dynamics_core::effects::{Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::Robot;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use host_tests::random::{random_numbers, within};
use serde_json::json;

use super::inverse::widened;
use super::statistics::Errors;

/// rad/s: every joint's speed lies within ± this.
const SPEEDS: [f64; 7] = [0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 3.0];

/// States of each.
const STATES: usize = 1000;

/// Prints a line for each speed.
pub fn print<T: Robot<B, N, N>, const B: usize, const N: usize>(full_scale: f64) {
    let mut random = random_numbers();
    for speed in SPEEDS {
        let errors = Errors::<N>::of((0..STATES).map(|_| {
            let mut numbers = |bound| within::<N>(&mut random, bound).map(|x| x as f32);
            let state = State {
                q: numbers(std::f64::consts::PI),
                qd: numbers(speed),
                qdd: numbers(10.0),
            };
            let without = Engine::<T>::rnea(&state, &(Gravity::EARTH, Inertia));
            let truth = Core::<T>::rnea(&widened(&state), &RIGID_BODY);
            (without.map(f64::from), truth)
        }));
        let summary = errors.summary(full_scale);
        println!(
            "{}",
            json!({
                "robot": T::MODEL.name,
                "kind": "speed",
                "key": "model=no_coriolis",
                "speed": speed,
                "unit": "N·m",
                "full_scale": full_scale,
                "error_max": summary.error_max,
                "error_rms": summary.error_rms,
                "error_p99": summary.error_p99,
                "relative_max": summary.relative_max,
            })
        );
    }
}
