//! Other torque errors, those of measurement and identification, for comparison with those of the
//! computation: along the robot's way, in f64, so that nothing of the computation is in them.

use std::f64::consts::TAU;

use dynamics_core::Core;
use dynamics_core::algorithms::rnea;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{Calibrated, Robot, model};
use host_tests::random::{random_numbers, within};
use serde_json::json;

use super::problem::Problem;
use super::statistics::{Errors, widened};

/// Steps of an encoder in a turn: 14 bits.
const STEPS: f64 = 16384.0;

/// Drawings of parameters that are off.
const DRAWINGS: usize = 20;

/// Share of a joint's greatest torque that friction takes at its greatest speed: assumed, of the
/// order of harmonic drives.
const FRICTION: f64 = 0.1;

/// Prints a line for each of them.
pub fn print<T: Robot<B, N, N>, const B: usize, const N: usize>(
    full_scale: f64,
    way: &[Problem<N>],
) {
    let line = |key: &str, what: &str, errors: &Errors| {
        let line = json!({"key": key, "what": what});
        errors.print(T::MODEL.name, "yardstick", [full_scale, 0.0], line);
    };
    let rounded = Errors::of(way.iter().map(|Problem { state, truth }| {
        let mut state = widened(state);
        state.q = state.q.map(|q| (q / (TAU / STEPS)).round() * (TAU / STEPS));
        (Core::<T>::rnea(&state, &RIGID_BODY), *truth)
    }));
    let what = "positions rounded to 14 bits of a turn";
    line("encoder14", what, &rounded);
    for percent in [1, 5] {
        let what = format!(
            "masses, moments and inertias off by up to ±{percent} %, the worst of {DRAWINGS} \
             drawings"
        );
        let worst = inertial::<T, B, N>(way, f64::from(percent) / 100.0);
        line(&format!("inertial{percent}"), &what, &worst);
    }
    let mut per_speed = [0.0; N];
    for link in &model::<f64, T, B, N, N>().links {
        if let Some(per_speed) = per_speed.get_mut(link.idx_v) {
            *per_speed = 0.1 * FRICTION * link.limits.torque / link.limits.velocity;
        }
    }
    let friction = Errors::of(way.iter().map(|Problem { state, truth }| {
        let with = |j| truth[j] + per_speed[j] * f64::from(state.qd[j]);
        (std::array::from_fn(with), *truth)
    }));
    let what = "10 % of a viscous friction that at full speed takes a tenth of the joint's torque";
    line("friction10", what, &friction);
}

/// The errors of the drawing with the largest RMS.
fn inertial<T: Robot<B, N, N>, const B: usize, const N: usize>(
    way: &[Problem<N>],
    share: f64,
) -> Errors {
    let mut random = random_numbers();
    let drawings =
        (0..DRAWINGS).map(|_| {
            let mut robot = Calibrated::<T, f64, B, N, N>::nominal();
            for inertia in robot.inertias() {
                let [mass, moment, second] = within::<3>(&mut random, share).map(|x| 1.0 + x);
                inertia.mass *= mass;
                inertia.first_moment *= moment;
                inertia.rotational *= second;
            }
            Errors::of(way.iter().step_by(10).map(|Problem { state, truth }| {
                (rnea(&robot, &widened(state), &RIGID_BODY), *truth)
            }))
        });
    let worst = drawings.max_by(|a, b| a.rms().total_cmp(&b.rms()));
    worst.expect("some drawings")
}
