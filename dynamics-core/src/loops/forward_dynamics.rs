//! Forward dynamics with kinematic loops.
//!
//! Featherstone, RBDA (2008), section 8.1: M q̈ + C = τ + Kᵀ λ and K q̈ = k. By the factors of the
//! tree's M, in the coordinates that the elimination of K leaves free: q̈ = G ÿ + ġ, section 8.11.

use core::borrow::Borrow;

use super::chain::LoopBodies;
use super::description::Loops;
use super::elimination::{Elimination, LoopRows, subtract};
use super::error::LoopError;
use super::factors::Factors;
use super::least_constraint::{Metric, Orthogonal};
use super::{Constraints, Stabilisation};
use crate::algorithms::{crba, ltdl_in_place, rnea};
use crate::effects::{Bias, Effect, no_load_friction};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::{Configuration, RobotState, all_finite};

/// The accelerations of the joints, and the forces that keep the loops closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopMotion<R: Real, const V: usize, const L: usize, const C: usize> {
    /// Acceleration of each joint, rad/s² or m/s².
    pub qdd: [R; V],
    /// λ: the force of the loop joints along each row of K, N·m and N; zero for redundant rows.
    /// [`Constraints::force`] makes wrenches of it.
    pub lambda: [R; C],
    /// Which rows of K were independent.
    pub rows: LoopRows<C>,
    /// The constraints of this state.
    pub constraints: Constraints<R, V, L, C>,
}

/// The acceleration of each joint, q̈, rad/s² or m/s², and the forces of the loop joints, from the
/// torques of the actuated coordinates.
///
/// `state.qdd` is not read. The state need not be closed: errors are corrected as `stabilisation`
/// says, and [`LoopMotion::closure`] says how large they are; [`LoopMotion::closed`] refuses loops
/// that are open by more than [`OPEN`](super::OPEN) of their sizes. If rows of K depend on each
/// other, those that elimination finds last are left out, and carry no force; [`LoopMotion::rank`]
/// says whether these are more than usual, as at a change point, where the accelerations jump.
///
/// # Shape
/// V, and C.
///
/// # Cost
/// The cost of [`rnea`](crate::algorithms::rnea()), [`crba`](crate::algorithms::crba()),
/// [`ltdl`](crate::algorithms::ltdl()), [`constraints`](super::constraints()) and
/// [`coordinate_map`](super::coordinate_map()); with n degrees of freedom 4 n² V flops for the
/// motion.
///
/// # Source
/// Featherstone, RBDA (2008), sections 8.1, 8.3 and 8.11.
///
/// # Example
/// ```
/// use dynamics_core::effects::RIGID_BODY;
/// use dynamics_core::loops::{self, BodyFrame, LoopJoint, Loops, Stabilisation};
/// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
/// use dynamics_core::state::State;
/// const Y: [f64; 3] = [0.0, 1.0, 0.0];
/// const TREE: ArmModel<f64, 3> = Model::new("slider_crank", [
///     Body::new("crank", BASE, Joint::revolute(Y)).mass(1.0).com([0.05, 0.0, 0.0]),
///     Body::new("rod", 0, Joint::revolute(Y)).xyz([0.1, 0.0, 0.0]).mass(1.0).com([0.15, 0.0, 0.0])
///         .inertia([0.0, 0.0, 0.0, 0.0075, 0.0, 0.0075]),
///     Body::new("piston", BASE, Joint::prismatic([1.0, 0.0, 0.0])).xyz([0.4, 0.0, 0.0]).mass(0.5),
/// ]);
/// const LOOPS: Loops<1, 5, 1> = Loops::new(&TREE, [
///     LoopJoint::new("pin", Joint::revolute(Y), [
///         BodyFrame::new(2),
///         BodyFrame::new(1).xyz([0.3, 0.0, 0.0]),
///     ]),
/// ], [0]);
/// // The piston carries the far end of the rod that falls.
/// let state = State::at([0.0_f64; 3]);
/// let free = loops::forward_dynamics(&TREE, &LOOPS, &state, &[0.0], Stabilisation::NONE, &RIGID_BODY)?;
/// let force = free.constraints.force(&LOOPS, 0, &free.lambda);
/// assert!(force.lin.length() > 1.0 && free.rows.rank() == 2);
/// assert!((free.qdd[1] / free.qdd[0] + 4.0 / 3.0).abs() < 1e-12); // its end stays in the cylinder
/// # Ok::<(), loops::LoopError>(())
/// ```
///
/// # Errors
/// [`LoopError::NotPositiveDefinite`] names a joint of the tree that moves no inertia,
/// [`LoopError::NotFinite`] the first loop that a number which is not finite reaches.
#[doc(alias = "constraintDynamics")]
#[doc(alias = "closed loops")]
#[cfg_attr(optimised, inline(always))]
pub fn forward_dynamics<
    R: Real,
    D,
    E,
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
    tau: &[R; A],
    stabilisation: Stabilisation<R>,
    effects: &E,
) -> Result<LoopMotion<R, V, L, C>, LoopError>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    const { assert!(E::ACCELERATIONS, "forward dynamics needs `Inertia` in the scene") };
    no_load_friction::<R, E, B, V>();
    let turns = &trig.coordinates;
    let mut closing = Constraints::blank();
    let mut bodies = LoopBodies::blank();
    closing.set_positions(robot, loops, turns, &mut bodies);
    closing.set_rates(robot, loops, &bodies, (turns, &state.qd));
    closing.check(loops)?;
    let right = core::array::from_fn(|row| closing.wanted(row, stabilisation));
    let mut elimination = Elimination::blank();
    let mut factors = Factors::blank(&mut elimination);
    factors.set(&closing, loops, &right);
    let rows = factors.loop_rows();

    let mut rest = rnea(robot, trig.with(state), &Bias(effects)).map(|bias| -bias);
    for (&joint, &tau) in loops.actuated().iter().zip(tau) {
        if let Some(rest) = rest.get_mut(joint) {
            *rest += tau;
        }
    }
    let mut m = crba(robot, trig, effects);
    ltdl_in_place(robot, &mut m)?;
    // q̈ = G ÿ + ġ with the ÿ of least constraint.
    let mut qdd = factors.solution();
    let metric = Metric::of(robot, &m.rows);
    let mut apart = metric.of_torque(&rest);
    subtract(&mut apart, R::ONE, &metric.weigh(metric.of_acceleration(&qdd)));
    let mut orthogonal = Orthogonal::blank();
    let motions = factors.free().rev();
    orthogonal.set(&metric, motions.map(|free| factors.motion(free)));
    orthogonal.approach(&mut apart, &mut qdd);
    // M q̈ differs from the torques as the motion differs from its own without loops.
    let lambda = factors.force(metric.to_torque(&apart.map(|x| -x)));
    if !(all_finite(&qdd) & all_finite(&lambda)) {
        let name = loops.robot;
        return Err(LoopError::NotFinite { name });
    }
    Ok(LoopMotion { qdd, lambda, rows, constraints: closing })
}
