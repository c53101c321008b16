//! Scene `jog`: a joystick moves the tip of a UR5e, to the end of its reach, through a singular
//! posture of the wrist and into a joint's limit, with the arm's full model as feed-forward.
//!
//! The stick is read in each tick, and [`TipMotion`] makes a reference of its twist: Jacobian and
//! inverse kinematics are in the phase `reference` of the tick.

use core::cell::RefCell;

use dynamics_core::Engine;
use dynamics_core::algorithms::frame::LocalWorldAligned;
use dynamics_core::effects::Effect;
use dynamics_core::model::{OnBody, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::spatial::Motion;
use dynamics_core::state::State;
use glam::Vec3;
use motion_control::limits::MotionLimits;
use motion_control::motion::{TipMotion, TipMotionConfig};
use motion_control::reference::{Reference, TrajectoryError};

use super::ur5e::{EFFECTS, Effects, GravityOnly, PickAndPlace};
use crate::plant::Plant;
use crate::scene::{Noise, PlantModel, Run, Scene, TICK};
use crate::trajectories::HOME;

pub const TIP: OnBody<{ Ur5e::MODEL.body("wrist_3") }> = OnBody;

/// The range of each joint either side of zero, rad: what the cell allows, less than the arm's own.
pub const RANGE: [f32; 6] = [2.5, 2.8, 2.8, 2.8, 2.2, 1.2];
/// The greatest speed and acceleration of each joint.
pub const LIMITS: MotionLimits<f32> = MotionLimits { velocity: 2.0, acceleration: 10.0 };

/// Readings of the stick: the ticks in which it comes there at even speed, 0 for at once, those in
/// which it stays, and its axes. Turns about the base's axes come first, full deflection is 127.
static STICK: [(i32, i32, [i8; 6]); 14] = [
    (0, 300, [0, 0, 0, 0, 0, 0]),
    (400, 0, [0, 0, 0, 0, 70, -60]), // A slow curve.
    (500, 0, [0, 0, 0, 60, -90, 0]),
    (300, 0, [0, 0, 0, 0, 0, 0]),
    (0, 400, [0, 0, 0, 0, 120, 0]), // From one side to the other at once.
    (0, 400, [0, 0, 0, 0, -120, 0]),
    (0, 1500, [0, 0, 120, 0, 0, 0]), // The last joint into its limit, and on.
    (0, 700, [0, 0, -100, 0, 0, 60]),
    (300, 0, [0, 0, 0, 0, 0, 0]),
    (200, 1700, [0, 0, 0, -120, 0, 0]), // To the end of the reach, on, and let go.
    (0, 300, [0, 0, 0, 0, 0, 0]),
    (300, 600, [0, 0, 0, 110, 0, 0]),
    (200, 1900, [-120, 0, 0, 0, 80, 0]), // Sideways through a wrist that is straight.
    (300, 0, [0, 0, 0, 0, 0, 0]),
];
/// The readings when the stick is let go.
const REST: [i8; 6] = [4, -3, 2, -2, 3, -4];
/// The readings about zero that are none, so that the arm rests when the stick is let go.
const DEAD_BAND: i32 = 10;
/// The speeds of the tip per step of the stick beyond it: 1.2 rad/s and 0.3 m/s at full deflection.
const PER_STEP: [f32; 2] = [1.2 / (127 - DEAD_BAND) as f32, 0.3 / (127 - DEAD_BAND) as f32];

/// The twist that the stick asks for in a tick, rad/s and m/s.
pub fn stick(tick: u32) -> Motion<f32> {
    let (mut from, mut passed) = ([0; 6], tick as i32);
    for &(comes, stays, to) in &STICK {
        if passed < comes + stays {
            let [rx, ry, rz, x, y, z] = core::array::from_fn(|axis| {
                let [from, to, rest] = [from[axis], to[axis], REST[axis]].map(i32::from);
                let left = (from - to) * (comes - passed).max(0) / comes.max(1);
                let reading = to + left + rest;
                (reading - reading.clamp(-DEAD_BAND, DEAD_BAND)) as f32
            });
            return Motion::new(
                Vec3::new(rx, ry, rz) * PER_STEP[0],
                Vec3::new(x, y, z) * PER_STEP[1],
            );
        }
        (from, passed) = (to, passed - comes - stays);
    }
    Motion::ZERO
}

/// The tip's motion in the tick that was asked for last.
#[derive(Debug)]
pub struct Jogged(RefCell<(u32, TipMotion<f32, 6>)>);

impl Reference<f32, 6> for Jogged {
    /// The state in the tick after that of the last call, or in the same; 0 begins again.
    #[inline(never)]
    fn at(&self, tick: u32) -> State<f32, 6, 6> {
        // Nobody else borrows it.
        let Ok(mut jogged) = self.0.try_borrow_mut() else { return State::at(HOME) };
        let (at, tip) = &mut *jogged;
        if tick == at.wrapping_add(1) {
            let jacobian = Engine::<Ur5e>::jacobian(&tip.state().q, TIP, LocalWorldAligned);
            tip.step(&jacobian, &stick(tick));
            *at = tick;
        } else if tick == 0 {
            *at = 0;
            let _ = tip.restart(&State::at(HOME));
        }
        *tip.state()
    }

    fn ticks(&self) -> u32 {
        STICK.iter().map(|(comes, stays, _)| (comes + stays) as u32).sum()
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Jog;

impl Scene<6, 6, 6, 6> for Jog {
    type Robot = Ur5e;
    type Effects = Effects;
    type Reference = Jogged;
    type Environment = ();
    type Plant = Plant<Ur5e, Effects, (), 6, 6, 6>;

    const NAME: &'static str = "jog";
    const BOUND: f32 = 1e-3;
    const EFFECTS: Effects = EFFECTS;
    const GAIN_POSE: [f32; 6] = HOME;
    const GAIN_POSE_NAME: &'static str = "home";
    const BASELINES: &'static [Run<Self, 6, 6, 6, 6>] = &[
        Run::of::<GravityOnly>(PlantModel::Exact, "gravity"),
        Run::of::<GravityOnly>(PlantModel::Mismatched, "gravity"),
    ];

    fn reference() -> Result<Jogged, TrajectoryError> {
        let tip = TipMotion::try_new(
            TipMotionConfig {
                tick: TICK,
                lower: RANGE.map(|end| -end),
                upper: RANGE,
                limits: [LIMITS; 6],
                damping: 0.01,
                length: 0.3,
                posture: HOME,
                posture_gain: 0.0,
            },
            &HOME,
        );
        // The constants are in range.
        Ok(Jogged(RefCell::new((0, tip.map_err(|_| TrajectoryError::Tick)?))))
    }

    fn environment(_: &Jogged, _: f32) {}

    fn inverse<E: Effect<f32, 6, 6>>(
        reference: &State<f32, 6, 6>,
        (): &(),
        effects: &E,
    ) -> [f32; 6] {
        PickAndPlace::inverse(reference, &(), effects)
    }

    fn plant(noise: Option<&mut Noise>) -> Self::Plant {
        PickAndPlace::plant(noise)
    }
}
