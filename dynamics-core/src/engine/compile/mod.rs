//! The constants of the engine from the description: evaluated at compile time, in f64, from the tips to the base.
//!
//! 1. A fixed body becomes part of its parent.
//! 2. Each frame is rotated until the joint's axis is z, and moved along it until the offset p from the parent is
//!    perpendicular to it ([`tree`]).
//! 3. Entries that miss −1, 0 or 1 by rounding become exact ([`snap`]).
//! 4. Inertias are regrouped to base parameters ([`base_parameters`]).
//! 5. Parameters below the robot's negligible share of torque become zero ([`mod@prune`]).
//! 6. The unit of length becomes a joint offset, so that this offset is 1, and the unit of mass such that Σ keeps its
//!    numbers: p/L, h·L, m·L².

mod base_parameters;
mod prune;
mod remainder;
mod snap;
mod topology;
mod tree;

pub(crate) use remainder::{Distribution, Remainder};
pub(crate) use topology::{
    Compiled, CompiledJoint, CompiledRobot, JointAndBody, JointPair, is_ancestor, is_parent, joint,
    load, loads, place, supports,
};
pub(crate) use tree::{BodyPlacement, CompiledTree, Joint};

use glam::{DMat3, DVec3};

use self::base_parameters::{mat_add, outer, regroup, second_moment};
use self::prune::prune;
use self::snap::{snap_small, snapped};
use self::tree::{AT_BASE, PADDING_JOINT};
use crate::math::const_eval::{add, dot, mul, mul_vec, scale, transpose};
use crate::model::{BASE, JointKind, Model};

const fn compile<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
    negligible: f64,
) -> CompiledTree<B, V> {
    let mut joints = [PADDING_JOINT; V];
    let mut places = [AT_BASE; B];
    let mut i = 0;
    while i < B {
        let link = &model.links[i];
        let parent = if link.parent == BASE {
            AT_BASE
        } else {
            places[link.parent]
        };
        let rot = mul(&parent.rot, &transpose(&link.placement.rot));
        let pos = add(mul_vec(&parent.rot, link.placement.pos), parent.pos);
        if matches!(link.joint.kind, JointKind::Fixed) {
            places[i] = BodyPlacement {
                joint: parent.joint,
                rot,
                pos,
            };
        } else {
            let rot = snapped(&rot);
            let prismatic = match link.joint.kind {
                JointKind::Prismatic => true,
                JointKind::Revolute | JointKind::Continuous => false,
                _ => panic!("the engine takes revolute, prismatic and fixed joints; use `Core`"),
            };
            let slide = -dot(pos, rot.z_axis);
            let joint = &mut joints[link.idx_v];
            joint.parent = parent.joint;
            joint.prismatic = prismatic;
            joint.near = link.limits.within_two_turns();
            joint.rot = rot;
            joint.pos = snap_small(add(pos, scale(rot.z_axis, slide)));
            places[i] = BodyPlacement {
                joint: link.idx_v,
                rot: DMat3::IDENTITY,
                pos: DVec3::new(0.0, 0.0, -slide),
            };
        }
        if places[i].joint != BASE {
            let joint = &mut joints[places[i].joint];
            let (rot, d, mass) = (&places[i].rot, places[i].pos, link.inertia.mass);
            let h = mul_vec(rot, link.inertia.first_moment);
            let second = mul(
                &mul(rot, &second_moment(&link.inertia.rotational)),
                &transpose(rot),
            );
            let second = mat_add(&second, &mat_add(&outer(h, d), &outer(d, h)));
            joint.second = mat_add(&joint.second, &mat_add(&second, &outer(d, scale(d, mass))));
            joint.moment = add(joint.moment, add(h, scale(d, mass)));
            joint.mass += mass;
        }
        i += 1;
    }
    regroup(&mut joints);
    prune(&mut joints, negligible);
    let length = unit_of_length(&joints);
    i = 0;
    while i < V {
        let joint = &mut joints[i];
        joint.pos = divide(joint.pos, length);
        joint.moment = scale(joint.moment, length);
        joint.mass *= length * length;
        i += 1;
    }
    i = 0;
    while i < B {
        // From the aligned frames to those of the description.
        places[i].rot = mul(&places[i].rot, &model.links[i].to_joint_frame);
        places[i].pos = divide(places[i].pos, length);
        i += 1;
    }
    CompiledTree {
        joints,
        places,
        length,
    }
}

/// The offset that occurs most often between two moving joints, or 1 m.
const fn unit_of_length<const V: usize>(joints: &[Joint; V]) -> f64 {
    let (mut best, mut most, mut i) = (1.0, 0, 0);
    while i < 3 * V {
        let length = offset(&joints[i / 3], i % 3);
        let (mut count, mut k) = (0, 0);
        while length != 0.0 && k < 3 * V {
            if offset(&joints[k / 3], k % 3) == length {
                count += 1;
            }
            k += 1;
        }
        if count > most {
            (best, most) = (length, count);
        }
        i += 1;
    }
    best
}

/// v / s, where s/s is exactly one.
const fn divide(v: DVec3, s: f64) -> DVec3 {
    DVec3::new(v.x / s, v.y / s, v.z / s)
}

const fn offset(joint: &Joint, k: usize) -> f64 {
    if joint.parent == BASE || joint.prismatic {
        return 0.0;
    }
    match k {
        0 => joint.pos.x.abs(),
        1 => joint.pos.y.abs(),
        _ => joint.pos.z.abs(),
    }
}
