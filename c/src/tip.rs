//! Inverse kinematics of the body `TOOL`: its way by twists, `..._tip_...` of the header, and the positions of a
//! pose.

use dynamics_core::Engine;
use dynamics_core::algorithms::frame::{self, LocalWorldAligned};
use dynamics_core::model::OnBody;
use dynamics_core::spatial::Motion;
use motion_control::limits::{ConfigError, ConfigParameter, MotionLimits};
use motion_control::motion::{PoseSolverError, TipGoal, TipMotion, TipMotionConfig, TipStatus};

use crate::control::{Config, Where, finite};
use crate::controller::located;
use crate::kinematics::Pose;
use crate::memory::Kept;
use crate::status::{self, NULL};
use crate::{Exports, Library, State, check, field, status_of};

/// The way of a tip: `..._tip` of the header.
pub type Tip<L, const N: usize> = Kept<TipMotion<f32, N>, L>;

/// The numbers of a solver: `..._pose_solver` of the header.
pub type PoseSolver<const N: usize> = motion_control::motion::PoseSolver<f32, N>;

impl<L: Library<N, TOOL, POINTS>, const N: usize, const TOOL: usize, const POINTS: usize>
    Exports<L, N, TOOL, POINTS>
{
    /// The pose of the tip, and its Jacobian in the base's axes.
    fn tip_kinematics(q: &[f32; N]) -> (frame::Pose<f32>, [Motion<f32>; N]) {
        let trig = Engine::<L::Arm>::joint_trig(q);
        let [pose] = Engine::<L::Arm>::poses_of(&trig, OnBody::<TOOL>);
        (pose, Engine::<L::Arm>::jacobian(&trig, OnBody::<TOOL>, LocalWorldAligned))
    }

    /// A tip that rests or moves in a state.
    pub fn tip_init(
        tip: Option<&mut Tip<L, N>>,
        config: Option<&Config<N>>,
        start: Option<&State<N>>,
        damping: f32,
        length: f32,
        posture_gain: f32,
        at: Option<&mut Where>,
    ) -> i32 {
        let (Some(tip), Some(config), Some(start)) = (tip, config, start) else {
            return NULL;
        };
        let &Config { tick, lower, upper, speed, acceleration, .. } = config;
        let limits = core::array::from_fn(|j| MotionLimits {
            velocity: speed[j],
            acceleration: acceleration[j],
        });
        let config = TipMotionConfig {
            tick,
            lower,
            upper,
            limits,
            damping,
            length,
            posture: start.q,
            posture_gain,
        };
        let made = finite(start).and_then(|()| {
            TipMotion::try_new(config, &start.q).map_err(|error| {
                let (field, joint) = match error {
                    ConfigError::OutOfRange {
                        parameter: ConfigParameter::JointRange { joint },
                    } => match acceleration.get(joint) {
                        Some(limit) if limit.is_finite() => (field::RANGE, Some(joint)),
                        _ => (field::ACCELERATION, Some(joint)),
                    },
                    _ => (field::TIP, None),
                };
                (status::CONFIG, Where::of(field, joint, None))
            })
        });
        let made = made.map(|mut motion| {
            // It is finite.
            let _ = motion.restart(start);
            *tip = Kept::of(motion);
        });
        located(made, at)
    }

    /// Advances the reference by a tick, and says which joint slows or limits the tip.
    fn advance(
        tip: Option<&mut Tip<L, N>>,
        reference: Option<&mut State<N>>,
        at: Option<&mut Where>,
        twist: impl FnOnce(&frame::Pose<f32>) -> Motion<f32>,
    ) -> Result<(), i32> {
        let (tip, reference) = (Kept::get_mut(tip)?, reference.ok_or(NULL)?);
        let (pose, jacobian) = Self::tip_kinematics(&tip.state().q);
        let (field, joint, done) = match tip.step(&jacobian, &twist(&pose)) {
            TipStatus::Follows => (field::NONE, None, Ok(())),
            TipStatus::Slowed(joint) => (field::SPEED, Some(joint), Ok(())),
            TipStatus::Limited(joint) => (field::RANGE, Some(joint), Ok(())),
            _ => (field::NONE, None, Err(status::NOT_FINITE)),
        };
        check::results([&tip.state().q, &tip.state().qd, &tip.state().qdd])?;
        *reference = *tip.state();
        if let Some(at) = at {
            *at = Where::of(field, joint, None);
        }
        done
    }

    /// Moves the tip by a twist.
    pub fn tip_step(
        tip: Option<&mut Tip<L, N>>,
        twist: Option<&[f32; 6]>,
        reference: Option<&mut State<N>>,
        at: Option<&mut Where>,
    ) -> i32 {
        status_of(|| {
            let &[a, b, c, x, y, z] = twist.ok_or(NULL)?;
            Self::advance(tip, reference, at, |_| Motion::new([a, b, c].into(), [x, y, z].into()))
        })
    }

    /// Moves the tip towards a pose.
    pub fn tip_goal(
        tip: Option<&mut Tip<L, N>>,
        pose: Option<&Pose>,
        gain: f32,
        angular: f32,
        linear: f32,
        reference: Option<&mut State<N>>,
        at: Option<&mut Where>,
    ) -> i32 {
        status_of(|| {
            // The joints brake without a pose.
            let wanted = pose.ok_or(NULL)?.checked();
            let none = Motion::new([f32::NAN; 3].into(), [f32::NAN; 3].into());
            let twist = |now: &_| {
                wanted.map_or(none, |pose| TipGoal { pose, gain, linear, angular }.twist(now))
            };
            Self::advance(tip, reference, at, twist).map_err(|status| match (status, wanted) {
                (status::NOT_FINITE, Err(status)) | (status, _) => status,
            })
        })
    }

    /// Positions for a pose of the tip.
    pub fn solve_pose(
        solver: Option<&PoseSolver<N>>,
        pose: Option<&Pose>,
        q: Option<&mut [f32; N]>,
    ) -> i32 {
        status_of(|| {
            let (solver, pose, q) =
                (solver.ok_or(NULL)?, pose.ok_or(NULL)?.checked()?, q.ok_or(NULL)?);
            Self::positions(q)?;
            let (found, done) = match solver.solve(&pose, q, Self::tip_kinematics) {
                Ok(found) => (found, Ok(())),
                Err(PoseSolverError::NotReached(nearest)) => (nearest, Err(status::NOT_REACHED)),
                Err(_) => return Err(status::NOT_FINITE),
            };
            Self::positions(&found.q)?;
            *q = found.q;
            done
        })
    }
}
