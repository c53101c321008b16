//! The constants of the engine from the description: evaluated at compile time, in f64, from the
//! tips to the base.
//!
//! 1. A fixed body becomes part of its parent.
//! 2. A joint becomes one coordinate for each degree of freedom. Each frame is rotated until the
//!    joint's axis is z, and moved along it until the offset p from the parent is perpendicular to
//!    it ([`tree`]).
//! 3. Entries that miss −1, 0 or 1 by rounding become exact ([`snap`]).
//! 4. Inertias are regrouped to base parameters ([`base_parameters`]).
//! 5. Parameters below the robot's negligible share of torque become zero ([`mod@prune`]).
//! 6. Those of M are regrouped further ([`matrix_parameters`]).
//! 7. The unit of length becomes a joint offset, so that this offset is 1, and the unit of mass
//!    such that Σ keeps its numbers: p/L, h·L, m·L².

mod alone;
mod base_parameters;
mod cut;
mod matrix_parameters;
mod prune;
mod remainder;
mod snap;
mod topology;
mod tree;

pub(crate) use base_parameters::{mat_add, outer};
pub(crate) use cut::{Cut, are_whole};
pub(crate) use remainder::{Distribution, Remainder};
pub(crate) use topology::{
    Compiled, CompiledJoint, CompiledRobot, JointAndBody, JointPair, has_subtree_functions,
    is_parent, is_slide_beyond, joint, last, load, loads, place, support, supports,
};
pub(crate) use tree::{BendingTree, BodyPlacement, CompiledTree, Joint, JointMotion, OnEnd};

use glam::{DMat3, DVec3};

use self::alone::inertia_alone;
use self::base_parameters::{regroup, second_moment};
use self::matrix_parameters::regroup_for_matrix;
use self::prune::prune;
use self::snap::{snap_small, snapped};
use self::tree::{AT_BASE, PADDING_JOINT};
use crate::math::const_eval::{add, dot, mul, mul_vec, scale, transpose};
use crate::model::{BASE, JointKind, Link, Model};

const fn compile<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
    negligible: f64,
) -> CompiledTree<B, V> {
    compile_bending(model, negligible, None).tree
}

