//! The words of an advice: what the number is, why it is remarkable, what to do.

use core::fmt::{Display, Formatter, Result};

use super::{Advice, AdvisedJoint, Frequency};
use core::f64::consts::PI;

/// A number with the digits that a reader needs.
struct Short(f64);

impl Display for Short {
    fn fmt(&self, out: &mut Formatter<'_>) -> Result {
        let x = self.0;
        // Within the digits of an f32.
        let is_whole = (x as f32) == (x as i32) as f32;
        match x.abs() {
            _ if is_whole => write!(out, "{x:.0}"),
            size if !(1e-3..1e7).contains(&size) => write!(out, "{x:.1e}"),
            size if size < 0.1 => write!(out, "{x:.4}"),
            size if size < 10.0 => write!(out, "{x:.2}"),
            size if size < 100.0 => write!(out, "{x:.1}"),
            _ => write!(out, "{x:.0}"),
        }
    }
}

impl Display for AdvisedJoint {
    fn fmt(&self, out: &mut Formatter<'_>) -> Result {
        match self.body {
            Some(body) => write!(out, "joint {} (`{body}`)", self.number),
            None => write!(out, "joint {}", self.number),
        }
    }
}

impl Display for Frequency {
    fn fmt(&self, out: &mut Formatter<'_>) -> Result {
        out.write_str(match self {
            Self::Natural => "the natural frequency",
            Self::DecayRate => "the decay rate",
            Self::Observer => "the observer's bandwidth",
        })
    }
}

impl Display for Advice {
    fn fmt(&self, out: &mut Formatter<'_>) -> Result {
        match *self {
            Self::MassesInGrams { .. }
            | Self::LengthsInMillimetres { .. }
            | Self::InertiasInMillimetres { .. }
            | Self::InertiaInMillimetres { .. }
            | Self::InertiasAboutJoints { .. }
            | Self::InertiaAboutJoint { .. } => self.write_masses(out),
            Self::PositionsInDegrees { .. }
            | Self::PositionInDegrees { .. }
            | Self::SpeedsInDegrees { .. }
            | Self::SpeedInDegrees { .. } => self.write_limits(out),
            Self::ImpossibleInertia { body, ref found } => write!(out, "body `{body}`: {found}"),
            Self::DrivingFriction { .. }
            | Self::NegativeArmature { .. }
            | Self::NegativePayload { .. }
            | Self::NoRotorInertia { .. } => self.write_scene(out),
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
            _ => self.write_loop(out),
        }
    }
}

impl Advice {
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

    fn write_limits(&self, out: &mut Formatter<'_>) -> Result {
        match *self {
            Self::PositionInDegrees { joint, limit } => write!(
                out,
                "{joint}: a position limit of {} rad is {} turns, and joints of robots have less \
                 than two: limits are in rad, this one looks like degrees; divide it by 57.3",
                Short(limit),
                Short(limit.abs() / (2.0 * PI))
            ),
            Self::SpeedInDegrees { joint, limit } => write!(
                out,
                "{joint}: a speed limit of {} rad/s is {} turns a minute, more than 20 times that \
                 of every other joint: limits are in rad/s, this one looks like degrees/s; divide \
                 it by 57.3",
                Short(limit),
                Short(limit * 30.0 / PI)
            ),
            Self::PositionsInDegrees { joint, limit } => write!(
                out,
                "{joint}: a position limit of {} rad is {} turns, and most joints of the robot \
                 have such: limits are in rad, these look like degrees; divide them by 57.3",
                Short(limit),
                Short(limit.abs() / (2.0 * PI))
            ),
            Self::SpeedsInDegrees { joint, limit } => write!(
                out,
                "{joint}: a speed limit of {} rad/s is {} turns a minute, and most joints of the \
                 robot have such: limits are in rad/s, these look like degrees/s; divide them by \
                 57.3",
                Short(limit),
                Short(limit * 30.0 / PI)
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

    fn write_loop(&self, out: &mut Formatter<'_>) -> Result {
        match *self {
            Self::LongTick { tick } => write!(
                out,
                "a tick of {} s means {} ticks a second, where control loops have 50 to 10000: the \
                 tick is in s, 1 ms is 0.001",
                Short(tick),
                Short(1.0 / tick)
            ),
            Self::ZeroRate { joint, torque } => write!(
                out,
                "{joint}: a rate of zero lets its torque never change, although its limit is {} \
                 N·m or N: the joint gets no torque; the rate is a change in a tick, such as half \
                 of the limit, or infinite",
                Short(torque)
            ),
            Self::FarRestart { distance } => write!(
                out,
                "a restart distance of {} rad or m allows a start {}° from the trajectory: it is \
                 in rad, and looks like degrees; 0.15 is usual",
                Short(distance),
                Short(distance * 180.0 / PI)
            ),
            Self::BeyondNyquist { of, frequency, nyquist } => write!(
                out,
                "{of} of {} rad/s is above half the frequency of the ticks, {} rad/s: it cannot \
                 act; lower it, or shorten the tick",
                Short(frequency),
                Short(nyquist)
            ),
            Self::BeyondObserver { of, frequency, bandwidth } => write!(
                out,
                "{of} of {} rad/s is not below the observer's bandwidth of {} rad/s: the velocity \
                 lags behind the feedback; a tenth of the bandwidth is usual",
                Short(frequency),
                Short(bandwidth)
            ),
            Self::BeyondDrive { frequency, bandwidth } => write!(
                out,
                "the natural frequency of {} rad/s is not below the drive's bandwidth of {} rad/s: \
                 the torque lags behind the feedback, which oscillates; a fifth of the bandwidth \
                 is usual",
                Short(frequency),
                Short(bandwidth)
            ),
            Self::CoarseEncoder { joint, resolution, step, speed } => write!(
                out,
                "{joint}: a step of {} rad or m of the encoder changes the estimated velocity by \
                 {} a second, and its greatest speed is {}: the damping becomes noise; lower the \
                 observer's bandwidth, or check the unit of the resolution, rad or m",
                Short(resolution),
                Short(step),
                Short(speed)
            ),
            _ => Ok(()),
        }
    }
}
