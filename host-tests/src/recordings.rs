//! What Pinocchio said: `host-tests/oracle/record.py` wrote it.

use std::path::PathBuf;

use serde::Deserialize;

/// The recorded answers for one robot; every row of an array is a state.
#[derive(Debug, Deserialize)]
pub struct Recording {
    /// The robot's name.
    pub robot: String,
    /// The version of Pinocchio.
    pub pinocchio: String,
    /// The robot that was recorded.
    pub model: crate::export::Robot,
    /// Largest absolute component of each quantity over the states.
    pub full_scale: FullScale,
    /// Positions, exactly representable in f32 like all inputs.
    pub q: Vec<Vec<f64>>,
    /// Velocities.
    pub qd: Vec<Vec<f64>>,
    /// Accelerations.
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
    /// Upper triangles of M by rows, of the first states.
    pub mass_matrix: Vec<Vec<f64>>,
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
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("recordings/{name}.json"));
    let text = std::fs::read_to_string(&path)
        .unwrap_or_else(|e| panic!("recording of `{name}` in host-tests/recordings: {e}"));
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("recording of `{name}`: {e}"))
}

/// A recorded row as an array of the robot's size.
///
/// # Panics
/// If the sizes differ.
pub fn row<const N: usize>(rows: &[Vec<f64>], state: usize) -> [f64; N] {
    rows[state]
        .as_slice()
        .try_into()
        .expect("the recording is of another robot")
}
