//! An arm of two joints, its descriptions, and recordings of it as `cargo xtask watch` writes them.

use std::fmt::Write as _;
use std::path::Path;

use dynamics_core::algorithms::rnea;
use dynamics_core::effects::{Coulomb, RIGID_BODY, Viscous, Width};
use dynamics_core::state::State;
use identification::files::error::Result;
use identification::files::recorded::Recorded;
use identification::files::report::Findings;
use identification::files::robot::Robot;
use identification::files::run::{self, JointEffect, Options};
use robot_import::import::Options as Selection;

pub type At = State<f64, 2, 2>;

pub const TICK: f64 = 2e-3;
pub const OPTIONS: fn() -> Options = || Options {
    effects: vec![
        JointEffect::Viscous,
        JointEffect::Coulomb,
        JointEffect::Armature,
        JointEffect::Offset,
    ],
    width: 0.02,
    cutoff: None,
    hold_out: 0.3,
};
/// A count of an encoder, rad.
const COUNT: f64 = std::f64::consts::TAU / 16384.0;
/// Noise of the measured torque, relative to the largest torques, N·m.
const NOISE: [f64; 2] = [0.1, 0.03];

pub fn described() -> Robot {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/two_links.urdf");
    Robot::read(Path::new(file), None, &Selection::default()).expect("a robot")
}

/// The description with numbers that are off by 30 %.
pub fn off() -> Robot {
    let mut robot = described();
    let mut factors = [0.7, 1.3, 1.3, 0.7, 1.3, 0.7].into_iter().cycle();
    for body in &mut robot.imported.tree.bodies {
        let mut factor = || factors.next().expect("endless");
        body.inertia.mass *= factor();
        body.inertia.com = body.inertia.com.map(|c| c * factor());
        let inertia = factor();
        body.inertia.inertia = body.inertia.inertia.map(|x| x * inertia);
        body.damping *= factor();
        body.friction *= factor();
    }
    robot
}

/// The torques of a robot at a state.
pub fn torques(robot: &Robot, at: &At) -> [f64; 2] {
    let (arm, ..) = robot.model::<2>(robot.gravity).expect("an arm");
    let of = |of: fn(&robot_import::tree::Body) -> f64| {
        std::array::from_fn(|j| of(&robot.imported.tree.bodies[j]))
    };
    let coulomb = Coulomb { torque: of(|body| body.friction), width: Width::new(0.02) };
    let armature = dynamics_core::effects::Armature(of(|body| body.armature));
    let viscous = Viscous(of(|body| body.damping));
    rnea(&arm, at, &(RIGID_BODY, viscous, coulomb, armature))
}

/// A motion of two frequencies of each joint without a common period; a joint with the size 0
/// rests.
pub fn swing(t: f64, size: [f64; 2], rates: [f64; 2]) -> At {
    let mut at = State::at([0.2, -0.3]);
    for j in 0..2 {
        for (share, rate) in [(0.6, rates[j]), (0.4, 2.3 * rates[j])] {
            let ((sin, cos), size) = ((rate * t).sin_cos(), share * size[j]);
            at.q[j] += size * sin;
            at.qd[j] += size * rate * cos;
            at.qdd[j] -= size * rate * rate * sin;
        }
    }
    at
}

/// The record of a motion of the described arm: positions in counts, torques with noise, of the
/// middle of each tick.
pub fn record(motion: impl Fn(f64) -> At, ticks: u32) -> String {
    record_late(motion, ticks, 0.0)
}

/// The record of torques that come so much later than their positions, s.
pub fn record_late(motion: impl Fn(f64) -> At, ticks: u32, late: f64) -> String {
    let robot = described();
    record_with(motion, ticks, late, |at| torques(&robot, at))
}

/// The record of an arm that has these torques along its motion.
pub fn record_with(
    motion: impl Fn(f64) -> At,
    ticks: u32,
    late: f64,
    mut torques: impl FnMut(&At) -> [f64; 2],
) -> String {
    let mut rng = fastrand::Rng::with_seed(7);
    let mut text = String::from(
        "number,tick,mode,fault,limited,dropped,time_s,reference_0,estimate_0,torque_0,reference_1,estimate_1,torque_1,read_counts\n",
    );
    for k in 0..ticks {
        let t = TICK * f64::from(k);
        let (q, tau) = (motion(t).q, torques(&motion(t + 0.5 * TICK - late)));
        let _ = write!(text, "{k},{k},full,,false,0,{t:.6}");
        for j in 0..2 {
            let estimate = (q[j] / COUNT).round() * COUNT;
            let torque = tau[j] + NOISE[j] * (2.0 * rng.f64() - 1.0);
            let _ = write!(text, ",{},{estimate},{torque}", q[j]);
        }
        text += ",0\n";
    }
    text
}

pub fn read(text: &str) -> Result<Recorded> {
    Recorded::from(Path::new("run.csv"), text.as_bytes(), &described().joints(), None)
}

/// The report about the arm whose description is off.
pub fn identified(text: &str) -> Result<Findings> {
    let recorded = read(text)?;
    run::identify(&off(), (Path::new("run.csv"), &recorded), None, &OPTIONS())
}
