//! A robot as Python sees it: where it comes from, and what it is. What it computes is in the files of its own folder.

mod drivetrain;
mod dynamics;
mod factors;
mod given;
mod kinematics;
mod momentum;
mod regressors;

use std::path::PathBuf;

use dynamics_core::model::JointKind;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use robot_import::loops::{self, Closed, Motors};
use robot_import::selection::Selection;
use robot_import::source;
use robot_import::tree::{Numbers, Tree};

use crate::arrays::Argument;
use crate::compute::{By, Request};
use crate::costs::{self, Cost};
use crate::error::{Exception, of_import, of_model};
use crate::library;
use robot_dynamics_engines::{InEngine, Scene as EngineScene};
use robot_dynamics_kernels::Which;
use robot_dynamics_kernels::model::{Bodies, Counts, Models};
use robot_dynamics_kernels::spec::{BodyRef, Spec};

use given::{frame_of, with_inertia, without_rotors};

/// A robot: a tree of bodies on joints.
///
/// ``Robot("ur5e")`` is a robot of the library, `robots()` lists their names; `Robot.from_file` and `Robot.from_text`
/// read URDF and MJCF. Units are SI: rad, m, kg, N·m, N.
///
/// Every method takes arrays of one state, such as q of shape (nq,), or of many, with any leading axes: (n, nq). All
/// arrays of a call are float32 or all are float64, and so is the result; lists have the type of the arrays beside
/// them, else float64. In float32 the results have the bits of the same algorithm (`Core`) in firmware. Batches
/// release Python's lock and use all cores.
///
/// q has the coordinates of each joint in the order of the bodies: an angle or a length; of a ball joint a quaternion
/// (x, y, z, w), of a free joint that and then the position; q̇ of a free joint has the angular velocity first, both in
/// the body's axes.
#[pyclass(frozen, module = "robot_dynamics", name = "Robot")]
pub struct Robot {
    pub single: Models<f32>,
    pub double: Models<f64>,
    pub counts: Counts,
    name: String,
    library: Option<&'static str>,
    bodies: Vec<BodyInfo>,
    /// The bodies as the library describes them.
    pub described: Bodies,
    /// The loops of the file.
    pub closed: Vec<Closed>,
    /// The coordinates that its motors drive, of a robot with loops.
    pub actuated: Vec<usize>,
}

