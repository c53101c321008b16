//! From a call in Python to an algorithm over its rows.

use numpy::{Element, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;
use robot_dynamics_kernels::job::{Input, Job, Output};
use robot_dynamics_kernels::model::Models;
use robot_dynamics_kernels::spec::{BodyRef, fit};
use robot_dynamics_kernels::{Scalar, Setting, Which};

use crate::arrays::{Dtype, arrays_of, dtype};
use crate::effects::refused;
use crate::failure::of_failure;
use crate::request::Request;
use crate::robot::Robot;

/// A scalar with numpy's arrays.
pub trait Numbers: Scalar + Element {
    /// The robot's models in this scalar.
    fn of(robot: &Robot) -> &Models<Self>;
}

impl Numbers for f32 {
    fn of(robot: &Robot) -> &Models<Self> {
        &robot.single
    }
}

impl Numbers for f64 {
    fn of(robot: &Robot) -> &Models<Self> {
        &robot.double
    }
}

/// Batches of fewer states are computed with Python's lock, which takes longer to release.
const ROWS_WITH_LOCK: usize = 64;

impl Robot {
    /// The results of an algorithm.
    pub fn compute<'py>(
        &self,
        py: Python<'py>,
        which: Which<'_>,
        request: &Request<'_, 'py>,
    ) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let effects = self.at_bodies(request.effects);
        let request =
            &Request { effects: effects.as_deref().unwrap_or(request.effects), ..*request };
        match dtype(request.arguments)? {
            Dtype::Single => self.compute_in::<f32>(py, which, request),
            Dtype::Double => self.compute_in::<f64>(py, which, request),
        }
    }

    fn compute_in<'py, R: Numbers>(
        &self,
        py: Python<'py>,
        which: Which<'_>,
        request: &Request<'_, 'py>,
    ) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let number = |body: &BodyRef| self.body_number(body);
        let alone = |coordinate| self.is_alone(coordinate);
        fit(request.effects, self.counts.v, alone, |body| {
            number(body).ok_or_else(|| self.no_body(body))
        })
        .map_err(|error| {
            let text = format!("{}: {}", error.effect, error.problem);
            refused(py, error.effect, text)
        })?;
        let (leading, arrays) = arrays_of::<R>(request.arguments)?;
        let rows = leading.iter().product();
        let in_range = arrays.iter().zip(request.arguments);
        let in_range: Vec<Option<Vec<R>>> = in_range
            .map(|(array, argument)| match &argument.positions {
                Some(positions) => {
                    let data = (array.as_slice()?, argument.width());
                    positions.in_range(py, |at| self.joint_of(at), data, request.effects)
                }
                None => Ok(None),
            })
            .collect::<PyResult<_>>()?;
        let results: Vec<_> = request
            .results
            .iter()
            .map(|shape| {
                let all: Vec<usize> = leading.iter().chain(*shape).copied().collect();
                PyArrayDyn::<R>::zeros(py, all, false)
            })
            .collect();
        let done = {
            let mut guards: Vec<_> = results.iter().map(|result| result.readwrite()).collect();
            let inputs = arrays.iter().zip(&in_range).zip(request.arguments);
            let inputs: PyResult<Vec<_>> = inputs
                .map(|((array, in_range), argument)| {
                    let data = match in_range {
                        Some(changed) => changed.as_slice(),
                        None => array.as_slice()?,
                    };
                    let width = argument.width();
                    Ok(Input { data, width })
                })
                .collect();
            let outputs = guards.iter_mut().zip(request.results);
            let outputs: PyResult<Vec<_>> = outputs
                .map(|(guard, shape)| {
                    let (data, width) = (guard.as_slice_mut()?, shape.iter().product());
                    Ok(Output { data, width })
                })
                .collect();
            let job = Job { inputs: inputs?, outputs: outputs?, rows };
            let body = |body: &BodyRef| number(body).unwrap_or(usize::MAX);
            let setting = Setting { counts: self.counts, effects: request.effects, body: &body };
            let models = R::of(self);
            let work = || job.compute(|job| R::compute(&which, models, setting, job));
            if rows < ROWS_WITH_LOCK { work() } else { py.detach(work) }
        };
        done.map_err(|failure| of_failure(py, self, request.names, &failure, R::MOST_ANGLE))?;
        Ok(results.into_iter().map(Bound::into_any).collect())
    }
}
