//! The limits of a joint's motion.

/// The limits of a joint's motion that a trajectory respects; a supervisor enforces
/// [`crate::limits::SafetyLimits`].
#[doc(alias = "Speed")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct MotionLimits<R> {
    /// Greatest |q̇|, rad/s or m/s.
    pub velocity: R,
    /// Greatest |q̈|, rad/s² or m/s².
    pub acceleration: R,
}
