//! The effects that a user composes, in numbers of f64, before a robot and a scalar are known.

use dynamics_core::effects::{
    AsymmetricCoulomb, BodyWrench, Cogging, ConstantTorque, Contact, ContactPoint, Coulomb,
    EndStops, GyroscopicRotors, LoadFriction, Lugre, Spring, Stribeck, Viscous, Width, WorldWrench,
};
use dynamics_core::model::BodyInertia;
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::{Force, Motion};
use serde::{Deserialize, Serialize};

use crate::scene::{AtBody, AtJoint, HARMONICS, Parts};

/// A body by its number or its name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum BodyRef {
    Number(usize),
    Name(String),
}

impl std::fmt::Display for BodyRef {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(number) => write!(out, "of the number {number}"),
            Self::Name(name) => write!(out, "of the name `{name}`"),
        }
    }
}

/// An effect.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Spec {
    Gravity([f64; 3]),
    Inertia,
    Coriolis,
    MovingBase {
        velocity: [f64; 6],
        acceleration: [f64; 6],
    },
    Viscous(Vec<f64>),
    Coulomb {
        torque: Vec<f64>,
        width: f64,
    },
    AsymmetricCoulomb {
        forward: Vec<f64>,
        backward: Vec<f64>,
        width: f64,
    },
    Stribeck {
        excess: Vec<f64>,
        stribeck_speed: f64,
        width: f64,
    },
    Lugre {
        /// stiffness, damping, viscous, sliding, excess, bristle
        values: [Vec<f64>; 6],
        stribeck_speed: f64,
    },
    LoadFriction {
        driving: Vec<f64>,
        backdriving: Vec<f64>,
        width: f64,
    },
    Spring {
        stiffness: Vec<f64>,
        rest: Vec<f64>,
    },
    EndStops {
        lower: Vec<f64>,
        upper: Vec<f64>,
        stiffness: f64,
        damping: f64,
        damping_depth: f64,
    },
    Cogging {
        per_turn: Vec<f64>,
        cos: Vec<Vec<f64>>,
        sin: Vec<Vec<f64>>,
    },
    ConstantTorque(Vec<f64>),
    Armature(Vec<f64>),
    GyroscopicRotors {
        inertia: Vec<f64>,
        ratio: Vec<f64>,
    },
    Payload {
        body: BodyRef,
        mass: f64,
        com: [f64; 3],
        inertia: [f64; 6],
    },
    BodyWrench {
        body: BodyRef,
        wrench: [f64; 6],
    },
    WorldWrench {
        body: BodyRef,
        wrench: [f64; 6],
    },
    Contact {
        points: Vec<(BodyRef, [f64; 3])>,
        normal: [f64; 3],
        /// height, stiffness, damping, friction, slip tolerance
        values: [f64; 5],
        damping_depth: f64,
    },
}

/// An effect that does not fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Unfit {
    /// The effect.
    pub effect: &'static str,
    /// Why not.
    pub problem: String,
}

