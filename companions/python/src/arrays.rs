//! Between numpy's arrays and the rows of a job.

use numpy::{
    Element, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::angles::{Positions, Use};
use crate::error::Exception;

/// An argument of a call: its name, the array, and its last axes: of a vector one, of a matrix two.
pub struct Argument<'a, 'py> {
    pub name: &'static str,
    pub given: &'a Bound<'py, PyAny>,
    pub axes: [usize; 2],
    pub matrix: bool,
    /// The positions in it, if it has any.
    pub positions: Option<Positions<'a>>,
}

impl Argument<'_, '_> {
    /// The same for a function that does something else with positions.
    pub fn by(mut self, by: Use) -> Self {
        if let Some(positions) = &mut self.positions {
            positions.by = by;
        }
        self
    }
    /// The shape of a state's numbers.
    fn own(&self) -> &[usize] {
        &self.axes[usize::from(!self.matrix)..]
    }

    /// The number of numbers that a state has.
    pub fn width(&self) -> usize {
        self.own().iter().product()
    }
}

/// The scalar of a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dtype {
    Single,
    Double,
}

/// The type of the arguments: lists have the type of the arrays among them, and f64 if there is
/// none.
pub fn dtype(arguments: &[Argument<'_, '_>]) -> PyResult<Dtype> {
    let mut found = None;
    for argument in arguments {
        let this = if argument.given.cast::<PyArrayDyn<f64>>().is_ok() {
            Dtype::Double
        } else if argument.given.cast::<PyArrayDyn<f32>>().is_ok() {
            Dtype::Single
        } else if argument.given.is_none() {
            let text = format!("`{}` is None: expected an array", argument.name);
            return Err(wrong_dtype(argument, text));
        } else if let Ok(array) = argument.given.cast::<PyUntypedArray>() {
            let dtype = array.dtype();
            let text =
                format!("`{}` has the dtype {dtype}: expected float32 or float64", argument.name);
            return Err(wrong_dtype(argument, text));
        } else {
            continue;
        };
        if found.is_some_and(|found| found != this) {
            let text = format!(
                "`{}` has another dtype than the arguments before it: all float32, or all float64",
                argument.name
            );
            return Err(wrong_dtype(argument, text));
        }
        found = Some(this);
    }
    Ok(found.unwrap_or(Dtype::Double))
}

fn wrong_dtype(argument: &Argument<'_, '_>, text: String) -> PyErr {
    Exception::new(argument.given.py(), "DtypeError", text).with("argument", argument.name).build()
}

/// The array of an argument, contiguous.
pub fn array<'py, R: Element>(
    argument: &Argument<'_, 'py>,
) -> PyResult<PyReadonlyArrayDyn<'py, R>> {
    let py = argument.given.py();
    if let Ok(array) = argument.given.cast::<PyArrayDyn<R>>()
        && array.is_c_contiguous()
        && let Ok(array) = array.try_readonly()
        // An array that is not aligned has no slice.
        && array.as_slice().is_ok()
    {
        return Ok(array);
    }
    let keywords = PyDict::new(py);
    keywords.set_item("dtype", numpy::dtype::<R>(py))?;
    keywords.set_item("order", "C")?;
    let copied = py
        .import("numpy")?
        .call_method("array", (argument.given,), Some(&keywords))
        .and_then(|copied| Ok(copied.cast_into::<PyArrayDyn<R>>()?));
    match copied {
        Ok(array) => Ok(array.readonly()),
        Err(error) => {
            let text = format!("`{}` is no array of numbers: {error}", argument.name);
            Err(wrong_dtype(argument, text))
        }
    }
}

/// The leading axes of the arguments, which are the same for all.
pub fn leading<'s>(
    arguments: &[Argument<'_, '_>],
    shapes: impl Iterator<Item = &'s [usize]>,
) -> PyResult<&'s [usize]> {
    let mut found: Option<(&'static str, &'s [usize])> = None;
    for (argument, shape) in arguments.iter().zip(shapes) {
        let Some(leading) = shape.strip_suffix(argument.own()) else {
            return Err(wrong_shape(argument, shape, String::new()));
        };
        match found {
            Some((name, other)) if other != leading => {
                let text = format!(", and the leading axes {other:?} of `{name}`");
                return Err(wrong_shape(argument, shape, text));
            }
            Some(_) => {}
            None => found = Some((argument.name, leading)),
        }
    }
    Ok(found.map_or(&[], |(_, leading)| leading))
}

fn wrong_shape(argument: &Argument<'_, '_>, shape: &[usize], more: String) -> PyErr {
    let expected = match argument.own() {
        [width] => format!("{width} numbers on the last axis{more}"),
        own => format!("{own:?} as the last axes{more}"),
    };
    let text = format!("`{}` has the shape {shape:?}: expected {expected}", argument.name);
    let py = argument.given.py();
    let shape = pyo3::types::PyTuple::new(py, shape);
    let error = Exception::new(py, "ShapeError", text).with("argument", argument.name);
    let error = match shape {
        Ok(shape) => error.with("shape", shape),
        Err(_) => error,
    };
    error.with("expected", expected).build()
}
