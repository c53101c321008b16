//! The loop of the arm: controller, detector of contacts and reaction, with encoders of 14 bits.

use dynamics_core::Core;
use dynamics_core::algorithms::{MomentumAndCoriolis, frame, osim_inverse};
use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia};
use dynamics_core::model::{ArmModel, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::sim::semi_implicit;
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use glam::DVec3;
use motion_control::estimate::{ContactDetector, DetectedContact, Estimate, ObserverConfig};
use motion_control::law::{Gains, feedback};
use motion_control::limits::{Command, MotionLimits, SafetyLimits};
use motion_control::motion::{
    ContactPhase, ContactReaction, ContactReactionConfig, ContactResponse, MotionController,
    MotionControllerConfig,
};
use motion_control::reference::{Trajectory, WayPoint};
use motion_control::safety::{FrozenEncoder, SupervisorConfig};

use crate::contact_reaction::plant::{
    Friction, Q, ROTORS, SPEED, Setup, TIP, Wall, arm, friction, tip,
};

pub const TICK: f64 = 1e-3;
const PARTS: u32 = 8; // the plant's steps in a tick
/// A step of an encoder of 14 bits, rad.
pub const STEP: f64 = core::f64::consts::TAU / 16_384.0;
const OMEGA_N: f64 = 8.0 * core::f64::consts::PI; // rad/s
const BANDWIDTH: f64 = 50.0; // rad/s, of the external torques
/// Above 4.9 standard deviations of the external torques without a contact, N·m.
pub const MARGIN: Q = [7.0, 10.0, 6.0, 0.9, 0.9, 0.9];
const RELEASE: u32 = 200; // ticks

const RIGID: (Gravity, Inertia, Coriolis, Armature<f64, 6>) =
    (Gravity::EARTH, Inertia, Coriolis, ROTORS);

pub struct Cell {
    pub motion: Trajectory<f64, 6, 2>,
    pub controller: MotionController<f64, 6>,
    pub reaction: ContactReaction<f64, 6>,
    pub detector: ContactDetector<f64, 6>,
    pub at: State<f64, 6, 6>,
    pub wall: Wall,
    pub contact: Option<DetectedContact<f64>>,
    pub limits: SafetyLimits<f64, 6>,
    gains: Gains<f64, 6>,
    arm: ArmModel<f64, 6>,
    friction: Friction,
    frozen: FrozenEncoder<f64, 6>,
    measured: Q,
    reacts: bool,
    compensated: f64,
}

impl Cell {
    pub fn new(setup: &Setup) -> Self {
        let [from, to] = setup.motion;
        let plan = |ticks: u32| {
            let stop = |q, ticks| WayPoint { q, qd: [0.0; 6], ticks };
            let limits = [MotionLimits { velocity: 3.0, acceleration: 10.0 }; 6];
            Trajectory::new(&[stop(from, 0), stop(to, ticks)], TICK, &limits).expect("a slow one")
        };
        // The tip is fastest halfway, where the wall is.
        let slow = plan(8000);
        let [_, velocity] = tip(&slow.at(4000));
        let motion = plan((8000.0 * velocity.length() / SPEED) as u32);
        let [origin, velocity] = tip(&motion.at(motion.ticks() / 2));
        let m = Core::<Ur5e>::crba(&from, &RIGID);
        let limits = SafetyLimits::from(Ur5e::MODEL.links.map(|link| link.limits));
        let limits = limits.with_rate_share(0.5);
        let controller = MotionController::try_new(MotionControllerConfig {
            supervisor: SupervisorConfig {
                limits,
                tick: TICK,
                resolution: STEP,
                ride_through_ticks: 5,
                hold_ticks: 100,
                reentry_ticks: 200,
            },
            observer_bandwidth: 10.0 * OMEGA_N,
            decay_rate: OMEGA_N,
            restart_distance: 0.15,
        });
        let config = ContactReactionConfig {
            response: setup.response.unwrap_or(ContactResponse::Stop),
            release_ticks: RELEASE,
        };
        let observer = ObserverConfig { bandwidth: BANDWIDTH, tick: TICK };
        Self {
            motion,
            controller: controller.expect("a good one"),
            reaction: ContactReaction::try_new(config).expect("a good one"),
            detector: ContactDetector::try_new(observer, MARGIN).expect("a good one"),
            at: State::at(from),
            wall: Wall {
                origin,
                normal: velocity.normalize(),
                stiffness: setup.stiffness,
                loss: setup.loss,
                hand: DVec3::ZERO,
            },
            contact: None,
            limits,
            gains: Gains::from_inertia(&core::array::from_fn(|j| m.get(j, j)), OMEGA_N, 1.0),
            arm: arm(setup.off.bodies),
            friction: friction(1.0 + setup.off.friction),
            frozen: FrozenEncoder::new([10.0 * STEP; 6], 3),
            measured: from,
            reacts: setup.response.is_some(),
            compensated: setup.share,
        }
    }

    /// The reflected mass of the tip along the wall's normal, kg.
    pub fn mass(&self) -> f64 {
        let q = self.motion.at(self.motion.ticks() / 2).q;
        let mobility = osim_inverse(&self.arm, &q, TIP, frame::LocalWorldAligned, &RIGID);
        let push = Force::new(DVec3::ZERO, self.wall.normal);
        1.0 / (mobility.expect("an arm with mass") * push).lin.dot(self.wall.normal)
    }

    /// The force of the tip on the wall, N.
    pub fn force(&self) -> f64 {
        self.wall.force(tip(&self.at))
    }

    /// The velocity of the tip into the wall, m/s.
    pub fn speed(&self) -> f64 {
        tip(&self.at)[1].dot(self.wall.normal)
    }

    /// The largest of numbers as a share of its limit; infinite if one is not finite.
    pub fn share(x: &Q, limits: &Q) -> f64 {
        let shares = x.iter().zip(limits).map(|(x, limit)| x.abs() / limit);
        shares.fold(
            0.0,
            |most, share| {
                if share.is_finite() { f64::max(most, share) } else { f64::INFINITY }
            },
        )
    }

    /// The place of the tip, m.
    pub fn tip(&self) -> DVec3 {
        tip(&self.at)[0]
    }

    /// One tick of the loop and of the plant.
    pub fn tick(&mut self) -> Command<f64, 6> {
        let motion = &self.motion;
        // The encoders send what they latched in the tick before.
        let measured = self.measured;
        self.measured = self.at.q.map(|q| (q / STEP).round() * STEP);
        let before = *self.controller.reference();
        let fault = self.frozen.check(&measured, &before.q);
        let observed = self.controller.observe(fault.map(|()| &measured));
        let Estimate { q, qd } = *observed.estimate();
        let still = State { q, qd, qdd: [0.0; 6] };
        let MomentumAndCoriolis { p, ct_qd } = Core::<Ur5e>::momentum_and_coriolis(&still, &ROTORS);
        let weight = Core::<Ur5e>::rnea(&still, &Gravity::EARTH);
        let resistance = Core::<Ur5e>::rnea(&still, &friction(1.0));
        let bodies = Core::<Ur5e>::rnea(&State { qdd: before.qdd, ..still }, &RIGID);
        let beta = core::array::from_fn(|i| ct_qd[i] - weight[i] - resistance[i]);
        let errors = core::array::from_fn(|i| 0.03 * bodies[i].abs() + 0.1 * resistance[i].abs());
        // A lost measurement neither starts a reaction nor releases the arm.
        let contact = fault.and_then(|()| self.detector.update(&p, &beta, &errors));
        self.contact = contact.ok().flatten();

        let tick = if self.reacts {
            self.reaction.reference(observed, contact, motion)
        } else {
            observed.reference(motion)
        };
        let share = match self.reaction.phase() {
            ContactPhase::Floating => self.compensated,
            _ => 1.0,
        };
        let ahead = Core::<Ur5e>::rnea(tick.reference(), &(RIGID, friction(share)));
        let back = feedback(&self.gains, tick.reference(), tick.estimate());
        let command = tick.command(&core::array::from_fn(|i| ahead[i] + back[i]));
        self.detector.drive(&command.torque);
        if command.brake {
            self.at.qd = [0.0; 6];
            self.detector.restart();
            self.frozen.restart();
        } else {
            let scene = (RIGID, self.friction, self.wall);
            for _ in 0..PARTS {
                let h = TICK / f64::from(PARTS);
                semi_implicit(&self.arm, &mut self.at, &command.torque, &scene, h)
                    .expect("an arm with mass");
            }
        }
        command
    }
}
