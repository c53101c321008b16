//! The importer's words on a file: advice, notes, and joints that follow others.

use std::sync::Arc;

use pyo3::prelude::*;
use robot_dynamics_kernels::spec::Spec;
use robot_import::advice::{self, Topic, advice};
use robot_import::description::Description;
use robot_import::dropped::dropped;
use robot_import::plausible::plausible;
use robot_import::selection::{Selected, Selection};
use robot_import::tree::Tree;
use serde::{Deserialize, Serialize};

use super::{BodyInfo, Robot};
use crate::effects::{PyScene, RIGID_BODY, wide};
use crate::error::wanted;

/// A piece of advice on a file, as ``cargo xtask import`` prints it.
#[pyclass(frozen, get_all, module = "robot_dynamics", name = "Advice")]
#[derive(Clone, Serialize, Deserialize)]
pub struct PyAdvice {
    /// Its kind, such as "units", "torque", "limits" or "left-out".
    topic: String,
    /// The line of the file; None if none is concerned.
    line: Option<u32>,
    /// The name of the link or joint.
    name: String,
    /// A sentence with the reason.
    text: String,
}

#[pymethods]
impl PyAdvice {
    fn __repr__(&self) -> String {
        let Self { topic, name, text, .. } = self;
        format!("Advice({topic}, {name}: {text})")
    }
}

/// A joint that follows another: its position is ``ratio`` times the position of ``leader``, and
/// ``offset``, rad or m.
///
/// A robot has a coordinate for each of both; a motor drives them together.
#[pyclass(frozen, get_all, module = "robot_dynamics", name = "Coupling")]
#[derive(Clone, Serialize, Deserialize)]
pub struct PyCoupling {
    /// The name of the joint that follows.
    joint: String,
    /// The joint that it follows.
    leader: String,
    /// The travel for each rad or m of the leader.
    ratio: f64,
    /// Its position where the leader is at zero, rad or m.
    offset: f64,
}

#[pymethods]
impl PyCoupling {
    fn __repr__(&self) -> String {
        let Self { joint, leader, ratio, offset } = self;
        format!("Coupling({joint} = {ratio} {leader} + {offset})")
    }
}

/// The importer's words on a robot.
#[derive(Clone, Default, Serialize, Deserialize)]
pub struct Said {
    pub advice: Vec<PyAdvice>,
    pub couplings: Vec<PyCoupling>,
}

impl Said {
    /// The words on a tree; `notes` name what else is left out, a sentence each.
    pub fn of(
        robot: &Description,
        (selection, selected): (&Selection, &Selected),
        tree: &Tree,
        notes: Vec<String>,
    ) -> Self {
        let mut all = advice(robot, selected, tree);
        all.extend(plausible(tree, &robot.name));
        let left_out = dropped(robot, selection, selected).into_iter().chain(notes);
        all.extend(left_out.map(|text| advice::Advice {
            topic: Topic::LeftOut,
            line: 0,
            name: robot.name.clone(),
            text,
        }));
        let of_body = |body: &robot_import::tree::Body| {
            let (leader, ratio, offset) = body.follows?;
            Some(PyCoupling {
                joint: body.joint.clone(),
                leader: tree.bodies[leader].joint.clone(),
                ratio,
                offset,
            })
        };
        Self {
            advice: all.into_iter().map(PyAdvice::of).collect(),
            couplings: tree.bodies.iter().filter_map(of_body).collect(),
        }
    }
}

impl PyAdvice {
    fn of(advice: advice::Advice) -> Self {
        // The names of the importer's JSON.
        let topic = serde_json::to_value(advice.topic).unwrap_or_default();
        Self {
            topic: topic.as_str().unwrap_or_default().to_owned(),
            line: (advice.line > 0).then_some(advice.line),
            name: advice.name,
            text: advice.text,
        }
    }
}

impl Robot {
    fn said(&self) -> Option<&Said> {
        self.read.as_ref().map(|read| &read.said)
    }
}

#[pymethods]
impl Robot {
    /// The scene of a rigid body and of what the file states: damping, friction, which is full
    /// beyond the speed ``width``, rad/s or m/s, armatures and springs, as in what ``cargo xtask
    /// import`` writes.
    #[pyo3(signature = (width = 0.02))]
    fn scene(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = wanted)] width: f64,
    ) -> PyResult<PyScene> {
        wide(py, "Coulomb", width)?;
        let list = |of: fn(&BodyInfo) -> f64| self.per_coordinate(of);
        let stated = [
            Spec::Viscous { coefficients: list(|body| body.damping) },
            Spec::Coulomb { torque: list(|body| body.friction), width },
            Spec::Armature { inertia: list(|body| body.armature) },
            Spec::Spring {
                stiffness: list(|body| body.spring[0]),
                rest: list(|body| body.spring[1]),
            },
        ];
        let mut all = RIGID_BODY.to_vec();
        all.extend(stated.into_iter().filter(|spec| match spec {
            Spec::Viscous { coefficients: all }
            | Spec::Coulomb { torque: all, .. }
            | Spec::Armature { inertia: all }
            | Spec::Spring { stiffness: all, .. } => all.iter().any(|&x| x != 0.0),
            _ => true,
        }));
        Ok(Arc::new(all).into())
    }

    /// Advice on the file, as ``cargo xtask import`` prints it, but for what that finds at random
    /// states: impossible inertias, numbers in other units, limits of torque below gravity's, and
    /// what is left out. Options in it are those of the command: ``--motors`` is ``actuated`` of
    /// `Loops`. Empty for a robot of the library.
    #[getter]
    fn advice(&self) -> Vec<PyAdvice> {
        self.said().map_or(Vec::new(), |said| said.advice.clone())
    }

    /// Statements of the file that the robot lacks, a sentence each: the advice of the topic
    /// "left-out".
    #[getter]
    fn notes(&self) -> Vec<String> {
        let advice = self.said().into_iter().flat_map(|said| &said.advice);
        let left_out = advice.filter(|advice| advice.topic == "left-out");
        left_out.map(|advice| advice.text.clone()).collect()
    }

    /// The joints of the file that follow others (``<mimic>``, ``<equality>``). Their coordinates
    /// are those of a tree: set q of both, and the torque at the leader is τ of the leader plus the
    /// sum of ratio times τ of the followers.
    #[getter]
    fn couplings(&self) -> Vec<PyCoupling> {
        self.said().map_or(Vec::new(), |said| said.couplings.clone())
    }
}
