//! From the angle of a sensor or motor shaft to that of the joint, and back.

use core::f32::consts::TAU;
use core::fmt;

/// The most that a zero may be in rad, and a ratio or its inverse: within it no conversion of a
/// count overflows.
const MOST: f32 = 1e6;

/// The direction in which a joint turns while the angle of its sensor or motor increases.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// The joint's angle increases too.
    #[default]
    Forward,
    /// The joint's angle decreases while the shaft's grows.
    Reverse,
}

impl Direction {
    /// The factor of this direction, +1 or −1.
    pub const fn sign(self) -> f32 {
        match self {
            Self::Forward => 1.0,
            Self::Reverse => -1.0,
        }
    }
}

/// The reason why a mapping, a resolution or a conversion was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MappingError {
    /// The zero is NaN or beyond ±10⁶ rad.
    Zero,
    /// The ratio is NaN or outside 10⁻⁶ to 10⁶.
    Ratio,
    /// The counts per turn are outside 1 to 2²⁴.
    Counts,
    /// The quantity to convert, or its result, is not finite.
    NotFinite,
    /// The range of the joint is not a number, has its ends in the wrong order, or is too many
    /// turns of the encoder away.
    Range,
    /// The range of the joint is longer than a turn of the encoder, which then does not say where
    /// the joint is.
    Turns,
    /// A turn of the encoder is not a whole number of turns of the continuous joint.
    Circle,
    /// The step of the joint in a tick is not above zero, or half a turn of the encoder and more.
    Step,
}

impl fmt::Display for MappingError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Zero => "the zero of the joint is not within ±1e6 rad",
            Self::Ratio => "the ratio of the gear is not within 1e-6 to 1e6",
            Self::Counts => "the counts per turn are not within 1 to 2^24",
            Self::NotFinite => "the quantity of the joint is not finite",
            Self::Range => {
                "the range of the joint is not one, or too many turns of the encoder away"
            }
            Self::Turns => "the range of the joint is longer than a turn of the encoder",
            Self::Circle => "a turn of the encoder is not a whole number of turns of the joint",
            Self::Step => "the joint moves by half a turn of the encoder in a tick, or not at all",
        })
    }
}

impl core::error::Error for MappingError {}

/// A joint's zero, its direction, and the turns of the shaft for one of the joint.
///
/// With x of the shaft on which a sensor or motor sits, q of the joint, the zero x₀, the sign s and
/// the ratio N: q = s (x − x₀) / N, q̇ = s ẋ / N, and the torque of the joint is s N times that of
/// the shaft, without friction.
///
/// ```
/// use joint_drivers::{Direction, JointMapping, MappingError};
/// let geared = JointMapping::new(0.5, Direction::Reverse, 100.0)?;
/// assert_eq!(geared.position(50.5)?, -0.5); // rad
/// assert_eq!(geared.shaft_position(-0.5)?, 50.5);
/// assert_eq!(geared.torque(0.2)?, -20.0); // N·m at the joint
/// assert_eq!(JointMapping::new(f32::NAN, Direction::Forward, 1.0), Err(MappingError::Zero));
/// # Ok::<(), MappingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointMapping {
    zero: f32,
    /// s / N, and s N: neither conversion divides.
    to_joint: f32,
    to_shaft: f32,
}

impl JointMapping {
    /// The joint's own angle: zero at zero, forward, one to one.
    pub const IDENTITY: Self = Self { zero: 0.0, to_joint: 1.0, to_shaft: 1.0 };

    /// A joint that is at zero while the shaft is at `zero` rad, and of which one turn is `ratio`
    /// turns of the shaft.
    ///
    /// # Errors
    /// [`MappingError::Zero`] and [`MappingError::Ratio`]: outside their ranges, or NaN.
    pub const fn new(zero: f32, direction: Direction, ratio: f32) -> Result<Self, MappingError> {
        if !(zero >= -MOST && zero <= MOST) {
            return Err(MappingError::Zero);
        }
        if !(ratio >= 1.0 / MOST && ratio <= MOST) {
            return Err(MappingError::Ratio);
        }
        Ok(Self { zero, to_joint: direction.sign() / ratio, to_shaft: direction.sign() * ratio })
    }

