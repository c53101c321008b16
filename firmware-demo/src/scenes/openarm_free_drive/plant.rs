//! An OpenArm with gears that stick, its Damiao drives at the ends of their frames, and the hand.

use dynamics_core::Core;
use dynamics_core::algorithms::frame;
use dynamics_core::effects::{
    Armature, Coriolis, Effect, Gravity, Inertia, Lugre, Payload, PreslidingLoadFriction, Width,
    hook,
};
use dynamics_core::model::Calibrated;
use dynamics_core::robots::OpenArm;
use dynamics_core::sim::linearly_implicit;
use dynamics_core::state::State;
use embedded_can::{Frame, StandardId};
use glam::Vec3;

use super::{
    GEARS, GRAVITY_ERROR, GRIP, HAND, MOTORS, NO_TOOL, RESOLUTION, SLIDING, STICTION, TICK, TOOL,
    Tool, borne, times, with_wrist,
};

use crate::scene::PlantModel;

pub type Q = [f32; 7];
/// The frames of the drives that have replied.
pub type Replies<F> = [Option<F>; 7];
/// The plant's steps in a tick, of 250 µs.
const PARTS: usize = 8;
/// The step before which each motor gets its command: after 130 µs for each, rounded up.
const ARRIVAL: [usize; 7] = [1, 2, 2, 3, 3, 4, 4];
const LOST: f32 = 1e-3;
/// The static friction is between that of the model and this times it: 2.4 to 3.3 N·m.
const MOST_STICTION: f32 = 3.3 / 2.4;

/// A generator of numbers (Marsaglia's xorshift64, 2003).
#[derive(Clone, Copy, Debug)]
pub struct Random(u64);

impl Random {
    /// Of the run of this number.
    pub fn seeded(run: u32) -> Self {
        let mut random = Self(0x9e37_79b9_7f4a_7c15 ^ u64::from(run + 1).wrapping_mul(0xd129_42c5));
        (0..8).for_each(|_| _ = random.within(0.0, 1.0));
        random
    }

    /// A number of this range.
    pub fn within(&mut self, from: f32, to: f32) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        from + (to - from) * ((self.0 >> 40) as f32 / 16_777_216.0)
    }

    fn factor(&mut self, off: f32) -> f32 {
        self.within(1.0 - off, 1.0 + off)
    }

    /// Each joint's value times such a factor.
    fn off(&mut self, of: Q, off: f32) -> Q {
        of.map(|x| x * self.factor(off))
    }
}

/// A hand that pulls the grip to a place by a spring and a damper.
#[derive(Clone, Copy, Debug, Default)]
pub struct Hand {
    pub goal: Vec3,
    pub velocity: Vec3,
    /// N/m and N·s/m; zero for a hand that is away.
    pub spring: [f32; 2],
}

impl Hand {
    pub fn force(&self, [place, velocity]: [Vec3; 2]) -> Vec3 {
        let [k, d] = self.spring;
        k * (self.goal - place) + d * (self.velocity - velocity)
    }
}

impl<const B: usize, const V: usize> Effect<f32, B, V> for Hand {
    const EXTERNAL_WRENCH: hook::Wrench<Self, f32> =
        hook::Wrench::of_state(|hand, body, at, fx| {
            if body == HAND {
                let (grip, back) = (GRIP, at.pose.rot.transpose());
                let velocity = back * (at.velocity.lin + at.velocity.ang.cross(grip));
                let force = at.pose.rot * hand.force([at.pose.pos + back * grip, velocity]);
                fx.lin += force;
                fx.ang += grip.cross(force);
            }
        });
}

pub type Scene = (
    Gravity,
    Inertia,
    Coriolis,
    Armature<f32, 7>,
    Payload<f32, HAND>,
    Lugre<f32, 7>,
    PreslidingLoadFriction<f32, 7>,
    Hand,
);

#[derive(Debug)]
pub struct Plant {
    pub at: State<f32, 7, 7>,
    pub scene: Scene,
    arm: Calibrated<OpenArm, f32, 7, 7, 7>,
    tool: Tool,
    /// What rounding has lost of the positions: a slow creep is less than a bit of them in a step.
    lost: Q,
    /// The torques that the drives have taken from their last command, N·m.
    torque: Q,
    random: Random,
    pub account: Account,
}

/// The work of the torques that [`Breakaway`](motion_control::law::Breakaway) added, by true
/// positions.
#[derive(Clone, Copy, Debug, Default)]
pub struct Account {
    acts: Q,
    from: Option<Q>,
    pub work: Q,
    pub path: Q,
}

