//! The parameters of an SO-101, and the engine's model of them.

use dynamics_core::Engine;
use dynamics_core::effects::{
    Armature, BaseParameters, Coulomb, LoadFriction, RIGID_BODY, Viscous, Width,
};
use dynamics_core::model::{BodyInertia, Calibrated};
use dynamics_core::robots::So101;
use dynamics_core::spatial::SpatialInertia;
use dynamics_core::state::State;
use motion_control::SelectedParameters;

/// For each joint: viscous and Coulomb friction, armature, and friction per torque of the load
/// while the motor drives and while the load does.
pub const OWN: usize = 5;
/// Ten of each body, then [`OWN`] of each joint.
pub const N: usize = 60 + 6 * OWN;
/// The number of parameters that are estimated.
pub const P: usize = 24;
/// Width of the smooth sign of friction, rad/s.
pub const WIDTH: Width<f32> = Width::f32(0.05);

/// The firmware's knowledge before the arm moves.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// The parameters of the nominal model.
    pub nominal: [f32; N],
    /// The base parameters of the motion.
    pub base: SelectedParameters<f32, P, N>,
}

/// The friction and the armature of the joints.
pub type Joints = (
    Viscous<f32, 6>,
    Coulomb<f32, 6>,
    Armature<f32, 6>,
    LoadFriction<f32, 6>,
);

/// The model with which the engine computes: bodies as base parameters in RAM, and joints.
#[derive(Clone, Copy, Debug)]
pub struct Model {
    bodies: BaseParameters<So101, f32, 6, 6, 6>,
    joints: Joints,
}

impl Model {
    /// The model of all parameters; `None` if a body is impossible.
    pub fn of(parameters: &[f32; N]) -> Option<Self> {
        let mut arm = Calibrated::<So101, f32, 6, 6, 6>::nominal();
        for (body, phi) in parameters.as_chunks().0.iter().take(6).enumerate() {
            let inertia = SpatialInertia::from_parameters(*phi);
            arm.set_inertia(body, BodyInertia::about_com(&inertia), 1e-3)
                .ok()?;
        }
        let own = |k: usize| core::array::from_fn(|joint| parameters[60 + OWN * joint + k]);
        let friction = Coulomb {
            torque: own(1),
            width: WIDTH,
        };
        let gears = LoadFriction {
            driving: own(3),
            backdriving: own(4),
            width: WIDTH,
        };
        Some(Self {
            bodies: Engine::<So101>::base_parameters(&arm, &()).ok()?,
            joints: (Viscous(own(0)), friction, Armature(own(2)), gears),
        })
    }

    /// The torques of the motors, N·m.
    pub fn torque(&self, state: &State<f32, 6, 6>) -> [f32; 6] {
        Engine::<So101>::rnea(state, &(RIGID_BODY, &self.bodies, self.joints))
    }

    /// The measured torques that the gears transmit, less those that the arm needs, N·m: the
    /// torques of what the model lacks. The friction of the gears grows with the load, and is no
    /// part of them.
    pub fn unexplained(&self, state: &State<f32, 6, 6>, measured: &[f32; 6]) -> [f32; 6] {
        let (viscous, coulomb, armature, gears) = self.joints;
        let transmitted = Engine::<So101>::transmitted_torque(state, measured, &gears);
        let scene = (RIGID_BODY, &self.bodies, (viscous, coulomb, armature));
        let needed = Engine::<So101>::rnea(state, &scene);
        core::array::from_fn(|i| transmitted[i] - needed[i])
    }
}
