//! M, what solves with it, and the tip's Jacobian, form by form.

use dynamics_core::algorithms::frame::LocalWorldAligned;
use dynamics_core::algorithms::{AccelerationGradient, NotPositiveDefinite};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{OnBody, Robot};
use dynamics_core::spatial::Motion;
use dynamics_core::state::{JointTrig, State, StateWithTrig};
use dynamics_core::{Core, Engine, MassMatrix};

use super::inverse::RigidBody as Scene;
use super::row::Row;
use super::{Ask, STATES, asks, done, estimators, loaded, momentum};

type Solution<const N: usize> = Result<[f32; N], NotPositiveDefinite>;
type Gradient<const N: usize> = Result<AccelerationGradient<f32, N>, NotPositiveDefinite>;
type Forward<'a, const N: usize> = fn(&'a State<f32, N, N>, &[f32; N], &Scene) -> Solution<N>;
type Precomputed<'a, const N: usize> =
    fn(StateWithTrig<'a, f32, N, N>, &[f32; N], &Scene) -> Solution<N>;

/// The functions of core or engine, each with sines and cosines computed inside and before.
pub struct Forms<'a, const N: usize, const TIP: usize> {
    name: &'static str,
    crba: fn(&[f32; N], &Scene) -> MassMatrix<f32, N>,
    crba_before: fn(&JointTrig<f32, N>, &Scene) -> MassMatrix<f32, N>,
    factor_solve: fn(&MassMatrix<f32, N>, &[f32; N]) -> Solution<N>,
    forward: Forward<'a, N>,
    forward_before: Precomputed<'a, N>,
    aba: Forward<'a, N>,
    aba_before: Precomputed<'a, N>,
    derivatives: fn(&'a State<f32, N, N>, &[f32; N], &Scene) -> Gradient<N>,
    jacobian: fn(&[f32; N], OnBody<TIP>, LocalWorldAligned) -> [Motion<f32>; N],
    jacobian_before: fn(&JointTrig<f32, N>, OnBody<TIP>, LocalWorldAligned) -> [Motion<f32>; N],
}

macro_rules! forms {
    ($of:ident, $factor_solve:ident, $Form:ident, $name:literal) => {
        pub fn $of<'a, T: Robot<B, N, N>, const B: usize, const N: usize, const TIP: usize>()
        -> Forms<'a, N, TIP> {
            Forms {
                name: $name,
                crba: $Form::<T>::crba,
                crba_before: $Form::<T>::crba,
                factor_solve: $factor_solve::<T, B, N>,
                forward: $Form::<T>::forward_dynamics,
                forward_before: $Form::<T>::forward_dynamics,
                aba: $Form::<T>::aba,
                aba_before: $Form::<T>::aba,
                derivatives: $Form::<T>::forward_dynamics_derivatives,
                jacobian: $Form::<T>::jacobian,
                jacobian_before: $Form::<T>::jacobian,
            }
        }

        #[inline(never)]
        fn $factor_solve<T: Robot<B, N, N>, const B: usize, const N: usize>(
            m: &MassMatrix<f32, N>,
            tau: &[f32; N],
        ) -> Solution<N> {
            Ok($Form::<T>::solve(&$Form::<T>::ltdl(m)?, tau))
        }
    };
}

forms!(of_core, core_factor_solve, Core, "core");
forms!(of_engine, engine_factor_solve, Engine, "engine");

pub fn both<T: Robot<B, N, N>, const B: usize, const N: usize, const TIP: usize>() -> ! {
    let asks = &asks::<T, B, N, STATES>();
    let forms = [of_core::<T, B, N, TIP>(), of_engine::<T, B, N, TIP>()];
    run::<T, B, N, TIP>(asks, &forms);
    derivatives::<T, B, N, TIP>(asks, &forms);
    momentum::both::<T, B, N>(asks);
    loaded::engine::<T, B, N>(asks);
    estimators::payload::<T, B, N>(asks);
    done()
}

pub fn core<T: Robot<B, N, N>, const B: usize, const N: usize, const TIP: usize>() -> ! {
    let (asks, forms) = (&asks::<T, B, N, STATES>(), [of_core::<T, B, N, TIP>()]);
    run::<T, B, N, TIP>(asks, &forms);
    derivatives::<T, B, N, TIP>(asks, &forms);
    done()
}

pub fn derivatives<'a, T: Robot<B, N, N>, const B: usize, const N: usize, const TIP: usize>(
    asks: &'a [Ask<N>; STATES],
    forms: &[Forms<'a, N, TIP>],
) {
    for form in forms {
        let run = form.derivatives;
        Row::of::<T, B, N>("forward_dynamics_derivatives", form.name, "full", true).measure(
            run as usize,
            asks,
            |ask| run(&ask.state, &ask.state.qdd, &RIGID_BODY),
        );
    }
}

/// Measures the rows of these forms. Torques are the states' accelerations: any will do, since the
/// work does not depend on what they move.
pub fn run<'a, T: Robot<B, N, N>, const B: usize, const N: usize, const TIP: usize>(
    asks: &'a [Ask<N>; STATES],
    forms: &[Forms<'a, N, TIP>],
) {
    let scene = &RIGID_BODY;
    let row = |form: &Forms<'_, N, TIP>, algorithm, trig| {
        Row::of::<T, B, N>(algorithm, form.name, "full", trig)
    };
    for form in forms {
        let (inside, precomputed) = (form.crba, form.crba_before);
        row(form, "crba", true).measure(inside as usize, asks, |ask| inside(&ask.state.q, scene));
        row(form, "crba", false)
            .measure(precomputed as usize, asks, |ask| precomputed(&ask.trig, scene));
    }
    for form in forms {
        let run = form.factor_solve;
        let matrices = asks.each_ref().map(|ask| Core::<T>::crba(&ask.trig, scene));
        row(form, "factor_solve", false).measure(run as usize, &matrices, |m| run(m, &[1.0; N]));
    }
    let forward =
        forms.iter().map(|form| (form, "forward_dynamics", form.forward, form.forward_before));
    let aba = forms.iter().map(|form| (form, "aba", form.aba, form.aba_before));
    for (form, algorithm, inside, precomputed) in forward.chain(aba) {
        row(form, algorithm, true)
            .measure(inside as usize, asks, |ask| inside(&ask.state, &ask.state.qdd, scene));
        row(form, algorithm, false).measure(precomputed as usize, asks, |ask| {
            precomputed(ask.trig.with(&ask.state), &ask.state.qdd, scene)
        });
    }
    for form in forms {
        let (inside, precomputed) = (form.jacobian, form.jacobian_before);
        row(form, "jacobian", true)
            .measure(inside as usize, asks, |ask| inside(&ask.state.q, OnBody, LocalWorldAligned));
        row(form, "jacobian", false).measure(precomputed as usize, asks, |ask| {
            precomputed(&ask.trig, OnBody, LocalWorldAligned)
        });
    }
}
