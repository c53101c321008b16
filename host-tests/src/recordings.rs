//! Results of other codes, written by the scripts in `host-tests/oracle`.

use std::fs::File;
use std::path::PathBuf;

use flate2::read::GzDecoder;
use serde::Deserialize;

/// The recorded answers for one robot; every row of an array is a state.
///
/// Coordinates, their order and all spatial vectors are the library's: angular before linear, a
/// joint's velocity in its body's frame. A matrix of six rows is listed by columns, a symmetric one
/// as its upper triangle by rows. "The tip" is the last body. From `wrenches` on there are rows
/// only for the first states: [`Recording::first_states`].
#[derive(Debug, Deserialize)]
pub struct Recording {
    pub robot: String,
    pub pinocchio: String,
    pub model: crate::export::Robot,
    /// Largest absolute component of each quantity over the states.
    pub full_scale: FullScale,
    /// The largest condition number κ(M) over the states.
    pub condition: f64,
    /// Rotor inertia at every velocity coordinate; 0 at joints of several degrees of freedom,
    /// kg·m².
    pub armature: Vec<f64>,
    /// Positions, exactly representable in f32 like all inputs, but for unit quaternions.
    pub q: Vec<Vec<f64>>,
    pub qd: Vec<Vec<f64>>,
    pub qdd: Vec<Vec<f64>>,
    /// Torques given to forward dynamics.
    pub tau: Vec<Vec<f64>>,
    /// ID(q, q̇, q̈).
    pub rnea: Vec<Vec<f64>>,
    /// ID(q, 0, 0).
    pub gravity: Vec<Vec<f64>>,
    /// ID(q, q̇, 0).
    pub bias: Vec<Vec<f64>>,
    /// FD(q, q̇, τ).
    pub aba: Vec<Vec<f64>>,
    /// M of the first states.
    pub mass_matrix: Vec<Vec<f64>>,

    /// Input: the wrench of the environment on every body, about its origin in its own frame, by
    /// bodies.
    pub wrenches: Vec<Vec<f64>>,
    /// Input: spatial velocity of the base in its own frame, which is the world's at that moment.
    pub base_velocity: Vec<Vec<f64>>,
    /// Input: spatial acceleration of the base in its own frame, gravity not included.
    pub base_acceleration: Vec<Vec<f64>>,
    /// Input: a motion of one second, in velocity coordinates.
    pub step: Vec<Vec<f64>>,

    /// Attitude (rotation from the tip's frame to the base's, by rows) and position of the tip.
    pub tip_pose: Vec<Vec<f64>>,
    /// Spatial velocity of the tip in its own frame.
    pub tip_velocity: Vec<Vec<f64>>,
    /// Spatial acceleration of the tip in its own frame, gravity not included.
    pub tip_acceleration: Vec<Vec<f64>>,
    /// Geometric Jacobian of the tip in its own frame.
    pub jacobian_local: Vec<Vec<f64>>,
    /// The same about the base's origin in base axes.
    pub jacobian_world: Vec<Vec<f64>>,
    /// The same about the tip's origin in base axes.
    pub jacobian_mixed: Vec<Vec<f64>>,
    /// J̇ q̇ in the tip's frame: its spatial acceleration with q̈ = 0.
    pub drift_local: Vec<Vec<f64>>,
    /// J̇ q̇ about the base's origin in base axes.
    pub drift_world: Vec<Vec<f64>>,
    /// J̇ q̇ about the tip's origin in base axes: ω̇, and the acceleration of the tip's origin.
    pub drift_mixed: Vec<Vec<f64>>,

    /// ½ q̇ᵀ M q̇, J.
    pub kinetic_energy: Vec<Vec<f64>>,
    /// −Σ m g·c, zero at the base's origin, J; all bodies count, also those welded to the base.
    pub potential_energy: Vec<Vec<f64>>,
    /// Centre of mass of all bodies in the base's frame, m.
    pub centre_of_mass: Vec<Vec<f64>>,
    /// Spatial momentum of all bodies about the base's origin in base axes.
    pub momentum: Vec<Vec<f64>>,
    /// The same about the centre of mass.
    pub centroidal_momentum: Vec<Vec<f64>>,
    /// The matrix that takes q̇ to it.
    pub centroidal_matrix: Vec<Vec<f64>>,
    /// M q̇, the generalised momentum.
    pub generalised_momentum: Vec<Vec<f64>>,
    /// Cᵀ q̇ = Ṁ q̇ − C q̇.
    pub coriolis_transposed: Vec<Vec<f64>>,
    /// ∂ID/∂q along the right increments of q, by rows; of fewer states.
    pub rnea_by_q: Vec<Vec<f64>>,
    /// ∂ID/∂q̇, by rows; of fewer states.
    pub rnea_by_qd: Vec<Vec<f64>>,
    /// Y with ID(q, q̇, q̈) = Y φ, by coordinates, bodies and ten parameters each; of fewer states.
    pub regressor: Vec<Vec<f64>>,

    /// M⁻¹.
    pub inverse_mass_matrix: Vec<Vec<f64>>,
    /// Λ⁻¹ = J M⁻¹ Jᵀ of the tip in its own frame.
    pub operational_inverse: Vec<Vec<f64>>,

