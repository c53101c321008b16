//! Inverse dynamics with kinematic loops.
//!
//! Featherstone, RBDA (2008), section 8.12: the torques τ of the tree's inverse dynamics, as if
//! every joint had a motor, and those of the actuated coordinates that do the same work, Gᵀ τ_a =
//! Gᵀ τ.

use core::borrow::Borrow;

use super::Constraints;
use super::chain::LoopBodies;
use super::coordinate_map::{CoordinateMap, Drive};
use super::description::Loops;
use super::elimination::LoopRows;
use super::error::LoopError;
use crate::algorithms::rnea;
use crate::effects::{Effect, no_load_friction};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::{Configuration, RobotState, State, all_finite, entry};

/// The torques of the motors, and what follows from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopTorque<R: Real, const Q: usize, const V: usize, const C: usize, const A: usize> {
    /// The torque of each actuated coordinate, N·m or N.
    pub tau: [R; A],
    /// The state with the velocities and accelerations of all coordinates.
    pub state: State<R, Q, V>,
    /// λ: the force of the loop joints along each row of K, N·m and N; zero for redundant rows.
    pub lambda: [R; C],
    /// Whether the motion determines the torques.
    pub drive: Drive,
    /// Which rows of K were independent.
    pub rows: LoopRows<C>,
}

/// The torque of each motor of a robot with closed loops, τ_a = ID(q, ẏ, ÿ), N·m or N, under the
/// effects of the scene.
///
/// q is that of all coordinates, with closed loops, from [`super::assemble`]. The independent
/// coordinates of q̇ and q̈ are read, all of which are actuated; the others follow from them. A
/// coordinate that no motor moves and that does no work, such as the spin of a rod between two ball
/// joints, is under-actuation: give it a universal joint.
///
/// At a dead point of the motors, and near it, torques, velocities and accelerations are those of
/// damped least squares: finite, bounded as [`Loops::damped_below`] says, and without a jump where
/// the damping ends. [`LoopTorque::drive`] is then [`Drive::Singular`], and the loops are not
/// closed by the velocities.
///
/// # Shape
/// A.
///
/// # Cost
/// The cost of [`rnea`](crate::algorithms::rnea()), of [`constraints`](super::constraints()) twice
/// and of [`coordinate_map`](super::coordinate_map()). Near a dead point V² C + 3 V³ flops more.
///
/// # Source
/// Featherstone, RBDA (2008), section 8.12.
///
/// # Example
/// ```
/// use dynamics_core::effects::RIGID_BODY;
/// use dynamics_core::loops::{self, BodyFrame, Drive, LoopJoint, Loops};
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
/// let at_rest = loops::inverse_dynamics(&TREE, &LOOPS, &State::at([0.0_f64; 3]), &RIGID_BODY)?;
/// assert!((at_rest.tau[0] + 9.81 * (0.05 + 0.05)).abs() < 1e-12); // the piston carries half of the rod
/// assert_eq!(at_rest.drive, Drive::Determined);
/// # Ok::<(), loops::LoopError>(())
/// ```
///
/// # Errors
/// As [`coordinate_map`](super::coordinate_map()), and [`LoopError::NotFinite`] where a velocity,
/// an acceleration or the result is not finite: a torque never is NaN.
#[doc(alias = "closed loops")]
#[doc(alias = "parallel robot")]
#[cfg_attr(optimised, inline(always))]
pub fn inverse_dynamics<
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
    effects: &E,
) -> Result<LoopTorque<R, Q, V, C, A>, LoopError>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    no_load_friction::<R, E, B, V>();
    let trig = state.configuration().trig_of(robot);
    let (trig, given) = (trig.borrow(), state.state());
    let mut state = State::at(given.q);
    let turns = &trig.coordinates;
    let mut closing = Constraints::blank();
    let mut bodies = LoopBodies::blank();
    closing.set_positions(robot, loops, turns, &mut bodies);
    let mut map = CoordinateMap::blank(loops);
    map.set(robot, loops, (turns, &bodies), &closing)?;
    state.qd = map.velocity(&loops.of_actuated(&given.qd));
    closing.set_rates(robot, loops, &bodies, (turns, &state.qd));
    closing.check(loops)?;
    state.qdd = map.acceleration(&loops.of_actuated(&given.qdd), &closing.bias);

    let tree = rnea(robot, trig.with(&state), effects);
    let tau = map.torque(&tree);
    let mut rest = tree;
    for (&joint, &tau) in loops.actuated.iter().zip(&tau) {
        if let Some(rest) = rest.get_mut(joint) {
            *rest -= tau;
        }
    }
    let lambda = map.lambda(&rest);
    if !(all_finite(&tau) & all_finite(&lambda) & all_finite(&state.qdd)) {
        let name = loops.robot;
        return Err(LoopError::NotFinite { name });
    }
    Ok(LoopTorque { tau, state, lambda, drive: map.drive(), rows: map.rows() })
}

impl<const L: usize, const C: usize, const A: usize> Loops<L, C, A> {
    /// Picks the values of the actuated coordinates out of those of all coordinates.
    #[cfg_attr(optimised, inline(always))]
    fn of_actuated<R: Real, const V: usize>(&self, all: &[R; V]) -> [R; A] {
        self.actuated.map(|joint| entry(all, joint))
    }
}
