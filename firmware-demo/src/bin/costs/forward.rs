//! M, what solves with it, and the tip's Jacobian, form by form.

use dynamics_core::algorithms::{NotPositiveDefinite, frame};
use dynamics_core::effects::{Coriolis, Gravity, Inertia, RIGID_BODY};

use dynamics_core::model::Robot;
use dynamics_core::spatial::Motion;
use dynamics_core::state::{JointTrig, State, StateWithTrig};
use dynamics_core::{Core, MassMatrix};

use super::costs::row::Row;
use super::costs::{Ask, STATES, done};

pub type Scene = (Gravity, Inertia, Coriolis);
pub type Solution<const N: usize> = Result<[f32; N], NotPositiveDefinite>;
pub type Forward<'a, const N: usize> = fn(&'a State<f32, N, N>, &[f32; N], &Scene) -> Solution<N>;
pub type Precomputed<'a, const N: usize> =
    fn(StateWithTrig<'a, f32, N, N>, &[f32; N], &Scene) -> Solution<N>;

/// The functions of core or engine, each with sines and cosines computed inside and before.
pub struct Forms<'a, const N: usize> {
    pub name: &'static str,
    pub crba: fn(&[f32; N], &Scene) -> MassMatrix<f32, N>,
    pub crba_at: fn(&JointTrig<f32, N>, &Scene) -> MassMatrix<f32, N>,
    pub factor_solve: fn(&MassMatrix<f32, N>, &[f32; N]) -> Solution<N>,
    pub forward: Forward<'a, N>,
    pub forward_at: Precomputed<'a, N>,
    pub aba: Forward<'a, N>,
    pub aba_at: Precomputed<'a, N>,
    pub jacobian: fn(&[f32; N]) -> [Motion<f32>; N],
    pub jacobian_at: fn(&JointTrig<f32, N>) -> [Motion<f32>; N],
}

impl<const N: usize> Forms<'_, N> {
    pub fn core<T: Robot<B, N, N>, const B: usize>() -> Self {
        Self {
            name: "core",
            crba: Core::<T>::crba,
            crba_at: Core::<T>::crba,
            factor_solve: core_factor_solve::<T, B, N>,
            forward: Core::<T>::forward_dynamics,
            forward_at: Core::<T>::forward_dynamics,
            aba: Core::<T>::aba,
            aba_at: Core::<T>::aba,
            jacobian: tip_jacobian::<T, B, N>,
            jacobian_at: tip_jacobian_at::<T, B, N>,
        }
    }
}

#[inline(never)]
fn core_factor_solve<T: Robot<B, N, N>, const B: usize, const N: usize>(
    m: &MassMatrix<f32, N>,
    tau: &[f32; N],
) -> Solution<N> {
    Ok(Core::<T>::solve(&Core::<T>::ltdl(m)?, tau))
}

/// The engine's: of the last body, along the axes of the base.
#[inline(never)]
fn tip_jacobian<T: Robot<B, N, N>, const B: usize, const N: usize>(
    q: &[f32; N],
) -> [Motion<f32>; N] {
    Core::<T>::jacobian(q, const { B - 1 }, frame::LocalWorldAligned)
}

#[inline(never)]
fn tip_jacobian_at<T: Robot<B, N, N>, const B: usize, const N: usize>(
    trig: &JointTrig<f32, N>,
) -> [Motion<f32>; N] {
    Core::<T>::jacobian(trig, const { B - 1 }, frame::LocalWorldAligned)
}

/// Measures the rows of these forms and leaves the emulator. Torques are the states' accelerations: any
/// will do, since the work does not depend on what they move.
pub fn run<'a, T: Robot<B, N, N>, const B: usize, const N: usize>(
    asks: &'a [Ask<N>; STATES],
    forms: &[Forms<'a, N>],
) -> ! {
    let scene = &RIGID_BODY;
    let row = |form: &Forms<'_, N>, algorithm, trig| Row {
        robot: T::MODEL.name,
        algorithm,
        form: form.name,
        inputs: "full",
        trig,
        joints: N,
    };
    for form in forms {
        let (inside, precomputed) = (form.crba, form.crba_at);
        row(form, "crba", true).measure(inside as usize, asks, |ask| inside(&ask.state.q, scene));
        row(form, "crba", false).measure(precomputed as usize, asks, |ask| {
            precomputed(&ask.trig, scene)
        });
    }
    for form in forms {
        let run = form.factor_solve;
        let matrices = asks.each_ref().map(|ask| Core::<T>::crba(&ask.trig, scene));
        row(form, "factor_solve", false).measure(run as usize, &matrices, |m| run(m, &[1.0; N]));
    }
    let forward = forms
        .iter()
        .map(|form| (form, "forward", form.forward, form.forward_at));
    let aba = forms
        .iter()
        .map(|form| (form, "aba", form.aba, form.aba_at));
    for (form, algorithm, inside, precomputed) in forward.chain(aba) {
        row(form, algorithm, true).measure(inside as usize, asks, |ask| {
            inside(&ask.state, &ask.state.qdd, scene)
        });
        row(form, algorithm, false).measure(precomputed as usize, asks, |ask| {
            precomputed(ask.trig.with(&ask.state), &ask.state.qdd, scene)
        });
    }
    for form in forms {
        let (inside, precomputed) = (form.jacobian, form.jacobian_at);
        row(form, "jacobian", true).measure(inside as usize, asks, |ask| inside(&ask.state.q));
        row(form, "jacobian", false)
            .measure(precomputed as usize, asks, |ask| precomputed(&ask.trig));
    }
    done()
}
