//! The checks of a link's modes, while compiling.

use glam::DMat3;

use super::link::{FlexibleLink, MODES_PER_LINK, ModeProblem};
use crate::math::const_eval::{mul, mul_vec, transpose};
use crate::spatial::SpatialInertia;

/// Rigid motions and modes.
const ALL: usize = 6 + MODES_PER_LINK;
/// A pivot is positive where it is more than this part of its diagonal.
const LEAST: f64 = 1e-10;

/// The first mode that cannot be used, and why. The inertia is that of the rigid body about its
/// joint, in the frame that `frame` turns to from the link's.
pub(super) const fn problem(
    link: &FlexibleLink,
    body: &SpatialInertia<f64>,
    frame: &DMat3,
) -> Option<(usize, ModeProblem)> {
    if link.count > MODES_PER_LINK {
        return Some((MODES_PER_LINK, ModeProblem::Count));
    }
    let (mut inertia, mut k) = (rigid(body, frame), 0);
    while k < link.count {
        if !is_finite(link, k) {
            return Some((k, ModeProblem::NotFinite));
        }
        let mode = &link.modes[k];
        // ∫ r × φ dm, the antisymmetric part of ∫ φ rᵀ dm.
        let [[_, xy, xz], [yx, _, yz], [zx, zy, _]] = mode.moments;
        let [x, y, z] = mode.momentum;
        let column = [zy - yz, xz - zx, yx - xy, x, y, z];
        let mut i = 0;
        while i < ALL {
            let entry = if i < 6 {
                column[i]
            } else if i - 6 < link.count {
                let [[xx, _, _], [_, yy, _], [_, _, zz]] = link.products[k][i - 6];
                xx + yy + zz
            } else {
                0.0
            };
            inertia[6 + k][i] = entry;
            inertia[i][6 + k] = entry;
            i += 1;
        }
        if inertia[6 + k][6 + k] <= 0.0 {
            return Some((k, ModeProblem::NoMass));
        }
        k += 1;
    }
    let last = 6 + link.count;
    if let Some(k) = not_transposed(link, &inertia) {
        return Some((k, ModeProblem::Inertia));
    }
    if let Some(k) = not_positive(&inertia, 6, last, 0) {
        return Some((k - 6, ModeProblem::Inertia));
    }
    if let Some(k) = not_positive(&inertia, 0, last, 6) {
        return Some((k - 6, ModeProblem::RigidMotion));
    }
    let (mut stiffness, mut k) = ([[0.0; ALL]; ALL], 0);
    while k < link.count {
        let mut l = 0;
        while l < link.count {
            stiffness[k][l] = link.stiffness[k][l];
            if link.stiffness[k][l] != link.stiffness[l][k] {
                return Some((k, ModeProblem::Stiffness));
            }
            if link.damping[k][l] != link.damping[l][k] {
                return Some((k, ModeProblem::Damping));
            }
            l += 1;
        }
        if stiffness[k][k] <= 0.0 {
            return Some((k, ModeProblem::Stiffness));
        }
        if link.damping[k][k] < 0.0 {
            return Some((k, ModeProblem::Damping));
        }
        k += 1;
    }
    match not_positive(&stiffness, 0, link.count, 0) {
        Some(k) => Some((k, ModeProblem::Stiffness)),
        None => None,
    }
}

/// The inertia of the rigid motions, angular and linear, in the link's frame.
const fn rigid(body: &SpatialInertia<f64>, frame: &DMat3) -> [[f64; ALL]; ALL] {
    let i = mul(&mul(&transpose(frame), &body.rotational), frame);
    let h = mul_vec(&transpose(frame), body.first_moment);
    let (rows, cross) =
        ([i.x_axis, i.y_axis, i.z_axis], [[0.0, -h.z, h.y], [h.z, 0.0, -h.x], [-h.y, h.x, 0.0]]);
    let (mut inertia, mut k) = ([[0.0; ALL]; ALL], 0);
    while k < 9 {
        let (row, column) = (k / 3, k % 3);
        inertia[row][column] = [rows[row].x, rows[row].y, rows[row].z][column];
        inertia[row][3 + column] = cross[row][column];
        inertia[3 + column][row] = cross[row][column];
        k += 1;
    }
    k = 3;
    while k < 6 {
        inertia[k][k] = body.mass;
        k += 1;
    }
    inertia
}

/// The first row from `first` to `last` whose pivot is not positive after those before it. The
/// first `rigid` rows, motions that may move no inertia, such as the rotation of a line about
/// itself, are then left out.
const fn not_positive(
    matrix: &[[f64; ALL]; ALL],
    first: usize,
    last: usize,
    rigid: usize,
) -> Option<usize> {
    let (mut a, mut k) = (*matrix, first);
    while k < last {
        let pivot = a[k][k];
        if pivot > LEAST * matrix[k][k] && matrix[k][k] > 0.0 {
            let mut i = k + 1;
            while i < last {
                let factor = a[i][k] / pivot;
                let mut j = k + 1;
                while j < last {
                    a[i][j] -= factor * a[k][j];
                    j += 1;
                }
                i += 1;
            }
        } else if k >= rigid {
            return Some(k);
        }
        k += 1;
    }
    None
}

/// The first mode k of which ∫ φₖ φₗᵀ dm is not the transpose of ∫ φₗ φₖᵀ dm.
const fn not_transposed(link: &FlexibleLink, inertia: &[[f64; ALL]; ALL]) -> Option<usize> {
    let mut k = 0;
    while k < link.count {
        let (mut l, scale) = (0, inertia[6 + k][6 + k]);
        while l <= k {
            let most = LEAST * (scale + inertia[6 + l][6 + l]);
            let mut i = 0;
            while i < 9 {
                let apart = link.products[k][l][i / 3][i % 3] - link.products[l][k][i % 3][i / 3];
                if apart > most || -apart > most {
                    return Some(k);
                }
                i += 1;
            }
            l += 1;
        }
        k += 1;
    }
    None
}

/// Whether every number of a mode is finite: 0 · x is zero of finite numbers alone.
pub(super) const fn is_finite(link: &FlexibleLink, k: usize) -> bool {
    let (mode, mut sum, mut i) = (&link.modes[k], 0.0, 0);
    while i < 3 {
        sum += 0.0 * (mode.momentum[i] + mode.shift[i] + mode.turn[i] + link.end[i]);
        sum += 0.0 * (mode.moments[i][0] + mode.moments[i][1] + mode.moments[i][2]);
        let mut l = 0;
        while l < link.count {
            let row = &link.products[k][l][i];
            sum += 0.0 * (row[0] + row[1] + row[2]);
            sum += 0.0 * (link.stiffness[k][l] + link.damping[k][l]);
            l += 1;
        }
        i += 1;
    }
    sum == 0.0
}
