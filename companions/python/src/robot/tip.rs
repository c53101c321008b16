//! Inverse kinematics of a robot whose joints have one coordinate each: positions for a pose of a
//! body, and joints whose motion is that of a tip.

use dynamics_core::algorithms::frame::{AnyFrame, Pose};
use dynamics_core::glam::{DMat3, DVec3};
use dynamics_core::spatial::Motion;
use motion_control::limits::MotionLimits;
use motion_control::motion::{PoseSolver, PoseSolverError, TipMotion, TipMotionConfig, TipStatus};
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::prelude::*;
use robot_dynamics_kernels::job::{Input, Job, Output};
use robot_dynamics_kernels::model::MOST_COORDINATES as MOST;
use robot_dynamics_kernels::{Scalar, Setting, Which};

use super::{Array, Robot};
use crate::error::{Exception, wanted};
use crate::goal::{Arrays, Lists, arrays, filled, limit, refused, state};

/// The iterations with which a start has led to its solution, or leads to none.
const FROM_ONE_START: u32 = 40;

/// A body of a robot.
struct Tip {
    robot: Py<Robot>,
    body: usize,
    joints: usize,
}

impl Tip {
    fn of(robot: &Bound<'_, Robot>, body: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (counts, (framed, body)) = (robot.get().counts, robot.get().at(body)?);
        if counts.q == counts.v {
            let robot = framed.unwrap_or_else(|| robot.clone().unbind());
            return Ok(Self { robot, body, joints: counts.v });
        }
        Err(refused(robot.py(), None, "inverse kinematics is for joints of one coordinate each"))
    }

    /// The pose of the body, and its Jacobian in the base's axes.
    fn kinematics(&self, q: &[f64; MOST]) -> (Pose<f64>, [Motion<f64>; MOST]) {
        let (robot, n) = (self.robot.get(), self.joints);
        let compute = |which, widths: &[usize]| {
            let mut results: Vec<Vec<f64>> = widths.iter().map(|&width| vec![0.0; width]).collect();
            let outputs = results.iter_mut().map(|data| Output { width: data.len(), data });
            let inputs = vec![Input { data: &q[..n], width: n }];
            let mut job = Job { inputs, outputs: outputs.collect(), rows: 1 };
            let setting = Setting { counts: robot.counts, effects: &[], body: &|_| usize::MAX };
            // Kinematics has a result in every state.
            let _ = f64::compute(&which, &robot.double, setting, &mut job);
            results
        };
        let bodies = robot.counts.bodies;
        let poses = compute(Which::Poses, &[9 * bodies, 3 * bodies]);
        let rot = DMat3::from_cols_slice(&poses[0][9 * self.body..]).transpose();
        let pose = Pose { rot, pos: DVec3::from_slice(&poses[1][3 * self.body..]) };
        let (body, frame) = (self.body, AnyFrame::LocalWorldAligned);
        let rows = compute(Which::Jacobian { body, frame }, &[6 * n]);
        let column = |j: usize| match j < n {
            true => motion(std::array::from_fn(|row| rows[0][row * n + j])),
            false => Motion::ZERO,
        };
        (pose, std::array::from_fn(column))
    }

    /// Limits of positions, of the robot if none are given.
    fn range(
        &self,
        py: Python<'_>,
        (lower, upper): (Option<Vec<f64>>, Option<Vec<f64>>),
    ) -> PyResult<[[f64; MOST]; 2]> {
        let robot = self.robot.get();
        let lower = lower.unwrap_or_else(|| robot.per_coordinate(|body| body.limits[0]));
        let upper = upper.unwrap_or_else(|| robot.per_coordinate(|body| body.limits[1]));
        Ok([filled(py, &lower, self.joints, 0.0)?, filled(py, &upper, self.joints, 0.0)?])
    }
}

fn motion([a, b, c, x, y, z]: [f64; 6]) -> Motion<f64> {
    Motion::new(DVec3::new(a, b, c), DVec3::new(x, y, z))
}

/// A pose of rows of a rotation, and of a position.
fn pose(py: Python<'_>, rotation: [[f64; 3]; 3], position: [f64; 3]) -> PyResult<Pose<f64>> {
    let rot = DMat3::from_cols_array_2d(&rotation).transpose();
    if (rot * rot.transpose()).abs_diff_eq(DMat3::IDENTITY, 1e-3) && rot.determinant() > 0.0 {
        return Ok(Pose { rot, pos: position.into() });
    }
    Err(refused(py, None, "the matrix is no rotation"))
}

