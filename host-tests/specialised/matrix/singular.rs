//! An M that is not positive definite is refused by name, and never a NaN.

use dynamics_core::algorithms::{
    NotPositiveDefinite, Prescribed, aba, cholesky, crba, forward_dynamics, hybrid_dynamics, ltdl,
    solve, spatial_operator_inverse, spatial_operator_ltdl,
};
use dynamics_core::effects::{Armature, Coriolis, Effect, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use proptest::prelude::RngExt;

use super::trees::random_numbers;

/// A link of mass, one of none, and a fork: another of mass.
fn massless_tip() -> ArmModel<f64, 3> {
    let link = Body::new("link", BASE, Joint::revolute([0.0, 1.0, 0.0]))
        .mass(1.0)
        .com([0.2, 0.0, 0.0])
        .inertia([0.01, 0.0, 0.0, 0.01, 0.0, 0.01]);
    let tip = |joint| Body::new("tip", 0, joint).xyz([0.4, 0.0, 0.1]);
    Model::new(
        "massless tip",
        [
            link,
            tip(Joint::revolute([1.0, 0.0, 0.0])),
            tip(Joint::prismatic([0.0, 0.0, 1.0])).mass(1.0),
        ],
    )
}

/// The verdict of each algorithm on the robot under a scene.
fn verdicts<R: Real, E: Effect<R, N, N>, const N: usize>(
    model: &ArmModel<R, N>,
    scene: &E,
) -> [Option<NotPositiveDefinite>; 7] {
    let state = State { qd: [R::ONE; N], ..State::at([R::from_f64(0.3); N]) };
    let (tau, m) = ([R::ONE; N], crba(model, &state.q, scene));
    fn finite<R: Real, const N: usize>(qdd: [R; N]) {
        assert!(qdd.iter().all(|x| x.is_finite()), "{qdd:?}");
    }
    [
        aba(model, &state, &tau, scene).map(finite).err(),
        forward_dynamics(model, &state, &tau, scene).map(finite).err(),
        hybrid_dynamics(model, &state, &tau.map(Prescribed::Torque), scene)
            .map(|r| finite(r.qdd))
            .err(),
        ltdl(model, &m).map(|f| finite(solve(model, &f, &tau))).err(),
        cholesky(model, &m).map(|f| finite(f.solve(model, &tau))).err(),
        spatial_operator_ltdl(model, &state.q, scene).err(),
        spatial_operator_inverse(model, &state.q, scene).err(),
    ]
}

fn names_the_massless_tip<R: Real>(model: &ArmModel<R, 3>) {
    let named = verdicts(model, &RIGID_BODY).map(|error| error.map(|error| error.joint));
    assert_eq!(named, [Some(1); 7]);
    let rotor = Armature([R::ZERO, R::from_f64(1e-4), R::ZERO]);
    let scene = (Gravity::EARTH, Inertia, Coriolis, rotor);
    assert_eq!(verdicts(model, &scene), [None; 7]);
}

// Without a rotor it is named, and with one M is definite.
#[test]
fn a_massless_last_link_needs_a_rotor() {
    names_the_massless_tip::<f64>(&massless_tip());
    names_the_massless_tip::<f32>(&massless_tip().to_f32());
}

// A joint of prescribed motion needs no inertia.
#[test]
fn a_nan_inertia_is_named() {
    let mut model = massless_tip();
    let state = State::at([0.1; 3]);
    let mut given = [Prescribed::Torque(0.0); 3];
    given[1] = Prescribed::Acceleration(2.0);
    let response =
        hybrid_dynamics(&model, &state, &given, &RIGID_BODY).expect("joint 1 is not solved for");
    assert!(response.qdd.iter().chain(&response.tau).all(|x| x.is_finite()));
    model.links[2].inertia.mass = f64::NAN;
    let named = verdicts(&model, &RIGID_BODY).map(|error| error.map(|error| error.joint));
    assert_eq!(named, [Some(2); 7]);
}

/// Elimination leaves rounding errors of either sign of a singular M.
#[test]
fn a_pivot_of_rounding_errors_is_refused_whatever_its_size() {
    fn refuse<R: Real>(model: &ArmModel<R, 2>) {
        let m = crba(model, &[R::from_f64(0.3); 2], &RIGID_BODY);
        assert_eq!(ltdl(model, &m).map_err(|e| e.joint).err(), Some(0));
        assert_eq!(cholesky(model, &m).map_err(|e| e.joint).err(), Some(0));
    }
    let rng = &mut random_numbers();
    for _ in 0..2000 {
        // Two joints on one axis, and all that moves on the second.
        let z = [0.0, 0.0, 1.0];
        let scale: f64 = 10.0_f64.powi(rng.random_range(-6..6));
        let rod = Body::new("rod", 0, Joint::revolute(z)).mass(scale * rng.random_range(0.5..2.0));
        let rod = rod.com([rng.random_range(0.1..1.0), rng.random_range(-1.0..1.0), 0.0]);
        let model = Model::new("coaxial", [Body::new("none", BASE, Joint::revolute(z)), rod]);
        refuse(&model);
        refuse(&model.to_f32());
    }
}
