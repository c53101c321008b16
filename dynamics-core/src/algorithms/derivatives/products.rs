//! ∂ID x and xᵀ ∂ID without the matrices, in O(B): the columns of
//! [`rnea_derivatives`](super::rnea_derivatives), Singh, Russell & Wensing (2022), summed over a
//! body's ancestors or descendants before they are projected.

use core::borrow::Borrow;

use heapless::Vec;

use super::outward::outward;
use super::{joint_slopes, named_derivatives};
use crate::algorithms::tree_pass::{inward, per_body};
use crate::effects::{Effect, Scene};
use crate::model::RobotModel;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Force, Motion};
use crate::state::{Configuration, RobotState, entry};

/// (∂τ/∂q) δq + (∂τ/∂q̇) δq̇: the change of the torques of inverse dynamics by small changes of
/// position and velocity, N·m or N.
///
/// Under the effects of [`rnea_derivatives`](super::rnea_derivatives), without its matrices.
///
/// # Shape
/// V.
///
/// # Cost
/// Some 900 flops for each body on a revolute joint.
///
/// # Source
/// Singh, Russell & Wensing (2022), summed.
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{rnea_along, rnea_derivatives};
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// let state = State { qd: [1.0; 6], ..State::at([0.0_f64, -1.2, 1.5, 0.3, 0.7, 0.0]) };
/// let by = rnea_derivatives(&Ur5e::MODEL, &state, &RIGID_BODY);
/// let along = rnea_along(&Ur5e::MODEL, &state, &[0.1; 6], &[0.0; 6], &RIGID_BODY);
/// for (row, product) in by.dq.iter().zip(along) {
///     assert!((row.iter().sum::<f64>() * 0.1 - product).abs() < 1e-13);
/// }
/// ```
#[doc(alias = "Jacobian-vector product")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn rnea_along<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    dq: &[R; V],
    dqd: &[R; V],
    effects: &E,
) -> [R; V]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const {
        let () = Scene::<R, E, B, V>::OF_CORE;
        named_derivatives::<R, E, B, V>();
    };
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let turns = &trig.coordinates;
    let (mut bodies, columns) = outward(robot, turns, state, effects);
    // The changes of velocity and acceleration by all coordinates up to each body.
    let mut changes = per_body(robot, [Motion::ZERO; 2]);
    let mut all: Vec<[Motion<R>; 2], B> = Vec::new();
    for body in &bodies {
        let mut change = changes.parent(&body.link).map(|m| body.x * m);
        for k in body.link.coordinates() {
            let column = columns.get(k).copied().unwrap_or_default();
            let (by_q, by_qd) = (entry(dq, k), entry(dqd, k));
            change[0] += column.s_rate * by_q + column.s * by_qd;
            change[1] += column.s_accel * by_q + column.s_rates * by_qd;
        }
        changes.push(change);
        let _ = all.push(change);
    }
    let mut beyond: Vec<Force<R>, B> = Vec::new();
    beyond.extend(bodies.iter().map(|_| Force::ZERO));
    let mut tau = [R::ZERO; V];
    let mut pass = inward(&mut bodies);
    while let Some((body, inner)) = pass.next() {
        body.add_to(inner);
        let i = inner.len();
        let [rate, accel] = all.get(i).copied().unwrap_or([Motion::ZERO; 2]);
        let mut up = beyond.get(i).copied().unwrap_or(Force::ZERO);
        body.link.project(turns, body.force(rate, accel) + up, &mut tau);
        for (place, k) in body.link.coordinates().enumerate() {
            let column = columns.get(k).copied().unwrap_or_default();
            let (by_q, by_qd) = (entry(dq, k), entry(dqd, k));
            let rate = column.s_rate * by_q + column.s * by_qd;
            let accel = column.s_accel * by_q + column.s_rates * by_qd;
            up += body.force(rate, accel) + (column.s * by_q).cross_force(body.fc);
            let mut own = R::ZERO;
            let at = (&body.link, &turns[..]);
            let slope = joint_slopes(effects, at, state, k, |j, by| own += by * entry(dq, j));
            add(&mut tau, k, own + slope * by_qd);
            if let Some(bend) = body.link.bend(turns, place) {
                add(&mut tau, body.link.idx_v(), bend.column.dot(body.fc) * by_q);
            }
        }
        if let Some(parent) = beyond.get_mut(body.link.parent) {
            *parent += body.x.transpose_mul(up);
        }
    }
    tau
}

