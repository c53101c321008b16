//! A rod on a bearing: its model, its law, its limits and its motion.

// page: begin
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
use dynamics_core::{Engine, state::State};
use joint_drivers::Law;
use motion_control::{law::*, limits::*, motion::*, reference::*, safety::*};

/// 2 kg and 1 m.
pub struct Rod;

impl Robot<1, 1, 1> for Rod {
    const MODEL: ArmModel<f64, 1> = Model::new(
        "rod",
        [Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0]))
            .mass(2.0)
            .com([0.0, 0.0, -0.5])
            .inertia([0.1667, 0.0, 0.0, 0.1667, 0.0, 0.0005])],
    );
}

impl Law<1> for Rod {
    fn feedforward(reference: &State<f32, 1, 1>, (): &()) -> [f32; 1] {
        Engine::<Rod>::rnea(reference, &RIGID_BODY)
    }
}
// page: end

/// 0.67 kg·m² about the bearing, at 25 rad/s.
pub fn gains() -> Gains<f32, 1> {
    Gains::from_inertia(&[0.67], 25.0, 1.0)
}

pub const CONFIG: MotionControllerConfig<f32, 1> = MotionControllerConfig {
    supervisor: SupervisorConfig {
        limits: SafetyLimits {
            torque: [20.0], // N·m
            rate: [2.0],    // N·m per tick
            speed: [5.0],   // rad/s
            lower: [-3.0],
            upper: [3.0],
        },
        tick: 1e-3,
        resolution: core::f32::consts::TAU / 4096.0,
        ride_through_ticks: 5,
        hold_ticks: 100,
        reentry_ticks: 200,
    },
    observer_bandwidth: 250.0,
    decay_rate: 25.0,
    restart_distance: 0.15,
};

/// One radian there, and back.
pub fn path() -> Result<Trajectory<f32, 1, 3>, TrajectoryError> {
    let stop = |q, ticks| WayPoint {
        q: [q],
        qd: [0.0],
        ticks,
    };
    let limits = MotionLimits {
        velocity: 4.0,
        acceleration: 20.0,
    };
    let points = [stop(0.0, 0), stop(1.0, 1000), stop(0.0, 2000)];
    Trajectory::new(&points, 1e-3, &[limits])
}
