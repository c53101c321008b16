//! Frames and scenes of algorithms, and what they refuse.

use dynamics_core::algorithms::frame::AnyFrame;
use pyo3::prelude::*;
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

/// Refuses a scene that lacks something, or that has what an algorithm has no place for.
fn checked(
    py: Python<'_>,
    effects: &[Spec],
    needed: &[Spec],
    foreign: impl Fn(&Spec) -> bool,
    why: &str,
) -> PyResult<()> {
    let lacking = needed.iter().find(|spec| !effects.contains(spec));
    let (effect, text) = match (lacking, effects.iter().find(|spec| foreign(spec))) {
        (_, Some(effect)) => (effect.name(), why.to_owned()),
        (Some(effect), None) => (effect.name(), format!("it needs {} in the scene", effect.name())),
        (None, None) => return Ok(()),
    };
    Err(refused(py, effect, format!("{effect}: {text}")))
}

const MOVING: [Spec; 2] = [Spec::Inertia, Spec::Coriolis];

/// Refuses a scene without `Inertia`, which forward dynamics needs.
pub fn with_inertia(py: Python<'_>, effects: &[Spec]) -> PyResult<()> {
    checked(py, effects, &MOVING[..1], |_| false, "")
}

/// Refuses a scene without `Inertia` or `Coriolis`, which few algorithms are compiled for.
pub fn moving(py: Python<'_>, effects: &[Spec]) -> PyResult<()> {
    checked(py, effects, &MOVING, |_| false, "")
}

/// Refuses rotors that spin, which some algorithms of the library do not have.
pub fn without_rotors(py: Python<'_>, effects: &[Spec]) -> PyResult<()> {
    let spins = |effect: &Spec| matches!(effect, Spec::GyroscopicRotors { .. });
    checked(py, effects, &[], spins, "this algorithm has no rotors that spin: name Armature")
}

/// Refuses scenes that machines with loops, linkages or links that bend do not have.
pub fn whole(py: Python<'_>, effects: &[Spec]) -> PyResult<()> {
    let foreign =
        |effect: &Spec| matches!(effect, Spec::LoadFriction { .. } | Spec::GyroscopicRotors { .. });
    checked(py, effects, &MOVING, foreign, "such a machine has no place for it")
}

/// Refuses scenes of which the library does not know derivatives.
pub fn differentiable(py: Python<'_>, effects: &[Spec]) -> PyResult<()> {
    let foreign = |spec: &Spec| !spec.is_differentiable();
    checked(py, effects, &MOVING, foreign, "its derivatives are not known")
}

/// Refuses scenes that elastic joints do not have.
pub fn elastic(py: Python<'_>, effects: &[Spec]) -> PyResult<()> {
    let foreign = |spec: &Spec| spec.is_extra() && !matches!(spec, Spec::Payload { .. });
    checked(py, effects, &MOVING, foreign, "elastic joints have no place for it")
}
