//! A payload on a body, known at run time only.

use crate::effects::{Effect, hook};
use crate::model::{BodyInertia, Problem};
use crate::scalar::Real;
use crate::spatial::SpatialInertia;
use core::fmt;
use glam::{DMat3, DVec3, Mat3, Vec3};

/// A rigid payload fixed to the body of the number BODY in the description: its inertia about the
/// origin of that body's frame.
///
/// It acts through the other effects of the scene: its weight with `Gravity`, its M q̈ with
/// `Inertia`. A scene may contain payloads of several bodies; those of one body add up.
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
/// // error: a payload is on body 6 of a robot of 6 bodies, which are numbered from 0: `Robot::MODEL.body("..")` finds a
/// // body by its name
/// ```
#[doc(alias = "load")]
#[doc(alias = "tool")]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Payload<R: Real, const BODY: usize>(pub SpatialInertia<R>);

impl<R: Real, const BODY: usize> Payload<R, BODY> {
    /// The payload of this mass, centre of mass and inertia in the body's frame, unchecked. RBDA
    /// (2.63).
    ///
    /// For a scene in a `const` or `static` [`Payload::f32`] and [`Payload::f64`] are evaluated by
    /// the compiler.
    pub fn from_inertia(inertia: BodyInertia<R>) -> Self {
        Self(inertia.about_origin())
    }

    /// The payload of this mass, centre of mass and inertia in the body's frame, if they are
    /// physical: no negative mass, and principal moments that are not negative and obey the
    /// triangle inequality within `relative` of the largest (f32 rounds to 1e-6).
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
            Some(problem) => Err(InvalidPayload { body: BODY, problem }),
        }
    }
}

/// [`Payload::f32`] and [`Payload::f64`]: the operations of [`BodyInertia::about_origin`] in their
/// order.
macro_rules! known_payload {
    ($(#[$doc:meta])* $r:ident $vec:ident $mat:ident) => {
        impl<const BODY: usize> Payload<$r, BODY> {
            $(#[$doc])*
            pub const fn $r(inertia: BodyInertia<$r>) -> Self {
                let BodyInertia { mass, com, inertia } = inertia;
                let ([x, y, z], [xx, xy, xz, yy, yz, zz]) = (com, inertia);
                let (xx, yy, zz) = (
                    xx + mass * (y * y + z * z),
                    yy + mass * (x * x + z * z),
                    zz + mass * (x * x + y * y),
                );
                let (xy, xz, yz) = (xy - mass * x * y, xz - mass * x * z, yz - mass * y * z);
                Self(SpatialInertia {
                    mass,
                    first_moment: $vec::new(x * mass, y * mass, z * mass),
                    rotational: $mat::from_cols(
                        $vec::new(xx, xy, xz),
                        $vec::new(xy, yy, yz),
                        $vec::new(xz, yz, zz),
                    ),
                })
            }
        }
    };
}

known_payload! {
    /// [`Payload::from_inertia`] of numbers that the compiler knows, for a scene in a `const` or
    /// `static`; unchecked.
    ///
    /// ```
    /// use dynamics_core::effects::{Coriolis, Gravity, Inertia, Payload};
    /// use dynamics_core::model::{BodyInertia, Robot};
    /// use dynamics_core::{Engine, robots::Ur5e, state::State};
    /// const WRIST: usize = Ur5e::MODEL.body("wrist_3");
    /// const TOOL: Payload<f32, WRIST> =
    ///     Payload::f32(BodyInertia { mass: 2.0, com: [0.0, 0.0, 0.1], inertia: [0.01, 0.0, 0.0, 0.01, 0.0, 0.005] });
    /// const SCENE: (Gravity, Inertia, Coriolis, Payload<f32, WRIST>) =
    ///     Engine::<Ur5e>::scene_f32((Gravity::EARTH, Inertia, Coriolis, TOOL));
    /// let at = State::at([0.0, -1.2, 1.5, 0.3, 0.0, 0.0]);
    /// let without = (Gravity::EARTH, Inertia, Coriolis);
    /// let [held, empty] = [Engine::<Ur5e>::rnea(&at, &SCENE)[1], Engine::<Ur5e>::rnea(&at, &without)[1]];
    /// assert!(held.abs() > empty.abs() + 2.0); // N·m at the shoulder
    /// ```
    f32 Vec3 Mat3
}
known_payload! {
    /// [`Payload::from_inertia`] of numbers that the compiler knows, unchecked: see
    /// [`Payload::f32`].
    ///
    /// ```
    /// use dynamics_core::{effects::Payload, model::BodyInertia};
    /// const LOAD: BodyInertia<f64> = BodyInertia { mass: 2.0, com: [0.0, 0.0, 0.1], inertia: [0.0; 6] };
    /// const TOOL: Payload<f64, 5> = Payload::f64(LOAD);
    /// assert_eq!(TOOL, Payload::from_inertia(LOAD));
    /// ```
    f64 DVec3 DMat3
}

/// A payload with a mass or an inertia that is not physical.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct InvalidPayload {
    /// The number of the body to which it was to be attached.
    pub body: usize,
    /// The defect: [`Problem::NotFinite`], [`Problem::Mass`], [`Problem::Massless`],
    /// [`Problem::NegativeMoment`] or [`Problem::Triangle`].
    pub problem: Problem,
}

impl fmt::Display for InvalidPayload {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "payload of body {}: {}", self.body, self.problem.text())?;
        if let Some((before, amount, unit)) = self.problem.amount() {
            write!(f, "{before}{amount:.2e}{unit}")?;
        }
        Ok(())
    }
}

impl core::error::Error for InvalidPayload {}

impl<R: Real, const BODY: usize, const B: usize, const V: usize> Effect<R, B, V>
    for Payload<R, BODY>
{
    const DIFFERENTIABLE: bool = true;
    const ADDED_INERTIA: hook::Inertia<Self, R, B> = hook::Inertia::on_body(BODY, Self::add_to);
}

impl<R: Real, const BODY: usize> Payload<R, BODY> {
    /// Adds the load to the inertia of `body`.
    #[cfg_attr(optimised, inline(always))]
    fn add_to(&self, body: usize, inertia: &mut SpatialInertia<R>) {
        if body == BODY {
            *inertia = *inertia + self.0;
        }
    }
}
