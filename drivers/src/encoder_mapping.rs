//! The places where a joint can be, so that an encoder whose count wraps knows in which turn it is.

use core::f32::consts::{PI, TAU};
use core::fmt;

use crate::{JointError, JointMapping, MappingError};

/// The part of a turn that a range leaves free: two counts of 12 bits, so that the rounding of a
/// count at one end is not the other end.
const FREE: f32 = 1.0 / 2048.0;
/// The most turns of an encoder between its zero and the place of its joint: their half counts of
/// 16 bits fit into 32.
pub(crate) const MOST_TURNS: f32 = 16_000.0;
/// The part of half a turn that is taken for it: below it a count more does not matter.
pub(crate) const HALF: f32 = 0.999;

/// The places where a joint can be, which say in which of its turns an encoder is.
///
/// An absolute encoder knows its angle within a turn. Its first reading after power-up, and each
/// after a gap, is one of the angles x + 2πk: this choice tells which.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum JointRange {
    /// Between its mechanical ends, rad or m of the joint: of the angles the one in this range. The
    /// range is shorter than one turn of the encoder.
    Within {
        /// The lower end of the joint's range.
        lower: f32,
        /// The upper end of the joint's range.
        upper: f32,
    },
    /// Within half a turn of the encoder from this position of the joint, rad or m, at the first
    /// reading; turns are counted from there. For ranges of a turn and more, and for encoders at
    /// the motor: the arm stands there at power-up, or another sensor has measured it.
    Near(f32),
    /// Anywhere on a circle: the joint turns without an end, and its position is within half a turn
    /// of the encoder from its zero, exact after any number of turns. One turn of the encoder is
    /// one of the joint, or a whole number of them.
    Continuous,
    /// Anywhere on a circle, with several turns of the encoder for one of the joint: the first
    /// reading is within half a turn of the encoder from this position, turns are counted from
    /// there, and the position is within half a turn of the joint from its zero, exact after any
    /// number of turns. The turns of the encoder in one of the joint are a whole number.
    ContinuousNear(f32),
}

impl JointRange {
    /// The middle of the joint's place, or why an encoder of which `ratio` turns are one of the
    /// joint cannot resolve it.
    const fn middle(self, ratio: f32) -> Result<f32, MappingError> {
        let middle = match self {
            Self::Within { lower, upper } => {
                if !(lower <= upper && lower.is_finite() && upper.is_finite()) {
                    return Err(MappingError::Range);
                }
                // False if the difference overflows, too.
                let is_a_turn_at_most = (upper - lower) * ratio <= TAU * (1.0 - FREE);
                if !is_a_turn_at_most {
                    return Err(MappingError::Turns);
                }
                0.5 * lower + 0.5 * upper
            }
            Self::Near(position) => position,
            Self::ContinuousNear(position) => {
                if !(ratio <= 0.5 * MOST_TURNS && ratio as u32 as f32 == ratio) {
                    return Err(MappingError::Circle);
                }
                position
            }
            Self::Continuous => {
                // The turns of the joint in one of the encoder.
                let turns = 1.0 / ratio;
                let whole = (turns + 0.5) as u32 as f32;
                if !(whole >= 1.0 && (turns - whole).abs() <= 1e-6 * turns) {
                    return Err(MappingError::Circle);
                }
                0.0
            }
        };
        if (middle * ratio).abs() <= MOST_TURNS * TAU {
            Ok(middle)
        } else {
            Err(MappingError::Range)
        }
    }
}

/// The mapping of an encoder whose count wraps, and where its joint can be:
/// [`JointMapping::with_range`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EncoderMapping {
    mapping: JointMapping,
    range: JointRange,
    /// The position of the joint from which the first reading is half a turn away at most.
    near: f32,
    /// The most that the shaft turns in a tick, rad.
    step: f32,
}

