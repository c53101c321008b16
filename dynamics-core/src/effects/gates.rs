//! Constants that follow from the hooks of a scene, so that core and engine use them under the same
//! conditions.

use core::marker::PhantomData;

use super::{Declared, Effect};
use crate::model::{BASE, Text};
use crate::scalar::Real;

/// The base components of the field that are computed.
pub(crate) const fn field_axes<R: Real, E, const B: usize, const V: usize>() -> [bool; 3]
where
    E: Effect<R, B, V>,
{
    let [x, y, z] = E::FIELD_AXES;
    [E::FIELD & x, E::FIELD & y, E::FIELD & z]
}

/// The facts about a scene that all algorithms need, evaluated once for all algorithms.
pub(crate) struct Scene<R, E, const B: usize, const V: usize>(PhantomData<(R, E)>);

impl<R: Real, E, const B: usize, const V: usize> Scene<R, E, B, V>
where
    E: Effect<R, B, V>,
{
    /// A scene that means what it says: see [`meaning`]. Public functions evaluate it in their own
    /// bodies, so that the compiler names the line that calls them.
    pub(crate) const MEANING: () = meaning::<R, E, B, V>();
    /// The same for the textbook algorithms, which have no base parameters.
    pub(crate) const OF_CORE: () = {
        let () = Self::MEANING;
        of_core::<R, E, B, V>();
    };
}

/// No effect occurs twice that cannot mean two things, and no payload is on a body that is not
/// there.
#[track_caller]
pub(crate) const fn meaning<R: Real, E, const B: usize, const V: usize>()
where
    E: Effect<R, B, V>,
{
    assert!(
        E::GRAVITIES <= 1,
        "the scene has several fields of gravity, whose sum would act: instead of (RIGID_BODY, \
         GravityVector(..)) write (Inertia, Coriolis, GravityVector(..))"
    );
    if let Some(problem) = E::ONCE.problem() {
        panic!("{}", problem);
    }
    if let Some(body) = E::PAYLOAD_ON_NO_BODY {
        Text::EMPTY
            .with("a payload is on body ")
            .number(body)
            .with(" of a robot of ")
            .number(B)
            .with(
                " bodies, which are numbered from 0: `Robot::MODEL.body(\"..\")` finds a body by \
                its name",
            )
            .panic();
    }
}

/// The same, without base parameters.
#[track_caller]
pub(crate) const fn of_core<R: Real, E, const B: usize, const V: usize>()
where
    E: Effect<R, B, V>,
{
    meaning::<R, E, B, V>();
    assert!(
        E::BASE_PARAMETERS == 0,
        "base parameters are the engine's: give the textbook algorithms the `Calibrated` robot"
    );
}

/// An effect that is to do something says what.
#[track_caller]
pub(crate) const fn has_hook<R: Real, E, const B: usize, const V: usize>()
where
    E: Effect<R, B, V>,
{
    assert!(
        E::FIELD
            | E::BASE_MOTION
            | E::WRENCH
            | E::ADDED_INERTIA.is_some
            | E::GYROSCOPIC_ROTORS
            | E::LOAD_DEPENDENT
            | (E::BASE_PARAMETERS > 0)
            | E::ACCELERATIONS
            | E::VELOCITY_PRODUCTS
            | E::ELASTICITY,
        "this effect has neither a hook among the constants of `Effect` nor the function `torque`: \
         it would do nothing. One whose only hook is `inertia` or `advance` has an empty `torque` \
         as well"
    );
}

/// The base parameters of the scene are one set, of the robot of this name.
pub(crate) const fn are_of<R: Real, E, const B: usize, const V: usize>(robot: &str)
where
    E: Effect<R, B, V>,
{
    assert!(E::BASE_PARAMETERS <= 1, "the scene has several sets of base parameters");
    let (of, robot) = (E::BASE_PARAMETERS_OF.as_bytes(), robot.as_bytes());
    let mut same = of.len() == robot.len();
    let mut i = 0;
    while same && i < of.len() {
        same = of[i] == robot[i];
        i += 1;
    }
    assert!(same || E::BASE_PARAMETERS == 0, "the base parameters are those of another robot");
}

/// Links that bend do not carry rotors that spin as bodies.
#[cfg_attr(optimised, inline(always))]
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

/// The number of bodies that carry a payload.
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
