//! Claims about the scene `openarm_free_drive`: an OpenArm with gears that stick is led by a hand,
//! over simulated frames, is let go, and stays.

mod plant;

use dynamics_core::state::State;
use firmware_demo::scenes::openarm_free_drive::{
    Free, FreeDrive, Joints, Kept, NO_TOOL, RESOLUTION, TICK, TOOL, breakaway, controller, guiding, joints,
    limits,
};
use dynamics_core::effects::Gravity;
use glam::DVec3;
use host_tests::everyday_or_full;
use joint_drivers::{ControlLoop, NoBrake};
use motion_control::{Gains, Mode, MotionController};
use plant::{Plant, Q, Random};

const RUNS: u32 = everyday_or_full(12, 1000);
/// Of the table, for each row.
const TABLE: u32 = everyday_or_full(4, 100);
/// The hand, N/m and N·s/m.
const SPRING: [f64; 2] = [2000.0, 50.0];
/// Its way, m, and the seconds before it, of it, after it, and of the release.
const WAY: f64 = 0.06;
const TIMES: [f64; 4] = [0.5, 2.0, 0.3, 10.0];

/// What the law lacks.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Less {
    Nothing,
    /// All but gravity (and the tool).
    AllButGravity,
    Gravity,
    Tool,
    Friction,
    Push,
    Dither,
    Gears,
}

#[derive(Clone, Copy, Debug, Default)]
struct Outcome {
    /// The greatest force of the hand until the grip has moved by 5 mm, N; and after the rest.
    start: f64,
    again: f64,
    /// The greatest distance of the grip from the place of the release, m.
    drift: f64,
    /// The most by which a joint has gone back and forth in the last 5 s, steps of its encoder.
    reversal: f64,
    /// The most of work less friction's part that a joint has got, as a share of its energy.
    spent: f64,
    /// As the law has it itself.
    own: f64,
    /// Ticks in which the controller was not in full operation, or limited a torque.
    held: u32,
    limited: u32,
    /// A joint is in its wall at the release.
    walled: bool,
}

fn law(less: Less, tool: bool) -> FreeDrive {
    let (mut guiding, mut breakaway) = (guiding().expect("good"), breakaway());
    if matches!(less, Less::Friction | Less::AllButGravity) {
        guiding.share = 0.0;
    }
    if less == Less::AllButGravity {
        guiding.damping = [0.0; 7];
    }
    if matches!(less, Less::Push | Less::AllButGravity) {
        breakaway.push = 0.0;
    }
    if matches!(less, Less::Dither | Less::AllButGravity) {
        breakaway.dither = 0.0;
    }
    let mut law = FreeDrive::new(guiding, breakaway).expect("good");
    law.tool = if tool && less != Less::Tool { TOOL } else { NO_TOOL };
    if less == Less::Gravity {
        law.gravity = Gravity::new(0.0);
    }
    if less == Less::Gears {
        (law.friction.2.driving, law.friction.2.backdriving) = ([0.0; 7], [0.0; 7]);
    }
    law
}

/// Half a joint's range about its middle, so that the way ends before the walls.
fn posture(random: &mut Random) -> Q {
    let limits = limits();
    core::array::from_fn(|i| {
        let [lower, upper] = [limits.lower[i], limits.upper[i]].map(f64::from);
        lower + (upper - lower) * random.within(0.25, 0.75)
    })
}

fn direction(random: &mut Random) -> DVec3 {
    loop {
        let way = DVec3::from_array([(); 3].map(|()| random.within(-1.0, 1.0)));
        if (0.1..1.0).contains(&way.length_squared()) {
            return way.normalize();
        }
    }
}

/// The arm in its loop.
struct Cell<'a> {
    control: ControlLoop<Kept<'a, &'a Joints>, &'a Joints, NoBrake, 7>,
    joints: &'a Joints,
    law: &'a FreeDrive,
    reference: State<f32, 7, 7>,
    plant: Plant,
    out: Outcome,
}

