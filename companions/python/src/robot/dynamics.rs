//! Inverse, forward and hybrid dynamics, and the matrices that they need.

use pyo3::prelude::*;
use robot_dynamics_kernels::Which;
use robot_dynamics_kernels::spec::Spec;

use super::{Array, Robot, frame_of, with_inertia, without_rotors};
use crate::arrays::Argument;
use crate::effects::{RIGID_BODY, given as effects_of, with_own};
use crate::error::wanted;
use crate::methods::{Machine, methods};
use crate::request::By;

impl Robot {
    /// Inverse dynamics in a form, of q and as many derivatives as there are more arguments, under
    /// those of the effects that it keeps.
    fn inverse_dynamics<'py>(
        &self,
        py: Python<'py>,
        form: &str,
        effects: Option<&Bound<'py, PyAny>>,
        keeps: impl Fn(&Spec) -> bool,
        arguments: &[Argument<'_, 'py>],
    ) -> PyResult<Array<'py>> {
        let shape: &[&[usize]] = &[&[self.counts.v]];
        if effects.is_none() && arguments.len() == 3 && form == "core" {
            let which = Which::Rnea { given: 3, still: false };
            return self.one(py, which, &RIGID_BODY, arguments, shape);
        }
        let scene = with_own(effects)?;
        let mut effects: Vec<Spec> = scene.iter().filter(|spec| keeps(spec)).cloned().collect();
        let mut given = arguments.len();
        let mut by = self.by(py, form, given, &effects)?;
        // Few scenes have machine code of their own. Without Inertia, the acceleration is zero but
        // for motors; without Coriolis, the velocity but for joints.
        let has = |spec| effects.contains(&spec);
        let [inertia, coriolis] = [has(Spec::Inertia), has(Spec::Coriolis)];
        let turns =
            |spec: &Spec| matches!(spec, Spec::Armature { .. } | Spec::GyroscopicRotors { .. });
        let (mut joints, mut still) = (Vec::new(), false);
        if matches!(by, By::Model(_)) && coriolis && !inertia {
            if given < 3 || !effects.iter().any(turns) {
                given = given.min(2);
                effects.push(Spec::Inertia);
            }
        } else if inertia && !coriolis && !effects.iter().any(Spec::is_extra) {
            still = true;
            let whole =
                |spec: &Spec| turns(spec) || matches!(spec, Spec::Gravity(_) | Spec::Inertia);
            (effects, joints) = effects.into_iter().partition(whole);
            effects.push(Spec::Coriolis);
        }
        if matches!(by, By::Model(_)) {
            by = Which::Rnea { given, still }.into();
        }
        let mut tau = self.one(py, by, &effects, arguments, shape)?;
        if !joints.is_empty() {
            let which = Which::Rnea { given: 2, still: false };
            tau = tau.add(self.one(py, which, &joints, arguments, shape)?)?;
        }
        // Gravity has no velocities.
        match if arguments.len() > 1 { scene.own_torque(py, arguments)? } else { None } {
            Some(own) => tau.add(own),
            None => Ok(tau),
        }
    }

    /// Forward dynamics of q, q̇ and τ.
    fn accelerations<'py>(
        &self,
        py: Python<'py>,
        which: Which<'static>,
        [q, qd, tau]: [&Array<'py>; 3],
        effects: Option<&Array<'py>>,
    ) -> PyResult<Array<'py>> {
        let scene = with_own(effects)?;
        with_inertia(py, &scene)?;
        let mut arguments = [self.q("q", q), self.v("qd", qd), self.v("tau", tau)];
        let own = scene.own_torque(py, &arguments)?;
        let rest =
            own.map(|own| PyModule::import(py, "numpy")?.call_method1("subtract", (tau, own)));
        let rest = rest.transpose()?;
        arguments[2] = self.v("tau", rest.as_ref().unwrap_or(tau));
        self.one(py, which, &scene, &arguments, &[&[self.counts.v]])
    }
}

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
        let given = [self.q("q", q), self.v("qd", qd), self.v("qdd", qdd)];
        self.inverse_dynamics(py, form, effects, |_| true, &given)
    }

    /// The torques (…, nv), N·m or N, at q (…, nq) and q̇ (…, nv) without acceleration: C(q, q̇)
    /// q̇ + g(q) and the other effects.
    #[pyo3(signature = (q, qd, effects = None, form = "core"))]
    fn bias<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
        form: &str,
    ) -> PyResult<Array<'py>> {
        let keeps = |spec: &Spec| !matches!(spec, Spec::Inertia);
        let given = [self.q("q", q), self.v("qd", qd)];
        self.inverse_dynamics(py, form, effects, keeps, &given)
    }

    /// The torques (…, nv), N·m or N, that hold the robot against gravity at q (…, nq). No other
    /// effects than Gravity and loads act.
    #[pyo3(signature = (q, effects = None, form = "core"))]
    fn gravity<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
        form: &str,
    ) -> PyResult<Array<'py>> {
        let keeps = |spec: &Spec| matches!(spec, Spec::Gravity(_) | Spec::Payload { .. });
        let given = [self.q("q", q)];
        self.inverse_dynamics(py, form, effects, keeps, &given)
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
        effects: Option<&Array<'py>>,
    ) -> PyResult<Array<'py>> {
        self.accelerations(py, Which::Aba, [q, qd, tau], effects)
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
        effects: Option<&Array<'py>>,
    ) -> PyResult<Array<'py>> {
        self.accelerations(py, Which::ForwardDynamics, [q, qd, tau], effects)
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
    ) -> PyResult<Array<'py>> {
        let ((framed, body), frame, v) = (self.at(body)?, frame_of(py, frame)?, self.counts.v);
        let of = framed.as_ref().map_or(self, |framed| framed.get());
        let which = Which::OperationalSpaceOf { body, frame, damping };
        let results: &[&[usize]] = &[&[6, v], &[6, v], &[6, 6], &[6, 6]];
        of.several(py, which, &effects_of(effects)?, &[of.q("q", q)], results)
    }
}

