//! Methods that ask for an algorithm and do nothing else, as rows of a table.

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use robot_dynamics_kernels::Which;
use robot_dynamics_kernels::spec::Spec;

use crate::arrays::Argument;
use crate::request::Request;
use crate::robot::{Array, Robot};

/// A robot, alone or with loops, linkages or links that bend.
pub trait Machine {
    /// The robot without these additions.
    fn robot(&self) -> &Robot;

    /// The names of its loops or linkages.
    fn names(&self) -> &[String] {
        &[]
    }

    /// A configuration, of which sines and cosines alone matter.
    fn q<'a, 'py>(&'a self, name: &'static str, given: &'a Array<'py>) -> Argument<'a, 'py> {
        self.robot().configuration(name, given)
    }

    /// One number for each velocity coordinate.
    fn v<'a, 'py>(&self, name: &'static str, given: &'a Array<'py>) -> Argument<'a, 'py> {
        crate::robot::argument(name, given, self.robot().counts.v)
    }

    /// The results of an algorithm that has several, a tuple.
    fn several<'py>(
        &self,
        py: Python<'py>,
        which: Which<'_>,
        effects: &[Spec],
        arguments: &[Argument<'_, 'py>],
        results: &[&[usize]],
    ) -> PyResult<Array<'py>> {
        let request = Request { effects, arguments, results, names: self.names() };
        let all = self.robot().compute(py, which, &request)?;
        Ok(PyTuple::new(py, all)?.into_any())
    }

    /// The result of an algorithm that has one.
    fn one<'py>(
        &self,
        py: Python<'py>,
        which: Which<'_>,
        effects: &[Spec],
        arguments: &[Argument<'_, 'py>],
        results: &[&[usize]],
    ) -> PyResult<Array<'py>> {
        self.several(py, which, effects, arguments, results)?.get_item(0)
    }
}

/// Methods of a class: each has arrays with the functions that make arguments of them, perhaps a
/// body or a frame on one and the axes, perhaps an argument of another type, perhaps effects and what
/// refuses some, perhaps an option; and one result or several of an algorithm, with the shape of a
/// row of each.
macro_rules! methods {
    (@effects) => { &[] };
    (@effects $effects:ident) => { &$effects };
    ($class:ident, $this:ident => $names:pat = $values:expr; $(
        $(#[$doc:meta])*
        $method:ident(
            $($array:ident: $kind:ident $(by $use:ident)?),*
            $(; at $body:ident $(, $frame:ident)?)?
            $(; given $given:ident: $type:ty)?
            $(; under $effects:ident $($refuses:ident)?)?
            $(; with $option:ident: $of:ty = $default:tt)?
        ) = $many:ident($which:ident $({ $($field:tt)* })?): $([$($shape:expr),*]),*;
    )*) => {
        #[::pyo3::pymethods]
        impl $class {$(
            $(#[$doc])*
            #[pyo3(signature = ($($array,)* $($body, $($frame = "local",)?)? $($given,)? $($effects = None,)? $($option = $default)?))]
            #[allow(
                unused_variables,
                clippy::too_many_arguments,
                reason = "sizes that a method does not need, and arguments of an algorithm"
            )]
            fn $method<'py>(
                &self,
                py: ::pyo3::Python<'py>,
                $($array: &$crate::robot::Array<'py>,)*
                $($body: &$crate::robot::Array<'py>, $($frame: &str,)?)?
                $(#[pyo3(from_py_with = $crate::error::wanted)] $given: $type,)?
                $($effects: Option<&$crate::robot::Array<'py>>,)?
                $(#[pyo3(from_py_with = $crate::error::wanted)] $option: $of,)?
            ) -> ::pyo3::PyResult<$crate::robot::Array<'py>> {
                use $crate::methods::Machine as _;
                let $this = self;
                let $names = $values;
                let machine = $this;
                $(
                    let (framed, $body) = self.at($body)?;
                    let machine = framed.as_ref().map_or(machine, |framed| framed.get());
                    $(let $frame = $crate::robot::given::frame_of(py, $frame)?;)?
                )?
                $(
                    let $effects = $crate::effects::given($effects)?;
                    $($refuses(py, &$effects)?;)?
                )?
                let arguments = [$(
                    machine.$kind(stringify!($array), $array)$(.by($crate::angles::Use::$use))?
                ),*];
                let which = ::robot_dynamics_kernels::Which::$which $({ $($field)* })?;
                let results: &[&[usize]] = &[$(&[$($shape),*]),*];
                machine.$many(py, which, methods!(@effects $($effects)?), &arguments, results)
            }
        )*}
    };
}

pub(crate) use methods;
