//! `wheel_leg_balance`: a robot on two wheels, each on a leg of five bars, balances, drives over a
//! kerb, turns, squats and is pushed.
//!
//! The torque of a tick is u = u₀(L) − K(L) x: x are the deviations of pitch, cranks and wheels
//! and of their rates, u₀ carries the robot, and [`gains`] are those of the discrete regulator of
//! the robot's own linearisation at a length L of the legs. The inertial unit gives pitch and
//! rate. Beyond what it can hold the robot sits down: it stops, draws its legs in, and rests on its
//! skids. It has no trajectory of joints, and is no [`Scene`](crate::scene::Scene): its runs are
//! [trials](trial) of a [plant] with wheels that roll, slip and leave the ground.
//!
//! The numbers are assumed, of the size of the robots in RoboMaster's contests.

use core::f32::consts::{PI, TAU};

use dynamics_core::effects::{Armature, Coriolis, Coulomb, Gravity, Inertia, Viscous, Width};
use dynamics_core::model::{JointLimits, Robot};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use motion_control::estimate::Estimate;
use motion_control::law::{GainTable, TablePlace};
use motion_control::limits::{Command, ConfigError, Fault, Mode, SafetyLimits};
use motion_control::motion::{CurrentTick, MotionController, MotionControllerConfig};
use motion_control::safety::{StopCategory, SupervisorConfig};

use crate::robots::{Straight, WheelLeg};
use crate::scene::{Less, limits_of};
use crate::{marker, region};

pub mod gains;
pub mod plant;
pub mod trial;

/// s.
pub const TICK: f32 = 2e-3;
/// A step of the encoders, rad: 14 bits.
pub const RESOLUTION: f32 = TAU / 16_384.0;
/// The bandwidth of the observer, rad/s.
pub const BANDWIDTH: f32 = 300.0;
/// Rotors, kg·m², viscous friction, N·m·s/rad, and sliding friction, N·m, of a crank's motor and of
/// a wheel's.
pub const ROTORS: [f32; 2] = [0.01, 0.003];
pub const VISCOUS: [f32; 2] = [0.05, 0.02];
pub const SLIDING: [f32; 2] = [0.15, 0.05];
/// The lengths of the table of gains: the first one, and the step, m.
pub const LENGTHS: [f32; 2] = [0.14, 0.02];
/// Gains of six motors by seven deviations, by their rates, and by 1: u₀.
pub type Gains = GainTable<f32, 6, 15, 11>;

pub type Effects =
    (Gravity, Inertia, Coriolis, Viscous<f32, 16>, Coulomb<f32, 16>, Armature<f32, 16>);

pub const EFFECTS: Effects = (
    Gravity::EARTH,
    Inertia,
    Coriolis,
    Viscous(at_motors(VISCOUS)),
    Coulomb { torque: at_motors(SLIDING), width: Width::f32(0.05) },
    Armature(at_motors(ROTORS)),
);

/// Numbers of the motors of cranks and wheels, by the tree's coordinates.
const fn at_motors([crank, wheel]: [f32; 2]) -> [f32; 16] {
    let mut all = [0.0; 16];
    let mut leg = 0;
    while leg < 2 {
        let first = WheelLeg::BODY + 1 + 5 * leg;
        (all[first], all[first + 2], all[first + 4]) = (crank, crank, wheel);
        leg += 1;
    }
    all
}

/// The limits of rear crank, front crank and wheel, of the left leg and of the right one.
pub const LIMITS: [JointLimits<f32>; 6] = limits_of(&WheelLeg::MODEL, [6, 8, 10, 11, 13, 15]);

/// The inertial unit's pitch and its rate, rad and rad/s.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pitch {
    pub angle: f32,
    pub rate: f32,
}

/// What the robot is to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Order {
    /// Forward, m/s.
    pub speed: f32,
    /// To the left, rad/s.
    pub turn: f32,
    /// Of the legs, m.
    pub length: f32,
}

impl Order {
    pub const STAND: Self = Self { speed: 0.0, turn: 0.0, length: 0.22 };
    /// The most that each may change in a second.
    const RATES: [f32; 3] = [1.5, 4.0, 0.4];
    /// That of the length while the robot sits down, m/s.
    const SIT: f32 = 1.0;
}

