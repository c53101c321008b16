//! How forward dynamics can fail.

use core::fmt;

/// M(q) is not positive definite: the named joint moves no inertia.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct NotPositiveDefinite {
    /// The joint's index in q̇.
    pub joint: usize,
}

impl fmt::Display for NotPositiveDefinite {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            out,
            "joint {} moves no inertia: M is not positive definite",
            self.joint
        )
    }
}

impl core::error::Error for NotPositiveDefinite {}