/// The properties of a body, its joint's among them.
struct BodyInfo {
    name: String,
    joint: String,
    kind: JointKind,
    parent: Option<usize>,
    limits: [f64; 4],
    damping: f64,
    friction: f64,
    armature: f64,
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
        for ((body, kind), parent) in bodies
            .iter_mut()
            .zip(described.kinds())
            .zip(described.parents())
        {
            (body.kind, body.parent) = (kind, parent);
        }
        Ok(Self {
            single: described.models().map_err(refused)?,
            double: described.models().map_err(refused)?,
            counts: described.counts(),
            name,
            library,
            bodies,
            described,
            closed: Vec::new(),
            actuated: Vec::new(),
        })
    }

    fn read(
        py: Python<'_>,
        described: robot_import::error::Result<robot_import::description::Description>,
        selection: &Selection,
        numbers: Numbers,
    ) -> PyResult<Self> {
        let read = described.and_then(|robot| {
            let tree = Tree::of(&robot, &selection.of(&robot)?, numbers)?;
            let (closed, _) = loops::closed(&robot, &tree);
            let motors = Motors::of(&tree, &closed, &[])?;
            Ok((tree, closed, motors.actuated))
        });
        let (tree, closed, actuated) = read.map_err(|error| of_import(py, &error))?;
        let bodies = tree.bodies.iter().map(|body| {
            let [lower, upper] = body
                .limits
                .position
                .unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
            let [velocity, effort] = [body.limits.velocity, body.limits.effort]
                .map(|limit| limit.unwrap_or(f64::INFINITY));
            BodyInfo {
                name: body.name.clone(),
                joint: body.joint.clone(),
                kind: JointKind::Fixed,
                parent: None,
                limits: [lower, upper, velocity, effort],
                damping: body.damping,
                friction: body.friction,
                armature: body.armature,
            }
        });
        let bodies = bodies.collect();
        let robot = Self::of(py, tree.name.clone(), None, Bodies::of(&tree), bodies)?;
        Ok(Self {
            closed,
            actuated,
            ..robot
        })
    }

    /// Its name, for errors.
    pub fn label(&self) -> &str {
        &self.name
    }

    /// A velocity coordinate by its number, or all of a joint by its name.
    pub fn coordinates_of(&self, given: &Bound<'_, PyAny>) -> PyResult<Vec<usize>> {
        let found: Vec<usize> = match (given.extract(), given.extract::<String>()) {
            (Ok(number), _) if number < self.counts.v => vec![number],
            (_, Ok(name)) => (0..self.counts.v)
                .filter(|&coordinate| self.joint_of(coordinate) == name)
                .collect(),
            _ => Vec::new(),
        };
        if !found.is_empty() {
            return Ok(found);
        }
        let text = format!(
            "the robot has no velocity coordinate {given}: it has {}",
            self.counts.v
        );
        Err(Exception::new(given.py(), "UnknownCoordinate", text)
            .with("coordinate", given)
            .build())
    }

    /// The number of a body.
    pub fn body_number(&self, body: &BodyRef) -> Option<usize> {
        match body {
            BodyRef::Number(number) => (*number < self.counts.bodies).then_some(*number),
            BodyRef::Name(name) => self.bodies.iter().position(|body| body.name == *name),
        }
    }

    /// The body that a velocity coordinate moves.
    fn moved_by(&self, coordinate: usize) -> Option<&BodyInfo> {
        let mut first = 0;
        self.bodies.iter().find(|body| {
            first += body.kind.coordinates().1;
            coordinate < first
        })
    }

    /// The name of the joint of a velocity coordinate.
    pub fn joint_of(&self, coordinate: usize) -> &str {
        self.moved_by(coordinate).map_or("", |body| &body.joint)
    }

    /// The name of a body.
    pub fn body_name(&self, body: usize) -> Option<&str> {
        self.bodies.get(body).map(|body| &*body.name)
    }

    /// The name of a body's joint.
    pub fn joint(&self, body: usize) -> &str {
        self.bodies.get(body).map_or("", |body| &body.joint)
    }

    /// The name of the joint of a position coordinate.
    pub fn joint_at(&self, position: usize) -> &str {
        let mut first = 0;
        let found = self.bodies.iter().find(|body| {
            first += body.kind.coordinates().0;
            position < first
        });
        found.map_or("", |body| &body.joint)
    }

    /// Whether a velocity coordinate is its joint's only one.
    pub fn is_alone(&self, coordinate: usize) -> bool {
        let body = self.moved_by(coordinate);
        body.is_some_and(|body| body.kind.coordinates().1 == 1)
    }

    pub fn body(&self, given: &Bound<'_, PyAny>) -> PyResult<usize> {
        let body = match given.extract::<usize>() {
            Ok(number) => Some(BodyRef::Number(number)),
            Err(_) => given.extract().map(BodyRef::Name).ok(),
        };
        body.and_then(|body| self.body_number(&body))
            .ok_or_else(|| {
                let names: Vec<&str> = self.bodies.iter().map(|body| body.name.as_str()).collect();
                let text = format!(
                    "the robot has no body {given}: its bodies are {}",
                    names.join(", ")
                );
                Exception::new(given.py(), "UnknownBody", text)
                    .with("body", given)
                    .build()
            })
    }

    /// What computes inverse dynamics in a form.
    fn by(
        &self,
        py: Python<'_>,
        form: &str,
        which: Which<'static>,
        scene: EngineScene,
        effects: &[Spec],
    ) -> PyResult<By<'static>> {
        if form == "core" {
            return Ok(which.into());
        }
        if form != "engine" {
            let text = format!("there is no form `{form}`: \"core\" or \"engine\"");
            return Err(Exception::new(py, "NoEngine", text)
                .with("robot", self.name.as_str())
                .build());
        }
        if self.library.and_then(<f32 as InEngine>::engine).is_none() {
            let text = format!("the wheel has no engine of `{}`", self.name);
            return Err(Exception::new(py, "NoEngine", text)
                .with("robot", self.name.as_str())
                .build());
        }
        let named = |spec| effects.contains(&spec);
        let down = Spec::Gravity([0.0, 0.0, -9.81]);
        let fits = match scene {
            EngineScene::RigidBody => {
                effects.len() == 3 && named(down) && named(Spec::Inertia) && named(Spec::Coriolis)
            }
            EngineScene::Bias => effects.len() == 2 && named(down) && named(Spec::Coriolis),
            EngineScene::Gravity => effects.len() == 1 && named(down),
        };
        if fits {
            return Ok(By::Engine(scene));
        }
        let text = "the engines of the wheel have the scenes of RIGID_BODY alone; other effects are computed by form = \"core\"";
        Err(Exception::new(py, "EffectError", text)
            .with("effect", "")
            .build())
    }

    /// A value for each velocity coordinate.
    fn per_coordinate(&self, of: impl Fn(&BodyInfo) -> f64) -> Vec<f64> {
        let bodies = self.bodies.iter();
        bodies
            .flat_map(|body| std::iter::repeat_n(of(body), body.kind.coordinates().1))
            .collect()
    }
}

