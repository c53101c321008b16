//! The robot as the engine computes with it: worked out while compiling, in f64, tip to base.
//!
//! - Fixed bodies become part of the body that carries them.
//! - Each frame is turned until the joint's axis is z, and slid along it until the offset p from
//!   the parent is perpendicular to it.
//! - Regrouping to base parameters (Khalil & Dombre, *Modeling, Identification and Control of
//!   Robots*, 2002, chapter 9): a rotation about z is not affected by what lies on z, so that mass m,
//!   h_z and Σ_zz go to the parent as a thin rod; Σ = ∫ r rᵀ dm is the second moment. Behind a
//!   prismatic joint the whole Σ goes there. τ and M are unchanged; inner forces are not the
//!   physical ones.
//! - What takes less than the robot's negligible share of torque becomes zero: [`mod@prune`].
//! - The unit of length is a joint offset, so that this offset becomes 1, and the unit of mass
//!   such that Σ keeps its numbers: p/L, h·L, m·L².

mod prune;

use glam::{DMat3, DVec3};

use crate::engine::compile::prune::prune;
use crate::math::const_eval::{add, dot, mul, mul_vec, scale, transpose};
use crate::model::{BASE, JointKind, Model, Robot};

/// A joint with the inertia that is left to its body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Joint {
    /// The joint that carries this one, or [`BASE`].
    pub(crate) parent: usize,
    pub(crate) prismatic: bool,
    /// Its limits keep it within ±4π.
    pub(crate) near: bool,
    /// Coordinates of the body at q = 0 to the parent's.
    pub(crate) rot: DMat3,
    /// Origin in the parent's frame, in units of length.
    pub(crate) pos: DVec3,
    pub(crate) mass: f64,
    pub(crate) moment: DVec3,
    pub(crate) second: DMat3,
    /// Σ for a base that moves.
    pub(crate) second_moment_only: DMat3,
}

/// Where a body of the description is found: x_engine = rot x_user + pos on `joint`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyPlacement {
    pub(crate) joint: usize,
    pub(crate) rot: DMat3,
    /// In units of length.
    pub(crate) pos: DVec3,
}

/// The robot as the engine computes with it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CompiledTree<const B: usize, const V: usize> {
    pub(crate) joints: [Joint; V],
    pub(crate) places: [BodyPlacement; B],
    /// The unit of length, m.
    pub(crate) length: f64,
}

/// Carries the constant of a robot.
pub(crate) struct CompiledRobot<T, const B: usize, const Q: usize, const V: usize>(
    core::marker::PhantomData<T>,
);

impl<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize> CompiledRobot<T, B, Q, V> {
    pub(crate) const TREE: CompiledTree<B, V> = {
        assert!(
            V <= 32,
            "the engine takes up to 32 moving bodies; use `Core`"
        );
        prepare(&T::MODEL, T::NEGLIGIBLE)
    };

    /// λ of each joint, or [`BASE`].
    pub(crate) const PARENTS: [usize; V] = {
        let (mut parents, mut i) = ([BASE; V], 0);
        while i < V {
            parents[i] = Self::TREE.joints[i].parent;
            i += 1;
        }
        parents
    };

    /// The joints that carry each joint, itself among them, as bits.
    const SUPPORT: [u32; V] = {
        let (mut support, mut i) = ([0; V], 0);
        while i < V {
            let parent = Self::PARENTS[i];
            support[i] = 1 << i;
            if parent != BASE {
                support[i] |= support[parent];
            }
            i += 1;
        }
        support
    };

    /// Whether joint `k` is joint `i` or supports it.
    pub(crate) const fn supports(k: usize, i: usize) -> bool {
        k < V && i < V && Self::SUPPORT[i] & (1 << k) != 0
    }

    /// Whether joint `k` supports joint `i`.
    pub(crate) const fn is_ancestor(k: usize, i: usize) -> bool {
        k != i && Self::supports(k, i)
    }

    /// Where a body of the description is found; beyond the last one something harmless.
    pub(crate) const fn place(body: usize) -> BodyPlacement {
        if body < B {
            Self::TREE.places[body]
        } else {
            AT_BASE
        }
    }

    /// How many of the bodies that are `loaded` move with joint `i`.
    pub(crate) const fn loads(i: usize, loaded: &[bool; B]) -> usize {
        let (mut count, mut body) = (0, 0);
        while body < B {
            if loaded[body] && Self::place(body).joint == i {
                count += 1;
            }
            body += 1;
        }
        count
    }

    /// The `k`-th of them, or B.
    pub(crate) const fn load(i: usize, k: usize, loaded: &[bool; B]) -> usize {
        let (mut count, mut body) = (0, 0);
        while body < B {
            if loaded[body] && Self::place(body).joint == i {
                if count == k {
                    return body;
                }
                count += 1;
            }
            body += 1;
        }
        B
    }

    /// How many bodies move with joint `i` as one.
    pub(crate) const fn bodies_on(i: usize) -> usize {
        let places = const { &Self::TREE.places };
        let (mut count, mut body) = (0, 0);
        while body < B {
            if places[body].joint == i {
                count += 1;
            }
            body += 1;
        }
        count
    }

    /// The `k`-th body that moves with joint `i`, and where it is found; beyond the last one something
    /// harmless, as in [`Self::joint`].
    pub(crate) const fn body_on(i: usize, k: usize) -> (usize, BodyPlacement) {
        let places = const { &Self::TREE.places };
        let (mut count, mut body) = (0, 0);
        while body < B {
            if places[body].joint == i {
                if count == k {
                    return (body, places[body]);
                }
                count += 1;
            }
            body += 1;
        }
        (B, AT_BASE)
    }

