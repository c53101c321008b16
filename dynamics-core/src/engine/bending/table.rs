//! The constants of a robot's modes, which the engine knows while compiling.

use core::marker::PhantomData;

use glam::{DMat3, DVec3};

use super::for_each_mode;
use crate::engine::compile::{
    BodyPlacement, Compiled, CompiledJoint, Joint, JointMotion, mat_add, outer,
};
use crate::math::const_eval::{add, scale};
use crate::model::Link;

/// The most modes of one link.
pub(crate) const MODES: usize = {
    let mut count = 0;
    for_each_mode!(K, {
        assert!(K == count);
        count += 1;
    });
    count
};
/// The largest rounding error of an integral over the product of two modes, as a share of the
/// integrals of the two modes themselves.
const ROUNDING: f64 = 1e-14;

/// A robot whose links bend, compiled, in m: for each joint, the modes of the body behind it.
pub(crate) trait Bends: Compiled {
    /// The modes for a base at rest. For a body that can only turn about z, one integral stands for
    /// the sum of two that the equations otherwise distinguish.
    const AT_REST: &'static [BendingLink];
    /// The modes for any motion of the base.
    const MOVING: &'static [BendingLink];
    /// The joints with the inertia of what is fixed on the end of each body, without the point that
    /// its mass is.
    const END_JOINTS: &'static [Joint];
    /// The placements of the bodies that are fixed on an end, relative to it; for all others the
    /// base.
    const END_PLACES: &'static [BodyPlacement];
}

/// The bodies that are fixed on the ends of a robot's links.
pub(super) struct Ends<T>(PhantomData<T>);

impl<T: Bends> Compiled for Ends<T> {
    const LINKS: &'static [Link<f64>] = T::LINKS;
    const JOINTS: &'static [Joint] = T::END_JOINTS;
    const PLACES: &'static [BodyPlacement] = T::END_PLACES;
    const LENGTH: f64 = T::LENGTH;
    const SUPPORT: &'static [u64] = T::SUPPORT;
}

/// The modes of a body, in the frame of its joint; none of a rigid one.
#[derive(Clone, Copy)]
pub(crate) struct BendingLink {
    /// The number of the first mode.
    pub(crate) first: usize,
    pub(crate) count: usize,
    /// The end, undeformed.
    pub(crate) end: DVec3,
    pub(crate) modes: [BendingMode; MODES],
}

/// The integrals of one mode over the mass of its link, and what its end does.
#[derive(Clone, Copy)]
pub(crate) struct BendingMode {
    /// ∫ φ dm.
    pub(crate) momentum: DVec3,
    /// ∫ φ r₀ᵀ dm.
    pub(crate) moments: DMat3,
    pub(crate) shift: DVec3,
    /// ½ ψ.
    pub(crate) half_turn: DVec3,
    /// ∫ φ φₗᵀ dm with each mode of the link.
    pub(crate) products: [DMat3; MODES],
    /// ∫ φ·φₗ dm.
    pub(crate) masses: [f64; MODES],
    pub(crate) stiffness: [f64; MODES],
    pub(crate) damping: [f64; MODES],
}

impl BendingMode {
    pub(crate) const NONE: Self = Self {
        momentum: DVec3::ZERO,
        moments: DMat3::ZERO,
        shift: DVec3::ZERO,
        half_turn: DVec3::ZERO,
        products: [DMat3::ZERO; MODES],
        masses: [0.0; MODES],
        stiffness: [0.0; MODES],
        damping: [0.0; MODES],
    };
}

impl BendingLink {
    pub(crate) const RIGID: Self =
        Self { first: 0, count: 0, end: DVec3::ZERO, modes: [BendingMode::NONE; MODES] };

    /// With a point of this mass at the end, which the modes displace as they do the end, and with
    /// what rounding left of integrals that are zero exactly so.
    pub(crate) const fn with_mass_at_end(mut self, mass: f64) -> Self {
        let (mut k, end) = (0, self.end);
        while k < self.count {
            let mode = &mut self.modes[k];
            let momentum = scale(mode.shift, mass);
            mode.momentum = add(mode.momentum, momentum);
            mode.moments = mat_add(&mode.moments, &outer(momentum, end));
            k += 1;
        }
        k = 0;
        while k < self.count * self.count {
            let (a, b) = (k / self.count, k % self.count);
            let (shift, other) = (self.modes[a].shift, self.modes[b].shift);
            let mode = &mut self.modes[a];
            mode.products[b] = mat_add(&mode.products[b], &outer(scale(shift, mass), other));
            mode.masses[b] = trace(&mode.products[b]);
            k += 1;
        }
        k = 0;
        while k < self.count * self.count {
            let (a, b) = (k / self.count, k % self.count);
            let of_both = self.modes[a].masses[a] + self.modes[b].masses[b];
            let mode = &mut self.modes[a];
            mode.masses[b] = kept(mode.masses[b], ROUNDING * of_both);
            k += 1;
        }
        self
    }

