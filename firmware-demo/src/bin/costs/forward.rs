//! M, what solves with it, and the tip's Jacobian, form by form.

use dynamics_core::algorithms::{NotPositiveDefinite, frame};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::Robot;
use dynamics_core::spatial::Motion;
use dynamics_core::state::{Configuration, JointTrig};
use dynamics_core::{Core, Engine, MassMatrix};

use super::row::Row;
use super::{STATES, asks, done};

/// A function that measures the rows of some forms, algorithm by algorithm, each with sines and cosines computed inside
/// and before. Torques are the states' accelerations: any will do, since the work does not depend on what they move.
macro_rules! measuring {
    ($name:ident: $($form:ident $label:literal $factor_solve:ident $jacobian:expr, $jacobian_before:expr;)+) => {
        pub fn $name<T: Robot<B, N, N>, const B: usize, const N: usize, const TIP: usize>() -> ! {
            let (asks, scene) = (&asks::<T, B, N, STATES>(), &RIGID_BODY);
            let row = |algorithm, form, trig| Row::of::<T, B, N>(algorithm, form, "full", trig);
            $(
                let run: fn(&[f32; N], &_) -> MassMatrix<f32, N> = $form::<T>::crba;
                row("crba", $label, true).measure(run as usize, asks, |ask| run(&ask.state.q, scene));
                let run: fn(&JointTrig<f32, N>, &_) -> MassMatrix<f32, N> = $form::<T>::crba;
                row("crba", $label, false).measure(run as usize, asks, |ask| run(&ask.trig, scene));
            )+
            $(
                let run: fn(&_, &_) -> _ = $factor_solve::<T, B, N>;
                let matrices = asks.each_ref().map(|ask| Core::<T>::crba(&ask.trig, scene));
                row("factor_solve", $label, false).measure(run as usize, &matrices, |m| run(m, &[1.0; N]));
            )+
            $(measuring!(forward row asks scene "forward" $label $form::<T>::forward_dynamics);)+
            $(measuring!(forward row asks scene "aba" $label $form::<T>::aba);)+
            $(
                let run: fn(&[f32; N]) -> [Motion<f32>; N] = $jacobian;
                row("jacobian", $label, true).measure(run as usize, asks, |ask| run(&ask.state.q));
                let run: fn(&JointTrig<f32, N>) -> [Motion<f32>; N] = $jacobian_before;
                row("jacobian", $label, false).measure(run as usize, asks, |ask| run(&ask.trig));
            )+
            done()
        }
    };
    (forward $row:ident $asks:ident $scene:ident $algorithm:literal $label:literal $function:expr) => {
        let run: fn(_, &_, &_) -> _ = $function;
        $row($algorithm, $label, true).measure(run as usize, $asks, |ask| run(&ask.state, &ask.state.qdd, $scene));
        let run: fn(_, &_, &_) -> _ = $function;
        $row($algorithm, $label, false)
            .measure(run as usize, $asks, |ask| run(ask.trig.with(&ask.state), &ask.state.qdd, $scene));
    };
}

measuring! { both:
    Core "core" core_factor_solve tip_jacobian::<_, T, B, N>, tip_jacobian::<_, T, B, N>;
    Engine "engine" engine_factor_solve
        Engine::<T>::jacobian::<TIP, _, _, _, _>, Engine::<T>::jacobian::<TIP, _, _, _, _>;
}

measuring! { core: Core "core" core_factor_solve tip_jacobian::<_, T, B, N>, tip_jacobian::<_, T, B, N>; }

/// M's factors and one solution.
macro_rules! factor_solve {
    ($($name:ident $form:ident;)+) => {$(
        #[inline(never)]
        fn $name<T: Robot<B, N, N>, const B: usize, const N: usize>(
            m: &MassMatrix<f32, N>,
            tau: &[f32; N],
        ) -> Result<[f32; N], NotPositiveDefinite> {
            Ok($form::<T>::solve(&$form::<T>::ltdl(m)?, tau))
        }
    )+};
}

factor_solve! { core_factor_solve Core; engine_factor_solve Engine; }

/// The engine's: of the last body, along the axes of the base.
#[inline(never)]
fn tip_jacobian<C: Configuration<f32, N>, T: Robot<B, N, N>, const B: usize, const N: usize>(
    q: &C,
) -> [Motion<f32>; N] {
    Core::<T>::jacobian(q, const { B - 1 }, frame::LocalWorldAligned)
}
