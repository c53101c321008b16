//! C(q, q̇) as a matrix and by the RNEA of two velocities: laws on trees with joints of every kind,
//! and on arms.

use crate::common::*;
use dynamics_core::algorithms::{
    MassMatrix, coriolis_matrix, crba, momentum_and_coriolis, rnea, rnea_two_velocities,
};
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Effect, Gravity, GyroscopicRotors, Inertia, MovingBase, Payload,
    Viscous, Width,
};
use dynamics_core::model::{BodyInertia, JointKind, Model, Robot};
use dynamics_core::robots::{A1, Panda, Ur5e};
use dynamics_core::spatial::Motion;
use dynamics_core::state::State;
use glam::DVec3;

type Matrix<const V: usize> = [[f64; V]; V];
type Scene = ((Armature<f64, V>, GyroscopicRotors<f64, V>), (Payload<f64, { B - 1 }>, Coriolis));

/// The additions to the inertia of a tree's bodies: armatures, spinning rotors and a payload.
fn scene(tree: &Tree) -> Scene {
    let load = Payload::from_inertia(BodyInertia {
        mass: 1.5,
        com: [0.1, -0.2, 0.05],
        inertia: [0.01, 0.0, 0.0, 0.02, 0.0, 0.015],
    });
    let mut inertia = [0.0; V];
    let single = (tree.links.iter()).filter(|link| link.joint.kind.coordinates().1 == 1);
    single.for_each(|link| inertia[link.idx_v] = 1e-2);
    let ratio = [20.0; V];
    let rotors = GyroscopicRotors { inertia, ratio };
    ((Armature([0.3; V]), rotors), (load, Coriolis))
}

fn times<const V: usize>(m: &Matrix<V>, x: &[f64; V]) -> [f64; V] {
    m.map(|row| row.iter().zip(x).map(|(m, x)| m * x).sum())
}

fn transposed<const V: usize>(m: &Matrix<V>) -> Matrix<V> {
    core::array::from_fn(|i| core::array::from_fn(|j| m[j][i]))
}

fn rows<const V: usize>(m: &MassMatrix<f64, V>) -> Matrix<V> {
    core::array::from_fn(|i| *m.row(i).unwrap())
}

fn with<const Q: usize, const V: usize>(
    state: &State<f64, Q, V>,
    qd: [f64; V],
) -> State<f64, Q, V> {
    let qdd = [0.0; V];
    State { qd, qdd, ..*state }
}

/// b with S b = S x × S y of each joint.
fn bracket(tree: &Tree, x: &[f64; V], y: &[f64; V]) -> [f64; V] {
    let mut b = [0.0; V];
    for link in &tree.links {
        let three = |of: &[f64; V], k: usize| DVec3::from_slice(&of[link.idx_v + k..][..3]);
        let mut put = |k: usize, v: DVec3| b[link.idx_v + k..][..3].copy_from_slice(&v.to_array());
        match link.joint.kind {
            JointKind::Spherical => put(0, three(x, 0).cross(three(y, 0))),
            JointKind::Free => {
                let (w, v) = (three(x, 0), three(x, 3));
                put(0, w.cross(three(y, 0)));
                put(3, w.cross(three(y, 3)) + v.cross(three(y, 0)));
            }
            JointKind::Planar => {
                // A rotation about z, and a translation along x and y.
                let ([w, vx, vy], [u, ux, uy]) = (three(x, 0).to_array(), three(y, 0).to_array());
                put(0, DVec3::new(0.0, u * vy - w * uy, w * ux - u * vx));
            }
            _ => {}
        }
    }
    b
}

const LAWS: [&str; 6] = [
    "C qd and rnea",
    "C(x) y by polarisation",
    "C(x) y less C(y) x",
    "C y by the matrix",
    "rate of M and C + Cᵀ",
    "Cᵀ qd by C",
];

fn laws() -> [Worst; 6] {
    let mut worst = <[Worst; 6]>::default();
    let mut rng = Rng::new(17);
    for (tree, state) in trees(false) {
        let scene = scene(&tree);
        let (x, y) = (state.qd, rng.vector::<V>(3.0));
        let at = |qd| with(&state, qd);
        let bias = |qd| rnea(&tree, &at(qd), &scene);
        let product = |x, y: &[f64; V]| rnea_two_velocities(&tree, &at(x), y, &scene);
        let (xy, yx) = (product(x, &y), product(y, &x));
        worst[0].see(product(x, &x), bias(x));
        // C q̇ is quadratic in q̇.
        let sum = bias(core::array::from_fn(|i| x[i] + y[i]));
        let apart = bias(core::array::from_fn(|i| x[i] - y[i]));
        worst[1].see::<V>(
            core::array::from_fn(|i| 0.5 * (xy[i] + yx[i])),
            core::array::from_fn(|i| 0.25 * (sum[i] - apart[i])),
        );
        let m = rows(&crba(&tree, &state.q, &(scene.0.1, scene.1)));
        worst[2].see(core::array::from_fn(|i| xy[i] - yx[i]), times(&m, &bracket(&tree, &x, &y)));
        let c = coriolis_matrix(&tree, &state, &scene);
        worst[3].see(times(&c, &y), xy);
        let rate = slope(|t| {
            let q = moved(&tree, &state.q, &state.qd, t);
            let m = rows(&crba(&tree, &q, &scene));
            core::array::from_fn::<_, { V * V }, _>(|k| m[k / V][k % V])
        });
        worst[4].see(core::array::from_fn(|k| c[k / V][k % V] + c[k % V][k / V]), rate);
        let ct_qd = momentum_and_coriolis(&tree, &state, &scene).ct_qd;
        worst[5].see(times(&transposed(&c), &x), ct_qd);
    }
    worst
}