    /// The shaft's angle where the joint is at zero, rad.
    pub(crate) const fn zero(&self) -> f32 {
        self.zero
    }

    /// Turns of the shaft in one of the joint.
    pub(crate) const fn ratio(&self) -> f32 {
        self.to_shaft.abs()
    }

    /// The same, with the sign of the direction.
    pub(crate) const fn shaft_per_joint(&self) -> f32 {
        self.to_shaft
    }

    /// Which way the joint turns.
    pub const fn direction(&self) -> Direction {
        if self.to_joint > 0.0 { Direction::Forward } else { Direction::Reverse }
    }

    /// The joint's position in rad while the shaft is at `shaft` rad. Cost: 2 flops.
    ///
    /// # Errors
    /// [`MappingError::NotFinite`].
    pub fn position(&self, shaft: f32) -> Result<f32, MappingError> {
        finite(self.joint_position(shaft))
    }

    /// The shaft's position in rad while the joint is at `joint` rad. Cost: 2 flops.
    ///
    /// # Errors
    /// [`MappingError::NotFinite`].
    pub fn shaft_position(&self, joint: f32) -> Result<f32, MappingError> {
        finite(joint * self.to_shaft + self.zero)
    }

    /// The joint's velocity in rad/s while the shaft turns at `shaft` rad/s.
    ///
    /// # Errors
    /// [`MappingError::NotFinite`].
    pub fn velocity(&self, shaft: f32) -> Result<f32, MappingError> {
        finite(shaft * self.to_joint)
    }

    /// The torque in N·m at the joint for `shaft` N·m at the shaft.
    ///
    /// # Errors
    /// [`MappingError::NotFinite`].
    pub fn torque(&self, shaft: f32) -> Result<f32, MappingError> {
        finite(shaft * self.to_shaft)
    }

    /// The torque in N·m at the shaft for `joint` N·m at the joint.
    ///
    /// # Errors
    /// [`MappingError::NotFinite`].
    pub fn shaft_torque(&self, joint: f32) -> Result<f32, MappingError> {
        finite(joint * self.to_joint)
    }

    /// The position of [`Self::position`] without its check.
    #[inline(always)]
    pub(crate) fn joint_position(&self, shaft: f32) -> f32 {
        (shaft - self.zero) * self.to_joint
    }
}

fn finite(quantity: f32) -> Result<f32, MappingError> {
    if quantity.is_finite() { Ok(quantity) } else { Err(MappingError::NotFinite) }
}

/// The counts per turn of an encoder.
///
/// ```
/// use joint_drivers::{MappingError, Resolution};
/// let lines = Resolution::new(4 * 500)?; // 500 lines, of which quadrature counts each edge
/// assert_eq!(lines.angle(-500), -core::f32::consts::FRAC_PI_2);
/// assert_eq!(Resolution::from_bits(14)?.counts(), 16_384);
/// assert_eq!(Resolution::new(0), Err(MappingError::Counts));
/// # Ok::<(), MappingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    counts: u32,
    per_count: f32,
}

impl Resolution {
    /// `counts` per turn, 1 to 2²⁴: in f32 each count of one turn is exact.
    ///
    /// # Errors
    /// [`MappingError::Counts`].
    pub const fn new(counts: u32) -> Result<Self, MappingError> {
        if counts == 0 || counts > 1 << 24 {
            return Err(MappingError::Counts);
        }
        Ok(Self { counts, per_count: TAU / counts as f32 })
    }

    /// 2^`bits` counts per turn, 0 to 24 bits.
    ///
    /// # Errors
    /// [`MappingError::Counts`].
    pub const fn from_bits(bits: u32) -> Result<Self, MappingError> {
        if bits > 24 {
            return Err(MappingError::Counts);
        }
        Self::new(1 << bits)
    }

    /// The number of counts in a turn of the shaft.
    pub const fn counts(&self) -> u32 {
        self.counts
    }

    /// The angle in rad of a count, turns included.
    ///
    /// Within two units in the last place of f32 up to 2²⁴ counts; beyond them the count is rounded
    /// as well.
    #[inline(always)]
    pub fn angle(&self, counts: i32) -> f32 {
        counts as f32 * self.per_count
    }
}
