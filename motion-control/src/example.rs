use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia};
use dynamics_core::{Core, robots::Ur5e, state::State};
use motion_control::{estimate::*, law::*, limits::*, motion::*, safety::*};

pub type Effects = (Gravity, Inertia, Coriolis, Armature<f32, 6>);
pub const EFFECTS: Effects =
    (Gravity::EARTH, Inertia, Coriolis, Armature([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]));
pub const TICK: f32 = 1e-3; // s
pub const RIDE_THROUGH: u32 = 5; // ticks of a fault that the observer bridges
pub const HOLD: u32 = 100; // ticks more until the brake
pub const REENTRY: u32 = 200; // ticks of the return to the trajectory
pub const OMEGA_N: f32 = 25.0; // rad/s, of the feedback; the speed of a held arm decays as fast

/// The controller of an arm at rest at the start of its trajectory.
pub fn controller(limits: SafetyLimits<f32, 6>) -> Result<MotionController<f32, 6>, ConfigError> {
    MotionController::try_new(MotionControllerConfig {
        supervisor: SupervisorConfig {
            limits,
            tick: TICK,
            resolution: 0.0, // step of the encoders, rad
            ride_through_ticks: RIDE_THROUGH,
            hold_ticks: HOLD,
            reentry_ticks: REENTRY,
        },
        observer_bandwidth: 10.0 * OMEGA_N,
        decay_rate: OMEGA_N,
        restart_distance: 0.15, // rad
    })
}

/// Gains of the feedback, critically damped.
pub fn gains(start: &[f32; 6]) -> Gains<f32, 6> {
    let m = Core::<Ur5e>::crba(start, &EFFECTS);
    Gains::from_inertia(&core::array::from_fn(|j| m.get(j, j)), OMEGA_N, 1.0)
}

/// Feed-forward of the whole model, and feedback.
pub fn law(
    gains: &Gains<f32, 6>,
    reference: &State<f32, 6, 6>,
    estimate: &Estimate<f32, 6>,
) -> [f32; 6] {
    let feedforward = Core::<Ur5e>::rnea(reference, &EFFECTS);
    let pd = feedback(gains, reference, estimate);
    core::array::from_fn(|j| feedforward[j] + pd[j])
}