methods! {
    Robot, robot => (v, nq, bodies) = (robot.counts.v, robot.counts.q, robot.counts.bodies);

    /// Inverse dynamics with the wrenches in joints: the torques (…, nv), N·m or N, and the wrench
    /// that the parent exerts on each body through its joint, (…, bodies, 6), couple and force,
    /// N·m and N, in the body's own frame; q (…, nq), q̇ and q̈ (…, nv). That of a body beyond a
    /// force sensor is what the sensor shows, but for its offset.
    rnea_and_wrenches(q: q, qd: v, qdd: v; under effects) = several(RneaAndWrenches): [v], [bodies, 6];

    /// M q̈_r + C(q, q̇) q̇_r + g and the other effects, (…, nv): q (…, nq), q̇, q̈_r and q̇_r (…,
    /// nv).
    rnea_two_velocities(q: q, qd: v, qdd: v, qd_r: v; under effects) = one(RneaTwoVelocities): [v];

    /// M(q), the joint-space inertia matrix (…, nv, nv), kg·m² or kg, with the motors' `Armature`;
    /// q (…, nq).
    crba(q: q; under effects) = one(Crba): [v, v];

    /// Forward dynamics by M and its factors, with the error that rounding leaves: q̈ and its
    /// estimated error, each (…, nv), rad/s² or m/s², for q (…, nq), q̇ and τ (…, nv). It says
    /// whether float32 serves for a robot and a state.
    forward_dynamics_with_error(q: q, qd: v, tau: v; under effects with_inertia) = several(ForwardWithError): [v], [v];

    /// Torques and accelerations, each (…, nv), where of each coordinate one is given: its torque,
    /// or, where ``accelerated`` is not zero, its acceleration. q (…, nq), q̇, given and
    /// accelerated (…, nv).
    hybrid_dynamics(q: q, qd: v, given: v, accelerated: v; under effects with_inertia) = several(Hybrid): [v], [v];

    /// The part of the motors' torques τ (…, nv) that arrives behind the friction of the gears
    /// (`LoadFriction`), (…, nv).
    transmitted_torque(q: q, qd: v, tau: v; under effects) = one(Transmitted): [v];

    /// C(q, q̇) (…, nv, nv), of Christoffel's symbols; q (…, nq), q̇ (…, nv).
    coriolis_matrix(q: q, qd: v; under effects) = one(CoriolisMatrix): [v, v];

    /// Λ⁻¹ = J M⁻¹ Jᵀ of a body, (…, 6, 6), by propagation of forces; q (…, nq).
    osim_inverse(q: q; at body, frame; under effects without_rotors) = one(OsimInverse { body, frame }): [6, 6];
}
