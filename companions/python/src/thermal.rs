//! Limits of torque by the motors' temperatures as Python sees them.

use motion_control::limits::ConfigParameter::{ThermalMotor, ThermalTorque};
use motion_control::limits::{ConfigError, SafetyLimits};
use motion_control::safety::{ThermalConfig, ThermalLimit, ThermalState, ThermalStatus};
use numpy::{IntoPyArray, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::arrays::{arrays_of, dtype};
use crate::error::{Exception, wanted};
use crate::robot::{Array, argument};

/// The most joints: as many as the shortest block of the library has ticks, so that the limits of
/// fewer are those of firmware.
const MOST: usize = 32;

/// Limits of torque that keep the windings of motors below their greatest temperature, as firmware
/// has them, in float64: the peak while a motor is cold, the continuous torque when it is as hot
/// as it may be.
///
/// tick, s; of each joint, from data sheets and behind the gear: the torque that may last and that
/// of a cold motor, N·m or N, the time constants of winding and motor, s, the share of the thermal
/// resistance from winding to housing in that to the ambient (1 for I²t alone), the greatest
/// temperature of the winding, °C; the greatest temperature of the ambient, °C; and `saved` of
/// limits so many seconds before, else the motors are as hot as they may be.
#[pyclass(module = "robot_dynamics", name = "ThermalLimit")]
pub struct PyThermalLimit {
    limit: ThermalLimit<f64, MOST>,
    joints: usize,
}

/// A motor that the library refuses.
fn refused(py: Python<'_>, joint: Option<usize>, text: &str) -> PyErr {
    let place = joint.map_or(String::new(), |joint| format!("joint {joint}: "));
    Exception::new(py, "MotorError", place + text).with("joint", joint).build()
}

impl PyThermalLimit {
    /// The first numbers, of the joints that there are.
    fn own(&self, values: &[f64; MOST]) -> Vec<f64> {
        values[..self.joints].to_vec()
    }

    fn joint(&self, py: Python<'_>, joint: usize) -> PyResult<usize> {
        let text = format!("there are {} joints", self.joints);
        (joint < self.joints).then_some(joint).ok_or_else(|| {
            Exception::new(py, "UnknownCoordinate", text).with("coordinate", joint).build()
        })
    }
}

#[pymethods]
impl PyThermalLimit {
    #[new]
    #[pyo3(signature = (tick, continuous, peak, winding_time, housing_time, share, hottest, ambient, saved = None, off = 0.0))]
    #[allow(clippy::too_many_arguments, reason = "the numbers of data sheets")]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = wanted)] tick: f64,
        #[pyo3(from_py_with = wanted)] continuous: Vec<f64>,
        #[pyo3(from_py_with = wanted)] peak: Vec<f64>,
        #[pyo3(from_py_with = wanted)] winding_time: Vec<f64>,
        #[pyo3(from_py_with = wanted)] housing_time: Vec<f64>,
        #[pyo3(from_py_with = wanted)] share: Vec<f64>,
        #[pyo3(from_py_with = wanted)] hottest: Vec<f64>,
        #[pyo3(from_py_with = wanted)] ambient: f64,
        #[pyo3(from_py_with = wanted)] saved: Option<(Vec<f64>, Vec<f64>)>,
        #[pyo3(from_py_with = wanted)] off: f64,
    ) -> PyResult<Self> {
        let joints = continuous.len();
        let lists = [&continuous, &peak, &winding_time, &housing_time, &share, &hottest];
        let saved_lists = saved.iter().flat_map(|(winding, housing)| [winding, housing]);
        let fits = lists.into_iter().chain(saved_lists).all(|list| list.len() == joints);
        if !fits || !(1..=MOST).contains(&joints) {
            let text = format!("lists of numbers for 1 to {MOST} joints, all of one length");
            return Err(refused(py, None, &text));
        }
        // The places beyond the joints have cold motors like the last one.
        let [continuous, peak, winding_time, housing_time, share, hottest] =
            lists.map(|list| std::array::from_fn(|i| list[i.min(joints - 1)]));
        let most = [f64::INFINITY; MOST];
        let gate = SafetyLimits { torque: most, rate: most, speed: most, lower: most, upper: most };
        let limit = ThermalLimit::try_new(
            ThermalConfig {
                tick,
                continuous,
                peak,
                winding_time,
                housing_time,
                share,
                hottest,
                ambient,
            },
            &gate,
        );
        let limit = limit.map_err(|error| {
            let joint = match error {
                ConfigError::OutOfRange {
                    parameter: ThermalTorque { joint } | ThermalMotor { joint },
                } => Some(joint),
                _ => None,
            };
            refused(py, joint, &error.to_string())
        })?;
        let (winding, housing) =
            saved.unwrap_or_else(|| [(); 2].map(|()| vec![f64::NAN; joints]).into());
        let [winding, housing] = [winding, housing]
            .map(|list| std::array::from_fn(|i| list.get(i).copied().unwrap_or(0.0)));
        Ok(Self { limit: limit.resumed(&ThermalState { winding, housing }, off), joints })
    }

    /// Takes the torques that the drives have in a tick (n), N·m or N, or in one tick after the
    /// other (…, n), and returns the limits after each.
    fn update<'py>(&mut self, py: Python<'py>, torque: &Array<'py>) -> PyResult<Array<'py>> {
        let given = [argument("torque", torque, self.joints)];
        dtype(&given)?;
        let torque = &arrays_of::<f64>(&given)?.1[0];
        let mut limits = Vec::new();
        for torque in torque.as_slice()?.chunks_exact(self.joints) {
            let mut all = [0.0; MOST];
            all[..self.joints].copy_from_slice(torque);
            self.limit.update(&all);
            limits.extend(self.own(self.limit.torque()));
        }
        Ok(limits.into_pyarray(py).reshape(torque.shape())?.into_any())
    }

    /// A winding's temperature that its drive has measured, °C: it may raise that of the model.
    fn measured(
        &mut self,
        py: Python<'_>,
        #[pyo3(from_py_with = wanted)] joint: usize,
        #[pyo3(from_py_with = wanted)] celsius: f64,
    ) -> PyResult<()> {
        let joint = self.joint(py, joint)?;
        self.limit.measured(joint, celsius);
        Ok(())
    }

    /// How long a joint can hold a torque, N·m or N, before its limit is less, s; inf for ever.
    fn holds_for(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = wanted)] joint: usize,
        #[pyo3(from_py_with = wanted)] torque: f64,
    ) -> PyResult<f64> {
        let joint = self.joint(py, joint)?;
        Ok(self.limit.holds_for(joint, torque))
    }

    /// The greatest torques of the next tick, N·m or N.
    #[getter]
    fn torque(&self) -> Vec<f64> {
        self.own(self.limit.torque())
    }
    /// The temperatures of the windings by the model, °C.
    #[getter]
    fn celsius(&self) -> Vec<f64> {
        (0..self.joints).map(|joint| self.limit.celsius(joint)).collect()
    }
    /// The temperatures of windings and housings to be saved, as shares of the greatest rise.
    #[getter]
    fn saved(&self) -> (Vec<f64>, Vec<f64>) {
        let ThermalState { winding, housing } = self.limit.state();
        (self.own(&winding), self.own(&housing))
    }
    /// "cool", "limited" or "hot", and the hottest joint that is limited, or None.
    #[getter]
    fn status(&self) -> (&'static str, Option<usize>) {
        match self.limit.status() {
            ThermalStatus::Cool => ("cool", None),
            ThermalStatus::Limited { joint } => ("limited", Some(joint)),
            ThermalStatus::Hot { joint } => ("hot", Some(joint)),
        }
    }
}