    /// The same of a link that turns about z alone: of ∫ φ rᵀ dm count the sum of its first two
    /// diagonal entries, for the velocity products, and the difference of those beside them, for
    /// the couple about z.
    pub(crate) const fn in_plane(mut self) -> Self {
        let mut k = 0;
        while k < self.count {
            self.modes[k].moments = in_plane(&self.modes[k].moments, 0.0);
            let mut l = 0;
            while l < self.count {
                let of_both = self.modes[k].masses[k] + self.modes[l].masses[l];
                let products = &mut self.modes[k].products[l];
                *products = in_plane(products, ROUNDING * of_both);
                l += 1;
            }
            k += 1;
        }
        self
    }

    /// Whether the end turns.
    const fn turns(&self) -> bool {
        let mut k = 0;
        while k < self.count {
            let DVec3 { x, y, z } = self.modes[k].half_turn;
            if x != 0.0 || y != 0.0 || z != 0.0 {
                return true;
            }
            k += 1;
        }
        false
    }

    /// Whether the end turns about axes along `axis` alone.
    pub(crate) const fn turns_about(&self, axis: DVec3) -> bool {
        let mut k = 0;
        while k < self.count {
            let turn = self.modes[k].half_turn;
            if (turn.y * axis.z - turn.z * axis.y) != 0.0
                || (turn.z * axis.x - turn.x * axis.z) != 0.0
                || (turn.x * axis.y - turn.y * axis.x) != 0.0
            {
                return false;
            }
            k += 1;
        }
        true
    }
}

const fn in_plane(m: &DMat3, rounding: f64) -> DMat3 {
    let diagonal = kept(m.x_axis.x + m.y_axis.y, rounding);
    let couple = kept(m.x_axis.y - m.y_axis.x, rounding);
    DMat3::from_cols(DVec3::new(diagonal, couple, 0.0), DVec3::ZERO, DVec3::ZERO)
}

const fn kept(x: f64, rounding: f64) -> f64 {
    if x.abs() <= rounding { 0.0 } else { x }
}

pub(super) const fn trace(m: &DMat3) -> f64 {
    m.x_axis.x + m.y_axis.y + m.z_axis.z
}

/// ∫ r × φ dm of ∫ φ rᵀ dm.
pub(super) const fn axial(m: &DMat3) -> DVec3 {
    DVec3::new(m.y_axis.z - m.z_axis.y, m.z_axis.x - m.x_axis.z, m.x_axis.y - m.y_axis.x)
}

/// The body of joint I, on a base that moves or at rest.
pub(super) struct BendingBody<T, const I: usize, const MOVES: bool>(PhantomData<T>);

impl<T: Bends, const I: usize, const MOVES: bool> BendingBody<T, I, MOVES> {
    pub(super) const LINK: &'static BendingLink = {
        let links = if MOVES { T::MOVING } else { T::AT_REST };
        if I < links.len() { &links[I] } else { &BendingLink::RIGID }
    };
    /// Whether it has modes.
    pub(super) const IS: bool = Self::LINK.count > 0;
    /// Whether its end turns.
    pub(super) const TURNS: bool = Self::LINK.turns();
    /// Whether its end turns about the axes of all of its children: their angles then become
    /// larger, and nothing is rotated twice.
    pub(super) const ADDS_TO_ANGLES: bool = {
        let (mut all, mut j) = (true, 0);
        while j < T::JOINTS.len() {
            let joint = &T::JOINTS[j];
            if joint.parent == I {
                let at_end = joint.pos.x == 0.0 && joint.pos.y == 0.0 && joint.pos.z == 0.0;
                all &= matches!(joint.motion, JointMotion::Turn)
                    && at_end
                    && Self::LINK.turns_about(joint.rot.z_axis);
            }
            j += 1;
        }
        all
    };
    /// Whether a body is fixed on its end.
    pub(super) const HAS_BODY_ON_END: bool = CompiledJoint::<Ends<T>, I>::BODIES > 0;
    /// Whether nothing is on its end.
    pub(super) const IS_LAST: bool = {
        let (mut last, mut j) = (!Self::HAS_BODY_ON_END, 0);
        while j < T::JOINTS.len() {
            last &= T::JOINTS[j].parent != CompiledJoint::<T, I>::LAST;
            j += 1;
        }
        last
    };
}

/// Whether the body of joint I has a K-th mode.
pub(super) struct HasMode<T, const I: usize, const K: usize>(PhantomData<T>);

impl<T: Bends, const I: usize, const K: usize> HasMode<T, I, K> {
    pub(super) const IS: bool = K < BendingBody::<T, I, true>::LINK.count;
}
