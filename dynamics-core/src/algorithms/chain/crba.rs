//! The joint-space inertia matrix of a chain of joints with one coordinate each.
//!
//! [`crba`](crate::algorithms::crba()) where nothing branches: one composite inertia runs from the tip to the base, and row i of M is the
//! force of joint i's unit acceleration on it, carried down to the base. Links are visited anew rather than stored.

use heapless::Vec;

use crate::algorithms::MassMatrix;
use crate::effects::{Declared, Effect, add_inertia, body_inertia, rotor_force};
use crate::model::{LinkView, RobotModel};
use crate::scalar::Real;
use crate::spatial::inertia::CompositeInertia;
use crate::state::JointTrig;

/// M of a chain: `D::CHAIN` and `D::SINGLE` hold.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(in crate::algorithms) fn sweep<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    effects: &E,
) -> MassMatrix<R, V>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let turns = &trig.coordinates;
    let mut rotations: Vec<R::Mat3, V> = Vec::new();
    for link in robot.links() {
        let _ = rotations.push(link.xform(turns).rot);
    }
    let composite = |i, link: &LinkView<'_, R>, beyond| {
        let mut ic = CompositeInertia::from(body_inertia(effects, i, link));
        if let Some(beyond) = beyond {
            ic += beyond;
        }
        ic
    };

    let mut m = MassMatrix::ZERO;
    let mut beyond = None;
    for i in (1..V).rev() {
        let (Some(link), Some(rot), Some(row)) =
            (robot.link(i), rotations.get(i), m.rows.get_mut(i))
        else {
            continue;
        };
        let mut x = link.xform_of(*rot, turns);
        let ic = composite(i, &link, beyond);
        beyond = Some(ic.at_parent(&x));
        let s = link.subspace(turns, 0);
        let mut f = ic.along(&s);
        if let Some(diagonal) = row.get_mut(i) {
            *diagonal = s.dot(f);
            add_inertia(effects, i, diagonal);
        }
        if E::GYROSCOPIC_ROTORS {
            f += rotor_force(effects, &link);
        }
        for l in (1..i).rev() {
            let (Some(ancestor), Some(rot), Some(entry)) =
                (robot.link(l), rotations.get(l), row.get_mut(l))
            else {
                continue;
            };
            f = x.transpose_mul(f);
            *entry = ancestor.subspace(turns, 0).dot(f);
            x = ancestor.xform_of(*rot, turns);
        }
        // Of the force on the first link only one component is computed.
        if let (Some(first), Some(entry)) = (robot.link(0), row.first_mut()) {
            *entry = first.subspace(turns, 0).dot(x.transpose_mul(f));
        }
    }
    if let (Some(first), Some(diagonal)) = (robot.link(0), m.diagonal_mut(0)) {
        let s = first.subspace(turns, 0);
        *diagonal = s.dot(composite(0, &first, beyond).along(&s));
        add_inertia(effects, 0, diagonal);
    }
    m.mirrored()
}
