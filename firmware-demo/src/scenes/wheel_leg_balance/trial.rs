//! A trial: the robot follows orders, and is pushed.

use dynamics_core::effects::Gravity;
use dynamics_core::model::JointLimits;
use glam::Vec3;
use joint_drivers::Telemetry;
use motion_control::limits::{Command, Mode, Status};

use super::plant::Plant;
use super::{Balance, LIMITS, Order, SCHEDULE, TICK};
use crate::marker;
use crate::region;
use crate::robots::WheelLeg;
use crate::scene::{Batch, Figures, Less, PlantModel, Term, Trial};
use crate::scenes::openarm_free_drive::plant::Random;

/// A push from a tick on, for 100 ms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    pub tick: u32,
    /// Forward and to the left, N.
    pub force: [f32; 2],
}

const PUSHED: u32 = 50;

/// Orders, each from a tick on.
pub type Course = [(u32, Order); 8];

#[derive(Clone, Copy, Debug)]
pub struct Ride {
    pub plant: PlantModel,
    pub less: Less,
    pub random: Random,
    pub course: Course,
    pub pushes: [Push; 2],
    /// Where a kerb begins, and its height, m.
    pub kerb: [f32; 2],
    /// rad.
    pub heading: f32,
    pub ticks: u32,
}

#[derive(Clone, Copy, Debug, Default)]
pub struct Outcome {
    /// The pitch at its largest, and its root mean square, rad.
    pub pitch: f32,
    pub rms: f32,
    /// The robot has sat down.
    pub sat: bool,
    /// A skid has touched the ground.
    pub touched: bool,
    /// The greatest speed of the body downward within a millimetre of the ground, m/s.
    pub impact: f32,
    /// The pitch at the end, rad, and the greatest speed then, of anything.
    pub rest: [f32; 2],
    /// The greatest torque at the end, N·m.
    pub torque: f32,
    /// How far it has come, m.
    pub way: f32,
    pub status: Option<Status>,
}

impl Outcome {
    /// It balances at the end, and has never touched the ground but by its wheels.
    pub fn stands(&self) -> bool {
        let full = self.status.is_some_and(|status| status.mode == Mode::Full);
        full && !self.sat && !self.touched
    }
}

const fn order(speed: f32, turn: f32, length: f32) -> Order {
    Order { speed, turn, length }
}

/// Over the kerb, a turn, a squat and up, and pushes.
const COURSE: Course = [
    (0, Order::STAND),
    (50, order(0.9, 0.0, 0.22)),
    (1000, order(0.5, 1.0, 0.22)),
    (1300, Order::STAND),
    (1500, order(0.0, 0.0, 0.15)),
    (1750, order(0.0, 0.0, 0.32)),
    (2050, order(0.0, 0.0, 0.22)),
    (2900, Order::STAND),
];

/// The whole tick between its markers.
#[inline(never)]
fn marked_tick(
    balance: &mut Balance,
    (q, pitch): &([f32; 6], super::Pitch),
    order: &Order,
) -> Command<f32, 6> {
    marker::measured::<{ region::TICK }, _>(|| {
        let command = balance.tick(Ok(q), pitch, order);
        marker::measured::<{ region::WRITE }, _>(|| core::hint::black_box(command))
    })
}

impl Ride {
    /// A trial in the envelope: at 0.6 to 0.9 m/s over a kerb of up to 3 cm within 0.2 rad of
    /// square, a turn of up to 1 rad/s, other lengths of the legs from 0.16 to 0.3 m, and two
    /// pushes of 100 ms with up to 50 N forward or back and 30 N sideways, one of them in the
    /// motion; of a robot, friction and sensors that are off.
    pub fn drawn(seed: u32, less: Less) -> Self {
        let mut random = Random::seeded(seed);
        let mut within = |from, to| random.within(from, to);
        let (speed, turn) = (within(0.6, 0.9), within(-1.0, 1.0));
        let [first, second] = [within(0.16, 0.3), within(0.16, 0.3)];
        let pushes = [1050, 1450].map(|tick| {
            let force = [within(-50.0, 50.0), within(-30.0, 30.0)];
            Push { tick, force }
        });
        let kerb = [within(0.7, 1.0), within(0.0, 0.03)];
        let heading = within(-0.2, 0.2);
        let last = (1250, order(0.0, 0.0, second));
        let course = [
            (0, order(0.0, 0.0, first)),
            (50, order(speed, 0.0, first)),
            (950, order(0.4, turn, first)),
            (1150, order(0.0, 0.0, first)),
            last,
            last,
            last,
            last,
        ];
        let plant = PlantModel::Mismatched;
        Self { plant, less, random, course, pushes, kerb, heading, ticks: 2000 }
    }