/// The lean at which the robot sits down, and the one at which it gives up balancing, rad.
pub const LEAN: [f32; 2] = [0.42, 0.7];
/// The time by which the lean is foreseen, s.
const AHEAD: f32 = 0.08;
/// The greatest lead of the wheels' reference over the wheels, m.
const LEAD: f32 = 0.25;
/// The friction of tyres that a wheel's torque relies on.
const TRACTION: f32 = 0.7;
/// τ = −d q̇ of cranks and wheels while the robot sinks onto its skids, N·m·s/rad.
const SINKING: [f32; 6] = [1.5, 1.5, 0.1, 1.5, 1.5, 0.1];

/// What the law can lack: u₀, the torque that carries the robot, the limit of a wheel's torque by
/// the load of its leg, and the schedule, without which the gains and u₀ are those of
/// [`Order::STAND`].
pub const GRAVITY: Less = Less(0);
pub const TRACTION_LIMIT: Less = Less(1);
pub const SCHEDULE: Less = Less(2);

/// The controller: references, law and gate.
#[derive(Debug)]
pub struct Balance {
    gate: MotionController<f32, 6, CurrentTick>,
    order: Order,
    /// The way that each wheel is to have rolled, left and right, m.
    way: [f32; 2],
    sits: bool,
    /// Where the length of the legs is in the table of gains.
    pub place: TablePlace,
    less: Less,
}

impl Balance {
    /// Of a robot at rest with legs of the length of [`Order::STAND`] and wheels at zero.
    ///
    /// # Errors
    /// If a limit of the robot were impossible.
    pub fn new(less: Less) -> Result<Self, ConfigError> {
        let gate = MotionController::try_new(MotionControllerConfig {
            supervisor: SupervisorConfig {
                limits: SafetyLimits::from(LIMITS),
                tick: TICK,
                resolution: RESOLUTION,
                ride_through_ticks: 5,
                hold_ticks: 1,
                reentry_ticks: 10,
            },
            observer_bandwidth: BANDWIDTH,
            decay_rate: 10.0,
            restart_distance: 0.1,
        })?
        .with_stop(StopCategory::DampedLowering { damping: SINKING });
        let order = Order::STAND;
        let way = [straight(&order, 0.0)[1]; 2].map(|rod| rod * WheelLeg::RADIUS as f32);
        Ok(Self { gate, order, way, sits: false, place: TablePlace::Within, less })
    }

    /// The motors' positions at the order of now, with wheels as far as they are to be.
    pub fn standing(&mut self) -> [f32; 6] {
        self.reference(0.0).q
    }

    /// Whether the robot sits down, or has.
    pub fn sits(&self) -> bool {
        self.sits
    }

    /// One tick: positions of cranks and wheels, rear, front, wheel of the left leg and of the
    /// right one, or the fault that prevented them.
    pub fn tick(
        &mut self,
        measured: Result<&[f32; 6], Fault>,
        pitch: &Pitch,
        wanted: &Order,
    ) -> Command<f32, 6> {
        marker::start::<{ region::REFERENCE }>();
        self.supervise(pitch);
        let length_rate = self.follow(wanted);
        let reference = self.reference(length_rate);
        marker::stop::<{ region::REFERENCE }>();
        let tick = marker::measured::<{ region::READ }, _>(|| self.gate.observe(measured));
        let tick = tick.reference(&reference).without_inertia();
        let (torque, place) = marker::measured::<{ region::DYNAMICS }, _>(|| {
            law(&self.order, tick.reference(), tick.estimate(), pitch, self.less)
        });
        self.place = place;
        marker::measured::<{ region::SAFETY }, _>(|| tick.command(&torque))
    }

    /// Moves the order towards the wanted one; returns the rate of the legs' length, m/s.
    fn follow(&mut self, wanted: &Order) -> f32 {
        let least = WheelLeg::LENGTHS[0] as f32;
        let seat = Order { speed: 0.0, turn: 0.0, length: least };
        let (wanted, sink) =
            if self.sits { (&seat, Order::SIT) } else { (wanted, Order::RATES[2]) };
        let towards =
            |from: f32, to: f32, rate: f32| from + (to - from).clamped(-rate * TICK, rate * TICK);
        let before = self.order;
        self.order = Order {
            speed: towards(before.speed, wanted.speed, Order::RATES[0]),
            turn: towards(before.turn, wanted.turn, Order::RATES[1]),
            length: towards(before.length, wanted.length, sink),
        };
        let side = WheelLeg::SIDE as f32 * self.order.turn;
        self.way[0] += TICK * (self.order.speed - side);
        self.way[1] += TICK * (self.order.speed + side);
        (self.order.length - before.length) / TICK
    }

