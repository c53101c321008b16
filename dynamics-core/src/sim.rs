//! Time steps of a simulated robot.

use crate::algorithms::{NotPositiveDefinite, aba};
use crate::effects::Effect;
use crate::model::Model;
use crate::scalar::Real;
use crate::state::State;

/// One step of `h` seconds by semi-implicit (symplectic) Euler: q̇ ← q̇ + h FD(q, q̇, τ), then
/// q ← q + h q̇ with the new q̇. First order in h; `state.qdd` is left at the acceleration used.
///
/// Hairer, Lubich & Wanner, *Geometric Numerical Integration* (2006), section I.1.2.
///
/// ```
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, sim::semi_implicit, state::State};
/// let mut arm = State::at([0.0_f64, -1.5, 0.0, 0.0, 0.0, 0.0]);
/// semi_implicit(&Ur5e::MODEL, &mut arm, &[0.0; 6], &RIGID_BODY, 1e-3)?;
/// assert!(arm.qd[1] != 0.0);
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// # Errors
/// As [`aba`]; the state is then left as it was.
pub fn semi_implicit<R: Real, E, const B: usize, const N: usize>(
    model: &Model<R, B, N, N>,
    state: &mut State<R, N, N>,
    tau: &[R; N],
    effects: &E,
    h: R,
) -> Result<(), NotPositiveDefinite>
where
    E: Effect<R, B, N>,
{
    state.qdd = aba(model, state, tau, effects)?;
    for ((q, qd), &qdd) in state.q.iter_mut().zip(&mut state.qd).zip(&state.qdd) {
        *qd += h * qdd;
        *q += h * *qd;
    }
    Ok(())
}
