//! The cost of M, forward dynamics and Jacobians on the UR5e, and of a motion of its tip.
#![no_std]
#![no_main]

mod costs;

use costs::row::Row;
use costs::{Ask, STATES, asks};
use dynamics_core::Engine;
use dynamics_core::algorithms::frame::LocalWorldAligned;
use dynamics_core::model::OnBody;
use motion_control::{ConfigError, MotionLimits, TipGoal, TipMotion, TipMotionConfig, TipStatus};
use robots::Ur5e;

const TIP: usize = 5;

/// All of a tick of the tip's motion: pose, Jacobian, the twist towards a goal, and the step.
#[inline(never)]
fn tip_motion(tip: &mut TipMotion<f32, 6>, goal: &TipGoal<f32>) -> TipStatus {
    let trig = Engine::<Ur5e>::joint_trig(&tip.state().q);
    let [pose] = Engine::<Ur5e>::poses_of(&trig, OnBody::<TIP>);
    let columns = Engine::<Ur5e>::jacobian(&trig, OnBody::<TIP>, LocalWorldAligned);
    tip.step(&columns, &goal.twist(&pose))
}

/// Of a free arm, and of one of which each joint comes to the end of its range in these ticks.
fn tips(asks: &[Ask<6>; STATES]) -> Result<(), ConfigError> {
    let goals = asks.each_ref().map(|ask| {
        let [pose] = Engine::<Ur5e>::poses_of(&ask.trig, OnBody::<TIP>);
        TipGoal { pose, gain: 4.0, linear: 0.5, angular: 1.0 }
    });
    let start = [0.0, -1.2, 1.5, 0.3, 0.7, 0.0];
    for (inputs, range) in [("full", 6.2), ("limited", 0.002)] {
        let mut tip = TipMotion::try_new(
            TipMotionConfig {
                tick: 1e-3,
                lower: start.map(|q| q - range),
                upper: start.map(|q| q + range),
                limits: [MotionLimits { velocity: 3.0, acceleration: 10.0 }; 6],
                damping: 0.01,
                length: 0.3,
                posture: start,
                posture_gain: 1.0,
            },
            &start,
        )?;
        for _ in 0..100 {
            tip_motion(&mut tip, &goals[0]);
        }
        let run = tip_motion;
        Row::of::<Ur5e, 6, 6>("tip_motion", "engine", inputs, true).measure(
            run as *const () as usize,
            &goals,
            |goal| run(&mut tip, goal),
        );
    }
    Ok(())
}

fn run() -> ! {
    if tips(&asks::<Ur5e, 6, 6, STATES>()).is_err() {
        costs::done()
    }
    costs::forward::both::<Ur5e, 6, 6, TIP>()
}

costs::main!(run());
