//! The record of a physical set in memory that keeps it without power, with a version, a check sum
//! and its quality.
//!
//! Words of 32 bits, little endian:
//!
//! ```text
//! version | N | check sum of the nominal parameters | quality | N parameters | check sum of all words before
//! ```
//!
//! The check sum is the CRC-32 of IEEE 802.3, of the bytes in their order. The first two words and
//! the place of the last one are the same in all versions, so that a whole record of another
//! version or another robot is distinguished from a damaged one.

use core::fmt;

use super::PhysicalParameters;

/// The version of the layout.
const VERSION: u32 = 1;
/// The words beside the parameters.
const WORDS: usize = 5;

/// Why a record is not read or written; the parameters are then unchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum RecordError {
    /// The memory has fewer bytes than the record.
    TooShort {
        /// The bytes of the record.
        needed: usize,
    },
    /// The check sum is not that of the bytes: an erased memory, or a write that was interrupted.
    CheckSum,
    /// The record has another layout.
    Version {
        /// Its version.
        found: u32,
    },
    /// The record belongs to other nominal parameters: another robot, or another description of it.
    OtherModel,
    /// The parameters are not those of bodies, or without the margin.
    Impossible,
}

impl fmt::Display for RecordError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooShort { needed } => {
                write!(out, "the memory is too short: a record has {needed} bytes")
            }
            Self::CheckSum => write!(out, "the check sum of the record is wrong"),
            Self::Version { found } => write!(out, "the record has the unknown layout {found}"),
            Self::OtherModel => write!(out, "the record belongs to other nominal parameters"),
            Self::Impossible => write!(out, "the parameters of the record are impossible"),
        }
    }
}

impl core::error::Error for RecordError {}

impl<const B: usize, const N: usize> PhysicalParameters<f32, B, N> {
    /// The bytes of a record: 4 (N + 5).
    pub const RECORD_BYTES: usize = 4 * (N + WORDS);

    /// Writes the stored set to `memory`, with a number for its quality, such as the largest
    /// [`consistency`](super::ParameterEstimator::consistency); returns the bytes of the record.
    /// Not for the tick.
    ///
    /// Write into the place without a record, and then erase the other place: whenever the power
    /// is lost, one of them has a whole record.
    ///
    /// ```
    /// use motion_control::estimate::{PhysicalParameters, RecordError};
    /// let nominal = [2.0_f32, 0.0, 0.0, 0.1, 0.1, 0.0, 0.1, 0.0, 0.0, 0.02, 0.3]; // a body and a friction
    /// let mut learned: PhysicalParameters<f32, 1, 11> = PhysicalParameters::try_new(nominal)?;
    /// let mut found = nominal;
    /// found[10] = 0.25;
    /// learned.follow(&found);
    /// let mut flash = [0xff; 64];
    /// learned.write(1.1, &mut flash)?;
    ///
    /// // The next start.
    /// let mut arm: PhysicalParameters<f32, 1, 11> = PhysicalParameters::try_new(nominal)?;
    /// assert_eq!(arm.read(&flash)?, 1.1);
    /// assert_eq!(arm.parameters()[10], 0.25);
    /// flash[20] ^= 1;
    /// assert_eq!(arm.read(&flash), Err(RecordError::CheckSum));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`RecordError::TooShort`] has the bytes that a record needs.
    pub fn write(&self, quality: f32, memory: &mut [u8]) -> Result<usize, RecordError> {
        let needed = Self::RECORD_BYTES;
        if memory.len() < needed {
            return Err(RecordError::TooShort { needed });
        }
        let header = [VERSION, N as u32, self.of_nominal(), quality.to_bits()];
        let words = header.into_iter().chain(self.stored.iter().map(|x| x.to_bits()));
        let sum = crc(words.clone());
        let (places, _) = memory.as_chunks_mut();
        for (place, word) in places.iter_mut().zip(words.chain([sum])) {
            *place = word.to_le_bytes();
        }
        Ok(needed)
    }

    /// Reads a record, and returns the quality with which it was written. Not for the tick.
    ///
    /// # Errors
    /// [`RecordError`] names the reason. The parameters are then those that were stored before:
    /// after [`Self::try_new`] the nominal ones.
    pub fn read(&mut self, memory: &[u8]) -> Result<f32, RecordError> {
        let needed = Self::RECORD_BYTES;
        if memory.len() < needed {
            return Err(RecordError::TooShort { needed });
        }
        let (places, _) = memory.as_chunks();
        let mut words = places.iter().map(|place| u32::from_le_bytes(*place));
        let numbers = words.clone().nth(1).unwrap_or(0) as usize;
        let before = numbers.saturating_add(WORDS - 1);
        let mut sum = words.clone().skip(before);
        if sum.next().is_none_or(|sum| sum != crc(words.clone().take(before))) {
            return Err(RecordError::CheckSum);
        }
        let [version, numbers, nominal, quality] =
            core::array::from_fn(|_| words.next().unwrap_or(0));
        if version != VERSION {
            return Err(RecordError::Version { found: version });
        }
        if (numbers, nominal) != (N as u32, self.of_nominal()) {
            return Err(RecordError::OtherModel);
        }
        let read = core::array::from_fn(|_| f32::from_bits(words.next().unwrap_or(0)));
        if !self.is_possible(&read) {
            return Err(RecordError::Impossible);
        }
        self.stored = read;
        Ok(f32::from_bits(quality))
    }

