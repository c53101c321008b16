//! The state of the loops in a result of forward dynamics: by how much they are open, and whether
//! the rank of K dropped.
//!
//! Both are computed where they are asked for, from what the result carries:
//! [`forward_dynamics`](super::forward_dynamics()) itself has no instruction more.

use super::assembly::{Moving, assemble};
use super::description::Loops;
use super::elimination::Elimination;
use super::error::LoopError;
use super::forward_dynamics::LoopMotion;
use super::{Constraints, constraints};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::State;
use crate::state::manifold::integrate;

/// The error of a loop relative to its size above which it counts as open: the size of a loop is
/// the root of the sum of squares of the motions of its joint per unit rates of all its coordinates
/// ([`Constraints::size`]), thus about the length of its links.
pub const OPEN: f64 = 1e-2;

/// The distance that [`mobility`] goes from a configuration to find the usual rank, rad or m.
const NEARBY: [f64; 4] = [0.05, -0.05, 0.005, -0.005];

/// By how much the loops are open in one state.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Closure<R> {
    /// The loop with the largest error of position.
    pub name: &'static str,
    /// The error of position of that loop relative to its size: 0 if it is closed.
    pub position: R,
    /// The largest error of velocity relative to the size of its loop, rad/s: 0 where the joints'
    /// velocities keep the loops closed.
    pub velocity: R,
}

/// The number of ways in which a machine with loops can move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Mobility {
    /// Degrees of freedom at the configuration: V less the rank of K.
    pub here: usize,
    /// The least of the configurations next to it that the loops allow: those of the machine.
    pub usual: usize,
}

/// Whether the loops constrain as many directions as they usually do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum LoopRank {
    /// They do.
    Full,
    /// They do not: the configuration is closer to a singular one, such as a change point, than
    /// [`RANK_TOLERANCE`](super::RANK_TOLERANCE). The rows that are left out carry no force, and
    /// the accelerations are those of a machine with more degrees of freedom, with a jump to those
    /// next to it.
    Dropped {
        /// The number of further degrees of freedom.
        gained: usize,
    },
}

impl<R: Real, const V: usize, const L: usize, const C: usize> Constraints<R, V, L, C> {
    /// By how much the loops are open, relative to their sizes, in position and velocity.
    pub fn closure<const A: usize>(&self, loops: &Loops<L, C, A>) -> Closure<R> {
        let (position, row) = self.worst();
        let mut velocity = R::ZERO;
        for (&error, &size) in self.velocity.iter().zip(&self.size) {
            let error = error.abs() / size;
            if error > velocity {
                velocity = error;
            }
        }
        let name = loops.name_of_row(row);
        Closure { name, position, velocity }
    }
}

impl<R: Real, const V: usize, const L: usize, const C: usize> LoopMotion<R, V, L, C> {
    /// By how much the loops of this state were open: a result of open loops is that of another
    /// machine.
    ///
    /// Beyond [`OPEN`] of a loop's size [`LoopMotion::closed`] refuses it, as
    /// [`inverse_dynamics`](super::inverse_dynamics()) does.
    ///
    /// ```
    /// use dynamics_core::effects::RIGID_BODY;
    /// use dynamics_core::loops::{self, BodyFrame, LoopError, LoopJoint, Loops, Stabilisation};
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
    ///     LoopJoint::new("pin", Joint::revolute(Y), [BodyFrame::new(2), BodyFrame::new(1).xyz([0.3, 0.0, 0.0])]),
    /// ], [0]);
    /// let at = |q| loops::forward_dynamics(&TREE, &LOOPS, &State::at(q), &[0.0], Stabilisation::NONE, &RIGID_BODY);
    /// assert_eq!(at([0.0_f64; 3])?.closed(&LOOPS)?.closure(&LOOPS).position, 0.0);
    /// // The piston is 0.1 m away from the end of the rod.
    /// let open = at([0.0, 0.0, 0.1])?;
    /// assert!((open.closure(&LOOPS).position * open.constraints.size[4] - 0.1).abs() < 1e-12);
    /// assert!(matches!(open.closed(&LOOPS), Err(LoopError::Open { name: "pin", .. })));
    /// # Ok::<(), LoopError>(())
    /// ```
    pub fn closure<const A: usize>(&self, loops: &Loops<L, C, A>) -> Closure<R> {
        self.constraints.closure(loops)
    }

    /// The same result, if its loops were closed within [`OPEN`] of their sizes.
    ///
    /// # Errors
    /// [`LoopError::Open`] names the loop with the largest error.
    pub fn closed<const A: usize>(self, loops: &Loops<L, C, A>) -> Result<Self, LoopError> {
        let closure = self.closure(loops);
        if closure.position > R::from_f64(OPEN) {
            let (name, error) = (closure.name, closure.position.to_f64());
            return Err(LoopError::Open { name, error });
        }
        Ok(self)
    }

