//! ∂ID/∂q and ∂ID/∂q̇, from composite inertias, their Coriolis matrices and composite forces.
//!
//! Singh, Russell & Wensing, "Efficient analytical derivatives of rigid-body dynamics using spatial
//! vector algebra" (2022), equations (16) to (23), in link coordinates. As in the Coriolis matrix,
//! the force of a column is projected on the joints between its body and the base.

use core::borrow::Borrow;

use super::outward::{Body, Column, outward};
use super::{joint_slopes, named_derivatives};
use crate::algorithms::tree_pass::inward;
use crate::effects::{Effect, Scene};
use crate::model::{JointCoordinate, RobotModel};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::Motion;
use crate::state::{Configuration, RobotState};

/// The derivatives of inverse dynamics at a state, by rows of τ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorqueGradient<R, const V: usize> {
    /// ∂τ/∂q, N·m/rad between revolute joints, N/m between prismatic ones.
    pub dq: [[R; V]; V],
    /// ∂τ/∂q̇, N·m·s/rad between revolute joints, N·s/m between prismatic ones.
    pub dqd: [[R; V]; V],
}

/// ∂τ/∂q and ∂τ/∂q̇ of inverse dynamics τ = ID(q, q̇, q̈) under the effects of the scene; ∂τ/∂q̈ is
/// M, that of [`crba`](crate::algorithms::crba()).
///
/// With composite inertias Iᶜ, their Coriolis matrices Bᶜ and composite forces fᶜ (which are those
/// of the joints), where joint i is joint j or one of its ancestors:
///
/// ```text
/// ∂τ_j/∂q_i = S_jᵀ (2 Bᶜ_j ʲX_i ψ̇_i + Iᶜ_j ʲX_i ψ̈_i)
/// ∂τ_i/∂q_j = S_iᵀ ʲX_iᵀ (2 Bᶜ_j ψ̇_j + Iᶜ_j ψ̈_j + S_j ×* fᶜ_j)        i ≠ j
/// ∂τ_j/∂q̇_i = S_jᵀ (2 Bᶜ_j ʲX_i S_i + Iᶜ_j ʲX_i (ψ̇_i + Ṡ_i))
/// ∂τ_i/∂q̇_j = S_iᵀ ʲX_iᵀ (2 Bᶜ_j S_j + Iᶜ_j (ψ̇_j + Ṡ_j))
/// ```
///
/// The derivative with respect to q is that along q ⊕ δ of
/// [`integrate`](crate::state::manifold::integrate()) at δ = 0: at a spherical, planar or free
/// joint along its velocities, in the body's frame, which are q̇'s coordinates; elsewhere along q
/// itself.
///
/// Gravity, inertia, velocity products, payloads, armatures and a base of given motion are part of
/// it, and joint torques by the derivatives that an effect names ([`Effect::slopes`]). A scene with
/// an effect that names none, such as wrenches on bodies, does not compile unless the scene says
/// that it counts as constant ([`Frozen`](crate::effects::Frozen)); nor do rotors that spin as
/// bodies and friction of loaded gears. A non-finite input gives a non-finite output.
///
/// # Shape
/// Two of V × V, not symmetric; an entry between joints of which neither is an ancestor of the
/// other is exactly zero.
///
/// # Cost
/// For B revolute joints some 800 B flops, and 190 for each pair of a joint and its ancestor: B² /
/// 2 pairs on a chain.
///
/// # Source
/// Singh, Russell & Wensing (2022); the universal joint, whose S depends on q, by differentiation.
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{rnea, rnea_derivatives};
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// let qd = [0.5, -1.0, 2.0, 0.3, 0.0, 1.0];
/// let mut state = State { qd, ..State::at([0.0_f64, -1.2, 1.5, 0.3, 0.7, 0.0]) };
/// let gradient = rnea_derivatives(&Ur5e::MODEL, &state, &RIGID_BODY);
/// let before = rnea(&Ur5e::MODEL, &state, &RIGID_BODY);
/// state.q[2] += 1e-6;
/// let after = rnea(&Ur5e::MODEL, &state, &RIGID_BODY);
/// for (row, (a, b)) in gradient.dq.iter().zip(after.iter().zip(before)) {
///     assert!(((a - b) / 1e-6 - row[2]).abs() < 1e-3);
/// }
/// ```
///
/// An effect that names no derivatives:
///
/// ```compile_fail,E0080
/// use dynamics_core::algorithms::rnea_derivatives;
/// use dynamics_core::effects::{Effect, JointState, RIGID_BODY};
/// use dynamics_core::{model::Robot, robots::Ur5e, state::State};
/// struct Drag;
/// impl<const B: usize, const V: usize> Effect<f64, B, V> for Drag {
///     fn torque(&self, _: usize, at: JointState<f64>, tau: &mut f64) {
///         *tau += at.qd * at.qd.abs();
///     }
/// }
/// let _ = rnea_derivatives(&Ur5e::MODEL, &State::at([0.0; 6]), &(RIGID_BODY, Drag));
/// // error: an effect of the scene has no derivatives: `Frozen(effect)` counts it as constant, and ..
/// ```
#[doc(alias = "computeRNEADerivatives")]
#[doc(alias = "inverse dynamics derivatives")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn rnea_derivatives<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
) -> TorqueGradient<R, V>
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

    let mut gradient = TorqueGradient { dq: [[R::ZERO; V]; V], dqd: [[R::ZERO; V]; V] };
    let mut pass = inward(&mut bodies);
    while let Some((body, inner)) = pass.next() {
        body.add_to(inner);
        for (k, j) in body.link.coordinates().enumerate() {
            gradient.pair_up(body, inner, (k, j), &columns, turns);
        }
        for k in body.link.coordinates() {
            let at = (&body.link, &turns[..]);
            let by_qd = joint_slopes(effects, at, state, k, |j, by_q| {
                gradient.add(k, j, [by_q, R::ZERO]);
            });
            gradient.add(k, k, [R::ZERO, by_qd]);
        }
    }
    gradient
}

