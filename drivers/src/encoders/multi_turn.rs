//! An encoder's position over many turns, in integers.

use core::f32::consts::PI;

use dynamics_core::scalar::Real;

use crate::encoder_mapping::{LostTurn, MOST_TURNS, floor};
use crate::{EncoderMapping, MappingError};

/// In place of the readings that are missing since the last one: it is unknown in which turn the
/// joint is.
const LOST: u32 = u32::MAX;
/// The same: each reading is placed anew.
const CIRCLE: u32 = LOST - 1;
/// Added to the readings that are missing of a joint that turns without an end: each reading is
/// examined, and may be one turn of the joint less.
const ENDLESS: u32 = 1 << 31;

/// The count before a reading.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PreviousCount(i32);

/// The position of a joint from an absolute encoder of BITS bits (1 to 16), turns included.
///
/// The first reading is placed where the joint can be ([`JointRange`](crate::JointRange)); then the
/// difference of two readings is the shorter rotation, so that the wrap from the last count to 0 is
/// not a jump. The count itself wraps after 2³⁰ counts: 65,536 turns of 14 bits. A range of the
/// joint that is longer than a turn but for two counts of BITS has two readings at its ends: with
/// less than 12 bits leave more than that free.
///
/// ```
/// use joint_drivers::{Direction, JointMapping, JointRange, LostTurn, MultiTurnEncoder};
/// // The encoder reads 2.4 rad where the joint is at zero.
/// let mapping = JointMapping::new(2.4, Direction::Forward, 1.0)?;
/// let mapping = mapping.with_range(JointRange::Within { lower: -1.2, upper: 1.2 }, 3e-3)?;
/// let mut joint = MultiTurnEncoder::<14>::new(mapping);
/// joint.update(9000)?; // power-up at 3.45 rad, beyond half a turn
/// assert!((joint.position() - 1.051).abs() < 1e-3);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "turn counter")]
#[doc(alias = "TurnCounter")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MultiTurnEncoder<const BITS: u32> {
    /// Twice the count, and odd before the first reading: the middle of the turn in which it is.
    halves: i32,
    /// Readings that are missing since the last one; [`LOST`], [`CIRCLE`].
    missing: u32,
    /// The joint's zero in half counts, and its rad or m per half count.
    zero: f32,
    per_half: f32,
    /// If each reading says by itself where the joint is: the place of a joint without a reading,
    /// as in `halves`, which is odd. Else twice the number of readings that may be missing.
    near_or_most: i32,
    /// The half counts in a turn of a joint that turns without an end, else zero.
    circle: i32,
}

impl<const BITS: u32> MultiTurnEncoder<BITS> {
    const SHIFT: u32 = {
        assert!(BITS >= 1 && BITS <= 16, "an encoder has 1 to 16 bits");
        31 - BITS
    };

    /// A counter without a reading, at the place where its joint is taken to be.
    pub const fn new(mapping: EncoderMapping) -> Self {
        let (zero, per_half) = mapping.in_counts((2_u32 << BITS) as f32);
        let near = place(mapping.near(), zero, per_half);
        Self {
            halves: near,
            missing: if mapping.is_circle() {
                CIRCLE
            } else if mapping.turns_of_circle().is_some() {
                ENDLESS
            } else {
                0
            },
            zero,
            per_half,
            near_or_most: if mapping.is_absolute() {
                near
            } else {
                doubled(mapping.most_missing(PI))
            },
            circle: match mapping.turns_of_circle() {
                Some(turns) => (turns * (1_u32 << BITS) as f32) as i32 * 2,
                None => 0,
            },
        }
    }

    /// Takes a reading `raw`, of which the bits above BITS are ignored.
    ///
    /// Call it only with readings that passed the encoder's own checks, once in each tick; for a
    /// tick without one call [`Self::missed`]. Cost: 6 instructions, more only after a gap and for
    /// [`Continuous`](crate::JointRange::Continuous).
    ///
    /// # Errors
    /// [`LostTurn`], until [`Self::place_near`].
    #[inline(always)]
    pub fn update(&mut self, raw: u16) -> Result<(), LostTurn> {
        let (_, missing) = self.follow(raw);
        if missing == 0 { Ok(()) } else { self.examine() }
    }