    /// Joint `i`; beyond the last one something harmless, since the compiler evaluates the
    /// constants of branches that it does not take.
    pub(crate) const fn joint(i: usize) -> Joint {
        if i < V {
            Self::TREE.joints[i]
        } else {
            PADDING_JOINT
        }
    }

    /// The joint that carries joint `i`, or something harmless.
    pub(crate) const fn parent_of(i: usize) -> Joint {
        Self::joint(Self::joint(i).parent)
    }
}

const PADDING_JOINT: Joint = Joint {
    parent: BASE,
    prismatic: false,
    near: false,
    rot: DMat3::IDENTITY,
    pos: DVec3::ZERO,
    mass: 0.0,
    moment: DVec3::ZERO,
    second: DMat3::ZERO,
    second_moment_only: DMat3::ZERO,
};

const AT_BASE: BodyPlacement = BodyPlacement {
    joint: BASE,
    rot: DMat3::IDENTITY,
    pos: DVec3::ZERO,
};

const fn prepare<const B: usize, const Q: usize, const V: usize>(
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
            joint.near = link.limits.lower >= -FOUR_PI && link.limits.upper <= FOUR_PI;
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
                &mul(rot, &second_moment(&link.inertia.inertia)),
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
        places[i].rot = mul(&places[i].rot, &model.links[i].frame);
        places[i].pos = divide(places[i].pos, length);
        i += 1;
    }
    CompiledTree {
        joints,
        places,
        length,
    }
}

/// From the last joint to the first, what does not affect a joint's motion goes to its parent.
const fn regroup<const V: usize>(joints: &mut [Joint; V]) {
    let mut i = V;
    while i > 0 {
        i -= 1;
        let child = joints[i];
        let (mut mass, mut rod_h, mut spread) = (0.0, 0.0, child.second);
        if child.prismatic {
            joints[i].second = DMat3::ZERO;
        } else {
            (mass, rod_h) = (child.mass, child.moment.z);
            let zz = child.second.z_axis.z;
            spread = DMat3::from_cols(DVec3::ZERO, DVec3::ZERO, DVec3::new(0.0, 0.0, zz));
            joints[i].mass = 0.0;
            joints[i].moment = DVec3::new(child.moment.x, child.moment.y, 0.0);
            let (x, y, z) = (
                child.second.x_axis,
                child.second.y_axis,
                child.second.z_axis,
            );
            joints[i].second = DMat3::from_cols(x, y, DVec3::new(z.x, z.y, 0.0));
        }
        joints[i].second_moment_only = joints[i].second;
        if child.parent != BASE {
            let parent = &mut joints[child.parent];
            let (p, h) = (child.pos, scale(child.rot.z_axis, rod_h));
            let second = mul(&mul(&child.rot, &spread), &transpose(&child.rot));
            let second = mat_add(&second, &mat_add(&outer(p, h), &outer(h, p)));
            parent.second = mat_add(&parent.second, &mat_add(&second, &outer(p, scale(p, mass))));
            parent.moment = add(parent.moment, add(scale(p, mass), h));
            parent.mass += mass;
        } else if !child.prismatic {
            // A base at rest leaves one rotation, about z, which depends on Σ_xx + Σ_yy alone.
            let sum = child.second.x_axis.x + child.second.y_axis.y;
            let x = DVec3::new(sum, 0.0, 0.0);
            joints[i].second = DMat3::from_cols(x, DVec3::ZERO, DVec3::ZERO);
        }
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

/// Σ = ½ tr(Ī) 1 − Ī.
const fn second_moment(inertia: &DMat3) -> DMat3 {
    let half = 0.5 * (inertia.x_axis.x + inertia.y_axis.y + inertia.z_axis.z);
    DMat3::from_cols(
        add(scale(DVec3::X, half), scale(inertia.x_axis, -1.0)),
        add(scale(DVec3::Y, half), scale(inertia.y_axis, -1.0)),
        add(scale(DVec3::Z, half), scale(inertia.z_axis, -1.0)),
    )
}

const fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(scale(a, b.x), scale(a, b.y), scale(a, b.z))
}

const fn mat_add(a: &DMat3, b: &DMat3) -> DMat3 {
    DMat3::from_cols(
        add(a.x_axis, b.x_axis),
        add(a.y_axis, b.y_axis),
        add(a.z_axis, b.z_axis),
    )
}

/// Entries of a rotation that differ from −1, 0 or 1 by rounding alone.
const fn snapped(r: &DMat3) -> DMat3 {
    DMat3::from_cols(snap_vec(r.x_axis), snap_vec(r.y_axis), snap_vec(r.z_axis))
}

const fn snap_vec(v: DVec3) -> DVec3 {
    DVec3::new(snap(v.x), snap(v.y), snap(v.z))
}

const fn snap(x: f64) -> f64 {
    let nearest = if x > 0.5 {
        1.0
    } else if x < -0.5 {
        -1.0
    } else {
        0.0
    };
    if (x - nearest).abs() < ROUNDING {
        nearest
    } else {
        x
    }
}

/// Components of an offset that are zero but for rounding.
const fn snap_small(v: DVec3) -> DVec3 {
    let limit = ROUNDING * (v.x.abs() + v.y.abs() + v.z.abs());
    DVec3::new(
        if v.x.abs() <= limit { 0.0 } else { v.x },
        if v.y.abs() <= limit { 0.0 } else { v.y },
        if v.z.abs() <= limit { 0.0 } else { v.z },
    )
}

/// No joint that limits hold within this leaves it by so much that two parts of π/2 do not do.
const FOUR_PI: f64 = 4.0 * core::f64::consts::PI;

const ROUNDING: f64 = 4.0 * f64::EPSILON;
