//! A mistake in a recording, in words.

use serde::Serialize;

use super::percent;

/// A mistake in a recording.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Mistake {
    /// The torques of all joints are `factor` times those of the robot.
    Unit { factor: f64 },
    /// The torques of these joints are reversed.
    TorqueSign { joints: Vec<String> },
    /// The positions of these joints are reversed.
    PositionSign { joints: Vec<String> },
    /// The positions of these joints are too small by these shifts, rad or m.
    Zero { shifts: Vec<(String, f64)> },
    /// The torques, or else the positions, of two joints are in each other's columns.
    Swapped { joints: [String; 2], are_torques: bool },
    /// The base stands so that gravity has this direction in its frame.
    Mounting { gravity: [f64; 3] },
    /// No robot and no mistake that is known explains the recording: the joint with the largest
    /// residuals relative to its largest torque, and these.
    NotExplained { joint: String, share: f64 },
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
            Self::Zero { shifts } => {
                let shifted = |(joint, shift): &(String, f64)| {
                    let degrees = shift.to_degrees();
                    format!(
                        "the zero of `{joint}` is shifted: its positions are too small by about \
                         {shift:.3} rad or m ({degrees:.1}° for a revolute joint)"
                    )
                };
                out.write_str(&shifts.iter().map(shifted).collect::<Vec<_>>().join("; "))
            }
            Self::Swapped { joints: [a, b], are_torques } => {
                let what = if *are_torques { "torques" } else { "positions" };
                write!(out, "the {what} of `{a}` and `{b}` are in each other's columns")
            }
            Self::Mounting { gravity: [x, y, z] } => write!(
                out,
                "the base is mounted in another way: gravity is along ({x:.3}, {y:.3}, {z:.3}) of \
                 its frame (--gravity={x:.3},{y:.3},{z:.3})"
            ),
            Self::NotExplained { joint, share } => write!(
                out,
                "not explained by any robot, nor by a wrong sign, unit, zero, mounting or two \
                 swapped columns: the best fit leaves {} of the torque of `{joint}`, RMS",
                percent(*share, 1.0)
            ),
        }
    }
}
