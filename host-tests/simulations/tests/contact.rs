//! Claims about a UR5e that finds contacts without sensors, in f32 as in firmware: the delay until
//! a push is found along the pick and place, and false alarms.

use dynamics_core::Engine;
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Effect, Gravity, Inertia, Viscous, smooth_sign,
};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use firmware_demo::scene::{HOLD, NEAR, OMEGA_N, REENTRY, RIDE, Scene, TICK, ZETA};
use firmware_demo::scenes::ur5e::{self, EFFECTS, PickAndPlace};
use firmware_demo::trajectories::HOME;
use motion_control::estimate::{ContactDetector, Estimate, Observer, ObserverConfig};
use motion_control::law::{Gains, feedback};
use motion_control::limits::SafetyLimits;
use motion_control::motion::{MotionController, MotionControllerConfig};
use motion_control::reference::Trajectory;
use motion_control::safety::SupervisorConfig;
use simulation_tests::plant::{EXCESS, Plant, bristles, coulomb};

/// Laps of a million ticks.
const LAPS: u32 = 150;
/// Ticks from one instant of pushes to the next: no divisor of the way-points'.
const EVERY: u32 = 251;
/// Ticks after which a push counts as not found.
const PATIENCE: u32 = 200;
/// Errors of the model of bodies and of friction: of the arm, and as stated to the detector.
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
#[derive(Clone, Copy)]
struct Sensing {
    /// Its step, rad.
    step: f32,
    /// Bandwidth of the detector's velocities and of its external torques, rad/s.
    bandwidth: f32,
    /// Margins of the detector, N·m.
    margin: [f32; 6],
    /// Whether stiction is stated: at low speed friction may have any value up to it.
    sticks: bool,
}

const BITS_14: Sensing = Sensing {
    step: core::f32::consts::TAU / 16_384.0,
    bandwidth: 60.0,
    margin: [2.4, 3.4, 2.25, 0.33, 0.3, 0.3],
    sticks: false,
};
const BITS_20: Sensing = Sensing {
    step: core::f32::consts::TAU / 1_048_576.0,
    bandwidth: 400.0,
    margin: [1.0, 1.05, 0.75, 0.22, 0.18, 0.22],
    sticks: false,
};

/// The arm with its controller and its detector.
#[derive(Clone)]
struct Cell<F> {
    plant: Plant<F>,
    controller: MotionController<f32, 6>,
    detector: ContactDetector<f32, 6>,
    velocities: Observer<f32, 6>,
    gains: Gains<f32, 6>,
    sensing: Sensing,
    latched: [f32; 6],
}

impl<F: Effect<f32, 6, 6> + Clone> Cell<F> {
    fn new(sensing: Sensing, plant: Plant<F>) -> Self {
        let observer = ObserverConfig { bandwidth: sensing.bandwidth, tick: TICK };
        let m = Engine::<Ur5e>::crba(&HOME, &RIGID);
        Self {
            latched: sensing.read(&plant.at.state.q),
            plant,
            controller: MotionController::new(MotionControllerConfig {
                supervisor: SupervisorConfig {
                    limits: SafetyLimits::from(PickAndPlace::LIMITS).with_rate_share(0.5),
                    tick: TICK,
                    resolution: sensing.step,
                    ride_through_ticks: RIDE,
                    hold_ticks: HOLD,
                    reentry_ticks: REENTRY,
                },
                observer_bandwidth: 10.0 * OMEGA_N,
                decay_rate: OMEGA_N,
                restart_distance: NEAR,
            }),
            detector: ContactDetector::try_new(observer, sensing.margin).expect("a good one"),
            velocities: Observer::new(observer),
            gains: Gains::from_inertia(&core::array::from_fn(|j| m.get(j, j)), OMEGA_N, ZETA),
            sensing,
        }
    }

    /// A tick of the firmware and of the arm. The greatest |r| less its bound of the model's
    /// errors, in margins: a contact from 1 on.
    fn tick(&mut self, motion: &Trajectory<f32, 6, 9>) -> f32 {
        let encoders = self.sensing.read(&self.plant.at.state.q);
        let measured = core::mem::replace(&mut self.latched, encoders);
        let ahead = self.controller.reference().qdd;
        let estimate = *self.velocities.update_delayed(&measured, &ahead);
        let excess = self.excess(&estimate, ahead);
        let tick = self.controller.observe(Ok(&measured)).reference(motion);
        let torques = Engine::<Ur5e>::rnea(tick.reference(), &(RIGID, FRICTION));
        let back = feedback(&self.gains, tick.reference(), tick.estimate());
        let command = tick.command(&core::array::from_fn(|i| torques[i] + back[i]));
        assert!(!command.brake, "the arm follows its motion");
        self.detector.drive(&command.torque);
        (self.plant.advance(&command.torque, 4, TICK / 4.0)).expect("an arm with mass");
        excess
    }

