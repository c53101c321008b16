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

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// The base without its acceleration: a = −g, its velocity if it moves, and its pose, in units
    /// of length; all other values are known zeros.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn unaccelerated(self) -> AccelerationField<R> {
        let length = T::LENGTH;
        const { Scene::<R, E, B, V>::MEANING };
        let mut g = R::Vec3::ZERO;
        call_hook!(E::GRAVITY_FIELD.add, self.effects, &mut g);
        let (g, [x, y, z]) = (g.array(), const { field_axes::<R, E, B, V>() });
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
        if E::BODY_POSE {
            field.pose = Pose::BASE;
        }
        if E::BASE_MOTION {
            let (mut velocity, mut acceleration) = (Motion::ZERO, Motion::ZERO);
            call_hook!(E::BASE.add, self.effects, &mut velocity, &mut acceleration);
            field.omega = Vec3::runtime(velocity.ang);
            field.v = Vec3::runtime(velocity.lin).scale(Folded::constant(1.0 / length));
        }
        field
    }
    /// The motion of the base: a = −g plus its own acceleration, in units of length. If it is at
    /// rest, all other values are known zeros.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn base(self) -> AccelerationField<R> {
        let length = T::LENGTH;
        let mut field = self.unaccelerated();
        if E::BASE_MOTION {
            let (_, a) = base_given(self.effects);
            field = accelerated(field, a, E::VELOCITY_PRODUCTS, length);
            if !E::BODY_VELOCITY {
                (field.omega, field.v) = (Vec3::ZERO, Vec3::ZERO);
            }
        }
        field
    }
    /// The motion of the base without gravity, and its pose: all of it, whatever the effects need.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn carried(self) -> AccelerationField<R> {
        let length = T::LENGTH;
        let mut field = AccelerationField::RESTING;
        if E::BASE_MOTION {
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
fn accelerated<R: Real>(
    mut field: AccelerationField<R>,
    a: Motion<R>,
    products: bool,
    length: f64,
) -> AccelerationField<R> {
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
