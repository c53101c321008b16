//! The joint-space inertia matrix of a chain of joints with one coordinate each.
//!
//! [`crba`](crate::algorithms::crba()) where nothing branches: one composite inertia runs from the
//! tip to the base, and row i of M is the force of joint i's unit acceleration on it, carried down
//! to the base. Links are visited anew rather than stored, and crossed by two screws if they are
//! placed by Denavit & Hartenberg's parameters, as in [`aba`](super::aba()).

use heapless::Vec;

use super::across::Across;
use crate::algorithms::MassMatrix;
use crate::algorithms::mass_matrix::UNROLLED;
use crate::effects::{Declared, Effect, add_inertia, body_inertia, rotor_force};
use crate::model::{LinkView, RobotModel};
use crate::scalar::Real;
use crate::spatial::inertia::CompositeInertia;
use crate::spatial::{AxialScrews, Xform};
use crate::state::JointTrig;

/// M of a chain: `D::CHAIN` and `D::SINGLE` hold.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn crba<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    effects: &E,
) -> MassMatrix<R, V>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    // Asking two or three links takes more cycles than they give back.
    if const { D::KINDS.are_revolute() && V > 3 && !matches!(D::SCREWS, Some(false)) }
        && robot.has_screws()
    {
        sweep::<AxialScrews<R>, _, _, _, B, Q, V>(robot, trig, effects)
    } else {
        sweep::<Xform<R>, _, _, _, B, Q, V>(robot, trig, effects)
    }
}

/// The two passes, with the transforms across links in the form X.
#[cfg_attr(optimised, inline(always))]
fn sweep<X, R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    effects: &E,
) -> MassMatrix<R, V>
where
    X: Across<R>,
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let turns = &trig.coordinates;
    let mut kept: Vec<X::Memo, V> = Vec::new();
    for link in robot.links() {
        let _ = kept.push(X::of(&link, turns).memo());
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
        let (Some(link), Some(x), Some(row)) = (robot.link(i), kept.get(i), m.rows.get_mut(i))
        else {
            continue;
        };
        let mut x = X::again(*x, &link, turns);
        let ic = composite(i, &link, beyond);
        beyond = Some(x.composite_back(&ic));
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
            let (Some(ancestor), Some(next), Some(entry)) =
                (robot.link(l), kept.get(l), row.get_mut(l))
            else {
                continue;
            };
            f = x.force_back(f);
            *entry = ancestor.subspace(turns, 0).dot(f);
            x = X::again(*next, &ancestor, turns);
        }
        // Only one component of the force on the first link is computed.
        if let (Some(first), Some(entry)) = (robot.link(0), row.first_mut()) {
            *entry = first.subspace(turns, 0).dot(x.force_back(f));
        }
    }
    if let (Some(first), Some(diagonal)) = (robot.link(0), m.diagonal_mut(0)) {
        let s = first.subspace(turns, 0);
        *diagonal = s.dot(composite(0, &first, beyond).along(&s));
        add_inertia(effects, 0, diagonal);
    }
    if V > UNROLLED {
        m.mirror();
        return m; // and not m.mirrored(), which copies it
    }
    m.mirrored()
}