/// xᵀ ∂τ/∂q and xᵀ ∂τ/∂q̇ of inverse dynamics: the slopes of xᵀ τ, for constant x.
///
/// Under the effects of [`rnea_derivatives`](super::rnea_derivatives), without its matrices.
///
/// # Shape
/// Two of V.
///
/// # Cost
/// Some 900 flops for each body on a revolute joint.
///
/// # Source
/// Singh, Russell & Wensing (2022), summed.
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{rnea_derivatives, rnea_transposed};
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// let state = State { qd: [1.0; 6], ..State::at([0.0_f64, -1.2, 1.5, 0.3, 0.7, 0.0]) };
/// let by = rnea_derivatives(&Ur5e::MODEL, &state, &RIGID_BODY);
/// let [by_q, _] = rnea_transposed(&Ur5e::MODEL, &state, &[0.1; 6], &RIGID_BODY);
/// for (k, product) in by_q.iter().enumerate() {
///     assert!((by.dq.iter().map(|row| row[k]).sum::<f64>() * 0.1 - product).abs() < 1e-13);
/// }
/// ```
#[doc(alias = "vector-Jacobian product")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn rnea_transposed<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    x: &[R; V],
    effects: &E,
) -> [[R; V]; 2]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const {
        let () = Scene::<R, E, B, V>::OF_CORE;
        named_derivatives::<R, E, B, V>();
    };
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let turns = &trig.coordinates;
    let (mut bodies, columns) = outward(robot, turns, state, effects);
    // S x of the ancestors of each body, in its coordinates.
    let mut moved = per_body(robot, Motion::ZERO);
    let mut before: Vec<Motion<R>, B> = Vec::new();
    for body in &bodies {
        let parent = body.x * moved.parent(&body.link);
        moved.push(body.link.plus_motion(parent, turns, x));
        let _ = before.push(parent);
    }
    // Iᶜ S x and 2 Bᶜᵀ S x of all joints from each body on, the latter a couple.
    let mut rows: Vec<(Force<R>, R::Vec3), B> = Vec::new();
    rows.extend(bodies.iter().map(|_| (Force::ZERO, R::Vec3::ZERO)));
    let [mut by_q, mut by_qd] = [[R::ZERO; V]; 2];
    let mut pass = inward(&mut bodies);
    while let Some((body, inner)) = pass.next() {
        body.add_to(inner);
        let i = inner.len();
        let along = body.link.motion(turns, x);
        let (mut row, mut couple) = rows.get(i).copied().unwrap_or((Force::ZERO, R::Vec3::ZERO));
        let own = body.bc.transpose_mul(along);
        row += body.force(Motion::ZERO, along);
        couple += own + own;
        let before = before.get(i).copied().unwrap_or(Motion::ZERO);
        for (place, k) in body.link.coordinates().enumerate() {
            let column = columns.get(k).copied().unwrap_or_default();
            let mut inward = body.force(column.s_rate, column.s_accel);
            inward += column.s.cross_force(body.fc);
            let of_row = |rate: Motion<R>, accel: Motion<R>| couple.dot(rate.ang) + accel.dot(row);
            let (x_k, at) = (entry(x, k), (&body.link, &turns[..]));
            let slope = joint_slopes(effects, at, state, k, |j, by| add(&mut by_q, j, by * x_k));
            let of_q = of_row(column.s_rate, column.s_accel) + before.dot(inward);
            let of_qd =
                of_row(column.s, column.s_rates) + before.dot(body.force(column.s, column.s_rates));
            add(&mut by_q, k, of_q);
            add(&mut by_qd, k, of_qd + slope * x_k);
            if let Some(bend) = body.link.bend(turns, place) {
                let first = entry(x, body.link.idx_v());
                add(&mut by_q, k, bend.column.dot(body.fc) * first);
            }
        }
        if let Some((row_there, couple_there)) = rows.get_mut(body.link.parent) {
            *row_there += body.x.transpose_mul(row);
            *couple_there += body.x.rot.transpose_mul(couple);
        }
    }
    [by_q, by_qd]
}

#[cfg_attr(optimised, inline(always))]
fn add<R: Real, const V: usize>(values: &mut [R; V], k: usize, more: R) {
    if let Some(value) = values.get_mut(k) {
        *value += more;
    }
}
