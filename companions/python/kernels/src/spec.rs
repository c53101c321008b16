//! The effects that a user composes, in numbers of f64, before a robot and a scalar are known.

use dynamics_core::effects::{
    AsymmetricCoulomb, BodyWrench, Cogging, ConstantTorque, Contact, ContactPoint, Coulomb,
    EndStops, GyroscopicRotors, LoadFriction, Lugre, Spring, Stribeck, Viscous, Width, WorldWrench,
};
use dynamics_core::model::BodyInertia;
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::{Force, Motion};
use serde::{Deserialize, Serialize};

use crate::scene::{At, AtBody, AtJoint, HARMONICS, Parts, Terms};

/// A body by its number or its name, or a point in the frame of the body of a number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum BodyRef {
    Number(usize),
    Name(String),
    Point(usize, Three),
}

impl std::fmt::Display for BodyRef {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(number) | Self::Point(number, _) => write!(out, "of the number {number}"),
            Self::Name(name) => write!(out, "of the name `{name}`"),
        }
    }
}

/// A number for each velocity coordinate.
pub type List = Vec<f64>;
/// Numbers for each velocity coordinate.
pub type Table = Vec<List>;
/// A number without conditions.
pub type Number = f64;
/// A number by which the library divides.
pub type Nonzero = f64;
/// A width of the library, by which it divides.
pub type Wide = f64;
/// A vector of three coordinates.
pub type Three = [f64; 3];
/// A vector of length 1.
pub type Unit = [f64; 3];
/// A spatial vector, angular part first.
pub type Six = [f64; 6];
/// Points in the frames of bodies.
pub type Points = Vec<(BodyRef, Three)>;

/// Gives a macro all effects but those of rigid bodies: the documentation, the name, and the
/// fields with the type, and the value if none is given; where a value is no number, the signature
/// in Python.
#[macro_export]
macro_rules! effects {
    ($then:ident) => {
        $then! {
            /// A base that moves: spatial velocity (rad/s, m/s) and acceleration (rad/s², m/s²),
            /// angular part first, at its origin and in its axes.
            MovingBase { velocity: Six, acceleration: Six }

            /// Viscous friction b q̇: b of each velocity coordinate, N·m·s/rad or N·s/m.
            Viscous { coefficients: List }

            /// Dry friction: the torque of each velocity coordinate, N·m or N, which is full beyond
            /// the speed ``width``, rad/s or m/s.
            Coulomb { torque: List, width: Wide }

            /// Dry friction that differs by direction: torques N·m or N, width rad/s or m/s.
            AsymmetricCoulomb { forward: List, backward: List, width: Wide }

            /// The excess of friction at low speed, N·m or N, which falls with the speed
            /// ``stribeck_speed``; widths rad/s or m/s.
            Stribeck { excess: List, stribeck_speed: Wide, width: Wide }

            /// The LuGre model at a given deflection of its bristles, rad or m: stiffness, damping,
            /// viscous, sliding and excess of each velocity coordinate. The bristles stand still
            /// here; a simulation advances them.
            Lugre {
                stiffness: List, damping: List, viscous: List, sliding: List, excess: List,
                stribeck_speed: Wide, bristle: List
            }

            /// Friction of gears that grows with the load: the factors when driving and when
            /// driven, and a width, rad/s or m/s.
            LoadFriction { driving: List, backdriving: List, width: Wide }

            /// A spring at each joint: stiffness N·m/rad or N/m, rest position rad or m.
            Spring { stiffness: List, rest: List }

            /// Stops at both ends of each joint: positions rad or m, stiffness N·m/rad, damping
            /// N·m·s/rad from a depth of ``damping_depth`` rad on.
            EndStops {
                lower: List, upper: List, stiffness: Number, damping: Number, damping_depth: Wide
            }

            /// Cogging: periods per turn of each joint, and per joint the torques of up to 8
            /// harmonics, N·m. Periods times angle may be up to 10⁴ rad in float32 and 10⁵ rad in
            /// float64.
            Cogging { per_turn: List, cos: Table, sin: Table }

            /// A constant torque that the motor of each joint supplies in any state, N·m or N: the
            /// offset of a sensor, or the mean of a friction that differs with direction.
            ConstantTorque { torque: List }

            /// The inertia of each motor at its joint, kg·m² or kg.
            Armature { inertia: List }

            /// Rotors that spin on the links before their joints: moment of inertia of each about
            /// its axis, kg·m², and the ratio of its gear, rad of the rotor per rad or m of the
            /// joint, negative for the opposite sense; zeros where there is none.
            ///
            /// `Armature` of I ρ² has their inertia at the joints alone. `centroidal_matrix` and
            /// `osim_inverse` do not take them.
            GyroscopicRotors { inertia: List, ratio: List }

            /// A load on a body: mass kg, centre of mass m in the body's frame, inertia about it
            /// (xx, xy, xz, yy, yz, zz) kg·m².
            Payload { body: BodyRef, mass: Number, com: Three = [0.0; 3], inertia: Six = [0.0; 6] }
            "(body, mass, com=[0.0, 0.0, 0.0], inertia=[0.0, 0.0, 0.0, 0.0, 0.0, 0.0])"

            /// A wrench on a body in its own frame: couple N·m, then force N.
            BodyWrench { body: BodyRef, wrench: Six }

            /// A wrench at a body's origin in the base's axes: couple N·m, then force N.
            WorldWrench { body: BodyRef, wrench: Six }

            /// Points of bodies that touch a plane n·x = height (m), n being ``normal``, a vector
            /// of length 1: stiffness N/m, damping N·s/m from ``damping_depth`` m on, coefficient
            /// of friction, and the speed below which friction sticks, m/s.
            Contact {
                points: Points, normal: Unit, height: Number, stiffness: Number, damping: Number,
                damping_depth: Wide, friction: Number, slip_tolerance: Nonzero
            }
        }
    };
}

