//! Random states and trees, and the worst error over them.

use super::*;
pub(crate) use host_tests::random::{random_body, random_numbers, within};

pub(crate) const G: f64 = 9.81;

pub(crate) fn random_state<const N: usize>(rng: &mut TestRng) -> State<f64, N, N> {
    State { q: within(rng, std::f64::consts::PI), qd: within(rng, 3.0), qdd: within(rng, 10.0) }
}

pub(crate) fn cast<R: Real, const N: usize>(state: &State<f64, N, N>) -> State<R, N, N> {
    State {
        q: state.q.map(R::from_f64),
        qd: state.qd.map(R::from_f64),
        qdd: state.qdd.map(R::from_f64),
    }
}

/// A tree of nine bodies and seven joints, revolute and prismatic, on axes, placements and
/// inertias of any kind; welds, branches and several roots wherever they fall.
pub(crate) fn random_tree(rng: &mut TestRng) -> Model<f64, 9, 7, 7> {
    const NAMES: [&str; 9] = ["a", "b", "c", "d", "e", "f", "g", "h", "i"];
    let welds = [rng.random_range(0..4), rng.random_range(4..9)];
    let bodies = core::array::from_fn(|i| {
        let parent = match rng.random_range(0..=i) {
            0 => BASE,
            // Every other body prolongs a chain.
            j => {
                if i % 2 == 0 {
                    i - 1
                } else {
                    j - 1
                }
            }
        };
        let axis = within(rng, 1.0);
        let joint = match rng.random_range(0..3) {
            _ if welds.contains(&i) => Joint::fixed(),
            0 => Joint::prismatic(axis),
            _ => Joint::revolute(axis),
        };
        random_body(rng, Body::new(NAMES[i], parent, joint))
    });
    Model::new("tree", bodies)
}

/// The worst error of a law and the full scale of what it speaks of.
#[derive(Default)]
pub(crate) struct Worst {
    error: f64,
    full_scale: f64,
}

impl Worst {
    pub(crate) fn see(&mut self, got: f64, want: f64) {
        let error = (got - want).abs();
        assert!(error.is_finite());
        self.error = self.error.max(error);
        self.full_scale = self.full_scale.max(want.abs());
    }

    pub(crate) fn relative(&self) -> f64 {
        self.error / self.full_scale
    }

    pub(crate) fn check<R>(&self, robot: &str, law: &str) {
        tolerances::check(robot, law, std::any::type_name::<R>(), self.relative())
            .unwrap_or_else(|e| panic!("{e}"));
    }
}
