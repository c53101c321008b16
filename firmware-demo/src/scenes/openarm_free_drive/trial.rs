//! A trial: a hand leads the arm, over the frames of its bus, lets it go, and it rests. It may pick
//! a tool up then, be led once more, and rest again.

use core::marker::PhantomData;

use dynamics_core::effects::{Gravity, LoadFriction};
use dynamics_core::state::State;
use glam::Vec3;
use joint_drivers::can::ClassicFrame;
use joint_drivers::{ControlLoop, NoBrake, Phase, Probe, Telemetry};
use motion_control::{Breakaway, Gains, Mode, MotionController, Status};

use super::plant::{Plant, Q, Random, Replies};
use super::{
    Free, FreeDrive, Friction, Joints, Kept, RESOLUTION, TICK, TOOL, Tool, borne, breakaway,
    controller, guiding, joints, limits,
};
use crate::marker;
use crate::region::{Marked, READ, TICK as WHOLE};
use crate::scene::PlantModel;

/// The hand, N/m and N·s/m.
const SPRING: [f32; 2] = [2000.0, 50.0];
/// Its way, m.
const WAY: f32 = 0.04;
/// The largest distance of the tip from the place of the release in the scene, m.
pub const BOUND: f32 = 2e-3;
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

/// The part that the law lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Less {
    Nothing,
    /// All but gravity (and the tool).
    AllButGravity,
    Gravity,
    Tool,
    Friction,
    Gears,
    Push,
    Dither,
    /// Push and dither.
    Breakaway,
}

impl Less {
    /// The single parts, each with its name and the bytes of its value.
    pub const PARTS: [(Self, &str, usize); 7] = [
        (Self::Gravity, "Gravity", size_of::<Gravity>()),
        (Self::Tool, "Payload", size_of::<Tool>()),
        (Self::Friction, "friction", size_of::<Friction>()),
        (Self::Gears, "LoadFriction", size_of::<LoadFriction<f32, 7>>()),
        (Self::Push, "push", size_of::<f32>()),
        (Self::Dither, "dither", size_of::<f32>()),
        (Self::Breakaway, "Breakaway", size_of::<Breakaway<f32, 7>>()),
    ];
}

/// A trial.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
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
    if matches!(less, Less::Friction | Less::AllButGravity) {
        guiding.share = 0.0;
    }
    if less == Less::AllButGravity {
        guiding.damping = [0.0; 7];
    }
    if matches!(less, Less::Push | Less::Breakaway | Less::AllButGravity) {
        breakaway.push = 0.0;
    }
    if matches!(less, Less::Dither | Less::Breakaway | Less::AllButGravity) {
        breakaway.dither = 0.0;
    }
    let mut law = FreeDrive::new(guiding, breakaway).ok()?;
    if less == Less::Gravity {
        law.gravity = Gravity::new(0.0);
    }
    if less == Less::Gears {
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
struct Unpacked<'s>(Seen<'s>);

impl Probe<7> for Unpacked<'_> {
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
        self.0.record(telemetry);
    }
}

type Loop<'a> = ControlLoop<Kept<'a, &'a Joints>, &'a Joints, NoBrake, 7>;

/// A tick from the frames that came to those that are sent, between the markers of its regions.
#[inline(never)]
fn marked_tick(
    control: &mut Loop<'_>,
    joints: &Joints,
    law: &FreeDrive,
    reference: &State<f32, 7, 7>,
    came: &Replies<ClassicFrame>,
    seen: Seen<'_>,
) -> (Replies<ClassicFrame>, Status) {
    marker::start::<WHOLE>();
    marker::start::<READ>();
    came.iter().flatten().for_each(|frame| joints.receive(frame));
    let status = control.tick_probed::<Free, _, _>(reference, law, &mut Unpacked(seen)).status;
    let commands = joints.commands();
    marker::stop::<WHOLE>();
    (commands, status)
}

/// The address of the function that is called each tick.
pub fn tick_at() -> usize {
    marked_tick as *const () as usize
}

/// Who sees the record of each tick: nobody where the program sends no telemetry.
#[derive(Default)]
pub struct Seen<'a>(
    #[cfg(feature = "telemetry")] Option<&'a mut dyn FnMut(&Telemetry<7>)>,
    PhantomData<&'a ()>,
);

impl<'a> Seen<'a> {
    /// By a function.
    #[cfg(feature = "telemetry")]
    pub fn by(function: &'a mut dyn FnMut(&Telemetry<7>)) -> Self {
        Self(Some(function), PhantomData)
    }

    #[inline(always)]
    fn again(&mut self) -> Seen<'_> {
        Seen(
            #[cfg(feature = "telemetry")]
            self.0.as_mut().map(|seen| &mut **seen as _),
            PhantomData,
        )
    }

    #[inline(always)]
    #[cfg_attr(not(feature = "telemetry"), expect(unused_variables, reason = "nobody sees it"))]
    fn record(&mut self, telemetry: &Telemetry<7>) {
        #[cfg(feature = "telemetry")]
        if let Some(seen) = &mut self.0 {
            seen(telemetry);
        }
    }
}

/// The arm in its loop.
struct Cell<'a, 's> {
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
    seen: Seen<'s>,
}

impl Cell<'_, '_> {
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
            control, joints, law, reference, replies, plant, status: last, out, seen, ..
        } = self;
        let (commands, status) =
            marked_tick(control, joints, law, reference, replies, seen.again());
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

impl Trial {
    /// The trial of the scene under a law that lacks a part. Of the axes of space, this way is the
    /// one whose forces are nearest to the medians of [`Trial::drawn`].
    pub fn of_scene(less: Less, plant: PlantModel, holds: Holds) -> Self {
        Self {
            posture: [0.5, 0.6, 0.2, 1.0, 0.1, -0.2, 0.3],
            ways: [Vec3::Y, Vec3::NEG_Y],
            random: Random::seeded(0),
            holds,
            plant,
            less,
            seconds: [0.5, 2.0, 0.5, 3.0],
            again: Some(3.0),
        }
    }

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

    /// The ticks to the end of the last rest.
    pub fn ticks(&self) -> u32 {
        let [_, way, after, _] = self.seconds;
        let again = self.again.map(|rest| [way, after, rest]);
        self.seconds.into_iter().chain(again.into_iter().flatten()).map(ticks).sum()
    }

    /// Runs it; nothing if there were no such law, or if the arm had no forward dynamics.
    pub fn run(&self, seen: Seen<'_>) -> Option<Outcome> {
        let (near, [way, back]) = (self.posture, self.ways);
        let plant = Plant::new(near, self.plant, self.random);
        let (law, joints) = (law(self.less)?, joints(&near).ok()?);
        let gains = Gains { kp: [0.0; 7], kd: [0.0; 7] };
        let gate = MotionController::try_new(controller()).ok()?;
        let control = ControlLoop::new(Kept(&joints, &law), &joints, NoBrake, gains, gate, ());
        let (joints, law, replies) = (&joints, &law, [const { None }; 7]);
        let (reference, seconds, out) = (State::at(near), self.seconds, Outcome::default());
        let (follows, status) = (self.less != Less::Tool, None);
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
            seen,
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
}
