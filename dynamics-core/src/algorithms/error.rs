//! The error of forward dynamics.

use core::fmt;

/// M(q) is not positive definite: the named joint moves no inertia; or a coordinate or inertia is
/// NaN, not necessarily one of that joint.
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
            "joint {} moves no inertia, or a coordinate or an inertia is not a number: M is not \
             positive definite",
            self.joint
        )
    }
}

impl core::error::Error for NotPositiveDefinite {}