/// A solver of inverse kinematics: positions of the joints for a pose of a body, in float64, by
/// Levenberg-Marquardt from several starts.
///
/// lower, upper: the ranges, rad or m, else those of the robot; length: at which a displacement
/// counts as much as a rotation, m, a third of the reach; tolerance: the greatest error, rad;
/// iterations: the most of all starts together.
#[pyclass(frozen, module = "robot_dynamics", name = "PoseSolver")]
pub struct PyPoseSolver {
    tip: Tip,
    solver: PoseSolver<f64, MOST>,
}

#[pymethods]
impl PyPoseSolver {
    #[new]
    #[pyo3(signature = (robot, body, lower = None, upper = None, length = 0.3, tolerance = 1e-9, iterations = 130))]
    #[allow(clippy::too_many_arguments, reason = "the numbers of the solver")]
    fn new(
        py: Python<'_>,
        robot: &Bound<'_, Robot>,
        body: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = wanted)] lower: Option<Vec<f64>>,
        #[pyo3(from_py_with = wanted)] upper: Option<Vec<f64>>,
        #[pyo3(from_py_with = wanted)] length: f64,
        #[pyo3(from_py_with = wanted)] tolerance: f64,
        #[pyo3(from_py_with = wanted)] iterations: u32,
    ) -> PyResult<Self> {
        let tip = Tip::of(robot, body)?;
        let [lower, upper] = tip.range(py, (lower, upper))?;
        let solver = PoseSolver { lower, upper, length, tolerance, iterations };
        Ok(Self { tip, solver })
    }

    /// Positions (joints), rad or m, at which the body has the rotation (3, 3) and the position
    /// (3), m, of `Robot.poses`: from `start`, else from the middle of the ranges, and then from
    /// others within the ranges
    ///
    /// Raises PoseNotReached, with the nearest positions, of a pose that is out of reach or nearly
    /// so, and MotionError of numbers that are not finite.
    #[pyo3(signature = (rotation, position, start = None))]
    fn solve<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = wanted)] rotation: [[f64; 3]; 3],
        #[pyo3(from_py_with = wanted)] position: [f64; 3],
        #[pyo3(from_py_with = wanted)] start: Option<Vec<f64>>,
    ) -> PyResult<Array<'py>> {
        let goal = pose(py, rotation, position)?;
        let start = match start {
            Some(start) => filled(py, &start, self.tip.joints, 0.0)?,
            None => self.solver.seed(0),
        };
        match self.solver.solve(&goal, &start, |q| self.tip.kinematics(q)) {
            Ok(found) => Ok(found.q[..self.tip.joints].to_vec().into_pyarray(py).into_any()),
            Err(PoseSolverError::NotReached(nearest)) => {
                let Motion { ang, lin } = nearest.error;
                let text = format!(
                    "no start has led to the pose: the nearest is off by {} rad and {} m",
                    ang.length(),
                    lin.length()
                );
                let error = Exception::new(py, "PoseNotReached", text);
                Err(error.with("q", nearest.q[..self.tip.joints].to_vec()).build())
            }
            Err(error) => Err(refused(py, None, &error.to_string())),
        }
    }

    /// All different positions (solutions, joints) that the first so many seeds lead to; those that
    /// differ by whole turns are one. A UR5e has up to eight.
    #[pyo3(signature = (rotation, position, starts = 200))]
    fn solutions<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = wanted)] rotation: [[f64; 3]; 3],
        #[pyo3(from_py_with = wanted)] position: [f64; 3],
        #[pyo3(from_py_with = wanted)] starts: u32,
    ) -> PyResult<Array<'py>> {
        let goal = pose(py, rotation, position)?;
        let robot = self.tip.robot.get();
        let iterations = self.solver.iterations.min(FROM_ONE_START);
        let solver = PoseSolver { iterations, ..self.solver };
        let same = |a: &Vec<f64>, b: &Vec<f64>| {
            let mut each = a.iter().zip(b).zip(&robot.positions);
            each.all(|((a, b), position)| match position.angle {
                true => (0.5 * (a - b)).sin().abs() < 1e-4,
                false => (a - b).abs() < 1e-4,
            })
        };
        let mut found: Vec<Vec<f64>> = Vec::new();
        for n in 0..starts {
            let solution = solver.solve(&goal, &solver.seed(n), |q| self.tip.kinematics(q));
            let q = solution.map(|solution| solution.q[..self.tip.joints].to_vec());
            let new = q.ok().filter(|q| !found.iter().any(|other| same(q, other)));
            found.extend(new);
        }
        let shape = [found.len(), self.tip.joints];
        Ok(found.concat().into_pyarray(py).reshape(shape)?.into_any())
    }
}

