//! Other torque errors, those of measurement and identification, for comparison with those of the computation.
//!
//! Along the robot's way, in f64, so that nothing of the computation is in them.

use std::f64::consts::TAU;

use dynamics_core::Core;
use dynamics_core::algorithms::rnea;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{Calibrated, Robot, model};
use host_tests::random::{random_numbers, within};
use serde_json::json;

use super::inverse::Problem;
use super::statistics::{Errors, widened};

/// Drawings of parameters that are off.
const DRAWINGS: usize = 20;

/// Share of a joint's greatest torque that friction takes at its greatest speed: assumed, of the order of harmonic
/// drives.
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
    let rounded = encoder::<T, B, N>(way, 14);
    line(
        "encoder14",
        "positions rounded to 14 bits of a turn",
        &rounded,
    );
    for percent in [1, 5] {
        line(
            &format!("inertial{percent}"),
            &format!(
                "masses, moments and inertias off by up to ±{percent} %, the worst of {DRAWINGS} drawings"
            ),
            &inertial::<T, B, N>(way, f64::from(percent) / 100.0),
        );
    }
    line(
        "friction10",
        "10 % of a viscous friction that at full speed takes a tenth of the joint's torque",
        &friction::<T, B, N>(way),
    );
}

fn encoder<T: Robot<B, N, N>, const B: usize, const N: usize>(
    way: &[Problem<N>],
    bits: u32,
) -> Errors {
    let step = TAU / f64::from(1_u32 << bits);
    Errors::of(way.iter().map(|Problem { course, truth }| {
        let mut state = widened(&course.state);
        state.q = state.q.map(|q| (q / step).round() * step);
        (Core::<T>::rnea(&state, &RIGID_BODY), *truth)
    }))
}

/// Of the drawing with the largest RMS.
fn inertial<T: Robot<B, N, N>, const B: usize, const N: usize>(
    way: &[Problem<N>],
    share: f64,
) -> Errors {
    let mut random = random_numbers();
    let drawings = (0..DRAWINGS).map(|_| {
        let mut robot = Calibrated::<T, f64, B, N, N>::nominal();
        for inertia in robot.inertias() {
            let [mass, moment, second] = within::<3>(&mut random, share).map(|x| 1.0 + x);
            inertia.mass *= mass;
            inertia.first_moment *= moment;
            inertia.inertia *= second;
        }
        Errors::of(way.iter().step_by(10).map(|Problem { course, truth }| {
            (rnea(&robot, &widened(&course.state), &RIGID_BODY), *truth)
        }))
    });
    drawings
        .max_by(|a, b| a.rms().total_cmp(&b.rms()))
        .expect("some drawings")
}

fn friction<T: Robot<B, N, N>, const B: usize, const N: usize>(way: &[Problem<N>]) -> Errors {
    let mut per_speed = [0.0; N];
    for link in &model::<f64, T, B, N, N>().links {
        if let Some(per_speed) = per_speed.get_mut(link.idx_v) {
            *per_speed = 0.1 * FRICTION * link.limits.torque / link.limits.velocity;
        }
    }
    Errors::of(way.iter().map(|Problem { course, truth }| {
        let with = |j| truth[j] + per_speed[j] * f64::from(course.state.qd[j]);
        (std::array::from_fn(with), *truth)
    }))
}
