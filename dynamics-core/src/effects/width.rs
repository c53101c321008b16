//! The speed or depth at which an effect reaches its full value.

use crate::scalar::Real;

/// A speed, rad/s or m/s, or a depth, rad or m, over which an effect fades in. The sign does not
/// matter.
///
/// Its reciprocal is stored, so that no tick divides by it. For a scene in a `const` or `static`
/// [`Width::f32`] and [`Width::f64`] are evaluated by the compiler.
///
/// ```
/// use dynamics_core::effects::{Coulomb, Width};
/// // 4 N·m, full beyond 0.02 rad/s
/// static DRY: Coulomb<f32, 1> = Coulomb { torque: [4.0], width: Width::f32(0.02) };
/// assert_eq!(DRY.width, Width::new(0.02));
/// assert_eq!(DRY.width.get(), 0.02);
/// ```
#[doc(alias = "regularization")]
#[doc(alias = "stiction tolerance")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Width<R> {
    inverse: R,
}

impl<R: Real> Width<R> {
    /// The width of a speed or depth.
    #[cfg_attr(optimised, inline(always))]
    pub fn new(width: R) -> Self {
        Self { inverse: R::ONE / width.abs() }
    }

    /// The speed or depth, to a rounding.
    pub fn get(self) -> R {
        R::ONE / self.inverse
    }

    /// Its reciprocal.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn inverse(self) -> R {
        self.inverse
    }
}

impl Width<f32> {
    /// The width of a speed or depth that the compiler knows.
    pub const fn f32(width: f32) -> Self {
        Self { inverse: 1.0 / width.abs() }
    }
}

impl Width<f64> {
    /// The width of a speed or depth that the compiler knows.
    pub const fn f64(width: f64) -> Self {
        Self { inverse: 1.0 / width.abs() }
    }
}