// The trees have joints of every kind, rotors and a payload.
#[test]
fn the_coriolis_matrix_satisfies_its_laws() {
    let mut verdict = Verdict::default();
    for (law, worst) in LAWS.iter().zip(laws()) {
        verdict.see("mixed tree", law, "f64", &worst);
    }
    verdict.speak();
}

/// C of an arm of revolute joints, and its Christoffel symbols by differences of M.
fn christoffel<const N: usize, const V: usize>(arm: &Model<f64, N, V, V>, worst: &mut Worst) {
    let mut rng = Rng::new(5);
    for _ in 0..20 {
        let state = random_state(arm, &mut rng);
        let by_q: [Matrix<V>; V] = core::array::from_fn(|k| {
            let m = |t: f64| {
                let mut q = state.q;
                q[k] += t;
                rows(&crba(arm, &q, &()))
            };
            let h = 2e-3;
            let [a, b, c, d] = [h, -h, 2.0 * h, -2.0 * h].map(m);
            core::array::from_fn(|i| {
                core::array::from_fn(|j| {
                    (8.0 * (a[i][j] - b[i][j]) - (c[i][j] - d[i][j])) / (12.0 * h)
                })
            })
        });
        let c = coriolis_matrix(arm, &state, &());
        for i in 0..V {
            let want = core::array::from_fn(|j| {
                let symbols = (0..V).map(|k| by_q[k][i][j] + by_q[j][i][k] - by_q[i][j][k]);
                symbols.zip(state.qd).map(|(s, qd)| 0.5 * s * qd).sum()
            });
            worst.see(c[i], want);
        }
    }
}

#[test]
fn c_of_an_arm_is_that_of_the_christoffel_symbols() {
    let mut worst = [(); 3].map(|()| Worst::default());
    christoffel(&Ur5e::MODEL, &mut worst[0]);
    christoffel(&Panda::MODEL, &mut worst[1]);
    christoffel(&A1::MODEL, &mut worst[2]);
    let mut verdict = Verdict::default();
    for (arm, worst) in ["ur5e", "panda", "a1"].iter().zip(&worst) {
        verdict.see(arm, "Christoffel symbols", "f64", worst);
    }
    verdict.speak();
}

// This holds under every effect.
#[test]
fn two_equal_velocities_give_the_torque_of_rnea() {
    let mut worst = [(); 2].map(|()| Worst::default());
    let mut rng = Rng::new(23);
    let friction = (Viscous([2.0; V]), Coulomb { torque: [1.0; V], width: Width::new(0.05) });
    let ship = MovingBase {
        velocity: Motion::new(DVec3::new(0.3, -0.5, 0.7), DVec3::new(0.1, 0.2, -0.3)),
        acceleration: Motion::new(DVec3::new(-1.0, 2.0, 0.5), DVec3::new(0.4, 1.0, -2.0)),
    };
    for (tree, state) in trees(false) {
        let whole = (scene(&tree), (Gravity::EARTH, Inertia), friction, ship);
        let torque = |y: &[f64; V]| rnea_two_velocities(&tree, &state, y, &whole);
        worst[0].see(torque(&state.qd), rnea(&tree, &state, &whole));
        // The second velocity acts by C alone, also on a base that moves.
        let y = rng.vector::<V>(3.0);
        let (with, without) = (torque(&y), torque(&[0.0; V]));
        let c = coriolis_matrix(&tree, &state, &(scene(&tree), ship));
        worst[1].see(core::array::from_fn(|i| with[i] - without[i]), times(&c, &y));
    }
    let mut verdict = Verdict::default();
    verdict.see("mixed tree", "rnea of equal velocities", "f64", &worst[0]);
    verdict.see("mixed tree", "C y on a moving base", "f64", &worst[1]);
    verdict.speak();
    // Quantities that no effect needs are not computed.
    let (tree, state) = trees(false).next().unwrap();
    let gravity = |state: &_, y| rnea_two_velocities(&tree, state, &y, &Gravity::EARTH);
    let rest = with(&state, [0.0; V]);
    assert_eq!(gravity(&state, [1.0; V]), gravity(&rest, [0.0; V]));
}

/// The largest error in f32, of the full scale, of the matrix and of the product.
fn single<const N: usize, const V: usize>(
    arm: &Model<f64, N, V, V>,
    effects: &(impl Effect<f32, N, V> + Effect<f64, N, V>),
) -> [Worst; 2] {
    let (small, mut rng, mut worst) = (arm.to_f32(), Rng::new(9), <[Worst; 2]>::default());
    for _ in 0..200 {
        let (state, y) = (random_state(arm, &mut rng), rng.vector::<V>(3.0));
        let half = State {
            q: state.q.map(|x| x as f32),
            qd: state.qd.map(|x| x as f32),
            qdd: state.qdd.map(|x| x as f32),
        };
        let c = coriolis_matrix(&small, &half, effects);
        for (got, want) in c.iter().zip(coriolis_matrix(arm, &state, effects)) {
            worst[0].see(got.map(f64::from), want);
        }
        let got = rnea_two_velocities(&small, &half, &y.map(|x| x as f32), effects);
        let want = rnea_two_velocities(arm, &state, &y, effects);
        worst[1].see(got.map(f64::from), want);
    }
    worst
}

#[test]
fn in_f32_c_has_the_accuracy_of_rnea() {
    let mut verdict = Verdict::default();
    for (arm, [matrix, product]) in [
        ("ur5e", single(&Ur5e::MODEL, &(Coriolis,))),
        ("panda", single(&Panda::MODEL, &(Coriolis,))),
    ] {
        verdict.see(arm, "C", "f32", &matrix);
        verdict.see(arm, "C y", "f32", &product);
    }
    verdict.speak();
}
