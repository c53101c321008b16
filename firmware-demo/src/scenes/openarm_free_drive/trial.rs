//! A trial: a hand leads the arm, over the frames of its bus, lets it go, and it rests. It may pick
//! a tool up then, be led once more, and rest again.

use dynamics_core::effects::{Gravity, LoadFriction};
use dynamics_core::model::{JointLimits, Robot};
use dynamics_core::robots::OpenArm;
use dynamics_core::state::State;
use glam::Vec3;
use joint_drivers::can::ClassicFrame;
use joint_drivers::{ControlLoop, NoBrake, Phase, Probe, Telemetry};
use motion_control::law::{Breakaway, Gains};
use motion_control::limits::{Mode, Status};
use motion_control::motion::MotionController;

use super::plant::{Plant, Q, Random, Replies};
use super::{
    Free, FreeDrive, Friction, Joints, Kept, RESOLUTION, TICK, TOOL, Tool, borne, breakaway,
    controller, guiding, joints, limits,
};
use crate::marker;
use crate::region::{Marked, READ, TICK as WHOLE};
use crate::scene::{Batch, Figures, Less, Other, PlantModel, Term, Trial, limits_of};

/// The hand, N/m and N·s/m.
const SPRING: [f32; 2] = [2000.0, 50.0];
/// Its way, m.
const WAY: f32 = 0.04;
/// The distance of the grip from which on the arm moves, m.
const MOVED: f32 = 2e-3;
/// The ticks in which a gripper closes: the weight of the tool goes over to the hand evenly.
pub const CLOSING: u32 = 100;
/// The ticks by which the payload of the law follows the gripper.
const LATE: u32 = 10;

/// Whether the hand of the arm holds a tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holds {
    Nothing,
    Tool,
    /// A tool, which it picks up after a third of the first rest.
    PickedUp,
}

/// What the law can lack: one of the terms, or all but gravity (and the tool).
pub const GRAVITY: Less = Less(0);
pub const PAYLOAD: Less = Less(1);
pub const FRICTION: Less = Less(2);
pub const GEAR_FRICTION: Less = Less(3);
pub const PUSH: Less = Less(4);
pub const DITHER: Less = Less(5);
pub const PUSH_AND_DITHER: Less = Less(6);
pub const ALL_BUT_GRAVITY: Less = Less(7);

/// A trial.
#[derive(Clone, Copy, Debug)]
pub struct Guidance {
    /// The posture at the start, rad.
    pub posture: Q,
    /// The directions in which the hand leads the arm, the second one after the rest.
    pub ways: [Vec3; 2],
    /// The numbers that draw the plant and the frames that are lost.
    pub random: Random,
    pub holds: Holds,
    /// The plant has the stiction that is drawn, and is otherwise the law's model, or it is not.
    pub plant: PlantModel,
    pub less: Less,
    /// The seconds before the way of the hand, of it, after it, and of the release.
    pub seconds: [f32; 4],
    /// The seconds of a second rest, before which the hand leads the arm once more.
    pub again: Option<f32>,
}

/// The figures of a trial.
#[derive(Clone, Copy, Debug, Default)]
pub struct Outcome {
    /// The greatest force of the hand until the grip has moved by 2 mm, N.
    pub start: f32,
    /// The same after the rest.
    pub again: f32,
    /// The mean force in the middle of the way, N.
    pub drag: f32,
    /// The greatest distance of the grip from the place of the release, and its root mean square,
    /// m.
    pub drift: f32,
    pub rms: f32,
    /// The most by which a joint has gone back and forth in the second half of the rest, steps of
    /// its encoder.
    pub reversal: f32,
    /// The most of work less friction's part that a joint has got, as a share of its energy.
    pub spent: f32,
    /// The most that is missing in a tank, as a share of its energy.
    pub own: f32,
    /// The last status in a rest in which the controller was in full operation, or the first before
    /// in which it was not.
    pub status: Option<Status>,
}

impl Outcome {
    /// The controller has left full operation: the hand has led a joint out of its bounds. The arm
    /// has no brake, and falls.
    pub fn fault(&self) -> bool {
        self.status.is_none_or(|status| status.mode != Mode::Full)
    }
}