impl<R: Real, const V: usize> TorqueGradient<R, V> {
    /// The entries of coordinate k of a body, number j of the robot, with those of the body itself
    /// and of the bodies `inner` to it.
    #[cfg_attr(optimised, inline(always))]
    fn pair_up(
        &mut self,
        body: &Body<'_, R>,
        inner: &[Body<'_, R>],
        (k, j): (usize, usize),
        columns: &[Column<R>; V],
        turns: &[JointCoordinate<R>],
    ) {
        let Some(own) = columns.get(j) else {
            return;
        };
        // The forces of column j; the forces Iᶜ S and 2 Bᶜᵀ S of row j, the latter a couple.
        let mut by_q = body.force(own.s_rate, own.s_accel);
        let mut by_qd = body.force(own.s, own.s_rates);
        let mut row = body.ic.along(&body.link.subspace(turns, k));
        let mut couple = body.bc.transpose_mul(own.s);
        couple += couple;
        for (l, i) in body.link.coordinates().enumerate() {
            let s = body.link.subspace(turns, l);
            self.put(i, j, [s.dot(by_q), s.dot(by_qd)]);
        }
        if let Some(bend) = body.link.bend(turns, k) {
            self.add(body.link.idx_v(), j, [bend.column.dot(body.fc), R::ZERO]);
        }
        by_q += own.s.cross_force(body.fc);
        let mut child = body;
        while let Some(parent) = inner.get(child.link.parent) {
            by_q = child.x.transpose_mul(by_q);
            by_qd = child.x.transpose_mul(by_qd);
            row = child.x.transpose_mul(row);
            couple = child.x.rot.transpose_mul(couple);
            for (l, i) in parent.link.coordinates().enumerate() {
                let Some(other) = columns.get(i) else {
                    continue;
                };
                let s = parent.link.subspace(turns, l);
                self.put(i, j, [s.dot(by_q), s.dot(by_qd)]);
                let of_row =
                    |rate: Motion<R>, accel: Motion<R>| couple.dot(rate.ang) + accel.dot(row);
                let by_row = [of_row(other.s_rate, other.s_accel), of_row(other.s, other.s_rates)];
                self.put(j, i, by_row);
            }
            child = parent;
        }
    }

    #[cfg_attr(optimised, inline(always))]
    fn put(&mut self, i: usize, j: usize, [by_q, by_qd]: [R; 2]) {
        for (matrix, value) in [(&mut self.dq, by_q), (&mut self.dqd, by_qd)] {
            if let Some(entry) = matrix.get_mut(i).and_then(|row| row.get_mut(j)) {
                *entry = value;
            }
        }
    }

    #[cfg_attr(optimised, inline(always))]
    fn add(&mut self, i: usize, j: usize, [by_q, by_qd]: [R; 2]) {
        let [was_q, was_qd] = [&self.dq, &self.dqd].map(|rows| entry_of(rows, i, j));
        self.put(i, j, [was_q + by_q, was_qd + by_qd]);
    }
}

#[cfg_attr(optimised, inline(always))]
fn entry_of<R: Real, const V: usize>(rows: &[[R; V]; V], i: usize, j: usize) -> R {
    rows.get(i).and_then(|row| row.get(j)).copied().unwrap_or(R::ZERO)
}
