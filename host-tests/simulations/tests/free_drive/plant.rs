//! An OpenArm with gears that stick, its Damiao drives at the ends of their frames, and the hand.

use dynamics_core::Core;
use dynamics_core::algorithms::frame;
use dynamics_core::effects::{
    Armature, Coriolis, Effect, Gravity, Inertia, Lugre, Payload, PreslidingLoadFriction, Width,
    hook,
};
use dynamics_core::model::{ArmModel, BodyInertia, model};
use dynamics_core::robots::OpenArm;
use dynamics_core::sim::linearly_implicit;
use dynamics_core::state::State;
use embedded_can::{Frame, StandardId};
use firmware_demo::scenes::openarm_free_drive::{
    GEARS, GRIP, HAND, MOTORS, RESOLUTION, SLIDING, STICTION, TICK, WRIST,
};
use glam::DVec3;
use joint_drivers::can::ClassicFrame;

pub type Q = [f64; 7];
/// The plant's steps in a tick, of 250 µs.
const PARTS: usize = 8;
/// The step before which each motor gets its command: after 130 µs for each, rounded up.
const ARRIVAL: [usize; 7] = [1, 2, 2, 3, 3, 4, 4];
const LOST: f64 = 1e-3;
/// The static friction is between that of the model and this times it: 2.4 to 3.3 N·m.
const MOST_STICTION: f64 = 3.3 / 2.4;

/// A generator of numbers (Marsaglia's xorshift64, 2003).
pub struct Random(u64);

impl Random {
    pub fn seeded(run: u32) -> Self {
        let mut random = Self(0x9e37_79b9_7f4a_7c15 ^ u64::from(run + 1).wrapping_mul(0xd129_42c5));
        (0..8).for_each(|_| _ = random.within(0.0, 1.0));
        random
    }

