//! Kinematic loops as Python sees them: joints that close them, and a robot with loops.

use dynamics_core::loops::{BodyFrame, LoopJoint, Moving, SINGULAR};
use dynamics_core::model::{BASE, Joint};
use pyo3::prelude::*;
use robot_dynamics_kernels::Which;
use robot_dynamics_kernels::loops::{AnyLoops, MOST_LOOPS};
use robot_dynamics_kernels::model::number;

use robot_import::number::Attitude;

use crate::angles::Use;
use crate::arrays::Argument;
use crate::effects::given as effects_of;
use crate::error::{Exception, wanted};
use crate::methods::{Machine, methods};
use crate::robot::given::whole;
use crate::robot::{Array, Robot, argument};

/// A joint that closes a loop: its name, its kind, the two bodies by name or number, None being the
/// base, the frames on them, and its axis in these frames.
///
/// ``kind``: "revolute", "prismatic", "cylindrical", "planar", "spherical" or "fixed". ``xyz``, m,
/// and ``rpy``, rad, are of the frames in those of the bodies; where the loop is closed, they
/// differ by a motion of the joint.
#[pyclass(frozen, module = "robot_dynamics", name = "LoopJoint")]
pub struct PyLoopJoint {
    name: String,
    joint: Joint<f64>,
    bodies: [Option<Py<PyAny>>; 2],
    frames: [[[f64; 3]; 2]; 2],
}

#[pymethods]
impl PyLoopJoint {
    #[new]
    #[pyo3(signature = (name, kind, bodies, xyz = [[0.0; 3]; 2], rpy = [[0.0; 3]; 2], axis = [0.0, 0.0, 1.0]), text_signature = "(name, kind, bodies, xyz=[[0.0] * 3] * 2, rpy=[[0.0] * 3] * 2, axis=[0.0, 0.0, 1.0])")]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = wanted)] name: String,
        #[pyo3(from_py_with = wanted)] kind: String,
        #[pyo3(from_py_with = wanted)] bodies: [Option<Py<PyAny>>; 2],
        #[pyo3(from_py_with = wanted)] xyz: [[f64; 3]; 2],
        #[pyo3(from_py_with = wanted)] rpy: [[f64; 3]; 2],
        #[pyo3(from_py_with = wanted)] axis: [f64; 3],
    ) -> PyResult<Self> {
        let joint = match kind.as_str() {
            "revolute" => Joint::revolute(axis),
            "prismatic" => Joint::prismatic(axis),
            "cylindrical" => Joint::cylindrical(axis),
            "planar" => Joint::planar(),
            "spherical" => Joint::spherical(),
            "fixed" => Joint::fixed(),
            _ => {
                let text = format!(
                    "`{kind}` closes no loop: revolute, prismatic, cylindrical, planar, spherical, fixed"
                );
                return Err(refused(py, &name, text));
            }
        };
        let frames = [0, 1].map(|end| [xyz[end], rpy[end]]);
        Ok(Self { name, joint, bodies, frames })
    }

    /// The name of the loop.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }
}

/// Loops that cannot be described so.
fn refused(py: Python<'_>, name: &str, text: String) -> PyErr {
    let error = Exception::new(py, "LoopModelError", format!("`{name}`: {text}"));
    error.with("loop", name).build()
}

/// A robot with kinematic loops, of any joints.
///
/// ``joints`` close the loops: those of the MJCF's ``connect`` and ``weld`` if none are given.
/// ``actuated`` has the velocity coordinates with a motor, or the names of their joints: those of
/// the file, or all, if none are given. Within ``damped_below`` of a dead point of the motors
/// torques are damped. Shapes: nl is the number of directions that the loops constrain, na that of
/// actuated coordinates.
#[pyclass(frozen, module = "robot_dynamics", name = "Loops")]
pub struct PyLoops {
    robot: Py<Robot>,
    loops: AnyLoops,
    names: Vec<String>,
}

