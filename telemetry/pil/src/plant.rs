//! The robot of the scene, in f64 or as the firmware has it.

use dynamics_core::effects::{Armature, Coriolis, Coulomb, Gravity, Inertia, Viscous, Width};
use dynamics_core::model::Calibrated;
use dynamics_core::robots::Ur5e;
use dynamics_core::sim::linearly_implicit;
use dynamics_core::state::State;
use firmware_demo::plant::Simulated;
use firmware_demo::scene::{STEPS, Scene, TICK};
use firmware_demo::scenes::ur5e::{EFFECTS, PickAndPlace};
use firmware_demo::sim_io::MAX_DUTY;
use firmware_demo::trajectories::HOME;
use joint_drivers::as5047p::{encode, quantise};

use crate::JOINTS;

pub trait Robot {
    /// The positions of its joints, rad.
    fn positions(&self) -> [f64; JOINTS];

    /// Moves on by a tick under these torques, N·m; returns whether it has forward dynamics.
    fn advance(&mut self, torque: &[f64; JOINTS]) -> bool;

    fn answers(&self) -> [u16; JOINTS] {
        self.positions().map(|q| encode(quantise(q as f32)))
    }
}

/// The torques that the drives deliver at these duties, N·m.
#[must_use]
pub fn torques(duties: &[u16; JOINTS]) -> [f64; JOINTS] {
    let limits = PickAndPlace::limits();
    core::array::from_fn(|joint| {
        let share = f64::from(duties[joint]) * (2.0 / f64::from(MAX_DUTY)) - 1.0;
        share * f64::from(limits[joint].torque)
    })
}

type Effects = (
    Gravity,
    Inertia,
    Coriolis,
    Viscous<f64, JOINTS>,
    Coulomb<f64, JOINTS>,
    Armature<f64, JOINTS>,
);

/// The robot in f64.
pub struct Outside {
    robot: Calibrated<Ur5e, f64, JOINTS, JOINTS, JOINTS>,
    effects: Effects,
    state: State<f64, JOINTS, JOINTS>,
}

impl Outside {
    /// At rest at the start of the trajectory, its friction `friction` times that of the scene.
    #[must_use]
    pub fn new(friction: f64) -> Self {
        let (gravity, inertia, coriolis, viscous, coulomb, armature) = EFFECTS;
        let scaled = |values: [f32; JOINTS]| values.map(|value| friction * f64::from(value));
        let coulomb = Coulomb {
            torque: scaled(coulomb.torque),
            width: Width::new(f64::from(coulomb.width.get())),
        };
        Self {
            robot: Calibrated::nominal(),
            effects: (
                gravity,
                inertia,
                coriolis,
                Viscous(scaled(viscous.0)),
                coulomb,
                Armature(armature.0.map(f64::from)),
            ),
            state: State::at(HOME.map(f64::from)),
        }
    }
}

impl Robot for Outside {
    fn positions(&self) -> [f64; JOINTS] {
        self.state.q
    }

    fn advance(&mut self, torque: &[f64; JOINTS]) -> bool {
        let (robot, state) = (&self.robot, &mut self.state);
        let h = f64::from(TICK) / f64::from(STEPS);
        (0..STEPS).all(|_| linearly_implicit(robot, state, torque, &mut self.effects, h).is_ok())
    }
}

/// The robot as the firmware has it, in f32.
pub struct Inside(<PickAndPlace as Scene<6, 6, 6, 6>>::Plant);

impl Inside {
    /// At rest at the start of the trajectory.
    #[must_use]
    pub fn new() -> Self {
        Self(PickAndPlace::plant(None))
    }
}

impl Default for Inside {
    fn default() -> Self {
        Self::new()
    }
}

impl Robot for Inside {
    fn positions(&self) -> [f64; JOINTS] {
        self.0.encoder_positions().map(f64::from)
    }

    fn advance(&mut self, torque: &[f64; JOINTS]) -> bool {
        let torque = torque.map(|tau| tau as f32);
        let h = TICK / STEPS as f32;
        (0..STEPS).all(|_| self.0.step(&torque, &(), h).is_ok())
    }
}
