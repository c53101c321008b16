//! Prints what an SO-101 that floats should command, as JSON, for the tests of the plug-in for
//! LeRobot: the torques of the scene `so101_teach` and of hand guiding, at positions that its
//! encoders can measure.
//!
//! The plug-in computes the same through Python, and its tests decode what it sends to the servos.
//! Nothing here passes through Python: observer, law and dynamics are those of the firmware, in
//! f32.

use dynamics_core::Engine;
use dynamics_core::effects::{Coulomb, Gravity, Viscous};
use dynamics_core::robots::So101;
use dynamics_core::state::State;
use firmware_demo::scene::Scene;
use firmware_demo::scenes::so101_teach::{
    BACK_EMF, COMPENSATION, COULOMB, Compensation, RESOLUTION, STALL, SUPPLY, TaughtPath, VISCOUS,
    with_back_emf,
};
use motion_control::estimate::{Estimate, Observer, ObserverConfig};
use motion_control::law::{HandGuiding, HandGuidingConfig, LimitedSpring, SpeedBrake};
use serde_json::{Value, json};

/// The ticks of the plug-in, s.
const TICK: f32 = 5e-3;
/// Bandwidth of its observer, rad/s.
const BANDWIDTH: f32 = 30.0;
/// The path is taught slower than it is driven, by this factor.
const SLOWER: f32 = 2.0;
/// Reduction of the scene's servos, and those of a leader's joints (LeRobot's page on the SO-101).
const SCENE_GEAR: f32 = 345.0;
const LEADER_GEARS: [f32; 6] = [191.0, 345.0, 191.0, 147.0, 147.0, 147.0];
/// Hand guiding, as the plug-in is configured by default.
const ERROR: f32 = 0.1;
const SHARE: f32 = 0.87;
const REST_SPEED: f32 = 0.03;
const GRAVITY_ERROR: f32 = 0.03;
const MOST: f32 = 0.5;

/// Postures within the joints' limits, rad: those of the scene's path, and others in which the arm
/// is stretched.
const POSTURES: [[f32; 6]; 10] = [
    [0.0, -1.2, 1.2, 0.8, 0.0, 0.2],
    [-0.6, 0.3, 0.3, 0.8, 0.4, 1.2],
    [0.8, 0.3, 0.2, 0.8, -0.5, 0.9],
    [0.0, 1.3, -1.2, 0.0, 0.0, 0.0],
    [1.0, 0.6, -0.9, -0.5, 1.0, 0.5],
    [-1.2, 0.9, -0.6, 0.3, -1.5, 1.0],
    [0.4, -0.8, 0.9, 1.2, 0.7, 0.1],
    [0.2, 1.0, -1.4, 0.9, 2.0, 1.5],
    [-0.9, -0.5, 1.3, -0.7, -2.0, 0.8],
    [1.5, 0.1, 0.7, -1.1, 0.3, 0.4],
];

/// Friction of servos of other gears: what the motor turns with grows with the reduction, what
/// depends on its speed with the square. The gears' own share of the load stays.
fn geared(ratio: [f32; 6]) -> Compensation {
    let coulomb = Coulomb { torque: ratio.map(|r| COULOMB * r), ..COMPENSATION.2 };
    let viscous = Viscous(ratio.map(|r| VISCOUS * r * r));
    (Gravity::EARTH, viscous, coulomb, COMPENSATION.3)
}

/// Hand guiding without walls and locks.
fn guiding() -> HandGuiding<f32, 6> {
    let none = LimitedSpring { stiffness: [0.0; 6], damping: [0.0; 6], torque: [0.0; 6] };
    let config = HandGuidingConfig {
        error: ERROR,
        share: SHARE,
        rest_speed: [REST_SPEED; 6],
        compensation: [MOST; 6],
        damping: [0.0; 6],
        brake: SpeedBrake { speed: [f32::INFINITY; 6], damping: [0.0; 6], torque: [0.0; 6] },
        lower: [f32::NEG_INFINITY; 6],
        upper: [f32::INFINITY; 6],
        wall: none,
        lock: none,
    };
    HandGuiding::try_new(config).expect("a passive share")
}

/// The commands of the servos at this estimate, in N·m at rest: of the scene, and of a
/// leader that is guided.
fn commands(estimate: &Estimate<f32, 6>) -> Value {
    let at = State { q: estimate.q, qd: estimate.qd, qdd: [0.0; 6] };
    let scene = with_back_emf(Engine::<So101>::rnea(&at, &COMPENSATION), &at.qd);
    let ratio = LEADER_GEARS.map(|gear| gear / SCENE_GEAR);
    let gravity = Engine::<So101>::rnea(&at, &Gravity::EARTH);
    let all = Engine::<So101>::rnea(&at, &geared(ratio));
    let friction = core::array::from_fn(|j| all[j] - gravity[j]);
    let errors = gravity.map(|torque| GRAVITY_ERROR * torque);
    let guide = guiding().torque(estimate, &friction, &errors);
    let leader: [f32; 6] =
        core::array::from_fn(|j| gravity[j] + guide[j] + BACK_EMF * ratio[j] * ratio[j] * at.qd[j]);
    json!({ "q": at.q, "qd": at.qd, "gravity": gravity, "scene": scene, "leader": leader })
}

/// Positions in steps of the encoders.
fn counts(q: &[f32; 6]) -> [i32; 6] {
    q.map(|q| (q / RESOLUTION).round() as i32)
}

fn measured(counts: &[i32; 6]) -> [f32; 6] {
    counts.map(|count| count as f32 * RESOLUTION)
}

fn at_rest(posture: &[f32; 6]) -> Value {
    let counts = counts(posture);
    let estimate = Estimate { q: measured(&counts), qd: [0.0; 6] };
    json!({ "counts": counts, "commands": commands(&estimate) })
}

/// The scene's path at a hand's pace, as the plug-in's observer sees it.
fn along_the_path() -> Vec<Value> {
    let reference = TaughtPath::reference().expect("within the limits");
    let mut observer = Observer::<f32, 6>::new(ObserverConfig { bandwidth: BANDWIDTH, tick: TICK });
    let ticks = (reference.ticks() as f32 * SLOWER * TaughtPath::TICK / TICK) as u32;
    let row = |tick: u32| {
        let position = tick as f32 * TICK / (SLOWER * TaughtPath::TICK);
        let [from, to] = [0, 1].map(|next| reference.at(position as u32 + next).q);
        let share = position.fract();
        let counts = counts(&core::array::from_fn(|j| from[j] + share * (to[j] - from[j])));
        let estimate = observer.update(&measured(&counts), &[0.0; 6]);
        json!({ "counts": counts, "commands": commands(&estimate) })
    };
    (0..ticks).map(row).collect()
}

fn main() -> serde_json::Result<()> {
    let scene = [STALL; 6];
    let leader = LEADER_GEARS.map(|gear| STALL * gear / SCENE_GEAR);
    let record = json!({
        "tick": TICK,
        "bandwidth": BANDWIDTH,
        "supply": SUPPLY,
        "stall": { "scene": scene, "leader": leader },
        "angles": POSTURES,
        "postures": POSTURES.iter().map(at_rest).collect::<Vec<_>>(),
        "path": along_the_path(),
    });
    println!("{}", serde_json::to_string(&record)?);
    Ok(())
}
