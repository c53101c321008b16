//! The factors of the inertia matrix, and solutions by these.

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use robot_dynamics_kernels::Which;

use super::{Array, Robot, without_rotors};
use crate::effects::given as effects_of;

#[pymethods]
impl Robot {
    /// M(q) (…, nv, nv), kg·m² or kg, and J (…, 6, nv) of a body in its own frame, angular rows
    /// first, at once; q (…, nq).
    #[pyo3(signature = (q, body, effects = None))]
    fn crba_jacobian<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        body: &Bound<'py, PyAny>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let body = self.body(body)?;
        let effects = effects_of(effects)?;
        let v = self.counts.v;
        self.several(
            py,
            Which::CrbaJacobian { body },
            &effects,
            &[self.q(q)],
            &[&[v, v], &[6, v]],
        )
    }

    /// The factors of M = Lᵀ D L: L (…, nv, nv), lower triangular with a unit diagonal, and the
    /// reciprocals of D (…, nv), 1/(kg·m²) or 1/kg; M (…, nv, nv), kg·m² or kg, of which the
    /// entries up to the diagonal are read. L is zero wherever M is: of two coordinates on
    /// different branches.
    ///
    /// Raises NotPositiveDefinite with the joint that moves no inertia.
    fn ltdl<'py>(&self, py: Python<'py>, m: &Array<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let v = self.counts.v;
        self.several(
            py,
            Which::LtdlOf,
            &[],
            &[self.matrix("m", m)],
            &[&[v, v], &[v]],
        )
    }

    /// x (…, nv) with M x = τ, rad/s² or m/s², by the factors of `ltdl`: L (…, nv, nv), the
    /// reciprocals of D and τ (…, nv), N·m or N.
    fn solve<'py>(
        &self,
        py: Python<'py>,
        l: &Array<'py>,
        d_inv: &Array<'py>,
        tau: &Array<'py>,
    ) -> PyResult<Array<'py>> {
        self.one(
            py,
            Which::Solve,
            &[],
            &[
                self.matrix("l", l),
                self.v("d_inv", d_inv),
                self.v("tau", tau),
            ],
            &[self.counts.v],
        )
    }

    /// M⁻¹ (…, nv, nv), 1/(kg·m²) or 1/kg, by the factors of `ltdl`: L (…, nv, nv) and the
    /// reciprocals of D (…, nv).
    fn inverse<'py>(
        &self,
        py: Python<'py>,
        l: &Array<'py>,
        d_inv: &Array<'py>,
    ) -> PyResult<Array<'py>> {
        self.one(
            py,
            Which::Inverse,
            &[],
            &[self.matrix("l", l), self.v("d_inv", d_inv)],
            &[self.counts.v, self.counts.v],
        )
    }

    /// The factor of M = Lᵀ L: L (…, nv, nv), lower triangular, √kg·m or √kg, and the reciprocals
    /// of its diagonal (…, nv); M (…, nv, nv), kg·m² or kg, of which the entries up to the diagonal
    /// are read.
    ///
    /// Raises NotPositiveDefinite with the joint that moves no inertia.
    fn cholesky<'py>(&self, py: Python<'py>, m: &Array<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let v = self.counts.v;
        self.several(
            py,
            Which::CholeskyOf,
            &[],
            &[self.matrix("m", m)],
            &[&[v, v], &[v]],
        )
    }

    /// x (…, nv) with M x = τ, rad/s² or m/s², by the factor of `cholesky`: L (…, nv, nv), the
    /// reciprocals of its diagonal and τ (…, nv), N·m or N.
    fn cholesky_solve<'py>(
        &self,
        py: Python<'py>,
        l: &Array<'py>,
        l_inv: &Array<'py>,
        tau: &Array<'py>,
    ) -> PyResult<Array<'py>> {
        self.one(
            py,
            Which::CholeskySolve,
            &[],
            &[
                self.matrix("l", l),
                self.v("l_inv", l_inv),
                self.v("tau", tau),
            ],
            &[self.counts.v],
        )
    }

    /// The factors of `ltdl` without M, by the spatial operators of articulated bodies: L (…, nv,
    /// nv) and the reciprocals of D (…, nv), 1/(kg·m²) or 1/kg; q (…, nq).
    #[pyo3(signature = (q, effects = None))]
    fn spatial_operator_ltdl<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let effects = effects_of(effects)?;
        without_rotors(py, &effects)?;
        let v = self.counts.v;
        self.several(
            py,
            Which::SpatialOperatorLtdl,
            &effects,
            &[self.q(q)],
            &[&[v, v], &[v]],
        )
    }

    /// M(q)⁻¹ (…, nv, nv), 1/(kg·m²) or 1/kg, without M, by the spatial operators of articulated
    /// bodies; q (…, nq).
    #[pyo3(signature = (q, effects = None))]
    fn spatial_operator_inverse<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        without_rotors(py, &effects)?;
        self.one(
            py,
            Which::SpatialOperatorInverse,
            &effects,
            &[self.q(q)],
            &[self.counts.v, self.counts.v],
        )
    }

    /// M(q)⁻¹ (…, nv, nv); q (…, nq).
    #[pyo3(signature = (q, effects = None))]
    fn inverse_mass<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        self.one(
            py,
            Which::InverseMass,
            &effects,
            &[self.q(q)],
            &[self.counts.v, self.counts.v],
        )
    }

    /// The estimated error (…, nv), rad/s² or m/s², that rounding leaves in a solution q̈ (…, nv)
    /// of M q̈ = b: M (…, nv, nv), L and the reciprocals of D of `ltdl`, q̈, and the sums of the
    /// magnitudes of the terms of b (…, nv), N·m or N.
    fn acceleration_error<'py>(
        &self,
        py: Python<'py>,
        m: &Array<'py>,
        l: &Array<'py>,
        d_inv: &Array<'py>,
        qdd: &Array<'py>,
        terms: &Array<'py>,
    ) -> PyResult<Array<'py>> {
        self.one(
            py,
            Which::AccelerationError,
            &[],
            &[
                self.matrix("m", m),
                self.matrix("l", l),
                self.v("d_inv", d_inv),
                self.v("qdd", qdd),
                self.v("terms", terms),
            ],
            &[self.counts.v],
        )
    }
}
