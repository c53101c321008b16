//! An incremental encoder with index: quadrature signals A and B, and Z once per turn.
//!
//! # Source
//! No data sheet: the order of the four states of A and B is that of every quadrature encoder, and "forward" is A
//! before B. The index is taken to be gated with A and B, one state wide; encoders with a wider one have
//! [`IncrementalEncoder::with_index_width`].
//!
//! After power-up the position is not known. The first index makes it known; each later one checks that the counts
//! since then are whole turns, which finds counts that were lost or added by noise.

use core::convert::Infallible;
use core::fmt;

use motion_control::CurrentTick;

use crate::{EncoderType, JointEncoder, JointMapping, Resolution};

mod decoder;

pub use decoder::{InvalidTransition, QuadratureDecoder};

/// What counts the edges of A and B: a timer in encoder mode, or [`QuadratureDecoder`].
///
/// A timer of fewer than 16 bits is extended by its implementation; of a longer one the lower 16 bits are returned.
pub trait QuadratureCounter {
    /// The reason why counts were lost.
    type Error: fmt::Debug + fmt::Display;

    /// The present count, modulo 2¹⁶: between two calls it changes by less than 2¹⁵.
    ///
    /// # Errors
    /// Counts may have been lost since the last call: the position is not known until the next index.
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
    /// The counts between two indices are not whole turns, but so many more or fewer. The position is referenced to
    /// the new index.
    Index {
        /// Counts that were added (above zero) or lost.
        excess: i32,
    },
}

impl<E: fmt::Display> fmt::Display for IncrementalError<E> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Counter(error) => write!(out, "the encoder lost counts: {error}"),
            Self::NotReferenced => out.write_str("the encoder's index has not been passed yet"),
            Self::Index { excess } => {
                write!(out, "{excess} counts too many between two indices")
            }
        }
    }
}

impl<E: fmt::Debug + fmt::Display> core::error::Error for IncrementalError<E> {}

/// One joint's incremental encoder.
///
/// ```
/// use joint_drivers::{JointMapping, Resolution};
/// use joint_drivers::incremental::{IncrementalEncoder, IncrementalError, QuadratureDecoder};
/// let resolution = Resolution::new(4 * 500)?;
/// let mut joint = IncrementalEncoder::new(QuadratureDecoder::new(), resolution, JointMapping::IDENTITY);
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
    mapping: JointMapping,
    tolerance: u16,
    /// The count extended to 32 bits, wrapping, and that of the index.
    count: i32,
    reference: Option<i32>,
}

impl<Counter: QuadratureCounter> IncrementalEncoder<Counter> {
    /// An encoder with `resolution` counts per turn; the zero of `mapping` is the shaft's angle from the index.
    ///
    /// Turns are counted from the last index before the first [`Self::read`] that returns a position.
    pub const fn new(counter: Counter, resolution: Resolution, mapping: JointMapping) -> Self {
        Self {
            counter,
            resolution,
            mapping,
            tolerance: 0,
            count: 0,
            reference: None,
        }
    }

    /// The same encoder with an index that is `counts` wide instead of one state: its edge lies elsewhere when it is
    /// passed in the other direction, and so much is not an error.
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
        let shaft = self.resolution.angle(from_index);
        Some(self.mapping.joint_position(shaft))
    }

    /// Reads the counter; the joint's position in rad.
    ///
    /// # Errors
    /// [`IncrementalError`]. After [`IncrementalError::Index`] the next call returns a position.
    pub fn read(&mut self) -> Result<f32, IncrementalError<Counter::Error>> {
        let count = match self.counter.count() {
            Ok(count) => count,
            Err(error) => {
                self.reference = None;
                // An index from before the loss must not become the reference.
                self.counter.index();
                return Err(IncrementalError::Counter(error));
            }
        };
        self.count = self.extend(count);
        if let Some(index) = self.counter.index() {
            self.pass(self.extend(index))?;
        }
        self.position().ok_or(IncrementalError::NotReferenced)
    }

    /// A 16-bit count near the present one.
    fn extend(&self, count: u16) -> i32 {
        let apart = count.wrapping_sub(self.count as u16) as i16;
        self.count.wrapping_add(i32::from(apart))
    }

    /// References the position to the index at `index`, or checks it.
    fn pass(&mut self, index: i32) -> Result<(), IncrementalError<Counter::Error>> {
        let Some(reference) = self.reference else {
            self.reference = Some(index);
            return Ok(());
        };
        let turn = self.resolution.counts() as i32;
        // A resolution is never zero, which the compiler cannot know.
        let beyond = index.wrapping_sub(reference).checked_rem_euclid(turn);
        let beyond = beyond.unwrap_or_default();
        let excess = if beyond > turn / 2 {
            beyond - turn
        } else {
            beyond
        };
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

/// A timer that cannot lose counts, as a function that reads its count and one that takes its captured index.
impl<Count: FnMut() -> u16, Index: FnMut() -> Option<u16>> QuadratureCounter for (Count, Index) {
    type Error = Infallible;

    fn count(&mut self) -> Result<u16, Infallible> {
        Ok((self.0)())
    }

    fn index(&mut self) -> Option<u16> {
        (self.1)()
    }
}