/// A field of an effect.
trait Field {
    /// Whether all its numbers are finite.
    fn all_finite(&self) -> bool;
    /// The list that it is.
    fn list(&self) -> Option<&List> {
        None
    }
}

impl Field for f64 {
    fn all_finite(&self) -> bool {
        self.is_finite()
    }
}

impl<const N: usize> Field for [f64; N] {
    fn all_finite(&self) -> bool {
        self.iter().all(|x| x.is_finite())
    }
}

impl Field for List {
    fn all_finite(&self) -> bool {
        self.iter().all(|x| x.is_finite())
    }
    fn list(&self) -> Option<&List> {
        Some(self)
    }
}

impl Field for Table {
    fn all_finite(&self) -> bool {
        self.iter().flatten().all(|x| x.is_finite())
    }
}

impl Field for BodyRef {
    fn all_finite(&self) -> bool {
        true
    }
}

impl Field for Points {
    fn all_finite(&self) -> bool {
        self.iter().all(|(_, point)| point.all_finite())
    }
}

macro_rules! spec {
    ($($(#[$doc:meta])* $name:ident {
        $($field:ident: $kind:ident $(= $default:expr)?),*
    } $($text:literal)?)*) => {
        /// An effect as Python describes it.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        pub enum Spec {
            Gravity([f64; 3]),
            Inertia,
            Coriolis,
            $($name { $($field: $kind),* },)*
        }

        impl Spec {
            /// The name of its class in Python.
            pub fn name(&self) -> &'static str {
                match self {
                    Self::Gravity(_) => "Gravity",
                    Self::Inertia => "Inertia",
                    Self::Coriolis => "Coriolis",
                    $(Self::$name { .. } => stringify!($name),)*
                }
            }

            /// Whether all its numbers are finite.
            pub fn all_finite(&self) -> bool {
                match self {
                    Self::Gravity(g) => g.all_finite(),
                    Self::Inertia | Self::Coriolis => true,
                    $(Self::$name { $($field),* } => true $(&& $field.all_finite())*,)*
                }
            }

            /// Its lists, one number for each velocity coordinate.
            fn lists(&self) -> Vec<&List> {
                let all = match self {
                    Self::Gravity(_) | Self::Inertia | Self::Coriolis => Vec::new(),
                    $(Self::$name { $($field),* } => vec![$($field.list()),*],)*
                };
                all.into_iter().flatten().collect()
            }
        }
    };
}

effects!(spec);

/// An effect that does not fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Unfit {
    /// The name of the effect.
    pub effect: &'static str,
    /// The reason why it does not fit.
    pub problem: String,
}

impl Spec {
    /// Whether a scene may contain several: as in the library, whose compiler refuses two of the
    /// others.
    pub fn may_repeat(&self) -> bool {
        matches!(
            self,
            Self::Spring { .. }
                | Self::EndStops { .. }
                | Self::Cogging { .. }
                | Self::ConstantTorque { .. }
                | Self::Payload { .. }
                | Self::BodyWrench { .. }
                | Self::WorldWrench { .. }
                | Self::Contact { .. }
        )
    }

    /// Whether it acts at bodies, at the base, in gears or by rotors that spin.
    pub fn is_extra(&self) -> bool {
        matches!(
            self,
            Self::MovingBase { .. }
                | Self::GyroscopicRotors { .. }
                | Self::LoadFriction { .. }
                | Self::Payload { .. }
                | Self::BodyWrench { .. }
                | Self::WorldWrench { .. }
                | Self::Contact { .. }
        )
    }

