//! Errors of loops: of their description, and at one configuration.

use core::fmt;

use crate::algorithms::NotPositiveDefinite;
use crate::model::{Problem, Text};

/// Loops whose description cannot be used, with the loop concerned.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct LoopModelError {
    /// The loop's name (the robot's, where the whole is concerned).
    pub name: &'static str,
    /// The mistake in it.
    pub problem: LoopProblem,
}

/// A mistake in the description of a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum LoopProblem {
    /// The robot has no body of this number.
    NoBody(usize),
    /// Both ends are on the same body.
    SameBody,
    /// No joint of the tree moves one end relative to the other.
    Rigid,
    /// The joint leaves every direction free.
    Unconstrained,
    /// The axes or the pitch of the joint are impossible.
    Joint(Problem),
    /// A frame's position or angle is not finite.
    NotFinite,
    /// Roll, pitch or yaw of a frame is beyond a whole turn, 2π rad: most often degrees.
    Angle,
    /// One link is longer than all the others together: the loop closes at no configuration.
    OutOfReach,
    /// The joints constrain another number of directions than C.
    Rows {
        /// The number of directions that they constrain, which C has to be.
        expected: usize,
        /// The C of the description.
        given: usize,
    },
    /// The robot has no velocity coordinate of this number, which is listed as actuated.
    NoCoordinate(usize),
    /// This coordinate is listed as actuated twice.
    ActuatedTwice(usize),
    /// V − C, the least number of degrees of freedom, exceeds the number of actuated coordinates.
    TooFewActuated {
        /// V − C.
        needed: usize,
        /// Their number.
        given: usize,
    },
}

impl LoopProblem {
    const fn text(self) -> &'static str {
        match self {
            Self::NoBody(_) => "the robot has no body of this number",
            Self::SameBody => "both ends are on the same body",
            Self::Rigid => "no joint of the tree moves one end relative to the other",
            Self::Unconstrained => "its joint constrains no direction",
            Self::Joint(problem) => problem.text(),
            Self::NotFinite => "a position or an angle is not finite",
            Self::Angle => "a roll, pitch or yaw is beyond 2 pi: angles are in rad",
            Self::OutOfReach => {
                "one link is longer than all the others together, so that it cannot close"
            }
            Self::Rows { .. } => "its loop joints constrain another number of directions than C",
            Self::NoCoordinate(_) => "an actuated coordinate is not one of the robot",
            Self::ActuatedTwice(_) => "a coordinate is actuated twice",
            Self::TooFewActuated { .. } => "fewer coordinates are actuated than are free to move",
        }
    }

    /// The kind of thing that has the name.
    const fn subject(self) -> &'static str {
        match self {
            Self::Rows { .. }
            | Self::NoCoordinate(_)
            | Self::ActuatedTwice(_)
            | Self::TooFewActuated { .. } => "robot `",
            _ => "loop `",
        }
    }

    /// Numbers that the text needs, with the words before them.
    const fn numbers(self) -> [(&'static str, usize); 2] {
        const NONE: (&str, usize) = ("", 0);
        match self {
            Self::NoBody(i) | Self::NoCoordinate(i) | Self::ActuatedTwice(i) => [(": ", i), NONE],
            Self::Rows { expected, given } => [(": ", expected), (", not ", given)],
            Self::TooFewActuated { needed, given } => [(": ", given), (" of at least ", needed)],
            _ => [NONE, NONE],
        }
    }
}

impl fmt::Display for LoopModelError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (subject, text) = (self.problem.subject(), self.problem.text());
        write!(out, "{subject}{}`: {text}", self.name)?;
        for (words, number) in self.problem.numbers() {
            if !words.is_empty() {
                write!(out, "{words}{number}")?;
            }
        }
        Ok(())
    }
}

impl core::error::Error for LoopModelError {}

impl LoopModelError {
    /// Panics with the text of `Display`, in a form that a `const` evaluation can print.
    pub(super) const fn panic(self) -> ! {
        let mut text = Text::EMPTY.with(self.problem.subject()).with(self.name);
        text = text.with("`: ").with(self.problem.text());
        let (numbers, mut i) = (self.problem.numbers(), 0);
        while i < numbers.len() {
            let (words, number) = numbers[i];
            if !words.is_empty() {
                text = text.with(words).number(number);
            }
            i += 1;
        }
        text.panic()
    }
}

/// Why a robot with loops has no result at a configuration; the loop concerned is named.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum LoopError {
    /// The loop is open: its ends are not where its joint would have them.
    Open {
        /// The loop with the largest error.
        name: &'static str,
        /// Its error, relative to the loop's size.
        error: f64,
    },
    /// With the actuated coordinates held, this coordinate still moves, here and at every
    /// configuration near by that the loops allow: they are too few, or depend on each other. A
    /// dead point that some motion leaves is no error but
    /// [`Drive::Singular`](super::Drive::Singular).
    UnderActuated {
        /// The loop that it moves in; the robot, if it moves in none.
        name: &'static str,
        /// Its index in q̇.
        joint: usize,
    },
    /// A number is infinite or NaN: a coordinate, a rate, a torque or a result.
    NotFinite {
        /// The first loop that it reaches; the robot, if it reaches none.
        name: &'static str,
    },
    /// M(q) of the tree is not positive definite.
    NotPositiveDefinite(NotPositiveDefinite),
}

impl fmt::Display for LoopError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Open { name, error } => {
                write!(out, "loop `{name}` is open by {error:.2e} of its size")
            }
            Self::UnderActuated { name, joint } => write!(
                out,
                "loop `{name}`: coordinate {joint} moves although all actuated coordinates are held"
            ),
            Self::NotFinite { name } => write!(out, "`{name}`: a number is not finite"),
            Self::NotPositiveDefinite(error) => error.fmt(out),
        }
    }
}

impl core::error::Error for LoopError {}

impl From<NotPositiveDefinite> for LoopError {
    fn from(error: NotPositiveDefinite) -> Self {
        Self::NotPositiveDefinite(error)
    }
}
