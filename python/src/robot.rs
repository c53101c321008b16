//! A robot as Python sees it.

use std::path::PathBuf;

use dynamics_core::model::JointKind;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use robot_import::selection::Selection;
use robot_import::source;
use robot_import::tree::{Numbers, Tree};

use crate::arrays::Argument;
use crate::compute::{By, Request};
use crate::costs::{self, Cost};
use crate::effects::given as effects_of;
use crate::error::{Exception, of_import, of_model};
use crate::library;
use robot_dynamics_engines::{InEngine, Scene as EngineScene};
use robot_dynamics_kernels::model::{Bodies, Counts, Models};
use robot_dynamics_kernels::spec::{BodyRef, Spec};
use robot_dynamics_kernels::{AnyFrame, Which};

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
}

/// What Python asks of a body.
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
        described: &Bodies,
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
        })
    }

    fn read(
        py: Python<'_>,
        described: robot_import::error::Result<robot_import::description::Description>,
        selection: &Selection,
        numbers: Numbers,
    ) -> PyResult<Self> {
        let tree = described.and_then(|robot| Tree::of(&robot, &selection.of(&robot)?, numbers));
        let tree = tree.map_err(|error| of_import(py, &error))?;
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
        Self::of(py, tree.name.clone(), None, &Bodies::of(&tree), bodies)
    }

    /// The number of a body.
    pub fn body_number(&self, body: &BodyRef) -> Option<usize> {
        match body {
            BodyRef::Number(number) => (*number < self.counts.bodies).then_some(*number),
            BodyRef::Name(name) => self.bodies.iter().position(|body| body.name == *name),
        }
    }

    /// The name of the joint of a velocity coordinate.
    pub fn joint_of(&self, coordinate: usize) -> &str {
        let mut first = 0;
        for body in &self.bodies {
            first += body.kind.coordinates().1;
            if coordinate < first {
                return &body.joint;
            }
        }
        ""
    }

    fn body(&self, given: &Bound<'_, PyAny>) -> PyResult<usize> {
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
        which: Which,
        scene: EngineScene,
        effects: &[Spec],
    ) -> PyResult<By> {
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

fn frame_of(py: Python<'_>, name: &str) -> PyResult<AnyFrame> {
    match name {
        "local" => Ok(AnyFrame::Local),
        "world" => Ok(AnyFrame::World),
        "local_world_aligned" => Ok(AnyFrame::LocalWorldAligned),
        _ => {
            let text = format!(
                "there is no frame `{name}`: \"local\", \"world\" or \"local_world_aligned\""
            );
            Err(Exception::new(py, "UnknownFrame", text)
                .with("frame", name)
                .build())
        }
    }
}

/// Refuses a scene without `Inertia`, which forward dynamics needs.
fn with_inertia(py: Python<'_>, effects: &[Spec]) -> PyResult<()> {
    if effects.contains(&Spec::Inertia) {
        return Ok(());
    }
    let text = "forward dynamics needs Inertia in the scene";
    Err(Exception::new(py, "EffectError", text)
        .with("effect", "Inertia")
        .build())
}

fn argument<'a, 'py>(
    name: &'static str,
    given: &'a Bound<'py, PyAny>,
    width: usize,
) -> Argument<'a, 'py> {
    Argument { name, given, width }
}

fn only<'py>(mut results: Vec<Bound<'py, PyAny>>) -> Bound<'py, PyAny> {
    results.swap_remove(0)
}

fn all<'py>(py: Python<'py>, results: Vec<Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyTuple>> {
    PyTuple::new(py, results)
}