impl Plant {
    /// At rest and with an empty hand; an arm, friction and a tool that are drawn, or those of the
    /// model but for its stiction.
    pub fn new(q: Q, plant: PlantModel, mut random: Random) -> Self {
        let off = if plant == PlantModel::Exact { 0.0 } else { 1.0 };
        let mut arm = Calibrated::nominal();
        let (weight, most) = (off * GRAVITY_ERROR, 0.3 * off);
        arm.inertias().for_each(|inertia| times(inertia, random.factor(weight)));
        let sliding = random.off(SLIDING, most);
        let stiction = STICTION.map(|least| least * random.within(1.0, MOST_STICTION));
        let gears = random.off(GEARS, most);
        let viscous = random.off(OpenArm::FRICTION.1.0, most);
        let tool = borne(TOOL, random.factor(weight));
        let bristles = Lugre {
            // They slide from 10⁻⁵ rad on: softer ones creep under a dither below their stiction,
            // which is an artefact of this model (Dupont, Armstrong & Hayward, 2000).
            stiffness: stiction.map(|most| 1e5 * most),
            damping: with_wrist(30.0),
            viscous,
            sliding,
            excess: core::array::from_fn(|i| stiction[i] - sliding[i]),
            stribeck_speed: Width::new(0.01),
            bristle: [0.0; 7],
        };
        let gears = PreslidingLoadFriction {
            magnitude: gears,
            torque: gears.map(|gear| 0.2 * gear),
            deflection: [2e-3; 7],
            direction: [0.0; 7],
        };
        let (rotors, away) = (OpenArm::ARMATURE, Hand::default());
        Self {
            at: State::at(q),
            scene: (Gravity::EARTH, Inertia, Coriolis, rotors, NO_TOOL, bristles, gears, away),
            arm,
            tool,
            lost: [0.0; 7],
            torque: [0.0; 7],
            random,
            account: Account::default(),
        }
    }

    /// The hand bears this share of the tool.
    pub fn bear(&mut self, share: f32) {
        self.scene.4 = borne(self.tool, share);
    }

    /// The place and the velocity of the grip, m and m/s.
    pub fn grip(&self) -> [Vec3; 2] {
        let k = Core::<OpenArm>::kinematics(&self.at, &());
        let arm = k.poses[HAND].rot * GRIP;
        let at = k.velocity(HAND, frame::LocalWorldAligned);
        [k.poses[HAND].pos + arm, at.lin + at.ang.cross(arm)]
    }

    /// A tick of drives and arm; `added` is the part of the commands that is accounted for. Returns
    /// the replies; nothing if the arm has no forward dynamics.
    pub fn tick<F: Frame>(&mut self, commands: &[Option<F>; 7], added: &Q) -> Option<Replies<F>> {
        let mut replies = [const { None }; 7];
        let h = TICK / PARTS as f32;
        for part in 0..PARTS {
            for (joint, reply) in replies.iter_mut().enumerate() {
                if ARRIVAL[joint] != part {
                    continue;
                }
                let came = !self.loses();
                self.account.tick(joint, self.at.q[joint], came.then_some(added[joint]));
                if let Some(command) = commands[joint].as_ref().filter(|_| came) {
                    let answer = self.drive(joint, command);
                    *reply = answer.filter(|_| !self.loses());
                }
            }
            let from = self.at.q;
            linearly_implicit(&self.arm, &mut self.at, &self.torque, &mut self.scene, h).ok()?;
            for ((q, from), (qd, lost)) in
                self.at.q.iter_mut().zip(from).zip(self.at.qd.iter().zip(&mut self.lost))
            {
                // Kahan's compensated sum, as of `KahanState`.
                let wanted = h * qd - *lost;
                *q = from + wanted;
                *lost = (*q - from) - wanted;
            }
            self.scene.7.goal += h * self.scene.7.velocity;
        }
        Some(replies)
    }

    fn loses(&mut self) -> bool {
        self.random.within(0.0, 1.0) < LOST
    }

    /// The drive's side of Damiao's protocol: torque alone, and a reply; none to a gain.
    fn drive<F: Frame>(&mut self, joint: usize, command: &F) -> Option<F> {
        let word = u64::from_be_bytes(command.data().try_into().ok()?);
        let [gains, torque] = [word >> 12 & 0xff_ffff, word & 0xfff];
        if gains != 0 {
            return None;
        }
        let scale = MOTORS[joint];
        self.torque[joint] = (2.0 * torque as f32 / 4095.0 - 1.0) * scale.torque;
        let count = |x: f32, most: f32, top: f32| libm::roundf((x / most + 1.0) * 0.5 * top) as u64;
        // Noise of half a step.
        let noise = 0.5 * RESOLUTION * self.random.within(-0.5, 0.5);
        let position = count(self.at.q[joint] + noise, scale.position, 65_535.0).min(65_535);
        let velocity = count(self.at.qd[joint], scale.velocity, 4095.0).min(4095);
        let id = joint as u64 + 1;
        let reply = (id | 0x10) << 56 | position << 40 | velocity << 28 | torque << 16;
        let host = StandardId::new(joint as u16 + 0x11)?;
        F::new(host, &(reply | 0x1f19).to_be_bytes())
    }
}

impl Account {
    /// A command reaches a joint, or is lost, and then the one before acts on.
    fn tick(&mut self, joint: usize, q: f32, added: Option<f32>) {
        let from = self.from.get_or_insert([f32::NAN; 7]);
        if from[joint].is_finite() {
            let step = q - from[joint];
            self.work[joint] += self.acts[joint] * step;
            self.path[joint] += step.abs();
        }
        from[joint] = q;
        self.acts[joint] = added.unwrap_or(self.acts[joint]);
    }
}
