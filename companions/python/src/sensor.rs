//! The load of a force sensor as Python sees it.

use dynamics_core::glam::DVec3;
use dynamics_core::spatial::Force;
use motion_control::estimate::{SensorLoad, SensorLoadFit};
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::prelude::*;

use crate::arrays::{arrays_of, dtype};
use crate::error::{Exception, wanted};
use crate::robot::{Array, argument};

/// The load of a force sensor and its offset: the mass, kg, its first moment about the sensor's
/// origin and along its axes, kg·m, and the wrench that it shows without a load: couple, N·m, and
/// force, N. It computes in float64.
///
/// While the arm moves, the sensor shows the offset and the wrench of a `Payload` of this mass and
/// centre, which `Robot.rnea_and_wrenches` has.
#[pyclass(frozen, module = "robot_dynamics", name = "SensorLoad")]
pub struct PySensorLoad(SensorLoad<f64>, Option<[f64; 2]>);

fn force([a, b, c, x, y, z]: [f64; 6]) -> Force<f64> {
    Force::new(DVec3::new(a, b, c), DVec3::new(x, y, z))
}

fn six(force: &Force<f64>) -> [f64; 6] {
    let (n, f) = (force.ang, force.lin);
    [n.x, n.y, n.z, f.x, f.y, f.z]
}

#[pymethods]
impl PySensorLoad {
    #[new]
    fn new(
        #[pyo3(from_py_with = wanted)] mass: f64,
        #[pyo3(from_py_with = wanted)] first_moment: [f64; 3],
        #[pyo3(from_py_with = wanted)] offset: [f64; 6],
    ) -> Self {
        let (first_moment, offset) = (first_moment.into(), force(offset));
        Self(SensorLoad { mass, first_moment, offset }, None)
    }

    /// Load and offset by least squares from poses at rest: gravity in the sensor's frame (…, 3),
    /// m/s², and what the sensor shows there (…, 6), couple and force, N·m and N.
    ///
    /// Raises SensorLoadError of poses from which no load follows, and of a sensor with the other
    /// sign or with other axes than those of gravity.
    #[staticmethod]
    fn fit<'py>(py: Python<'py>, gravity: &Array<'py>, wrench: &Array<'py>) -> PyResult<Self> {
        let given = [argument("gravity", gravity, 3), argument("wrench", wrench, 6)];
        dtype(&given)?;
        let arrays = arrays_of::<f64>(&given)?.1;
        let mut fit = SensorLoadFit::new();
        let gravity = arrays[0].as_slice()?.as_chunks().0;
        let wrench = arrays[1].as_slice()?.as_chunks().0;
        for (&gravity, &wrench) in gravity.iter().zip(wrench) {
            fit.add(DVec3::from_array(gravity), &force(wrench));
        }
        fit.load().map(|load| Self(load, Some(fit.residual(&load)))).map_err(|error| {
            let error = Exception::new(py, "SensorLoadError", error.to_string());
            error.with("poses", gravity.len()).build()
        })
    }

    /// The mass, kg.
    #[getter]
    fn mass(&self) -> f64 {
        self.0.mass
    }
    /// Mass times centre of mass, kg·m.
    #[getter]
    fn first_moment(&self) -> [f64; 3] {
        self.0.first_moment.into()
    }
    /// The wrench that the sensor shows without a load, N·m and N.
    #[getter]
    fn offset(&self) -> [f64; 6] {
        six(&self.0.offset)
    }

    /// The root mean squares of couple, N·m, and force, N, that a fit leaves over its poses, near
    /// the sensor's noise; None of a load that was not fitted.
    #[getter]
    fn residual(&self) -> Option<[f64; 2]> {
        self.1
    }

    /// The wrench at rest (…, 6), N·m and N, of gravity in the sensor's frame (…, 3), m/s²: that
    /// of a contact is what it measures less this.
    fn at_rest<'py>(&self, py: Python<'py>, gravity: &Array<'py>) -> PyResult<Array<'py>> {
        let given = [argument("gravity", gravity, 3)];
        dtype(&given)?;
        let (mut shape, arrays) = arrays_of::<f64>(&given)?;
        let each = arrays[0].as_slice()?.as_chunks().0.iter();
        let shown: Vec<f64> =
            each.flat_map(|&gravity| six(&self.0.at_rest(DVec3::from_array(gravity)))).collect();
        shape.push(6);
        Ok(shown.into_pyarray(py).reshape(shape)?.into_any())
    }
}
