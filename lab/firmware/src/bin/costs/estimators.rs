//! Estimators of a load and of an arm's parameters: one update each.

use dynamics_core::Core;
use dynamics_core::algorithms::friction_regressor;
use dynamics_core::effects::{RIGID_BODY, Width};
use dynamics_core::model::Robot;
use dynamics_core::robots::So101;
use dynamics_core::state::State;
use motion_control::estimate::{
    ParameterEstimator, ParameterEstimatorConfig, PayloadEstimator, PayloadEstimatorConfig,
    SelectedParameters,
};

use super::row::Row;
use super::{Ask, STATES};

/// The estimator of a load, with the torques of all joints and of the first three.
pub fn payload<T: Robot<B, N, N>, const B: usize, const N: usize>(asks: &[Ask<N>; STATES]) {
    let config = PayloadEstimatorConfig {
        noise: [1.0; N],
        prior: [1.0; 10],
        forgetting: 1e-3,
        limit: 1000.0,
    };
    let Ok(mut estimator) = PayloadEstimator::<f32, N>::try_new(config) else {
        return;
    };
    let columns = asks
        .each_ref()
        .map(|ask| Core::<T>::regressor_columns(&ask.state, &RIGID_BODY, const { B - 1 }));
    let row = |inputs| Row::of::<T, B, N>("payload_update", "core", inputs, false);
    let run = all_joints::<N>;
    row("all_joints").measure(run as *const () as usize, &columns, |y| run(&mut estimator, y));
    let run = three_joints::<N>;
    row("3_joints").measure(run as *const () as usize, &columns, |y| run(&mut estimator, y));
}

#[inline(never)]
fn all_joints<const N: usize>(
    estimator: &mut PayloadEstimator<f32, N>,
    y: &[[f32; 10]; N],
) -> bool {
    estimator.update(y, &[1.0; N]).is_ok()
}

#[inline(never)]
fn three_joints<const N: usize>(
    estimator: &mut PayloadEstimator<f32, N>,
    y: &[[f32; 10]; N],
) -> bool {
    estimator.update_joints([0, 1, 2], y, &[1.0; N]).is_ok()
}

/// Parameters that are estimated, of 60 of the bodies and five of each joint.
const P: usize = 24;
const N: usize = 90;
/// Those that the test of the estimator selects.
const SELECTED: SelectedParameters<f32, P, N> = SelectedParameters {
    columns: [
        11, 30, 40, 60, 61, 62, 65, 66, 67, 68, 70, 71, 72, 73, 74, 75, 76, 77, 80, 81, 82, 85, 86,
        87,
    ],
    prior: [0.1; P],
    spread: [[0.0; P]; N],
};

/// The estimator of the SO-101's parameters: an update with the row of its first joint, and with
/// one that is given.
pub fn parameters(asks: &[Ask<6>; STATES]) {
    let config = ParameterEstimatorConfig {
        noise: [1.0; 6],
        prior: [0.1; P],
        own: SELECTED.own(6, 5),
        forgetting: 1e-4,
        limit: 1000.0,
    };
    let Ok(mut estimator) = ParameterEstimator::<f32, P, 6>::try_new(config) else {
        return;
    };
    let bodies = SELECTED.bodies();
    let row = |inputs, trig| Row::of::<So101, 6, 6>("parameter_update", "core", inputs, trig);
    row("with_row", true).measure(with_row as *const () as usize, asks, |ask| {
        with_row(&mut estimator, &bodies, &ask.state)
    });
    let rows = asks.each_ref().map(|ask| parameter_row(&bodies, &ask.state));
    row("row_given", false)
        .measure(update as *const () as usize, &rows, |y| update(&mut estimator, y));
}

#[inline(always)]
fn parameter_row(bodies: &[bool; 6], state: &State<f32, 6, 6>) -> [f32; P] {
    let bodies = Core::<So101>::regressor_row_of_bodies(state, &RIGID_BODY, 0, bodies);
    let [[viscous, sign], ..] = friction_regressor(&state.qd, Width::f32(0.05));
    SELECTED.row(0, &bodies, &[viscous, sign, state.qdd[0], 0.0, 0.0])
}

#[inline(never)]
fn with_row(
    estimator: &mut ParameterEstimator<f32, P, 6>,
    bodies: &[bool; 6],
    state: &State<f32, 6, 6>,
) -> bool {
    estimator.update(0, &parameter_row(bodies, state), 0.1).is_ok()
}

#[inline(never)]
fn update(estimator: &mut ParameterEstimator<f32, P, 6>, y: &[f32; P]) -> bool {
    estimator.update(0, y, 0.1).is_ok()
}
