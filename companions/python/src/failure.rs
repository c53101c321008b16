//! From a state without a result to an exception that names the joint, the loop or the linkage.

use dynamics_core::clusters::ClusterProblem;
use dynamics_core::flexible::FlexibleError;
use dynamics_core::loops::LoopError;
use pyo3::prelude::*;

use robot_dynamics_kernels::job::{Failure, Problem as StateProblem};

use crate::error::Exception;
use crate::robot::Robot;

/// A state without a result.
///
/// `most`: the largest angle of which sines are computed.
pub fn of_failure(
    py: Python<'_>,
    robot: &Robot,
    names: &[String],
    failure: &Failure,
    most: f64,
) -> PyErr {
    let state = failure.row;
    let of_joint = |class, joint: &str, text: &str| {
        let text = format!("joint `{joint}` {text} (state {state})");
        Exception::new(py, class, text).with("joint", joint).with("state", state)
    };
    let name_of = |number: &str| -> String {
        let name = number.parse().ok().and_then(|i: usize| names.get(i));
        name.map_or(robot.label(), String::as_str).to_owned()
    };
    let of_loop = |class, number: &str, text: &str| {
        let name = name_of(number);
        let text = format!("loop `{name}` {text} (state {state})");
        Exception::new(py, class, text).with("loop", name).with("state", state)
    };
    match failure.problem {
        StateProblem::Loop(LoopError::Open { name, error }) => {
            let text = format!("is open by {error:.2e} of its size");
            of_loop("LoopOpen", name, &text).with("error", error).build()
        }
        StateProblem::Loop(LoopError::UnderActuated { name, joint }) => {
            let text = format!("moves joint `{}` with all motors held", robot.joint_of(joint));
            let error = of_loop("UnderActuated", name, &text);
            error.with("joint", robot.joint_of(joint)).build()
        }
        StateProblem::Loop(LoopError::NotFinite { name }) => {
            of_loop("NotFinite", name, "has a number that is not finite").build()
        }
        StateProblem::Loop(error) => of_loop("LoopOpen", "", &error.to_string()).build(),
        StateProblem::Linkage(at, problem) => {
            let name = names.get(at).map_or(robot.label(), String::as_str);
            let why = match problem {
                ClusterProblem::CannotClose => "the links do not reach each other",
                ClusterProblem::NotConverged => "the iteration has not converged",
                ClusterProblem::NoInertia => "it moves no inertia in some direction",
                _ => "a coordinate or a torque is not finite",
            };
            let text = format!("linkage `{name}`: {why} (state {state})");
            Exception::new(py, "LinkageError", text)
                .with("linkage", name)
                .with("state", state)
                .build()
        }
        StateProblem::Angle(at, angle) => {
            let name = names.get(at).map_or(robot.label(), String::as_str);
            let text = format!(
                "linkage `{name}` has an angle of {angle} rad, and sines are computed to {most} rad (state {state})"
            );
            Exception::new(py, "AngleError", text)
                .with("joint", name)
                .with("coordinate", py.None())
                .with("angle", angle)
                .with("limit", most)
                .with("state", state)
                .build()
        }
        StateProblem::Flexible(FlexibleError::Joint(joint)) => of_joint(
            "NotPositiveDefinite",
            robot.joint_of(joint),
            "moves no inertia, or a number is not finite",
        )
        .with("coordinate", joint)
        .build(),
        StateProblem::Flexible(error) => {
            let mode = match error {
                FlexibleError::Mode(mode) => Some(mode),
                _ => None,
            };
            Exception::new(py, "ModeError", format!("{error} (state {state})"))
                .with("link", py.None())
                .with("mode", mode)
                .with("state", state)
                .build()
        }
        StateProblem::Singular(error) => of_joint(
            "NotPositiveDefinite",
            robot.joint_of(error.joint),
            "moves no inertia, or a coordinate or an inertia is not a number",
        )
        .with("coordinate", error.joint)
        .build(),
        StateProblem::Joint(error) => of_joint(
            "MultiDofJoint",
            robot.joint(error.body),
            "has several degrees of freedom: no transmission of it is known",
        )
        .build(),
        StateProblem::Attitude(error) => of_joint(
            "NoAttitude",
            robot.joint_at(error.at),
            "has a quaternion of length zero, or one that is not finite",
        )
        .build(),
    }
}
