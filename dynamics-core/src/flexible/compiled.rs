//! The modes of a robot known at compile time, as the engine computes with them.

use core::marker::PhantomData;

use glam::{DMat3, DVec3};

use super::{BendingRobot, Modes};
use crate::engine::{
    BendingLink, BendingMode, BendingTree, Bends, BodyPlacement, Compiled, Joint, JointMotion,
    MODES, compile_bending, mat_add, outer, support,
};
use crate::math::const_eval::add;
use crate::model::{BASE, JointKind, Link, Text};

/// The robot `T` with M modes, compiled.
pub(super) struct CompiledModes<T, const B: usize, const Q: usize, const V: usize, const M: usize>(
    PhantomData<T>,
);

impl<T, const B: usize, const Q: usize, const V: usize, const M: usize> CompiledModes<T, B, Q, V, M>
where
    T: BendingRobot<B, Q, V, M>,
{
    /// The ends of the links that bend, of a robot that the engine takes with its modes.
    pub(super) const ENDS: [Option<DVec3>; B] = {
        if V + M > 64 {
            Text::EMPTY
                .with("robot `")
                .with(T::MODEL.name)
                .with("`: the engine takes up to 64 joints and modes; use `Core`")
                .panic();
        }
        let (mut ends, mut k) = ([None; B], 0);
        while k < M {
            ends[T::MODES.links[k]] = Some(T::MODES.each[k].end);
            k += 1;
        }
        taken(T::MODEL.name, &T::MODEL.links, &ends);
        ends
    };
    const TREE: &'static BendingTree<B, V> = &compile_bending(&T::MODEL, 0.0, Some(&Self::ENDS));
    const MOVING_LINKS: [BendingLink; V] = {
        let BendingTree { tree, on_ends, .. } = Self::TREE;
        let (mut links, mut body) = ([BendingLink::RIGID; V], 0);
        while body < B {
            if Self::ENDS[body].is_some() {
                let place = &tree.places[body];
                let link = bending(&T::MODES, body, place.pos);
                links[place.joint] = link.with_mass_at_end(on_ends[place.joint].mass);
            }
            body += 1;
        }
        links
    };
    /// Whether each body turns about z alone, on a base at rest.
    const IN_PLANE: [bool; V] = {
        let joints = &Self::TREE.tree.joints;
        let (mut flat, mut i) = ([false; V], 0);
        while i < V {
            let Joint { parent, rot, .. } = &joints[i];
            flat[i] = matches!(joints[i].motion, JointMotion::Turn)
                && (*parent == BASE
                    || flat[*parent]
                        && rot.z_axis.z.abs() == 1.0
                        && Self::MOVING_LINKS[*parent].turns_about(DVec3::Z));
            i += 1;
        }
        flat
    };
    const LINKS_AT_REST: [BendingLink; V] = {
        let (mut links, mut i) = (Self::MOVING_LINKS, 0);
        while i < V {
            if Self::IN_PLANE[i] {
                links[i] = links[i].in_plane();
            }
            i += 1;
        }
        links
    };
    const JOINTS: [Joint; V] = {
        let (mut joints, mut i) = (Self::TREE.tree.joints, 0);
        while i < V {
            if Self::IN_PLANE[i] {
                joints[i].second = flat(&joints[i].second);
            }
            i += 1;
        }
        joints
    };
    const END_JOINTS: [Joint; V] = {
        let (mut joints, mut i) = (Self::TREE.tree.joints, 0);
        while i < V {
            let (joint, on_end) = (&mut joints[i], &Self::TREE.on_ends[i]);
            (joint.mass, joint.moment) = (0.0, on_end.moment);
            (joint.second, joint.second_moment_only) = (on_end.second, on_end.second);
            if Self::IN_PLANE[i] && Self::MOVING_LINKS[i].turns_about(DVec3::Z) {
                joint.second = flat(&joint.second);
            }
            i += 1;
        }
        joints
    };

    /// The places of the bodies that are fixed on an end, or of all others.
    const fn places(on_end: bool) -> [BodyPlacement; B] {
        let (mut places, mut body) = (Self::TREE.tree.places, 0);
        while body < B {
            if Self::TREE.is_on_end[body] != on_end {
                places[body].joint = BASE;
            }
            body += 1;
        }
        places
    }
}

