//! A payload held by a body, known at run time only.

use crate::effects::{Effect, hook};
use crate::model::{BodyInertia, Problem};
use crate::scalar::Real;
use crate::spatial::SpatialInertia;
use core::fmt;

/// A rigid payload fixed to the body of the number BODY in the description.
///
/// Frame: that body's, about its origin. It acts through whatever else the scene names: its weight
/// with `Gravity`, its M q̈ with `Inertia`. Payloads of several bodies stand side by side in a scene, and those of
/// one body add up.
///
/// ```
/// use dynamics_core::effects::{Gravity, Payload};
/// use dynamics_core::model::Robot;
/// use dynamics_core::{Core, Engine, robots::Ur5e, state::State};
/// type OnWrist = Payload<f32, { Ur5e::MODEL.body("wrist_3") }>;
/// let arm = State::at([0.0_f32, -0.8, 0.9, 0.1, 0.2, 0.3]);
/// let scene = (Gravity::EARTH, OnWrist::new(2.0, [0.0, 0.0, 0.1], [0.0; 6]));
/// let empty = Core::<Ur5e>::rnea(&arm, &Gravity::EARTH);
/// let loaded = Engine::<Ur5e>::rnea(&arm, &scene);
/// assert!((loaded[1] - empty[1]).abs() > 5.0);
/// assert!((loaded[1] - Core::<Ur5e>::rnea(&arm, &scene)[1]).abs() < 1e-4);
/// ```
///
/// A payload of a body that there is not does not compile:
///
/// ```compile_fail,E0080
/// use dynamics_core::effects::{Payload, RIGID_BODY};
/// use dynamics_core::{Core, robots::Ur5e, state::State};
/// let scene = (RIGID_BODY, Payload::<f32, 6>::new(2.0, [0.0; 3], [0.0; 6]));
/// let _ = Core::<Ur5e>::rnea(&State::at([0.3; 6]), &scene);
/// // error: a payload is on a body that the robot does not have: bodies are numbered from 0
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Payload<R: Real, const BODY: usize>(pub SpatialInertia<R>);

impl<R: Real, const BODY: usize> Payload<R, BODY> {
    /// From mass (kg), centre of mass (m) and rotational inertia about it (xx, xy, xz, yy, yz, zz,
    /// kg·m²), in the body's frame. RBDA (2.63).
    pub fn new(mass: R, com: [R; 3], inertia: [R; 6]) -> Self {
        let body = BodyInertia { mass, com, inertia };
        Self(body.about_origin())
    }
}

impl<R: Real, const BODY: usize> Payload<R, BODY> {
    /// As [`Payload::new`], of numbers that a body could have: no negative mass, principal moments that are
    /// not negative and obey the triangle inequality within `relative` of the largest (f32 rounds to 1e-6).
    ///
    /// Not for the tick: it computes principal moments in f64.
    ///
    /// ```
    /// use dynamics_core::effects::{InvalidPayload, Payload};
    /// let checked = |mass, xx| Payload::<_, 5>::checked(mass, [0.0, 0.0, 0.1], [xx, 0.0, 0.0, 0.02, 0.0, 0.02], 1e-6);
    /// assert!(checked(2.0_f64, 0.01).is_ok());
    /// assert_eq!(checked(-2.0, 0.01), Err(InvalidPayload::Mass));
    /// assert!(matches!(checked(2.0, 0.05), Err(InvalidPayload::Triangle(by)) if (by - 0.2).abs() < 1e-9));
    /// assert_eq!(checked(0.0, 0.01), Err(InvalidPayload::Massless));
    /// assert_eq!(checked(f64::NAN, 0.01), Err(InvalidPayload::NotFinite));
    /// ```
    ///
    /// # Errors
    /// [`InvalidPayload`] says what no body has.
    pub fn checked(
        mass: R,
        com: [R; 3],
        inertia: [R; 6],
        relative: f64,
    ) -> Result<Self, InvalidPayload> {
        let body = BodyInertia { mass, com, inertia };
        match body.problem(relative) {
            None => Ok(Self(body.about_origin())),
            Some(Problem::Mass) => Err(InvalidPayload::Mass),
            Some(Problem::Massless) => Err(InvalidPayload::Massless),
            Some(Problem::Triangle(excess)) => Err(InvalidPayload::Triangle(excess)),
            Some(_) => Err(InvalidPayload::NotFinite),
        }
    }
}

/// Why no body has such a mass and inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum InvalidPayload {
    /// A number is infinite or not a number.
    NotFinite,
    /// The mass is negative.
    Mass,
    /// There is inertia about the centre of mass without mass.
    Massless,
    /// A principal moment is negative or exceeds the sum of the others, by this much of the largest.
    Triangle(f64),
}

impl fmt::Display for InvalidPayload {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite => f.write_str("payload: a number is not finite"),
            Self::Mass => f.write_str("payload: its mass is negative"),
            Self::Massless => f.write_str("payload: it has inertia but no mass"),
            Self::Triangle(by) => write!(
                f,
                "payload: no body has these principal moments (off by {by:.2e} of the largest)"
            ),
        }
    }
}

impl core::error::Error for InvalidPayload {}

impl<R: Real, const BODY: usize, const B: usize, const V: usize> Effect<R, B, V>
    for Payload<R, BODY>
{
    const ADDED_INERTIA: hook::Inertia<Self, R, B> = {
        assert!(
            BODY < B,
            "a payload is on a body that the robot does not have: bodies are numbered from 0"
        );
        let mut bodies = [false; B];
        bodies[BODY] = true;
        hook::Inertia::on(bodies, Self::add_to)
    };
}

impl<R: Real, const BODY: usize> Payload<R, BODY> {
    /// Adds the load to the inertia of `body`.
    #[inline(always)]
    fn add_to(&self, body: usize, inertia: &mut SpatialInertia<R>) {
        if body == BODY {
            *inertia = *inertia + self.0;
        }
    }
}
