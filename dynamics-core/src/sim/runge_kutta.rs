//! A time step of fourth order, on joints of any kind.
//!
//! Runge and Kutta's method as Celledoni, Marthinsen & Owren, "Commutator-free Lie group methods" (2003),
//! section 3.2, write it for groups, here for velocities in the body's own frame. With k = (q̇, q̈):
//!
//! ```text
//! Y₂ = Y ⊕ h/2 k₁    Y₃ = Y ⊕ h/2 k₂    Y₄ = Y₂ ⊕ h (k₃ − k₁/2)
//! Y₊ = Y ⊕ h/12 (3 k₁ + 2 k₂ + 2 k₃ − k₄) ⊕ h/12 (−k₁ + 2 k₂ + 2 k₃ + 3 k₄)
//! ```
//!
//! For joints of one axis it is the classical method.

use crate::algorithms::{NotPositiveDefinite, aba};
use crate::configuration::integrate;
use crate::effects::Effect;
use crate::model::Description;
use crate::scalar::Real;
use crate::state::State;

/// One step of `h` seconds of fourth order, explicit: for motion without stiff springs, dampers or dry
/// friction. `state.qdd` is left at the mean acceleration; what effects remember stays as it is.
///
/// Cost: four times that of [`aba`], and for quaternions five exponentials.
///
/// ```
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, sim::runge_kutta, state::State};
/// use dynamics_core::algorithms::{kinetic_energy, potential_energy};
/// let mut arm = State::at([0.0_f64, -1.5, 0.0, 0.0, 0.0, 0.0]);
/// let energy = |arm: &State<f64, 6, 6>| {
///     kinetic_energy(&Ur5e::MODEL, arm, &()) + potential_energy(&Ur5e::MODEL, &arm.q, &RIGID_BODY)
/// };
/// let before = energy(&arm);
/// for _ in 0..1000 {
///     runge_kutta(&Ur5e::MODEL, &mut arm, &[0.0; 6], &RIGID_BODY, 1e-3)?;
/// }
/// assert!((energy(&arm) - before).abs() < 1e-6);
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// # Errors
/// As [`aba`]; the state is then left as it was.
pub fn runge_kutta<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: &mut State<R, Q, V>,
    tau: &[R; V],
    effects: &E,
    h: R,
) -> Result<(), NotPositiveDefinite>
where
    D: Description<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let of = R::from_f64;
    let (half, zero) = (of(0.5) * h, [R::ZERO; V]);
    // The state from q on by a step of positions, at q̇ and a step of velocities.
    let stage = |from: &[R; Q], step: &[R; V], faster: &[R; V]| State {
        q: integrate(robot, from, step),
        qd: sum([(R::ONE, &state.qd), (R::ONE, faster)]),
        qdd: zero,
    };
    let rate = |at: &State<R, Q, V>| aba(robot, at, tau, effects);

    let (v_1, a_1) = (state.qd, rate(state)?);
    let y = stage(&state.q, &sum([(half, &v_1)]), &sum([(half, &a_1)]));
    let (second, v_2, a_2) = (y.q, y.qd, rate(&y)?);
    let y = stage(&state.q, &sum([(half, &v_2)]), &sum([(half, &a_2)]));
    let (v_3, a_3) = (y.qd, rate(&y)?);
    let ahead = sum([(h, &v_3), (-half, &v_1)]);
    let y = stage(&second, &ahead, &sum([(h, &a_3)]));
    let (v_4, a_4) = (y.qd, rate(&y)?);

    let w = h * of(1.0 / 12.0);
    let (less, twice, more) = (-w, w + w, of(3.0) * w);
    let first = sum([(more, &v_1), (twice, &v_2), (twice, &v_3), (less, &v_4)]);
    let last = sum([(less, &v_1), (twice, &v_2), (twice, &v_3), (more, &v_4)]);
    let (sixth, third) = (of(1.0 / 6.0), of(1.0 / 3.0));
    state.qdd = sum([(sixth, &a_1), (third, &a_2), (third, &a_3), (sixth, &a_4)]);
    state.qd = sum([(R::ONE, &state.qd), (h, &state.qdd)]);
    state.q = integrate(robot, &integrate(robot, &state.q, &first), &last);
    Ok(())
}

/// Σ w k.
fn sum<R: Real, const V: usize, const N: usize>(terms: [(R, &[R; V]); N]) -> [R; V] {
    let mut out = [R::ZERO; V];
    for (weight, k) in terms {
        for (out, &k) in out.iter_mut().zip(k) {
            *out += weight * k;
        }
    }
    out
}
