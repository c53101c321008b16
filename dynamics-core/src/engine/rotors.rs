//! Rotors that spin as bodies, [`crate::effects::GyroscopicRotors`]: their terms in the engine's
//! recursions.
//!
//! A rotor of ratio ρ is mounted on the parent's side of its joint and spins by ρ q̇ about the
//! joint's axis z. Its angular momentum exceeds that which the parent's inertia includes by ρ I q̇
//! z. Without such rotors the scene's functions return what they are given, and nothing of them is
//! in the machine code.

use core::marker::PhantomData;

use super::acceleration_field::Wrench;
use super::call::Call;
use super::compile::{Compiled, CompiledJoint};
use super::folding::{Folded, Mat3, Vec3};
use crate::effects::{Declared, Effect, call_hook};
use crate::model::JointKind;
use crate::scalar::Real;

/// Whether coordinate I of a robot may have such a rotor: it is the only coordinate of its joint.
struct OnlyCoordinate<T, const I: usize>(PhantomData<T>);

impl<T: Compiled, const I: usize> OnlyCoordinate<T, I> {
    const IS: bool = {
        let (mut is, mut body) = (false, 0);
        while body < T::LINKS.len() {
            let link = &T::LINKS[body];
            is |= link.idx_v == I
                && link.joint.kind.coordinates().1 == 1
                && !matches!(link.joint.kind, JointKind::Fixed);
            body += 1;
        }
        is
    };
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// ρ I of the rotor of joint I; a known zero without one.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn coupling<const I: usize>(self) -> Folded<R> {
        let mut coupling = R::ZERO;
        let has_rotor = E::GYROSCOPIC_ROTORS && OnlyCoordinate::<T, I>::IS;
        if has_rotor {
            call_hook!(E::ROTOR.add, self.effects, I, &mut coupling);
        }
        Folded::runtime_if(has_rotor, coupling)
    }
    /// The wrench `carried` as joint I feels it: with the couple ρ I z·x by which the rotor follows
    /// a motion x of the parent, its ω or α.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn felt<const I: usize>(self, carried: Wrench<R>, parent: Vec3<R>) -> Wrench<R> {
        let mut felt = carried;
        if E::GYROSCOPIC_ROTORS {
            let joint = CompiledJoint::<T, I>::JOINT;
            let along = Mat3::constant(&joint.rot).transpose_mul(parent).0[2];
            let couple = self.coupling::<I>() * along;
            if joint.prismatic {
                // A force along z counts by units of length.
                felt.f.0[2] = felt.f.0[2] + couple * Folded::constant(T::LENGTH);
            } else {
                felt.n.0[2] = felt.n.0[2] + couple;
            }
        }
        felt
    }
    /// The wrench `carried` as the parent of joint I bears it: with a couple on the rotor, in the
    /// frame of the joint's body.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn borne(self, carried: Wrench<R>, couple: Vec3<R>) -> Wrench<R> {
        if E::GYROSCOPIC_ROTORS { Wrench { f: carried.f, n: carried.n + couple } } else { carried }
    }
}
