//! Loop constraints: K, k, and the errors of position and velocity.
//!
//! Featherstone, RBDA (2008), section 8.2. The velocity of a loop joint's successor relative to its
//! predecessor, Tᵀ (v_s − v_p), in the successor's loop frame. Only the joints between the two
//! bodies and their nearest common ancestor count: what moves that ancestor, and how far away the
//! base is, does not enter.

use core::borrow::Borrow;

use heapless::Vec;

use super::Stabilisation;
use super::chain::{LoopBodies, common_ancestor, inverse};
use super::description::{Loops, NONE};
use super::error::LoopError;
use super::joint_constraint::counts;
use super::loop_joint::LoopJoint;
use crate::model::{BASE, JointCoordinate, RobotModel};
use crate::scalar::{Real, Vector};
use crate::spatial::{Force, Motion, Xform};
use crate::state::{Configuration, RobotState, all_finite, entry};

/// The constraints of L loops in one state: K q̇ = 0 and K q̈ = k where the loops are closed and
/// remain so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constraints<R: Real, const V: usize, const L: usize, const C: usize> {
    /// K by rows, those of a loop's rotations before those of its translations.
    pub jacobian: [[R; V]; C],
    /// k, rad/s² and m/s².
    pub bias: [R; C],
    /// φ, the error of position of each row, rad and m.
    pub position: [R; C],
    /// K q̇, the error of velocity of each row, rad/s and m/s.
    pub velocity: [R; C],
    /// The size of a loop for each of its rows: the root of the sum of squares of the rotations, or
    /// translations, that unit rates of all coordinates of the loop give its successor. One for
    /// rows of a loop that none moves.
    pub size: [R; C],
    /// From each predecessor's aligned loop frame to the successor's.
    poses: [Xform<R>; L],
    /// The nearest common ancestor of the two bodies of each loop joint.
    ancestors: [usize; L],
    /// The only loop that moves a coordinate, or [`NONE`].
    own_loop: [usize; V],
}

impl<R: Real, const V: usize, const L: usize, const C: usize> Constraints<R, V, L, C> {
    /// The largest error of position relative to the size of its loop, and its row.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn worst(&self) -> (R, usize) {
        let mut worst = (R::ZERO, 0);
        for (row, (&error, &size)) in self.position.iter().zip(&self.size).enumerate() {
            let error = error.abs() / size;
            if error > worst.0 {
                worst = (error, row);
            }
        }
        worst
    }

    /// One over the size of the loop of each row.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn scale(&self) -> [R; C] {
        self.size.map(|size| R::ONE / size)
    }

    /// The rows of K over the sizes of their loops.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn scaled(&self) -> [[R; V]; C] {
        let mut rows = self.jacobian;
        for (row, by) in rows.iter_mut().zip(self.scale()) {
            row.iter_mut().for_each(|entry| *entry *= by);
        }
        rows
    }

    /// The errors of position over the sizes of their loops.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn error(&self) -> [R; C] {
        scaled(self.position, &self.scale())
    }

    /// k over the sizes of the loops.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn scaled_bias(&self) -> [R; C] {
        scaled(self.bias, &self.scale())
    }

    /// Row `row` of K q̈, with what stabilises it.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn wanted(&self, row: usize, by: Stabilisation<R>) -> R {
        let errors =
            by.velocity * entry(&self.velocity, row) + by.position * entry(&self.position, row);
        entry(&self.bias, row) - errors
    }

    /// The loop that a coordinate moves most; the robot if it moves none.
    pub(super) fn name_of<const A: usize>(
        &self,
        loops: &Loops<L, C, A>,
        coordinate: usize,
    ) -> &'static str {
        let (mut largest, mut most) = (R::ZERO, C);
        for (i, (row, &size)) in self.jacobian.iter().zip(&self.size).enumerate() {
            let moves = (entry(row, coordinate) / size).abs();
            if moves > largest {
                (largest, most) = (moves, i);
            }
        }
        loops.name_of_row(most)
    }

    /// The force of loop joint `i` on its successor, N·m about the origin and N, along the axes of
    /// the successor's loop frame, from the λ of all loops. Its predecessor gets the opposite
    /// force.
    pub fn force<const A: usize>(
        &self,
        loops: &Loops<L, C, A>,
        i: usize,
        lambda: &[R; C],
    ) -> Force<R> {
        let pose = self.poses.get(i).copied();
        loops.wrench(i, pose.unwrap_or(Xform::IDENTITY), lambda)
    }

    /// Whether coordinate `i` moves loop `of` and no other.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn is_own(&self, i: usize, of: usize) -> bool {
        self.own_loop.get(i) == Some(&of)
    }

    /// # Errors
    /// [`LoopError::NotFinite`] with the name of the first loop of which a number is not finite.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn check<const A: usize>(&self, loops: &Loops<L, C, A>) -> Result<(), LoopError> {
        // The size of a loop is not finite where an entry of K is not.
        let all = [&self.size, &self.position, &self.velocity, &self.bias];
        if all.iter().all(|of_rows| all_finite(&of_rows[..])) {
            return Ok(());
        }
        let is_finite =
            |row: &usize| all.iter().all(|of_rows| entry(&of_rows[..], *row).is_finite());
        let row = (0..C).find(|row| !is_finite(row)).unwrap_or_default();
        let name = loops.name_of_row(row);
        Err(LoopError::NotFinite { name })
    }
}