fn law(less: Less) -> Option<FreeDrive> {
    let (mut guiding, mut breakaway) = (guiding().ok()?, breakaway());
    if matches!(less, FRICTION | ALL_BUT_GRAVITY) {
        guiding.share = 0.0;
    }
    if less == ALL_BUT_GRAVITY {
        guiding.damping = [0.0; 7];
    }
    if matches!(less, PUSH | PUSH_AND_DITHER | ALL_BUT_GRAVITY) {
        breakaway.push = 0.0;
    }
    if matches!(less, DITHER | PUSH_AND_DITHER | ALL_BUT_GRAVITY) {
        breakaway.dither = 0.0;
    }
    let mut law = FreeDrive::new(guiding, breakaway).ok()?;
    if less == GRAVITY {
        law.gravity = Gravity::new(0.0);
    }
    if less == GEAR_FRICTION {
        (law.friction.2.driving, law.friction.2.backdriving) = ([0.0; 7], [0.0; 7]);
    }
    Some(law)
}

/// Two fifths of a joint's range about its middle, so that the way ends before the walls.
fn posture(random: &mut Random) -> Q {
    let limits = limits();
    core::array::from_fn(|i| {
        let [lower, upper] = [limits.lower[i], limits.upper[i]];
        lower + (upper - lower) * random.within(0.3, 0.7)
    })
}

fn direction(random: &mut Random) -> Vec3 {
    loop {
        let way = Vec3::from_array([(); 3].map(|()| random.within(-1.0, 1.0)));
        if (0.1..1.0).contains(&way.length_squared()) {
            return way.normalize();
        }
    }
}

/// The markers of a tick whose frames are unpacked before the loop's own, as part of the reading,
/// and who sees its record.
struct Unpacked<'s, F>(&'s mut F);

impl<F: FnMut(&Telemetry<7>, f32)> Probe<7> for Unpacked<'_, F> {
    #[inline(always)]
    fn begin(&mut self, phase: Phase) {
        if !matches!(phase, Phase::Tick | Phase::Read) {
            Probe::<7>::begin(&mut Marked(()), phase);
        }
    }

    #[inline(always)]
    fn end(&mut self, phase: Phase) {
        if !matches!(phase, Phase::Tick) {
            Probe::<7>::end(&mut Marked(()), phase);
        }
    }

    #[inline(always)]
    fn record(&mut self, telemetry: &Telemetry<7>) {
        (self.0)(telemetry, f32::NAN);
    }
}

type Loop<'a> = ControlLoop<Kept<'a, &'a Joints>, &'a Joints, NoBrake, 7>;

/// A tick from the frames that came to those that are sent, between the markers of its regions.
#[inline(never)]
fn marked_tick<F: FnMut(&Telemetry<7>, f32)>(
    control: &mut Loop<'_>,
    joints: &Joints,
    law: &FreeDrive,
    reference: &State<f32, 7, 7>,
    came: &Replies<ClassicFrame>,
    see: &mut F,
) -> (Replies<ClassicFrame>, Status) {
    marker::start::<WHOLE>();
    marker::start::<READ>();
    came.iter().flatten().for_each(|frame| joints.receive(frame));
    let status = control.tick_probed::<Free, _, _>(reference, law, &mut Unpacked(see)).status;
    let commands = joints.commands();
    marker::stop::<WHOLE>();
    (commands, status)
}

/// The arm in its loop.
struct Cell<'a, F> {
    control: Loop<'a>,
    joints: &'a Joints,
    law: &'a FreeDrive,
    reference: State<f32, 7, 7>,
    replies: Replies<ClassicFrame>,
    plant: Plant,
    seconds: [f32; 4],
    /// The tool becomes a payload of the law.
    follows: bool,
    status: Option<Status>,
    out: Outcome,
    see: F,
}