/// The reference of an arm whose tip is moved by a twist that is new in each tick, within limits of
/// position, velocity and acceleration of the joints, as firmware has it, in float64.
///
/// It rests at q, rad or m, with ticks of `tick` seconds; velocity, lower and upper are those of
/// the robot if none are given. damping, s, is about the time in which the tip comes to the end of
/// its reach; length, m, is a third of the reach; joints move towards the posture by posture_gain
/// per distance, 1/s, as far as the tip leaves them free.
#[pyclass(module = "robot_dynamics", name = "TipMotion")]
pub struct PyTipMotion {
    tip: Tip,
    motion: TipMotion<f64, MOST>,
}

#[pymethods]
impl PyTipMotion {
    #[new]
    #[pyo3(signature = (robot, body, q, tick, acceleration, velocity = None, lower = None, upper = None, damping = 0.01, length = 0.3, posture = None, posture_gain = 0.0))]
    #[allow(clippy::too_many_arguments, reason = "the numbers of the motion")]
    fn new(
        py: Python<'_>,
        robot: &Bound<'_, Robot>,
        body: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = wanted)] q: Vec<f64>,
        #[pyo3(from_py_with = wanted)] tick: f64,
        #[pyo3(from_py_with = wanted)] acceleration: Vec<f64>,
        #[pyo3(from_py_with = wanted)] velocity: Option<Vec<f64>>,
        #[pyo3(from_py_with = wanted)] lower: Option<Vec<f64>>,
        #[pyo3(from_py_with = wanted)] upper: Option<Vec<f64>>,
        #[pyo3(from_py_with = wanted)] damping: f64,
        #[pyo3(from_py_with = wanted)] length: f64,
        #[pyo3(from_py_with = wanted)] posture: Option<Vec<f64>>,
        #[pyo3(from_py_with = wanted)] posture_gain: f64,
    ) -> PyResult<Self> {
        let tip = Tip::of(robot, body)?;
        let of = |list: &[f64], rest| filled(py, list, tip.joints, rest);
        let [lower, upper] = tip.range(py, (lower, upper))?;
        let velocity =
            velocity.unwrap_or_else(|| robot.get().per_coordinate(|body| body.limits[2]));
        let [v, a] = [of(&velocity, 1.0)?, of(&acceleration, 1.0)?];
        let limits = std::array::from_fn(|j| MotionLimits { velocity: v[j], acceleration: a[j] });
        let posture = of(&posture.unwrap_or_else(|| q.clone()), 0.0)?;
        let config =
            TipMotionConfig { tick, lower, upper, limits, damping, length, posture, posture_gain };
        let motion = TipMotion::try_new(config, &of(&q, 0.0)?).map_err(|error| limit(py, error))?;
        Ok(Self { tip, motion })
    }

    /// Advances the reference by a tick, in which the tip moves by the twist (6), rad/s and m/s, in
    /// the base's axes. Returns "follows", "slowed", "limited" or, with a twist that is not finite,
    /// "stops", and the joint that slows or limits the tip, or None.
    fn step(
        &mut self,
        #[pyo3(from_py_with = wanted)] twist: [f64; 6],
    ) -> (&'static str, Option<usize>) {
        let (_, jacobian) = self.tip.kinematics(&self.motion.state().q);
        match self.motion.step(&jacobian, &motion(twist)) {
            TipStatus::Follows => ("follows", None),
            TipStatus::Slowed(joint) => ("slowed", Some(joint)),
            TipStatus::Limited(joint) => ("limited", Some(joint)),
            _ => ("stops", None),
        }
    }

    /// Begins again from a state (q, q̇, q̈) of the arm, after a fault or another motion.
    ///
    /// Raises MotionError of a state that is not finite.
    fn restart(
        &mut self,
        py: Python<'_>,
        #[pyo3(from_py_with = wanted)] start: Lists,
    ) -> PyResult<()> {
        let is_taken = self.motion.restart(&state(py, &start, self.tip.joints)?);
        is_taken.then_some(()).ok_or_else(|| refused(py, None, "the state is not finite"))
    }

    /// q, q̇ and q̈ of the reference, each (joints).
    #[getter]
    fn state<'py>(&self, py: Python<'py>) -> PyResult<Arrays<'py>> {
        arrays(py, &[*self.motion.state()], &[self.tip.joints])
    }
}