    /// The same with pushes of so many times the force, and time to sit down.
    pub fn pushed(seed: u32, times: f32) -> Self {
        let mut trial = Self::drawn(seed, Less::NOTHING);
        for push in &mut trial.pushes {
            push.force = push.force.map(|force| times * force);
        }
        Self { ticks: 3500, ..trial }
    }
}

impl Trial<6> for Ride {
    const NAME: &'static str = "wheel_leg_balance";
    const TICK: f32 = TICK;
    /// The largest pitch, rad.
    const BOUND: f32 = 0.3;
    const LIMITS: [JointLimits<f32>; 6] = LIMITS;
    const TERMS: &'static [Term] = &[
        Term { name: || "Gravity", bytes: size_of::<Gravity>() },
        Term { name: || "traction", bytes: size_of::<f32>() },
    ];

    fn ticks(&self) -> u32 {
        self.ticks
    }
}

impl Batch<6> for Ride {
    type Outcome = Outcome;
    const BASELINE: Less = SCHEDULE;

    fn of_scene(less: Less, plant: PlantModel) -> Self {
        let push = |tick, force| Push { tick, force };
        let pushes = [push(2200, [60.0, 0.0]), push(2500, [0.0, 40.0])];
        let random = Random::seeded(0);
        let (kerb, heading) = ([1.0, 0.03], 0.0);
        Self { plant, less, random, course: COURSE, pushes, kerb, heading, ticks: 2900 }
    }

    /// Sees the measured positions of the motors as reference and estimate, and the pitch.
    fn run<F: FnMut(&Telemetry<6>, f32)>(&self, mut see: F) -> Option<Outcome> {
        let mut balance = Balance::new(self.less).ok()?;
        let mut plant = Plant::new(self.plant, self.kerb, self.heading, self.random);
        let mut out = Outcome::default();
        for tick in 0..self.ticks {
            let order = self.course.iter().rfind(|(from, _)| *from <= tick)?.1;
            let (sin, cos) = libm::sincosf(plant.state().q[3]);
            plant.ground().push = self.pushes.iter().fold(Vec3::ZERO, |sum, push| {
                let [x, y] = push.force;
                let acts = (push.tick..push.tick + PUSHED).contains(&tick);
                if acts { sum + Vec3::new(cos * x - sin * y, sin * x + cos * y, 0.0) } else { sum }
            });
            let measured = plant.measured();
            let command = marked_tick(&mut balance, &measured, &order);
            plant.tick(&command.torque).ok()?;
            let y = plant.state();
            let pitch = y.q[WheelLeg::PITCH];
            let (q, torque, status) = (measured.0, command.torque, command.status);
            see(&Telemetry { tick, reference: q, estimate: q, torque, status }, pitch);
            out.pitch = out.pitch.max(pitch.abs());
            out.rms += pitch * pitch;
            let clearance = plant.clearance();
            out.touched |= clearance < 0.0;
            if clearance < 1e-3 {
                out.impact = out.impact.max(-y.qd[2]);
            }
            out.torque = command.torque.iter().fold(0.0, |most, x| x.abs().max(most));
            out.rest = [pitch, y.qd.iter().fold(0.0, |most, x| x.abs().max(most))];
            out.status = Some(command.status);
        }
        let y = plant.state();
        out.way = libm::hypotf(y.q[0], y.q[1]);
        out.sat = balance.sits();
        out.rms = libm::sqrtf(out.rms / self.ticks as f32);
        Some(out)
    }

    fn figures(&Outcome { pitch, rms, status, .. }: &Outcome) -> Figures {
        Figures { rms, max: pitch, start: None, status }
    }

    fn tick_at<F: FnMut(&Telemetry<6>, f32)>(_: &F) -> usize {
        marked_tick as *const () as usize
    }
}
