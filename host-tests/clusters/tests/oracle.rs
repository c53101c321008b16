//! What Pinocchio says of robots with loops (`host-tests/oracle/clusters.py`), by core and engine, in f64 and f32.

use std::path::PathBuf;

use cluster_tests::{FiveBarLeg, apart, hold, largest};
use dynamics_core::clusters::{Clustered, ClusteredRobot};
use dynamics_core::effects::{Gravity, RIGID_BODY};
use dynamics_core::state::{RobotState, State};
use dynamics_core::{Core, Engine};
use firmware_demo::robots::{AnkleLeg, FourBarLeg};
use serde::Deserialize;

/// A recording; every row is a state.
#[derive(Deserialize)]
struct Recording {
    q: Vec<Vec<f64>>,
    qd: Vec<Vec<f64>>,
    qdd: Vec<Vec<f64>>,
    tau: Vec<Vec<f64>>,
    tree_q: Vec<Vec<f64>>,
    tree_qd: Vec<Vec<f64>>,
    tree_qdd: Vec<Vec<f64>>,
    rnea: Vec<Vec<f64>>,
    gravity: Vec<Vec<f64>>,
    forward: Vec<Vec<f64>>,
    mass_matrix: Vec<Vec<f64>>,
}

fn row<const N: usize>(rows: &[Vec<f64>], state: usize) -> [f64; N] {
    rows[state]
        .as_slice()
        .try_into()
        .expect("a row of this robot")
}

