//! A payload on a body, known at run time only.

use crate::effects::{Effect, hook};
use crate::model::{BodyInertia, Problem};
use crate::scalar::Real;
use crate::spatial::SpatialInertia;
use core::fmt;

/// A rigid payload fixed to the body of the number BODY in the description: its inertia about the origin of that body's
/// frame.
///
/// It acts through the other effects of the scene: its weight with `Gravity`, its M q̈ with `Inertia`. A scene may
/// contain payloads of several bodies; those of one body add up.
///
/// ```
/// use dynamics_core::effects::{Gravity, Payload};
/// use dynamics_core::model::{BodyInertia, Robot};
/// use dynamics_core::{Core, Engine, robots::Ur5e, state::State};
/// type OnWrist = Payload<f32, { Ur5e::MODEL.body("wrist_3") }>;
/// let arm = State::at([0.0_f32, -0.8, 0.9, 0.1, 0.2, 0.3]);
/// let held = OnWrist::try_new(BodyInertia { mass: 2.0, com: [0.0, 0.0, 0.1], inertia: [0.0; 6] }, 1e-6)?;
/// let scene = (Gravity::EARTH, held);
/// let empty = Core::<Ur5e>::rnea(&arm, &Gravity::EARTH);
/// let loaded = Engine::<Ur5e>::rnea(&arm, &scene);
/// assert!((loaded[1] - empty[1]).abs() > 5.0);
/// assert!((loaded[1] - Core::<Ur5e>::rnea(&arm, &scene)[1]).abs() < 1e-4);
/// # Ok::<(), dynamics_core::effects::InvalidPayload>(())
/// ```
///
/// A payload of a body that the robot does not have does not compile:
///
/// ```compile_fail,E0080
/// use dynamics_core::effects::{Payload, RIGID_BODY};
/// use dynamics_core::{Core, robots::Ur5e, state::State};
/// let scene = (RIGID_BODY, Payload::<f32, 6>::default());
/// let _ = Core::<Ur5e>::rnea(&State::at([0.3; 6]), &scene);
/// // error: a payload is on a body that the robot does not have: bodies are numbered from 0
/// ```
#[doc(alias = "load")]
#[doc(alias = "tool")]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Payload<R: Real, const BODY: usize>(pub SpatialInertia<R>);

impl<R: Real, const BODY: usize> Payload<R, BODY> {
    /// The payload of this mass, centre of mass and inertia in the body's frame, unchecked. RBDA (2.63).
    pub fn from_inertia(inertia: BodyInertia<R>) -> Self {
        Self(inertia.about_origin())
    }

    /// The payload of this mass, centre of mass and inertia in the body's frame, if they are physical: no negative
    /// mass, and principal moments that are not negative and obey the triangle inequality within `relative` of the
    /// largest (f32 rounds to 1e-6).
    ///
    /// Not for the tick: it computes principal moments in f64.
    ///
    /// ```
    /// use dynamics_core::effects::Payload;
    /// use dynamics_core::model::{BodyInertia, Problem};
    /// let load = |mass, xx| BodyInertia { mass, com: [0.0, 0.0, 0.1], inertia: [xx, 0.0, 0.0, 0.02, 0.0, 0.02] };
    /// let problem = |mass, xx| Payload::<f64, 5>::try_new(load(mass, xx), 1e-6).map_err(|error| error.problem);
    /// assert!(problem(2.0, 0.01).is_ok());
    /// assert_eq!(problem(-2.0, 0.01), Err(Problem::Mass(-2.0)));
    /// assert_eq!(problem(0.0, 0.01), Err(Problem::Massless));
    /// assert_eq!(problem(f64::NAN, 0.01), Err(Problem::NotFinite));
    ///
    /// let error = Payload::<f64, 5>::try_new(load(2.0, 0.05), 1e-6).unwrap_err();
    /// assert_eq!(error.body, 5);
    /// assert!(matches!(error.problem, Problem::Triangle(by) if (by - 0.2).abs() < 1e-9));
    /// let text = "payload of body 5: its moments of inertia break the triangle inequality by 2.00e-1 of the largest";
    /// assert_eq!(error.to_string(), text);
    /// ```
    ///
    /// # Errors
    /// [`InvalidPayload`] names the body and what is not physical, with its amount.
    pub fn try_new(inertia: BodyInertia<R>, relative: f64) -> Result<Self, InvalidPayload> {
        match inertia.problem(relative) {
            None => Ok(Self::from_inertia(inertia)),
            Some(problem) => Err(InvalidPayload {
                body: BODY,
                problem,
            }),
        }
    }
}

/// A payload with a mass or an inertia that is not physical.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct InvalidPayload {
    /// The number of the body to which it was to be attached.
    pub body: usize,
    /// What is not physical: [`Problem::NotFinite`], [`Problem::Mass`], [`Problem::Massless`] or [`Problem::Triangle`].
    pub problem: Problem,
}

impl fmt::Display for InvalidPayload {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "payload of body {}: {}", self.body, self.problem.text())?;
        if let Problem::Triangle(excess) = self.problem {
            write!(f, " by {excess:.2e} of the largest")?;
        }
        Ok(())
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
