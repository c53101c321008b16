//! Frames and scenes of algorithms, and what they refuse.

use pyo3::prelude::*;
use robot_dynamics_kernels::AnyFrame;
use robot_dynamics_kernels::spec::Spec;

use crate::effects::refused;
use crate::error::Exception;

pub fn frame_of(py: Python<'_>, name: &str) -> PyResult<AnyFrame> {
    match name {
        "local" => Ok(AnyFrame::Local),
        "world" => Ok(AnyFrame::World),
        "local_world_aligned" => Ok(AnyFrame::LocalWorldAligned),
        _ => {
            let text = format!(
                "there is no frame `{name}`: \"local\", \"world\" or \"local_world_aligned\""
            );
            Err(Exception::new(py, "UnknownFrame", text).with("frame", name).build())
        }
    }
}

/// Refuses a scene without `Inertia`, which forward dynamics needs.
pub fn with_inertia(py: Python<'_>, effects: &[Spec]) -> PyResult<()> {
    if effects.contains(&Spec::Inertia) {
        return Ok(());
    }
    let text = "forward dynamics needs Inertia in the scene";
    Err(refused(py, "Inertia", text))
}

/// Refuses rotors that spin, which some algorithms of the library do not have.
pub fn without_rotors(py: Python<'_>, effects: &[Spec]) -> PyResult<()> {
    let spins = |effect: &Spec| matches!(effect, Spec::GyroscopicRotors { .. });
    if !effects.iter().any(spins) {
        return Ok(());
    }
    let text = "GyroscopicRotors: this algorithm has no rotors that spin: name Armature";
    Err(refused(py, "GyroscopicRotors", text))
}