/// The same of a robot with modes: `ends` has the end of each body that bends, in its aligned
/// frame. On it are the joints of its children, whose places are those from the end. Without modes
/// there are no ends.
pub(crate) const fn compile_bending<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
    negligible: f64,
    ends: Option<&[Option<DVec3>; B]>,
) -> BendingTree<B, V> {
    // Coordinates of modes are in m, and beside them those of joints.
    let in_meters = ends.is_some();
    let ends = match ends {
        Some(ends) => ends,
        None => &[None; B],
    };
    let mut joints = [PADDING_JOINT; V];
    let mut places = [AT_BASE; B];
    let mut bent = [None; V];
    let (mut on_ends, mut is_on_end) = ([OnEnd::NOTHING; V], [false; B]);
    let mut i = 0;
    while i < B {
        let link = &model.links[i];
        let parent = if link.parent == BASE { AT_BASE } else { places[link.parent] };
        let rot = mul(&parent.rot, &transpose(&link.placement.rot));
        let pos = match end_of(ends, link.parent) {
            None => add(mul_vec(&parent.rot, link.placement.pos), parent.pos),
            Some(end) => mul_vec(&parent.rot, apart(link.placement.pos, end)),
        };
        if matches!(link.joint.kind, JointKind::Fixed) {
            places[i] = BodyPlacement { joint: parent.joint, rot, pos };
            is_on_end[i] =
                link.parent < B && (ends[link.parent].is_some() || is_on_end[link.parent]);
        } else {
            places[i] = attach(&mut joints, link, parent.joint, &rot, pos);
        }
        if places[i].joint != BASE {
            let joint = &mut joints[places[i].joint];
            let (rot, d, mass) = (&places[i].rot, places[i].pos, link.inertia.mass);
            let h = mul_vec(rot, link.inertia.first_moment);
            let second = mul(&mul(rot, &second_moment(&link.inertia.rotational)), &transpose(rot));
            let second = mat_add(&second, &mat_add(&outer(h, d), &outer(d, h)));
            let second = mat_add(&second, &outer(d, scale(d, mass)));
            let moment = add(h, scale(d, mass));
            if let (true, Some(end)) = (is_on_end[i], bent[places[i].joint]) {
                // Its mass is a point at the end.
                let on_end = &mut on_ends[places[i].joint];
                on_end.second = mat_add(&on_end.second, &second);
                on_end.moment = add(on_end.moment, moment);
                on_end.mass += mass;
                joint.second = mat_add(&joint.second, &outer(end, scale(end, mass)));
                joint.moment = add(joint.moment, scale(end, mass));
            } else {
                joint.second = mat_add(&joint.second, &second);
                joint.moment = add(joint.moment, moment);
            }
            joint.mass += mass;
            if let Some(end) = ends[i] {
                bent[places[i].joint] = Some(add(mul_vec(rot, end), d));
            }
        }
        i += 1;
    }
    if negligible == 0.0 {
        inertia_alone(&mut joints, &model.links);
    }
    regroup(&mut joints, &bent, &mut on_ends);
    prune(&mut joints, negligible);
    regroup_for_matrix(&mut joints);
    let length = if in_meters { 1.0 } else { unit_of_length(&joints) };
    i = 0;
    while i < V {
        let joint = &mut joints[i];
        joint.pos = divide(joint.pos, length);
        joint.moment = scale(joint.moment, length);
        joint.mass *= length * length;
        joint.pitch /= length;
        i += 1;
    }
    i = 0;
    while i < B {
        // From the aligned frames to those of the description.
        places[i].rot = mul(&places[i].rot, &model.links[i].to_joint_frame);
        places[i].pos = divide(places[i].pos, length);
        i += 1;
    }
    let tree = CompiledTree { joints, places, length };
    BendingTree { tree, on_ends, is_on_end }
}

const fn end_of(ends: &[Option<DVec3>], body: usize) -> Option<DVec3> {
    if body < ends.len() { ends[body] } else { None }
}

/// A place relative to the end of a link; components that are zero up to rounding are zero.
const fn apart(place: DVec3, end: DVec3) -> DVec3 {
    let limit = 4.0 * f64::EPSILON * (end.x.abs() + end.y.abs() + end.z.abs());
    let d = add(place, scale(end, -1.0));
    DVec3::new(
        if d.x.abs() <= limit { 0.0 } else { d.x },
        if d.y.abs() <= limit { 0.0 } else { d.y },
        if d.z.abs() <= limit { 0.0 } else { d.z },
    )
}

/// Writes the coordinates of a joint whose frame is `rot` and `pos` in that of `parent`; returns
/// where its body is.
const fn attach<const V: usize>(
    joints: &mut [Joint; V],
    link: &Link<f64>,
    parent: usize,
    rot: &DMat3,
    pos: DVec3,
) -> BodyPlacement {
    use JointKind::*;
    let (v, q) = (link.idx_v, link.idx_q);
    let single = Joint {
        parent,
        first: v,
        q,
        position: Some(q),
        near: link.joint.kind.coordinates().1 == 1 && link.limits.within_two_turns(),
        rot: snapped(rot),
        pos,
        ..PADDING_JOINT
    };
    let (motion, pitch) = match link.joint.kind {
        Prismatic => (JointMotion::Slide, 0.0),
        Helical => (JointMotion::Screw, link.joint.pitch),
        Planar => return at_once(joints, &single, JointMotion::Planar),
        Spherical => return at_once(joints, &single, JointMotion::Spherical),
        Free => return at_once(joints, &single, JointMotion::Free),
        Revolute | Continuous | Cylindrical | Universal | Fixed => (JointMotion::Turn, 0.0),
    };
    let mut first =
        Joint { motion, pitch, prismatic: matches!(motion, JointMotion::Slide), ..single };
    // The frame of a universal joint's first rotation, which is about x, in that of the body; a
    // cyclic permutation.
    let turned = DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X);
    if matches!(link.joint.kind, Universal) {
        first.rot = mul(&first.rot, &turned);
    }
    let place = along_axis(joints, first);
    let (motion, rot) = match link.joint.kind {
        Universal => (JointMotion::Turn, transpose(&turned)),
        Cylindrical => (JointMotion::Slide, DMat3::IDENTITY),
        Revolute | Continuous | Prismatic | Helical | Planar | Spherical | Free | Fixed => {
            return place;
        }
    };
    let second = Joint {
        parent: v,
        motion,
        prismatic: matches!(motion, JointMotion::Slide),
        first: v + 1,
        q: q + 1,
        position: Some(q + 1),
        rot,
        pos: place.pos,
        ..single
    };
    along_axis(joints, second)
}

