//! The loops of a robot that are known at run time: the library's, filled up.

use std::any::Any;

use dynamics_core::loops::{LoopJoint, LoopModelError, LoopProblem, Loops};
use dynamics_core::model::Model;

use crate::model::{Counts, Models};

/// The greatest number of loops of a robot.
pub const MOST_LOOPS: usize = 8;

/// The most directions that they constrain: those of as many fixed joints.
pub const MOST_ROWS: usize = 6 * MOST_LOOPS;

/// Loops on a model of V velocity coordinates.
pub type Filled<const V: usize> = Loops<MOST_LOOPS, MOST_ROWS, V>;

/// An error without the coordinates that fill the model up.
fn of_robot(mut error: LoopModelError, fill: usize) -> LoopModelError {
    if let LoopProblem::TooFewActuated { needed, given } = &mut error.problem {
        (*needed, *given) = (needed.saturating_sub(fill), given.saturating_sub(fill));
    }
    error
}

/// Loops on a model filled up to V velocity coordinates.
fn loops_on<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
    counts: Counts,
    joints: &[LoopJoint],
    (actuated, damped_below): (&[usize], f64),
) -> Result<Filled<V>, LoopModelError> {
    // The bodies that fill the model up have motors, so that they are free to move.
    let motors: Vec<usize> = actuated.iter().copied().chain(counts.v..V).collect();
    let filled = Filled::<V>::try_filled(model, joints, &motors);
    let filled = filled.map_err(|error| of_robot(error, V - counts.v))?;
    Ok(filled.damped_below(damped_below))
}

/// Loops on the larger model of a robot, the only one for which their algorithms are compiled.
#[derive(Debug)]
pub struct AnyLoops {
    filled: Box<dyn Any + Send + Sync>,
    /// The actuated coordinates, as indices in q̇.
    pub actuated: Vec<usize>,
    /// The number of directions that the loops constrain.
    pub rows: usize,
}

impl AnyLoops {
    /// Loops on a robot, of which up to [`MOST_LOOPS`] are given.
    ///
    /// # Errors
    /// The library's reason for its refusal.
    pub fn of(
        models: &Models<f64>,
        counts: Counts,
        joints: &[LoopJoint],
        actuated: &[usize],
        damped_below: f64,
    ) -> Result<Self, LoopModelError> {
        let filled = loops_on(&models.general.large, counts, joints, (actuated, damped_below))?;
        let rows = filled.rows(joints.len().saturating_sub(1)).end;
        Ok(Self { filled: Box::new(filled), actuated: actuated.to_vec(), rows })
    }

    /// The loops on the larger model, which has V velocity coordinates.
    pub(crate) fn get<const V: usize>(&self) -> &Filled<V> {
        match self.filled.downcast_ref() {
            Some(filled) => filled,
            None => unreachable!("the loops are those of another robot"),
        }
    }

    /// The number of actuated coordinates.
    pub fn motors(&self) -> usize {
        self.actuated.len()
    }
}
