//! A mistake in a recording, in words.

use std::f64::consts::PI;

use serde::Serialize;

/// A mistake in a recording.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Mistake {
    /// The torques of all joints are `factor` times those of the robot.
    Unit { factor: f64 },
    /// The torques of these joints are reversed.
    TorqueSign { joints: Vec<String> },
    /// The positions of these joints are reversed.
    PositionSign { joints: Vec<String> },
    /// The positions of a joint are too small by `shift`, rad or m.
    Zero { joint: String, shift: f64 },
}

impl std::fmt::Display for Mistake {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let list = |joints: &[String]| joints.join("`, `");
        match self {
            Self::Unit { factor } => {
                let why = match (factor / 1e3).ln().abs() < 0.5 {
                    true => ": are they in mN·m, or currents in mA?",
                    false => ": are they in another unit, or on the motor's side of a gear?",
                };
                write!(out, "the torques are about {factor:.3} times those of the description{why}")
            }
            Self::TorqueSign { joints } => {
                write!(out, "the torques of `{}` have the wrong sign", list(joints))
            }
            Self::PositionSign { joints } => {
                write!(out, "the positions of `{}` have the wrong sign", list(joints))
            }
            Self::Zero { joint, shift } => write!(
                out,
                "the zero of `{joint}` is shifted: its positions are too small by about {shift:.3} \
                 rad or m ({:.1}° for a revolute joint)",
                shift * 180.0 / PI
            ),
        }
    }
}
