//! Inverse, forward and hybrid dynamics, and the matrices that they need.

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use robot_dynamics_engines::Scene as EngineScene;
use robot_dynamics_kernels::Which;
use robot_dynamics_kernels::spec::Spec;

use super::{Array, Robot, frame_of, with_inertia, without_rotors};
use crate::effects::given as effects_of;
use crate::error::wanted;

#[pymethods]
impl Robot {
    /// Inverse dynamics: the torques (…, nv), N·m or N, for q (…, nq), q̇ and q̈ (…, nv). Equations
    /// (3) to (8) of Featherstone and Orin.
    #[pyo3(signature = (q, qd, qdd, effects = None, form = "core"))]
    fn rnea<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        qdd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
        form: &str,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let by = self.by(
            py,
            form,
            Which::Rnea { given: 3 },
            EngineScene::RigidBody,
            &effects,
        )?;
        self.one(
            py,
            by,
            &effects,
            &[self.q(q), self.v("qd", qd), self.v("qdd", qdd)],
            &[self.counts.v],
        )
    }

    /// The torques (…, nv), N·m or N, at q (…, nq) and q̇ (…, nv) without acceleration: C(q, q̇) q̇ + g(q) and the
    /// other effects.
    #[pyo3(signature = (q, qd, effects = None, form = "core"))]
    fn bias<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
        form: &str,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let effects: Vec<Spec> = effects
            .iter()
            .filter(|spec| !matches!(spec, Spec::Inertia))
            .cloned()
            .collect();
        let by = self.by(
            py,
            form,
            Which::Rnea { given: 2 },
            EngineScene::Bias,
            &effects,
        )?;
        self.one(
            py,
            by,
            &effects,
            &[self.q(q), self.v("qd", qd)],
            &[self.counts.v],
        )
    }

    /// The torques (…, nv), N·m or N, that hold the robot against gravity at q (…, nq). Of the
    /// effects only Gravity and loads act.
    #[pyo3(signature = (q, effects = None, form = "core"))]
    fn gravity<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
        form: &str,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let effects: Vec<Spec> = effects
            .iter()
            .filter(|spec| matches!(spec, Spec::Gravity(_) | Spec::Payload { .. }))
            .cloned()
            .collect();
        let by = self.by(
            py,
            form,
            Which::Rnea { given: 1 },
            EngineScene::Gravity,
            &effects,
        )?;
        self.one(py, by, &effects, &[self.q(q)], &[self.counts.v])
    }

    /// M q̈_r + C(q, q̇) q̇_r + g and the other effects, (…, nv): q (…, nq), q̇, q̈_r and q̇_r (…,
    /// nv).
    #[pyo3(signature = (q, qd, qdd, qd_r, effects = None))]
    fn rnea_two_velocities<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        qdd: &Array<'py>,
        qd_r: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        self.one(
            py,
            Which::RneaTwoVelocities,
            &effects,
            &[
                self.q(q),
                self.v("qd", qd),
                self.v("qdd", qdd),
                self.v("qd_r", qd_r),
            ],
            &[self.counts.v],
        )
    }

    /// M(q), the joint-space inertia matrix (…, nv, nv), kg·m² or kg, with the motors' `Armature`;
    /// q (…, nq).
    #[pyo3(signature = (q, effects = None))]
    fn crba<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        self.one(
            py,
            Which::Crba,
            &effects,
            &[self.q(q)],
            &[self.counts.v, self.counts.v],
        )
    }

    /// Forward dynamics by articulated bodies: q̈ (…, nv), rad/s² or m/s², for q (…, nq), q̇ and τ
    /// (…, nv).
    #[pyo3(signature = (q, qd, tau, effects = None))]
    fn aba<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        tau: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        with_inertia(py, &effects)?;
        self.one(
            py,
            Which::Aba,
            &effects,
            &[self.q(q), self.v("qd", qd), self.v("tau", tau)],
            &[self.counts.v],
        )
    }

    /// Forward dynamics by M and its factors: q̈ (…, nv), rad/s² or m/s², for q (…, nq), q̇ and τ
    /// (…, nv).
    #[pyo3(signature = (q, qd, tau, effects = None))]
    fn forward_dynamics<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        tau: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        with_inertia(py, &effects)?;
        self.one(
            py,
            Which::ForwardDynamics,
            &effects,
            &[self.q(q), self.v("qd", qd), self.v("tau", tau)],
            &[self.counts.v],
        )
    }

    /// Forward dynamics by M and its factors, with the error that rounding leaves: q̈ and its
    /// estimated error, each (…, nv), rad/s² or m/s², for q (…, nq), q̇ and τ (…, nv). It says
    /// whether float32 serves for a robot and a state.
    #[pyo3(signature = (q, qd, tau, effects = None))]
    fn forward_dynamics_with_error<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        tau: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let effects = effects_of(effects)?;
        with_inertia(py, &effects)?;
        self.several(
            py,
            Which::ForwardWithError,
            &effects,
            &[self.q(q), self.v("qd", qd), self.v("tau", tau)],
            &[&[self.counts.v], &[self.counts.v]],
        )
    }

    /// Torques and accelerations, each (…, nv), where of each coordinate one is given: its torque,
    /// or, where ``accelerated`` is not zero, its acceleration. q (…, nq), q̇, given and
    /// accelerated (…, nv).
    #[pyo3(signature = (q, qd, given, accelerated, effects = None))]
    fn hybrid_dynamics<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        given: &Array<'py>,
        accelerated: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let effects = effects_of(effects)?;
        with_inertia(py, &effects)?;
        self.several(
            py,
            Which::Hybrid,
            &effects,
            &[
                self.q(q),
                self.v("qd", qd),
                self.v("given", given),
                self.v("accelerated", accelerated),
            ],
            &[&[self.counts.v], &[self.counts.v]],
        )
    }

    /// What of the motors' torques τ (…, nv) arrives behind the friction of the gears
    /// (`LoadFriction`), (…, nv).
    #[pyo3(signature = (q, qd, tau, effects = None))]
    fn transmitted_torque<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        tau: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        self.one(
            py,
            Which::Transmitted,
            &effects,
            &[self.q(q), self.v("qd", qd), self.v("tau", tau)],
            &[self.counts.v],
        )
    }

    /// C(q, q̇) (…, nv, nv), of Christoffel's symbols; q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, effects = None))]
    fn coriolis_matrix<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        self.one(
            py,
            Which::CoriolisMatrix,
            &effects,
            &[self.q(q), self.v("qd", qd)],
            &[self.counts.v, self.counts.v],
        )
    }

    /// Λ⁻¹ = J M⁻¹ Jᵀ of a body, (…, 6, 6), by propagation of forces; q (…, nq).
    #[pyo3(signature = (q, body, frame = "local", effects = None))]
    fn osim_inverse<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        body: &Bound<'py, PyAny>,
        frame: &str,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let body = self.body(body)?;
        let frame = frame_of(py, frame)?;
        let effects = effects_of(effects)?;
        without_rotors(py, &effects)?;
        self.one(
            py,
            Which::OsimInverse { body, frame },
            &effects,
            &[self.q(q)],
            &[6, 6],
        )
    }

    /// J (…, 6, nv), J M⁻¹ (…, 6, nv), Λ⁻¹ and Λ (…, 6, 6) of a body, Λ damped by ``damping``
    /// relative to the largest eigenvalue of Λ⁻¹ where it is nearly singular; q (…, nq).
    #[pyo3(signature = (q, body, frame = "local", effects = None, damping = 1e-6))]
    fn operational_space<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        body: &Bound<'py, PyAny>,
        frame: &str,
        effects: Option<&Bound<'py, PyAny>>,
        #[pyo3(from_py_with = wanted)] damping: f64,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let body = self.body(body)?;
        let frame = frame_of(py, frame)?;
        let effects = effects_of(effects)?;
        self.several(
            py,
            Which::OperationalSpaceOf {
                body,
                frame,
                damping,
            },
            &effects,
            &[self.q(q)],
            &[&[6, self.counts.v], &[6, self.counts.v], &[6, 6], &[6, 6]],
        )
    }
}
