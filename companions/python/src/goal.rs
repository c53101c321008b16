//! Goals that may change at any tick as Python sees them.

use dynamics_core::state::State;
use motion_control::limits::ConfigError;
use motion_control::limits::ConfigParameter::{JerkLimit, JointRange};
use motion_control::reference::{GoalError, JerkLimits, MovingGoal, Reference};
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::prelude::*;
use robot_dynamics_kernels::model::MOST_COORDINATES as MOST;

use crate::error::{Exception, wanted};
use crate::robot::Array;

/// Three lists: positions, velocities and accelerations.
pub type Lists = (Vec<f64>, Vec<f64>, Vec<f64>);
/// Three arrays of the same.
pub type Arrays<'py> = (Array<'py>, Array<'py>, Array<'py>);

/// The motion to a goal that may change at any tick, from any state, with limits of velocity,
/// acceleration and jerk, as firmware has it, in float64.
///
/// It rests at q, rad or m, with ticks of `tick` seconds; of each joint velocity, rad/s or m/s,
/// acceleration and jerk are the greatest. Joints arrive together, or earlier if they have to brake
/// as fast as they can.
#[pyclass(module = "robot_dynamics", name = "MovingGoal")]
pub struct PyMovingGoal {
    goal: MovingGoal<f64, MOST>,
    joints: usize,
}

/// Numbers that are refused, of a joint or of all.
pub fn refused(py: Python<'_>, joint: Option<usize>, text: &str) -> PyErr {
    Exception::new(py, "MotionError", text).with("joint", joint).build()
}

/// A limit that the library refuses.
pub fn limit(py: Python<'_>, error: ConfigError) -> PyErr {
    let (place, joint) = match error {
        ConfigError::OutOfRange { parameter: JerkLimit { joint } | JointRange { joint } } => {
            (format!("joint {joint}: "), Some(joint))
        }
        _ => (String::new(), None),
    };
    refused(py, joint, &format!("{place}{error}"))
}

/// A list for the joints that there are, with `rest` for those that there are not.
pub fn filled(py: Python<'_>, list: &[f64], joints: usize, rest: f64) -> PyResult<[f64; MOST]> {
    if list.len() == joints && (1..=MOST).contains(&joints) {
        return Ok(std::array::from_fn(|j| list.get(j).copied().unwrap_or(rest)));
    }
    let text = format!("{} numbers: expected one for each of {joints} joints", list.len());
    Err(refused(py, None, &text))
}

/// A state of the joints that there are.
pub fn state(py: Python<'_>, lists: &Lists, joints: usize) -> PyResult<State<f64, MOST, MOST>> {
    let of = |list: &[f64]| filled(py, list, joints, 0.0);
    Ok(State { q: of(&lists.0)?, qd: of(&lists.1)?, qdd: of(&lists.2)? })
}

/// Positions, velocities and accelerations of states: (…, joints).
pub fn arrays<'py>(
    py: Python<'py>,
    states: &[State<f64, MOST, MOST>],
    shape: &[usize],
) -> PyResult<Arrays<'py>> {
    let joints = shape[shape.len() - 1];
    let list = |of: fn(&State<f64, MOST, MOST>) -> &[f64; MOST]| {
        let all: Vec<f64> = states.iter().flat_map(|state| of(state)[..joints].to_vec()).collect();
        all.into_pyarray(py).reshape(shape).map(Bound::into_any)
    };
    Ok((list(|state| &state.q)?, list(|state| &state.qd)?, list(|state| &state.qdd)?))
}

#[pymethods]
impl PyMovingGoal {
    #[new]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = wanted)] q: Vec<f64>,
        #[pyo3(from_py_with = wanted)] tick: f64,
        #[pyo3(from_py_with = wanted)] velocity: Vec<f64>,
        #[pyo3(from_py_with = wanted)] acceleration: Vec<f64>,
        #[pyo3(from_py_with = wanted)] jerk: Vec<f64>,
    ) -> PyResult<Self> {
        let joints = q.len();
        let of = |list: &[f64]| filled(py, list, joints, 1.0);
        let [v, a, j] = [of(&velocity)?, of(&acceleration)?, of(&jerk)?];
        let limits =
            std::array::from_fn(|i| JerkLimits { velocity: v[i], acceleration: a[i], jerk: j[i] });
        let goal = MovingGoal::try_new(&filled(py, &q, joints, 0.0)?, limits, tick);
        Ok(Self { goal: goal.map_err(|error| limit(py, error))?, joints })
    }

    /// Moves the goal at a tick, rad or m: from the state there, or from one that is given (q, q̇,
    /// q̈), to rest at the goal. Returns the tick of the arrival.
    ///
    /// Raises MotionError of a goal that is not finite, or of an acceleration beyond its limit.
    #[pyo3(signature = (tick, goal, start = None))]
    fn set(
        &mut self,
        py: Python<'_>,
        #[pyo3(from_py_with = wanted)] tick: u32,
        #[pyo3(from_py_with = wanted)] goal: Vec<f64>,
        #[pyo3(from_py_with = wanted)] start: Option<Lists>,
    ) -> PyResult<u32> {
        let goal = filled(py, &goal, self.joints, 0.0)?;
        let arrival = match start {
            Some(start) => self.goal.set_from(tick, &state(py, &start, self.joints)?, &goal),
            None => self.goal.set(tick, &goal),
        };
        arrival.map_err(|error| {
            let joint = match error {
                GoalError::NotFinite { joint } | GoalError::Start { joint } => Some(joint),
                _ => None,
            };
            refused(py, joint, &error.to_string())
        })
    }

    /// q, q̇ and q̈, each (joints), in a tick, or (ticks, joints) in several.
    fn at<'py>(&self, py: Python<'py>, tick: &Bound<'py, PyAny>) -> PyResult<Arrays<'py>> {
        if let Ok(tick) = tick.extract() {
            return arrays(py, &[self.goal.at(tick)], &[self.joints]);
        }
        let ticks: Vec<u32> = wanted(tick)?;
        let states: Vec<_> = ticks.iter().map(|&tick| self.goal.at(tick)).collect();
        arrays(py, &states, &[states.len(), self.joints])
    }

    /// The tick of the arrival.
    #[getter]
    fn ticks(&self) -> u32 {
        self.goal.ticks()
    }
}
