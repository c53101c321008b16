//! Between numpy's arrays and the rows of a job.

use numpy::{
    Element, PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArray,
    PyUntypedArrayMethods,
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

/// The type of the arguments: lists and integers have the type of the arrays among them, and f64
/// if there is none.
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
            match (dtype.kind(), dtype.itemsize()) {
                (b'i' | b'u', _) => continue,
                // In the other order of bytes.
                (b'f', 8) => Dtype::Double,
                (b'f', 4) => Dtype::Single,
                (kind, _) => {
                    let (name, remedy) = (
                        argument.name,
                        match kind {
                            b'f' | b'b' => format!(": {}.astype(np.float64)", argument.name),
                            _ => String::new(),
                        },
                    );
                    let text = format!(
                        "`{name}` has the dtype {dtype}: expected float32, float64 or integers{remedy}"
                    );
                    return Err(wrong_dtype(argument, text));
                }
            }
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
fn array<'py, R: Element>(argument: &Argument<'_, 'py>) -> PyResult<PyReadonlyArrayDyn<'py, R>> {
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

/// The leading axes of the arguments together, and arrays that have them.
pub fn arrays_of<'py, R: Element>(
    arguments: &[Argument<'_, 'py>],
) -> PyResult<(Vec<usize>, Vec<PyReadonlyArrayDyn<'py, R>>)> {
    let mut arrays: Vec<_> = arguments.iter().map(array::<R>).collect::<PyResult<_>>()?;
    let leading = leading(arguments, arrays.iter().map(|array| array.shape()))?;
    for (argument, array) in arguments.iter().zip(&mut arrays) {
        if array.shape().strip_suffix(argument.own()) != Some(&*leading) {
            *array = broadcast(argument, array, &leading)?;
        }
    }
    Ok((leading, arrays))
}

/// The leading axes of the arguments together, as numpy broadcasts them.
fn leading<'s>(
    arguments: &[Argument<'_, '_>],
    shapes: impl Iterator<Item = &'s [usize]>,
) -> PyResult<Vec<usize>> {
    let mut all: Option<Vec<usize>> = None;
    for (i, (argument, shape)) in arguments.iter().zip(shapes).enumerate() {
        let Some(leading) = shape.strip_suffix(argument.own()) else {
            return Err(wrong_shape(argument, shape, String::new()));
        };
        let all = all.get_or_insert_with(|| leading.to_vec());
        if all != leading && !widen(all, leading) {
            let before: Vec<&str> = arguments[..i].iter().map(|before| before.name).collect();
            let text = format!(", and the leading axes {all:?} of `{}`", before.join("`, `"));
            return Err(wrong_shape(argument, shape, text));
        }
    }
    Ok(all.unwrap_or_default())
}

/// Broadcasts axes with others, unless they do not go together.
fn widen(all: &mut Vec<usize>, axes: &[usize]) -> bool {
    let mut wide = all.clone();
    wide.splice(0..0, std::iter::repeat_n(1, axes.len().saturating_sub(all.len())));
    let first = wide.len() - axes.len();
    for (one, &length) in wide[first..].iter_mut().zip(axes) {
        match (*one, length) {
            (1, _) => *one = length,
            (one, length) if one == length || length == 1 => {}
            _ => return false,
        }
    }
    *all = wide;
    true
}

/// An array with these leading axes.
fn broadcast<'py, R: Element>(
    argument: &Argument<'_, 'py>,
    array: &PyReadonlyArrayDyn<'py, R>,
    leading: &[usize],
) -> PyResult<PyReadonlyArrayDyn<'py, R>> {
    let shape = [leading, argument.own()].concat();
    let numpy = argument.given.py().import("numpy")?;
    let all = numpy.call_method1("broadcast_to", (&**array, shape))?;
    let all = numpy.call_method1("ascontiguousarray", (all,))?;
    Ok(all.cast_into::<PyArrayDyn<R>>()?.readonly())
}

pub fn wrong_shape(argument: &Argument<'_, '_>, shape: &[usize], more: String) -> PyErr {
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