/// Moves a joint's frame along its axis z until the offset from the parent is perpendicular to it.
const fn along_axis<const V: usize>(joints: &mut [Joint; V], joint: Joint) -> BodyPlacement {
    let slide = -dot(joint.pos, joint.rot.z_axis);
    joints[joint.first] =
        Joint { pos: snap_small(add(joint.pos, scale(joint.rot.z_axis, slide))), ..joint };
    BodyPlacement { joint: joint.first, rot: DMat3::IDENTITY, pos: DVec3::new(0.0, 0.0, -slide) }
}

/// Writes the coordinates that move a body at once, `first` the first of them.
const fn at_once<const V: usize>(
    joints: &mut [Joint; V],
    first: &Joint,
    motion: JointMotion,
) -> BodyPlacement {
    // The number of coordinates, the axis of the first rotation, and the position of the first
    // translation.
    let (count, turns, shift) = match motion {
        JointMotion::Planar => (3, 2, 1),
        JointMotion::Spherical => (3, 0, 0),
        _ => (6, 0, 4),
    };
    let rotations = 3 - turns;
    let mut k = 0;
    while k < count {
        let prismatic = k >= rotations;
        let joint = &mut joints[first.first + k];
        *joint = Joint {
            motion: JointMotion::Still,
            count,
            prismatic,
            axis: if prismatic { k - rotations } else { turns + k },
            position: if prismatic {
                Some(first.q + shift + k - rotations)
            } else if matches!(motion, JointMotion::Planar) {
                Some(first.q)
            } else {
                None
            },
            ..*first
        };
        if k == 0 {
            joint.motion = motion;
            joint.pos = snap_small(first.pos);
        } else {
            joint.parent = first.first + k - 1;
            (joint.rot, joint.pos) = (DMat3::IDENTITY, DVec3::ZERO);
        }
        k += 1;
    }
    BodyPlacement { joint: first.first + count - 1, rot: DMat3::IDENTITY, pos: DVec3::ZERO }
}

/// The offset that occurs most often between two moving joints, or 1 m.
const fn unit_of_length<const V: usize>(joints: &[Joint; V]) -> f64 {
    let (mut best, mut most, mut i) = (1.0, 0, 0);
    while i < 3 * V {
        let length = offset(joints, i / 3, i % 3);
        let (mut count, mut k) = (0, 0);
        while length != 0.0 && k < 3 * V {
            if offset(joints, k / 3, k % 3) == length {
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

/// Component `k` of the offset of joint `i`, or zero if no product contains it.
const fn offset<const V: usize>(joints: &[Joint; V], i: usize, k: usize) -> f64 {
    let joint = &joints[i];
    let constant =
        matches!(joint.motion, JointMotion::Turn | JointMotion::Spherical | JointMotion::Still);
    if joint.parent == BASE || !constant {
        return 0.0;
    }
    let parent = &joints[joint.parent];
    if k == 2 && parent.parent == BASE && matches!(parent.motion, JointMotion::Turn) {
        // Points on an axis that stands still do not move.
        return 0.0;
    }
    match k {
        0 => joint.pos.x.abs(),
        1 => joint.pos.y.abs(),
        _ => joint.pos.z.abs(),
    }
}
