//! A robot as Python sees it: where it comes from, and what it is. The functions that it computes
//! are in the files of its own folder.

mod drivetrain;
mod dynamics;
mod factors;
pub mod frames;
pub mod given;
mod kinematics;
mod momentum;
pub mod pickled;
mod regressors;
pub mod said;
pub mod tip;

use std::collections::BTreeMap;
use std::path::PathBuf;

use dynamics_core::model::JointKind;
use numpy::PyArray1;
use pyo3::prelude::*;
use robot_import::loops::{self, Closed, Motors};
use robot_import::selection::Selection;
use robot_import::source;
use robot_import::tree::{Numbers, Tree};

use crate::angles::{self, Position, Positions, Use};
use crate::arrays::Argument;
use crate::costs::{self, Cost};
use crate::error::{Exception, of_import, of_model, wanted};
use crate::library;
use crate::methods::Machine;
use robot_dynamics_kernels::model::{Bodies, Counts, Models};
use robot_dynamics_kernels::spec::BodyRef;

use frames::{Frame, Framed, frames};
use given::{frame_of, with_inertia, without_rotors};
use said::Said;

/// A robot: a tree of bodies on joints.
///
/// ``Robot("ur5e")`` is a robot of the library, `robots()` lists their names; `Robot.from_file` and
/// `Robot.from_text` read URDF and MJCF. Units are SI: rad, m, kg, N·m, N.
///
/// Every method takes arrays of one state, such as q of shape (nq,), or of many, with any leading
/// axes, which broadcast as numpy's: (n, nq) and (nv,) give (n, nv). All arrays of a call are
/// float32 or all are float64, and so is the result; lists and integers have the type of the arrays
/// beside them, else float64. In float32 the results have the bits of
/// the same algorithm (`Core`) in firmware. Batches release Python's lock and use all cores.
///
/// q has the coordinates of each joint in the order of the bodies: an angle or a length; of a ball
/// joint a quaternion (x, y, z, w), of a free joint that and then the position; q̇ of a free joint
/// has the angular velocity first, both in the body's axes.
///
/// Angles may have any size. Sines are computed to ±10⁴ rad in float32 and to ±10⁵ rad in float64;
/// of an angle beyond, whole turns are subtracted in float64 before the call. AngleError names joint
/// and state where turns matter: at joints with a spring, end stops or cogging, in `elastic_inverse_dynamics`
/// and `Loops.assemble`, which return positions, and in linkages.
///
/// A state with a NaN or an infinite number has NaN in its own row of the results; the others of
/// its batch are computed.
#[pyclass(frozen, module = "robot_dynamics", name = "Robot")]
pub struct Robot {
    pub single: Models<f32>,
    pub double: Models<f64>,
    pub counts: Counts,
    name: String,
    library: Option<&'static str>,
    bodies: Vec<BodyInfo>,
    /// The places of its joints' positions in q.
    pub positions: Vec<Position>,
    /// The velocity coordinates that are rates of attitudes.
    rates: Vec<Position>,
    /// The bodies as the library describes them.
    pub described: Bodies,
    /// The numbers that were read, of a file.
    read: Option<Read>,
    /// The frames that are fixed to its bodies.
    frames: Vec<Frame>,
    framed: Framed,
}

/// The numbers that were read of a file.
#[derive(serde::Serialize, serde::Deserialize)]
pub struct Read {
    tree: Tree,
    /// The loops that the file closes.
    closed: Vec<Closed>,
    /// The coordinates that its motors drive, of a robot with loops.
    actuated: Vec<usize>,
    /// The remarks of the importer.
    said: Said,
    frames: Vec<Frame>,
}

/// The keywords of `Robot.from_file`: base, tip, joints, without, lock and free_base.
type Selected =
    (Option<String>, Option<String>, Vec<String>, Vec<String>, Option<BTreeMap<String, f64>>, bool);

/// The properties of a body, its joint's among them.
#[derive(Clone)]
struct BodyInfo {
    name: String,
    joint: String,
    kind: JointKind,
    parent: Option<usize>,
    limits: [f64; 4],
    damping: f64,
    friction: f64,
    armature: f64,
    spring: [f64; 2],
}