    pub fn within(&mut self, from: f64, to: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        from + (to - from) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Each joint's value times a factor from 1 − off to 1 + off.
    fn off<const N: usize>(&mut self, of: [f64; N], off: f64) -> [f64; N] {
        of.map(|x| x * self.within(1.0 - off, 1.0 + off))
    }
}

/// A hand that pulls the grip to a place by a spring and a damper.
#[derive(Clone, Copy, Debug)]
pub struct Hand {
    pub goal: DVec3,
    pub velocity: DVec3,
    /// N/m and N·s/m; zero for a hand that is away.
    pub spring: [f64; 2],
}

impl Hand {
    pub fn force(&self, [place, velocity]: [DVec3; 2]) -> DVec3 {
        let [k, d] = self.spring;
        k * (self.goal - place) + d * (self.velocity - velocity)
    }
}

impl<const B: usize, const V: usize> Effect<f64, B, V> for Hand {
    const EXTERNAL_WRENCH: hook::Wrench<Self, f64> =
        hook::Wrench::of_state(|hand, body, at, fx| {
            if body == HAND {
                let (grip, back) = (DVec3::from(GRIP), at.pose.rot.transpose());
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
    Armature<f64, 7>,
    Payload<f64, HAND>,
    Lugre<f64, 7>,
    PreslidingLoadFriction<f64, 7>,
    Hand,
);

pub struct Plant {
    pub at: State<f64, 7, 7>,
    pub scene: Scene,
    arm: ArmModel<f64, 7>,
    /// The torques that the drives have taken from their last command, N·m.
    torque: Q,
    random: Random,
    pub account: Account,
}

/// The work of the torques that [`Breakaway`](motion_control::Breakaway) added, by true positions.
#[derive(Default)]
pub struct Account {
    acts: Q,
    from: Option<Q>,
    pub work: Q,
    pub path: Q,
}

impl Plant {
    /// At rest, with an arm, friction and a tool that are drawn.
    pub fn new(q: Q, tool: f64, mut random: Random) -> Self {
        let mut arm = *model::<f64, OpenArm, 7, 7, 7>();
        for link in &mut arm.links {
            let (inertia, off) = (&mut link.inertia, random.within(0.98, 1.02));
            inertia.mass *= off;
            inertia.first_moment *= off;
            inertia.rotational *= off;
        }
        let sliding = random.off(SLIDING.map(f64::from), 0.3);
        let stiction = STICTION.map(|least| f64::from(least) * random.within(1.0, MOST_STICTION));
        let gears = random.off(GEARS.map(f64::from), 0.3);
        let viscous = random.off(OpenArm::FRICTION.1.0.map(f64::from), 0.3);
        let tool = tool * random.within(0.98, 1.02);
        let bristles = Lugre {
            // They slide from 10⁻⁵ rad on: softer ones creep under a dither below their stiction,
            // which is an artefact of this model (Dupont, Armstrong & Hayward, 2000).
            stiffness: stiction.map(|most| 1e5 * most),
            damping: core::array::from_fn(|i| 30.0 * if i < 4 { 1.0 } else { f64::from(WRIST) }),
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
        let inertia = [1e-3, 0.0, 0.0, 1e-3, 0.0, 1e-3].map(|i| tool * i);
        let load = Payload::from_inertia(BodyInertia { mass: tool, com: GRIP, inertia });
        let away = Hand { goal: DVec3::ZERO, velocity: DVec3::ZERO, spring: [0.0; 2] };
        let rotors = Armature(OpenArm::ARMATURE.0.map(f64::from));
        Self {
            at: State::at(q),
            scene: (Gravity::EARTH, Inertia, Coriolis, rotors, load, bristles, gears, away),
            arm,
            torque: [0.0; 7],
            random,
            account: Account::default(),
        }
    }

    /// The place and the velocity of the grip, m and m/s.
    pub fn grip(&self) -> [DVec3; 2] {
        let k = Core::<OpenArm>::kinematics(&self.at, &());
        let arm = k.poses[HAND].rot * DVec3::from(GRIP);
        let at = k.velocity(HAND, frame::LocalWorldAligned);
        [k.poses[HAND].pos + arm, at.lin + at.ang.cross(arm)]
    }

    /// The force of the hand, N.
    pub fn force(&self) -> f64 {
        self.scene.7.force(self.grip()).length()
    }

    /// A tick of drives and arm; `added` is the part of the commands that is accounted for. Returns
    /// the replies.
    pub fn tick(&mut self, commands: &[Option<ClassicFrame>; 7], added: &Q) -> Vec<ClassicFrame> {
        let mut replies = Vec::new();
        for part in 0..PARTS {
            for joint in (0..7).filter(|joint| ARRIVAL[*joint] == part) {
                let came = !self.loses();
                self.account.tick(joint, self.at.q[joint], came.then_some(added[joint]));
                if let Some(command) = commands[joint].filter(|_| came) {
                    let reply = self.drive(joint, &command);
                    replies.extend((!self.loses()).then_some(reply));
                }
            }
            let h = f64::from(TICK) / PARTS as f64;
            linearly_implicit(&self.arm, &mut self.at, &self.torque, &mut self.scene, h)
                .expect("an arm with mass");
            self.scene.7.goal += h * self.scene.7.velocity;
        }
        replies
    }

    fn loses(&mut self) -> bool {
        self.random.within(0.0, 1.0) < LOST
    }

    /// The drive's side of Damiao's protocol: torque alone, and a reply.
    fn drive(&mut self, joint: usize, command: &ClassicFrame) -> ClassicFrame {
        let data: [u8; 8] = command.data().try_into().expect("eight bytes");
        let word = u64::from_be_bytes(data);
        assert_eq!(word >> 12 & 0xff_ffff, 0, "a gain");
        let scale = MOTORS[joint];
        let share = 2.0 * (word & 0xfff) as f64 / 4095.0 - 1.0;
        self.torque[joint] = share * f64::from(scale.torque);
        let count = |x: f64, most: f32, top: f64| {
            ((x / f64::from(most) + 1.0) * 0.5 * top).round().clamp(0.0, top) as u64
        };
        // Noise of half a step.
        let noise = 0.5 * f64::from(RESOLUTION) * self.random.within(-0.5, 0.5);
        let position = count(self.at.q[joint] + noise, scale.position, 65_535.0);
        let velocity = count(self.at.qd[joint], scale.velocity, 4095.0);
        let id = joint as u64 + 1;
        let reply = (id | 0x10) << 56 | position << 40 | velocity << 28 | (word & 0xfff) << 16;
        let host = StandardId::new(joint as u16 + 0x11).expect("eleven bits");
        ClassicFrame::new(host, &(reply | 0x1f19).to_be_bytes()).expect("eight bytes")
    }
}

impl Account {
    /// A command reaches a joint, or is lost, and then the one before acts on.
    fn tick(&mut self, joint: usize, q: f64, added: Option<f64>) {
        let from = self.from.get_or_insert([f64::NAN; 7]);
        if from[joint].is_finite() {
            let step = q - from[joint];
            self.work[joint] += self.acts[joint] * step;
            self.path[joint] += step.abs();
        }
        from[joint] = q;
        self.acts[joint] = added.unwrap_or(self.acts[joint]);
    }
}
