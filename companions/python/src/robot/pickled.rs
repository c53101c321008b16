//! Robots that are pickled and copied. A robot of the library is its name; one of a file is the
//! numbers that were read, so that it is the same where the file is not.

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
        let (maker, given) = match &self.read {
            Some(read) => {
                let numbers = serde_json::to_string(read);
                let text = numbers.map_err(|error| of_pickle(py, &error.to_string()))?;
                (native.getattr("_robot")?, text)
            }
            None => (native.getattr("Robot")?, self.label().to_owned()),
        };
        (maker, (given,)).into_pyobject(py)
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