type Array<'py> = Bound<'py, PyAny>;

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
        Self::of(py, found.to_owned(), Some(found), &known.bodies, bodies)
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

    /// The configuration of rest, (nq,): zeros and quaternions of no rotation.
    fn neutral<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let none = numpy::PyArray1::<f64>::zeros(py, 0, false).into_any();
        let request = Request {
            effects: &[],
            arguments: &[argument("q", &none, 0)],
            results: &[&[self.counts.q]],
        };
        self.compute(py, Which::Neutral, &request).map(only)
    }

    /// Inverse dynamics: the torques (…, nv), N·m or N, for q (…, nq), q̇ and q̈ (…, nv). Equations (3) to (8) of
    /// Featherstone and Orin.
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
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
                argument("qdd", qdd, self.counts.v),
            ],
            results: &[&[self.counts.v]],
        };
        let by = self.by(
            py,
            form,
            Which::Rnea { given: 3 },
            EngineScene::RigidBody,
            &effects,
        )?;
        let found = self.compute(py, by, &request)?;
        Ok(only(found))
    }

    /// The torques (…, nv), N·m or N, at q (…, nq) and q̇ (…, nv) without acceleration: C(q, q̇) q̇ + g(q) and the
    /// other effects.
    #[pyo3(signature = (q, qd, effects = None, form = "core"))]
    fn bias<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
        form: &str,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let effects: Vec<Spec> = effects
            .iter()
            .filter(|spec| !matches!(spec, Spec::Inertia))
            .cloned()
            .collect();
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
            ],
            results: &[&[self.counts.v]],
        };
        let by = self.by(
            py,
            form,
            Which::Rnea { given: 2 },
            EngineScene::Bias,
            &effects,
        )?;
        let found = self.compute(py, by, &request)?;
        Ok(only(found))
    }

    /// The torques (…, nv), N·m or N, that hold the robot against gravity at q (…, nq). Of the effects only Gravity
    /// and loads act.
    #[pyo3(signature = (q, effects = None, form = "core"))]
    fn gravity<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
        form: &str,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let effects: Vec<Spec> = effects
            .iter()
            .filter(|spec| matches!(spec, Spec::Gravity(_) | Spec::Payload { .. }))
            .cloned()
            .collect();
        let request = Request {
            effects: &effects,
            arguments: &[argument("q", q, self.counts.q)],
            results: &[&[self.counts.v]],
        };
        let by = self.by(
            py,
            form,
            Which::Rnea { given: 1 },
            EngineScene::Gravity,
            &effects,
        )?;
        let found = self.compute(py, by, &request)?;
        Ok(only(found))
    }

    /// M q̈_r + C(q, q̇) q̇_r + g and the other effects, (…, nv): q (…, nq), q̇, q̈_r and q̇_r (…, nv).
    #[pyo3(signature = (q, qd, qdd, qd_r, effects = None))]
    fn rnea_two_velocities<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        qdd: &Array<'py>,
        qd_r: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
                argument("qdd", qdd, self.counts.v),
                argument("qd_r", qd_r, self.counts.v),
            ],
            results: &[&[self.counts.v]],
        };
        let found = self.compute(py, Which::RneaTwoVelocities, &request)?;
        Ok(only(found))
    }

    /// M(q), the joint-space inertia matrix (…, nv, nv), kg·m² or kg, with the motors' `Armature`; q (…, nq).
    #[pyo3(signature = (q, effects = None))]
    fn crba<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[argument("q", q, self.counts.q)],
            results: &[&[self.counts.v, self.counts.v]],
        };
        let found = self.compute(py, Which::Crba, &request)?;
        Ok(only(found))
    }

    /// M(q)⁻¹ (…, nv, nv); q (…, nq).
    #[pyo3(signature = (q, effects = None))]
    fn inverse_mass<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[argument("q", q, self.counts.q)],
            results: &[&[self.counts.v, self.counts.v]],
        };
        let found = self.compute(py, Which::InverseMass, &request)?;
        Ok(only(found))
    }

    /// Forward dynamics by articulated bodies: q̈ (…, nv), rad/s² or m/s², for q (…, nq), q̇ and τ (…, nv).
    #[pyo3(signature = (q, qd, tau, effects = None))]
    fn aba<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        tau: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        with_inertia(py, &effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
                argument("tau", tau, self.counts.v),
            ],
            results: &[&[self.counts.v]],
        };
        let found = self.compute(py, Which::Aba, &request)?;
        Ok(only(found))
    }

    /// Forward dynamics by M and its factors: q̈ (…, nv), rad/s² or m/s², for q (…, nq), q̇ and τ (…, nv).
    #[pyo3(signature = (q, qd, tau, effects = None))]
    fn forward_dynamics<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        tau: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        with_inertia(py, &effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
                argument("tau", tau, self.counts.v),
            ],
            results: &[&[self.counts.v]],
        };
        let found = self.compute(py, Which::ForwardDynamics, &request)?;
        Ok(only(found))
    }

    /// Torques and accelerations, each (…, nv), where of each coordinate one is given: its torque, or, where
    /// ``accelerated`` is not zero, its acceleration. q (…, nq), q̇, given and accelerated (…, nv).
    #[pyo3(signature = (q, qd, given, accelerated, effects = None))]
    fn hybrid_dynamics<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        given: &Array<'py>,
        accelerated: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let effects = effects_of(effects)?;
        with_inertia(py, &effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
                argument("given", given, self.counts.v),
                argument("accelerated", accelerated, self.counts.v),
            ],
            results: &[&[self.counts.v], &[self.counts.v]],
        };
        let found = self.compute(py, Which::Hybrid, &request)?;
        all(py, found)
    }

    /// What of the motors' torques τ (…, nv) arrives behind the friction of the gears (`LoadFriction`), (…, nv).
    #[pyo3(signature = (q, qd, tau, effects = None))]
    fn transmitted_torque<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        tau: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
                argument("tau", tau, self.counts.v),
            ],
            results: &[&[self.counts.v]],
        };
        let found = self.compute(py, Which::Transmitted, &request)?;
        Ok(only(found))
    }

    /// J (…, 6, nv) of a body with v = J q̇, angular rows first; q (…, nq). ``frame``: "local", "world" or
    /// "local_world_aligned".
    #[pyo3(signature = (q, body, frame = "local"))]
    fn jacobian<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        body: &Bound<'py, PyAny>,
        frame: &str,
    ) -> PyResult<Array<'py>> {
        let body = self.body(body)?;
        let frame = frame_of(py, frame)?;
        let request = Request {
            effects: &[],
            arguments: &[argument("q", q, self.counts.q)],
            results: &[&[6, self.counts.v]],
        };
        let found = self.compute(py, Which::Jacobian { body, frame }, &request)?;
        Ok(only(found))
    }

    /// J̇ q̇ of a body, (…, 6), rad/s² and m/s², the spatial acceleration without q̈; q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, body, frame = "local"))]
    fn bias_acceleration<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        body: &Bound<'py, PyAny>,
        frame: &str,
    ) -> PyResult<Array<'py>> {
        let body = self.body(body)?;
        let frame = frame_of(py, frame)?;
        let request = Request {
            effects: &[],
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
            ],
            results: &[&[6]],
        };
        let found = self.compute(py, Which::BiasAcceleration { body, frame }, &request)?;
        Ok(only(found))
    }

    /// Rotation matrices (…, bodies, 3, 3) from each body's frame to the base's, and positions (…, bodies, 3), m; q
    /// (…, nq).
    #[pyo3(signature = (q))]
    fn poses<'py>(&self, py: Python<'py>, q: &Array<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let request = Request {
            effects: &[],
            arguments: &[argument("q", q, self.counts.q)],
            results: &[&[self.counts.bodies, 3, 3], &[self.counts.bodies, 3]],
        };
        let found = self.compute(py, Which::Poses, &request)?;
        all(py, found)
    }

    /// Spatial velocities (rad/s, m/s) and accelerations (rad/s², m/s²) of all bodies, each (…, bodies, 6), angular
    /// part first; q (…, nq), q̇ and q̈ (…, nv).
    #[pyo3(signature = (q, qd, qdd, frame = "local", effects = None))]
    fn kinematics<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        qdd: &Array<'py>,
        frame: &str,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let frame = frame_of(py, frame)?;
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
                argument("qdd", qdd, self.counts.v),
            ],
            results: &[&[self.counts.bodies, 6], &[self.counts.bodies, 6]],
        };
        let found = self.compute(py, Which::Kinematics { frame }, &request)?;
        all(py, found)
    }

    /// The kinetic energy (…), J; q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, effects = None))]
    fn kinetic_energy<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
            ],
            results: &[&[]],
        };
        let found = self.compute(py, Which::KineticEnergy, &request)?;
        Ok(only(found))
    }

    /// The potential energy in the field of gravity (…), J, zero at the base's origin; q (…, nq).
    #[pyo3(signature = (q, effects = None))]
    fn potential_energy<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[argument("q", q, self.counts.q)],
            results: &[&[]],
        };
        let found = self.compute(py, Which::PotentialEnergy, &request)?;
        Ok(only(found))
    }

    /// The momentum of all bodies about the base's origin (…, 6): N·m·s, then N·s; q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, effects = None))]
    fn momentum<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
            ],
            results: &[&[6]],
        };
        let found = self.compute(py, Which::Momentum, &request)?;
        Ok(only(found))
    }

    /// The momentum of all bodies about their centre of mass (…, 6): N·m·s, then N·s; q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, effects = None))]
    fn centroidal_momentum<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
            ],
            results: &[&[6]],
        };
        let found = self.compute(py, Which::CentroidalMomentum, &request)?;
        Ok(only(found))
    }

    /// A(q) (…, 6, nv) with A q̇ the momentum about the centre of mass; q (…, nq).
    #[pyo3(signature = (q, effects = None))]
    fn centroidal_matrix<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[argument("q", q, self.counts.q)],
            results: &[&[6, self.counts.v]],
        };
        let found = self.compute(py, Which::CentroidalMatrix, &request)?;
        Ok(only(found))
    }

    /// Mass (…), kg, position (…, 3), m, and velocity (…, 3), m/s, of the centre of mass; q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, effects = None))]
    fn center_of_mass<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
            ],
            results: &[&[], &[3], &[3]],
        };
        let found = self.compute(py, Which::CenterOfMass, &request)?;
        all(py, found)
    }

    /// p = M q̇ and Cᵀ q̇, each (…, nv), for observers of external torques; q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, effects = None))]
    fn momentum_and_coriolis<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
            ],
            results: &[&[self.counts.v], &[self.counts.v]],
        };
        let found = self.compute(py, Which::MomentumAndCoriolis, &request)?;
        all(py, found)
    }

    /// p = M q̇ and β = Cᵀ q̇ − g − F, each (…, nv); q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, effects = None))]
    fn momentum_and_drift<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
            ],
            results: &[&[self.counts.v], &[self.counts.v]],
        };
        let found = self.compute(py, Which::MomentumAndDrift, &request)?;
        all(py, found)
    }

    /// C(q, q̇) (…, nv, nv), of Christoffel's symbols; q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, effects = None))]
    fn coriolis_matrix<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
            ],
            results: &[&[self.counts.v, self.counts.v]],
        };
        let found = self.compute(py, Which::CoriolisMatrix, &request)?;
        Ok(only(found))
    }

    /// q̇ (…, nv) with the rates of the free base for which the momentum of all bodies about the base's origin is h
    /// (…, 6); q (…, nq), q̇ (…, nv).
    #[pyo3(signature = (q, qd, h, effects = None))]
    fn base_velocity_from_momentum<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        h: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
                argument("h", h, 6),
            ],
            results: &[&[self.counts.v]],
        };
        let found = self.compute(py, Which::BaseVelocity, &request)?;
        Ok(only(found))
    }

    /// Λ⁻¹ = J M⁻¹ Jᵀ of a body, (…, 6, 6), by propagation of forces; q (…, nq).
    #[pyo3(signature = (q, body, frame = "local", effects = None))]
    fn osim_inverse<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        body: &Bound<'py, PyAny>,
        frame: &str,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let body = self.body(body)?;
        let frame = frame_of(py, frame)?;
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[argument("q", q, self.counts.q)],
            results: &[&[6, 6]],
        };
        let found = self.compute(py, Which::OsimInverse { body, frame }, &request)?;
        Ok(only(found))
    }

    /// J (…, 6, nv), J M⁻¹ (…, 6, nv), Λ⁻¹ and Λ (…, 6, 6) of a body, Λ damped by ``damping`` relative to the largest
    /// eigenvalue of Λ⁻¹ where it is nearly singular; q (…, nq).
    #[pyo3(signature = (q, body, frame = "local", effects = None, damping = 1e-6))]
    fn operational_space<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        body: &Bound<'py, PyAny>,
        frame: &str,
        effects: Option<&Bound<'py, PyAny>>,
        damping: f64,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let body = self.body(body)?;
        let frame = frame_of(py, frame)?;
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[argument("q", q, self.counts.q)],
            results: &[&[6, self.counts.v], &[6, self.counts.v], &[6, 6], &[6, 6]],
        };
        let found = self.compute(
            py,
            Which::OperationalSpaceOf {
                body,
                frame,
                damping,
            },
            &request,
        )?;
        all(py, found)
    }

    /// Y (…, nv, bodies, 10) with τ = Y φ, φ of a body: m, m c (3), then Ixx, Ixy, Iyy, Ixz, Iyz, Izz about the
    /// origin of its frame whose z is the joint's axis; q (…, nq), q̇ and q̈ (…, nv).
    #[pyo3(signature = (q, qd, qdd, effects = None))]
    fn regressor<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        qd: &Array<'py>,
        qdd: &Array<'py>,
        effects: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Array<'py>> {
        let effects = effects_of(effects)?;
        let request = Request {
            effects: &effects,
            arguments: &[
                argument("q", q, self.counts.q),
                argument("qd", qd, self.counts.v),
                argument("qdd", qdd, self.counts.v),
            ],
            results: &[&[self.counts.v, self.counts.bodies, 10]],
        };
        let found = self.compute(py, Which::Regressor, &request)?;
        Ok(only(found))
    }

    /// q ⊕ δ (…, nq): the configuration after a unit of time at the velocity δ (…, nv).
    #[pyo3(signature = (q, delta))]
    fn integrate<'py>(
        &self,
        py: Python<'py>,
        q: &Array<'py>,
        delta: &Array<'py>,
    ) -> PyResult<Array<'py>> {
        let request = Request {
            effects: &[],
            arguments: &[
                argument("q", q, self.counts.q),
                argument("delta", delta, self.counts.v),
            ],
            results: &[&[self.counts.q]],
        };
        let found = self.compute(py, Which::Integrate, &request)?;
        Ok(only(found))
    }

    /// q₁ ⊖ q₀ (…, nv): the velocity that leads from q₀ to q₁ (…, nq) in a unit of time.
    #[pyo3(signature = (q0, q1))]
    fn difference<'py>(
        &self,
        py: Python<'py>,
        q0: &Array<'py>,
        q1: &Array<'py>,
    ) -> PyResult<Array<'py>> {
        let request = Request {
            effects: &[],
            arguments: &[
                argument("q0", q0, self.counts.q),
                argument("q1", q1, self.counts.q),
            ],
            results: &[&[self.counts.v]],
        };
        let found = self.compute(py, Which::Difference, &request)?;
        Ok(only(found))
    }
}
