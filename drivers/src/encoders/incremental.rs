//! An incremental encoder with index: quadrature signals A and B, and Z once per turn.
//!
//! # Source
//! No data sheet: the order of the four states of A and B is that of every quadrature encoder, and
//! "forward" is A before B. The index is taken to be gated with A and B, one state wide; encoders
//! with a wider one have [`IncrementalEncoder::with_index_width`].
//!
//! After power-up the position is not known. The first index makes it known; each later one checks
//! that the counts since then are whole turns, which finds counts that were lost or added by noise.
//! The index is passed once in each turn of the encoder: where the joint can be says in which one.

use core::convert::Infallible;
use core::fmt;

use motion_control::{limits::Fault, motion::CurrentTick};

use crate::{EncoderMapping, EncoderType, JointEncoder, LostTurn, MappingError, Resolution};

mod decoder;

/// The counts between two readings after which a counter of 16 bits is ambiguous.
const WRAP: i32 = 1 << 15;

pub use decoder::{InvalidTransition, QuadratureDecoder};

/// A counter of the edges of A and B: a timer in encoder mode, or [`QuadratureDecoder`].
///
/// A timer of fewer than 16 bits is extended by its implementation; of a longer one the lower 16
/// bits are returned. Between two readings it counts less than 2¹⁵: [`IncrementalEncoder`] refuses
/// a joint that is faster, and takes counts for lost that a gap in the readings has let grow
/// further.
pub trait QuadratureCounter {
    /// The reason why counts were lost.
    type Error: fmt::Debug + fmt::Display;

    /// The present count, modulo 2¹⁶.
    ///
    /// # Errors
    /// Counts may have been lost since the last call: the position is not known until the next
    /// index.
    fn count(&mut self) -> Result<u16, Self::Error>;

    /// The count at the last index, if one has passed since the last call: most timers capture it.
    fn index(&mut self) -> Option<u16>;
}

/// The reason why there is no position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum IncrementalError<E> {
    /// The counter lost counts.
    Counter(E),
    /// The index has not been passed since power-up, or since the counter lost counts.
    NotReferenced,
    /// The counts between two indices are not whole turns, but this many more or fewer. The
    /// position is referenced to the new index.
    Index {
        /// Counts that were added (above zero) or lost.
        excess: i32,
    },
    /// The counter can have wrapped, or lost counts, after the joint was placed near a position: an
    /// index does not say in which turn it is, until [`IncrementalEncoder::place_near`].
    LostTurn,
}

impl<E: fmt::Display> fmt::Display for IncrementalError<E> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Counter(error) => write!(out, "the encoder lost counts: {error}"),
            Self::NotReferenced => out.write_str("the encoder's index has not been passed yet"),
            Self::Index { excess } => {
                write!(out, "{excess} counts too many between two indices")
            }
            Self::LostTurn => LostTurn.fmt(out),
        }
    }
}

impl<E: fmt::Debug + fmt::Display> core::error::Error for IncrementalError<E> {}

/// One joint's incremental encoder.
///
/// ```
/// use joint_drivers::{JointMapping, JointRange, Resolution};
/// use joint_drivers::incremental::{IncrementalEncoder, IncrementalError, QuadratureDecoder};
/// let resolution = Resolution::new(4 * 500)?;
/// let mapping = JointMapping::IDENTITY.with_range(JointRange::Within { lower: -1.0, upper: 1.0 }, 5e-3)?;
/// let mut joint = IncrementalEncoder::new(QuadratureDecoder::new(), resolution, mapping)?;
/// assert_eq!(joint.read(), Err(IncrementalError::NotReferenced));
/// for (a, b, z) in [(true, false, false), (true, true, true), (false, true, false)] {
///     joint.counter().update(a, b, z)?;
/// }
/// assert_eq!(joint.read(), Ok(resolution.angle(1))); // one count after the index
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct IncrementalEncoder<Counter> {
    counter: Counter,
    resolution: Resolution,
    mapping: EncoderMapping,
    tolerance: u16,
    /// The joint's zero in counts from the index, and its rad or m per count.
    zero: f32,
    per_count: f32,
    /// The count extended to 32 bits, wrapping, and the one that is the joint's turn at an index.
    count: i32,
    reference: Option<i32>,
    /// The count at which a joint was placed near its position.
    anchor: Option<i32>,
    /// Ticks without a reading since the last one.
    missing: u32,
    is_lost: bool,
}

impl<Counter: QuadratureCounter> IncrementalEncoder<Counter> {
    /// An encoder with `resolution` counts per turn; the zero of `mapping` is the shaft's angle
    /// from the index.
    ///
    /// At the first index the joint is where the mapping says that it can be; one that is near a
    /// position was there at the first reading.
    ///
    /// # Errors
    /// [`MappingError::Step`]: the joint can move by 2¹⁵ counts in a tick. [`MappingError::Circle`]:
    /// its range is [`JointRange::ContinuousNear`](crate::JointRange).
    pub fn new(
        counter: Counter,
        resolution: Resolution,
        mapping: EncoderMapping,
    ) -> Result<Self, MappingError> {
        let (zero, per_count) = mapping.in_counts(resolution.counts() as f32);
        if mapping.can_turn(1, resolution.angle(WRAP)) {
            return Err(MappingError::Step);
        }
        if mapping.turns_of_circle().is_some() {
            return Err(MappingError::Circle);
        }
        Ok(Self {
            counter,
            resolution,
            mapping,
            tolerance: 0,
            zero,
            per_count,
            count: 0,
            reference: None,
            anchor: None,
            missing: 0,
            is_lost: false,
        })
    }

    /// The same encoder with an index that is `counts` wide instead of one state: its edge lies
    /// elsewhere when it is passed in the other direction, and so much is not an error.
    pub const fn with_index_width(mut self, counts: u16) -> Self {
        self.tolerance = counts;
        self
    }

