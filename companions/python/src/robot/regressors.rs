//! The regressors: torques are linear in inertial parameters and in coefficients of friction.

use pyo3::prelude::*;
use robot_dynamics_kernels::Which;

use super::{Array, Robot, argument};
use crate::effects::{given as effects_of, wide};
use crate::error::wanted;
use crate::methods::{Machine, methods};

#[pymethods]
impl Robot {
    /// The row (…, bodies, 10) of one velocity coordinate in `regressor`, given by its number or
    /// its joint, by powers of the bodies; q (…, nq), q̇ and q̈ (…, nv).
    #[pyo3(signature = (q, qd, qdd, coordinate, effects = None))]
    fn regressor_row<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        qdd: &Array<'py>,
        coordinate: &Bound<'py, PyAny>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let coordinate = self.coordinates_of(coordinate)?[0];
        let given = [self.q("q", q), self.v("qd", qd), self.v("qdd", qdd)];
        let (which, effects) = (Which::RegressorRow { coordinate }, effects_of(effects)?);
        self.one(py, which, &effects, &given, &[&[self.counts.bodies, 10]])
    }

    /// φ (bodies, 10) of `regressor`, float64: the inertial parameters of the bodies with the loads
    /// on them, kg, kg·m and kg·m².
    #[pyo3(signature = (effects = None))]
    fn inertial_parameters<'py>(
        &self,
        py: Python<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let none = numpy::PyArray1::<f64>::zeros(py, 0, false).into_any();
        let (which, effects) = (Which::InertialParameters, effects_of(effects)?);
        let q = [argument("q", &none, 0)];
        self.one(py, which, &effects, &q, &[&[self.counts.bodies, 10]])
    }

    /// The regressor of friction (…, nv, 2): of each coordinate q̇ for the coefficient of
    /// `Viscous`, N·m·s/rad or N·s/m, and the smooth sign of `Coulomb` of this width, rad/s or m/s,
    /// for its torque, N·m or N; q̇ (…, nv).
    fn friction_regressor<'py>(
        &self,
        py: Python<'py>,
        qd: &Array<'py>,
        #[pyo3(from_py_with = wanted)] width: f64,
    ) -> PyResult<Array<'py>> {
        wide(py, "Coulomb", width)?;
        let which = Which::FrictionRegressor { width };
        self.one(py, which, &[], &[self.v("qd", qd)], &[&[self.counts.v, 2]])
    }
}

methods! {
    Robot, robot => (v, nq, bodies) = (robot.counts.v, robot.counts.q, robot.counts.bodies);

    /// Y (…, nv, bodies, 10) with τ = Y φ, φ of a body: m, m c (3), then Ixx, Ixy, Iyy, Ixz, Iyz,
    /// Izz about the origin of its frame whose z is the joint's axis; q (…, nq), q̇ and q̈ (…, nv).
    regressor(q: q, qd: v, qdd: v; under effects) = one(Regressor { first: 0, end: bodies }): [v, bodies, 10];

    /// The columns (…, nv, 10) of one body in `regressor`; q (…, nq), q̇ and q̈ (…, nv).
    regressor_columns(q: q, qd: v, qdd: v; at body; under effects) = one(Regressor { first: body, end: body + 1 }): [v, 10];
}
