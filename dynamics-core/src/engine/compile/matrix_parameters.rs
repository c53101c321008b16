//! Base parameters of M, fewer than those of τ: the part of Σ that is the same along x and y goes
//! to the parent.
//!
//! A turn about z does not change diag(a, a, 0), so that in M it may be the parent's, except that
//! it spins with its own joint: M_ii, and the couple along z of column i, have 2a more. In τ it may
//! not, because the velocity products of this spin are not the parent's.

use glam::{DMat3, DVec3};

use super::base_parameters::mat_add;
use super::tree::Joint;
use crate::math::const_eval::{mul, scale, transpose};
use crate::model::BASE;

/// From the last joint to the first, moves what M allows of the second moments that regrouping
/// left.
pub(super) const fn regroup_for_matrix<const V: usize>(joints: &mut [Joint; V]) {
    let mut i = 0;
    while i < V {
        joints[i].matrix_second = joints[i].second;
        i += 1;
    }
    while i > 0 {
        i -= 1;
        let child = joints[i];
        // The axes of a planar, spherical or free joint turn with its body, which keeps its Σ.
        if child.parent == BASE || child.count > 1 {
            continue;
        }
        let second = child.matrix_second;
        let mut moved = second;
        if !child.prismatic {
            // Along the axis of a child, Σ is more than a constant in any case: the other axis
            // becomes zero.
            let a = if children_lie_along_x(joints, i) { second.x_axis.x } else { second.y_axis.y };
            // The entry that the descendants left along z goes on to the parent, too.
            moved = DMat3::from_diagonal(DVec3::new(a, a, second.z_axis.z));
            joints[i].spin = a + a;
        }
        joints[i].matrix_second = mat_add(&second, &negative(&moved));
        let parent = &mut joints[child.parent];
        let added = mul(&mul(&child.rot, &moved), &transpose(&child.rot));
        if parent.parent == BASE && !parent.prismatic {
            // A base at rest leaves one rotation, about z, which depends on Σ_xx + Σ_yy alone.
            parent.matrix_second.x_axis.x += added.x_axis.x + added.y_axis.y;
        } else {
            parent.matrix_second = mat_add(&parent.matrix_second, &added);
        }
    }
}

/// Whether joint `i` has children, all of whose axes lie along x.
const fn children_lie_along_x<const V: usize>(joints: &[Joint; V], i: usize) -> bool {
    let (mut any, mut k) = (false, i + 1);
    while k < V {
        if joints[k].parent == i {
            if joints[k].rot.z_axis.x.abs() != 1.0 {
                return false;
            }
            any = true;
        }
        k += 1;
    }
    any
}

const fn negative(m: &DMat3) -> DMat3 {
    DMat3::from_cols(scale(m.x_axis, -1.0), scale(m.y_axis, -1.0), scale(m.z_axis, -1.0))
}
