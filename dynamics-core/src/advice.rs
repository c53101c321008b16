//! Words on limits and on a controller's configuration: advice, never a refusal.
//!
//! `motion_control::motion::MotionControllerConfig::advice` compares its numbers with those of
//! machines, and names the number, the reason and what to do. The advice on a robot and on a scene
//! is that of the crate `robot-import`, for a host. What stands here is compiled into firmware by
//! those who call it, such as the C library; none of it is in a tick, nor in an image that does not
//! call it.

use core::f64::consts::PI;
use core::fmt::{Display, Formatter, Result};

/// Position, rad: four turns. Robots have up to 1.6 turns; a median of 56° to 360° makes 9 turns or
/// more.
const TURNS: f64 = 8.0 * PI;
/// Speed, rad/s: 573 turns a minute. Robots have a median of up to 32; in degrees/s a slow one has
/// 70.
const SPEED: f64 = 60.0;
/// The speed of one joint over the next one, beside [`SPEED`]: degrees/s make 57.
const FASTER: f64 = 20.0;

/// A joint that an [`Advice`] is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AdvisedJoint {
    /// Its index in q̇.
    pub number: usize,
    /// The name of the body that it moves, where the robot is known.
    pub body: Option<&'static str>,
}

/// A frequency of a control loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Frequency {
    /// The natural frequency ω_n of the feedback.
    Natural,
    /// The rate at which the speed of a held arm decays.
    DecayRate,
    /// The bandwidth of the observer.
    Observer,
}

/// A number that machines do not have, with what it is compared with. SI units.
///
/// [`Display`](core::fmt::Display) says what it is, why it is remarkable and what to do.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Advice {
    /// The limits of position look like degrees.
    PositionsInDegrees {
        /// The joint with the farthest limit.
        joint: AdvisedJoint,
        /// The limit, rad.
        limit: f64,
    },
    /// The limit of position of one joint among others looks like degrees.
    PositionInDegrees {
        /// The joint with the farthest limit.
        joint: AdvisedJoint,
        /// The limit, rad.
        limit: f64,
    },
    /// The limits of speed look like degrees per second.
    SpeedsInDegrees {
        /// The joint with the greatest limit.
        joint: AdvisedJoint,
        /// The limit, rad/s.
        limit: f64,
    },
    /// The limit of speed of one joint among others looks like degrees per second.
    SpeedInDegrees {
        /// The joint.
        joint: AdvisedJoint,
        /// The limit, rad/s.
        limit: f64,
    },
    /// A tick is far longer than that of a control loop.
    LongTick {
        /// The tick, s.
        tick: f64,
    },
    /// The torque may not change: the joint never gets any.
    ZeroRate {
        /// The joint.
        joint: AdvisedJoint,
        /// Its limit of torque, N·m or N.
        torque: f64,
    },
    /// An arm may be started so far from its trajectory that it is not a restart; it looks like
    /// degrees.
    FarRestart {
        /// The distance, rad or m.
        distance: f64,
    },
    /// A frequency is above half that of the ticks, π / h.
    BeyondNyquist {
        /// Which.
        of: Frequency,
        /// The frequency, rad/s.
        frequency: f64,
        /// π / h, rad/s.
        nyquist: f64,
    },
    /// A frequency of the feedback is not below the bandwidth of the observer, whose velocity it
    /// uses.
    BeyondObserver {
        /// Which.
        of: Frequency,
        /// The frequency, rad/s.
        frequency: f64,
        /// The bandwidth, rad/s.
        bandwidth: f64,
    },
    /// The natural frequency of the feedback is not below the bandwidth of the drive's torque.
    BeyondDrive {
        /// The natural frequency, rad/s.
        frequency: f64,
        /// The bandwidth of the drive, rad/s.
        bandwidth: f64,
    },
    /// A count of the encoder changes the estimated velocity by a large share of the joint's
    /// greatest speed.
    CoarseEncoder {
        /// The joint.
        joint: AdvisedJoint,
        /// The encoder's step Δ, rad or m.
        resolution: f64,
        /// The change of velocity ω_o² h Δ, rad/s or m/s.
        step: f64,
        /// The joint's greatest speed, rad/s or m/s.
        speed: f64,
    },
}

impl Advice {
    /// Whether the advice is that numbers are in another unit than that of the library.
    pub const fn is_about_units(&self) -> bool {
        matches!(
            self,
            Self::PositionsInDegrees { .. }
                | Self::PositionInDegrees { .. }
                | Self::SpeedsInDegrees { .. }
                | Self::SpeedInDegrees { .. }
                | Self::LongTick { .. }
                | Self::FarRestart { .. }
        )
    }

