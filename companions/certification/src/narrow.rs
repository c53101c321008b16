//! `--box`: a narrower box of states than the description's.

use std::str::FromStr;

pub use crate::error::NarrowError;
use crate::interval::Interval;
use crate::sines;
use crate::state_box::{Kind, Robot};

/// A narrower range of one joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Narrow {
    /// As it was written.
    option: String,
    joint: usize,
    kind: Kind,
    range: Interval,
}

/// The greatest magnitude of an acceleration, a speed or a position, as an option gives it.
///
/// # Errors
/// [`NarrowError::Magnitude`].
pub fn magnitude(text: &str) -> Result<f64, NarrowError> {
    let number = text.parse().ok();
    let is_one = |x: &f64| (0.0..f64::INFINITY).contains(x);
    number
        .filter(is_one)
        .ok_or_else(|| NarrowError::Magnitude(text.to_owned()))
}

impl FromStr for Narrow {
    type Err = NarrowError;

    fn from_str(text: &str) -> Result<Self, NarrowError> {
        let read = || {
            let (joint, rest) = text.split_once(':')?;
            let joint = joint.parse().ok().filter(|joint| *joint > 0)?;
            let number = |text: &str| text.parse::<f64>().ok().filter(|x| x.is_finite());
            let (kind, range) = match rest.split_once(':') {
                Some(("v", most)) => (Kind::Velocity, number(most).map(|x| (-x, x))?),
                Some(("a", most)) => (Kind::Acceleration, number(most).map(|x| (-x, x))?),
                Some(_) => return None,
                None => {
                    let (low, high) = rest.split_once("..")?;
                    (Kind::Position, (number(low)?, number(high)?))
                }
            };
            (range.0 <= range.1).then(|| Self {
                option: text.to_owned(),
                joint,
                kind,
                range: Interval::new(range.0, range.1),
            })
        };
        read().ok_or_else(|| NarrowError::Syntax(text.to_owned()))
    }
}

impl Narrow {
    /// Narrows a robot's box.
    ///
    /// # Errors
    /// [`NarrowError`], with the option and the joint.
    pub fn apply(&self, robot: &mut Robot) -> Result<(), NarrowError> {
        let (option, number, joints) = (self.option.clone(), self.joint, robot.joints.len());
        let joint = robot
            .joints
            .get_mut(number - 1)
            .ok_or_else(|| NarrowError::NoJoint {
                option: option.clone(),
                joint: number,
                joints,
            })?;
        let whole = match self.kind {
            Kind::Position => joint.position,
            Kind::Velocity => Interval::new(-joint.speed, joint.speed),
            // The description has none.
            Kind::Acceleration => self.range,
        };
        if self.range.low < whole.low || self.range.high > whole.high {
            return Err(NarrowError::Outside {
                option,
                joint: number,
                range: whole,
            });
        }
        let was_near = sines::is_near(joint);
        match self.kind {
            Kind::Position => joint.position = self.range,
            Kind::Velocity => joint.speed = self.range.high,
            Kind::Acceleration => joint.acceleration = self.range.high,
        }
        // The function's code is that of the description.
        if joint.turns && sines::is_near(joint) != was_near {
            return Err(NarrowError::Turns {
                option,
                joint: number,
            });
        }
        Ok(())
    }
}