impl<F: FnMut(&Telemetry<7>, f32)> Cell<'_, F> {
    /// The time until each drive has replied to zero torque: in a tick of the loop a lost frame
    /// would be a fault of the start, which stops the arm. Friction holds it.
    #[inline(never)]
    fn start(&mut self, commands: &Replies<ClassicFrame>) -> Option<()> {
        while self.replies.iter().any(Option::is_none) {
            self.replies = self.plant.tick(commands, &[0.0; 7])?;
        }
        Some(())
    }

    fn tick(&mut self) -> Option<()> {
        let Self {
            control, joints, law, reference, replies, plant, status: last, out, see, ..
        } = self;
        let (commands, status) = marked_tick(control, joints, law, reference, replies, see);
        if !last.is_some_and(|status| status.mode != Mode::Full) {
            *last = Some(status);
        }
        *replies = plant.tick(&commands, &law.added.get())?;
        let (own, budget) = (law.breakaway.try_borrow().ok()?.energy(), breakaway());
        for (i, energy) in budget.energy.into_iter().enumerate() {
            let passive = (1.0 - budget.share) * budget.friction[i];
            let spent = plant.account.work[i] - passive * plant.account.path[i];
            out.spent = out.spent.max(spent / energy);
            out.own = out.own.max(1.0 - own[i] / energy);
        }
        Some(())
    }

    /// The hand leads the grip along a way of least jerk. Returns its force at the start and on the
    /// way, N.
    fn lead(&mut self, way: Vec3) -> Option<[f32; 2]> {
        let [from, _] = self.plant.grip();
        let (mut start, mut drag, mut moved) = (0.0_f32, 0.0, false);
        (self.plant.scene.7.goal, self.plant.scene.7.spring) = (from, SPRING);
        let [_, on_way, after, _] = self.seconds;
        let all = ticks(on_way);
        for k in 0..all + ticks(after) {
            let s = (k as f32 + 0.5) / all as f32;
            let part = s * (1.0 - s);
            let speed = if k < all { 30.0 * part * part } else { 0.0 };
            self.plant.scene.7.velocity = WAY / on_way * speed * way;
            self.tick()?;
            let grip = self.plant.grip();
            let force = self.plant.scene.7.force(grip).length();
            moved |= (grip[0] - from).length() > MOVED;
            start = if moved { start } else { start.max(force) };
            if (all / 4..3 * all / 4).contains(&k) {
                drag += force / (all / 2) as f32;
            }
        }
        self.plant.scene.7.spring = [0.0; 2];
        Some([start, drag])
    }

    /// Closes the gripper further, which began to close this many ticks ago.
    fn close(&mut self, ticks: u32) {
        let share = |ticks: u32| ticks.min(CLOSING) as f32 / CLOSING as f32;
        self.plant.bear(share(ticks));
        if self.follows {
            self.law.tool.set(borne(TOOL, share(ticks.saturating_sub(LATE))));
        }
    }

    /// The time after the release, in which the hand may pick a tool up.
    fn rest(&mut self, seconds: f32, picks_up: bool) -> Option<()> {
        let ([from, _], all) = (self.plant.grip(), ticks(seconds));
        let mut ends = [self.plant.at.q; 2];
        let (mut swings, mut squares) = ([[0.0_f32; 7]; 2], 0.0);
        for k in 0..all {
            if picks_up && k >= all / 3 {
                self.close(k - all / 3);
            }
            self.tick()?;
            let (grip, q) = (self.plant.grip()[0], self.plant.at.q);
            let far = (grip - from).length();
            self.out.drift = self.out.drift.max(far);
            squares += far * far / all as f32;
            if k == all / 2 {
                ends = [q; 2];
            }
            for (i, q) in q.into_iter().enumerate().filter(|_| k > all / 2) {
                (ends[0][i], ends[1][i]) = (ends[0][i].min(q), ends[1][i].max(q));
                swings[0][i] = swings[0][i].max(q - ends[0][i]);
                swings[1][i] = swings[1][i].max(ends[1][i] - q);
            }
        }
        if all > 0 {
            self.out.status = self.status;
        }
        self.out.rms = self.out.rms.max(libm::sqrtf(squares));
        for (up, down) in swings[0].iter().zip(swings[1]) {
            self.out.reversal = self.out.reversal.max(up.min(down) / RESOLUTION);
        }
        Some(())
    }
}

fn ticks(seconds: f32) -> u32 {
    (seconds / TICK + 0.5) as u32
}

impl Guidance {
    /// A trial with a posture and ways of its own, of a plant that is off and rests for ten
    /// seconds.
    pub fn drawn(seed: u32, less: Less, tool: bool) -> Self {
        let mut random = Random::seeded(seed);
        let posture = posture(&mut random);
        let ways = [direction(&mut random), direction(&mut random)];
        let (plant, seconds) = (PlantModel::Mismatched, [0.5, 2.0, 1.0, 10.0]);
        let holds = if tool { Holds::Tool } else { Holds::Nothing };
        Self { posture, ways, random, holds, plant, less, seconds, again: Some(0.0) }
    }
}

