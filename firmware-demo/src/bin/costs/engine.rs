//! The engine's functions, for robots that the compiler does not take too long for.

use dynamics_core::model::Robot;
use dynamics_core::{Engine, MassMatrix};

use super::forward::{Forms, Solution};

/// In the order of the table.
pub fn engine<'a, T: Robot<B, N, N>, const B: usize, const N: usize, const TIP: usize>()
-> Forms<'a, N> {
    Forms {
        name: "engine",
        crba: Engine::<T>::crba,
        crba_at: Engine::<T>::crba,
        factor_solve: engine_factor_solve::<T, B, N>,
        forward: Engine::<T>::forward_dynamics,
        forward_at: Engine::<T>::forward_dynamics,
        aba: Engine::<T>::aba,
        aba_at: Engine::<T>::aba,
        jacobian: Engine::<T>::jacobian::<TIP, _, _, _, _>,
        jacobian_at: Engine::<T>::jacobian::<TIP, _, _, _, _>,
    }
}

#[inline(never)]
fn engine_factor_solve<T: Robot<B, N, N>, const B: usize, const N: usize>(
    m: &MassMatrix<f32, N>,
    tau: &[f32; N],
) -> Solution<N> {
    Ok(Engine::<T>::solve(&Engine::<T>::ltdl(m)?, tau))
}
