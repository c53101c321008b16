//! Random bodies, trees and states, from fixed seeds.

use dynamics_core::model::{BASE, Body, Joint, Model, RobotModel};
use dynamics_core::state::State;
use dynamics_core::state::manifold::normalise;
use glam::{DMat3, DVec3};
use proptest::prelude::RngExt;
use proptest::test_runner::{RngAlgorithm, TestRng};

/// A stream of random numbers, always the same.
pub fn random_numbers() -> TestRng {
    TestRng::deterministic_rng(RngAlgorithm::ChaCha)
}

/// N numbers within ±`bound`.
pub fn within<const N: usize>(rng: &mut TestRng, bound: f64) -> [f64; N] {
    core::array::from_fn(|_| rng.random_range(-bound..bound))
}

/// Mass, centre of mass and inertia about it of six points, each of a mass and at a place: nothing
/// that could not be a body's.
pub fn six_points(mut point: impl FnMut() -> (f64, [f64; 3])) -> (f64, [f64; 3], [f64; 6]) {
    let (mut mass, mut moment, mut second) = (0.0, DVec3::ZERO, DMat3::ZERO);
    for _ in 0..6 {
        let (m, r) = point();
        let r = DVec3::from(r);
        mass += m;
        moment += m * r;
        second += DMat3::from_cols(r * r.x, r * r.y, r * r.z) * m;
    }
    let com = moment / mass;
    second -= DMat3::from_cols(com * com.x, com * com.y, com * com.z) * mass;
    let trace = second.x_axis.x + second.y_axis.y + second.z_axis.z;
    let about_com = DMat3::from_diagonal(DVec3::splat(trace)) - second;
    let [x, y, z] = about_com.to_cols_array_2d();
    (mass, com.to_array(), [x[0], x[1], x[2], y[1], y[2], z[2]])
}

/// `body` at a random place, with the inertia of six points.
pub fn random_body(rng: &mut TestRng, body: Body) -> Body {
    let (mass, com, inertia) = six_points(|| (rng.random_range(0.1..0.5), within(rng, 0.3)));
    body.xyz(within(rng, 0.5)).rpy(within(rng, 3.0)).mass(mass).com(com).inertia(inertia)
}

/// Bodies, position and velocity coordinates of [`mixed_tree`].
pub const MIXED: (usize, usize, usize) = (20, 44, 40);
/// The robot of [`mixed_tree`].
pub type MixedTree = Model<f64, { MIXED.0 }, { MIXED.1 }, { MIXED.2 }>;

/// A tree with every kind of joint twice, in random order, on random axes and placements.
pub fn mixed_tree(rng: &mut TestRng) -> MixedTree {
    const NAMES: [&str; MIXED.0] = [
        "a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m", "n", "o", "p", "q", "r",
        "s", "t",
    ];
    let mut order: [usize; MIXED.0] = core::array::from_fn(|i| i);
    for i in (1..MIXED.0).rev() {
        order.swap(i, rng.random_range(0..=i));
    }
    let bodies = core::array::from_fn(|i| {
        let parent = match rng.random_range(0..=i) {
            0 => BASE,
            // Every other body prolongs a chain.
            j => (if i % 2 == 0 { i } else { j }) - 1,
        };
        let joint = random_joint(rng, order[i] % 10);
        random_body(rng, Body::new(NAMES[i], parent, joint))
    });
    Model::new("tree", bodies)
}

/// The twenty trees of `recordings/trees.json.gz`, each with its state.
pub fn recorded_trees() -> impl Iterator<Item = (MixedTree, State<f64, { MIXED.1 }, { MIXED.2 }>)> {
    let mut rng = random_numbers();
    (0..20).map(move |_| {
        let tree = mixed_tree(&mut rng);
        (tree, state_of(&tree, &mut rng))
    })
}

/// The joint of one of the ten kinds.
fn random_joint(rng: &mut TestRng, kind: usize) -> Joint<f64> {
    let axis: [f64; 3] = within(rng, 1.0);
    match kind {
        0 => Joint::revolute(axis),
        1 => Joint::continuous(axis),
        2 => Joint::prismatic(axis),
        3 => Joint::helical(axis, rng.random_range(-0.2..0.2)),
        4 => Joint::cylindrical(axis),
        5 => {
            let across = DVec3::from(axis).cross(DVec3::from(within(rng, 1.0)));
            Joint::universal(axis, across.to_array())
        }
        6 => Joint::spherical(),
        7 => Joint::planar(),
        8 => Joint::free(),
        _ => Joint::fixed(),
    }
}

/// A random state of any robot: unit quaternions, other coordinates within ±π, velocities within 3,
/// accelerations within 10.
pub fn state_of<D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    rng: &mut TestRng,
) -> State<f64, Q, V>
where
    D: RobotModel<f64, B, Q, V>,
{
    let mut q = within(rng, core::f64::consts::PI);
    normalise(robot, &mut q).expect("no random quaternion is zero");
    State { q, qd: within(rng, 3.0), qdd: within(rng, 10.0) }
}