    /// Takes a reading, and returns what was before it, and 0 if it follows that: then it needs no
    /// [`Self::examine`].
    #[inline(always)]
    pub(crate) fn follow(&mut self, raw: u16) -> (PreviousCount, u32) {
        let (before, missing) = (self.halves, self.missing);
        // Shifting out the turns leaves the difference modulo one turn, with its sign.
        let apart = (i32::from(raw) << 1).wrapping_sub(before);
        self.halves = before.wrapping_add(Self::within(apart));
        (PreviousCount(before), missing)
    }

    /// Whether each reading says by itself where the joint is.
    const fn is_absolute(&self) -> bool {
        self.near_or_most & 1 == 1
    }

    /// Takes back a reading that is none.
    pub(crate) fn back(&mut self, before: PreviousCount) {
        self.halves = before.0;
    }

    /// Half counts without whole turns.
    #[inline(always)]
    const fn within(halves: i32) -> i32 {
        (halves << Self::SHIFT) >> Self::SHIFT
    }

    /// Notes that this many readings failed or were not made, one in each tick: the joint may have
    /// moved on.
    #[cold]
    pub fn missed(&mut self, readings: u32) {
        if self.is_absolute() {
            self.halves = self.near_or_most;
        } else if self.halves & 1 == 0 && self.missing < LOST {
            let most = if self.circle == 0 { ENDLESS - 1 } else { CIRCLE - 1 };
            self.missing = self.missing.saturating_add(readings).min(most);
        }
    }

    /// Takes the joint to be at `position` rad or m: the next reading is within half a turn of the
    /// encoder from there, and ends [`LostTurn`]. A joint that every reading places by itself stays
    /// where it is.
    ///
    /// # Errors
    /// [`MappingError::Range`]: not finite, or more than 16,000 turns of the encoder away; nothing
    /// is changed.
    pub fn place_near(&mut self, position: f32) -> Result<(), MappingError> {
        let turns = position / self.per_half / (2_u32 << BITS) as f32;
        // False for NaN, too.
        let is_known = turns.abs() <= MOST_TURNS;
        if !is_known {
            return Err(MappingError::Range);
        }
        if !self.is_absolute() {
            self.halves = place(position, self.zero, self.per_half);
            self.missing = self.none_missing();
        }
        Ok(())
    }

    const fn none_missing(&self) -> u32 {
        if self.circle == 0 { 0 } else { ENDLESS }
    }

    /// Whether a reading after others that are missing says where the joint is: a function of its
    /// own, so that the usual reading has no case for it.
    #[cold]
    #[inline(never)]
    fn examine(&mut self) -> Result<(), LostTurn> {
        if self.is_absolute() {
            // The angle of a circle: its count does not grow with its turns.
            let apart = self.halves.wrapping_sub(self.near_or_most);
            self.halves = self.near_or_most.wrapping_add(Self::within(apart));
        } else if self.missing - self.none_missing() > self.near_or_most as u32 / 2 {
            self.missing = LOST;
            return Err(LostTurn);
        } else {
            self.missing = self.none_missing();
            if self.circle != 0 {
                let half = self.circle / 2;
                let apart = self.halves.wrapping_sub(self.zero as i32).wrapping_add(half);
                let circles = apart.checked_div_euclid(self.circle).unwrap_or(0);
                self.halves = self.halves.wrapping_sub(circles.wrapping_mul(self.circle));
            }
        }
        Ok(())
    }

    /// The joint's position in rad or m in the last reading.
    ///
    /// f32: within 2.5 units in the last place; whole turns are counted in integers. Cost: 3 flops.
    #[inline(always)]
    pub fn position(&self) -> f32 {
        (self.halves as f32 - self.zero) * self.per_half
    }

    /// The count at which the joint is at `position`, turns included.
    pub(crate) fn count_at(&self, position: f32) -> f32 {
        0.5 * (position / self.per_half + self.zero)
    }

    /// The position of the encoder's shaft in counts after the last reading: of a joint of
    /// [`JointRange::ContinuousNear`](crate::JointRange) within a turn of the joint.
    #[inline(always)]
    pub const fn counts(&self) -> i32 {
        self.halves >> 1
    }

