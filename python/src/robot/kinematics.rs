//! Configurations, poses, velocities, accelerations and Jacobians of bodies.

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use robot_dynamics_kernels::Which;

use super::{Array, Robot, all, argument, frame_of, only};
use crate::compute::Request;
use crate::effects::given as effects_of;

#[pymethods]
impl Robot {
    /// The configuration of rest, (nq,): zeros and quaternions of no rotation.
    fn neutral<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let none = numpy::PyArray1::<f64>::zeros(py, 0, false).into_any();
        let request = Request {
            effects: &[],
            arguments: &[argument("q", &none, 0)],
            results: &[&[self.counts.q]],
        };
        self.compute(py, Which::Neutral, &request).map(only)
    }

    /// J (…, 6, nv) of a body with v = J q̇, angular rows first; q (…, nq). ``frame``: "local", "world" or
    /// "local_world_aligned".
    #[pyo3(signature = (q, body, frame = "local"))]
    fn jacobian<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        body: &Bound<'py, PyAny>,
        frame: &str,
    ) -> PyResult<Array<'py>> {
        let body = self.body(body)?;
        let frame = frame_of(py, frame)?;
        let request = Request {
            effects: &[],
            arguments: &[argument("q", q, self.counts.q)],
            results: &[&[6, self.counts.v]],
        };
        let found = self.compute(py, Which::Jacobian { body, frame }, &request)?;
        Ok(only(found))
    }

    /// J̇ q̇ of a body, (…, 6), rad/s² and m/s², the spatial acceleration without q̈; q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, body, frame = "local"))]
    fn bias_acceleration<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        body: &Bound<'py, PyAny>,
        frame: &str,
    ) -> PyResult<Array<'py>> {
        let body = self.body(body)?;
        let frame = frame_of(py, frame)?;
        let request = Request {
            effects: &[],
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
            ],
            results: &[&[6]],
        };
        let found = self.compute(py, Which::BiasAcceleration { body, frame }, &request)?;
        Ok(only(found))
    }

    /// Rotation matrices (…, bodies, 3, 3) from each body's frame to the base's, and positions (…, bodies, 3), m; q
    /// (…, nq).
    #[pyo3(signature = (q))]
    fn poses<'py>(&self, py: Python<'py>, q: &Array<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let request = Request {
            effects: &[],
            arguments: &[argument("q", q, self.counts.q)],
            results: &[&[self.counts.bodies, 3, 3], &[self.counts.bodies, 3]],
        };
        let found = self.compute(py, Which::Poses, &request)?;
        all(py, found)
    }

    /// Spatial velocities (rad/s, m/s) and accelerations (rad/s², m/s²) of all bodies, each (…, bodies, 6), angular
    /// part first; q (…, nq), q̇ and q̈ (…, nv).
    #[pyo3(signature = (q, qd, qdd, frame = "local", effects = None))]
    fn kinematics<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        qdd: &Array<'py>,
        frame: &str,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let frame = frame_of(py, frame)?;
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
                argument("qdd", qdd, self.counts.v),
            ],
            results: &[&[self.counts.bodies, 6], &[self.counts.bodies, 6]],
        };
        let found = self.compute(py, Which::Kinematics { frame }, &request)?;
        all(py, found)
    }

    /// Mass (…), kg, position (…, 3), m, and velocity (…, 3), m/s, of the centre of mass; q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, effects = None))]
    fn center_of_mass<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
            ],
            results: &[&[], &[3], &[3]],
        };
        let found = self.compute(py, Which::CenterOfMass, &request)?;
        all(py, found)
    }

    /// q ⊕ δ (…, nq): the configuration after a unit of time at the velocity δ (…, nv).
    #[pyo3(signature = (q, delta))]
    fn integrate<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        delta: &Array<'py>,
    ) -> PyResult<Array<'py>> {
        let request = Request {
            effects: &[],
            arguments: &[
                argument("q", q, self.counts.q),
                argument("delta", delta, self.counts.v),
            ],
            results: &[&[self.counts.q]],
        };
        let found = self.compute(py, Which::Integrate, &request)?;
        Ok(only(found))
    }

    /// q₁ ⊖ q₀ (…, nv): the velocity that leads from q₀ to q₁ (…, nq) in a unit of time.
    #[pyo3(signature = (q0, q1))]
    fn difference<'py>(
        &self,
        py: Python<'py>,
        q0: &Array<'py>,
        q1: &Array<'py>,
    ) -> PyResult<Array<'py>> {
        let request = Request {
            effects: &[],
            arguments: &[
                argument("q0", q0, self.counts.q),
                argument("q1", q1, self.counts.q),
            ],
            results: &[&[self.counts.v]],
        };
        let found = self.compute(py, Which::Difference, &request)?;
        Ok(only(found))
    }
}
