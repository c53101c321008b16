//! The firmware of the arm, with a tick in five regions of the meter, and the arm behind it.

use dynamics_core::Engine;
use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Effect, Gravity, Inertia, Viscous, smooth_sign,
};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use firmware_demo::scene::{HOLD, NEAR, OMEGA_N, REENTRY, RIDE, Scene, TICK, ZETA};
use firmware_demo::scenes::ur5e::{EFFECTS, PickAndPlace};
use firmware_demo::trajectories::HOME;
use motion_control::{
    Command, ConfigError, ContactDetector, ContactPhase, ContactReaction, ContactReactionConfig,
    ContactResponse, DetectedContact, Estimate, Fault, Gains, MotionController,
    MotionControllerConfig, Observer, ObserverConfig, Reference, SafetyLimits, SupervisorConfig,
    feedback,
};

use super::plant::{EXCESS, Plant};

/// The names of the regions, by their numbers: the tick and its phases.
pub const REGIONS: [&str; 6] = ["tick", "observe", "detect", "react", "law", "gate"];
/// Ticks without a contact until the arm is released.
pub const RELEASE: u32 = 200;
/// The share of friction that is compensated in an arm that floats.
const FLOATING: f32 = 0.6;
/// Stated errors of the model: of the torques of the bodies, and of friction.
const STATED: [f32; 2] = [0.03, 0.1];

/// Stated stiction, as a share of the modelled sliding friction.
const STICTION: f32 = (1.0 + STATED[1]) * (1.0 + EXCESS as f32);

/// Joints may stick up to this multiple of the width of the modelled friction, since velocities are
/// estimated with a delay.
const STUCK: f32 = 1.5;

const RIGID: (Gravity, Inertia, Coriolis, Armature<f32, 6>) = {
    let (gravity, inertia, coriolis, .., rotors) = EFFECTS;
    (gravity, inertia, coriolis, rotors)
};
const FRICTION: (Viscous<f32, 6>, Coulomb<f32, 6>) = {
    let (.., viscous, coulomb, _) = EFFECTS;
    (viscous, coulomb)
};

/// An encoder, and the detector for its noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensing {
    /// Its step, rad.
    pub step: f32,
    /// Bandwidth of the detector's velocities and of its external torques, rad/s.
    pub bandwidth: f32,
    /// Margins of the detector, N·m.
    pub margin: [f32; 6],
    /// Whether the stated errors hold for joints that stick: at low speed their friction may have
    /// any value up to stiction.
    pub sticks: bool,
}

impl Sensing {
    /// 14 bits, as in the other scenes.
    pub const BITS_14: Self = Self {
        step: core::f32::consts::TAU / 16_384.0,
        bandwidth: 60.0,
        margin: [2.4, 3.4, 2.25, 0.33, 0.3, 0.3],
        sticks: false,
    };
    pub const BITS_20: Self = Self {
        step: core::f32::consts::TAU / 1_048_576.0,
        bandwidth: 400.0,
        margin: [1.0, 1.05, 0.75, 0.22, 0.18, 0.22],
        ..Self::BITS_14
    };

    /// The same for joints that stick.
    #[must_use]
    pub const fn sticking(mut self) -> Self {
        self.sticks = true;
        self
    }
}

#[derive(Clone, Debug)]
pub struct Firmware {
    pub controller: MotionController<f32, 6>,
    pub reaction: ContactReaction<f32, 6>,
    pub detector: ContactDetector<f32, 6>,
    /// The contact that the detector found in the last tick.
    pub contact: Option<DetectedContact<f32>>,
    sensing: Sensing,
    velocities: Observer<f32, 6>,
    gains: Gains<f32, 6>,
    reacts: bool,
}

impl Firmware {
    /// At the start of a motion; without a response the arm follows it whatever it touches.
    ///
    /// # Errors
    /// [`ConfigError`] names a number that is none.
    pub fn new(
        sensing: Sensing,
        response: Option<ContactResponse<f32>>,
    ) -> Result<Self, ConfigError> {
        let controller = MotionController::try_new(MotionControllerConfig {
            supervisor: SupervisorConfig {
                limits: SafetyLimits::from(PickAndPlace::limits()).with_rate_share(0.5),
                tick: TICK,
                resolution: sensing.step,
                ride_through_ticks: RIDE,
                hold_ticks: HOLD,
                reentry_ticks: REENTRY,
            },
            observer_bandwidth: 10.0 * OMEGA_N,
            decay_rate: OMEGA_N,
            restart_distance: NEAR,
        })?;
        let observer = ObserverConfig {
            bandwidth: sensing.bandwidth,
            tick: TICK,
        };
        let m = Engine::<Ur5e>::crba(&HOME, &RIGID);
        let diagonal = core::array::from_fn(|joint| m.get(joint, joint));
        Ok(Self {
            controller,
            reaction: ContactReaction::try_new(ContactReactionConfig {
                response: response.unwrap_or(ContactResponse::Stop),
                release_ticks: RELEASE,
            })?,
            detector: ContactDetector::try_new(observer, sensing.margin)?,
            contact: None,
            sensing,
            velocities: Observer::try_new(observer)?,
            gains: Gains::from_inertia(&diagonal, OMEGA_N, ZETA),
            reacts: response.is_some(),
        })
    }

