//! The decoder of quadrature signals in software.

use core::fmt;

use super::QuadratureCounter;

/// A and B changed at once: one edge was missed, and with it two counts of unknown sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct InvalidTransition {
    /// The number of edges since power-up.
    pub total: u32,
}

impl fmt::Display for InvalidTransition {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "A and B changed at once, {} times so far", self.total)
    }
}

impl core::error::Error for InvalidTransition {}

/// A quadrature decoder in software, four counts per line, from the levels of A, B and Z after each
/// of their edges.
///
/// Forward is A before B: (A, B) = 00, 10, 11, 01. The index is the state in which Z becomes high.
///
/// ```
/// use joint_drivers::incremental::{InvalidTransition, QuadratureCounter, QuadratureDecoder};
/// let mut decoder = QuadratureDecoder::new();
/// decoder.update(true, false, false)?;
/// decoder.update(true, true, false)?;
/// assert_eq!(decoder.count(), Ok(2));
/// assert_eq!(decoder.update(false, false, false).map_err(|lost| lost.total), Err(1));
/// # Ok::<(), InvalidTransition>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct QuadratureDecoder {
    /// The state's place in the order of forward motion, 0 to 3.
    phase: u8,
    z: bool,
    count: u16,
    index: Option<u16>,
    invalid: u32,
    /// Whether an invalid transition has not been reported by `count` yet.
    is_lost: bool,
}

impl QuadratureDecoder {
    /// A decoder at count 0 with A, B and Z low.
    pub const fn new() -> Self {
        Self::at(false, false, false)
    }

    /// A decoder at count 0 with the present levels of A, B and Z.
    pub const fn at(a: bool, b: bool, z: bool) -> Self {
        Self { phase: phase(a, b), z, count: 0, index: None, invalid: 0, is_lost: false }
    }

    /// Takes the levels of A, B and Z. Cost: about 20 instructions.
    ///
    /// # Errors
    /// [`InvalidTransition`], of which the next [`QuadratureCounter::count`] reports the last too.
    pub fn update(&mut self, a: bool, b: bool, z: bool) -> Result<(), InvalidTransition> {
        let phase = phase(a, b);
        let step = phase.wrapping_sub(self.phase) & 3;
        self.phase = phase;
        match step {
            1 => self.count = self.count.wrapping_add(1),
            3 => self.count = self.count.wrapping_sub(1),
            _ => {}
        }
        if z && !self.z {
            self.index = Some(self.count);
        }
        self.z = z;
        if step == 2 {
            self.invalid = self.invalid.saturating_add(1);
            self.is_lost = true;
            return Err(InvalidTransition { total: self.invalid });
        }
        Ok(())
    }

    /// The invalid transitions so far.
    pub const fn invalid_transitions(&self) -> u32 {
        self.invalid
    }
}

/// The place of (A, B) in the order of forward motion.
const fn phase(a: bool, b: bool) -> u8 {
    match (a, b) {
        (false, false) => 0,
        (true, false) => 1,
        (true, true) => 2,
        (false, true) => 3,
    }
}

impl QuadratureCounter for QuadratureDecoder {
    type Error = InvalidTransition;

    fn count(&mut self) -> Result<u16, InvalidTransition> {
        if core::mem::take(&mut self.is_lost) {
            return Err(InvalidTransition { total: self.invalid });
        }
        Ok(self.count)
    }

    fn index(&mut self) -> Option<u16> {
        self.index.take()
    }
}
