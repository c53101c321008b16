//! The loop of an arm that is guided: encoders of 14 bits, observer, gravity compensation and the
//! law.

use dynamics_core::Core;
use dynamics_core::algorithms::{frame, task_jacobian};
use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia, Lugre};
use dynamics_core::model::ArmModel;
use dynamics_core::robots::Ur5e;
use dynamics_core::sim::linearly_implicit;
use dynamics_core::state::State;
use glam::DVec3;
use motion_control::estimate::{Estimate, Observer, ObserverConfig};
use motion_control::law::{
    CartesianImpedance, HandGuiding, HandGuidingConfig, LimitedSpring, SpeedBrake, TaskDeviation,
    TaskFrame,
};

use crate::hand_guiding::plant::{
    Hand, Inertias, Q, ROTORS, SLIDING, TIP, arm, modelled, real, tip,
};

pub const TICK: f64 = 1e-3;
const PARTS: u32 = 4; // the plant's steps in a tick
/// A step of an encoder of 14 bits, rad.
const STEP: f64 = core::f64::consts::TAU / 16_384.0;
const BANDWIDTH: f64 = 30.0; // rad/s, of the velocities
/// Uniform noise of the encoders, steps.
const NOISE: f64 = 0.5;

const RIGID: (Gravity, Inertia, Coriolis, Armature<f64, 6>) =
    (Gravity::EARTH, Inertia, Coriolis, ROTORS);

/// The configuration of hand guiding with walls that are far away.
pub fn config(error: f64, share: f64) -> HandGuidingConfig<f64, 6> {
    let spring = LimitedSpring {
        stiffness: [400.0, 400.0, 400.0, 60.0, 60.0, 60.0],
        damping: [30.0, 30.0, 30.0, 4.0, 4.0, 4.0],
        torque: [40.0, 40.0, 40.0, 10.0, 10.0, 10.0],
    };
    HandGuidingConfig {
        error,
        share,
        rest_speed: [0.002; 6],
        compensation: SLIDING.map(|f| 4.0 * f),
        damping: [0.0; 6],
        brake: SpeedBrake { speed: [2.0; 6], damping: [20.0; 6], torque: [10.0; 6] },
        lower: [-6.2; 6],
        upper: [6.2; 6],
        wall: spring,
        lock: spring,
    }
}

/// The hand guiding of an arm, and the errors of its model.
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    pub config: HandGuidingConfig<f64, 6>,
    /// The modelled friction exceeds that of the arm by this share.
    pub over: f64,
    pub inertias: Inertias,
    /// The stated error of gravity, as a share of it.
    pub gravity_error: f64,
}

pub struct Cell {
    pub guiding: HandGuiding<f64, 6>,
    pub at: State<f64, 6, 6>,
    pub hand: Hand,
    /// The torque of the law in the last tick, N·m.
    pub guide: Q,
    /// The tip is held at a height, m.
    pub level: Option<(CartesianImpedance<f64, 1>, f64)>,
    observer: Observer<f64, 6>,
    arm: ArmModel<f64, 6>,
    friction: Lugre<f64, 6>,
    pub over: f64,
    gravity_error: f64,
    measured: Q,
    random: u32,
}

fn measure(q: &Q) -> Q {
    q.map(|q| (q / STEP).round() * STEP)
}

impl Cell {
    pub fn new(q: Q, setup: &Setup) -> Self {
        let config = ObserverConfig { bandwidth: BANDWIDTH, tick: TICK };
        let mut observer = Observer::try_new(config).expect("a good one");
        observer.reset(&measure(&q));
        Self {
            guiding: HandGuiding::try_new(setup.config).expect("a good one"),
            at: State::at(q),
            hand: Hand::Away,
            guide: [0.0; 6],
            level: None,
            observer,
            arm: arm(setup.inertias),
            friction: real(),
            over: setup.over,
            gravity_error: setup.gravity_error,
            measured: measure(&q),
            random: 0x5eed_1234,
        }
    }

    /// The place of the tip, m.
    pub fn tip(&self) -> DVec3 {
        tip(&self.at)[0]
    }

    /// The force of the hand, N.
    pub fn force(&self) -> DVec3 {
        self.hand.force(tip(&self.at))
    }

    /// In (-1, 1).
    fn noise(&mut self) -> f64 {
        self.random ^= self.random << 13;
        self.random ^= self.random >> 17;
        self.random ^= self.random << 5;
        f64::from(self.random) / f64::from(u32::MAX) * 2.0 - 1.0
    }

    /// One tick of the loop and of the plant.
    pub fn tick(&mut self) {
        // The encoders send what they latched in the tick before.
        let noisy = self.at.q.map(|q| q + NOISE * STEP * self.noise());
        let measured = core::mem::replace(&mut self.measured, measure(&noisy));
        let estimate = *self.observer.update_delayed(&measured, &[0.0; 6]);
        self.tick_by(&estimate);
    }

    /// The greatest distance of the tip from where it is now within these ticks, m.
    pub fn run(&mut self, ticks: u32) -> f64 {
        let from = self.tip();
        (0..ticks).fold(0.0, |most: f64, _| {
            self.tick();
            most.max((self.tip() - from).length())
        })
    }

    pub fn tick_by(&mut self, estimate: &Estimate<f64, 6>) {
        let Estimate { q, qd } = *estimate;
        let at = State { qd, ..State::at(q) };
        let gravity = Core::<Ur5e>::rnea(&at, &Gravity::EARTH);
        let friction = Core::<Ur5e>::rnea(&at, &modelled(1.0 + self.over));
        let errors = gravity.map(|g| self.gravity_error * g);
        self.guide = self.guiding.torque(estimate, &friction, &errors);
        let guided = core::array::from_fn(|i| gravity[i] + self.guide[i]);
        let tau = self.levelled(estimate, guided);
        let mut scene = (RIGID, self.friction, self.hand);
        for _ in 0..PARTS {
            let h = TICK / f64::from(PARTS);
            linearly_implicit(&self.arm, &mut self.at, &tau, &mut scene, h)
                .expect("an arm with mass");
            if let Hand::Lead(place, velocity) = &mut scene.2 {
                *place += h * *velocity;
            }
        }
        (self.friction, self.hand) = (scene.1, scene.2);
    }

    /// With the torques that hold the tip at its height.
    fn levelled(&mut self, estimate: &Estimate<f64, 6>, guided: Q) -> Q {
        let Some((impedance, height)) = &mut self.level else {
            return guided;
        };
        let Estimate { q, qd } = *estimate;
        let tip = tip(&State { qd, ..State::at(q) });
        let columns = Core::<Ur5e>::jacobian(&q, TIP, frame::LocalWorldAligned);
        let rows = task_jacobian(&columns, &TaskFrame::BASE.place()[2..].try_into().expect("one"));
        let factors =
            Core::<Ur5e>::ltdl(&Core::<Ur5e>::crba(&q, &RIGID)).expect("an arm with mass");
        let solve = |tau: &_| Core::<Ur5e>::solve(&factors, tau);
        let deviation = TaskDeviation { position: [*height - tip[0].z], velocity: [-tip[1].z] };
        let torque = impedance.torque(&rows, solve, &deviation, &guided, &[0.0; 6]);
        torque.expect("finite").tau
    }
}
