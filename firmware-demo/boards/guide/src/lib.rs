//! The common part of the programs of the guide's page on firmware: the arm of the page, and a
//! placeholder for the board.
#![no_std]

use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia};
use dynamics_core::{Engine, robots::Ur5e};
use motion_control::{law::*, limits::*, motion::*, reference::*, safety::*};

pub mod rod;

const TICK: f32 = 1e-3; // s
const SCENE: (Gravity, Inertia, Coriolis, Armature<f32, 6>) = Engine::<Ur5e>::scene_f32((
    Gravity::EARTH,
    Inertia,
    Coriolis,
    Armature([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]),
));
const HOME: [f32; 6] = [0.0, -1.57, 1.57, -1.57, -1.57, 0.0];

/// The arm: a controller, its trajectory and its gains.
pub struct Arm {
    controller: MotionController<f32, 6>,
    trajectory: Trajectory<f32, 6, 2>,
    gains: Gains<f32, 6>,
}

impl Arm {
    /// An arm at rest at the start of its trajectory.
    #[expect(clippy::new_without_default, reason = "the page shows what is needed")]
    pub fn new() -> Self {
        let stop = |q, ticks| WayPoint {
            q,
            qd: [0.0; 6],
            ticks,
        };
        let points = [
            stop(HOME, 0),
            stop([1.0, -1.2, 1.4, -1.57, -1.57, 0.0], 1000),
        ];
        let limits = [MotionLimits {
            velocity: 3.0,
            acceleration: 10.0,
        }; 6];
        let inertia = Engine::<Ur5e>::crba(&HOME, &SCENE);
        let diagonal = core::array::from_fn(|joint| inertia.get(joint, joint));
        Self {
            controller: MotionController::new(MotionControllerConfig {
                supervisor: SupervisorConfig {
                    limits: SafetyLimits {
                        torque: [150.0, 150.0, 150.0, 28.0, 28.0, 28.0], // N·m
                        rate: [75.0, 75.0, 75.0, 14.0, 14.0, 14.0],      // N·m per tick
                        speed: [3.2; 6],                                 // rad/s
                        lower: [-6.3; 6],
                        upper: [6.3; 6],
                    },
                    tick: TICK,
                    resolution: 0.0,
                    ride_through_ticks: 5,
                    hold_ticks: 100,
                    reentry_ticks: 200,
                },
                observer_bandwidth: 250.0,
                decay_rate: 25.0,
                restart_distance: 0.15,
            }),
            trajectory: Trajectory::new(&points, TICK, &limits).expect("within its limits"),
            gains: Gains::from_inertia(&diagonal, 25.0, 1.0),
        }
    }

    /// Computes the command of one tick from the positions of the joints, or from the fault that
    /// prevented their measurement.
    pub fn tick(&mut self, measured: Result<&[f32; 6], Fault>) -> Command<f32, 6> {
        let gains = &self.gains;
        self.controller
            .tick(measured, &self.trajectory, |reference, estimate| {
                let mut tau = Engine::<Ur5e>::rnea(reference, &SCENE);
                let pd = feedback(gains, reference, estimate);
                tau.iter_mut().zip(pd).for_each(|(tau, pd)| *tau += pd);
                tau
            })
    }
}

/// Stands for encoders and drives.
pub mod board {
    use motion_control::limits::{Command, Fault};

    /// The joints' positions, rad.
    pub fn positions() -> Result<[f32; 6], Fault> {
        Err(Fault::Stale)
    }

    /// Torques to the drives, and the brake.
    pub fn drive(_: &Command<f32, 6>) {}
}