impl BodyInfo {
    /// A body on a joint without limits.
    fn of(name: &str, joint: &str) -> Self {
        Self {
            name: name.to_owned(),
            joint: joint.to_owned(),
            kind: JointKind::Fixed,
            parent: None,
            limits: [f64::NEG_INFINITY, f64::INFINITY, f64::INFINITY, f64::INFINITY],
            damping: 0.0,
            friction: 0.0,
            armature: 0.0,
            spring: [0.0; 2],
        }
    }
}

impl Robot {
    fn of(
        py: Python<'_>,
        name: String,
        library: Option<&'static str>,
        described: Bodies,
        mut bodies: Vec<BodyInfo>,
    ) -> PyResult<Self> {
        let names: Vec<String> = bodies.iter().map(|body| body.name.clone()).collect();
        let refused = |error| of_model(py, &error, &names);
        for ((body, kind), parent) in
            bodies.iter_mut().zip(described.kinds()).zip(described.parents())
        {
            (body.kind, body.parent) = (kind, parent);
        }
        let (positions, rates) = angles::of_joints(described.kinds());
        Ok(Self {
            positions,
            rates,
            single: described.models().map_err(refused)?,
            double: described.models().map_err(refused)?,
            counts: described.counts(),
            name,
            library,
            bodies,
            described,
            read: None,
            frames: Vec::new(),
            framed: Framed::default(),
        })
    }

    fn read(
        py: Python<'_>,
        described: robot_import::error::Result<robot_import::description::Description>,
        (base, tip, joints, without, lock, free_base): Selected,
        exact: bool,
    ) -> PyResult<Self> {
        let selection = Selection {
            base,
            tip,
            without,
            joints,
            lock: lock.unwrap_or_default().into_iter().collect(),
            free_base,
        };
        let numbers = match exact {
            true => Numbers::Exact,
            false => Numbers::AsGiven,
        };
        let read = described.and_then(|robot| {
            let selected = selection.of(&robot)?;
            let tree = Tree::of(&robot, &selected, numbers)?;
            let (closed, mut notes) = loops::closed(&robot, &tree);
            let motors = Motors::of(&tree, &closed, &[])?;
            notes.extend(motors.advice);
            let said = Said::of(&robot, (&selection, &selected), &tree, notes);
            let frames = frames(&tree, robot.links.iter().map(|link| &*link.name));
            Ok(Read { tree, closed, actuated: motors.actuated, said, frames })
        });
        Self::of_file(py, read.map_err(|error| of_import(py, &error))?)
    }

    fn of_file(py: Python<'_>, read: Read) -> PyResult<Self> {
        let tree = &read.tree;
        let bodies = tree.bodies.iter().map(|body| {
            let [lower, upper] = body.limits.position.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
            let [velocity, effort] = [body.limits.velocity, body.limits.effort]
                .map(|limit| limit.unwrap_or(f64::INFINITY));
            BodyInfo {
                limits: [lower, upper, velocity, effort],
                damping: body.damping,
                friction: body.friction,
                armature: body.armature,
                spring: body.spring,
                ..BodyInfo::of(&body.name, &body.joint)
            }
        });
        let bodies = bodies.collect();
        let robot = Self::of(py, tree.name.clone(), None, Bodies::of(tree), bodies)?;
        Ok(Self { frames: read.frames.clone(), read: Some(read), ..robot })
    }

    /// The loops of the file, and the coordinates that its motors drive.
    pub fn loops(&self) -> (&[Closed], &[usize]) {
        let read = self.read.as_ref();
        read.map_or((&[], &[]), |read| (&read.closed, &read.actuated))
    }

    /// The name of the robot, for errors.
    pub fn label(&self) -> &str {
        &self.name
    }

    /// A velocity coordinate by its number, or all of a joint by its name.
    pub fn coordinates_of(&self, given: &Bound<'_, PyAny>) -> PyResult<Vec<usize>> {
        let found: Vec<usize> = match (given.extract(), given.extract::<String>()) {
            (Ok(number), _) if number < self.counts.v => vec![number],
            (_, Ok(name)) => {
                (0..self.counts.v).filter(|&coordinate| self.joint_of(coordinate) == name).collect()
            }
            _ => Vec::new(),
        };
        if !found.is_empty() {
            return Ok(found);
        }
        let text =
            format!("the robot has no velocity coordinate {given}: it has {}", self.counts.v);
        Err(Exception::new(given.py(), "UnknownCoordinate", text).with("coordinate", given).build())
    }

