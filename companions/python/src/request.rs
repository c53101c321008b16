//! The request of a call.

use robot_dynamics_kernels::Which;
use robot_dynamics_kernels::spec::Spec;

use crate::arrays::Argument;

/// The algorithm or engine that computes the rows.
#[derive(Clone, Copy)]
pub enum By<'a> {
    /// An algorithm over the robot's model.
    Model(Which<'a>),
    /// The engine of a robot of the library.
    Engine,
}

impl<'a> From<Which<'a>> for By<'a> {
    fn from(which: Which<'a>) -> Self {
        Self::Model(which)
    }
}

/// A call: the effects, the arguments, and the shape of a row of each result.
pub struct Request<'a, 'py> {
    pub effects: &'a [Spec],
    pub arguments: &'a [Argument<'a, 'py>],
    pub results: &'a [&'a [usize]],
    /// The names of a machine's loops or linkages, which the library knows by their numbers.
    pub names: &'a [String],
}
