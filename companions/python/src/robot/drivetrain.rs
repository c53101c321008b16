//! The methods for robots with elastic joints.

use pyo3::prelude::*;
use robot_dynamics_kernels::Which;

use super::given::elastic;
use super::{Array, Robot};
use crate::angles::Use;
use crate::effects::{given as effects_of, refused};
use crate::error::wanted;
use crate::methods::Machine;

#[pymethods]
impl Robot {
    /// Inverse dynamics with elastic joints: of each motor, reflected to the joint, its torque, N·m
    /// or N, position, rad or m, and velocity, rad/s or m/s, each (…, nv), for a motion of the
    /// links with four derivatives: q (…, nq), q̇, q̈, jerk, rad/s³ or m/s³, and snap (…, nv),
    /// rad/s⁴ or m/s⁴.
    ///
    /// The arguments of each joint, (nv,), are the stiffness of the transmission, N·m/rad or N/m,
    /// the inertia of the rotor, kg·m² or kg, and the viscous friction of the motor, N·m·s/rad or
    /// N·s/m, reflected. Effects act on the links; wrenches, rotors that spin, friction of gears
    /// and a moving base have no place.
    ///
    /// Raises MultiDofJoint for a joint of several coordinates.
    #[pyo3(signature = (q, qd, qdd, jerk, snap, stiffness, rotor, friction, effects = None))]
    #[allow(clippy::too_many_arguments, reason = "a trajectory with four derivatives")]
    fn elastic_inverse_dynamics<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        qdd: &Array<'py>,
        jerk: &Array<'py>,
        snap: &Array<'py>,
        #[pyo3(from_py_with = wanted)] stiffness: Vec<f64>,
        #[pyo3(from_py_with = wanted)] rotor: Vec<f64>,
        #[pyo3(from_py_with = wanted)] friction: Vec<f64>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        elastic(py, &effects)?;
        let refuse =
            |effect: &str, text: String| Err(refused(py, effect, format!("{effect}: {text}")));
        let v = self.counts.v;
        let joints = [&*stiffness, &*rotor, &*friction];
        for (name, values) in ["stiffness", "rotor", "friction"].iter().zip(joints) {
            let least = if *name == "stiffness" { f64::MIN_POSITIVE } else { 0.0 };
            if values.len() != v || !values.iter().all(|x| x.is_finite() && *x >= least) {
                let text = format!(
                    "{name} needs {v} numbers that are finite and not negative, and no stiffness of zero"
                );
                return refuse("ElasticJoints", text);
            }
        }
        self.several(
            py,
            Which::ElasticInverseDynamics { joints },
            &effects,
            &[
                self.q("q", q).by(Use::Numbers),
                self.v("qd", qd),
                self.v("qdd", qdd),
                self.v("jerk", jerk),
                self.v("snap", snap),
            ],
            &[&[v], &[v], &[v]],
        )
    }
}
