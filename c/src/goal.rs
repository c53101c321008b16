//! A goal that may change at any tick: `..._goal_...` of the header.

use motion_control::limits::ConfigError;
use motion_control::limits::ConfigParameter::JerkLimit;
use motion_control::reference::{GoalError, JerkLimits, MovingGoal, Reference};

use crate::control::{Config, Rejected, Where};
use crate::controller::{bare, located};
use crate::memory::{Handle, Kept};
use crate::status::{self, NULL};
use crate::{Exports, Library, State, check, field, status_of};

/// The motion to a goal: `..._goal` of the header.
pub type Goal<L, const N: usize> = Kept<MovingGoal<f32, N>, L>;
/// A change of it that is spread over ticks: `..._goal_change` of the header.
pub type GoalChange<L, const N: usize> = Kept<motion_control::reference::GoalChange<f32, N>, L>;

fn refused(error: GoalError) -> Rejected {
    match error {
        GoalError::NotFinite { joint } => {
            (status::NOT_FINITE, Where::of(field::POSITION, Some(joint), None))
        }
        GoalError::Start { joint } => {
            (status::TOO_FAST, Where::of(field::ACCELERATION, Some(joint), None))
        }
        GoalError::Torque { joint } => {
            (status::TORQUE_LIMIT, Where::of(field::TORQUE, Some(joint), None))
        }
        GoalError::Missed => bare(status::LATE),
        _ => bare(status::TOO_LONG),
    }
}

/// Gives the tick and the limits of motions to `take`.
fn limit<T, const N: usize>(
    config: Option<&Config<N>>,
    jerk: Option<&[f32; N]>,
    take: impl FnOnce(f32, [JerkLimits<f32>; N]) -> Result<T, ConfigError>,
) -> Result<T, Rejected> {
    let (config, jerk) = config.zip(jerk).ok_or(bare(NULL))?;
    config.check_motion()?;
    let limits = core::array::from_fn(|j| {
        let (velocity, acceleration) = (config.speed[j], config.acceleration[j]);
        JerkLimits { velocity, acceleration, jerk: jerk[j] }
    });
    take(config.tick, limits).map_err(|error| {
        let (field, joint) = match error {
            ConfigError::OutOfRange { parameter: JerkLimit { joint } } => {
                (field::JERK, Some(joint))
            }
            _ => (field::TICK, None),
        };
        (status::CONFIG, Where::of(field, joint, None))
    })
}

impl<L: Library<N, TOOL, POINTS>, const N: usize, const TOOL: usize, const POINTS: usize>
    Exports<L, N, TOOL, POINTS>
{
    /// Limits of motions to goals.
    pub fn goal_init(
        goal: Option<&mut Goal<L, N>>,
        config: Option<&Config<N>>,
        jerk: Option<&[f32; N]>,
        at: Option<&mut Where>,
    ) -> i32 {
        let Some(goal) = goal else { return NULL };
        let made = limit(config, jerk, |tick, limits| MovingGoal::try_new(&[0.0; N], limits, tick));
        located(made.map(|motion| *goal = Kept::of(motion)), at)
    }

    /// Other limits of the motions that are set from now on.
    pub fn goal_limits(
        goal: Option<&mut Goal<L, N>>,
        config: Option<&Config<N>>,
        jerk: Option<&[f32; N]>,
        at: Option<&mut Where>,
    ) -> i32 {
        let goal = Kept::get_mut(goal).map_err(bare);
        let take = |goal: &mut MovingGoal<_, N>| limit(config, jerk, |_, new| goal.set_limits(new));
        located(goal.and_then(take), at)
    }

    /// Leads an arm to a goal, whatever it does.
    pub fn controller_goal(
        memory: Option<Handle>,
        goal: Option<&mut Goal<L, N>>,
        q: Option<&[f32; N]>,
        ticks: Option<&mut u32>,
        at: Option<&mut Where>,
    ) -> i32 {
        let lead = || -> Result<(), Rejected> {
            let (control, goal) =
                (Self::control(memory).map_err(bare)?, Kept::get_mut(goal).map_err(bare)?);
            let q = q.ok_or(bare(NULL))?;
            let arrival = goal.set_from(0, &control.departure(q)?, q).map_err(refused)?;
            if let Some(ticks) = ticks {
                *ticks = arrival;
            }
            Ok(())
        };
        located(lead(), at)
    }

    /// Begins to move a goal, in several ticks.
    pub fn controller_goal_begin(
        memory: Option<Handle>,
        goal: Option<&Goal<L, N>>,
        change: Option<&mut GoalChange<L, N>>,
        start: u32,
        q: Option<&[f32; N]>,
        torque: Option<&[f32; N]>,
        at: Option<&mut Where>,
    ) -> i32 {
        let begin = || -> Result<(), Rejected> {
            let (control, goal) =
                (Self::control(memory).map_err(bare)?, Kept::get(goal).map_err(bare)?);
            let (change, q) = (change.ok_or(bare(NULL))?, q.ok_or(bare(NULL))?);
            control.departure(q)?;
            *change = Kept::of(
                goal.begin_within(start, q, torque.unwrap_or(&[f32::INFINITY; N]))
                    .map_err(refused)?,
            );
            Ok(())
        };
        located(begin(), at)
    }

    /// Goes on with it.
    pub fn controller_goal_advance(
        memory: Option<Handle>,
        goal: Option<&mut Goal<L, N>>,
        change: Option<&mut GoalChange<L, N>>,
        tick: u32,
        ticks: Option<&mut u32>,
        at: Option<&mut Where>,
    ) -> i32 {
        let advance = || -> Result<(), Rejected> {
            let (control, goal) =
                (Self::control(memory).map_err(bare)?, Kept::get_mut(goal).map_err(bare)?);
            let change = Kept::get_mut(change).map_err(bare)?;
            change.step(|state| control.torques(state)).map_err(refused)?;
            if let (Some(arrival), Some(ticks)) = (goal.take(tick, change).map_err(refused)?, ticks)
            {
                *ticks = arrival;
            }
            Ok(())
        };
        located(advance(), at)
    }

    /// The state on the way to a goal.
    pub fn goal_state(goal: Option<&Goal<L, N>>, tick: u32, state: Option<&mut State<N>>) -> i32 {
        status_of(|| {
            let (goal, state) = (Kept::get(goal)?, state.ok_or(NULL)?);
            let now = goal.at(tick);
            check::results([&now.q, &now.qd, &now.qdd])?;
            *state = now;
            Ok(())
        })
    }
}
