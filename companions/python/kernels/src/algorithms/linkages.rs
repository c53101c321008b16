//! The algorithms for robots with linkages: loops that have a closed form.

use dynamics_core::algorithms;
use dynamics_core::model::RobotModel;
use dynamics_core::scalar::Real;
use dynamics_core::state::{JointTrig, all_finite};

use super::*;
use crate::linkages::{Linkages, TreeMotion};
use crate::most_angle;

/// The tree's motion at the y, ẏ and ÿ of a row, of which so many are given, with its sines and
/// cosines.
#[allow(clippy::type_complexity, reason = "a pair")]
fn motion<'a, R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    linkages: &'a Linkages,
    row: &impl Row<R>,
    given: usize,
) -> Result<(TreeMotion<'a, R, Q, V>, JointTrig<R, Q>), Problem>
where
    D: RobotModel<R, B, Q, V>,
{
    let [p, y] = linkages.sizes;
    let part = |input| match input < given {
        true => filled(row, input, y),
        false => [R::ZERO; V],
    };
    let y = filled(row, 0, p);
    linkages.within(&y, most_angle::<R>())?;
    let tree = linkages.motion(&y, &part(1), &part(2))?;
    tree.within(most_angle::<R>())?;
    let mut trig = JointTrig::new(robot, &tree.q);
    for &(at, turn) in &tree.turns {
        trig.coordinates[at] = turn;
    }
    Ok((tree, trig))
}

/// Inverse dynamics of the tree.
#[inline(never)]
fn torques<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    parts: &Parts<R, V>,
) -> [R; V]
where
    D: RobotModel<R, B, Q, V>,
{
    let scene = Scene::<R, V, true, true, true, false>(parts, true);
    algorithms::rnea(robot, trig.with(state), &scene)
}

algorithm! {
    /// q, q̇ and q̈ of the tree, G, and whether a linkage is near a singularity, of y, ẏ and ÿ.
    LinkageMotion<'a> { linkages: &'a Linkages }, none, |this, robot, counts, scene, row| {
        let (tree, _) = motion::<R, D, B, Q, V>(robot, this.linkages, row, 3)?;
        put(row, 0, 0, &tree.q[..counts.q]);
        put(row, 1, 0, &tree.qd[..counts.v]);
        put(row, 2, 0, &tree.qdd[..counts.v]);
        put_rows(row, 3, &tree.g()[..counts.v], this.linkages.sizes[1]);
        row.put(4, 0, if tree.is_singular() { R::ONE } else { R::ZERO });
    }
}

algorithm! {
    /// τ at y, of y, ẏ and ÿ.
    LinkageRnea<'a> { linkages: &'a Linkages }, linked, |this, robot, counts, scene, row| {
        let (tree, trig) = motion::<R, D, B, Q, V>(robot, this.linkages, row, 3)?;
        let state = State { q: tree.q, qd: tree.qd, qdd: tree.qdd };
        let tau = tree.torque(&torques(robot, &trig, &state, parts_of(scene)));
        let tau = &tau[..this.linkages.sizes[1]];
        if !all_finite(tau) {
            return Err(tree.not_finite(tau).into());
        }
        put(row, 0, 0, tau);
    }
}

algorithm! {
    /// ÿ of y, ẏ and τ at y: Gᵀ M G ÿ = τ − Gᵀ ID(γ(y), G ẏ, Ġ ẏ). RBDA (2008), section 8.5.
    LinkageForward<'a> { linkages: &'a Linkages }, linked, |this, robot, counts, scene, row| {
        let count = this.linkages.sizes[1];
        let (tree, trig) = motion::<R, D, B, Q, V>(robot, this.linkages, row, 2)?;
        let state = State { q: tree.q, qd: tree.qd, qdd: tree.qdd };
        let bias = tree.torque(&torques(robot, &trig, &state, parts_of(scene)));
        let mut rest: [R; V] = filled(row, 2, count);
        for (rest, bias) in rest.iter_mut().zip(bias) {
            *rest -= bias;
        }
        let (m, g) = (algorithms::crba(robot, &trig, scene), tree.g());
        let mut of_y = [[R::ZERO; V]; V];
        for k in 0..count {
            let along = std::array::from_fn(|i| g[i][k]);
            of_y[k] = tree.torque(&m.mul_vec(&along));
        }
        let ydd = solved(&mut of_y, rest, count).map_err(|k| this.linkages.without_inertia(k))?;
        if !all_finite(&ydd[..count]) {
            return Err(tree.not_finite(&ydd[..count]).into());
        }
        put(row, 0, 0, &ydd[..count]);
    }
}

/// Rounding errors of a pivot, in those of its diagonal entry: those of the library's factors.
const ROUNDINGS: f64 = 32.0;

/// x with M x = b, M being symmetric and positive definite.
///
/// # Errors
/// The row whose pivot is not positive, beyond what rounding leaves of it.
fn solved<R: Real, const V: usize>(
    m: &mut [[R; V]; V],
    mut x: [R; V],
    count: usize,
) -> Result<[R; V], usize> {
    let sizes: [R; V] = std::array::from_fn(|k| m[k][k]);
    for k in 0..count {
        let (above, below) = m.split_at_mut(k + 1);
        let row = &above[k];
        // False of a NaN, too.
        if !(row[k] > sizes[k] * R::EPSILON * R::from_f64(ROUNDINGS) && row[k].is_finite()) {
            return Err(k);
        }
        for (i, other) in below.iter_mut().enumerate().take(count - k - 1) {
            let factor = other[k] / row[k];
            for j in k + 1..count {
                other[j] -= factor * row[j];
            }
            x[k + 1 + i] -= factor * x[k];
        }
    }
    for k in (0..count).rev() {
        for j in k + 1..count {
            x[k] -= m[k][j] * x[j];
        }
        x[k] = x[k] / m[k][k];
    }
    Ok(x)
}
