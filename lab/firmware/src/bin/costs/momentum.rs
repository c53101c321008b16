//! p and Cᵀ q̇, and what an observer of external torques costs with them.

use dynamics_core::algorithms::{MomentumAndDrift, frame};
use dynamics_core::effects::{
    Coriolis, Coulomb, Gravity, Inertia, LoadFriction, RIGID_BODY, Viscous, Width,
};
use dynamics_core::model::Robot;
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use motion_control::estimate::{MomentumObserver, ObserverConfig, TipWrench, TipWrenchConfig};
use motion_control::limits::Fault;

use super::row::Row;
use super::{Ask, STATES, inverse};

/// Inverse dynamics and the observer have the same scene.
type Scene<const N: usize> =
    ((Gravity, Inertia, Coriolis), (Viscous<f32, N>, Coulomb<f32, N>), LoadFriction<f32, N>);

pub fn both<T: Robot<B, N, N>, const B: usize, const N: usize>(asks: &[Ask<N>; STATES]) {
    inverse::rows!(momentum_and_coriolis, ["momentum", "full"], asks, &());
    observer::<T, B, N>(asks);
}

/// Inverse dynamics with all friction, the observer's residual with the same friction, and the
/// wrench at the tip.
pub fn observer<T: Robot<B, N, N>, const B: usize, const N: usize>(asks: &[Ask<N>; STATES]) {
    let row = |algorithm, inputs, trig| Row::of::<T, B, N>(algorithm, "engine", inputs, trig);
    let (torque, width) = ([2.0; N], Width::new(0.05));
    let friction = (Viscous([0.5; N]), Coulomb { torque, width });
    let gears = LoadFriction { driving: [0.2; N], backdriving: [0.15; N], width };
    let scene = &(RIGID_BODY, friction, gears);
    let run: inverse::Inside<'_, _, N> = Engine::<T>::rnea;
    row("rnea", "friction", true)
        .measure(run as *const () as usize, asks, |ask| run(&ask.state, scene));

    let config = ObserverConfig { bandwidth: 50.0, tick: 1e-3 };
    let Ok(mut observer) = MomentumObserver::try_new(config) else {
        return;
    };
    let run = residual::<T, B, N>;
    row("residual", "friction", true)
        .measure(run as *const () as usize, asks, |ask| run(&mut observer, &ask.state, scene));

    let columns = asks
        .each_ref()
        .map(|ask| Core::<T>::jacobian(&ask.trig, const { B - 1 }, frame::LocalWorldAligned));
    let sizes = TipWrenchConfig { noise: [0.5; N], force: 100.0, couple: 10.0 };
    let Ok(wrench) = TipWrench::try_new(sizes) else {
        return;
    };
    let run = tip_wrench::<N>;
    row("tip_wrench", "6_directions", false).measure(
        run as *const () as usize,
        &columns,
        |columns| run(&wrench, columns, &[1.0; N]),
    );
}

#[inline(never)]
fn tip_wrench<const N: usize>(
    given: &TipWrench<f32, N>,
    jacobian: &[Motion<f32>; N],
    external: &[f32; N],
) -> Result<Force<f32>, Fault> {
    given.estimate(jacobian, external)
}

/// A tick of the observer: the torques are the state's accelerations, since any will do.
#[inline(never)]
fn residual<T: Robot<B, N, N>, const B: usize, const N: usize>(
    observer: &mut MomentumObserver<f32, N>,
    state: &State<f32, N, N>,
    scene: &Scene<N>,
) -> bool {
    let MomentumAndDrift { p, beta } = Engine::<T>::momentum_and_drift(state, scene);
    let fault = observer.update(&p, &beta);
    observer.drive(&Engine::<T>::transmitted_torque(state, &state.qdd, scene));
    fault.is_err()
}
