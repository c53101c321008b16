//! The records of Pinocchio for robots with clusters (`host-tests/oracle/clusters.py`), and how far
//! core and engine are from it and from each other.

use dynamics_core::clusters::{Clustered, ClusteredRobot};
use dynamics_core::effects::{Armature, Gravity, RIGID_BODY, Viscous};
use dynamics_core::scalar::Real;
use dynamics_core::state::{RobotState, State};
use dynamics_core::{Core, Engine};
use host_tests::export::{Robot, robot};
use host_tests::recordings::{read, row};
use host_tests::tolerances::Errors;
use serde::Deserialize;

/// A loop: two points that coincide, each with its body and its place in the body's frame.
#[derive(Deserialize)]
pub struct PointLoop {
    pub bodies: [i64; 2],
    /// The points, m.
    pub points: [[f64; 3]; 2],
}

/// A recording; every row is a state.
#[derive(Deserialize)]
pub struct Recording {
    /// The spanning tree that was recorded.
    pub model: Robot,
    /// The loops that are pairs of points.
    #[serde(default)]
    pub loops: Vec<PointLoop>,
    /// The tree's coordinates that are the independent ones, where loops are pairs of points.
    #[serde(default)]
    pub independent: Vec<usize>,
    /// Independent positions, exactly representable in f32, like velocities, accelerations and
    /// torques.
    pub q: Vec<Vec<f64>>,
    /// Independent velocities.
    pub qd: Vec<Vec<f64>>,
    /// Independent accelerations.
    pub qdd: Vec<Vec<f64>>,
    /// Torques that are given to forward dynamics.
    pub tau: Vec<Vec<f64>>,
    pub tree_q: Vec<Vec<f64>>,
    pub tree_qd: Vec<Vec<f64>>,
    pub tree_qdd: Vec<Vec<f64>>,
    pub rnea: Vec<Vec<f64>>,
    pub gravity: Vec<Vec<f64>>,
    pub forward: Vec<Vec<f64>>,
    /// M of the independent coordinates, its upper triangle by rows.
    pub mass_matrix: Vec<Vec<f64>>,
}

/// The recording of a robot.
///
/// # Panics
/// If there is none.
pub fn recording(robot: &str) -> Recording {
    let recording: Recording = read(&format!("clusters/{robot}"));
    assert_eq!(recording.q.len(), 200);
    recording
}

/// Errors of core and engine over the recorded states, in f64 and f32.
///
/// # Panics
/// If another robot was recorded, or a state of it does not close.
pub fn errors<T, const B: usize, const N: usize, const Y: usize>() -> Errors
where
    T: ClusteredRobot<B, N, N, Y, Y>,
{
    let recorded = recording(T::MODEL.name);
    assert_eq!(recorded.model, robot(&T::MODEL), "another robot was recorded");
    let mut errors = Errors::new(T::MODEL.name);
    for k in 0..recorded.q.len() {
        tree::<T, B, N, Y>(&recorded, k, &mut errors);
        torques::<T, f64, B, N, Y>(&recorded, k, "f64", &mut errors);
        torques::<T, f32, B, N, Y>(&recorded, k, "f32", &mut errors);
    }
    errors
}

pub fn state<R: Real, const Y: usize>(recorded: &Recording, k: usize) -> State<R, Y, Y> {
    let of = |rows| row::<Y>(rows, k).map(R::from_f64);
    State { q: of(&recorded.q), qd: of(&recorded.qd), qdd: of(&recorded.qdd) }
}

/// The tree's motion, and M.
fn tree<T, const B: usize, const N: usize, const Y: usize>(
    recorded: &Recording,
    k: usize,
    errors: &mut Errors,
) where
    T: ClusteredRobot<B, N, N, Y, Y>,
{
    let motion = Clustered::<Core<T>>::motion(&state::<f64, Y>(recorded, k)).expect("it closes");
    let tree = motion.state();
    let tree = tree.state();
    errors.add("position", "f64", &tree.q, &recorded.tree_q[k]);
    errors.add("rate", "f64", &tree.qd, &recorded.tree_qd[k]);
    errors.add("acceleration", "f64", &tree.qdd, &recorded.tree_qdd[k]);
    let m = motion.inertia(&Core::<T>::crba(motion.configuration(), &RIGID_BODY));
    let upper = (0..Y).flat_map(|i| (i..Y).map(move |j| (i, j)));
    let upper: Vec<f64> = upper.map(|(i, j)| m.get(i, j)).collect();
    errors.add("M", "f64", &upper, &recorded.mass_matrix[k]);
}

fn torques<T, R: Real, const B: usize, const N: usize, const Y: usize>(
    recorded: &Recording,
    k: usize,
    scalar: &'static str,
    errors: &mut Errors,
) where
    T: ClusteredRobot<B, N, N, Y, Y>,
{
    let y = state::<R, Y>(recorded, k);
    let mut compare = |quantity, got: [R; Y], want: &[f64]| {
        errors.add(quantity, scalar, &got.map(Real::to_f64), want);
    };
    let core = Clustered::<Core<T>>::rnea(&y, &RIGID_BODY).expect("it closes");
    let engine = Clustered::<Engine<T>>::rnea(&y, &RIGID_BODY).expect("it closes");
    compare("rnea", core, &recorded.rnea[k]);
    compare("engine rnea", engine, &recorded.rnea[k]);
    compare("engine and core", engine, &core.map(Real::to_f64));
    let again = Clustered::<Core<T>>::aba(&y, &core, &RIGID_BODY).expect("it moves");
    compare("aba of rnea", again, &recorded.qdd[k]);

    let core = Clustered::<Core<T>>::rnea(&y, &Gravity::EARTH).expect("it closes");
    let engine = Clustered::<Engine<T>>::rnea(&y, &Gravity::EARTH).expect("it closes");
    compare("gravity", core, &recorded.gravity[k]);
    compare("engine gravity", engine, &recorded.gravity[k]);
    compare("engine and core, gravity", engine, &core.map(Real::to_f64));

    let scene = (RIGID_BODY, Viscous([R::from_f64(0.3); N]), Armature([R::from_f64(0.02); N]));
    let core = Clustered::<Core<T>>::rnea(&y, &scene).expect("it closes");
    let engine = Clustered::<Engine<T>>::rnea(&y, &scene).expect("it closes");
    compare("engine and core, friction and rotors", engine, &core.map(Real::to_f64));

    let tau = row::<Y>(&recorded.tau, k).map(R::from_f64);
    let forward = Clustered::<Core<T>>::aba(&y, &tau, &RIGID_BODY).expect("it moves");
    compare("aba", forward, &recorded.forward[k]);
}
