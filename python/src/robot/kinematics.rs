//! Configurations, poses, velocities, accelerations and Jacobians of bodies.

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use robot_dynamics_kernels::Which;

use super::{Array, Robot, argument, frame_of};
use crate::angles::Use;
use crate::effects::given as effects_of;

#[pymethods]
impl Robot {
    /// The configuration of rest, (nq,): zeros and quaternions of no rotation.
    fn neutral<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let none = numpy::PyArray1::<f64>::zeros(py, 0, false).into_any();
        self.one(
            py,
            Which::Neutral,
            &[],
            &[argument("q", &none, 0)],
            &[self.counts.q],
        )
    }

    /// J (…, 6, nv) of a body with v = J q̇, angular rows first; q (…, nq). ``frame``: "local",
    /// "world" or "local_world_aligned".
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
        self.one(
            py,
            Which::Jacobian { body, frame },
            &[],
            &[self.q(q)],
            &[6, self.counts.v],
        )
    }

    /// J̇ q̇ of a body, (…, 6), rad/s² and m/s²: what `jacobian` leaves of the derivative of v = J
    /// q̇ without q̈; q (…, nq), q̇ (…, nv). In the frames "local" and "world" it is the spatial
    /// acceleration, as that of `kinematics` at q̈ = 0; in "local_world_aligned" its linear part is
    /// the acceleration of the body's origin, and that of `kinematics` is less by ω × v.
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
        self.one(
            py,
            Which::BiasAcceleration { body, frame },
            &[],
            &[self.q(q), self.v("qd", qd)],
            &[6],
        )
    }

    /// Rotation matrices (…, bodies, 3, 3) from each body's frame to the base's, and positions (…,
    /// bodies, 3), m; q (…, nq).
    #[pyo3(signature = (q))]
    fn poses<'py>(&self, py: Python<'py>, q: &Array<'py>) -> PyResult<Bound<'py, PyTuple>> {
        self.several(
            py,
            Which::Poses,
            &[],
            &[self.q(q)],
            &[&[self.counts.bodies, 3, 3], &[self.counts.bodies, 3]],
        )
    }

    /// Spatial velocities (rad/s, m/s) and accelerations (rad/s², m/s²) of all bodies, each (…,
    /// bodies, 6), angular part first; q (…, nq), q̇ and q̈ (…, nv).
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
        self.several(
            py,
            Which::Kinematics { frame },
            &effects,
            &[self.q(q), self.v("qd", qd), self.v("qdd", qdd)],
            &[&[self.counts.bodies, 6], &[self.counts.bodies, 6]],
        )
    }

    /// Mass (…), kg, position (…, 3), m, and velocity (…, 3), m/s, of the centre of mass; q (…,
    /// nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, effects = None))]
    fn center_of_mass<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let effects = effects_of(effects)?;
        self.several(
            py,
            Which::CenterOfMass,
            &effects,
            &[self.q(q), self.v("qd", qd)],
            &[&[], &[3], &[3]],
        )
    }

    /// q ⊕ δ (…, nq): the configuration after a unit of time at the velocity δ (…, nv).
    #[pyo3(signature = (q, delta))]
    fn integrate<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        delta: &Array<'py>,
    ) -> PyResult<Array<'py>> {
        self.one(
            py,
            Which::Integrate,
            &[],
            &[self.q(q).by(Use::Integrate), self.step("delta", delta)],
            &[self.counts.q],
        )
    }

    /// q (…, nq) with quaternions of unit length, and angles of continuous joints within half a
    /// turn.
    ///
    /// Raises NoAttitude for a quaternion of length zero.
    fn normalise<'py>(&self, py: Python<'py>, q: &Array<'py>) -> PyResult<Array<'py>> {
        self.one(
            py,
            Which::Normalise,
            &[],
            &[self.q(q).by(Use::Normalise)],
            &[self.counts.q],
        )
    }

    /// q₁ ⊖ q₀ (…, nv): the velocity that leads from q₀ to q₁ (…, nq) in a unit of time.
    #[pyo3(signature = (q0, q1))]
    fn difference<'py>(
        &self,
        py: Python<'py>,
        q0: &Array<'py>,
        q1: &Array<'py>,
    ) -> PyResult<Array<'py>> {
        self.one(
            py,
            Which::Difference,
            &[],
            &[
                self.configuration("q0", q0).by(Use::Difference),
                self.configuration("q1", q1).by(Use::Difference),
            ],
            &[self.counts.v],
        )
    }
}
