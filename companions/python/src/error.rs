//! From errors of the library to exceptions of `robot_dynamics.errors`.

use std::path::Path;

use pyo3::prelude::*;
use pyo3::types::PyDict;

use robot_import::error::{ImportError, Problem};

use robot_dynamics_kernels::model::NoModel;

/// An exception of that class with fields.
pub struct Exception<'py> {
    class: &'static str,
    message: String,
    fields: Bound<'py, PyDict>,
}

impl<'py> Exception<'py> {
    /// An exception without fields.
    pub fn new(py: Python<'py>, class: &'static str, message: impl Into<String>) -> Self {
        Self { class, message: message.into(), fields: PyDict::new(py) }
    }

    /// The same exception with a field more.
    pub fn with(self, name: &str, value: impl IntoPyObject<'py>) -> Self {
        // The only failure is that of memory, which leaves the field unset.
        let _ = self.fields.set_item(name, value);
        self
    }

    /// The exception that Python raises.
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
        let own = py.import("robot_dynamics.errors");
        let own = own.and_then(|errors| errors.getattr("RobotDynamicsError"));
        if own.is_ok_and(|own| error.matches(py, own).unwrap_or(false)) {
            return error;
        }
        let kind = given.get_type();
        let text = format!("an argument cannot be this {kind}: {}", error.value(py));
        Exception::new(py, "ArgumentError", text).with("given", given).build()
    })
}

/// A description that cannot be read.
pub fn of_import(py: Python<'_>, error: &ImportError) -> PyErr {
    let class = match error.problem {
        Problem::File { ref path, .. } if !Path::new(path).exists() => "MissingFile",
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
            Exception::new(py, "ModelError", text).with("body", name.map(String::as_str)).build()
        }
    }
}