    /// Whether it is friction with a coefficient or torque below zero.
    pub fn is_negative_friction(&self) -> bool {
        let (one, other) = match self {
            Self::Viscous { coefficients } => (coefficients, coefficients),
            Self::Coulomb { torque, .. } => (torque, torque),
            Self::AsymmetricCoulomb { forward, backward, .. } => (forward, backward),
            Self::LoadFriction { driving, backdriving, .. } => (driving, backdriving),
            Self::Lugre { viscous, sliding, .. } => (viscous, sliding),
            _ => return false,
        };
        one.iter().chain(other).any(|x| *x < 0.0)
    }

    /// Whether the library knows the derivatives of what it adds.
    pub fn is_differentiable(&self) -> bool {
        match self {
            Self::Payload { .. } | Self::MovingBase { .. } => true,
            _ => {
                !self.is_extra()
                    && of_joints::<f64>(self).is_none_or(|effect| effect.is_differentiable())
            }
        }
    }
}

/// Why the effects cannot act on a robot of so many velocity coordinates; `alone` says whether a
/// coordinate is its joint's only one, `body` finds a body.
///
/// # Errors
/// A list of another length, a rotor at a joint of several coordinates, or a body that the robot
/// does not have.
pub fn fit(
    specs: &[Spec],
    v: usize,
    alone: impl Fn(usize) -> bool,
    body: impl Fn(&BodyRef) -> Result<usize, String>,
) -> Result<(), Unfit> {
    for spec in specs {
        let effect = spec.name();
        let refuse = |problem| Err(Unfit { effect, problem });
        for list in spec.lists() {
            if list.len() != v {
                let problem = format!("it has {} numbers for {v} velocity coordinates", list.len());
                return refuse(problem);
            }
        }
        if let Spec::GyroscopicRotors { inertia, .. } = spec {
            let mut rotors = inertia.iter().enumerate();
            if let Some((at, _)) = rotors.find(|&(at, &inertia)| inertia != 0.0 && !alone(at)) {
                return refuse(format!("the joint of velocity coordinate {at} has several"));
            }
        }
        let bodies: Vec<&BodyRef> = match spec {
            Spec::Payload { body, .. }
            | Spec::BodyWrench { body, .. }
            | Spec::WorldWrench { body, .. } => vec![body],
            Spec::Contact { points, .. } => points.iter().map(|(body, _)| body).collect(),
            _ => Vec::new(),
        };
        for given in bodies {
            if let Err(problem) = body(given) {
                return refuse(problem);
            }
        }
        if let Spec::Cogging { per_turn, cos, sin } = spec {
            let fits = |rows: &[Vec<f64>]| {
                rows.len() == per_turn.len() && rows.iter().all(|row| row.len() <= HARMONICS)
            };
            if !fits(cos) || !fits(sin) {
                let problem =
                    format!("it needs up to {HARMONICS} harmonics for each velocity coordinate");
                return refuse(problem);
            }
        }
        if let Spec::Payload { mass, com, inertia, .. } = spec {
            let payload = BodyInertia { mass: *mass, com: *com, inertia: *inertia };
            if let Err(problem) = dynamics_core::effects::Payload::<f64, 0>::try_new(payload, 1e-6)
            {
                let text = problem.to_string();
                return refuse(text.replacen("payload of body 0: ", "", 1));
            }
        }
    }
    Ok(())
}

fn array<R: Real, const N: usize>(values: &[f64]) -> [R; N] {
    std::array::from_fn(|i| values.get(i).map_or(R::ZERO, number))
}

fn rows<R: Real, const N: usize>(given: &[List]) -> [[R; HARMONICS]; N] {
    std::array::from_fn(|i| array(given.get(i).map_or(&[], Vec::as_slice)))
}

fn number<R: Real>(x: &f64) -> R {
    R::from_f64(*x)
}

fn vector<R: Real>([x, y, z]: &[f64; 3]) -> R::Vec3 {
    R::Vec3::new(number(x), number(y), number(z))
}

fn wide<R: Real>(value: &f64) -> Width<R> {
    Width::new(number(value))
}

fn motion<R: Real>(&[a, b, c, d, e, f]: &[f64; 6]) -> Motion<R> {
    Motion::new(vector::<R>(&[a, b, c]), vector::<R>(&[d, e, f]))
}

fn force<R: Real>(&[a, b, c, d, e, f]: &[f64; 6]) -> Force<R> {
    Force::new(vector::<R>(&[a, b, c]), vector::<R>(&[d, e, f]))
}

/// The library's effect of fields, each with the function that makes it of the user's.
macro_rules! made {
    ($name:ident { $($field:ident: $by:ident $(= $from:ident)?),* }) => {
        $name { $($field: $by(made!(@ $field $($from)?))),* }
    };
    (@ $field:ident) => { $field };
    (@ $field:ident $from:ident) => { $from };
}

