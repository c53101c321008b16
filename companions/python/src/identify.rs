//! Identification of a robot's parameters from arrays as Python sees it.

use std::path::PathBuf;

use identification::files::recorded::Recorded;
use identification::files::robot::Robot;
use identification::files::run::{self, Options};
use numpy::ndarray::ArrayView1;
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use serde_json::Value;

use crate::error::Exception;

/// Masses, inertias and frictions of the robot of a URDF or MJCF from a recording of any motion:
/// time (n,), s, q (n, joints), rad or m, and tau (n, joints), N·m or N, all float64. Times may be
/// uneven, have gaps, and start anywhere. It computes without the interpreter's lock.
///
/// `joints` names the columns of q and tau; the robot's other joints are locked. Without it they
/// are the robot's joints.
/// `effects` are of "viscous", "coulomb", "armature", "load", "preslide", "offset", "stribeck" and
/// "asymmetric"; `width` is the speed below which Coulomb friction fades, rad/s or m/s, and torques
/// are compared up to `cutoff`, Hz, or the highest frequency that the rate allows. The dict is the
/// JSON of `cargo xtask identify`.
///
/// Raises IdentificationError; of a robot of more than eight joints, too.
#[pyfunction]
#[pyo3(signature = (robot_file, time, q, tau, *, joints = None, effects = vec!["viscous".into(), "coulomb".into(), "armature".into(), "offset".into()], width = 0.02, cutoff = None), text_signature = "(robot_file, time, q, tau, *, joints=None, effects=('viscous', 'coulomb', 'armature', 'offset'), width=0.02, cutoff=None)")]
#[allow(clippy::too_many_arguments, reason = "they are those of Python, most by name")]
pub fn identify<'py>(
    py: Python<'py>,
    robot_file: PathBuf,
    time: PyReadonlyArray1<'py, f64>,
    q: PyReadonlyArray2<'py, f64>,
    tau: PyReadonlyArray2<'py, f64>,
    joints: Option<Vec<String>>,
    effects: Vec<String>,
    width: f64,
    cutoff: Option<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let failed = |text: String| Exception::new(py, "IdentificationError", text).build();
    let kinds = effects.into_iter().map(|name| serde_json::from_value(Value::String(name)));
    let effects =
        kinds.collect::<Result<_, _>>().map_err(|error| failed(format!("effects: {error}")))?;
    if ![width, cutoff.unwrap_or(1.0)].iter().all(|x| *x > 0.0 && x.is_finite()) {
        return Err(failed("`width` and `cutoff` are positive".to_owned()));
    }
    let [q, tau] = [&q, &tau].map(|all| all.as_array().to_owned());
    let times = time.as_array().to_vec();
    let text = py.detach(|| {
        let robot = Robot::read(&robot_file, joints.clone().unwrap_or_default())?;
        let names = robot.joints();
        let place = |name| joints.as_ref().unwrap_or(&names).iter().position(|own| own == name);
        let order: Vec<usize> = names.iter().filter_map(place).collect();
        let all = |row: ArrayView1<'_, f64>| match row.len() == order.len() {
            true => order.iter().map(|&at| row[at]).collect(),
            // The number is refused.
            false => row.to_vec(),
        };
        let rows = q.rows().into_iter().zip(tau.rows());
        let rows = rows.map(|(q, tau)| (all(q), all(tau))).collect();
        let name = PathBuf::from("the arrays");
        let recorded = Recorded::of(&name, times, rows)?;
        let options = Options { effects, width, cutoff, hold_out: 0.3 };
        let found = run::identify(&robot, (&name, &recorded), None, &options)?;
        Ok::<_, identification::files::error::Error>(serde_json::to_string(&found)?)
    });
    let text = text.map_err(|error| failed(error.to_string()))?;
    py.import("json")?.call_method1("loads", (text,))
}
