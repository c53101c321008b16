//! What bodies hand to the bodies that they carry.

use heapless::Vec;

/// A quantity of each body so far, and of the base. On a chain, where every body hangs on the one
/// before it, only the last one is kept: `chain` is a constant at every call, and the rest vanishes.
pub(super) struct PerBody<T, const B: usize> {
    base: T,
    last: T,
    all: Vec<T, B>,
}

impl<T: Copy, const B: usize> PerBody<T, B> {
    /// That of the base.
    #[inline(always)]
    pub(super) fn from(base: T) -> Self {
        Self {
            base,
            last: base,
            all: Vec::new(),
        }
    }

    /// That of the body `parent`.
    #[inline(always)]
    pub(super) fn parent(&self, chain: bool, parent: usize) -> T {
        if chain {
            self.last
        } else {
            *self.all.get(parent).unwrap_or(&self.base)
        }
    }

    /// Adds that of the next body.
    #[inline(always)]
    pub(super) fn push(&mut self, chain: bool, value: T) {
        if chain {
            self.last = value;
        } else {
            let _ = self.all.push(value);
        }
    }
}
