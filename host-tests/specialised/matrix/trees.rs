//! Random trees that mix every kind of joint, their states, and condition numbers.

use dynamics_core::MassMatrix;
use dynamics_core::model::{BASE, Body, Joint, JointKind, Model};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use glam::DVec3;
use host_tests::random::random_body;
pub use host_tests::random::{random_numbers, state_of, within};
use proptest::prelude::RngExt;
use proptest::test_runner::TestRng;

use JointKind::*;

/// As many bodies as it has room for: every kind of joint as often, revolute ones for the rest, in
/// any order; any branches and several roots.
pub fn mixed<const B: usize, const Q: usize, const V: usize>(
    rng: &mut TestRng,
) -> Model<f64, B, Q, V> {
    let mut kinds = core::array::from_fn(|i| {
        if i < B - B % JointKind::ALL.len() {
            JointKind::ALL[i % JointKind::ALL.len()]
        } else {
            Revolute
        }
    });
    for i in (1..B).rev() {
        kinds.swap(i, rng.random_range(0..=i));
    }
    tree(rng, kinds)
}

pub fn tree<const B: usize, const Q: usize, const V: usize>(
    rng: &mut TestRng,
    kinds: [JointKind; B],
) -> Model<f64, B, Q, V> {
    let bodies = core::array::from_fn(|i| {
        let parent = match rng.random_range(0..=i) {
            0 => BASE,
            // Every other body prolongs a chain.
            _ if i % 2 == 0 => i - 1,
            j => j - 1,
        };
        let axis = within(rng, 1.0);
        let joint = match kinds[i] {
            Revolute => Joint::revolute(axis),
            Continuous => Joint::continuous(axis),
            Prismatic => Joint::prismatic(axis),
            Helical => Joint::helical(axis, rng.random_range(-0.1..0.1)),
            Cylindrical => Joint::cylindrical(axis),
            Universal => {
                let first = DVec3::from(within(rng, 1.0)).cross(DVec3::from(axis));
                Joint::universal(first.to_array(), axis)
            }
            Spherical => Joint::spherical(),
            Planar => Joint::planar(),
            Free => Joint::free(),
            _ => Joint::fixed(),
        };
        random_body(rng, Body::new("body", parent, joint))
    });
    Model::new("mixed", bodies)
}

pub fn cast<R: Real, const Q: usize, const V: usize>(state: &State<f64, Q, V>) -> State<R, Q, V> {
    State {
        q: state.q.map(R::from_f64),
        qd: state.qd.map(R::from_f64),
        qdd: state.qdd.map(R::from_f64),
    }
}

/// κ(M) in the 2-norm, its eigenvalues by cyclic Jacobi rotations.
pub fn condition<R: Real, const V: usize>(m: &MassMatrix<R, V>) -> f64 {
    let mut a: Vec<Vec<f64>> =
        (0..V).map(|i| (0..V).map(|j| m.get(i, j).to_f64()).collect()).collect();
    for _ in 0..10 {
        for p in 0..V {
            for q in p + 1..V {
                if a[p][q] == 0.0 {
                    continue;
                }
                let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
                let c = 1.0 / (t * t + 1.0).sqrt();
                let s = t * c;
                for row in &mut a {
                    (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                }
                let (upper, lower) = a.split_at_mut(q);
                for (x, y) in upper[p].iter_mut().zip(&mut lower[0]) {
                    (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
                }
            }
        }
    }
    let eigenvalues = (0..V).map(|i| a[i][i]);
    let largest = eigenvalues.clone().fold(0.0, f64::max);
    largest / eigenvalues.fold(f64::INFINITY, f64::min)
}
