//! From errors of the library to exceptions of `robot_dynamics.errors`.

use dynamics_core::clusters::ClusterProblem;
use dynamics_core::flexible::FlexibleError;
use dynamics_core::loops::LoopError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use robot_import::error::{ImportError, Problem};

use robot_dynamics_kernels::job::{Failure, Problem as StateProblem};
use robot_dynamics_kernels::model::NoModel;

use crate::robot::Robot;

/// An exception of that class with fields.
pub struct Exception<'py> {
    class: &'static str,
    message: String,
    fields: Bound<'py, PyDict>,
}

impl<'py> Exception<'py> {
    /// Without fields.
    pub fn new(py: Python<'py>, class: &'static str, message: impl Into<String>) -> Self {
        Self {
            class,
            message: message.into(),
            fields: PyDict::new(py),
        }
    }

    /// With a field more.
    pub fn with(self, name: &str, value: impl IntoPyObject<'py>) -> Self {
        // The only failure is that of memory, which leaves the field unset.
        let _ = self.fields.set_item(name, value);
        self
    }

    /// The exception.
    pub fn build(self) -> PyErr {
        let py = self.fields.py();
        let built = py
            .import("robot_dynamics.errors")
            .and_then(|errors| errors.getattr(self.class))
            .and_then(|class| class.call((self.message,), Some(&self.fields)));
        match built {
            Ok(exception) => PyErr::from_value(exception),
            Err(error) => error,
        }
    }
}

/// An argument as the type that it has to have.
pub fn wanted<'py, T>(given: &Bound<'py, PyAny>) -> PyResult<T>
where
    T: for<'a> FromPyObject<'a, 'py>,
{
    given.extract().map_err(|error| {
        let (py, error): (_, PyErr) = (given.py(), Into::into(error));
        let kind = given.get_type();
        let text = format!("an argument cannot be this {kind}: {}", error.value(py));
        Exception::new(py, "ArgumentError", text)
            .with("given", given)
            .build()
    })
}

/// A description that cannot be read.
pub fn of_import(py: Python<'_>, error: &ImportError) -> PyErr {
    let class = match error.problem {
        Problem::File { .. } => "UnreadableFile",
        _ => "DescriptionError",
    };
    let line = (error.place.line > 0).then_some(error.place.line);
    Exception::new(py, class, error.to_string())
        .with("line", line)
        .with("element", error.place.element.as_str())
        .with("problem", error.problem.to_string())
        .build()
}

/// A robot that the library refuses.
pub fn of_model(py: Python<'_>, error: &NoModel, names: &[String]) -> PyErr {
    match error {
        NoModel::TooLarge { what, found, most } => {
            Exception::new(py, "ModelError", format!("{what}: {found}, at most {most}"))
                .with("body", py.None())
                .build()
        }
        NoModel::Refused { body, problem } => {
            let name = body.and_then(|body| names.get(body));
            let problem = match problem.split_once(": ") {
                Some((_, problem)) if name.is_some() => problem,
                _ => problem,
            };
            let text = match name {
                Some(name) => format!("body `{name}`: {problem}"),
                None => problem.to_owned(),
            };
            Exception::new(py, "ModelError", text)
                .with("body", name.map(String::as_str))
                .build()
        }
    }
}

/// A state without a result.
///
/// `most`: the largest angle of which sines are computed.
pub fn of_failure(
    py: Python<'_>,
    robot: &Robot,
    names: &[String],
    failure: &Failure,
    most: f64,
) -> PyErr {
    let state = failure.row;
    let of_joint = |class, joint: &str, text: &str| {
        let text = format!("joint `{joint}` {text} (state {state})");
        Exception::new(py, class, text)
            .with("joint", joint)
            .with("state", state)
    };
    let name_of = |number: &str| -> String {
        let name = number.parse().ok().and_then(|i: usize| names.get(i));
        name.map_or(robot.label(), String::as_str).to_owned()
    };
    let of_loop = |class, number: &str, text: &str| {
        let name = name_of(number);
        let text = format!("loop `{name}` {text} (state {state})");
        Exception::new(py, class, text)
            .with("loop", name)
            .with("state", state)
    };
    match failure.problem {
        StateProblem::Loop(LoopError::Open { name, error }) => {
            let text = format!("is open by {error:.2e} of its size");
            of_loop("LoopOpen", name, &text)
                .with("error", error)
                .build()
        }
        StateProblem::Loop(LoopError::UnderActuated { name, joint }) => {
            let text = format!(
                "moves joint `{}` with all motors held",
                robot.joint_of(joint)
            );
            let error = of_loop("UnderActuated", name, &text);
            error.with("joint", robot.joint_of(joint)).build()
        }
        StateProblem::Loop(LoopError::NotFinite { name }) => {
            of_loop("NotFinite", name, "has a number that is not finite").build()
        }
        StateProblem::Loop(error) => of_loop("LoopOpen", "", &error.to_string()).build(),
        StateProblem::Linkage(at, problem) => {
            let name = names.get(at).map_or(robot.label(), String::as_str);
            let why = match problem {
                ClusterProblem::CannotClose => "the links do not reach each other",
                ClusterProblem::NotConverged => "the iteration has not converged",
                ClusterProblem::NoInertia => "it moves no inertia in some direction",
                _ => "a coordinate or a torque is not finite",
            };
            let text = format!("linkage `{name}`: {why} (state {state})");
            Exception::new(py, "LinkageError", text)
                .with("linkage", name)
                .with("state", state)
                .build()
        }
        StateProblem::Angle(at, angle) => {
            let name = names.get(at).map_or(robot.label(), String::as_str);
            let text = format!(
                "linkage `{name}` has an angle of {angle} rad, and sines are computed to {most} rad (state {state})"
            );
            Exception::new(py, "AngleError", text)
                .with("joint", name)
                .with("coordinate", py.None())
                .with("angle", angle)
                .with("limit", most)
                .with("state", state)
                .build()
        }
        StateProblem::Flexible(FlexibleError::Joint(joint)) => of_joint(
            "NotPositiveDefinite",
            robot.joint_of(joint),
            "moves no inertia, or a number is not finite",
        )
        .with("coordinate", joint)
        .build(),
        StateProblem::Flexible(error) => {
            let mode = match error {
                FlexibleError::Mode(mode) => Some(mode),
                _ => None,
            };
            Exception::new(py, "ModeError", format!("{error} (state {state})"))
                .with("link", py.None())
                .with("mode", mode)
                .with("state", state)
                .build()
        }
        StateProblem::Singular(error) => of_joint(
            "NotPositiveDefinite",
            robot.joint_of(error.joint),
            "moves no inertia, or a coordinate or an inertia is not a number",
        )
        .with("coordinate", error.joint)
        .build(),
        StateProblem::Joint(error) => of_joint(
            "MultiDofJoint",
            robot.joint(error.body),
            "has several degrees of freedom: no transmission of it is known",
        )
        .build(),
        StateProblem::Attitude(error) => of_joint(
            "NoAttitude",
            robot.joint_at(error.at),
            "has a quaternion of length zero, or one that is not finite",
        )
        .build(),
    }
}
