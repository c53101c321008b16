//! How the base moves: what the recursion starts from.

use super::field::Field;
use super::known::Known;
use super::pose::Pose;
use super::small::{Mat3, Vec3};
use crate::effects::{Effect, field_axes, one_gravity};
use crate::scalar::{Real, Vector};
use crate::spatial::Motion;

/// The engine has no rotors that spin as bodies.
#[inline(always)]
pub(crate) const fn no_spinning<R: Real, E, const B: usize, const V: usize>()
where
    E: Effect<R, B, V>,
{
    const {
        assert!(
            !E::SPINNING,
            "the engine has no rotors that spin as bodies; use `Core`"
        )
    };
}

/// The base: a = −g and, if it moves, its own; in units of length. At rest all else is a known zero.
#[inline(always)]
pub(crate) fn base<R: Real, E, const B: usize, const V: usize>(effects: &E, length: f64) -> Field<R>
where
    E: Effect<R, B, V>,
{
    no_spinning::<R, E, B, V>();
    one_gravity::<R, E, B, V>();
    let mut g = R::Vec3::ZERO;
    effects.field(&mut g);
    let (g, [x, y, z]) = (g.array(), const { field_axes::<R, E, B, V>() });
    let up = Known::constant(-1.0 / length);
    let weight = Vec3([
        Known::only_if(x, g[0]) * up,
        Known::only_if(y, g[1]) * up,
        Known::only_if(z, g[2]) * up,
    ]);
    let mut field = Field {
        omega: Vec3::ZERO,
        spin: Vec3::ZERO,
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
        let (mut v, mut a) = (Motion::ZERO, Motion::ZERO);
        effects.base(&mut v, &mut a);
        let per_length = Known::constant(1.0 / length);
        let (omega, alpha) = (Vec3::any(v.ang), Vec3::any(a.ang));
        let [ax, ay, az] = alpha.0;
        let (zero, velocity) = (Known::ZERO, Vec3::any(v.lin).scale(per_length));
        field.alpha = alpha;
        field.u = Mat3([
            Vec3([zero, az, -ay]),
            Vec3([-az, zero, ax]),
            Vec3([ay, -ax, zero]),
        ]);
        field.a = field.a + Vec3::any(a.lin).scale(per_length);
        if E::VELOCITY_PRODUCTS {
            field.spin = omega;
            // [ω]×[ω]× r = ω × (ω × r), and the origin's own ω × v.
            let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            let [x, y, z] =
                axes.map(|axis| omega.cross(omega.cross(Vec3(axis.map(Known::constant)))));
            field.u = field.u + Mat3([x, y, z]);
            field.a = field.a + omega.cross(velocity);
        }
        if E::BODY_VELOCITY {
            (field.omega, field.v) = (omega, velocity);
        }
    }
    field
}