    /// Sits down if the robot is about to lean too far, from the speed that it has, and gives way
    /// where that cannot be held, or when the legs are drawn in.
    fn supervise(&mut self, pitch: &Pitch) {
        if self.gate.mode() != Mode::Full {
            self.sits = true;
            return;
        }
        if !self.sits && (pitch.angle + AHEAD * pitch.rate).abs() > LEAN[0] {
            self.sits = true;
            let rates = self.gate.estimate().qd;
            self.order.speed = 0.5 * WheelLeg::RADIUS as f32 * (rates[2] + rates[5]);
        }
        let low = self.sits && self.order.length <= WheelLeg::LENGTHS[0] as f32;
        if pitch.angle.abs() > LEAN[1] || low {
            let category = StopCategory::DampedLowering { damping: SINKING };
            self.gate.stop_by(Fault::External, category);
        }
    }

    /// The reference of cranks and wheels. It does not run away from a wheel that is held up.
    fn reference(&mut self, length_rate: f32) -> State<f32, 6, 6> {
        let [front, rod, front_rate, rod_rate] = straight(&self.order, length_rate);
        let (radius, side) = (WheelLeg::RADIUS as f32, WheelLeg::SIDE as f32 * self.order.turn);
        let lead = if self.sits { 0.1 * LEAD } else { LEAD };
        let [.., left, _, _, right] = self.gate.estimate().q;
        for (way, wheel) in self.way.iter_mut().zip([left, right]) {
            let rolled = (wheel + rod) * radius;
            *way = way.clamped(rolled - lead, rolled + lead);
        }
        let [left, right] = self.way.map(|way| way / radius - rod);
        let [slow, fast] = [-side, side].map(|turn| (self.order.speed + turn) / radius - rod_rate);
        State {
            q: [PI - front, front, left, PI - front, front, right],
            qd: [-front_rate, front_rate, slow, -front_rate, front_rate, fast],
            qdd: [0.0; 6],
        }
    }
}

/// Angles of the front crank and of the rear rod, and their rates.
fn straight(order: &Order, length_rate: f32) -> [f32; 4] {
    let [least, most] = WheelLeg::LENGTHS.map(|x| x as f32);
    let Straight { front, rear_rod, slopes: [a, b] } =
        Straight::of_length(order.length.clamped(least, most));
    [front, rear_rod, a * length_rate, b * length_rate]
}

/// u = u₀ − K x, and at a wheel no more than its tyre can pass on: |τ| ≤ μ r F, F being the force of
/// its leg by the torques of the cranks. A wheel in the air is not spun up.
fn law(
    order: &Order,
    reference: &State<f32, 6, 6>,
    estimate: &Estimate<f32, 6>,
    pitch: &Pitch,
    less: Less,
) -> ([f32; 6], TablePlace) {
    let length = if less == SCHEDULE { Order::STAND.length } else { order.length };
    let (gains, place) = gains::GAINS.at(length);
    let mut x = [0.0; 15];
    (x[0], x[7], x[14]) = (pitch.angle, pitch.rate, if less == GRAVITY { 0.0 } else { -1.0 });
    for j in 0..6 {
        x[1 + j] = estimate.q[j] - reference.q[j];
        x[8 + j] = estimate.qd[j] - reference.qd[j];
    }
    let mut torque = gains.map(|row| -row.iter().zip(&x).map(|(k, x)| k * x).sum::<f32>());
    if less != TRACTION_LIMIT {
        let by_length = straight(order, 1.0)[2];
        let [rear, front, wheel, right @ ..] = &mut torque;
        let [right_rear, right_front, right_wheel] = right;
        for (rear, front, wheel) in [(rear, front, wheel), (right_rear, right_front, right_wheel)] {
            let force = (*front - *rear) * by_length;
            let most = (TRACTION * WheelLeg::RADIUS as f32 * force).max(0.0);
            // What is not a number passes, and the gate stops it.
            if wheel.abs() > most {
                *wheel = most.copysign(*wheel);
            }
        }
    }
    (torque, place)
}