impl Spec {
    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Gravity(_) => "Gravity",
            Self::Inertia => "Inertia",
            Self::Coriolis => "Coriolis",
            Self::MovingBase { .. } => "MovingBase",
            Self::Viscous(_) => "Viscous",
            Self::Coulomb { .. } => "Coulomb",
            Self::AsymmetricCoulomb { .. } => "AsymmetricCoulomb",
            Self::Stribeck { .. } => "Stribeck",
            Self::Lugre { .. } => "Lugre",
            Self::LoadFriction { .. } => "LoadFriction",
            Self::Spring { .. } => "Spring",
            Self::EndStops { .. } => "EndStops",
            Self::Cogging { .. } => "Cogging",
            Self::ConstantTorque(_) => "ConstantTorque",
            Self::Armature(_) => "Armature",
            Self::GyroscopicRotors { .. } => "GyroscopicRotors",
            Self::Payload { .. } => "Payload",
            Self::BodyWrench { .. } => "BodyWrench",
            Self::WorldWrench { .. } => "WorldWrench",
            Self::Contact { .. } => "Contact",
        }
    }

    /// Whether a scene may contain several: as in the library, whose compiler refuses two of the
    /// others.
    pub fn may_repeat(&self) -> bool {
        matches!(
            self,
            Self::Spring { .. }
                | Self::EndStops { .. }
                | Self::Cogging { .. }
                | Self::ConstantTorque(_)
                | Self::Payload { .. }
                | Self::BodyWrench { .. }
                | Self::WorldWrench { .. }
                | Self::Contact { .. }
        )
    }

    /// Its lists, one number for each velocity coordinate.
    fn lists(&self) -> Vec<&Vec<f64>> {
        match self {
            Self::Viscous(a) | Self::ConstantTorque(a) | Self::Armature(a) => vec![a],
            Self::Coulomb { torque: a, .. } | Self::Stribeck { excess: a, .. } => vec![a],
            Self::AsymmetricCoulomb {
                forward: a,
                backward: b,
                ..
            }
            | Self::LoadFriction {
                driving: a,
                backdriving: b,
                ..
            }
            | Self::Spring {
                stiffness: a,
                rest: b,
            }
            | Self::GyroscopicRotors {
                inertia: a,
                ratio: b,
            }
            | Self::EndStops {
                lower: a, upper: b, ..
            } => vec![a, b],
            Self::Lugre { values, .. } => values.iter().collect(),
            Self::Cogging { per_turn, .. } => vec![per_turn],
            _ => Vec::new(),
        }
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
        if let Spec::Payload {
            mass, com, inertia, ..
        } = spec
        {
            let payload = BodyInertia {
                mass: *mass,
                com: *com,
                inertia: *inertia,
            };
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
    let mut filled = [R::ZERO; N];
    for (filled, &value) in filled.iter_mut().zip(values) {
        *filled = R::from_f64(value);
    }
    filled
}

fn vector<R: Real>([x, y, z]: [f64; 3]) -> R::Vec3 {
    R::Vec3::new(R::from_f64(x), R::from_f64(y), R::from_f64(z))
}

fn width<R: Real>(value: f64) -> Width<R> {
    Width::new(R::from_f64(value))
}

fn motion<R: Real>([a, b, c, d, e, f]: [f64; 6]) -> Motion<R> {
    Motion::new(vector::<R>([a, b, c]), vector::<R>([d, e, f]))
}

fn force<R: Real>([a, b, c, d, e, f]: [f64; 6]) -> Force<R> {
    Force::new(vector::<R>([a, b, c]), vector::<R>([d, e, f]))
}

/// The effects for a robot, of which [`fit`] has said that they do.
pub(crate) fn parts<R: Real, const V: usize>(
    specs: &[Spec],
    body: &dyn Fn(&BodyRef) -> usize,
) -> Parts<R, V> {
    let mut parts = Parts {
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
            Spec::Gravity(g) => parts.gravity = vector::<R>(*g),
            Spec::Inertia | Spec::Coriolis => {}
            Spec::MovingBase {
                velocity,
                acceleration,
            } => parts.base = Some((motion(*velocity), motion(*acceleration))),
            Spec::Armature(values) => parts.armature = Some(array(values)),
            Spec::GyroscopicRotors { inertia, ratio } => {
                parts.rotors = Some(GyroscopicRotors {
                    inertia: array(inertia),
                    ratio: array(ratio),
                });
            }
            Spec::LoadFriction {
                driving,
                backdriving,
                width: at,
            } => {
                parts.gears = Some(LoadFriction {
                    driving: array(driving),
                    backdriving: array(backdriving),
                    width: width(*at),
                });
            }
            Spec::Payload {
                body: on,
                mass,
                com,
                inertia,
            } => {
                let payload = BodyInertia {
                    mass: R::from_f64(*mass),
                    com: com.map(R::from_f64),
                    inertia: inertia.map(R::from_f64),
                };
                let payload = dynamics_core::effects::Payload::<R, 0>::from_inertia(payload);
                parts.payloads.push((body(on), payload.0));
            }
            Spec::BodyWrench { body: on, wrench } => {
                parts.wrenches.push(AtBody::Body(BodyWrench {
                    body: body(on),
                    wrench: force(*wrench),
                }))
            }
            Spec::WorldWrench { body: on, wrench } => {
                parts.wrenches.push(AtBody::World(WorldWrench {
                    body: body(on),
                    wrench: force(*wrench),
                }));
            }
            Spec::Contact {
                points,
                normal,
                values,
                damping_depth,
            } => {
                let [height, stiffness, damping, friction, slip_tolerance] =
                    values.map(R::from_f64);
                for (on, point) in points {
                    let points = [ContactPoint {
                        body: body(on),
                        point: vector::<R>(*point),
                    }];
                    parts.wrenches.push(AtBody::Contact(Contact {
                        points,
                        normal: vector::<R>(*normal),
                        height,
                        stiffness,
                        damping,
                        damping_depth: width(*damping_depth),
                        friction,
                        slip_tolerance,
                    }));
                }
            }
            at_joint => parts.joints.extend(of_joints(at_joint)),
        }
    }
    parts
}

/// An effect at joints.
fn of_joints<R: Real, const V: usize>(spec: &Spec) -> Option<AtJoint<R, V>> {
    Some(match spec {
        Spec::Viscous(values) => AtJoint::Viscous(Viscous(array(values))),
        Spec::Coulomb { torque, width: at } => AtJoint::Coulomb(Coulomb {
            torque: array(torque),
            width: width(*at),
        }),
        Spec::AsymmetricCoulomb {
            forward,
            backward,
            width: at,
        } => AtJoint::Asymmetric(AsymmetricCoulomb {
            forward: array(forward),
            backward: array(backward),
            width: width(*at),
        }),
        Spec::Stribeck {
            excess,
            stribeck_speed,
            width: at,
        } => AtJoint::Stribeck(Stribeck {
            excess: array(excess),
            stribeck_speed: width(*stribeck_speed),
            width: width(*at),
        }),
        Spec::Lugre {
            values: [stiffness, damping, viscous, sliding, excess, bristle],
            stribeck_speed,
        } => AtJoint::Lugre(Lugre {
            stiffness: array(stiffness),
            damping: array(damping),
            viscous: array(viscous),
            sliding: array(sliding),
            excess: array(excess),
            stribeck_speed: width(*stribeck_speed),
            bristle: array(bristle),
        }),
        Spec::Spring { stiffness, rest } => AtJoint::Spring(Spring {
            stiffness: array(stiffness),
            rest: array(rest),
        }),
        Spec::EndStops {
            lower,
            upper,
            stiffness,
            damping,
            damping_depth,
        } => AtJoint::EndStops(EndStops {
            lower: array(lower),
            upper: array(upper),
            stiffness: R::from_f64(*stiffness),
            damping: R::from_f64(*damping),
            damping_depth: width(*damping_depth),
        }),
        Spec::ConstantTorque(values) => AtJoint::Constant(ConstantTorque(array(values))),
        Spec::Cogging { per_turn, cos, sin } => {
            let rows = |given: &[Vec<f64>]| {
                std::array::from_fn(|i| array(given.get(i).map_or(&[], Vec::as_slice)))
            };
            AtJoint::Cogging(Box::new(Cogging {
                per_turn: array(per_turn),
                cos: rows(cos),
                sin: rows(sin),
            }))
        }
        _ => return None,
    })
}
