//! An encoder's position over many turns, in integers.

use dynamics_core::scalar::Real;

/// The position of an absolute encoder of BITS bits (1 to 16), turns included.
///
/// The difference of two readings is interpreted as the shorter rotation, so that the wrap from the last count to 0 is
/// not a jump. The count itself wraps after 2³¹ counts: 131,072 turns of 14 bits.
///
/// ```
/// use joint_drivers::MultiTurnEncoder;
/// let mut joint = MultiTurnEncoder::<14>::new();
/// assert_eq!(joint.update(16_383), -1); // power-up just below zero
/// assert_eq!(joint.update(2), 2);
/// assert_eq!(joint.angle::<f32>(), 2.0 * core::f32::consts::TAU / 16_384.0);
/// ```
#[doc(alias = "turn counter")]
#[doc(alias = "TurnCounter")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MultiTurnEncoder<const BITS: u32> {
    counts: i32,
}

impl<const BITS: u32> MultiTurnEncoder<BITS> {
    const SHIFT: u32 = {
        assert!(BITS >= 1 && BITS <= 16, "an encoder has 1 to 16 bits");
        32 - BITS
    };

    /// A counter whose first reading lies within half a turn of zero.
    pub const fn new() -> Self {
        Self { counts: 0 }
    }

    /// A counter whose first reading lies within half a turn of `turns` whole turns, for joints whose number of turns
    /// is known at power-up.
    ///
    /// ```
    /// use joint_drivers::MultiTurnEncoder;
    /// assert_eq!(MultiTurnEncoder::<14>::near(-1).update(16_383), -16_385);
    /// ```
    pub const fn near(turns: i32) -> Self {
        Self {
            counts: turns.wrapping_shl(BITS),
        }
    }

    /// The position in counts after a reading `raw`, of which the bits above BITS are ignored.
    ///
    /// Call it only with readings that passed the encoder's own checks. Cost: 4 instructions for all readings.
    #[inline(always)]
    pub fn update(&mut self, raw: u16) -> i32 {
        // Shifting out the turns leaves the difference modulo one turn, with its sign.
        let apart = i32::from(raw).wrapping_sub(self.counts);
        let step = (apart << Self::SHIFT) >> Self::SHIFT;
        self.counts = self.counts.wrapping_add(step);
        self.counts
    }

    /// The position in counts after the last reading.
    #[inline(always)]
    pub const fn counts(&self) -> i32 {
        self.counts
    }

    /// Whole turns, rounded down.
    ///
    /// ```
    /// use joint_drivers::MultiTurnEncoder;
    /// let mut joint = MultiTurnEncoder::<14>::new();
    /// joint.update(16_383);
    /// assert_eq!(joint.turns(), -1);
    /// ```
    #[inline(always)]
    pub const fn turns(&self) -> i32 {
        self.counts >> BITS
    }

    /// The position in rad, turns included: 2π counts / 2^BITS.
    ///
    /// f32: within 1.5 units in the last place, so that adding the turns separately would not be more accurate; that
    /// unit is 6·10⁻⁵ rad at 100 turns, a sixth of a 14-bit count. Cost: 2 flops.
    #[inline(always)]
    pub fn angle<R: Real>(&self) -> R {
        // A power of two scales exactly: one rounding here, and one of 2π.
        let per_count = const { core::f64::consts::TAU / (1_u64 << BITS) as f64 };
        // One VCVT in f32: the conversion to f64 is dead code there.
        R::select(f64::from(self.counts), self.counts as f32) * R::from_f64(per_count)
    }

    /// The position in rad without whole turns, within ±π: as accurate after a million turns as in the first.
    ///
    /// f32: within 1.5 units in the last place. Cost: 2 flops and 2 shifts.
    ///
    /// ```
    /// use joint_drivers::MultiTurnEncoder;
    /// let mut joint = MultiTurnEncoder::<14>::near(100_000);
    /// joint.update(4096);
    /// assert_eq!(joint.within_turn::<f32>(), core::f32::consts::FRAC_PI_2);
    /// ```
    #[inline(always)]
    pub fn within_turn<R: Real>(&self) -> R {
        let counts = (self.counts << Self::SHIFT) >> Self::SHIFT;
        Self { counts }.angle()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_step_below_half_a_turn_is_followed_both_ways() {
        for step in [1, -1, 17, -8191, 8191, -8192] {
            let mut counter = MultiTurnEncoder::<14>::new();
            let mut expected = 0;
            for _ in 0..10_000 {
                expected += step;
                assert_eq!(counter.update((expected & 0x3fff) as u16), expected);
                assert_eq!(counter.turns(), expected.div_euclid(16_384));
            }
        }
    }

    #[test]
    fn angles_are_within_two_ulps_over_a_thousand_turns() {
        for counts in (-16_777_216..16_777_216).step_by(7919) {
            let counter = MultiTurnEncoder::<14> { counts };
            let (single, double) = (counter.angle::<f32>(), counter.angle::<f64>());
            let unit = f64::from(single.abs().next_up() - single.abs());
            let error = (f64::from(single) - double).abs() / unit;
            assert!(error < 1.5, "{counts}: {error}");
        }
    }

    #[test]
    fn a_sixteen_bit_count_wraps_without_overflow() {
        let mut counter = MultiTurnEncoder::<16>::near(32_767);
        for (raw, counts) in [
            (0x7fff, 0x7fff_7fff),
            (0xfffe, i32::MAX - 1),
            (1, i32::MIN + 1),
        ] {
            assert_eq!(counter.update(raw), counts);
        }
    }
}