    /// The number of a body.
    pub fn body_number(&self, body: &BodyRef) -> Option<usize> {
        match body {
            BodyRef::Number(number) | BodyRef::Point(number, _) => {
                (*number < self.counts.bodies).then_some(*number)
            }
            BodyRef::Name(name) => self.bodies.iter().position(|body| body.name == *name),
        }
    }

    /// The body of a position coordinate (0) or of a velocity coordinate (1).
    fn moved_by(&self, coordinate: usize, kind: usize) -> Option<&BodyInfo> {
        let mut first = 0;
        self.bodies.iter().find(|body| {
            first += <[usize; 2]>::from(body.kind.coordinates())[kind];
            coordinate < first
        })
    }

    /// The name of the joint of a velocity coordinate.
    pub fn joint_of(&self, coordinate: usize) -> &str {
        self.moved_by(coordinate, 1).map_or("", |body| &body.joint)
    }

    /// The name of the joint of a position coordinate.
    pub fn joint_at(&self, position: usize) -> &str {
        self.moved_by(position, 0).map_or("", |body| &body.joint)
    }

    /// The name of a body.
    pub fn body_name(&self, body: usize) -> Option<&str> {
        self.bodies.get(body).map(|body| &*body.name)
    }

    /// The name of a body's joint.
    pub fn joint(&self, body: usize) -> &str {
        self.bodies.get(body).map_or("", |body| &body.joint)
    }

    /// Whether a velocity coordinate is its joint's only one.
    pub fn is_alone(&self, coordinate: usize) -> bool {
        let body = self.moved_by(coordinate, 1);
        body.is_some_and(|body| body.kind.coordinates().1 == 1)
    }

    pub fn body(&self, given: &Bound<'_, PyAny>) -> PyResult<usize> {
        let body = match given.extract::<usize>() {
            Ok(number) => Some(BodyRef::Number(number)),
            Err(_) => given.extract().map(BodyRef::Name).ok(),
        };
        let found = body.and_then(|body| self.body_number(&body));
        found.ok_or_else(|| self.unknown_body(given))
    }

    /// A value for each velocity coordinate.
    fn per_coordinate(&self, of: impl Fn(&BodyInfo) -> f64) -> Vec<f64> {
        let bodies = self.bodies.iter();
        bodies.flat_map(|body| std::iter::repeat_n(of(body), body.kind.coordinates().1)).collect()
    }
}

pub fn argument<'a, 'py>(
    name: &'static str,
    given: &'a Bound<'py, PyAny>,
    width: usize,
) -> Argument<'a, 'py> {
    Argument { name, given, axes: [1, width], matrix: false, positions: None }
}

impl Machine for Robot {
    fn robot(&self) -> &Robot {
        self
    }
}

/// Arguments of the methods in the files below.
impl Robot {
    /// A configuration, of which sines and cosines alone matter.
    pub fn configuration<'a, 'py>(
        &'a self,
        name: &'static str,
        given: &'a Array<'py>,
    ) -> Argument<'a, 'py> {
        Argument {
            positions: Some(Positions { by: Use::Sines, at: &self.positions }),
            ..argument(name, given, self.counts.q)
        }
    }

    /// A step from a configuration.
    fn step<'a, 'py>(&'a self, name: &'static str, given: &'a Array<'py>) -> Argument<'a, 'py> {
        Argument {
            positions: Some(Positions { by: Use::Step, at: &self.rates }),
            ..self.v(name, given)
        }
    }

    /// An argument that is a spatial vector.
    fn six<'a, 'py>(&self, name: &'static str, given: &'a Array<'py>) -> Argument<'a, 'py> {
        argument(name, given, 6)
    }

    /// A square matrix of the velocity coordinates.
    fn matrix<'a, 'py>(&self, name: &'static str, given: &'a Array<'py>) -> Argument<'a, 'py> {
        Argument { axes: [self.counts.v; 2], matrix: true, ..argument(name, given, 0) }
    }
}

