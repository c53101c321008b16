//! The words of an advice: what the number is, why it is remarkable, what to do.

use std::fmt::{Display, Formatter, Result};

use dynamics_core::advice::Short;

use super::NumberAdvice;

impl Display for NumberAdvice {
    fn fmt(&self, out: &mut Formatter<'_>) -> Result {
        match *self {
            Self::Limit(advice) => advice.fmt(out),
            Self::ImpossibleInertia { body, ref found } => write!(out, "body `{body}`: {found}"),
            Self::TorqueLimitsFarAbove { joint, limit, needed } => {
                let times = Short(limit / needed);
                let (limit, needed) = (Short(limit), Short(needed));
                write!(
                    out,
                    "{joint}: its torque limit of {limit} N·m or N is {times} times the {needed} \
                     that hold all it moves, stretched out horizontally; those of the other joints \
                     are even further above their need, so that none of them limits anything: take \
                     those of the motors and gears"
                )
            }
            Self::GravityBeyondTorque { joint, needed, limit } => {
                let (needed, limit) = (Short(needed), Short(limit));
                write!(
                    out,
                    "{joint}: gravity needs {needed} N·m or N at a configuration within the \
                     limits, its torque limit is {limit}: the motor does not hold the robot there; \
                     check masses and the limit, or narrow the limits of position"
                )
            }
            Self::DrivingFriction { .. }
            | Self::NegativeArmature { .. }
            | Self::NegativePayload { .. }
            | Self::NoRotorInertia { .. } => self.write_scene(out),
            _ => self.write_masses(out),
        }
    }
}

impl NumberAdvice {
    fn write_masses(&self, out: &mut Formatter<'_>) -> Result {
        match *self {
            Self::MassesInGrams { robot, mass, reach } => write!(
                out,
                "robot `{robot}`: {} kg within a reach of {} m are {} kg for each cubic metre of \
                 it, where robots have 3 to 130: masses are in kg, these look like g; divide them \
                 and the inertias by 1000",
                Short(mass),
                Short(reach),
                Short(mass / (reach * reach * reach))
            ),
            Self::LengthsInMillimetres { robot, mass, reach } => write!(
                out,
                "robot `{robot}`: a reach of {} m with a mass of {} kg: lengths are in m, these \
                 look like mm; divide them by 1000, inertias by 1e6",
                Short(reach),
                Short(mass)
            ),
            Self::InertiasInMillimetres { body, gyration, reach } => write!(
                out,
                "body `{body}`: its inertia is that of a mass {} m from the centre, and most \
                 bodies' are beyond ten times the robot's reach of {} m: inertias are in kg·m², \
                 these look like kg·mm² or g·mm²; divide them by 1e6 or 1e9",
                Short(gyration),
                Short(reach)
            ),
            Self::InertiasAboutJoints { body, inertia, shift } => write!(
                out,
                "body `{body}`: of its inertia of {} kg·m² the distance of the centre of mass from \
                 the joint would be {}, and so of all bodies whose centre is far: inertias are \
                 about the centre of mass, these look like those about the joint; subtract m d²",
                Short(inertia),
                Short(shift)
            ),
            Self::InertiaInMillimetres { body, gyration, reach } => write!(
                out,
                "body `{body}`: its inertia is that of a mass {} m from the centre, and the \
                 robot's reach is {} m: inertias are in kg·m², this one looks like kg·mm² or \
                 g·mm²; divide it by 1e6 or 1e9",
                Short(gyration),
                Short(reach)
            ),
            Self::InertiaAboutJoint { body, inertia, shift } => write!(
                out,
                "body `{body}`: its inertia of {} kg·m² is more than masses between its joints \
                 have, and without the {} of the distance of its centre of mass from the joint it \
                 is not: inertias are about the centre of mass, this one looks like that about the \
                 joint; subtract m d²",
                Short(inertia),
                Short(shift)
            ),
            _ => Ok(()),
        }
    }

    fn write_scene(&self, out: &mut Formatter<'_>) -> Result {
        match *self {
            Self::DrivingFriction { joint, speed, torque } => write!(
                out,
                "{joint}: at {} rad/s or m/s the friction of the scene is {} N·m or N: it drives \
                 the joint in place of braking it; no coefficient of friction is negative",
                Short(speed),
                Short(torque)
            ),
            Self::NegativeArmature { joint, inertia } => write!(
                out,
                "{joint}: the scene adds an inertia of {} kg·m² or kg at it, and none is negative",
                Short(inertia)
            ),
            Self::NegativePayload { body, mass } => write!(
                out,
                "body `{body}`: its payload has a mass of {} kg, and none is negative",
                Short(mass)
            ),
            Self::NoRotorInertia { joint } => write!(
                out,
                "{joint}: the scene has the friction of its gear and no inertia of its rotor, \
                 which, times the square of the gear's ratio, often exceeds that of the links: add \
                 `Armature`"
            ),
            _ => Ok(()),
        }
    }
}
