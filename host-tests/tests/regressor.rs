//! The regressor: against Pinocchio's, and Y φ as inverse dynamics on trees of every joint.

use crate::common::of_recorded_robots;
use crate::common::*;
use dynamics_core::Core;
use dynamics_core::algorithms::{
    friction_regressor, inertial_parameters, regressor, regressor_columns, regressor_row, rnea,
};
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Effect, Gravity, Inertia, MovingBase, Payload, RIGID_BODY,
    Viscous, Width,
};
use dynamics_core::model::{BodyInertia, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;
use dynamics_core::spatial::Motion;
use dynamics_core::state::State;
use glam::DVec3;
use host_tests::measured::largest;
use host_tests::recordings::{Recording, load, row};

/// By coordinates, bodies and parameters.
type Y<const B: usize, const V: usize> = [[[f64; 10]; B]; V];

/// The recorded regressor of a state.
fn recorded<const B: usize, const V: usize>(r: &Recording, state: usize) -> Y<B, V> {
    let (rows, rest) = r.regressor[state].as_chunks::<10>();
    assert_eq!((rows.len(), rest.len()), (B * V, 0), "of another robot");
    core::array::from_fn(|k| core::array::from_fn(|i| rows[k * B + i]))
}

/// The largest error of a parameter's entries relative to their full scale over the recorded
/// states.
fn error<const B: usize, const V: usize>(r: &Recording, got: impl Fn(usize) -> Y<B, V>) -> f64 {
    let mut worst = [(); 10].map(|()| Worst::default());
    for i in 0..r.regressor.len() {
        let (got, want) = (got(i), recorded::<B, V>(r, i));
        for (got, want) in got.iter().flatten().zip(want.iter().flatten()) {
            for (k, worst) in worst.iter_mut().enumerate() {
                worst.see([got[k]], [want[k]]);
            }
        }
    }
    largest(worst.map(|worst| worst.error / worst.full_scale))
}

fn state_of<R: Real, const Q: usize, const V: usize>(r: &Recording, i: usize) -> State<R, Q, V> {
    State {
        q: row::<Q>(&r.q, i).map(R::from_f64),
        qd: row::<V>(&r.qd, i).map(R::from_f64),
        qdd: row::<V>(&r.qdd, i).map(R::from_f64),
    }
}

fn of_robot<R: Real, T, const B: usize, const Q: usize, const V: usize>() -> f64
where
    T: Robot<B, Q, V>,
{
    let r = load(T::MODEL.name);
    let whole = error(&r, |i| {
        Core::<T>::regressor(&state_of::<R, Q, V>(&r, i), &RIGID_BODY)
            .map(|row| row.map(|body| body.map(R::to_f64)))
    });
    let by_columns = error(&r, |i| {
        let state = state_of::<R, Q, V>(&r, i);
        let mut y = [[[0.0; 10]; B]; V];
        for body in 0..B {
            let columns = Core::<T>::regressor_columns(&state, &RIGID_BODY, body);
            for (row, column) in y.iter_mut().zip(columns) {
                row[body] = column.map(R::to_f64);
            }
        }
        y
    });
    let by_rows = error::<B, V>(&r, |i| {
        let state = state_of::<R, Q, V>(&r, i);
        core::array::from_fn(|k| {
            Core::<T>::regressor_row(&state, &RIGID_BODY, k).map(|body| body.map(R::to_f64))
        })
    });
    largest([whole, by_columns, by_rows])
}

/// In f64 and f32.
fn both<T, const B: usize, const Q: usize, const V: usize>(most: &mut [f64; 2])
where
    T: Robot<B, Q, V>,
{
    *most = [
        largest([most[0], of_robot::<f64, T, B, Q, V>()]),
        largest([most[1], of_robot::<f32, T, B, Q, V>()]),
    ];
}

#[test]
fn the_regressor_its_rows_and_its_columns_agree_with_pinocchio() {
    let mut most = [0.0; 2];
    of_recorded_robots!(both, &mut most);
    let mut verdict = Verdict::default();
    for (scalar, error) in ["f64", "f32"].into_iter().zip(most) {
        let full_scale = 1.0;
        verdict.see("recorded robots", "regressor", scalar, &Worst { error, full_scale });
    }
    verdict.speak();
}

/// Σ Y φ.
fn product<R: Real, const B: usize, const V: usize>(
    y: &[[[R; 10]; B]; V],
    phi: &[[R; 10]; B],
) -> [f64; V] {
    core::array::from_fn(|k| {
        let terms = y[k].iter().flatten().zip(phi.iter().flatten());
        terms.map(|(y, phi)| (*y * *phi).to_f64()).sum()
    })
}

fn carried() -> Payload<f64, { B - 1 }> {
    Payload::from_inertia(BodyInertia {
        mass: 1.5,
        com: [0.1, -0.2, 0.05],
        inertia: [0.01, 0.002, -0.003, 0.02, 0.001, 0.015],
    })
}

fn see(worst: &mut Worst, tree: &Tree, state: &State<f64, Q, V>, scene: impl Effect<f64, B, V>) {
    let y = regressor(tree, state, &scene);
    let tau = rnea(tree, state, &scene);
    worst.see(product(&y, &inertial_parameters(tree, &scene)), tau);
}

// Joints are of every kind, and each effect of bodies acts.
#[test]
fn y_phi_is_inverse_dynamics() {
    let mut worst = <[Worst; 2]>::default();
    for (tree, state) in trees(false) {
        let ship = MovingBase {
            velocity: Motion::new(DVec3::new(0.3, -0.5, 0.7), DVec3::new(0.1, 0.2, -0.3)),
            acceleration: Motion::new(DVec3::new(-1.0, 2.0, 0.5), DVec3::new(0.4, 1.0, -2.0)),
        };
        see(&mut worst[0], &tree, &state, RIGID_BODY);
        see(&mut worst[0], &tree, &state, Gravity::EARTH);
        see(&mut worst[0], &tree, &state, (Gravity::EARTH, Coriolis));
        see(&mut worst[0], &tree, &state, (Inertia, ship));
        see(&mut worst[0], &tree, &state, (RIGID_BODY, carried(), ship));
        let (single, at) = (tree.to_f32(), state_of_single(&state));
        let y = regressor(&single, &at, &RIGID_BODY);
        let phi = inertial_parameters(&single, &());
        worst[1].see(product(&y, &phi), rnea(&tree, &state, &RIGID_BODY));
    }
    let mut verdict = Verdict::default();
    verdict.see("mixed tree", "Y φ", "f64", &worst[0]);
    verdict.see("mixed tree", "Y φ", "f32", &worst[1]);
    verdict.speak();
}

fn state_of_single(state: &State<f64, Q, V>) -> State<f32, Q, V> {
    State {
        q: state.q.map(|x| x as f32),
        qd: state.qd.map(|x| x as f32),
        qdd: state.qdd.map(|x| x as f32),
    }
}

#[test]
fn with_the_columns_of_friction_and_armatures_y_is_complete() {
    let mut worst = Worst::default();
    let (b, f, j): ([f64; 6], [f64; 6], [f64; 6]) = ([6.0; 6], [3.0; 6], [0.8; 6]);
    let width = Width::new(0.5);
    let friction = (Viscous(b), Coulomb { torque: f, width }, Armature(j));
    let mut rng = Rng::new(7);
    for _ in 0..100 {
        let state = random_state(&Ur5e::MODEL, &mut rng);
        let y = Core::<Ur5e>::regressor(&state, &RIGID_BODY);
        let bodies = product(&y, &inertial_parameters(&Ur5e::MODEL, &()));
        let joints = friction_regressor(&state.qd, width);
        let tau = core::array::from_fn(|k| {
            bodies[k] + b[k] * joints[k][0] + f[k] * joints[k][1] + j[k] * state.qdd[k]
        });
        worst.see(tau, Core::<Ur5e>::rnea(&state, &(RIGID_BODY, friction)));
    }
    let mut verdict = Verdict::default();
    verdict.see("ur5e", "Y φ with friction", "f64", &worst);
    verdict.speak();
}

#[test]
fn a_missing_body_or_coordinate_gives_zeros() {
    let state = State::at([0.3; 6]);
    for beyond in [6, usize::MAX] {
        let columns = regressor_columns(&Ur5e::MODEL, &state, &RIGID_BODY, beyond);
        assert_eq!(columns, [[0.0; 10]; 6]);
        let row = regressor_row(&Ur5e::MODEL, &state, &RIGID_BODY, beyond);
        assert_eq!(row, [[0.0; 10]; 6]);
    }
}
