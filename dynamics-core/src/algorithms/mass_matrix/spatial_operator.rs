//! M⁻¹ and the factors of M by the spatial operators of articulated bodies, computed independently.
//!
//! Rodriguez, Jain & Kreutz-Delgado (1991, 1992):
//!
//! ```text
//! M   = (1 + H Φ K) D (1 + H Φ K)ᵀ
//! M⁻¹ = (1 − H Ψ K)ᵀ D⁻¹ (1 − H Ψ K)
//! ```
//!
//! H projects on the joints; K = U/D of a joint, at its parent; Φ transmits forces inward as
//! through rigid bodies, Ψ as through joints that move freely. The first factor is Lᵀ of RBDA's
//! section 6.5.

use core::borrow::Borrow;

use crate::algorithms::NotPositiveDefinite;
use crate::algorithms::articulated_pass::{ArticulatedPass, JointFactor, eliminate};
use crate::algorithms::{Ltdl, MassMatrix};
use crate::effects::Effect;
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::spatial::Force;
use crate::state::{Configuration, entry};

/// The factors L = (1 + HΦK)ᵀ and D of M(q), without M: the same as those of
/// [`ltdl`](crate::algorithms::ltdl()).
///
/// ```text
/// M = Lᵀ D L = (1 + H Φ K) D (1 + H Φ K)ᵀ
/// ```
///
/// H projects on the joints; K = U/D of a joint, at its parent; Φ transmits forces inward as
/// through rigid bodies.
///
/// # Shape
/// V × V and V.
///
/// # Cost
/// The inertias of the articulated-body algorithm, and 40 flops for each pair of a joint and its
/// ancestor.
///
/// # Source
/// Rodriguez, Jain & Kreutz-Delgado (1991).
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{crba, spatial_operator_ltdl, solve};
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e};
/// let q = [0.0, -1.2, 1.5, 0.3, 0.0, 0.0];
/// let x = solve(&Ur5e::MODEL, &spatial_operator_ltdl(&Ur5e::MODEL, &q, &RIGID_BODY)?, &[1.0; 6]);
/// let tau = crba(&Ur5e::MODEL, &q, &RIGID_BODY).mul_vec(&x);
/// assert!(tau.iter().all(|tau| (tau - 1.0).abs() < 1e-12));
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// # Errors
/// [`NotPositiveDefinite`] names a coordinate that moves no inertia, as
/// [`aba`](crate::algorithms::aba()) does.
#[doc(alias = "innovations factorisation")]
#[cfg_attr(optimised, inline(always))]
pub fn spatial_operator_ltdl<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &impl Configuration<R, Q>,
    effects: &E,
) -> Result<Ltdl<R, V>, NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    columns(robot, q, effects, |f, _, _| f)
}

/// The inverse M⁻¹, without M and without its elimination.
///
/// ```text
/// M⁻¹ = (1 − H Ψ K)ᵀ D⁻¹ (1 − H Ψ K)
/// ```
///
/// H and K are those of [`spatial_operator_ltdl`]; Ψ transmits forces inward as through joints that
/// move freely.
///
/// # Shape
/// V × V.
///
/// # Cost
/// The cost of [`spatial_operator_ltdl`], and O(V³) for the product.
///
/// # Source
/// Rodriguez, Jain & Kreutz-Delgado (1992).
///
/// # Errors
/// As [`spatial_operator_ltdl`].
#[cfg_attr(optimised, inline(always))]
pub fn spatial_operator_inverse<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &impl Configuration<R, Q>,
    effects: &E,
) -> Result<MassMatrix<R, V>, NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    // A joint that moves freely removes its part: ψ = φ − K H φ.
    let factor = columns(robot, q, effects, |f, projected, k| f - k * projected)?;
    let w = |a: usize, i: usize| match factor.rows.get(a).and_then(|row| row.get(i)) {
        _ if a == i => R::ONE,
        Some(&hpk) if i < a => -hpk,
        _ => R::ZERO,
    };
    let mut m_inv = MassMatrix::ZERO;
    for a in 0..V {
        for b in 0..=a {
            let terms = (0..=b).map(|i| w(a, i) * w(b, i) * entry(&factor.d_inv, i));
            m_inv.set(a, b, terms.fold(R::ZERO, |sum, term| sum + term));
        }
    }
    Ok(m_inv)
}

/// H (Φ or Ψ) K by rows of joints, and D⁻¹: K of each joint, projected on its ancestors; `pass` is
/// the force that a joint transmits inward, given the force's projection on the joint and its own
/// K.
#[cfg_attr(optimised, inline(always))]
fn columns<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &impl Configuration<R, Q>,
    effects: &E,
    pass: impl Fn(Force<R>, R, Force<R>) -> Force<R>,
) -> Result<Ltdl<R, V>, NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = q.trig_of(robot);
    let turns = &trig.borrow().coordinates;
    let ArticulatedPass { x, factors } = eliminate(robot, turns, effects)?;
    let gain = |joint| {
        let factor: JointFactor<R> = entry(&factors, joint);
        factor.u_a * factor.d_inv
    };

    let mut rows = [[R::ZERO; V]; V];
    for (i, link) in robot.links().enumerate() {
        for joint in link.coordinates() {
            let (mut f, mut at) = (gain(joint), i);
            while let (Some(link), Some(x)) = (robot.link(at), x.get(at)) {
                for (k, ancestor) in link.coordinates().enumerate().rev() {
                    if ancestor >= joint {
                        continue; // itself, and what it carries on the same body
                    }
                    let projected = link.subspace(turns, k).dot(f);
                    f = pass(f, projected, gain(ancestor));
                    if let Some(entry) = rows.get_mut(joint).and_then(|row| row.get_mut(ancestor)) {
                        *entry = projected;
                    }
                }
                (f, at) = (x.transpose_mul(f), link.parent);
            }
        }
    }
    let d_inv = factors.map(|factor| factor.d_inv);
    Ok(Ltdl { rows, d_inv })
}