    /// ID(q, q̇, q̈) with `wrenches` on the bodies.
    pub rnea_wrenches: Vec<Vec<f64>>,
    /// The wrench in each joint that moves, under them, in its body's own frame.
    pub reactions: Vec<Vec<f64>>,
    /// FD(q, q̇, τ) with `wrenches` on the bodies.
    pub aba_wrenches: Vec<Vec<f64>>,
    /// ID(q, q̇, q̈) on a base that moves with `base_velocity` and `base_acceleration`.
    pub rnea_moving_base: Vec<Vec<f64>>,
    /// The wrench about its origin in its own frame that such a base has to supply.
    pub base_wrench: Vec<Vec<f64>>,
    /// ID(q, q̇, q̈) with `armature`.
    pub rnea_armature: Vec<Vec<f64>>,
    /// FD(q, q̇, τ) with `armature`.
    pub aba_armature: Vec<Vec<f64>>,

    /// q moved by `step`.
    pub integrated: Vec<Vec<f64>>,
    /// The step from q to the q of the next state.
    pub difference: Vec<Vec<f64>>,
}

impl Recording {
    /// The number of states of which everything is recorded.
    pub fn first_states(&self) -> usize {
        self.tip_pose.len()
    }

    /// ∂FD/∂q and ∂FD/∂q̇ at a state of which ∂ID is recorded, and the torque that gives its q̈:
    /// −M⁻¹ ∂ID.
    pub fn forward_derivatives<const V: usize>(&self, state: usize) -> [[[f64; V]; V]; 2] {
        let inverse = symmetric::<V>(&self.inverse_mass_matrix, state);
        [&self.rnea_by_q, &self.rnea_by_qd].map(|rows| {
            let rows = rows[state].as_chunks::<V>().0;
            let entry = |i: usize, j: usize| -> f64 {
                inverse[i].iter().zip(rows).map(|(x, row)| -x * row[j]).sum()
            };
            std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
        })
    }
}

/// Full scale of each recorded quantity (DESIGN, "Tests").
#[derive(Clone, Copy, Debug, Deserialize)]
pub struct FullScale {
    /// N·m
    pub rnea: f64,
    /// N·m
    pub gravity: f64,
    /// N·m
    pub bias: f64,
    /// rad/s²
    pub aba: f64,
    /// kg·m²
    pub mass_matrix: f64,
}

/// The recording of the robot `name`.
///
/// # Panics
/// If there is none, or it cannot be read: a test without its oracle has failed.
pub fn load(name: &str) -> Recording {
    read(name)
}

/// Torques of some recorded states in 50 digits, rounded to f64: what
/// `host-tests/oracle/precise.py` wrote.
#[derive(Debug, Deserialize)]
pub struct Precise {
    /// The indices of the states in the robots' recordings.
    pub states: Vec<usize>,
    ur5e: Vec<Vec<f64>>,
    panda: Vec<Vec<f64>>,
    a1: Vec<Vec<f64>>,
}

impl Precise {
    /// ID(q, q̇, q̈) of the robot recorded as `name`.
    ///
    /// # Panics
    /// If there is none.
    pub fn rnea(&self, name: &str) -> &[Vec<f64>] {
        match name {
            "ur5e" => &self.ur5e,
            "panda" => &self.panda,
            "a1" => &self.a1,
            _ => panic!("no torques of `{name}` in 50 digits"),
        }
    }
}

/// Derivatives of one of the [`random::recorded_trees`](crate::random::recorded_trees) by
/// Pinocchio.
#[derive(Debug, Deserialize)]
pub struct TreeDerivatives {
    /// The state's positions: the tree is still the one that was recorded.
    pub q: Vec<f64>,
    /// ∂ID/∂q and ∂ID/∂q̇ by rows.
    pub by: [Vec<f64>; 2],
}

/// Reads the recording of a script under this name.
///
/// # Panics
/// As [`load`].
pub fn read<T: serde::de::DeserializeOwned>(name: &str) -> T {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("recordings/{name}.json.gz"));
    let text = File::open(path)
        .and_then(|file| std::io::read_to_string(GzDecoder::new(file)))
        .unwrap_or_else(|e| panic!("recording of `{name}` in host-tests/recordings: {e}"));
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("recording of `{name}`: {e}"))
}

/// A recorded row as an array of the robot's size.
///
/// # Panics
/// If the sizes differ.
pub fn row<const N: usize>(rows: &[Vec<f64>], state: usize) -> [f64; N] {
    rows[state].as_slice().try_into().expect("the recording is of another robot")
}

/// A recorded matrix of six rows, or a list of wrenches: its columns.
///
/// # Panics
/// If the sizes differ.
pub fn columns<const N: usize>(rows: &[Vec<f64>], state: usize) -> [[f64; 6]; N] {
    let (columns, rest) = rows[state].as_chunks::<6>();
    assert!(rest.is_empty(), "not six rows");
    columns.try_into().expect("the recording is of another robot")
}

/// A recorded symmetric matrix.
///
/// # Panics
/// If the sizes differ.
pub fn symmetric<const N: usize>(rows: &[Vec<f64>], state: usize) -> [[f64; N]; N] {
    let entries = &rows[state];
    assert_eq!(entries.len(), N * (N + 1) / 2, "the recording is of another robot");
    // Row i of the triangle begins after N + (N − 1) + … entries.
    let entry = |i: usize, j: usize| entries[i * (2 * N + 1 - i) / 2 + j - i];
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i.min(j), i.max(j))))
}

/// Full scale of a quantity: its largest absolute component over the recorded states.
pub fn full_scale(rows: &[Vec<f64>]) -> f64 {
    rows.iter().flatten().fold(0.0, |most, x| most.max(x.abs()))
}