pub type Array<'py> = Bound<'py, PyAny>;

#[pymethods]
impl Robot {
    /// A robot of the library by its name.
    #[new]
    fn new(py: Python<'_>, #[pyo3(from_py_with = wanted)] name: String) -> PyResult<Self> {
        let Some((found, known)) = library::find(&name) else {
            let names = library::ROBOTS.map(|(name, _)| name).join(", ");
            let text = format!("there is no robot `{name}`: {names}");
            return Err(Exception::new(py, "UnknownRobot", text).with("name", name).build());
        };
        let joints = library::joints(found, &known.names);
        let bodies = known.names.iter().zip(&joints).zip(&known.limits);
        let bodies = bodies.map(|((name, joint), limits)| BodyInfo {
            limits: [limits.lower, limits.upper, limits.velocity, limits.torque],
            ..BodyInfo::of(name, joint)
        });
        let bodies = bodies.collect();
        let robot = Self::of(py, found.to_owned(), Some(found), known.bodies, bodies)?;
        Ok(Self { frames: library::frames(found), ..robot })
    }

    /// A robot from a URDF or MJCF.
    ///
    /// base: the link that stands still, else the root; tip: only the joints up to this link move;
    /// joints: only these move; without: links that are left out with all that they carry; lock:
    /// positions (rad, m) of joints that stand still; free_base: the base is free; exact: right
    /// angles and zeros in place of their roundings.
    #[staticmethod]
    #[pyo3(signature = (path, *, base = None, tip = None, joints = None, without = None, lock = None, free_base = false, exact = true))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn from_file(
        py: Python<'_>,
        #[pyo3(from_py_with = wanted)] path: PathBuf,
        #[pyo3(from_py_with = wanted)] base: Option<String>,
        #[pyo3(from_py_with = wanted)] tip: Option<String>,
        #[pyo3(from_py_with = wanted)] joints: Option<Vec<String>>,
        #[pyo3(from_py_with = wanted)] without: Option<Vec<String>>,
        #[pyo3(from_py_with = wanted)] lock: Option<BTreeMap<String, f64>>,
        #[pyo3(from_py_with = wanted)] free_base: bool,
        #[pyo3(from_py_with = wanted)] exact: bool,
    ) -> PyResult<Self> {
        let described = py.detach(|| source::read(&path));
        let gone = without.unwrap_or_default();
        let selection = (base, tip, joints.unwrap_or_default(), gone, lock, free_base);
        Self::read(py, described, selection, exact)
    }

    /// A robot from the text of a URDF or MJCF; the files that an MJCF includes are in ``folder``.
    /// The keywords are those of `from_file`.
    #[staticmethod]
    #[pyo3(signature = (text, folder = None, *, base = None, tip = None, joints = None, without = None, lock = None, free_base = false, exact = true))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn from_text(
        py: Python<'_>,
        #[pyo3(from_py_with = wanted)] text: String,
        #[pyo3(from_py_with = wanted)] folder: Option<PathBuf>,
        #[pyo3(from_py_with = wanted)] base: Option<String>,
        #[pyo3(from_py_with = wanted)] tip: Option<String>,
        #[pyo3(from_py_with = wanted)] joints: Option<Vec<String>>,
        #[pyo3(from_py_with = wanted)] without: Option<Vec<String>>,
        #[pyo3(from_py_with = wanted)] lock: Option<BTreeMap<String, f64>>,
        #[pyo3(from_py_with = wanted)] free_base: bool,
        #[pyo3(from_py_with = wanted)] exact: bool,
    ) -> PyResult<Self> {
        let folder = folder.unwrap_or(PathBuf::from("."));
        let described = py.detach(|| source::parse(&text, &folder));
        let gone = without.unwrap_or_default();
        let selection = (base, tip, joints.unwrap_or_default(), gone, lock, free_base);
        Self::read(py, described, selection, exact)
    }

    fn __repr__(&self) -> String {
        let Counts { bodies, q, v } = self.counts;
        format!("Robot({:?}, {bodies} bodies, nq = {q}, nv = {v})", self.name)
    }

    /// The name of the robot.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }
    /// Its name in `robots()`, or None if it was read from a file.
    #[getter]
    pub fn library_name(&self) -> Option<&'static str> {
        self.library
    }
    /// The number of position coordinates.
    #[getter]
    fn nq(&self) -> usize {
        self.counts.q
    }
    /// The number of velocity coordinates.
    #[getter]
    fn nv(&self) -> usize {
        self.counts.v
    }
    /// The names of the bodies, parents first: links, of which what is fixed to them is a part.
    #[getter]
    fn bodies(&self) -> Vec<String> {
        self.bodies.iter().map(|body| body.name.clone()).collect()
    }
    /// The names of the frames that are fixed to bodies or the base, such as a tool's: fixed links
    /// of the file. Methods that ask for a body take them.
    #[getter]
    fn frames(&self) -> Vec<String> {
        self.frames.iter().map(|frame| frame.name.clone()).collect()
    }
    /// The name of the joint of each body, as in the file; of a robot of the library, in the file
    /// of its source.
    #[getter]
    fn joints(&self) -> Vec<String> {
        self.bodies.iter().map(|body| body.joint.clone()).collect()
    }
    /// The kind of the joint of each body, such as "revolute".
    #[getter]
    fn joint_kinds(&self) -> Vec<String> {
        let kinds = self.bodies.iter().map(|body| body.kind);
        kinds.map(|kind| format!("{kind:?}").to_lowercase()).collect()
    }
    /// The parent of each body by its number, or None for the base.
    #[getter]
    fn parents(&self) -> Vec<Option<usize>> {
        self.bodies.iter().map(|body| body.parent).collect()
    }
    /// The number of a body of that name.
    fn body_index(&self, name: &Bound<'_, PyAny>) -> PyResult<usize> {
        self.body(name)
    }

    /// The cost of each algorithm on a Cortex-M4F for this robot, from the repository's records.
    ///
    /// Raises NotRecorded for a robot without a record, such as one from a file.
    fn costs(&self, py: Python<'_>) -> PyResult<Vec<Cost>> {
        let found = self.library.map(costs::of).unwrap_or_default();
        if found.is_empty() {
            return Err(costs::not_recorded(py, &self.name, "the cost of algorithms"));
        }
        Ok(found)
    }

    /// The longest tick of the robot's scene on a Cortex-M4F, cycles: encoders, reference,
    /// dynamics, safety and drives.
    ///
    /// Raises NotRecorded for a robot without a scene.
    fn scene_cycles(&self, py: Python<'_>) -> PyResult<u64> {
        let found = self.library.and_then(costs::tick);
        found.ok_or_else(|| costs::not_recorded(py, &self.name, "the tick of a scene"))
    }
}

