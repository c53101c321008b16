//! The Coriolis matrix C(q, q̇), from composite inertias and their rates.
//!
//! Echeandia & Wensing, "Numerical methods to compute the Coriolis matrix and Christoffel symbols
//! for rigid-body systems" (2021). As in the composite-rigid-body algorithm, the force of a column
//! is projected on the joints between its body and the base.

use core::borrow::Borrow;

use heapless::Vec;

use super::tree_pass::{inward, per_body};
use crate::effects::{Declared, Effect, base_given, body_inertia, rotor_force};
use crate::model::{LinkView, RobotModel};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::inertia::CompositeInertia;
use crate::spatial::{BodyCoriolis, Force, Motion, MotionSubspace, Xform};
use crate::state::{Configuration, RobotState, entry};

/// The results of the outward pass for the inward one.
struct Body<'a, R: Real> {
    link: LinkView<'a, R>,
    x: Xform<R>,
    v: Motion<R>,
    ic: CompositeInertia<R>,
    bc: BodyCoriolis<R>,
}

/// The Coriolis matrix C(q, q̇), by rows: N·m·s/rad between revolute joints, N·s/m between
/// prismatic ones.
///
/// With the composite inertias Iᶜ, their Coriolis matrices Bᶜ (see
/// [`rnea_two_velocities`](crate::algorithms::rnea_two_velocities())) and Ṡ_i = S̊_i + v_i × S_i:
///
/// ```text
/// C_ij = S_iᵀ ʲX_iᵀ (Iᶜ_j Ṡ_j + Bᶜ_j S_j)
/// C_ji = S_jᵀ (Iᶜ_j ʲX_i Ṡ_i + Bᶜ_j ʲX_i S_i)
/// ```
///
/// where joint i is joint j or one of its ancestors. For joints of every kind
///
/// - C q̇ is the vector of velocity products, [`rnea`](crate::algorithms::rnea()) under
///   [`Coriolis`](crate::effects::Coriolis);
/// - Ṁ = C + Cᵀ, so that Ṁ − 2 C is antisymmetric; Cᵀ q̇ is that of
///   [`momentum_and_coriolis`](crate::algorithms::momentum_and_coriolis());
/// - C(q, x) y − C(q, y) x = M b, M without armatures, where b is zero but at spherical, planar and
///   free joints, whose q̇ is not a derivative of q. There b is the vector with S b = S x × S y: x
///   × y at a spherical joint.
///
/// If q̇ is the derivative of q, C is thus the matrix of the Christoffel symbols:
/// C_ij = ½ Σ_k (∂_k M_ij + ∂_j M_ik − ∂_i M_jk) q̇_k.
///
/// M is that of [`crba`](crate::algorithms::crba()) under the same effects; of these, payloads,
/// rotors and a base of given motion are part of C. A non-finite input gives a non-finite output.
/// For the product with one vector,
/// [`rnea_two_velocities`](crate::algorithms::rnea_two_velocities()) is faster.
///
/// # Shape
/// V × V, not symmetric; an entry between joints of which neither is an ancestor of the other is
/// exactly zero.
///
/// # Cost
/// For B revolute joints some 600 B flops, and 110 for each pair of a joint and its ancestor: B² /
/// 2 pairs on a chain.
///
/// # Source
/// Echeandia & Wensing (2021).
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{coriolis_matrix, rnea};
/// use dynamics_core::{effects::Coriolis, model::Robot, robots::Ur5e, state::State};
/// let qd = [0.5, -1.0, 2.0, 0.3, 0.0, 1.0];
/// let state = State { qd, ..State::at([0.0_f64, -1.2, 1.5, 0.3, 0.7, 0.0]) };
/// let c = coriolis_matrix(&Ur5e::MODEL, &state, &());
/// for (row, c_qd) in c.iter().zip(rnea(&Ur5e::MODEL, &state, &(Coriolis,))) {
///     assert!((row.iter().zip(qd).map(|(c, qd)| c * qd).sum::<f64>() - c_qd).abs() < 1e-13);
/// }
/// ```
#[doc(alias = "Christoffel symbols")]
#[doc(alias = "computeCoriolisMatrix")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn coriolis_matrix<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
) -> [[R; V]; V]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let (turns, qd) = (&trig.coordinates, &state.qd);
    let mut velocities = per_body(robot, base_given(effects).0);
    let mut bodies: Vec<Body<'_, R>, B> = Vec::new();
    for (i, link) in robot.links().enumerate() {
        let x = link.xform(turns);
        let v = link.plus_motion(x * velocities.parent(&link), turns, qd);
        let inertia = body_inertia(effects, i, &link);
        let (ic, bc) = (inertia.into(), BodyCoriolis::new(&inertia, v));
        velocities.push(v);
        let _ = bodies.push(Body { link, x, v, ic, bc });
    }

    let mut c = [[R::ZERO; V]; V];
    let mut put = |i: usize, j: usize, value: R| {
        if let Some(entry) = c.get_mut(i).and_then(|row| row.get_mut(j)) {
            *entry = value;
        }
    };
    let mut pass = inward(&mut bodies);
    while let Some((body, inner)) = pass.next() {
        let rotor = rotor_force(effects, &body.link);
        if let Some(parent) = inner.get_mut(body.link.parent) {
            parent.ic += body.ic.at_parent(&body.x);
            parent.bc += body.bc.at_parent(&body.x);
            if E::GYROSCOPIC_ROTORS {
                let h = rotor.ang * entry(qd, body.link.idx_v());
                parent.bc.add_rotor(body.x.rot.transpose_mul(h));
            }
        }
        for (k, j) in body.link.coordinates().enumerate() {
            let s = body.link.column(turns, k);
            let s_rate = body.link.column_rate(turns, qd, body.v, k);
            // Iᶜ Ṡ + Bᶜ S of column j; Iᶜ S and the couple Bᶜᵀ S of row j.
            let mut column = body.ic.along(&MotionSubspace::General(s_rate)) + body.bc * s;
            let mut row = body.ic.along(&body.link.subspace(turns, k));
            let mut row_couple = body.bc.transpose_mul(s);
            for (l, i) in body.link.coordinates().enumerate() {
                put(i, j, body.link.subspace(turns, l).dot(column));
            }
            if E::GYROSCOPIC_ROTORS {
                let half = body.v.ang.cross(rotor.ang) * R::from_f64(0.5);
                column.ang += half;
                row += rotor;
                row_couple += half;
            }
            let mut child = &*body;
            while let Some(parent) = inner.get(child.link.parent) {
                column = child.x.transpose_mul(column);
                row = child.x.transpose_mul(row);
                row_couple = child.x.rot.transpose_mul(row_couple);
                for (l, i) in parent.link.coordinates().enumerate() {
                    let s = parent.link.subspace(turns, l);
                    let s_rate = parent.link.column_rate(turns, qd, parent.v, l);
                    put(i, j, s.dot(column));
                    let couple = Force::new(row_couple, R::Vec3::ZERO);
                    put(j, i, s_rate.dot(row) + s.dot(couple));
                }
                child = parent;
            }
        }
    }
    c
}