    /// The joint that it is about; none of an advice on the robot or the loop.
    pub const fn joint(&self) -> Option<AdvisedJoint> {
        match *self {
            Self::PositionsInDegrees { joint, .. }
            | Self::PositionInDegrees { joint, .. }
            | Self::SpeedsInDegrees { joint, .. }
            | Self::SpeedInDegrees { joint, .. }
            | Self::ZeroRate { joint, .. }
            | Self::CoarseEncoder { joint, .. } => Some(joint),
            _ => None,
        }
    }

    /// The same with the joint's name, from
    /// [`coordinate_names`](crate::model::Model::coordinate_names) or another list of the joints.
    ///
    /// ```
    /// use dynamics_core::advice::{Advice, AdvisedJoint};
    /// let joint = AdvisedJoint { number: 1, body: None };
    /// let advice = Advice::ZeroRate { joint, torque: 9.0 }.named(&["shoulder", "elbow"]);
    /// assert_eq!(
    ///     advice.to_string(),
    ///     "joint 1 (`elbow`): a rate of zero lets its torque never change, although its limit is 9 N·m or N: the joint gets \
    ///      no torque; the rate is a change in a tick, such as half of the limit, or infinite"
    /// );
    /// ```
    #[must_use]
    pub fn named(mut self, names: &[&'static str]) -> Self {
        if let Self::PositionsInDegrees { joint, .. }
        | Self::PositionInDegrees { joint, .. }
        | Self::SpeedsInDegrees { joint, .. }
        | Self::SpeedInDegrees { joint, .. }
        | Self::ZeroRate { joint, .. }
        | Self::CoarseEncoder { joint, .. } = &mut self
        {
            joint.body = names.get(joint.number).copied();
        }
        self
    }
}

/// Whether a limit is one, and not a number that stands for none: infinite, zero, or a power of
/// ten.
#[doc(hidden)]
pub fn is_stated(limit: f64) -> bool {
    let mut power = 100.0;
    while power < limit.abs() && power < 1e30 {
        power *= 10.0;
    }
    // The rounding of an f32.
    let is_power = (limit.abs() - power).abs() <= 1e-6 * power;
    limit.is_finite() && limit != 0.0 && !is_power
}

/// [`Advice::PositionsInDegrees`], if most joints that state limits of position, rad, have one
/// beyond four turns, or [`Advice::PositionInDegrees`], if some do: published robots have up to
/// 1.6.
///
/// Limits that are infinite, zero or a power of ten of 100 or more state none.
///
/// ```
/// use dynamics_core::advice::{Advice, AdvisedJoint, positions_in_degrees};
/// let joint = |number| AdvisedJoint { number, body: None };
/// let advice = positions_in_degrees([(joint(0), [-170.0, 170.0]), (joint(1), [0.0, 120.0])].into_iter());
/// assert_eq!(advice, Some(Advice::PositionsInDegrees { joint: joint(0), limit: 170.0 }));
/// let advice = positions_in_degrees([(joint(0), [-170.0, 170.0]), (joint(1), [0.0, 2.0])].into_iter());
/// assert_eq!(advice, Some(Advice::PositionInDegrees { joint: joint(0), limit: 170.0 }));
/// ```
pub fn positions_in_degrees(
    limits: impl Iterator<Item = (AdvisedJoint, [f64; 2])>,
) -> Option<Advice> {
    let placed = |x: f64| if is_stated(x) { x } else { 0.0 };
    let farther = limits.map(|(joint, ends)| {
        let [lower, upper] = ends.map(placed);
        (joint, if lower.abs() > upper.abs() { lower } else { upper })
    });
    let Greatest { joint, limit, most_beyond, .. } = Greatest::of(farther, TURNS)?;
    Some(if most_beyond {
        Advice::PositionsInDegrees { joint, limit }
    } else {
        Advice::PositionInDegrees { joint, limit }
    })
}

/// [`Advice::SpeedsInDegrees`], if most joints that state a limit of speed, rad/s, have one above
/// 60, or [`Advice::SpeedInDegrees`], if one does and is 20 times the next: published robots have a
/// median of up to 32.
///
/// Limits that are infinite, zero or a power of ten of 100 or more state none.
///
/// ```
/// use dynamics_core::advice::{Advice, AdvisedJoint, speeds_in_degrees};
/// let joint = |number| AdvisedJoint { number, body: None };
/// let speeds = |all: [f64; 2]| speeds_in_degrees([(joint(0), all[0]), (joint(1), all[1])].into_iter());
/// assert_eq!(speeds([3.14, 62.0]), None);
/// assert_eq!(speeds([120.0, 180.0]), Some(Advice::SpeedsInDegrees { joint: joint(1), limit: 180.0 }));
/// assert_eq!(speeds([3.14, 180.0]), Some(Advice::SpeedInDegrees { joint: joint(1), limit: 180.0 }));
/// ```
pub fn speeds_in_degrees(limits: impl Iterator<Item = (AdvisedJoint, f64)>) -> Option<Advice> {
    let greatest = Greatest::of(limits, SPEED)?;
    let (joint, limit) = (greatest.joint, greatest.limit);
    if greatest.most_beyond {
        return Some(Advice::SpeedsInDegrees { joint, limit });
    }
    let is_alone = limit.abs() > FASTER * greatest.next;
    is_alone.then_some(Advice::SpeedInDegrees { joint, limit })
}

/// The greatest of the limits that are stated.
struct Greatest {
    joint: AdvisedJoint,
    limit: f64,
    /// The size of the next one.
    next: f64,
    /// Whether most are beyond the bound.
    most_beyond: bool,
}

impl Greatest {
    /// If it is beyond the bound.
    fn of(joints: impl Iterator<Item = (AdvisedJoint, f64)>, bound: f64) -> Option<Self> {
        let (mut beyond, mut stated, mut next) = (0, 0, 0.0_f64);
        let mut greatest = None::<(AdvisedJoint, f64)>;
        for (joint, limit) in joints.filter(|&(_, limit)| is_stated(limit)) {
            stated += 1;
            beyond += usize::from(limit.abs() > bound);
            match greatest {
                Some((_, before)) if limit.abs() <= before.abs() => next = next.max(limit.abs()),
                before => {
                    next = before.map_or(0.0, |(_, before)| before.abs());
                    greatest = Some((joint, limit));
                }
            }
        }
        let (joint, limit) = greatest.filter(|_| beyond > 0)?;
        Some(Self { joint, limit, next, most_beyond: 2 * beyond > stated })
    }
}

/// A number with the digits that a reader needs.
#[doc(hidden)]
pub struct Short(pub f64);

impl Display for Short {
    /// In integers, since the formatting of floats takes half of an image's flash for advice.
    fn fmt(&self, out: &mut Formatter<'_>) -> Result {
        let (x, mut size, mut exponent) = (self.0, self.0.abs(), 0);
        if !size.is_finite() {
            return out.write_str(match x > 0.0 {
                true => "inf",
                false if x < 0.0 => "-inf",
                false => "NaN",
            });
        }
        // Within the digits of an f32.
        let is_whole = (x as f32) == (x as i32) as f32;
        let digits = match size {
            _ if is_whole => 0,
            1e-3..0.1 => 4,
            0.1..10.0 => 2,
            10.0..100.0 => 1,
            100.0..1e7 => 0,
            _ => {
                while size >= 10.0 {
                    (size, exponent) = (size / 10.0, exponent + 1);
                }
                while size < 1.0 {
                    (size, exponent) = (size * 10.0, exponent - 1);
                }
                1
            }
        };
        let scale = 10_u32.pow(digits);
        let scaled = size * f64::from(scale);
        let down = scaled as u32;
        let rest = scaled - f64::from(down);
        let mut rounded = down + u32::from(rest > 0.5 || (rest == 0.5 && down % 2 == 1));
        if exponent != 0 && rounded == 100 {
            (rounded, exponent) = (10, exponent + 1);
        }
        out.write_str(if x.is_sign_negative() { "-" } else { "" })?;
        write!(out, "{}", rounded / scale)?;
        if digits > 0 {
            write!(out, ".{:01$}", rounded % scale, digits as usize)?;
        }
        if exponent != 0 {
            write!(out, "e{exponent}")?;
        }
        Ok(())
    }
}

impl Display for AdvisedJoint {
    fn fmt(&self, out: &mut Formatter<'_>) -> Result {
        write!(out, "joint {}", self.number)?;
        // In parts, without the code that pads a text.
        self.body.map_or(Ok(()), |body| {
            [" (`", body, "`)"].iter().try_for_each(|part| out.write_str(part))
        })
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
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Short;

    /// Numbers of the whole range of f32 have the text that the formatting of floats gives them.
    #[test]
    fn a_number_has_the_text_of_the_formatting_of_floats() {
        let usual = |x: f64| match x.abs() {
            _ if (x as f32) == (x as i32) as f32 => format!("{x:.0}"),
            1e-3..0.1 => format!("{x:.4}"),
            0.1..10.0 => format!("{x:.2}"),
            10.0..100.0 => format!("{x:.1}"),
            100.0..1e7 => format!("{x:.0}"),
            _ => format!("{x:.1e}"),
        };
        let numbers = [0.125, 99.96, 9.996e8, 9.96e-5, 1e-38, 162.5, f32::NAN, f32::INFINITY];
        let random = (0..200_000_u32).map(|k| f32::from_bits(k.wrapping_mul(0x9e37_79b9)));
        for x in random.chain(numbers).flat_map(|x| [x, -x]).map(f64::from) {
            assert_eq!(Short(x).to_string(), usual(x));
        }
    }
}
