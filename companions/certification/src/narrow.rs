//! `--box`: a narrower box of states than the description's.

use std::str::FromStr;

pub use crate::error::NarrowError;
use crate::interval::Interval;
use crate::sines;
use crate::state_box::{Kind, Robot};

/// A narrower range of one joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Narrow {
    /// The option as the user wrote it.
    option: String,
    joint: usize,
    kind: Kind,
    range: Interval,
}

fn refused(option: &str, why: String) -> NarrowError {
    let option = option.to_owned();
    NarrowError { option, why }
}

/// The greatest magnitude of an acceleration, a speed or a position, as an option gives it.
///
/// # Errors
/// [`NarrowError`].
pub fn magnitude(text: &str) -> Result<f64, NarrowError> {
    let number = text.parse().ok();
    let number = number.filter(|x: &f64| (0.0..f64::INFINITY).contains(x));
    number.ok_or_else(|| refused(text, "not a finite number that is not negative".to_owned()))
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
        let forms = "JOINT:LOW..HIGH of its position, JOINT:v:MOST of its speed or JOINT:a:MOST of its acceleration";
        read().ok_or_else(|| refused(text, format!("a range is {forms}")))
    }
}

impl Narrow {
    /// Narrows the box of a robot.
    ///
    /// # Errors
    /// [`NarrowError`], with the option and the joint.
    pub fn apply(&self, robot: &mut Robot) -> Result<(), NarrowError> {
        let (number, joints) = (self.joint, robot.joints.len());
        let refused = |why: String| refused(&self.option, why);
        let Some(joint) = robot.joints.get_mut(number - 1) else {
            return Err(refused(format!("the robot has joints 1 to {joints}")));
        };
        let whole = match self.kind {
            Kind::Position => joint.position,
            Kind::Velocity => Interval::new(-joint.speed, joint.speed),
            // The description has none.
            Kind::Acceleration => self.range,
        };
        if self.range.low < whole.low || self.range.high > whole.high {
            let Interval { low, high } = whole;
            return Err(refused(format!("joint {number} has the range {low} to {high}")));
        }
        let was_near = sines::is_near(joint);
        match self.kind {
            Kind::Position => joint.position = self.range,
            Kind::Velocity => joint.speed = self.range.high,
            Kind::Acceleration => joint.acceleration = self.range.high,
        }
        // The function's code is that of the description.
        if joint.turns && sines::is_near(joint) != was_near {
            let turns = "more than two turns on a side, as its description has";
            return Err(refused(format!("the range of joint {number} needs {turns}")));
        }
        Ok(())
    }
}
