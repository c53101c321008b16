//! The interface of every approximation of sine and cosine.

/// An approximation of sine and cosine, selected as a type.
///
/// ```
/// use dynamics_core::{Engine, effects::RIGID_BODY, robots::Ur5e, state::State, trig::{Kernel, Minimax}};
/// /// A user's own.
/// struct Coarse;
/// impl Kernel<f32> for Coarse {
///     fn sin_cos(x: f32) -> (f32, f32) {
///         Minimax::<3, 2>::sin_cos(x)
///     }
/// }
/// let state = State { q: [0.1_f32; 6], qd: [0.5; 6], qdd: [1.0; 6] };
/// let tau = Engine::<Ur5e, Coarse>::rnea(&state, &RIGID_BODY);
/// let all = Engine::<Ur5e>::rnea(&state, &RIGID_BODY);
/// assert!(tau.iter().zip(all).all(|(a, b)| (a - b).abs() < 1e-3 * 100.0));
/// ```
pub trait Kernel<R> {
    /// (sin x, cos x) of x in rad.
    fn sin_cos(x: R) -> (R, R);

    /// (sin x, cos x) of x in rad, |x| ≤ 100: [`crate::Engine`] uses it for joints whose limits lie
    /// within ±4π.
    #[cfg_attr(optimised, inline(always))]
    fn sin_cos_near(x: R) -> (R, R) {
        Self::sin_cos(x)
    }
}

/// The rest r of a reduction, or nothing if that was not `inside` its range: 0 of a finite x, NaN
/// of others.
///
/// Without a branch: the compiler would make one of an `if`.
#[allow(clippy::eq_op, reason = "x − x is 0 of a finite x and NaN of any other")]
#[cfg_attr(optimised, inline(always))]
pub(super) fn bounded(r: f32, inside: bool, x: f32) -> f32 {
    core::hint::select_unpredictable(inside, r, x - x)
}

/// Whether the processor computes several numbers at once, so that sines of several joints together
/// take less time than one by one.
pub(crate) const VECTORS: bool = cfg!(any(target_feature = "sse2", target_feature = "neon"));

/// Whether the processor has gathers, which load several numbers at once, each from an address of
/// its own.
pub(super) const GATHERS: bool = cfg!(target_feature = "avx2");