    /// The check sum of the nominal parameters.
    fn of_nominal(&self) -> u32 {
        crc(self.nominal.iter().map(|x| x.to_bits()))
    }
}

/// The CRC-32 of the bytes of these words.
fn crc(words: impl Iterator<Item = u32>) -> u32 {
    !words.flat_map(u32::to_le_bytes).fold(!0, |sum, byte| {
        (0..8).fold(sum ^ u32::from(byte), |sum, _| {
            (sum >> 1) ^ (0xedb8_8320 & (sum & 1).wrapping_neg())
        })
    })
}

#[cfg(test)]
mod tests {
    use super::{RecordError, crc};
    use crate::estimate::PhysicalParameters;

    type Arm = PhysicalParameters<f32, 1, 11>;
    const NOMINAL: [f32; 11] = [2.0, 0.0, 0.0, 0.1, 0.1, 0.0, 0.1, 0.0, 0.0, 0.02, 0.3];

    fn arm() -> Arm {
        Arm::try_new(NOMINAL).expect("a possible body")
    }

    /// A record of an arm whose friction was learned.
    fn record() -> [u8; Arm::RECORD_BYTES] {
        let mut learned = arm();
        let found = core::array::from_fn(|i| if i == 10 { 0.25 } else { NOMINAL[i] });
        assert_eq!(learned.follow(&found), 1.0);
        let mut record = [0xff; Arm::RECORD_BYTES];
        assert_eq!(learned.write(1.5, &mut record), Ok(record.len()));
        record
    }

    /// The same with another word, and its check sum.
    fn with_word(place: usize, word: u32) -> [u8; Arm::RECORD_BYTES] {
        let mut record = record();
        let (words, _) = record.as_chunks_mut::<4>();
        words[place] = word.to_le_bytes();
        let sum = crc(words[..15].iter().map(|word| u32::from_le_bytes(*word)));
        words[15] = sum.to_le_bytes();
        record
    }

    #[test]
    fn the_check_sum_is_that_of_ieee_802_3() {
        let words = [*b"1234", *b"5678"].map(u32::from_le_bytes);
        assert_eq!(crc(words.into_iter()), 0x9ae0_daaf); // of zlib, for b"12345678"
    }

    #[test]
    fn a_record_roundtrips_and_any_flipped_bit_is_noticed() {
        let (mut other, mut record) = (arm(), record());
        assert_eq!(other.read(&record), Ok(1.5));
        assert_eq!(other.parameters()[10], 0.25);
        let mut fresh = arm();
        for bit in 0..8 * record.len() {
            record[bit / 8] ^= 1 << (bit % 8);
            assert_eq!(fresh.read(&record), Err(RecordError::CheckSum), "bit {bit}");
            record[bit / 8] ^= 1 << (bit % 8);
        }
        assert_eq!(*fresh.parameters(), NOMINAL);
    }

    /// Records in a memory that is larger.
    // Another size is another model, and another layout has its version.
    #[test]
    fn a_foreign_record_reports_its_model_or_version() {
        type Two = PhysicalParameters<f32, 1, 12>;
        let all = core::array::from_fn(|i| NOMINAL.get(i).copied().unwrap_or(0.1));
        let two = Two::try_new(all).expect("a possible body");
        let mut memory = [0xff; 100];
        assert_eq!(two.write(1.0, &mut memory), Ok(Two::RECORD_BYTES));
        assert_eq!(arm().read(&memory), Err(RecordError::OtherModel));
        memory[..Arm::RECORD_BYTES].copy_from_slice(&record());
        let mut larger = two;
        assert_eq!(larger.read(&memory), Err(RecordError::OtherModel));
        memory[..Arm::RECORD_BYTES].copy_from_slice(&with_word(0, 2));
        let version = RecordError::Version { found: 2 };
        assert_eq!(larger.read(&memory), Err(version));
        assert_eq!(larger, two);
    }

    // They are of other layouts, robots and sizes.
    #[test]
    fn other_records_leave_the_nominal_model() {
        let mut arm = arm();
        let needed = Arm::RECORD_BYTES;
        let short = RecordError::TooShort { needed };
        assert_eq!(arm.read(&record()[..needed - 1]), Err(short));
        assert_eq!(arm.write(1.0, &mut [0; 8]), Err(short));
        assert_eq!(arm.read(&[0xff; 100]), Err(RecordError::CheckSum)); // erased
        let version = RecordError::Version { found: 2 };
        assert_eq!(arm.read(&with_word(0, 2)), Err(version));
        assert_eq!(arm.read(&with_word(1, 12)), Err(RecordError::CheckSum)); // not whole
        assert_eq!(arm.read(&with_word(2, 7)), Err(RecordError::OtherModel));
        for word in [-2.0, f32::NAN].map(f32::to_bits) {
            assert_eq!(arm.read(&with_word(4, word)), Err(RecordError::Impossible));
        }
        assert_eq!(*arm.parameters(), NOMINAL);
        assert_eq!(arm.read(&with_word(3, 2.0_f32.to_bits())), Ok(2.0));
    }
}
