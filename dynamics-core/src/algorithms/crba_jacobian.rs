//! M and a Jacobian together: the modified composite-rigid-body method.
//!
//! Lilly & Orin, "Alternate formulations for the manipulator inertia matrix" (1991). As
//! [`crba`](super::crba()), but the joints' axes are transformed outward to the tips instead of a
//! force inward to the base: in a body's frame they are its Jacobian, and M_jk is the scalar
//! product of its column k and the force that accelerates the composite body of joint j.

use core::borrow::Borrow;

use heapless::Vec;

use super::mass_matrix::parent;
use super::tree_pass::{inward, per_body};
use crate::algorithms::MassMatrix;
use crate::effects::{Declared, Effect, add_inertia, body_inertia, rotor_force};
use crate::model::{BASE, LinkView, RobotModel};
use crate::scalar::{Matrix, Real};
use crate::spatial::inertia::CompositeInertia;
use crate::spatial::{Motion, Xform};
use crate::state::Configuration;

/// The results of the outward pass for the others.
struct Body<'a, R: Real> {
    link: LinkView<'a, R>,
    x: Xform<R>,
    ic: CompositeInertia<R>,
}

/// The inertia matrix M(q), and the Jacobian of one body at its origin and along its own axes.
///
/// Column k of the Jacobian is the velocity of the body at unit rate of coordinate k.
///
/// ```text
/// J_k = ᵇX_k S_k      M_jk = (ʲX_k S_k)ᵀ Iᶜ_j S_j
/// ```
///
/// # Shape
/// V × V and 6 × V. The Jacobian of the base is zero, that of a body that the robot does not have
/// NaN.
///
/// # Cost
/// The cost of [`crba`](super::crba()), of which the Jacobian is a by-product.
///
/// # Source
/// Lilly & Orin (1991).
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{crba, crba_jacobian};
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e};
/// let q = [0.0, -1.2, 1.5, 0.3, 0.0, 0.0];
/// let (m, jacobian) = crba_jacobian(&Ur5e::MODEL, &q, 5, &RIGID_BODY);
/// assert!((m.get(0, 1) - crba(&Ur5e::MODEL, &q, &RIGID_BODY).get(0, 1)).abs() < 1e-15);
/// assert_eq!(jacobian[5].lin.length(), 0.0); // the last joint does not move its own origin
/// ```
#[doc(alias = "modified composite-rigid-body method")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn crba_jacobian<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &impl Configuration<R, Q>,
    body: usize,
    effects: &E,
) -> (MassMatrix<R, V>, [Motion<R>; V])
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = q.trig_of(robot);
    let trig = trig.borrow();
    let (turns, lambda) = (&trig.coordinates, &robot.model().lambda);
    let mut bodies: Vec<Body<'_, R>, B> = Vec::new();
    for (i, link) in robot.links().enumerate() {
        let ic = body_inertia(effects, i, &link).into();
        let x = link.xform(turns);
        let _ = bodies.push(Body { link, x, ic });
    }
    let mut pass = inward(&mut bodies);
    while let Some((body, inner)) = pass.next() {
        if let Some(parent) = inner.get_mut(body.link.parent) {
            parent.ic += body.ic.at_parent(&body.x);
        }
    }

    let (mut m, mut wanted) = (MassMatrix::ZERO, [Motion::ZERO; V]);
    // For each body, the last coordinate that moves it, and its Jacobian.
    let mut jacobians = per_body(robot, (BASE, [Motion::ZERO; V]));
    for (i, Body { link, x, ic }) in bodies.iter().enumerate() {
        let (mut last, mut jacobian) = jacobians.parent(link);
        let mut k = last;
        while let Some(column) = jacobian.get_mut(k) {
            *column = *x * *column;
            k = parent(lambda, k);
        }
        for (k, joint) in link.coordinates().enumerate() {
            if let Some(column) = jacobian.get_mut(joint) {
                *column = link.column(turns, k);
            }
            let mut f = ic.along(&link.subspace(turns, k));
            let mut ancestor = joint;
            while let Some(column) = jacobian.get(ancestor) {
                m.set(joint, ancestor, column.dot(f));
                if E::GYROSCOPIC_ROTORS && ancestor == joint {
                    f += rotor_force(effects, link);
                }
                ancestor = parent(lambda, ancestor);
            }
            if let Some(diagonal) = m.diagonal_mut(joint) {
                add_inertia(effects, joint, diagonal);
            }
            last = joint;
        }
        if i == body {
            let turned = |v| link.to_joint_frame.transpose_mul(v);
            wanted = jacobian.map(|column| Motion::new(turned(column.ang), turned(column.lin)));
        }
        jacobians.push((last, jacobian));
    }
    if body >= B && body != BASE {
        wanted = [Motion::nan(); V];
    }
    (m, wanted)
}