    /// A tick: from the positions that the encoders latched in the tick before to the torques.
    pub fn tick(
        &mut self,
        measured: &[f32; 6],
        motion: &impl Reference<f32, 6>,
    ) -> Command<f32, 6> {
        let ahead = self.controller.reference().qdd;
        let observed = self.controller.observe(Ok(measured));
        let estimate = *self.velocities.update_delayed(measured, &ahead);

        let contact = detect(&mut self.detector, &estimate, ahead, self.sensing.sticks);
        self.contact = contact.ok().flatten();

        let tick = match self.reacts {
            true => self.reaction.reference(observed, contact, motion),
            false => observed.reference(motion),
        };

        let share = match self.reaction.phase() {
            ContactPhase::Floating => FLOATING,
            _ => 1.0,
        };
        let torques = Engine::<Ur5e>::rnea(tick.reference(), &RIGID);
        let friction = Engine::<Ur5e>::rnea(tick.reference(), &FRICTION);
        let back = feedback(&self.gains, tick.reference(), tick.estimate());
        let tau = core::array::from_fn(|i| torques[i] + share * friction[i] + back[i]);

        let command = tick.command(&tau);
        self.detector.drive(&command.torque);
        if command.brake {
            self.detector.restart();
        }
        command
    }

    /// The greatest |r| less its bound of the model's errors, in margins: a contact from 1 on.
    pub fn excess(&self) -> f32 {
        let (r, threshold) = (self.detector.external_torque(), self.detector.threshold());
        let mut most = f32::NEG_INFINITY;
        for ((r, threshold), margin) in r.iter().zip(threshold).zip(self.sensing.margin) {
            most = most.max((r.abs() - threshold) / margin + 1.0);
        }
        most
    }
}

/// The detector's part of a tick, with the acceleration of the reference until now.
fn detect(
    detector: &mut ContactDetector<f32, 6>,
    &Estimate { q, qd }: &Estimate<f32, 6>,
    qdd: [f32; 6],
    sticks: bool,
) -> Result<Option<DetectedContact<f32>>, Fault> {
    let state = State { q, qd, qdd };
    let trig = Engine::<Ur5e>::joint_trig(&q);
    let at = trig.with(&state);
    // Without friction, whose torques the errors need by themselves.
    let mut model = Engine::<Ur5e>::momentum_and_drift(at, &RIGID);
    let resistance = Engine::<Ur5e>::rnea(at, &FRICTION);
    let bodies = Engine::<Ur5e>::rnea(at, &RIGID);
    for (beta, resistance) in model.beta.iter_mut().zip(resistance) {
        *beta -= resistance;
    }
    let (_, Coulomb { torque, width }) = FRICTION;
    let errors = core::array::from_fn(|i| {
        let sliding = smooth_sign(qd[i] / (STUCK * width.get())).abs();
        let stuck = STICTION * torque[i] * (1.0 - sliding);
        let stuck = if sticks { stuck } else { 0.0 };
        STATED[0] * bodies[i].abs() + STATED[1] * resistance[i].abs() + stuck
    });
    detector.update(&model.p, &model.beta, &errors)
}

#[derive(Clone, Debug)]
pub struct Cell<F> {
    pub firmware: Firmware,
    pub plant: Plant<F>,
    latched: [f32; 6],
}

impl<F: Effect<f32, 6, 6> + Clone> Cell<F> {
    pub fn new(firmware: Firmware, plant: Plant<F>) -> Self {
        Self {
            latched: firmware.sensing.read(&plant.at.state.q),
            firmware,
            plant,
        }
    }

    /// A tick of the firmware, and of the arm in this many steps.
    ///
    /// # Errors
    /// As forward dynamics.
    pub fn tick(
        &mut self,
        motion: &impl Reference<f32, 6>,
        steps: u32,
    ) -> Result<Command<f32, 6>, NotPositiveDefinite> {
        let encoders = self.firmware.sensing.read(&self.plant.at.state.q);
        let latched = core::mem::replace(&mut self.latched, encoders);
        let command = self.firmware.tick(&latched, motion);
        match command.brake {
            true => self.plant.at.state.qd = [0.0; 6],
            false => (self.plant).advance(&command.torque, steps, TICK / steps as f32)?,
        }
        Ok(command)
    }
}

impl Sensing {
    /// The measurement of the encoders.
    fn read(&self, q: &[f32; 6]) -> [f32; 6] {
        q.map(|q| libm::roundf(q / self.step) * self.step)
    }
}
