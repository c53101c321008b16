//! The simulated arm.

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::effects::{
    Armature, Coulomb, Effect, LoadFriction, Lugre, Payload, RIGID_BODY, Viscous, Width,
};
use dynamics_core::model::model;
use dynamics_core::robots::So101;
use dynamics_core::sim::KahanState;
use dynamics_core::state::State;
use firmware_demo::scenes::so101_teach::{
    ARMATURE, BACK_EMF, COULOMB, LOAD, MAX_DUTY, RESOLUTION, STALL, VISCOUS,
};

use super::TICK;
use super::parameters::WIDTH;
use crate::step::compensated_step;

/// The body that carries the load.
pub const GRIPPER: usize = 4;
/// Steps in a tick.
const STEPS: u32 = 4;
/// Standard deviation of the measured torques, N·m: two steps of the duty.
const NOISE: f32 = 7e-3;
/// Viscous friction with the back-EMF, N·m·s/rad.
pub const DAMPING: f32 = VISCOUS + BACK_EMF;

/// The friction of the model's kind.
pub const SMOOTH: (Viscous<f32, 6>, Coulomb<f32, 6>) = (
    Viscous([DAMPING; 6]),
    Coulomb {
        torque: [COULOMB; 6],
        width: WIDTH,
    },
);
/// Bristles that slide from 10⁻⁴ rad on, with stiction 15 % above sliding friction.
pub const BRISTLES: Lugre<f32, 6> = Lugre {
    stiffness: [1e4 * COULOMB; 6],
    damping: [30.0 * COULOMB; 6],
    viscous: [DAMPING; 6],
    sliding: [COULOMB; 6],
    excess: [0.15 * COULOMB; 6],
    stribeck_speed: Width::f32(0.01),
    bristle: [0.0; 6],
};
/// Armature and friction of the gears, which are of one kind.
pub const GEARS: (Armature<f32, 6>, LoadFriction<f32, 6>) = (
    Armature([ARMATURE; 6]),
    LoadFriction {
        driving: [2.0 * LOAD / (1.0 - LOAD); 6],
        backdriving: [2.0 * LOAD / (1.0 + LOAD); 6],
        width: WIDTH,
    },
);

/// An arm with friction of the kind `F`, its encoders, and its drives.
#[derive(Clone, Debug)]
pub struct Arm<F> {
    pub at: KahanState<f32, 6, true>,
    pub load: Payload<f32, GRIPPER>,
    friction: F,
    random: u32,
}

impl<F: Effect<f32, 6, 6> + Clone> Arm<F> {
    /// At the start of a motion.
    pub fn new(state: State<f32, 6, 6>, friction: F) -> Self {
        Self {
            at: KahanState::at(state),
            load: Payload::default(),
            friction,
            random: 0x5eed_1234,
        }
    }

    pub fn encoders(&self) -> [f32; 6] {
        self.at.state.q.map(|q| nearest(q, RESOLUTION))
    }

    /// A tick under commanded torques, which become duties; returns the measured ones.
    ///
    /// # Errors
    /// As forward dynamics.
    pub fn advance(&mut self, command: &[f32; 6]) -> Result<[f32; 6], NotPositiveDefinite> {
        const MOST: f32 = MAX_DUTY * STALL;
        let tau = command.map(|tau| nearest(tau.clamp(-MOST, MOST), 1e-3 * STALL));
        let h = TICK / STEPS as f32;
        for _ in 0..STEPS {
            let scene = (RIGID_BODY, GEARS, self.load, self.friction.clone());
            let (robot, acting) = (model::<f32, So101, 6, 6, 6>(), (&scene, &mut self.friction));
            compensated_step(robot, &mut self.at, tau, acting, h)?;
        }
        Ok(tau.map(|tau| tau + NOISE * self.normal()))
    }

    /// A number of a normal distribution, nearly.
    fn normal(&mut self) -> f32 {
        let mut sum = 0.0;
        for _ in 0..12 {
            self.random ^= self.random << 13;
            self.random ^= self.random >> 17;
            self.random ^= self.random << 5;
            sum += (self.random >> 8) as f32 * (1.0 / 16_777_216.0) - 0.5;
        }
        sum
    }
}

fn nearest(x: f32, unit: f32) -> f32 {
    libm::roundf(x / unit) * unit
}