/// Errors of each quantity over the states, and its full scale.
#[derive(Default)]
struct Errors(Vec<(&'static str, f64, f64)>);

impl Errors {
    fn add(&mut self, quantity: &'static str, got: &[f64], want: &[f64]) {
        let at = self
            .0
            .iter()
            .position(|entry| entry.0 == quantity)
            .unwrap_or_else(|| {
                self.0.push((quantity, 0.0, 0.0));
                self.0.len() - 1
            });
        let (_, error, scale) = &mut self.0[at];
        let apart = apart(got, want);
        assert!(apart.is_finite(), "{quantity}: {got:?}");
        (*error, *scale) = (error.max(apart), scale.max(largest(want)));
    }

    /// Relative to full scale.
    fn of(&self, quantity: &str) -> f64 {
        let found = self.0.iter().find(|entry| entry.0 == quantity);
        found
            .map(|(_, error, scale)| error / scale)
            .expect("a quantity that was compared")
    }
}

fn errors<T, const B: usize, const N: usize, const Y: usize>() -> Errors
where
    T: ClusteredRobot<B, N, N, Y, Y>,
{
    let name = T::MODEL.name;
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join(format!("../recordings/clusters/{name}.json"));
    let text = std::fs::read_to_string(path).expect("a recording");
    let recorded: Recording = serde_json::from_str(&text).expect("a recording");
    assert_eq!(recorded.q.len(), 200);
    let mut errors = Errors::default();
    for i in 0..recorded.q.len() {
        let (q, qd, qdd) = (
            row(&recorded.q, i),
            row(&recorded.qd, i),
            row(&recorded.qdd, i),
        );
        let y: State<f64, Y, Y> = State { q, qd, qdd };
        let tau: [f64; Y] = row(&recorded.tau, i);
        let (rnea, gravity, forward) = (
            &recorded.rnea[i],
            &recorded.gravity[i],
            &recorded.forward[i],
        );

        let motion = Clustered::<Core<T>>::motion(&y).expect("it closes");
        let tree = motion.state();
        let tree = tree.state();
        errors.add("position", &tree.q, &recorded.tree_q[i]);
        errors.add("rate", &tree.qd, &recorded.tree_qd[i]);
        errors.add("acceleration", &tree.qdd, &recorded.tree_qdd[i]);
        let m = motion.inertia(&Core::<T>::crba(motion.configuration(), &RIGID_BODY));
        let upper: Vec<f64> = (0..Y)
            .flat_map(|i| (i..Y).map(move |j| (i, j)))
            .map(|(i, j)| m.get(i, j))
            .collect();
        errors.add("M", &upper, &recorded.mass_matrix[i]);
        let core = Clustered::<Core<T>>::rnea(&y, &RIGID_BODY).expect("it closes");
        errors.add("rnea", &core, rnea);
        let core = Clustered::<Core<T>>::rnea(&y, &Gravity::EARTH).expect("it closes");
        errors.add("gravity", &core, gravity);
        let core = Clustered::<Core<T>>::aba(&y, &tau, &RIGID_BODY).expect("it moves");
        errors.add("aba", &core, forward);
        let engine = Clustered::<Engine<T>>::rnea(&y, &RIGID_BODY).expect("it closes");
        errors.add("engine rnea", &engine, rnea);
        let engine = Clustered::<Engine<T>>::rnea(&y, &Gravity::EARTH).expect("it closes");
        errors.add("engine gravity", &engine, gravity);

        let y = State {
            q: q.map(|x| x as f32),
            qd: qd.map(|x| x as f32),
            qdd: qdd.map(|x| x as f32),
        };
        let single = Clustered::<Core<T>>::rnea(&y, &RIGID_BODY).expect("it closes");
        errors.add("rnea in f32", &single.map(f64::from), rnea);
        let single = Clustered::<Engine<T>>::rnea(&y, &RIGID_BODY).expect("it closes");
        errors.add("engine rnea in f32", &single.map(f64::from), rnea);
        let tau = tau.map(|x| x as f32);
        let single = Clustered::<Core<T>>::aba(&y, &tau, &RIGID_BODY).expect("it moves");
        errors.add("aba in f32", &single.map(f64::from), forward);
    }
    errors
}

/// Holds the errors against bounds in the order of the quantities.
fn held<T, const B: usize, const N: usize, const Y: usize>(bounds: [(&str, f64); 12])
where
    T: ClusteredRobot<B, N, N, Y, Y>,
{
    let errors = errors::<T, B, N, Y>();
    for (quantity, _) in bounds {
        println!("{} {quantity}: {:.1e}", T::MODEL.name, errors.of(quantity));
    }
    for (quantity, bound) in bounds {
        hold(quantity, errors.of(quantity), bound);
    }
}

#[test]
fn pinocchio_agrees_on_the_four_bar_leg() {
    held::<FourBarLeg, 5, 5, 3>([
        ("position", 1e-14),
        ("rate", 3e-14),
        ("acceleration", 5e-14),
        ("M", 2e-14),
        ("rnea", 1e-14),
        ("gravity", 2e-14),
        ("aba", 3e-12),
        ("engine rnea", 1e-14),
        ("engine gravity", 1e-14),
        ("rnea in f32", 1e-5),
        ("engine rnea in f32", 1e-5),
        ("aba in f32", 1e-3),
    ]);
}

#[test]
fn pinocchio_agrees_on_the_five_bar_leg() {
    held::<FiveBarLeg, 5, 5, 3>([
        ("position", 3e-15),
        ("rate", 3e-15),
        ("acceleration", 5e-15),
        ("M", 1e-16),
        ("rnea", 1e-15),
        ("gravity", 1e-15),
        ("aba", 1e-13),
        ("engine rnea", 1e-15),
        ("engine gravity", 2e-15),
        ("rnea in f32", 5e-7),
        ("engine rnea in f32", 1e-6),
        ("aba in f32", 2e-5),
    ]);
}

#[test]
fn pinocchio_agrees_on_the_parallel_ankle() {
    held::<AnkleLeg, 9, 9, 3>([
        ("position", 1e-14),
        ("rate", 1e-14),
        ("acceleration", 3e-14),
        ("M", 2e-15),
        ("rnea", 1e-15),
        ("gravity", 1e-15),
        ("aba", 1e-13),
        ("engine rnea", 1e-15),
        ("engine gravity", 2e-15),
        ("rnea in f32", 5e-7),
        ("engine rnea in f32", 5e-7),
        ("aba in f32", 1e-5),
    ]);
}