impl PyLoops {
    fn motors<'a, 'py>(&self, name: &'static str, given: &'a Array<'py>) -> Argument<'a, 'py> {
        argument(name, given, self.loops.motors())
    }
}

impl Machine for PyLoops {
    fn robot(&self) -> &Robot {
        self.robot.get()
    }
    fn names(&self) -> &[String] {
        &self.names
    }
}

#[pymethods]
impl PyLoops {
    #[new]
    #[pyo3(signature = (robot, joints = None, actuated = None, damped_below = None))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = wanted)] robot: Py<Robot>,
        #[pyo3(from_py_with = wanted)] joints: Option<Vec<Py<PyLoopJoint>>>,
        #[pyo3(from_py_with = wanted)] actuated: Option<Vec<Bound<'_, PyAny>>>,
        #[pyo3(from_py_with = wanted)] damped_below: Option<f64>,
    ) -> PyResult<Self> {
        let of = robot.get();
        let (mut names, mut all) = (Vec::new(), Vec::new());
        let of_file = joints.is_none();
        for joint in joints.iter().flatten() {
            let given = joint.get();
            let mut ends = [BodyFrame::new(BASE); 2];
            for (end, (body, [xyz, rpy])) in
                ends.iter_mut().zip(given.bodies.iter().zip(given.frames))
            {
                let body = match body {
                    Some(body) => of.body(body.bind(py))?,
                    None => BASE,
                };
                *end = BodyFrame::new(body).xyz(xyz).rpy(rpy);
            }
            all.push(LoopJoint::new(number(all.len()), given.joint, ends));
            names.push(given.name.clone());
        }
        for closed in of.loops().0.iter().filter(|_| of_file) {
            let joint = match closed.kind {
                robot_import::description::Kind::Fixed => Joint::fixed(),
                _ => Joint::spherical(),
            };
            let ends = closed.ends.map(|(body, xyz, attitude)| {
                let frame = BodyFrame::new(body.unwrap_or(BASE)).xyz(xyz);
                match attitude {
                    Attitude::QuarterTurns(turns) => frame.quarter_turns(turns),
                    Attitude::Rpy(rpy) => frame.rpy(rpy),
                }
            });
            all.push(LoopJoint::new(number(all.len()), joint, ends));
            names.push(closed.name.clone());
        }
        if all.is_empty() || all.len() > MOST_LOOPS {
            let text = format!("{} loops: at least 1, at most {MOST_LOOPS}", all.len());
            return Err(refused(py, of.label(), text));
        }
        let damped_below = damped_below.unwrap_or(SINGULAR);
        if !(0.0..=1.0).contains(&damped_below) {
            let text = format!("damped_below is {damped_below}: from 0 to 1");
            return Err(refused(py, of.label(), text));
        }
        let actuated = match actuated {
            Some(given) => {
                let mut all = Vec::new();
                for one in given {
                    all.extend(of.coordinates_of(&one)?);
                }
                all
            }
            None if of_file => of.loops().1.to_vec(),
            None => (0..of.counts.v).collect(),
        };
        let loops = AnyLoops::of(&of.double, of.counts, &all, &actuated, damped_below);
        let loops = loops.map_err(|error| {
            let named = error.name.parse().ok().and_then(|i: usize| names.get(i));
            let name = named.map_or(of.label(), String::as_str);
            let text = error.to_string();
            let problem = text.split_once("`: ").map_or(&*text, |(_, problem)| problem);
            refused(py, name, problem.to_owned())
        })?;
        Ok(Self { robot, loops, names })
    }

    /// The names of the loops.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.names.clone()
    }
    /// The actuated coordinates, as indices in q̇.
    #[getter]
    fn actuated(&self) -> Vec<usize> {
        self.loops.actuated.clone()
    }
    /// The number of directions that the loops constrain.
    #[getter]
    fn nl(&self) -> usize {
        self.loops.rows
    }

    /// q (…, nq) near a guess q (…, nq), rad and m, at which all loops are closed. ``moving``:
    /// "passive" coordinates, or "all".
    ///
    /// Raises LoopOpen with the loop that stays open.
    #[pyo3(signature = (q, moving = "passive"))]
    fn assemble<'py>(&self, py: Python<'py>, q: &Array<'py>, moving: &str) -> PyResult<Array<'py>> {
        let moving = match moving {
            "passive" => Moving::Passive,
            "all" => Moving::All,
            _ => {
                let text = format!("moving is `{moving}`: \"passive\" or \"all\"");
                return Err(refused(py, self.robot.get().label(), text));
            }
        };
        let which = Which::Assemble { loops: &self.loops, moving };
        let q = [self.q("q", q).by(Use::Numbers)];
        self.one(py, which, &[], &q, &[&[self.robot().counts.q]])
    }

    /// Forward dynamics: q̈ (…, nv), rad/s² or m/s², the forces λ of the loops (…, nl), N·m and N,
    /// and the rank of K (…); for q (…, nq), q̇ (…, nv) and the torques of the motors (…, na), N·m
    /// or N. ``stabilisation``: of errors of position, 1/s², and of velocity, 1/s, K q̈ = k −
    /// velocity K q̇ − position φ.
    ///
    /// Raises NotPositiveDefinite and NotFinite. Scenes have Inertia and Coriolis, and no friction
    /// of gears.
    #[pyo3(signature = (q, qd, tau, effects = None, stabilisation = [0.0, 0.0]), text_signature = "($self, q, qd, tau, effects=None, stabilisation=[0.0, 0.0])")]
    fn forward_dynamics<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        tau: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
        #[pyo3(from_py_with = wanted)] stabilisation: [f64; 2],
    ) -> PyResult<Array<'py>> {
        let (loops, effects) = (&self.loops, effects_of(effects)?);
        whole(py, &effects)?;
        let given = [self.q("q", q), self.v("qd", qd), self.motors("tau", tau)];
        let which = Which::LoopForward { loops, stabilisation };
        let results: &[&[usize]] = &[&[self.robot().counts.v], &[loops.rows], &[]];
        self.several(py, which, &effects, &given, results)
    }
}

