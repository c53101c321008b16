//! How forward dynamics can fail.

use core::fmt;

/// M(q) is not positive definite: the named joint moves no inertia; or some coordinate or inertia is not a number,
/// not necessarily of that joint.
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
            "joint {} moves no inertia, or a coordinate or an inertia is not a number: M is not positive definite",
            self.joint
        )
    }
}

impl core::error::Error for NotPositiveDefinite {}
