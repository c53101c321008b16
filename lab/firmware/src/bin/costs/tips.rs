//! A motion of the UR5e's tip.

use dynamics_core::Engine;
use dynamics_core::algorithms::frame::LocalWorldAligned;
use dynamics_core::model::OnBody;
use dynamics_core::robots::Ur5e;
use dynamics_core::spatial::Motion;
use motion_control::limits::{ConfigError, MotionLimits};
use motion_control::motion::{TipGoal, TipMotion, TipMotionConfig, TipStatus};

use super::row::Row;
use super::{Ask, STATES};

const TIP: usize = 5;

/// All of a tick of the tip's motion by a joystick: Jacobian and step.
#[inline(never)]
fn by_twist(tip: &mut TipMotion<f32, 6>, goal: &TipGoal<f32>) -> TipStatus {
    let columns = Engine::<Ur5e>::jacobian(&tip.state().q, OnBody::<TIP>, LocalWorldAligned);
    tip.step(&columns, &Motion::new(goal.pose.pos, goal.pose.rot.x_axis))
}

/// All of a tick towards a pose: pose, Jacobian, the twist, and the step.
#[inline(never)]
fn to_goal(tip: &mut TipMotion<f32, 6>, goal: &TipGoal<f32>) -> TipStatus {
    let trig = Engine::<Ur5e>::joint_trig(&tip.state().q);
    let [pose] = Engine::<Ur5e>::poses_of(&trig, OnBody::<TIP>);
    let columns = Engine::<Ur5e>::jacobian(&trig, OnBody::<TIP>, LocalWorldAligned);
    tip.step(&columns, &goal.twist(&pose))
}

/// The motion of a free arm, and of one whose joints all come to the ends of their ranges.
pub fn rows(asks: &[Ask<6>; STATES]) -> Result<(), ConfigError> {
    let goals = asks.each_ref().map(|ask| {
        let [pose] = Engine::<Ur5e>::poses_of(&ask.trig, OnBody::<TIP>);
        TipGoal { pose, gain: 4.0, linear: 0.5, angular: 1.0 }
    });
    let start = [0.0, -1.2, 1.5, 0.3, 0.7, 0.0];
    type Tick = fn(&mut TipMotion<f32, 6>, &TipGoal<f32>) -> TipStatus;
    for (inputs, range, run) in
        [("twist", 6.2, by_twist as Tick), ("goal", 6.2, to_goal), ("limited", 0.002, to_goal)]
    {
        let mut tip = TipMotion::try_new(
            TipMotionConfig {
                tick: 1e-3,
                lower: start.map(|q| q - range),
                upper: start.map(|q| q + range),
                limits: [MotionLimits { velocity: 3.0, acceleration: 10.0 }; 6],
                damping: 0.01,
                length: 0.3,
                posture: start,
                posture_gain: 0.0,
            },
            &start,
        )?;
        for _ in 0..100 {
            run(&mut tip, &goals[0]);
        }
        Row::of::<Ur5e, 6, 6>("tip_motion", "engine", inputs, true).measure(
            run as usize,
            &goals,
            |goal| run(&mut tip, goal),
        );
    }
    Ok(())
}