pub fn argument<'a, 'py>(
    name: &'static str,
    given: &'a Bound<'py, PyAny>,
    width: usize,
) -> Argument<'a, 'py> {
    Argument {
        name,
        given,
        axes: [1, width],
        matrix: false,
    }
}

/// The methods of the files below: an algorithm, effects, arguments, and the shape of a row of each result.
impl Robot {
    /// The configuration, an argument.
    pub fn q<'a, 'py>(&self, given: &'a Array<'py>) -> Argument<'a, 'py> {
        argument("q", given, self.counts.q)
    }

    /// An argument of one number for each velocity coordinate.
    pub fn v<'a, 'py>(&self, name: &'static str, given: &'a Array<'py>) -> Argument<'a, 'py> {
        argument(name, given, self.counts.v)
    }

    /// An argument of a square matrix of the velocity coordinates.
    fn matrix<'a, 'py>(&self, name: &'static str, given: &'a Array<'py>) -> Argument<'a, 'py> {
        Argument {
            name,
            given,
            axes: [self.counts.v; 2],
            matrix: true,
        }
    }

    /// The results of an algorithm that has several.
    pub fn several<'a, 'py>(
        &self,
        py: Python<'py>,
        by: impl Into<By<'a>>,
        effects: &[Spec],
        arguments: &[Argument<'_, 'py>],
        results: &[&[usize]],
    ) -> PyResult<Bound<'py, PyTuple>> {
        let request = Request {
            effects,
            arguments,
            results,
            names: &[],
        };
        PyTuple::new(py, self.compute(py, by, &request)?)
    }

    /// The result of an algorithm that has one.
    fn one<'a, 'py>(
        &self,
        py: Python<'py>,
        by: impl Into<By<'a>>,
        effects: &[Spec],
        arguments: &[Argument<'_, 'py>],
        result: &[usize],
    ) -> PyResult<Array<'py>> {
        let request = Request {
            effects,
            arguments,
            results: &[result],
            names: &[],
        };
        Ok(self.compute(py, by, &request)?.swap_remove(0))
    }
}

pub type Array<'py> = Bound<'py, PyAny>;

#[pymethods]
impl Robot {
    /// A robot of the library by its name.
    #[new]
    fn new(py: Python<'_>, name: &str) -> PyResult<Self> {
        let Some((found, known)) = library::find(name) else {
            let names = library::ROBOTS.map(|(name, _)| name).join(", ");
            let text = format!("there is no robot `{name}`: {names}");
            return Err(Exception::new(py, "UnknownRobot", text)
                .with("name", name)
                .build());
        };
        let bodies = known
            .names
            .iter()
            .zip(&known.limits)
            .map(|(name, limits)| BodyInfo {
                name: name.clone(),
                joint: name.clone(),
                kind: JointKind::Fixed,
                parent: None,
                limits: [limits.lower, limits.upper, limits.velocity, limits.torque],
                damping: 0.0,
                friction: 0.0,
                armature: 0.0,
            });
        let bodies = bodies.collect();
        Self::of(py, found.to_owned(), Some(found), known.bodies, bodies)
    }