/// Numbers of rows times those of the scale.
#[cfg_attr(optimised, inline(always))]
pub(super) fn scaled<R: Real, const C: usize>(mut rows: [R; C], scale: &[R; C]) -> [R; C] {
    for (x, &scale) in rows.iter_mut().zip(scale) {
        *x *= scale;
    }
    rows
}

/// The constraint Jacobian K and bias k of all loops, and their errors of position and velocity.
///
/// `state.qdd` is not read.
///
/// # Shape
/// C × V and C.
///
/// # Cost
/// O(C V) in all; for each joint of a loop some 200 flops.
///
/// # Source
/// Featherstone, RBDA (2008), section 8.2.
///
/// # Example
/// ```
/// use dynamics_core::loops::{BodyFrame, LoopJoint, Loops, constraints};
/// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
/// use dynamics_core::state::State;
/// const Y: [f64; 3] = [0.0, 1.0, 0.0];
/// const TREE: ArmModel<f64, 3> = Model::new("slider_crank", [
///     Body::new("crank", BASE, Joint::revolute(Y)).mass(1.0).com([0.05, 0.0, 0.0]),
///     Body::new("rod", 0, Joint::revolute(Y)).xyz([0.1, 0.0, 0.0]).mass(1.0).com([0.15, 0.0, 0.0]),
///     Body::new("piston", BASE, Joint::prismatic([1.0, 0.0, 0.0])).xyz([0.4, 0.0, 0.0]).mass(0.5),
/// ]);
/// const LOOPS: Loops<1, 5, 1> = Loops::new(&TREE, [
///     LoopJoint::new("pin", Joint::revolute(Y), [
///         BodyFrame::new(2),
///         BodyFrame::new(1).xyz([0.3, 0.0, 0.0]),
///     ]),
/// ], [0]);
/// let stretched = constraints(&TREE, &LOOPS, &State { qd: [1.0, 0.0, 0.0], ..State::at([0.0; 3]) });
/// assert_eq!(stretched.position, [0.0; 5]); // the rod reaches the piston
/// assert!(stretched.velocity.iter().any(|error| error.abs() > 0.3)); // m/s: the crank alone would lift its end
/// ```
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn constraints<
    R: Real,
    D,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>(
    robot: &D,
    loops: &Loops<L, C, A>,
    state: impl RobotState<R, Q, V>,
) -> Constraints<R, V, L, C>
where
    D: RobotModel<R, B, Q, V>,
{
    let trig = state.configuration().trig_of(robot);
    let turns = &trig.borrow().coordinates;
    let mut all = Constraints::blank();
    let mut bodies = LoopBodies::blank();
    all.set_positions(robot, loops, turns, &mut bodies);
    all.set_rates(robot, loops, &bodies, (turns, &state.state().qd));
    all
}