methods! {
    PyLoops, of => (loops, v, a, l) = (&of.loops, of.robot().counts.v, of.loops.motors(), of.loops.rows);

    /// The constraints K q̈ = k at q (…, nq) and q̇ (…, nv): K (…, nl, nv), k (…, nl), rad/s² and
    /// m/s², and the errors of position, rad and m, and velocity K q̇, rad/s and m/s, each (…, nl).
    /// Rows of a loop are those of rotations before those of translations, along the successor's
    /// frame.
    constraints(q: q, qd: v) = several(LoopConstraints { loops }): [l, v], [l], [l], [l];

    /// G (…, nv, na) with q̇ = G ẏ of the rates ẏ of the motors, at q (…, nq) of closed loops, and
    /// the number of degrees of freedom (…). Columns of motors that are redundant are zero.
    ///
    /// Raises LoopOpen, and UnderActuated where a coordinate moves with all motors held.
    coordinate_map(q: q) = several(CoordinateMapOf { loops }): [v, a], [];

    /// The numbers of degrees of freedom at q (…, nq) of closed loops, and at configurations near
    /// by, each (…): they differ at a change point.
    mobility(q: q) = several(MobilityOf { loops }): [], [];

    /// Inverse dynamics: the torques of the motors (…, na), N·m or N, q̇ and q̈ of all coordinates
    /// (…, nv), the forces λ of the loops (…, nl), N·m and N, and how many motors are redundant
    /// (…), −1 where they are near a dead point and torques are damped; for q (…, nq) of closed
    /// loops, and the rates and accelerations of the motors, (…, na).
    ///
    /// Raises LoopOpen, UnderActuated and NotFinite. Scenes have Inertia and Coriolis, and no
    /// friction of gears.
    inverse_dynamics(q: q, yd: motors, ydd: motors; under effects whole) = several(LoopInverse { loops }): [a], [v], [v], [l], [];
}
