//! An algorithm, and a call of it for a robot of a type.

use dynamics_core::model::RobotModel;
use dynamics_core::scalar::Real;

use crate::job::{Failure, Problem, Row, Rows};
use crate::lanes::Lanes;
use crate::model::Counts;
use crate::scene::{Parts, Terms};

/// Nothing, or where it cannot be computed.
pub type Done = Result<(), Failure>;

/// The general models for which an algorithm is compiled: each costs as much machine code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sizes {
    /// It is among the most used.
    Both,
    /// The smaller one alone.
    Small,
    /// The larger one alone.
    Large,
}

/// A call of an algorithm for a robot of a type.
pub struct Call<'a, D, P, R: Real, const V: usize> {
    /// The model of the robot.
    pub robot: &'a D,
    /// The numbers of its bodies and coordinates.
    pub counts: Counts,
    /// The terms of the scene.
    pub terms: Terms,
    /// The effects besides these terms.
    pub parts: &'a Parts<R, V>,
    /// The rows that are computed.
    pub rows: &'a mut P,
}

/// An algorithm that computes the rows of a call.
pub trait Algorithm: Sync {
    /// Whether the library has a form of it for some kinds of robots.
    const FAST: bool = false;
    /// Whether that form is compiled for scenes with these terms.
    fn fits(terms: Terms) -> bool;
    /// Whether it depends on the state and the terms alone, not on torques at joints.
    const TERMS_ALONE: bool = false;
    /// Whether it computes what fills the model up, too, with the inertia 1: M then has its
    /// factors.
    const WHOLE: bool = false;
    /// The general models for which it is compiled.
    const SIZES: Sizes;
    /// Whether it computes several states at once: its only comparisons are those of pivots, and of
    /// placements, which its states share.
    const LANES: bool = false;

    /// Computes one row, of a scene with the products of accelerations (A), of velocities (C) and
    /// effects at bodies (X).
    ///
    /// # Errors
    /// Why this state has no result.
    fn row<
        R: Real,
        D: RobotModel<R, B, Q, V>,
        const B: usize,
        const Q: usize,
        const V: usize,
        const A: bool,
        const C: bool,
        const X: bool,
    >(
        &self,
        robot: &D,
        counts: Counts,
        parts: &Parts<R, V>,
        row: &mut impl Row<R>,
    ) -> Result<(), Problem>;

    /// Computes all blocks of rows in the scene of the call, which has no effects at bodies.
    ///
    /// # Errors
    /// The block and why it has none.
    fn blocks<D, P, const B: usize, const Q: usize, const V: usize>(
        &self,
        call: Call<'_, D, P, Lanes, V>,
    ) -> Done
    where
        D: RobotModel<Lanes, B, Q, V>,
        P: Rows<Lanes>;

    /// Computes all rows in the scene of the call.
    ///
    /// # Errors
    /// The row and why it has none.
    fn all<R: Real, D, P, const B: usize, const Q: usize, const V: usize>(
        &self,
        call: Call<'_, D, P, R, V>,
    ) -> Done
    where
        D: RobotModel<R, B, Q, V>,
        P: Rows<R>;
}
