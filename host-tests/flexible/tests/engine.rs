//! The engine's links that bend against the core's, and against the referee's recording.

use dynamics_core::effects::{Effect, Elasticity, RIGID_BODY};
use dynamics_core::flexible::{Bending, BendingRobot, JointsAndModes};
use dynamics_core::{Core, Engine};
use flexible_tests::{JOINTS, MODES, Numbers, Planar, Spatial};

/// The largest difference over the largest number, of torques and of forces on modes.
fn apart<const V: usize, const M: usize>(
    a: &JointsAndModes<f64, V, M>,
    b: &JointsAndModes<f64, V, M>,
) -> f64 {
    let of = |a: &[f64], b: &[f64]| {
        let scale = b.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
        let worst = a.iter().zip(b).map(|(a, b)| (a - b).abs());
        worst.fold(0.0, f64::max) / f64::max(scale, 1e-300)
    };
    f64::max(of(&a.joints, &b.joints), of(&a.modes, &b.modes))
}

fn same<T: BendingRobot<2, 2, 2, M>, E: Effect<f64, 2, 2>, const M: usize>(scene: &E) {
    let mut numbers = Numbers::new(11);
    for k in 0..100 {
        let (state, bent) = (numbers.state::<2>(JOINTS), numbers.state::<M>(MODES));
        let core = Bending::<Core<T>>::rnea(&state, &bent, scene);
        let engine = Bending::<Engine<T>>::rnea(&state, &bent, scene);
        let error = apart(&engine, &core);
        assert!(error < 1e-13, "{k}: {error:.1e}, {engine:?}, {core:?}");
    }
}

#[test]
fn engine_and_core_bend_alike() {
    same::<Planar, _, 4>(&RIGID_BODY);
    same::<Planar, _, 4>(&(RIGID_BODY, Elasticity));
    same::<Spatial, _, 6>(&RIGID_BODY);
    same::<Spatial, _, 6>(&(RIGID_BODY, Elasticity));
}
