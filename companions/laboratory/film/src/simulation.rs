//! The scene `ur5e` in the loop: three times its path, with the feed-forward on, off, and on again.

use dynamics_core::algorithms::Pose;
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use firmware_demo::plant::{Rig, Simulated};
use firmware_demo::scene::{STEPS, Scene, SimLoop, TICK, simulated_loop};
use firmware_demo::scenes::ur5e::{EFFECTS, PickAndPlace};
use firmware_demo::sim_io::Wires;
use glam::DVec3;
use joint_drivers::Law;
use motion_control::reference::{Reference, Trajectory};

/// The parts of the film: whether the feed-forward is on.
pub const PARTS: [bool; 3] = [true, false, true];

/// From the flange to the tip of the tool that is drawn, m; it has no mass.
const TOOL: f64 = 0.12;
/// The places of the links beside the planes of the model's frames, m: the upper arm stands off
/// the shoulder, the forearm hardly.
const UPPER_ARM: f64 = 0.138;
const FOREARM: f64 = 0.02;

/// The scene's feed-forward, if it is on.
struct Switch(bool);

struct Switched;

impl Law<6, Switch> for Switched {
    const ACCELERATES: bool = true;

    fn feedforward(reference: &State<f32, 6, 6>, &Switch(on): &Switch) -> [f32; 6] {
        match on {
            true => Engine::<Ur5e>::rnea(reference, &EFFECTS),
            false => [0.0; 6],
        }
    }
}

/// The path of the scene, again and again.
struct Cycles(Trajectory<f32, 6, 9>);

impl Reference<f32, 6> for Cycles {
    fn at(&self, tick: u32) -> State<f32, 6, 6> {
        self.0.at(tick % self.0.ticks())
    }

    fn ticks(&self) -> u32 {
        self.0.ticks() * PARTS.len() as u32
    }
}

/// The points between which the arm is drawn, from its base to its tip, m.
pub type Skeleton = [DVec3; 10];

/// A tick, as it is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Tick {
    pub reference: Skeleton,
    pub actual: Skeleton,
}

impl Tick {
    /// The distance of the tip from its reference, m.
    pub fn error(&self) -> f64 {
        self.actual[9].distance(self.reference[9])
    }
}

/// The states of the film, one each millisecond.
pub struct Motion {
    pub ticks: Vec<Tick>,
    /// The ticks of each part.
    pub part: usize,
}

/// Runs the loop of the scene on its plant.
pub fn run() -> Motion {
    let way = PickAndPlace::reference().expect("the arm can go there");
    let wires: &'static Wires<6> = Box::leak(Box::default());
    let full_scale = PickAndPlace::LIMITS.map(|limit| limit.torque);
    let mut rig = Rig::new(PickAndPlace::plant(None), full_scale, wires);
    let mut control: SimLoop<6> =
        simulated_loop::<PickAndPlace, (), 6, 6, 6, 6>(&way, wires, ()).expect("torque limits");
    let part = way.ticks() as usize;
    let cycles = Cycles(way);
    let switches = PARTS.into_iter().flat_map(|on| std::iter::repeat_n(on, part));
    let ticks = switches.map(|on| {
        let told = control.tick_probed::<Switched, _, _>(&cycles, &Switch(on), &mut ());
        assert!(told.status.fault.is_none(), "{:?}", told.status);
        let tick =
            Tick { reference: skeleton(&told.reference), actual: skeleton(&rig.plant.actual()) };
        let moved = rig.advance(wires, STEPS, TICK / STEPS as f32, |_| ());
        moved.expect("the arm has forward dynamics");
        tick
    });
    Motion { ticks: ticks.collect(), part }
}

fn skeleton(q: &[f32; 6]) -> Skeleton {
    let poses: [Pose<f64>; 6] = Core::<Ur5e>::poses(&q.map(f64::from));
    let [_, upper_arm, forearm, wrist_1, wrist_2, wrist_3] = poses;
    let side = upper_arm.rot.z_axis;
    let wrist = wrist_1.pos - side * (wrist_1.pos - forearm.pos).dot(side);
    [
        DVec3::ZERO,
        upper_arm.pos,
        upper_arm.pos + UPPER_ARM * side,
        forearm.pos + UPPER_ARM * side,
        forearm.pos + FOREARM * side,
        wrist + FOREARM * side,
        wrist_1.pos,
        wrist_2.pos,
        wrist_3.pos,
        wrist_3.pos + TOOL * wrist_3.rot.z_axis,
    ]
}
