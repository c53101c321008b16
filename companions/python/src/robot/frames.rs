//! Frames that are fixed to bodies, such as a tool's: links of a file that move with another.
//!
//! Algorithms see one as a body of its own, without mass.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use robot_dynamics_kernels::place::Place;
use robot_dynamics_kernels::spec::{BodyRef, Spec};
use robot_import::number::{Attitude, tidy};
use robot_import::tree::Tree;
use serde::{Deserialize, Serialize};

use super::{Array, BodyInfo, Robot};
use crate::error::Exception;

/// A frame on a body; none is the base.
#[derive(Clone, Serialize, Deserialize)]
pub struct Frame {
    pub name: String,
    pub body: Option<usize>,
    pub xyz: [f64; 3],
    pub attitude: Attitude,
}

/// The links of a tree that are parts of bodies or of the base, with names.
pub fn frames<'a>(tree: &Tree, names: impl Iterator<Item = &'a str>) -> Vec<Frame> {
    let frame = |(name, link): (&str, &Option<(Option<usize>, _)>)| {
        let (body, pose): &(Option<usize>, robot_import::description::Pose) = link.as_ref()?;
        let (xyz, attitude) = (pose.position.to_array().map(tidy), Attitude::of(&pose.rotation));
        let is_body = body.is_some_and(|body| tree.bodies[body].name == name);
        (!is_body).then(|| Frame { name: name.to_owned(), body: *body, xyz, attitude })
    };
    names.zip(&tree.links).filter_map(frame).collect()
}

/// The robots with a frame as their last body, by the frames' names.
#[derive(Default)]
pub struct Framed(Mutex<BTreeMap<String, Py<Robot>>>);

impl Robot {
    /// The number of a body, or that of a frame and the robot that has it.
    pub fn at(&self, given: &Bound<'_, PyAny>) -> PyResult<(Option<Py<Robot>>, usize)> {
        let (py, name) = (given.py(), given.extract::<String>().ok());
        let own = |name: &String| self.body_number(&BodyRef::Name(name.clone())).is_some();
        let frame = name
            .filter(|name| !own(name))
            .and_then(|name| self.frames.iter().find(|frame| frame.name == name));
        let Some(frame) = frame else {
            return Ok((None, self.body(given)?));
        };
        let mut all = self.framed.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(robot) = all.get(&frame.name) {
            return Ok((Some(robot.clone_ref(py)), self.counts.bodies));
        }
        let described = self.described.with_frame(frame.body, frame.xyz, frame.attitude);
        let bodies = self.bodies.iter().cloned().chain([BodyInfo::of(&frame.name, "")]).collect();
        let mut robot = Self::of(py, self.name.clone(), None, described, bodies)?;
        robot.frames.clone_from(&self.frames);
        let robot = Py::new(py, robot)?;
        all.insert(frame.name.clone(), robot.clone_ref(py));
        Ok((Some(robot), self.counts.bodies))
    }

    /// Effects at frames, as they act at the bodies of these; none if all act at bodies.
    pub fn at_bodies(&self, effects: &[Spec]) -> Option<Vec<Spec>> {
        let is_body = |name: &str| self.bodies.iter().any(|body| body.name == name);
        let place = |name: &str| {
            let frame = self.frames.iter().find(|frame| frame.name == name && !is_body(name))?;
            Some(Place::new(frame.body?, frame.xyz, frame.attitude))
        };
        let mut names = effects.iter().flat_map(Spec::names);
        let any = !self.frames.is_empty() && names.any(|name| place(name).is_some());
        any.then(|| effects.iter().map(|effect| effect.at_bodies(place)).collect())
    }

    /// The error of a body that there is not.
    pub fn unknown_body(&self, given: &Bound<'_, PyAny>) -> PyErr {
        let error = Exception::new(given.py(), "UnknownBody", self.no_body(given));
        error.with("body", given).build()
    }

    /// The words of that error, with the names that there are.
    pub fn no_body(&self, given: &impl std::fmt::Display) -> String {
        let bodies: Vec<&str> = self.bodies.iter().map(|body| &*body.name).collect();
        let frames: Vec<&str> = self.frames.iter().map(|frame| &*frame.name).collect();
        let more = if frames.is_empty() { "" } else { "; its frames are " };
        let (bodies, frames) = (bodies.join(", "), frames.join(", "));
        format!("the robot has no body {given}: its bodies are {bodies}{more}{frames}")
    }
}

/// The results of one body, from results (…, bodies, …), each with so many axes of a body.
pub fn only<'py>(all: &Array<'py>, body: usize, axes: [i32; 2]) -> PyResult<Array<'py>> {
    let py = all.py();
    let mut of_body = Vec::new();
    for (result, axes) in all.cast::<PyTuple>()?.iter().zip(axes) {
        let keywords = PyDict::new(py);
        keywords.set_item("axis", -1 - axes)?;
        of_body.push(result.call_method("take", (body,), Some(&keywords))?);
    }
    Ok(PyTuple::new(py, of_body)?.into_any())
}
