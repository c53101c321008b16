//! A mistake in a recording, in words.

use std::f64::consts::PI;

use serde::Serialize;

use super::report::percent;

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
    /// The positions of a joint are too small by `shift`, rad or m.
    Zero { joint: String, shift: f64 },
    /// The positions of these joints are too small by these shifts, rad or m.
    Zeros { shifts: Vec<(String, f64)> },
    /// The torques, or else the positions, of two joints are in each other's columns.
    Swapped { joints: [String; 2], are_torques: bool },
    /// The torques of a joint come later than those of the others, s.
    Late { joint: String, seconds: f64 },
    /// The base stands so that gravity has this direction in its frame.
    Mounting { gravity: [f64; 3] },
    /// The positions of all joints are radians that were read as degrees.
    Radians,
    /// No robot and no mistake that is known explains the recording: the residuals of the best fit,
    /// relative to the joints' largest torques, and the largest one after each correction.
    NotExplained { residuals: Vec<(String, f64)>, tried: Vec<(String, f64)> },
}

/// A shifted zero.
fn shifted(joint: &str, shift: f64) -> String {
    let degrees = shift * 180.0 / PI;
    format!(
        "the zero of `{joint}` is shifted: its positions are too small by about {shift:.3} rad or m \
         ({degrees:.1}° for a revolute joint)"
    )
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
            Self::Zero { joint, shift } => out.write_str(&shifted(joint, *shift)),
            Self::Zeros { shifts } => {
                let all = shifts.iter().map(|(joint, shift)| shifted(joint, *shift));
                out.write_str(&all.collect::<Vec<_>>().join("; "))
            }
            Self::Swapped { joints: [a, b], are_torques } => {
                let what = if *are_torques { "torques" } else { "positions" };
                write!(out, "the {what} of `{a}` and `{b}` are in each other's columns")
            }
            Self::Late { joint, seconds } => write!(
                out,
                "the torques of `{joint}` are {} those of the other joints by about {:.0} ms",
                if *seconds > 0.0 { "later than" } else { "ahead of" },
                1e3 * seconds.abs()
            ),
            Self::Mounting { gravity: [x, y, z] } => write!(
                out,
                "the base is mounted in another way: gravity is along ({x:.3}, {y:.3}, {z:.3}) of \
                 its frame (--gravity={x:.3},{y:.3},{z:.3})"
            ),
            Self::Radians => out.write_str(
                "the positions are radians that were read as degrees: position_unit = \"rad\"",
            ),
            Self::NotExplained { residuals, tried } => {
                let of = |(joint, share): &(String, f64)| {
                    format!("{} at `{joint}`", percent(*share, 1.0))
                };
                let residuals: Vec<String> = residuals.iter().map(of).collect();
                let of = |(kind, share): &(String, f64)| format!("{kind} {}", percent(*share, 1.0));
                let tried: Vec<String> = tried.iter().map(of).collect();
                write!(
                    out,
                    "the recording is not explained: the best fit leaves, RMS and of the largest \
                     torque, {}",
                    residuals.join(", ")
                )?;
                match &tried[..] {
                    [] => Ok(()),
                    _ => write!(
                        out,
                        ". With the best correction of each kind the worst joint keeps: {}",
                        tried.join(", ")
                    ),
                }
            }
        }
    }
}
