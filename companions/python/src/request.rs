//! The request of a call.

use robot_dynamics_kernels::spec::Spec;

use crate::arrays::Argument;

/// A call: the effects, the arguments, and the shape of a row of each result.
pub struct Request<'a, 'py> {
    pub effects: &'a [Spec],
    pub arguments: &'a [Argument<'a, 'py>],
    pub results: &'a [&'a [usize]],
    /// The names of a machine's loops or linkages, which the library knows by their numbers.
    pub names: &'a [String],
}