impl Cell<'_> {
    fn tick(&mut self) {
        let Self { control, joints, law, plant, out, .. } = self;
        let status = control.tick::<Free, _, _>(&self.reference, *law).status;
        if let Some(fault) = status.fault.filter(|_| status.mode != Mode::Full && out.held == 0) { println!("{fault:?} {status:?} {:?} {:?} {:?}", control.encoder_error(), control.drive_error(), plant.at); }
        out.held += u32::from(status.mode != Mode::Full);
        out.limited += u32::from(status.limited);
        for reply in plant.tick(&joints.commands(), &law.added.get().map(f64::from)) {
            joints.receive(&reply);
        }
        let (own, budget) = (law.breakaway.borrow().energy(), breakaway());
        for (i, energy) in budget.energy.map(f64::from).into_iter().enumerate() {
            let passive = f64::from((1.0 - budget.share) * budget.friction[i]);
            let spent = plant.account.work[i] - passive * plant.account.path[i];
            out.spent = out.spent.max(spent / energy);
            out.own = out.own.max(1.0 - f64::from(own[i]) / energy);
        }
    }

    /// The hand leads the grip along a way of least jerk. Returns its greatest force until the grip
    /// has moved by 5 mm, N.
    fn lead(&mut self, way: DVec3) -> f64 {
        let [from, _] = self.plant.grip();
        let (mut start, mut moved) = (0.0_f64, false);
        (self.plant.scene.7.goal, self.plant.scene.7.spring) = (from, SPRING);
        let all = ticks(TIMES[1]);
        for k in 0..all + ticks(TIMES[2]) {
            let s = (f64::from(k) + 0.5) / f64::from(all);
            let speed = if k < all { 30.0 * (s * (1.0 - s)).powi(2) } else { 0.0 };
            self.plant.scene.7.velocity = WAY / TIMES[1] * speed * way;
            self.tick();
            if std::env::var("TRACE").is_ok() && k % 10 == 0 { println!("{k} {:.2} N moved {:.3} goal {:.3} q {:.3?} z {:.2?}", self.plant.force(), 1e3*(self.plant.grip()[0] - from).length(), 1e3*(self.plant.scene.7.goal-from).length(), self.plant.at.q, core::array::from_fn::<f64,7,_>(|i| self.plant.scene.5.bristle[i]*self.plant.scene.5.stiffness[i])); }
            moved |= (self.plant.grip()[0] - from).length() > 5e-3;
            start = if moved { start } else { start.max(self.plant.force()) };
        }
        self.plant.scene.7.spring = [0.0; 2];
        start
    }

    fn rest(&mut self) {
        let ([from, _], all) = (self.plant.grip(), ticks(TIMES[3]));
        let mut ends = [self.plant.at.q; 2];
        let mut swings = [[0.0_f64; 7]; 2];
        for k in 0..all {
            self.tick();
            let (grip, q) = (self.plant.grip()[0], self.plant.at.q);
            self.out.drift = self.out.drift.max((grip - from).length());
            if k == all / 2 {
                ends = [q; 2];
            }
            for i in (0..7).filter(|_| k > all / 2) {
                (ends[0][i], ends[1][i]) = (ends[0][i].min(q[i]), ends[1][i].max(q[i]));
                swings[0][i] = swings[0][i].max(q[i] - ends[0][i]);
                swings[1][i] = swings[1][i].max(ends[1][i] - q[i]);
            }
        }
        for i in 0..7 {
            let back = swings[0][i].min(swings[1][i]) / f64::from(RESOLUTION);
            self.out.reversal = self.out.reversal.max(back);
        }
    }
}

fn ticks(seconds: f64) -> u32 {
    (seconds / f64::from(TICK)).round() as u32
}

fn run(seed: u32, less: Less, tool: bool) -> Outcome {
    let mut random = Random::seeded(seed);
    let (q, way, back) = (posture(&mut random), direction(&mut random), direction(&mut random));
    let plant = Plant::new(q, if tool { 1.0 } else { 0.0 }, random);
    let (law, near) = (law(less, tool), q.map(|q| q as f32));
    let joints = joints(&near).expect("good");
    let gains = Gains { kp: [0.0; 7], kd: [0.0; 7] };
    let gate = MotionController::try_new(controller()).expect("good");
    let control = ControlLoop::new(Kept(&joints, &law), &joints, NoBrake, gains, gate, ());
    let (joints, law, out) = (&joints, &law, Outcome::default());
    let mut cell = Cell { control, joints, law, reference: State::at(near), plant, out };
    // The first replies, to zero torque: friction holds the arm for a tick.
    for reply in cell.plant.tick(&joints.commands(), &[0.0; 7]) {
        joints.receive(&reply);
    }
    (0..ticks(TIMES[0])).for_each(|k| { cell.tick(); if std::env::var("TRACE").is_ok() && k % 10 == 0 { println!("pre {k} q {:.4?} qd {:.4?} added {:.2?}", cell.plant.at.q, cell.plant.at.qd, cell.law.added.get()); } });
    cell.out.start = cell.lead(way);
    let walls = guiding().expect("good");
    cell.out.walled = (0..7).any(|i| {
        let range = f64::from(walls.lower[i])..f64::from(walls.upper[i]);
        !range.contains(&cell.plant.at.q[i])
    });
    cell.rest();
    cell.out.again = cell.lead(back);
    cell.out
}

fn median(mut of: Vec<f64>) -> f64 {
    of.sort_by(f64::total_cmp);
    of[of.len() / 2]
}

fn most(of: impl Iterator<Item = f64>) -> f64 {
    of.fold(0.0, f64::max)
}

#[test]
fn explore() {
    for tool in [false, true] {
        for seed in std::env::var("SEED").map_or(0..RUNS, |s| { let s: u32 = s.parse().unwrap(); s..s+1 }) {
            let [all, alone] = [Less::Nothing, Less::AllButGravity].map(|less| run(seed, less, tool));
            println!(
                "{seed} {tool}: start {:.2}/{:.2} N = {:.2}, again {:.2}/{:.2}, drift {:.3}/{:.3} mm, reversal {:.3}, spent {:.3} own {:.3} held {} limited {} walled {}",
                all.start, alone.start, all.start / alone.start, all.again, alone.again,
                1e3 * all.drift, 1e3 * alone.drift, all.reversal, all.spent, all.own, all.held,
                all.limited, all.walled
            );
        }
    }
}