    /// Whole turns of the encoder's shaft, rounded down.
    #[inline(always)]
    pub const fn turns(&self) -> i32 {
        self.halves >> (BITS + 1)
    }

    /// The angle of the encoder's shaft in rad, turns included, without the mapping: 2π counts /
    /// 2^BITS.
    ///
    /// f32: within 1.5 units in the last place, so that adding the turns separately would not be
    /// more accurate; that unit is 6·10⁻⁵ rad at 100 turns, a sixth of a 14-bit count. Cost: 2
    /// flops.
    #[inline(always)]
    pub fn angle<R: Real>(&self) -> R {
        angle::<R, BITS>(self.counts())
    }

    /// The angle of the encoder's shaft in rad without whole turns, within ±π: as accurate after a
    /// million turns as in the first.
    ///
    /// f32: within 1.5 units in the last place. Cost: 2 flops and 2 shifts.
    ///
    /// ```
    /// use joint_drivers::{JointMapping, JointRange, MultiTurnEncoder};
    /// let far = JointMapping::IDENTITY.with_range(JointRange::Near(62_831.85), 3e-3)?;
    /// let mut joint = MultiTurnEncoder::<14>::new(far);
    /// joint.update(4096)?;
    /// assert_eq!((joint.turns(), joint.within_turn()), (10_000, core::f32::consts::FRAC_PI_2));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[inline(always)]
    pub fn within_turn<R: Real>(&self) -> R {
        angle::<R, BITS>(Self::within(self.halves) >> 1)
    }
}

/// Twice a number of readings, of which 2³⁰ and more are the same.
const fn doubled(readings: u32) -> i32 {
    const MOST: u32 = (1 << 30) - 1;
    if readings < MOST { 2 * readings as i32 } else { 2 * MOST as i32 }
}

/// The middle of the turn in which a joint near `position` is, in half counts: an odd number.
const fn place(position: f32, zero: f32, per_half: f32) -> i32 {
    2 * floor(0.5 * (position / per_half + zero)) + 1
}

#[inline(always)]
fn angle<R: Real, const BITS: u32>(counts: i32) -> R {
    // A power of two scales exactly: one rounding here, and one of 2π.
    let per_count = const { core::f64::consts::TAU / (1_u64 << BITS) as f64 };
    // One VCVT in f32: the conversion to f64 is dead code there.
    R::select(f64::from(counts), counts as f32) * R::from_f64(per_count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{JointMapping, JointRange};

    /// A counter at a known count.
    fn at<const BITS: u32>(counts: i32) -> MultiTurnEncoder<BITS> {
        let near = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 0.1);
        MultiTurnEncoder { halves: 2 * counts, ..MultiTurnEncoder::new(near.unwrap()) }
    }

    #[test]
    fn every_step_below_half_a_turn_is_followed_both_ways() {
        for step in [1, -1, 17, -8191, 8191, -8192] {
            let mut counter = at::<14>(0);
            let mut expected = 0;
            for _ in 0..10_000 {
                expected += step;
                counter.update((expected & 0x3fff) as u16).unwrap();
                assert_eq!(counter.counts(), expected);
                assert_eq!(counter.turns(), expected.div_euclid(16_384));
            }
        }
    }

    #[test]
    fn angles_are_within_two_ulps_over_a_thousand_turns() {
        for counts in (-16_777_216..16_777_216).step_by(7919) {
            let counter = at::<14>(counts);
            let (single, double) = (counter.angle::<f32>(), counter.angle::<f64>());
            let unit = f64::from(single.abs().next_up() - single.abs());
            let error = (f64::from(single) - double).abs() / unit;
            assert!(error < 1.5, "{counts}: {error}");
        }
    }

    #[test]
    fn a_sixteen_bit_count_wraps_without_overflow() {
        let mut counter = at::<16>(16_383 << 16);
        for (raw, counts) in [(0x7fff, 0x3fff_7fff), (0xfffe, 0x3fff_fffe), (1, -0x3fff_ffff)] {
            counter.update(raw).unwrap();
            assert_eq!(counter.counts(), counts);
        }
    }
}
