//! Constants that follow from the hooks of a scene, so that core and engine use them under the same conditions.

use super::Effect;
use crate::model::BASE;
use crate::scalar::Real;

/// The base components of the field that are computed.
pub(crate) const fn field_axes<R: Real, E, const B: usize, const V: usize>() -> [bool; 3]
where
    E: Effect<R, B, V>,
{
    let [x, y, z] = E::FIELD_AXES;
    [E::FIELD & x, E::FIELD & y, E::FIELD & z]
}

/// Two fields of gravity would both act.
#[inline(always)]
pub(crate) const fn one_gravity<R: Real, E, const B: usize, const V: usize>()
where
    E: Effect<R, B, V>,
{
    const {
        assert!(
            E::GRAVITIES <= 1,
            "the scene has several fields of gravity, whose sum would act: instead of (RIGID_BODY, GravityVector(..)) \
             write (Inertia, Coriolis, GravityVector(..))"
        )
    };
}

/// Base parameters belong to the constants of the engine.
#[inline(always)]
pub(crate) const fn no_base_parameters<R: Real, E, const B: usize, const V: usize>()
where
    E: Effect<R, B, V>,
{
    const {
        assert!(
            E::BASE_PARAMETERS == 0,
            "base parameters are the engine's: give the textbook algorithms the `Calibrated` robot"
        )
    };
}

/// The base parameters of the scene are one set, of the robot of this name.
pub(crate) const fn are_of<R: Real, E, const B: usize, const V: usize>(robot: &str)
where
    E: Effect<R, B, V>,
{
    assert!(
        E::BASE_PARAMETERS <= 1,
        "the scene has several sets of base parameters"
    );
    let (of, robot) = (E::BASE_PARAMETERS_OF.as_bytes(), robot.as_bytes());
    let mut same = of.len() == robot.len();
    let mut i = 0;
    while same && i < of.len() {
        same = of[i] == robot[i];
        i += 1;
    }
    assert!(
        same || E::BASE_PARAMETERS == 0,
        "the base parameters are those of another robot"
    );
}

/// Links that bend do not carry rotors that spin as bodies.
#[inline(always)]
pub(crate) const fn no_gyroscopic_rotors<R: Real, E, const B: usize, const V: usize>()
where
    E: Effect<R, B, V>,
{
    const {
        assert!(
            !E::GYROSCOPIC_ROTORS,
            "links that bend do not carry gyroscopic rotors: use `Armature`"
        )
    };
}

/// How many bodies carry a payload.
pub(crate) const fn loads<R: Real, E, const B: usize, const V: usize>() -> usize
where
    E: Effect<R, B, V>,
{
    let (mut count, mut body) = (0, 0);
    while body < B {
        if E::PAYLOAD[body] {
            count += 1;
        }
        body += 1;
    }
    count
}

/// The only body that carries a payload, or [`BASE`].
pub(crate) const fn only_load<R: Real, E, const B: usize, const V: usize>() -> usize
where
    E: Effect<R, B, V>,
{
    let mut body = 0;
    while body < B {
        if E::PAYLOAD[body] && loads::<R, E, B, V>() == 1 {
            return body;
        }
        body += 1;
    }
    BASE
}
