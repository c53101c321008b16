//! Robots that are pickled and copied. A robot of the library is its name; one of a file is the
//! numbers that were read, so that it is the same where the file is not.

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use robot_import::description::{Kind, Limits};
use robot_import::inertia::MassProperties;
use robot_import::loops::Closed;
use robot_import::number::Attitude;
use robot_import::tree::{Body, Tree};
use serde::{Deserialize, Serialize};

use super::{Read, Robot, said::Said};
use crate::error::Exception;

/// A rotation in quarter turns, or by roll, pitch and yaw.
#[derive(Serialize, Deserialize)]
enum Turned {
    Quarters([i32; 3]),
    Rpy([f64; 3]),
}

#[derive(Serialize, Deserialize)]
struct BodyNumbers {
    names: [String; 2],
    parent: Option<usize>,
    kind: String,
    xyz: [f64; 3],
    attitude: Turned,
    axis: [f64; 3],
    mass: f64,
    com: [f64; 3],
    inertia: [f64; 6],
    position: Option<[f64; 2]>,
    velocity: Option<f64>,
    effort: Option<f64>,
    damping: f64,
    friction: f64,
    armature: f64,
    spring: [f64; 2],
}

#[derive(Serialize, Deserialize)]
struct LoopNumbers {
    name: String,
    kind: String,
    ends: [(Option<usize>, [f64; 3], Turned); 2],
}

#[derive(Serialize, Deserialize)]
struct Numbers {
    name: String,
    base: String,
    bodies: Vec<BodyNumbers>,
    loops: Vec<LoopNumbers>,
    actuated: Vec<usize>,
    said: Said,
}

const KINDS: [Kind; 7] = [
    Kind::Fixed,
    Kind::Revolute,
    Kind::Continuous,
    Kind::Prismatic,
    Kind::Spherical,
    Kind::Planar,
    Kind::Free,
];

fn kind_of(name: &str) -> Option<Kind> {
    KINDS.into_iter().find(|kind| format!("{kind:?}") == name)
}

impl From<Attitude> for Turned {
    fn from(attitude: Attitude) -> Self {
        match attitude {
            Attitude::QuarterTurns(turns) => Self::Quarters(turns),
            Attitude::Rpy(rpy) => Self::Rpy(rpy),
        }
    }
}

impl From<Turned> for Attitude {
    fn from(turned: Turned) -> Self {
        match turned {
            Turned::Quarters(turns) => Self::QuarterTurns(turns),
            Turned::Rpy(rpy) => Self::Rpy(rpy),
        }
    }
}

impl Numbers {
    fn of(read: &Read) -> Self {
        let body = |body: &Body| BodyNumbers {
            names: [body.name.clone(), body.joint.clone()],
            parent: body.parent,
            kind: format!("{:?}", body.kind),
            xyz: body.xyz,
            attitude: body.attitude.into(),
            axis: body.axis,
            mass: body.inertia.mass,
            com: body.inertia.com,
            inertia: body.inertia.inertia,
            position: body.limits.position,
            velocity: body.limits.velocity,
            effort: body.limits.effort,
            damping: body.damping,
            friction: body.friction,
            armature: body.armature,
            spring: body.spring,
        };
        let closed = |one: &Closed| LoopNumbers {
            name: one.name.clone(),
            kind: format!("{:?}", one.kind),
            ends: one
                .ends
                .map(|(body, xyz, attitude)| (body, xyz, attitude.into())),
        };
        Self {
            name: read.tree.name.clone(),
            base: read.tree.base.clone(),
            bodies: read.tree.bodies.iter().map(body).collect(),
            loops: read.closed.iter().map(closed).collect(),
            actuated: read.actuated.clone(),
            said: read.said.clone(),
        }
    }

    /// The numbers that were read; none if these are numbers of no robot.
    fn read(self) -> Option<Read> {
        let body = |body: BodyNumbers| {
            let [name, joint] = body.names;
            Some(Body {
                name,
                joint,
                line: 0,
                parent: body.parent,
                kind: kind_of(&body.kind)?,
                xyz: body.xyz,
                attitude: body.attitude.into(),
                axis: body.axis,
                inertia: MassProperties {
                    mass: body.mass,
                    com: body.com,
                    inertia: body.inertia,
                },
                limits: Limits {
                    position: body.position,
                    velocity: body.velocity,
                    effort: body.effort,
                },
                damping: body.damping,
                friction: body.friction,
                armature: body.armature,
                spring: body.spring,
                driven: false,
                follows: None,
                merged: Vec::new(),
                snapped: Vec::new(),
                roundings: Vec::new(),
            })
        };
        let closed = |one: LoopNumbers| {
            let ends = one.ends;
            Some(Closed {
                source: 0,
                name: one.name,
                kind: kind_of(&one.kind)?,
                ends: ends.map(|(body, xyz, turned)| (body, xyz, turned.into())),
            })
        };
        let bodies: Vec<Body> = self.bodies.into_iter().map(body).collect::<Option<_>>()?;
        let before = |i: usize| bodies[i].parent.is_none_or(|parent| parent < i);
        if !(0..bodies.len()).all(before) {
            return None;
        }
        Some(Read {
            tree: Tree {
                name: self.name,
                base: self.base,
                links: Vec::new(),
                bodies,
            },
            closed: self.loops.into_iter().map(closed).collect::<Option<_>>()?,
            actuated: self.actuated,
            said: self.said,
        })
    }
}

#[pymethods]
impl Robot {
    fn __copy__(robot: Py<Self>) -> Py<Self> {
        robot
    }

    // A robot does not change.
    fn __deepcopy__(robot: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        robot
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let native = py.import("robot_dynamics._native")?;
        let (maker, given) = match &self.read {
            Some(read) => {
                let numbers = serde_json::to_string(&Numbers::of(read));
                let text = numbers.map_err(|error| of_pickle(py, &error.to_string()))?;
                (native.getattr("_robot")?, text)
            }
            None => (native.getattr("Robot")?, self.label().to_owned()),
        };
        (maker, (given,)).into_pyobject(py)
    }
}

/// The robot of numbers that were pickled.
#[pyfunction(name = "_robot")]
pub fn robot(py: Python<'_>, numbers: &str) -> PyResult<Robot> {
    let read: Option<Read> = serde_json::from_str(numbers).ok().and_then(Numbers::read);
    Robot::of_file(
        py,
        read.ok_or_else(|| of_pickle(py, "these are numbers of no robot"))?,
    )
}

fn of_pickle(py: Python<'_>, text: &str) -> PyErr {
    Exception::new(py, "ModelError", format!("pickle: {text}"))
        .with("body", py.None())
        .build()
}
