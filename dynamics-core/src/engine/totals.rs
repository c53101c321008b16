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
pub(super) struct Totals<Scalar> {
    pub(super) mass: Folded<Scalar>,
    pub(super) moment: Vec3<Scalar>,
    pub(super) momentum: Wrench<Scalar>,
    /// Twice the kinetic energy.
    pub(super) twice: Folded<Scalar>,
    /// The angular momentum of the rotors on the parent itself, beyond what its inertia includes.
    spin: Vec3<Scalar>,
}

impl<Scalar: Real> Add for Totals<Scalar> {
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

impl<Scalar: Real> Totals<Scalar> {
    /// With those of the children, whose rotors turn with the body of the angular velocity ω.
    #[cfg_attr(optimised, inline(always))]
    fn carrying(self, inner: Self, omega: Vec3<Scalar>) -> Self {
        let along = omega.dot(inner.spin);
        let sum = self + inner;
        Self { twice: sum.twice + along + along, ..sum }
    }

    /// The centre of mass, m; the base's origin if there is no mass. And 1/m, 1/kg; then zero.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn centre(&self, length: f64) -> (Scalar::Vec3, Scalar) {
        centre(self.mass, self.moment, length)
    }
}

/// The centre of mass of a mass and a first moment in units of length, m, and the reciprocal of the
/// mass, 1/kg.
#[cfg_attr(optimised, inline(always))]
pub(super) fn centre<Scalar: Real>(
    mass: Folded<Scalar>,
    moment: Vec3<Scalar>,
    length: f64,
) -> (Scalar::Vec3, Scalar) {
    let mass = (mass * Folded::constant(1.0 / (length * length))).get();
    let mass_inv = if mass > Scalar::ZERO { Scalar::ONE / mass } else { Scalar::ZERO };
    let moment = moment.scale(Folded::constant(1.0 / length)).get();
    (moment * mass_inv, mass_inv)
}

impl<Scalar, Tree, Effects, const B: usize, const Q: usize, const V: usize>
    Call<'_, Scalar, Tree, Effects, B, Q, V>
where
    Scalar: Real,
    Tree: Compiled,
    Effects: Effect<Scalar, B, V>,
{
    /// The totals of all bodies of a robot at rates `qd`, or at rest without them, with what is
    /// fixed to the base. With WHOLE, of which the momentum needs all of Σ.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn totals<const WHOLE: bool>(self, qd: Option<&[Scalar; V]>) -> Totals<Scalar> {
        let mut base = AccelerationField { pose: Pose::UNKNOWN, ..AccelerationField::RESTING };
        let moves = Effects::BASE_MOTION && qd.is_some();
        if moves {
            let (v, _) = base_given(self.effects);
            base.omega = Vec3::runtime(v.ang);
            base.v = Vec3::runtime(v.lin).scale(Folded::constant(Tree::LENGTH_INV));
        }
        let mut pass = Sums::<Scalar, Tree, Effects, B, Q, V, WHOLE> { call: self, qd };
        let moving = sweep(&mut pass, &base);
        of_body(&base, &fixed(Remainder::<Tree, B, V>::AT_BASE)).carrying(moving, base.omega)
    }

    /// Twice the energy of what stands at the coordinates of joint I.
    #[cfg_attr(optimised, inline(always))]
    fn rotor_energy<const I: usize>(self, qd: &[Scalar; V]) -> Folded<Scalar> {
        let mut twice = Scalar::ZERO;
        for_each_joint!(K, {
            if JointPair::<Tree, I, K>::IS_COORDINATE
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
pub(super) fn fixed<Scalar: Real>(at_base: &'static Distribution) -> Inertia<Scalar> {
    Inertia {
        mass: Folded::constant(at_base.mass),
        moment: Vec3::constant(at_base.moment),
        second: Sym3::of(&Mat3::constant(&at_base.second)),
    }
}

/// The totals of one body.
#[cfg_attr(optimised, inline(always))]
fn of_body<Scalar: Real>(
    body: &AccelerationField<Scalar>,
    own: &Inertia<Scalar>,
) -> Totals<Scalar> {
    let h = momentum(body, own);
    Totals {
        mass: own.mass,
        moment: own.moment,
        momentum: h,
        twice: h.f.dot(body.v) + h.n.dot(body.omega),
        spin: Vec3::ZERO,
    }
}

struct Sums<
    'a,
    Scalar,
    Tree,
    Effects,
    const B: usize,
    const Q: usize,
    const V: usize,
    const WHOLE: bool,
> {
    call: Call<'a, Scalar, Tree, Effects, B, Q, V>,
    qd: Option<&'a [Scalar; V]>,
}

impl<
    Scalar: Real,
    Tree: Compiled,
    Effects,
    const B: usize,
    const Q: usize,
    const V: usize,
    const WHOLE: bool,
> Pass for Sums<'_, Scalar, Tree, Effects, B, Q, V, WHOLE>
where
    Effects: Effect<Scalar, B, V>,
{
    type Tree = Tree;
    type Outward = AccelerationField<Scalar>;
    type Inward = Totals<Scalar>;
    const NOTHING: Totals<Scalar> = Totals {
        mass: Folded::ZERO,
        moment: Vec3::ZERO,
        momentum: Wrench::ZERO,
        twice: Folded::ZERO,
        spin: Vec3::ZERO,
    };

    #[cfg_attr(optimised, inline(always))]
    fn enter<const I: usize>(
        &mut self,
        parent: &AccelerationField<Scalar>,
    ) -> AccelerationField<Scalar> {
        let none = [Scalar::ZERO; V];
        let motions = Motions {
            turns: self.call.turns,
            qd: self.qd.unwrap_or(&none),
            qdd: &none,
            velocity: self.qd.is_some(),
            products: false,
            accel: false,
        };
        motions.field::<Tree, I>(parent)
    }

    #[cfg_attr(optimised, inline(always))]
    fn leave<const I: usize>(
        &mut self,
        body: &AccelerationField<Scalar>,
        inner: Totals<Scalar>,
    ) -> Totals<Scalar> {
        let own = self.call.inertia::<I>(WHOLE | Effects::BASE_MOTION);
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