    /// Whether the rank of K is that of the machine, whose [`mobility`] is computed once, at any
    /// closed configuration.
    pub fn rank(&self, machine: &Mobility) -> LoopRank {
        match V.saturating_sub(self.rows.rank() + machine.usual) {
            0 => LoopRank::Full,
            gained => LoopRank::Dropped { gained },
        }
    }
}

/// The degrees of freedom at a closed configuration, and those of the machine: the least next to
/// it.
///
/// # Cost
/// The cost of [`assemble`] four times for each degree of freedom: once for a machine, not for the
/// control tick.
///
/// # Example
/// ```
/// use dynamics_core::effects::RIGID_BODY;
/// use dynamics_core::loops::{self, BodyFrame, LoopJoint, LoopRank, Loops, Mobility, Stabilisation};
/// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
/// use dynamics_core::state::State;
/// const Y: [f64; 3] = [0.0, 1.0, 0.0];
/// /// A parallelogram that lies flat at q = 0: from there it may go on as an antiparallelogram.
/// const TREE: ArmModel<f64, 3> = Model::new("parallelogram", [
///     Body::new("crank", BASE, Joint::revolute(Y)).mass(1.0).com([0.1, 0.0, 0.0]),
///     Body::new("coupler", 0, Joint::revolute(Y)).xyz([0.2, 0.0, 0.0]).mass(1.0).com([0.25, 0.0, 0.0]),
///     Body::new("rocker", BASE, Joint::revolute(Y)).xyz([0.5, 0.0, 0.0]).mass(1.0).com([0.1, 0.0, 0.0]),
/// ]);
/// const LOOPS: Loops<1, 5, 1> = Loops::new(&TREE, [
///     LoopJoint::new("pin", Joint::revolute(Y), [
///         BodyFrame::new(1).xyz([0.5, 0.0, 0.0]),
///         BodyFrame::new(2).xyz([0.2, 0.0, 0.0]),
///     ]),
/// ], [0]);
/// let machine = loops::mobility(&TREE, &LOOPS, &[0.0_f64; 3])?;
/// assert_eq!(machine, Mobility { here: 2, usual: 1 });
/// let at = |q| loops::forward_dynamics(&TREE, &LOOPS, &State::at(q), &[0.0], Stabilisation::NONE, &RIGID_BODY);
/// assert_eq!(at([0.1, -0.1, 0.1])?.rank(&machine), LoopRank::Full);
/// assert_eq!(at([0.0; 3])?.rank(&machine), LoopRank::Dropped { gained: 1 });
/// # Ok::<(), loops::LoopError>(())
/// ```
///
/// # Errors
/// [`LoopError::Open`] of loops that are not closed at q, [`LoopError::NotFinite`] of a q that is
/// not finite.
pub fn mobility<
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
    q: &[R; Q],
) -> Result<Mobility, LoopError>
where
    D: RobotModel<R, B, Q, V>,
{
    let at = |q: &[R; Q]| constraints(robot, loops, &State::<R, Q, V>::at(*q));
    let closing = at(q);
    closing.check(loops)?;
    let closure = closing.closure(loops);
    if closure.position > R::from_f64(OPEN) {
        let (name, error) = (closure.name, closure.position.to_f64());
        return Err(LoopError::Open { name, error });
    }
    let freedoms = |closing: &Constraints<R, V, L, C>| {
        let mut elimination = Elimination::blank();
        elimination.eliminate(closing, loops, |_| true, &closing.scale());
        V - elimination.loop_rows().rank()
    };
    let here = freedoms(&closing);
    let mut usual = here;
    let mut elimination = Elimination::blank();
    elimination.eliminate(&closing, loops, |_| true, &closing.scale());
    for free in elimination.free() {
        let mut unit = [R::ZERO; V];
        if let Some(unit) = unit.get_mut(free) {
            *unit = R::ONE;
        }
        let motion = elimination.complete(&unit);
        let largest = motion.iter().fold(
            R::ONE,
            |largest, x| {
                if x.abs() > largest { x.abs() } else { largest }
            },
        );
        for way in NEARBY {
            let step = motion.map(|x| x * (R::from_f64(way) / largest));
            let guess = integrate(robot, q, &step);
            // If the loops do not close there, another way leads on.
            if let Ok(next) = assemble(robot, loops, &guess, Moving::All) {
                usual = usual.min(freedoms(&at(&next.q)));
            }
        }
    }
    Ok(Mobility { here, usual })
}
