//! Energy and momentum.

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use robot_dynamics_kernels::Which;

use super::{Array, Robot, argument, without_rotors};
use crate::effects::given as effects_of;

#[pymethods]
impl Robot {
    /// The kinetic energy (…), J; q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, effects = None))]
    fn kinetic_energy<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        self.one(
            py,
            Which::KineticEnergy,
            &effects,
            &[self.q(q), self.v("qd", qd)],
            &[],
        )
    }

    /// The potential energy in the field of gravity (…), J, zero at the base's origin; q (…, nq).
    #[pyo3(signature = (q, effects = None))]
    fn potential_energy<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        self.one(py, Which::PotentialEnergy, &effects, &[self.q(q)], &[])
    }

    /// The momentum of all bodies about the base's origin (…, 6): N·m·s, then N·s; q (…, nq), q̇
    /// (…, nv).
    #[pyo3(signature = (q, qd, effects = None))]
    fn momentum<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        self.one(
            py,
            Which::Momentum,
            &effects,
            &[self.q(q), self.v("qd", qd)],
            &[6],
        )
    }

    /// The momentum of all bodies about their centre of mass (…, 6): N·m·s, then N·s; q (…, nq), q̇
    /// (…, nv).
    #[pyo3(signature = (q, qd, effects = None))]
    fn centroidal_momentum<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        self.one(
            py,
            Which::CentroidalMomentum,
            &effects,
            &[self.q(q), self.v("qd", qd)],
            &[6],
        )
    }

    /// A(q) (…, 6, nv) with A q̇ the momentum about the centre of mass; q (…, nq).
    #[pyo3(signature = (q, effects = None))]
    fn centroidal_matrix<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        without_rotors(py, &effects)?;
        self.one(
            py,
            Which::CentroidalMatrix,
            &effects,
            &[self.q(q)],
            &[6, self.counts.v],
        )
    }

    /// p = M q̇ and Cᵀ q̇, each (…, nv), for observers of external torques; q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, effects = None))]
    fn momentum_and_coriolis<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let effects = effects_of(effects)?;
        self.several(
            py,
            Which::MomentumAndCoriolis,
            &effects,
            &[self.q(q), self.v("qd", qd)],
            &[&[self.counts.v], &[self.counts.v]],
        )
    }

    /// p = M q̇ and β = Cᵀ q̇ − g − F, each (…, nv); q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, effects = None))]
    fn momentum_and_drift<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let effects = effects_of(effects)?;
        self.several(
            py,
            Which::MomentumAndDrift,
            &effects,
            &[self.q(q), self.v("qd", qd)],
            &[&[self.counts.v], &[self.counts.v]],
        )
    }

    /// q̇ (…, nv) with the rates of the free base for which the momentum of all bodies about the
    /// base's origin is h (…, 6); q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, h, effects = None))]
    fn base_velocity_from_momentum<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        h: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        self.one(
            py,
            Which::BaseVelocity,
            &effects,
            &[self.q(q), self.v("qd", qd), argument("h", h, 6)],
            &[self.counts.v],
        )
    }
}