    /// The detector's part of a tick, with the acceleration of the reference until now.
    fn excess(&mut self, &Estimate { q, qd }: &Estimate<f32, 6>, qdd: [f32; 6]) -> f32 {
        let state = State { q, qd, qdd };
        // Without friction, whose torques the errors need by themselves.
        let mut model = Engine::<Ur5e>::momentum_and_drift(&state, &RIGID);
        let resistance = Engine::<Ur5e>::rnea(&state, &FRICTION);
        let bodies = Engine::<Ur5e>::rnea(&state, &RIGID);
        for (beta, resistance) in model.beta.iter_mut().zip(resistance) {
            *beta -= resistance;
        }
        let (_, Coulomb { torque, width }) = FRICTION;
        let errors = core::array::from_fn(|i| {
            let sliding = smooth_sign(qd[i] / (STUCK * width.get())).abs();
            let stuck = STICTION * torque[i] * (1.0 - sliding);
            let stuck = if self.sensing.sticks { stuck } else { 0.0 };
            STATED[0] * bodies[i].abs() + STATED[1] * resistance[i].abs() + stuck
        });
        (self.detector.update(&model.p, &model.beta, &errors)).expect("finite");
        let (r, threshold) = (self.detector.external_torque(), self.detector.threshold());
        let share = |i: usize| (r[i].abs() - threshold[i]) / self.sensing.margin[i] + 1.0;
        (0..6).map(share).fold(f32::NEG_INFINITY, f32::max)
    }
}

impl Sensing {
    /// The positions that the encoders measure.
    fn read(&self, q: &[f32; 6]) -> [f32; 6] {
        q.map(|q| libm::roundf(q / self.step) * self.step)
    }
}

/// The ticks and those with a contact of some laps, and the longest delay, ticks, until pushes of
/// either sign on the shoulder and on each joint of the wrist are found. Inertias and friction
/// are off by the stated errors, in each lap with other signs.
fn laps<F: Effect<f32, 6, 6> + Clone>(
    sensing: Sensing,
    friction: fn([f32; 6]) -> F,
    laps: u32,
    pushes: &[(usize, f32)],
) -> ([usize; 2], u32) {
    let mut motion = Trajectory::REST;
    ur5e::plan(&mut motion).expect("within the limits");
    let ([mut ticks, mut alarms], mut longest) = ([0; 2], 0);
    for lap in 0..laps {
        // Knuth's multiplicative hash.
        let signs = (lap + 1000).wrapping_mul(2_654_435_761) >> 13;
        let off = |size: f32, first: usize| -> [f32; 6] {
            core::array::from_fn(|i| 1.0 + size * (2.0 * ((signs >> (first + i)) & 1) as f32 - 1.0))
        };
        let plant = Plant::new(HOME, off(STATED[0], 0), friction(off(STATED[1], 6)));
        let mut cell = Cell::new(sensing, plant);
        for tick in 0..motion.ticks() {
            ticks += 1;
            alarms += usize::from(cell.tick(&motion) > 1.0);
            for &(joint, torque) in pushes.iter().filter(|_| tick % EVERY == EVERY - 1) {
                let mut copy = cell.clone();
                copy.plant.pushed[joint] = torque;
                let found = (1..PATIENCE).find(|_| copy.tick(&motion) > 1.0);
                longest = longest.max(found.unwrap_or(PATIENCE));
            }
        }
    }
    ([ticks, alarms], longest)
}

/// With the friction of the model's kind.
fn smooth(share: [f32; 6]) -> (Viscous<f32, 6>, Coulomb<f32, 6>) {
    let (_, Coulomb { width, .. }) = FRICTION;
    coulomb(share, width)
}

#[test]
fn pushes_at_shoulder_and_wrist_are_found_within_their_bars() {
    let pushes = [(1, 10.0), (3, 2.0), (4, 2.0), (5, 2.0)];
    let pushes = pushes.map(|(joint, torque)| [(joint, torque), (joint, -torque)]);
    for (sensing, required) in [(BITS_14, 40), (BITS_20, 10)] {
        let (_, longest) = laps(sensing, smooth, 4, pushes.as_flattened());
        assert!(longest <= required, "{longest} of {required} ms");
    }
}

// The motion is the pick and place.
#[test]
fn a_hundred_thousand_ticks_have_no_false_alarm() {
    let count = if cfg!(feature = "full") { LAPS } else { LAPS / 10 };
    let ([ticks, found], _) = laps(BITS_14, smooth, count, &[]);
    assert!(ticks >= 6_600 * count as usize && found == 0, "{found} in {ticks}");
}

// Stated stiction gives none.
#[test]
fn unstated_stiction_gives_false_alarms() {
    let stated = Sensing { sticks: true, ..BITS_14 };
    let ([_, none], _) = laps(stated, bristles, 10, &[]);
    let ([_, many], _) = laps(BITS_14, bristles, 10, &[]);
    assert!(none == 0 && many > 1000, "{none} {many}");
}