impl<T, const B: usize, const Q: usize, const V: usize, const M: usize> Compiled
    for CompiledModes<T, B, Q, V, M>
where
    T: BendingRobot<B, Q, V, M>,
{
    const LINKS: &'static [Link<f64>] = &T::MODEL.links;
    const JOINTS: &'static [Joint] = &Self::JOINTS;
    const PLACES: &'static [BodyPlacement] = &Self::places(false);
    const LENGTH: f64 = Self::TREE.tree.length;
    const SUPPORT: &'static [u64] = &support(&Self::TREE.tree.joints);
}

impl<T, const B: usize, const Q: usize, const V: usize, const M: usize> Bends
    for CompiledModes<T, B, Q, V, M>
where
    T: BendingRobot<B, Q, V, M>,
{
    const AT_REST: &'static [BendingLink] = &Self::LINKS_AT_REST;
    const MOVING: &'static [BendingLink] = &Self::MOVING_LINKS;
    const END_JOINTS: &'static [Joint] = &Self::END_JOINTS;
    const END_PLACES: &'static [BodyPlacement] = &Self::places(true);
}

/// Σ of a body that turns about z alone: Σ_xx + Σ_yy.
const fn flat(second: &DMat3) -> DMat3 {
    let x = DVec3::new(second.x_axis.x + second.y_axis.y, 0.0, 0.0);
    DMat3::from_cols(x, DVec3::ZERO, DVec3::ZERO)
}

/// A robot whose modes the engine takes.
const fn taken(robot: &'static str, links: &[Link<f64>], ends: &[Option<DVec3>]) {
    let mut i = 0;
    while i < links.len() {
        let joint = &links[i].joint;
        let fixed = matches!(joint.kind, JointKind::Fixed);
        let problem = if joint.kind.coordinates().1 > 1 {
            Some("a joint has several degrees of freedom")
        } else if fixed && ends[i].is_some() {
            Some("a body on a fixed joint bends")
        } else {
            None
        };
        if let Some(problem) = problem {
            Text::EMPTY
                .with("robot `")
                .with(robot)
                .with("`, body `")
                .with(links[i].name)
                .with("`: ")
                .with(problem)
                .with(", which the engine does not take beside modes; use `Core`")
                .panic();
        }
        i += 1;
    }
}

/// The modes of a body, whose aligned frame has its origin at `origin` in that of the joint; both
/// have the same axes.
const fn bending<const M: usize>(modes: &Modes<f64, M>, body: usize, origin: DVec3) -> BendingLink {
    let (mut link, mut k) = (BendingLink::RIGID, 0);
    while k < M {
        if modes.links[k] == body {
            if link.count == 0 {
                link.first = k;
                link.end = add(modes.each[k].end, origin);
            }
            let of = &modes.each[k];
            let mut mode = BendingMode {
                momentum: of.momentum,
                moments: mat_add(&of.moments, &outer(of.momentum, origin)),
                shift: of.shift,
                half_turn: of.half_turn,
                ..BendingMode::NONE
            };
            let mut l = 0;
            while link.first + l < M && l < MODES {
                let with = link.first + l;
                if modes.links[with] == body {
                    mode.products[l] = modes.products[k][with];
                    mode.stiffness[l] = modes.stiffness[k][with];
                    mode.damping[l] = modes.damping[k][with];
                }
                l += 1;
            }
            link.modes[link.count] = mode;
            link.count += 1;
        }
        k += 1;
    }
    link
}