/// Properties with a value for each velocity coordinate.
macro_rules! per_coordinate {
    ($($(#[$doc:meta])* $name:ident: $field:ident $([$at:literal])?;)*) => {
        #[pymethods]
        impl Robot {$(
            $(#[$doc])*
            #[getter]
            fn $name<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
                PyArray1::from_vec(py, self.per_coordinate(|body| body.$field $([$at])?))
            }
        )*}
    };
}

per_coordinate! {
    /// The lower limit of each velocity coordinate's position, rad or m; -inf if there is none.
    lower_limits: limits[0];
    /// The upper limit of each velocity coordinate's position, rad or m; inf if there is none.
    upper_limits: limits[1];
    /// The largest speed of each velocity coordinate, rad/s or m/s; inf if there is none.
    velocity_limits: limits[2];
    /// The largest torque of each velocity coordinate, N·m or N; inf if there is none.
    torque_limits: limits[3];
    /// Viscous friction of the file, N·m·s/rad or N·s/m, for `Viscous`.
    damping: damping;
    /// Dry friction of the file, N·m or N, for `Coulomb`.
    friction: friction;
    /// Inertia of the motors of the file, kg·m² or kg, for `Armature`.
    armature: armature;
    /// Stiffness of the springs of the file, N·m/rad or N/m, for `Spring`.
    spring_stiffness: spring[0];
    /// Positions at which the springs of the file are at rest, rad or m, for `Spring`.
    spring_rest: spring[1];
}