    /// A robot from a URDF or MJCF.
    ///
    /// base: the link that stands still, else the root; tip: only the joints up to this link move; joints: only these
    /// move; without: links that are left out with all that they carry; lock: positions (rad, m) of joints that stand
    /// still; free_base: the base is free; exact: right angles and zeros in place of their roundings.
    #[staticmethod]
    #[pyo3(signature = (path, *, base = None, tip = None, joints = Vec::new(), without = Vec::new(), lock = None, free_base = false, exact = true))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn from_file(
        py: Python<'_>,
        path: PathBuf,
        base: Option<String>,
        tip: Option<String>,
        joints: Vec<String>,
        without: Vec<String>,
        lock: Option<std::collections::BTreeMap<String, f64>>,
        free_base: bool,
        exact: bool,
    ) -> PyResult<Self> {
        let lock = lock.unwrap_or_default().into_iter().collect();
        let selection = Selection {
            base,
            tip,
            without,
            joints,
            lock,
            free_base,
        };
        let numbers = if exact {
            Numbers::Exact
        } else {
            Numbers::AsGiven
        };
        Self::read(py, py.detach(|| source::read(&path)), &selection, numbers)
    }

    /// A robot from the text of a URDF or MJCF; the files that an MJCF includes are in ``folder``. The keywords are
    /// those of `from_file`.
    #[staticmethod]
    #[pyo3(signature = (text, folder = PathBuf::from("."), *, base = None, tip = None, joints = Vec::new(), without = Vec::new(), lock = None, free_base = false, exact = true))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn from_text(
        py: Python<'_>,
        text: &str,
        folder: PathBuf,
        base: Option<String>,
        tip: Option<String>,
        joints: Vec<String>,
        without: Vec<String>,
        lock: Option<std::collections::BTreeMap<String, f64>>,
        free_base: bool,
        exact: bool,
    ) -> PyResult<Self> {
        let lock = lock.unwrap_or_default().into_iter().collect();
        let selection = Selection {
            base,
            tip,
            without,
            joints,
            lock,
            free_base,
        };
        let numbers = if exact {
            Numbers::Exact
        } else {
            Numbers::AsGiven
        };
        Self::read(
            py,
            py.detach(|| source::parse(text, &folder)),
            &selection,
            numbers,
        )
    }

    fn __repr__(&self) -> String {
        let Counts { bodies, q, v } = self.counts;
        format!(
            "Robot({:?}, {bodies} bodies, nq = {q}, nv = {v})",
            self.name
        )
    }

    /// Its name.
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
    /// The names of the bodies, parents first; what does not move against a body is part of it.
    #[getter]
    fn bodies(&self) -> Vec<String> {
        self.bodies.iter().map(|body| body.name.clone()).collect()
    }
    /// The name of the joint of each body.
    #[getter]
    fn joints(&self) -> Vec<String> {
        self.bodies.iter().map(|body| body.joint.clone()).collect()
    }
    /// The kind of the joint of each body, such as "revolute".
    #[getter]
    fn joint_kinds(&self) -> Vec<String> {
        let kinds = self.bodies.iter().map(|body| body.kind);
        kinds
            .map(|kind| format!("{kind:?}").to_lowercase())
            .collect()
    }
    /// The parent of each body by its number, or None for the base.
    #[getter]
    fn parents(&self) -> Vec<Option<usize>> {
        self.bodies.iter().map(|body| body.parent).collect()
    }
    /// The lower limit of each velocity coordinate's position, rad or m; -inf if there is none.
    #[getter]
    fn lower_limits(&self) -> Vec<f64> {
        self.per_coordinate(|body| body.limits[0])
    }
    /// The upper limit of each velocity coordinate's position, rad or m; inf if there is none.
    #[getter]
    fn upper_limits(&self) -> Vec<f64> {
        self.per_coordinate(|body| body.limits[1])
    }
    /// The largest speed of each velocity coordinate, rad/s or m/s; inf if there is none.
    #[getter]
    fn velocity_limits(&self) -> Vec<f64> {
        self.per_coordinate(|body| body.limits[2])
    }
    /// The largest torque of each velocity coordinate, N·m or N; inf if there is none.
    #[getter]
    fn torque_limits(&self) -> Vec<f64> {
        self.per_coordinate(|body| body.limits[3])
    }
    /// Viscous friction of the file, N·m·s/rad or N·s/m, for `Viscous`.
    #[getter]
    fn damping(&self) -> Vec<f64> {
        self.per_coordinate(|body| body.damping)
    }
    /// Dry friction of the file, N·m or N, for `Coulomb`.
    #[getter]
    fn friction(&self) -> Vec<f64> {
        self.per_coordinate(|body| body.friction)
    }
    /// Inertia of the motors of the file, kg·m² or kg, for `Armature`.
    #[getter]
    fn armature(&self) -> Vec<f64> {
        self.per_coordinate(|body| body.armature)
    }
    /// The number of a body of that name.
    fn body_index(&self, name: &Bound<'_, PyAny>) -> PyResult<usize> {
        self.body(name)
    }

    /// What each algorithm costs on a Cortex-M4F for this robot: the repository's records.
    ///
    /// Raises NotRecorded for a robot without a record, such as one from a file.
    fn costs(&self, py: Python<'_>) -> PyResult<Vec<Cost>> {
        let found = self.library.map(costs::of).unwrap_or_default();
        if found.is_empty() {
            return Err(costs::not_recorded(
                py,
                &self.name,
                "the cost of algorithms",
            ));
        }
        Ok(found)
    }

    /// The longest tick of the robot's scene on a Cortex-M4F, cycles: encoders, reference, dynamics, safety and drives.
    ///
    /// Raises NotRecorded for a robot without a scene.
    fn scene_cycles(&self, py: Python<'_>) -> PyResult<u64> {
        let found = self.library.and_then(costs::tick);
        found.ok_or_else(|| costs::not_recorded(py, &self.name, "the tick of a scene"))
    }
}