impl JointMapping {
    /// The mapping of an encoder whose joint is where `range` says and moves by at most `step` rad
    /// or m in a tick: its greatest speed times the length of a tick.
    ///
    /// After readings that failed or were missed, in which the encoder can have turned by half a
    /// turn, a joint of [`JointRange::Within`] and [`JointRange::Continuous`] is placed anew. One
    /// of [`JointRange::Near`] has lost its turn and reports [`LostTurn`] until the driver's
    /// `place_near` gets its position.
    ///
    /// # Errors
    /// [`MappingError::Range`]: not a number, the ends in the wrong order, or more than 16,000
    /// turns of the encoder away. [`MappingError::Turns`]: the range is longer than a turn of the
    /// encoder. [`MappingError::Circle`]: a turn of the encoder is not a whole number of turns of a
    /// continuous joint. [`MappingError::Step`]: the step is not above zero, or half a turn of the
    /// encoder.
    ///
    /// ```
    /// use joint_drivers::{Direction, JointMapping, JointRange, MappingError};
    /// let (direct, step) = (JointMapping::new(2.4, Direction::Reverse, 1.0)?, 3.0 * 1e-3);
    /// assert!(direct.with_range(JointRange::Within { lower: -1.2, upper: 1.2 }, step).is_ok());
    /// // An encoder at the motor does not know where in such a range it starts.
    /// let geared = JointMapping::new(2.4, Direction::Reverse, 100.0)?;
    /// let range = JointRange::Within { lower: -1.2, upper: 1.2 };
    /// assert_eq!(geared.with_range(range, step), Err(MappingError::Turns));
    /// assert!(geared.with_range(JointRange::Near(0.0), step).is_ok());
    /// # Ok::<(), MappingError>(())
    /// ```
    pub const fn with_range(
        self,
        range: JointRange,
        step: f32,
    ) -> Result<EncoderMapping, MappingError> {
        let ratio = self.ratio();
        let near = match range.middle(ratio) {
            Ok(near) => near,
            Err(error) => return Err(error),
        };
        let step = step * ratio;
        if !(step > 0.0 && step < HALF * PI) {
            return Err(MappingError::Step);
        }
        Ok(EncoderMapping { mapping: self, range, near, step })
    }
}

impl EncoderMapping {
    /// Those of the encoders of a robot: [`JointMapping::with_range`] for each joint.
    ///
    /// # Errors
    /// The error of the first joint that has one, with its number.
    ///
    /// ```
    /// use joint_drivers::{EncoderMapping, JointError, JointMapping, JointRange, MappingError};
    /// let ranges = [1.2, 3.5].map(|end| JointRange::Within { lower: -end, upper: end });
    /// let refused = EncoderMapping::of([JointMapping::IDENTITY; 2], ranges, [3e-3; 2]);
    /// assert_eq!(refused, Err(JointError { joint: 1, error: MappingError::Turns }));
    /// ```
    pub fn of<const V: usize>(
        mappings: [JointMapping; V],
        ranges: [JointRange; V],
        steps: [f32; V],
    ) -> Result<[Self; V], JointError<MappingError>> {
        let mut all = [Self::UNUSED; V];
        let each = mappings.into_iter().zip(ranges).zip(steps);
        for (joint, (all, ((mapping, range), step))) in all.iter_mut().zip(each).enumerate() {
            let made = mapping.with_range(range, step);
            *all = made.map_err(|error| JointError { joint, error })?;
        }
        Ok(all)
    }

    /// A place of an array that is filled at once.
    const UNUSED: Self = Self {
        mapping: JointMapping::IDENTITY,
        range: JointRange::Near(0.0),
        near: 0.0,
        step: 1.0,
    };

    /// The mapping without the range.
    pub const fn mapping(&self) -> &JointMapping {
        &self.mapping
    }

    /// The places where the joint can be.
    pub const fn range(&self) -> JointRange {
        self.range
    }

    /// The same joint, known to be within half a turn of the encoder from `position` if nothing
    /// else says where it is.
    pub(crate) fn moved_near(mut self, position: f32) -> Result<Self, MappingError> {
        let near = JointRange::Near(position).middle(self.mapping.ratio())?;
        if !self.is_absolute() {
            self.near = near;
        }
        Ok(self)
    }

    /// Whether every reading says by itself where the joint is, so that a gap does not matter.
    pub(crate) const fn is_absolute(&self) -> bool {
        !matches!(self.range, JointRange::Near(_) | JointRange::ContinuousNear(_))
    }

