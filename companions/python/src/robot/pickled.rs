//! Robots that are pickled and copied. A robot of the library is its name; one of a file is the
//! numbers that were read, so that it is the same where the file is not.

use std::hash::{DefaultHasher, Hash, Hasher};

use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::{Read, Robot};
use crate::error::Exception;

#[pymethods]
impl Robot {
    fn __copy__(robot: Py<Self>) -> Py<Self> {
        robot
    }

    // A robot does not change.
    fn __deepcopy__(robot: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        robot
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let native = py.import("robot_dynamics._native")?;
        let maker = if self.read.is_some() { "_robot" } else { "Robot" };
        (native.getattr(maker)?, (self.numbers(py)?,)).into_pyobject(py)
    }

    fn __eq__(&self, py: Python<'_>, other: &Self) -> PyResult<bool> {
        Ok(self.read.is_some() == other.read.is_some() && self.numbers(py)? == other.numbers(py)?)
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        (self.label(), self.counts.q, self.counts.v).hash(&mut hasher);
        hasher.finish()
    }
}

impl Robot {
    /// The name in the library, or the numbers that were read: two robots are equal if these are.
    fn numbers(&self, py: Python<'_>) -> PyResult<String> {
        let Some(read) = &self.read else {
            return Ok(self.label().to_owned());
        };
        serde_json::to_string(read).map_err(|error| of_pickle(py, &error.to_string()))
    }
}

/// The robot of numbers that were pickled.
#[pyfunction(name = "_robot")]
pub fn robot(py: Python<'_>, numbers: &str) -> PyResult<Robot> {
    let read: Option<Read> = serde_json::from_str(numbers).ok();
    let parents_first = |read: &Read| {
        let mut bodies = read.tree.bodies.iter().enumerate();
        bodies.all(|(i, body)| body.parent.is_none_or(|parent| parent < i))
    };
    let read = read.filter(parents_first);
    Robot::of_file(py, read.ok_or_else(|| of_pickle(py, "these are numbers of no robot"))?)
}

fn of_pickle(py: Python<'_>, text: &str) -> PyErr {
    Exception::new(py, "ModelError", format!("pickle: {text}")).with("body", py.None()).build()
}
