//! The motion of the base, from which the recursion starts.

use super::acceleration_field::AccelerationField;
use super::call::Call;
use super::compile::Compiled;
use super::folding::Folded;
use super::folding::{Mat3, Vec3};
use super::pose::Pose;
use crate::effects::{Declared, Effect, Scene, base_given, call_hook, field_axes};
use crate::scalar::{Real, Vector};
use crate::spatial::Motion;

impl<Scalar, Tree, Effects, const B: usize, const Q: usize, const V: usize>
    Call<'_, Scalar, Tree, Effects, B, Q, V>
where
    Scalar: Real,
    Tree: Compiled,
    Effects: Effect<Scalar, B, V>,
{
    /// The base without its acceleration: a = −g, its velocity if it moves, and its pose, in units
    /// of length; all other values are known zeros.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn unaccelerated(self) -> AccelerationField<Scalar> {
        let length = Tree::LENGTH;
        const { Scene::<Scalar, Effects, B, V>::MEANING };
        let mut g = Scalar::Vec3::ZERO;
        call_hook!(Effects::GRAVITY_FIELD.add, self.effects, &mut g);
        let (g, [x, y, z]) = (g.array(), const { field_axes::<Scalar, Effects, B, V>() });
        let up = Folded::constant(-1.0 / length);
        let weight = Vec3([
            Folded::runtime_if(x, g[0]) * up,
            Folded::runtime_if(y, g[1]) * up,
            Folded::runtime_if(z, g[2]) * up,
        ]);
        let mut field = AccelerationField {
            omega: Vec3::ZERO,
            omega_products: Vec3::ZERO,
            alpha: Vec3::ZERO,
            u: Mat3::ZERO,
            a: weight,
            v: Vec3::ZERO,
            pose: Pose::UNKNOWN,
        };
        if Effects::BODY_POSE {
            field.pose = Pose::BASE;
        }
        if Effects::BASE_MOTION {
            let (mut velocity, mut acceleration) = (Motion::ZERO, Motion::ZERO);
            call_hook!(Effects::BASE.add, self.effects, &mut velocity, &mut acceleration);
            field.omega = Vec3::runtime(velocity.ang);
            field.v = Vec3::runtime(velocity.lin).scale(Folded::constant(1.0 / length));
        }
        field
    }
    /// The motion of the base: a = −g plus its own acceleration, in units of length. If it is at
    /// rest, all other values are known zeros.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn base(self) -> AccelerationField<Scalar> {
        let length = Tree::LENGTH;
        let mut field = self.unaccelerated();
        if Effects::BASE_MOTION {
            let (_, a) = base_given(self.effects);
            field = accelerated(field, a, Effects::VELOCITY_PRODUCTS, length);
            if !Effects::BODY_VELOCITY {
                (field.omega, field.v) = (Vec3::ZERO, Vec3::ZERO);
            }
        }
        field
    }
    /// The motion of the base without gravity, and its pose: all of it, whatever the effects need.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn carried(self) -> AccelerationField<Scalar> {
        let length = Tree::LENGTH;
        let mut field = AccelerationField::RESTING;
        if Effects::BASE_MOTION {
            let (v, a) = base_given(self.effects);
            field.omega = Vec3::runtime(v.ang);
            field.v = Vec3::runtime(v.lin).scale(Folded::constant(1.0 / length));
            field = accelerated(field, a, true, length);
        }
        field
    }
}

/// The field of a base of the velocity of `field`, with its spatial acceleration, and with the
/// products of its velocity if they are asked for.
#[cfg_attr(optimised, inline(always))]
fn accelerated<Scalar: Real>(
    mut field: AccelerationField<Scalar>,
    a: Motion<Scalar>,
    products: bool,
    length: f64,
) -> AccelerationField<Scalar> {
    let (omega, velocity, alpha) = (field.omega, field.v, Vec3::runtime(a.ang));
    let ([ax, ay, az], zero) = (alpha.0, Folded::ZERO);
    field.alpha = alpha;
    field.u = Mat3([Vec3([zero, az, -ay]), Vec3([-az, zero, ax]), Vec3([ay, -ax, zero])]);
    field.a = field.a + Vec3::runtime(a.lin).scale(Folded::constant(1.0 / length));
    if products {
        field.omega_products = omega;
        // [ω]×[ω]× r = ω × (ω × r), and the origin's own ω × v.
        let one = Folded::ONE;
        let centripetal = |axis| omega.cross(omega.cross(Vec3(axis)));
        field.u = field.u
            + Mat3([
                centripetal([one, zero, zero]),
                centripetal([zero, one, zero]),
                centripetal([zero, zero, one]),
            ]);
        field.a = field.a + omega.cross(velocity);
    }
    field
}