impl Trial<7> for Guidance {
    const NAME: &'static str = "openarm_free_drive";
    const TICK: f32 = TICK;
    /// The largest distance of the tip from the place of the release, m.
    const BOUND: f32 = 2e-3;
    const LIMITS: [JointLimits<f32>; 7] = limits_of(&OpenArm::MODEL, [0, 1, 2, 3, 4, 5, 6]);
    const TERMS: &'static [Term] = &[
        Term { name: || "Gravity", bytes: size_of::<Gravity>() },
        Term { name: || "Payload", bytes: size_of::<Tool>() },
        Term { name: || "friction", bytes: size_of::<Friction>() },
        Term { name: || "LoadFriction", bytes: size_of::<LoadFriction<f32, 7>>() },
        Term { name: || "push", bytes: size_of::<f32>() },
        Term { name: || "dither", bytes: size_of::<f32>() },
        Term { name: || "Breakaway", bytes: size_of::<Breakaway<f32, 7>>() },
    ];

    /// The ticks to the end of the last rest.
    fn ticks(&self) -> u32 {
        let [_, way, after, _] = self.seconds;
        let again = self.again.map(|rest| [way, after, rest]);
        self.seconds.into_iter().chain(again.into_iter().flatten()).map(ticks).sum()
    }
}

impl Batch<7> for Guidance {
    type Outcome = Outcome;
    const BASELINE: Less = ALL_BUT_GRAVITY;
    const OTHER: Option<Other<Self>> = Some(("empty-hand", || Self {
        holds: Holds::Nothing,
        ..Self::of_scene(Less::NOTHING, PlantModel::Exact)
    }));

    /// Of the axes of space, this way is the one whose forces are nearest to the medians of
    /// [`Self::drawn`].
    fn of_scene(less: Less, plant: PlantModel) -> Self {
        Self {
            posture: [0.5, 0.6, 0.2, 1.0, 0.1, -0.2, 0.3],
            ways: [Vec3::Y, Vec3::NEG_Y],
            random: Random::seeded(0),
            holds: Holds::PickedUp,
            plant,
            less,
            seconds: [0.5, 2.0, 0.5, 3.0],
            again: Some(3.0),
        }
    }

    fn run<F: FnMut(&Telemetry<7>, f32)>(&self, see: F) -> Option<Outcome> {
        let (near, [way, back]) = (self.posture, self.ways);
        let plant = Plant::new(near, self.plant, self.random);
        let (law, joints) = (law(self.less)?, joints(&near).ok()?);
        let gains = Gains { kp: [0.0; 7], kd: [0.0; 7] };
        let gate = MotionController::try_new(controller()).ok()?;
        let control = ControlLoop::new(Kept(&joints, &law), &joints, NoBrake, gains, gate, ());
        let (joints, law, replies) = (&joints, &law, [const { None }; 7]);
        let (reference, seconds, out) = (State::at(near), self.seconds, Outcome::default());
        let (follows, status) = (self.less != PAYLOAD, None);
        let mut cell = Cell {
            control,
            joints,
            law,
            reference,
            replies,
            plant,
            seconds,
            follows,
            status,
            out,
            see,
        };
        if self.holds == Holds::Tool {
            cell.close(CLOSING + LATE);
        }
        cell.start(&joints.commands())?;
        for _ in 0..ticks(seconds[0]) {
            cell.tick()?;
        }
        [cell.out.start, cell.out.drag] = cell.lead(way)?;
        cell.rest(seconds[3], self.holds == Holds::PickedUp)?;
        if let Some(again) = self.again {
            [cell.out.again, _] = cell.lead(back)?;
            cell.rest(again, false)?;
        }
        Some(cell.out)
    }

    fn figures(out: &Outcome) -> Figures {
        let &Outcome { rms, drift: max, status, .. } = out;
        Figures { rms, max, start: Some(out.start.max(out.again)), status }
    }

    fn tick_at<F: FnMut(&Telemetry<7>, f32)>(_: &F) -> usize {
        marked_tick::<F> as *const () as usize
    }
}