    /// The counter, for a decoder that is fed from an interrupt.
    pub const fn counter(&mut self) -> &mut Counter {
        &mut self.counter
    }

    /// The joint's position in rad; `None` until the index was passed. No access to the counter.
    pub fn position(&self) -> Option<f32> {
        let from_index = self.count.wrapping_sub(self.reference?);
        Some((from_index as f32 - self.zero) * self.per_count)
    }

    /// Takes the joint to be at `position` rad or m, which says in which turn it is at the next
    /// index. Ends [`IncrementalError::LostTurn`].
    ///
    /// # Errors
    /// [`MappingError::Range`]; nothing is changed.
    pub fn place_near(&mut self, position: f32) -> Result<(), MappingError> {
        self.mapping = self.mapping.moved_near(position)?;
        (self.reference, self.anchor, self.is_lost) = (None, None, false);
        Ok(())
    }

    /// Reads the counter; the joint's position in rad.
    ///
    /// # Errors
    /// [`IncrementalError`]. After [`IncrementalError::Index`] the next call returns a position.
    pub fn read(&mut self) -> Result<f32, IncrementalError<Counter::Error>> {
        let read = self.counter.count();
        let ticks = core::mem::take(&mut self.missing).saturating_add(1);
        if read.is_err() || self.mapping.can_turn(ticks, self.resolution.angle(WRAP)) {
            self.lose();
        }
        let count = read.map_err(IncrementalError::Counter)?;
        self.count = self.extend(count);
        if self.is_lost {
            self.counter.index();
            return Err(IncrementalError::LostTurn);
        }
        let count = self.count;
        self.anchor.get_or_insert(count);
        if let Some(index) = self.counter.index() {
            self.pass(self.extend(index))?;
        }
        self.unwind();
        self.position().ok_or(IncrementalError::NotReferenced)
    }

    /// Counts were lost: the next index says where the joint is within a turn of the encoder.
    #[cold]
    fn lose(&mut self) {
        // A joint that has not been read yet has nothing to lose.
        self.is_lost |= !self.mapping.is_absolute() && self.anchor.is_some();
        self.reference = None;
        // An index from before the loss must not become the reference.
        self.counter.index();
    }

    /// Keeps the count of a continuous joint within a turn of the encoder: it does not grow with
    /// its turns.
    fn unwind(&mut self) {
        if let (true, Some(reference)) = (self.mapping.is_circle(), self.reference) {
            let near = self.mapping.near_count(self.resolution.counts() as f32);
            self.reference = Some(self.placed(reference, self.count, near));
        }
    }

    /// The count of an index at `index`, or whole turns beside it, from which the joint at `count`
    /// is `near` counts away, or half a turn more or less.
    fn placed(&self, index: i32, count: i32, near: i32) -> i32 {
        let turn = self.resolution.counts() as i32;
        let off = count.wrapping_sub(index).wrapping_sub(near);
        // A resolution is never zero, which the compiler cannot know.
        let beyond = off.wrapping_add(turn / 2).checked_div_euclid(turn);
        index.wrapping_add(beyond.unwrap_or_default().wrapping_mul(turn))
    }

    /// A 16-bit count near the present one.
    fn extend(&self, count: u16) -> i32 {
        let apart = count.wrapping_sub(self.count as u16) as i16;
        self.count.wrapping_add(i32::from(apart))
    }

    /// References the position to the index at `index`, or checks it.
    fn pass(&mut self, index: i32) -> Result<(), IncrementalError<Counter::Error>> {
        let Some(reference) = self.reference else {
            let near = self.mapping.near_count(self.resolution.counts() as f32);
            let known = match self.anchor {
                Some(anchor) if !self.mapping.is_absolute() => anchor,
                _ => self.count,
            };
            self.reference = Some(self.placed(index, known, near));
            return Ok(());
        };
        let turn = self.resolution.counts() as i32;
        // A resolution is never zero, which the compiler cannot know.
        let beyond = index.wrapping_sub(reference).checked_rem_euclid(turn);
        let beyond = beyond.unwrap_or_default();
        let excess = if beyond > turn / 2 { beyond - turn } else { beyond };
        if excess.unsigned_abs() <= u32::from(self.tolerance) {
            return Ok(());
        }
        self.reference = Some(reference.wrapping_add(excess));
        Err(IncrementalError::Index { excess })
    }
}

impl<Counter: QuadratureCounter> EncoderType for IncrementalEncoder<Counter> {
    type Error = IncrementalError<Counter::Error>;
    type Age = CurrentTick;

    fn missed(&mut self, ticks: u32) {
        self.missing = self.missing.saturating_add(ticks);
    }

    fn fault(error: &Self::Error, joint: usize) -> Fault {
        match error {
            IncrementalError::LostTurn => Fault::LostTurn { joint },
            _ => Fault::Encoder { joint },
        }
    }
}

impl<Counter: QuadratureCounter> JointEncoder for IncrementalEncoder<Counter> {
    fn sample(&mut self) -> Result<(), Self::Error> {
        self.read().map(|_| ())
    }

    /// Zero until the index was passed.
    fn position(&self) -> f32 {
        IncrementalEncoder::position(self).unwrap_or_default()
    }
}

/// A timer that cannot lose counts, as a function that reads its count and one that takes its
/// captured index.
impl<Count: FnMut() -> u16, Index: FnMut() -> Option<u16>> QuadratureCounter for (Count, Index) {
    type Error = Infallible;

    fn count(&mut self) -> Result<u16, Infallible> {
        Ok((self.0)())
    }

    fn index(&mut self) -> Option<u16> {
        (self.1)()
    }
}