/// The effects for a robot, of which [`fit`] has said that they do.
pub(crate) fn parts<R: Real, const V: usize>(
    specs: &[Spec],
    body: &dyn Fn(&BodyRef) -> usize,
) -> Parts<R, V> {
    let mut parts = Parts {
        terms: terms_of(specs),
        gravity: <R::Vec3 as Vector<R>>::ZERO,
        joints: Vec::new(),
        armature: None,
        rotors: None,
        base: None,
        payloads: Vec::new(),
        wrenches: Vec::new(),
        gears: None,
    };
    for spec in specs {
        match spec {
            Spec::Gravity(g) => parts.gravity = vector::<R>(g),
            Spec::Inertia | Spec::Coriolis => {}
            Spec::MovingBase { velocity, acceleration } => {
                parts.base = Some((motion(velocity), motion(acceleration)))
            }
            Spec::Armature { inertia } => parts.armature = Some(array(inertia)),
            Spec::GyroscopicRotors { inertia, ratio } => {
                parts.rotors = Some(made!(GyroscopicRotors { inertia: array, ratio: array }));
            }
            Spec::LoadFriction { driving, backdriving, width } => {
                parts.gears =
                    Some(made!(LoadFriction { driving: array, backdriving: array, width: wide }));
            }
            Spec::Payload { body: on, mass, com, inertia } => {
                let payload = made!(BodyInertia { mass: number, com: array, inertia: array });
                let payload = dynamics_core::effects::Payload::<R, 0>::from_inertia(payload);
                parts.payloads.push((body(on), payload.0));
            }
            Spec::BodyWrench { body: on, wrench } => {
                let wrench = made!(BodyWrench { body: body = on, wrench: force });
                parts.wrenches.push(AtBody::Body(wrench));
            }
            Spec::WorldWrench { body: on, wrench } => {
                let wrench = made!(WorldWrench { body: body = on, wrench: force });
                let at = match on {
                    BodyRef::Point(_, point) => Some(vector::<R>(point)),
                    _ => None,
                };
                parts.wrenches.push(AtBody::World(wrench, at));
            }
            Spec::Contact {
                points,
                normal,
                height,
                stiffness,
                damping,
                damping_depth,
                friction,
                slip_tolerance,
            } => {
                for (on, point) in points {
                    let at = |point: &[f64; 3]| {
                        [ContactPoint { body: body(on), point: vector::<R>(point) }]
                    };
                    let normal_of = vector::<R>;
                    parts.wrenches.push(AtBody::Contact(made!(Contact {
                        points: at = point,
                        normal: normal_of = normal,
                        height: number,
                        stiffness: number,
                        damping: number,
                        damping_depth: wide,
                        friction: number,
                        slip_tolerance: number
                    })));
                }
            }
            at_joint => parts.joints.extend(of_joints::<R>(at_joint)),
        }
    }
    parts
}

/// The joint effect that a description stands for; `None` if it acts elsewhere. It is compiled for
/// the largest model alone.
fn of_joints<R: Real>(spec: &Spec) -> Option<Box<dyn AtJoint<R>>> {
    macro_rules! at_joints {
        ($($name:ident { $($field:ident: $by:ident),* })*) => {
            match spec {
                Spec::Viscous { coefficients } => {
                    Box::new(At(Viscous(array(coefficients))))
                }
                Spec::ConstantTorque { torque } => {
                    Box::new(At(ConstantTorque(array(torque))))
                }
                $(Spec::$name { $($field),* } => {
                    Box::new(At($name { $($field: $by($field)),* }))
                })*
                _ => return None,
            }
        };
    }
    Some(at_joints! {
        Coulomb { torque: array, width: wide }
        AsymmetricCoulomb { forward: array, backward: array, width: wide }
        Stribeck { excess: array, stribeck_speed: wide, width: wide }
        Lugre {
            stiffness: array, damping: array, viscous: array, sliding: array, excess: array,
            stribeck_speed: wide, bristle: array
        }
        Spring { stiffness: array, rest: array }
        EndStops { lower: array, upper: array, stiffness: number, damping: number, damping_depth: wide }
        Cogging { per_turn: array, cos: rows, sin: rows }
    })
}

/// The terms that the effects of a scene have.
pub fn terms_of(effects: &[Spec]) -> Terms {
    let mut terms = Terms::default();
    for effect in effects {
        match effect {
            Spec::Inertia => terms.inertia = true,
            Spec::Coriolis => terms.coriolis = true,
            effect => terms.extra |= effect.is_extra(),
        }
    }
    terms
}
