//! Configurations, poses, velocities, accelerations and Jacobians of bodies.

use pyo3::prelude::*;
use robot_dynamics_kernels::Which;

use super::frames::only;
use super::{Array, Robot, argument, frame_of};
use crate::effects::given as effects_of;
use crate::methods::{Machine, methods};

#[pymethods]
impl Robot {
    /// The configuration of rest, (nq,): zeros and quaternions of no rotation.
    fn neutral<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let none = numpy::PyArray1::<f64>::zeros(py, 0, false).into_any();
        let q = [argument("q", &none, 0)];
        self.one(py, Which::Neutral, &[], &q, &[&[self.counts.q]])
    }

    /// Spatial velocities (rad/s, m/s) and accelerations (rad/s², m/s²) of all bodies, each (…,
    /// bodies, 6), angular part first, or of the body or frame ``at``, (…, 6); q (…, nq), q̇ and q̈
    /// (…, nv).
    #[pyo3(signature = (q, qd, qdd, frame = "local", effects = None, at = None))]
    #[allow(clippy::too_many_arguments, reason = "arguments of an algorithm")]
    fn kinematics<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        qdd: &Array<'py>,
        frame: &str,
        effects: Option<&Bound<'py, PyAny>>,
        at: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let which = Which::Kinematics { frame: frame_of(py, frame)? };
        let effects = effects_of(effects)?;
        let (framed, body) = at.map(|at| self.at(at)).transpose()?.unzip();
        let of = framed.as_ref().and_then(Option::as_ref).map_or(self, |framed| framed.get());
        let given = [of.q("q", q), of.v("qd", qd), of.v("qdd", qdd)];
        let each = [of.counts.bodies, 6];
        let all = of.several(py, which, &effects, &given, &[&each, &each])?;
        body.map_or(Ok(all.clone()), |body| only(&all, body, [1, 1]))
    }

    /// Rotation matrices (…, bodies, 3, 3) from each body's frame to the base's, and positions (…,
    /// bodies, 3), m, or those of the body or frame ``at``, (…, 3, 3) and (…, 3); q (…, nq).
    #[pyo3(signature = (q, at = None))]
    fn poses<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        at: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let (framed, body) = at.map(|at| self.at(at)).transpose()?.unzip();
        let of = framed.as_ref().and_then(Option::as_ref).map_or(self, |framed| framed.get());
        let bodies = of.counts.bodies;
        let results: &[&[usize]] = &[&[bodies, 3, 3], &[bodies, 3]];
        let all = of.several(py, Which::Poses, &[], &[of.q("q", q)], results)?;
        body.map_or(Ok(all.clone()), |body| only(&all, body, [2, 1]))
    }
}

methods! {
    Robot, robot => (v, nq, bodies) = (robot.counts.v, robot.counts.q, robot.counts.bodies);

    /// J (…, 6, nv) of a body with v = J q̇, angular rows first; q (…, nq). ``frame``: "local",
    /// "world" or "local_world_aligned".
    jacobian(q: q; at body, frame) = one(Jacobian { body, frame }): [6, v];

    /// J̇ q̇ of a body, (…, 6), rad/s² and m/s²: what `jacobian` leaves of the derivative of v = J
    /// q̇ without q̈; q (…, nq), q̇ (…, nv). In the frames "local" and "world" it is the spatial
    /// acceleration, as that of `kinematics` at q̈ = 0; in "local_world_aligned" its linear part is
    /// the acceleration of the body's origin, and that of `kinematics` is less by ω × v.
    bias_acceleration(q: q, qd: v; at body, frame) = one(BiasAcceleration { body, frame }): [6];

    /// Mass (…), kg, position (…, 3), m, and velocity (…, 3), m/s, of the centre of mass; q (…,
    /// nq), q̇ (…, nv).
    center_of_mass(q: q, qd: v; under effects) = several(CenterOfMass): [], [3], [3];

    /// q ⊕ δ (…, nq): the configuration after a unit of time at the velocity δ (…, nv).
    integrate(q: q by Integrate, delta: step) = one(Integrate): [nq];

    /// q (…, nq) with quaternions of unit length, and angles of continuous joints within half a
    /// turn.
    ///
    /// Raises NoAttitude for a quaternion of length zero.
    normalise(q: q by Normalise) = one(Normalise): [nq];

    /// q₁ ⊖ q₀ (…, nv): the velocity that leads from q₀ to q₁ (…, nq) in a unit of time.
    difference(q0: q by Difference, q1: q by Difference) = one(Difference): [v];
}