impl<R: Real, const V: usize, const L: usize, const C: usize> Constraints<R, V, L, C> {
    /// Nothing, to be filled where it stands: it is large.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn blank() -> Self {
        Self {
            jacobian: [[R::ZERO; V]; C],
            bias: [R::ZERO; C],
            position: [R::ZERO; C],
            velocity: [R::ZERO; C],
            size: [R::ONE; C],
            poses: [Xform::IDENTITY; L],
            ancestors: [BASE; L],
            own_loop: [NONE; V],
        }
    }

    /// K and φ of constraints that are blank, and the bodies between the ends of the loops.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn set_positions<D, const B: usize, const Q: usize, const A: usize>(
        &mut self,
        robot: &D,
        loops: &Loops<L, C, A>,
        turns: &[JointCoordinate<R>; Q],
        bodies: &mut LoopBodies<R, B>,
    ) where
        D: RobotModel<R, B, Q, V>,
    {
        let mut is_moved = [false; V];
        let ends = loops.joints.each_ref().map(LoopJoint::bodies);
        self.ancestors = ends.map(|ends| common_ancestor(robot, ends));
        bodies.set(robot, ends.iter().zip(&self.ancestors), turns);
        for (i, (joint, [frame_p, frame_s])) in loops.ends::<R>().enumerate() {
            let [p, s] = joint.bodies();
            let ancestor = entry(&self.ancestors, i);
            let mut columns: Vec<(usize, Motion<R>), V> = Vec::new();
            let on_s = (s, frame_s);
            let from_s = bodies.of_frame(robot, turns, on_s, ancestor, |coordinate, column| {
                let _ = columns.push((coordinate, column.motion()));
            });
            let from_p = bodies.of_frame(robot, turns, (p, frame_p), ancestor, |_, _| ());
            let x = from_s * inverse(&from_p);
            bodies.columns(robot, turns, (p, frame_p), ancestor, |coordinate, column| {
                let _ = columns.push((coordinate, column.opposite(&x)));
            });

            let constraint = loops.constraint(joint, x);
            let rows = loops.rows(i);
            let of_loop = self.jacobian.get_mut(rows.clone()).unwrap_or_default();
            let [rotations, _] = counts(joint.joint.kind);
            let mut squares = [R::ZERO; 2];
            for &(coordinate, column) in &columns {
                let [ang, lin] = &mut squares;
                if rotations > 0 {
                    *ang += column.ang.dot(column.ang);
                }
                *lin += column.lin.dot(column.lin);
                for (row, x) in of_loop.iter_mut().zip(constraint.across(column)) {
                    if let Some(entry) = row.get_mut(coordinate) {
                        *entry = x;
                    }
                }
                if let (Some(own), Some(is_moved)) =
                    (self.own_loop.get_mut(coordinate), is_moved.get_mut(coordinate))
                {
                    *own = if *is_moved { NONE } else { i };
                    *is_moved = true;
                }
            }
            let sizes = squares.map(|square| {
                // A NaN remains one.
                if square == R::ZERO { R::ONE } else { square * square.rsqrt() }
            });
            let position = constraint.position();
            for (k, row) in rows.enumerate() {
                if let (Some(p), Some(s)) = (self.position.get_mut(row), self.size.get_mut(row)) {
                    *p = entry(&position, k);
                    *s = if k < rotations { sizes[0] } else { sizes[1] };
                }
            }
            if let Some(pose) = self.poses.get_mut(i) {
                *pose = x;
            }
        }
    }

    /// K q̇ and k.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn set_rates<D, const B: usize, const Q: usize, const A: usize>(
        &mut self,
        robot: &D,
        loops: &Loops<L, C, A>,
        bodies: &LoopBodies<R, B>,
        (turns, qd): (&[JointCoordinate<R>; Q], &[R; V]),
    ) where
        D: RobotModel<R, B, Q, V>,
    {
        let ends = loops.ends::<R>().zip(&self.poses).enumerate();
        for (i, ((joint, [frame_p, frame_s]), &x)) in ends {
            let [p, s] = joint.bodies();
            let ancestor = entry(&self.ancestors, i);
            let [v_p, a_p] = bodies.motion(robot, (turns, qd), (p, frame_p), ancestor);
            let [v_s, a_s] = bodies.motion(robot, (turns, qd), (s, frame_s), ancestor);
            let v_p = x * v_p;
            let v = v_s - v_p;
            let a = a_s - x * a_p + v.cross(v_p);
            let constraint = loops.constraint(joint, x);
            let velocity = constraint.across(v);
            let (known, apparent) = (constraint.across(a), constraint.apparent(v));
            for (k, row) in loops.rows(i).enumerate() {
                if let (Some(v), Some(b)) = (self.velocity.get_mut(row), self.bias.get_mut(row)) {
                    *v = entry(&velocity, k);
                    *b = -(entry(&known, k) + entry(&apparent, k));
                }
            }
        }
    }
}
