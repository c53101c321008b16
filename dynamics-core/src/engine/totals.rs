//! Sums over all bodies in one pass: mass, first moment, momentum and kinetic energy. Sums that a
//! function does not read are not in its machine code.
//!
//! Regrouping to base parameters moves mass along a joint's axis, where it moves with both links:
//! it changes none of these sums but by what it leaves to the base.

use core::ops::Add;

use super::acceleration_field::{AccelerationField, Inertia, Wrench, along_z};
use super::call::Call;
use super::compile::{Compiled, Distribution, JointPair, Remainder};
use super::folding::{Folded, Mat3, Sym3, Vec3};
use super::momentum::momentum;
use super::pass::{Motions, Pass, sweep};
use super::pose::Pose;
use crate::effects::{Declared, Effect, base_given};
use crate::scalar::Real;

/// The sums over a body and its descendants, about the origin of the parent, in its frame and in
/// units of length.
#[derive(Clone, Copy)]
pub(super) struct Totals<R> {
    pub(super) mass: Folded<R>,
    pub(super) moment: Vec3<R>,
    pub(super) momentum: Wrench<R>,
    /// Twice the kinetic energy.
    pub(super) twice: Folded<R>,
    /// The angular momentum of the rotors on the parent itself, beyond what its inertia includes.
    spin: Vec3<R>,
}

impl<R: Real> Add for Totals<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, o: Self) -> Self {
        Self {
            mass: self.mass + o.mass,
            moment: self.moment + o.moment,
            momentum: self.momentum + o.momentum,
            twice: self.twice + o.twice,
            spin: self.spin + o.spin,
        }
    }
}

impl<R: Real> Totals<R> {
    /// With those of the children, whose rotors turn with the body of the angular velocity ω.
    #[cfg_attr(optimised, inline(always))]
    fn carrying(self, inner: Self, omega: Vec3<R>) -> Self {
        let along = omega.dot(inner.spin);
        let sum = self + inner;
        Self { twice: sum.twice + along + along, ..sum }
    }

    /// The centre of mass, m; the base's origin if there is no mass. And 1/m, 1/kg; then zero.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn centre(&self, length: f64) -> (R::Vec3, R) {
        centre(self.mass, self.moment, length)
    }
}

/// The centre of mass of a mass and a first moment in units of length, m, and the reciprocal of the
/// mass, 1/kg.
#[cfg_attr(optimised, inline(always))]
pub(super) fn centre<R: Real>(mass: Folded<R>, moment: Vec3<R>, length: f64) -> (R::Vec3, R) {
    let mass = (mass * Folded::constant(1.0 / (length * length))).get();
    let mass_inv = if mass > R::ZERO { R::ONE / mass } else { R::ZERO };
    let moment = moment.scale(Folded::constant(1.0 / length)).get();
    (moment * mass_inv, mass_inv)
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// The totals of all bodies of a robot at rates `qd`, or at rest without them, with what is
    /// fixed to the base. With WHOLE, of which the momentum needs all of Σ.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn totals<const WHOLE: bool>(self, qd: Option<&[R; V]>) -> Totals<R> {
        let mut base = AccelerationField { pose: Pose::UNKNOWN, ..AccelerationField::RESTING };
        let moves = E::BASE_MOTION && qd.is_some();
        if moves {
            let (v, _) = base_given(self.effects);
            base.omega = Vec3::runtime(v.ang);
            base.v = Vec3::runtime(v.lin).scale(Folded::constant(T::LENGTH_INV));
        }
        let mut pass = Sums::<R, T, E, B, Q, V, WHOLE> { call: self, qd };
        let moving = sweep(&mut pass, &base);
        of_body(&base, &fixed(Remainder::<T, B, V>::AT_BASE)).carrying(moving, base.omega)
    }

    /// Twice the energy of what stands at the coordinates of joint I.
    #[cfg_attr(optimised, inline(always))]
    fn rotor_energy<const I: usize>(self, qd: &[R; V]) -> Folded<R> {
        let mut twice = R::ZERO;
        for_each_joint!(K, {
            if JointPair::<T, I, K>::IS_COORDINATE
                && let Some(inertia) = self.effects.inertia(K)
            {
                twice += inertia * qd[K] * qd[K];
            }
        });
        Folded::runtime(twice)
    }
}

/// The inertia that is fixed to the base.
#[cfg_attr(optimised, inline(always))]
pub(super) fn fixed<R: Real>(at_base: &'static Distribution) -> Inertia<R> {
    Inertia {
        mass: Folded::constant(at_base.mass),
        moment: Vec3::constant(at_base.moment),
        second: Sym3::of(&Mat3::constant(&at_base.second)),
    }
}

/// The totals of one body.
#[cfg_attr(optimised, inline(always))]
fn of_body<R: Real>(body: &AccelerationField<R>, own: &Inertia<R>) -> Totals<R> {
    let h = momentum(body, own);
    Totals {
        mass: own.mass,
        moment: own.moment,
        momentum: h,
        twice: h.f.dot(body.v) + h.n.dot(body.omega),
        spin: Vec3::ZERO,
    }
}

struct Sums<'a, R, T, E, const B: usize, const Q: usize, const V: usize, const WHOLE: bool> {
    call: Call<'a, R, T, E, B, Q, V>,
    qd: Option<&'a [R; V]>,
}

impl<R: Real, T: Compiled, E, const B: usize, const Q: usize, const V: usize, const WHOLE: bool>
    Pass for Sums<'_, R, T, E, B, Q, V, WHOLE>
where
    E: Effect<R, B, V>,
{
    type Tree = T;
    type Outward = AccelerationField<R>;
    type Inward = Totals<R>;
    const NOTHING: Totals<R> = Totals {
        mass: Folded::ZERO,
        moment: Vec3::ZERO,
        momentum: Wrench::ZERO,
        twice: Folded::ZERO,
        spin: Vec3::ZERO,
    };

    #[cfg_attr(optimised, inline(always))]
    fn enter<const I: usize>(&mut self, parent: &AccelerationField<R>) -> AccelerationField<R> {
        let none = [R::ZERO; V];
        let motions = Motions {
            turns: self.call.turns,
            qd: self.qd.unwrap_or(&none),
            qdd: &none,
            velocity: self.qd.is_some(),
            products: false,
            accel: false,
        };
        motions.field::<T, I>(parent)
    }

    #[cfg_attr(optimised, inline(always))]
    fn leave<const I: usize>(
        &mut self,
        body: &AccelerationField<R>,
        inner: Totals<R>,
    ) -> Totals<R> {
        let own = self.call.inertia::<I>(WHOLE | E::BASE_MOTION);
        let mut here = of_body(body, &own).carrying(inner, body.omega);
        let mut rotor = Wrench::ZERO;
        if let Some(qd) = self.qd {
            here.twice = here.twice + self.call.rotor_energy::<I>(qd);
            let spin = self.call.coupling::<I>() * Folded::runtime(qd[I]);
            rotor.n = along_z(spin);
        }
        let at = self.call.displacement::<I>();
        let mass = Inertia { mass: here.mass, moment: here.moment, second: Sym3::ZERO };
        let (mass, rotor) = (mass.to_parent(&at), rotor.to_parent(&at));
        Totals {
            mass: mass.mass,
            moment: mass.moment,
            momentum: here.momentum.to_parent(&at) + rotor,
            twice: here.twice,
            spin: rotor.n,
        }
    }
}