    /// The turns of the encoder after which its joint is where it was, if they are counted.
    pub(crate) const fn turns_of_circle(&self) -> Option<f32> {
        match self.range {
            JointRange::ContinuousNear(_) => Some(self.mapping.ratio()),
            _ => None,
        }
    }

    pub(crate) const fn is_circle(&self) -> bool {
        matches!(self.range, JointRange::Continuous)
    }

    /// The most that the shaft turns in a tick, rad.
    pub(crate) const fn step(&self) -> f32 {
        self.step
    }

    /// The readings, one in each tick, that may be missing between two: before the shaft can turn
    /// by `angle` rad, or any number (`u32::MAX`) if every reading says by itself where the joint
    /// is.
    pub(crate) const fn most_missing(&self, angle: f32) -> u32 {
        if self.is_absolute() {
            return u32::MAX;
        }
        // The step is less than the angle; the whole number below the ratio may be it.
        let ticks = (HALF * angle / self.step) as u32;
        ticks.saturating_sub(1)
    }

    /// Whether the shaft can turn by `angle` rad or more in this many ticks.
    pub(crate) const fn can_turn(&self, ticks: u32, angle: f32) -> bool {
        // NaN does not occur; both are above zero.
        ticks as f32 * self.step >= HALF * angle
    }

    /// The zero of the joint in counts of `turn` per turn, within half a turn, and rad or m of the
    /// joint per count.
    pub(crate) const fn in_counts(&self, turn: f32) -> (f32, f32) {
        let per_count = TAU / turn;
        let zero = within_turn(self.mapping.zero());
        (zero / per_count, per_count / self.mapping.shaft_per_joint())
    }

    /// The position from which the joint is half a turn away at most when it is placed.
    pub(crate) const fn near(&self) -> f32 {
        self.near
    }

    /// The count from which the joint is half a turn away at most, at or above it.
    pub(crate) const fn near_count(&self, turn: f32) -> i32 {
        let (zero, per_count) = self.in_counts(turn);
        -floor(-(self.near / per_count + zero))
    }

    /// The position of a joint whose device counts `turns` of the shaft, of which the whole ones
    /// are known if they were kept in `whole`; they are kept if the device counts on from them.
    pub(crate) fn position_at(
        &self,
        turns: f32,
        whole: &mut Option<f32>,
    ) -> Result<f32, MappingError> {
        let off = whole.unwrap_or_else(|| {
            let near = self.near * self.mapping.shaft_per_joint() + self.mapping.zero();
            floor(near * (1.0 / TAU) - turns + 0.5) as f32
        });
        let mut off = off;
        let mut position = self.mapping.position((turns + off) * TAU)?;
        if let Some(circle) = self.turns_of_circle()
            && position.abs() > PI
        {
            let circles = floor(position * (1.0 / TAU) + 0.5) as f32;
            off -= circles * circle.copysign(self.mapping.shaft_per_joint());
            position = self.mapping.position((turns + off) * TAU)?;
        }
        if !self.is_absolute() {
            *whole = Some(off);
        }
        Ok(position)
    }
}

/// The whole number at or below one within the range of i32.
pub(crate) const fn floor(exact: f32) -> i32 {
    let whole = exact as i32;
    whole.saturating_sub(((whole as f32) > exact) as i32)
}

/// An angle without its whole turns, within half a turn.
pub(crate) const fn within_turn(angle: f32) -> f32 {
    // 2π in two parts, of which products with whole turns are exact up to 65,536 turns.
    const HIGH: f32 = 6.281_25;
    const LOW: f32 = (core::f64::consts::TAU - 6.281_25) as f32;
    let half = if angle < 0.0 { -0.5 } else { 0.5 };
    let turns = (angle * (1.0 / TAU) + half) as i32 as f32;
    (angle - turns * HIGH) - turns * LOW
}

/// An encoder can have turned by half a turn or more since its last reading: its count does not say
/// where the joint is.
///
/// It lasts until the driver's function `place_near` gets the position of the joint; the
/// controller stops the arm ([`motion_control::limits::Fault::LostTurn`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LostTurn;

impl fmt::Display for LostTurn {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str("the encoder can have turned by half a turn since its last reading")
    }
}

impl core::error::Error for LostTurn {}
