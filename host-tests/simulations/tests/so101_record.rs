//! A record of the arm that learns, as `cargo xtask watch` writes it, gives `cargo xtask identify`
//! its parameters.

use std::fmt::Write as _;
use std::path::Path;

use dynamics_core::Core;
use dynamics_core::algorithms::rnea;
use dynamics_core::effects::{Armature, Coulomb, LoadFriction, RIGID_BODY, Viscous, Width};
use dynamics_core::robots::So101;
use dynamics_core::state::State;
use firmware_demo::scene::Scene;
use firmware_demo::scenes::so101_teach::TaughtPath;
use identification::files::recorded::Recorded;
use identification::files::report::Findings;
use identification::files::robot::Robot;
use identification::files::run::{self, JointEffect, Options};
use robot_import::import::Options as Selection;
use robot_import::inertia::MassProperties;
use robot_import::model;

use crate::common::Rng;
use crate::parameter_estimator::arm::{LEARNED, NOISE, TICK, friction, nominal, normal, observed};

/// Half a minute of learning: what the observer estimates, and the measured torques.
fn record() -> String {
    let mut text = String::from("number,tick,mode,time_s");
    (0..6).for_each(|j| text += &format!(",estimate_{j},torque_{j}"));
    let (mut rng, mut tick) = (Rng::new(2), 0);
    observed(&nominal(1), LEARNED, 0..0, |estimate, torques| {
        let _ = write!(text, "\n{tick},{tick},full,{:.6}", TICK * f64::from(tick));
        for (q, torque) in estimate.q.iter().zip(torques) {
            let _ = write!(text, ",{q},{}", torque + NOISE * normal(&mut rng));
        }
        tick += 1;
    });
    text + "\n"
}

/// The description of the arm with each number of its bodies 30 % more or less, and without
/// friction.
fn described() -> Robot {
    let file =
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../tools/robot-import/tests/urdf/so101.urdf");
    let mut robot = Robot::read(Path::new(file), None, &Selection::default()).expect("a robot");
    let mut factors = [0.7, 1.3, 1.3, 0.7, 1.3, 0.7, 0.7].into_iter().cycle();
    for body in &mut robot.imported.tree.bodies {
        let mut factor = || factors.next().expect("endless");
        body.inertia.mass *= factor();
        body.inertia.com = body.inertia.com.map(|c| c * factor());
        let inertia = factor();
        body.inertia.inertia = body.inertia.inertia.map(|x| x * inertia);
    }
    robot
}

/// The torques of the description with what was found, as it is pasted.
fn torques(robot: &Robot, found: &Findings, at: &State<f64, 6, 6>) -> [f64; 6] {
    let mut tree = robot.imported.tree.clone();
    for (body, own) in tree.bodies.iter_mut().zip(&found.bodies) {
        body.inertia =
            MassProperties { mass: own.after.mass, com: own.after.com, inertia: own.after.inertia };
    }
    let arm = model::arm::<6>(&tree).expect("an arm");
    let of = |k: usize| std::array::from_fn(|j: usize| found.joints[j].after[k]);
    let gears = |k: usize| {
        std::array::from_fn(|j: usize| found.joints[j].gear.map_or(0.0, |gear| gear.friction[k]))
    };
    let width = Width::new(found.width);
    let (viscous, armature) = (Viscous(of(0)), Armature(of(2)));
    let coulomb = Coulomb { torque: of(1), width };
    let gears = LoadFriction { driving: gears(0), backdriving: gears(1), width };
    rnea(&arm, at, &(RIGID_BODY, viscous, coulomb, armature, gears))
}

/// The errors on the path that is taught: of each joint, the root mean square and the largest, of
/// the largest torque.
fn errors(robot: &Robot, found: &Findings) -> [[f64; 2]; 6] {
    let path = TaughtPath::reference().expect("a path");
    let (mut errors, mut largest, mut count) = ([[0.0_f64; 2]; 6], [0.0_f64; 6], 0.0);
    for tick in (0..path.ticks()).step_by(9) {
        let State { q, qd, qdd } = path.at(tick);
        let at = State { q: q.map(f64::from), qd: qd.map(f64::from), qdd: qdd.map(f64::from) };
        let truth = Core::<So101>::rnea(&at, &(RIGID_BODY, friction()));
        for (j, found) in torques(robot, found, &at).into_iter().enumerate() {
            let error = (found - truth[j]).abs();
            errors[j] = [errors[j][0] + error * error, errors[j][1].max(error)];
            largest[j] = largest[j].max(truth[j].abs());
        }
        count += 1.0;
    }
    std::array::from_fn(|j| [(errors[j][0] / count).sqrt() / largest[j], errors[j][1] / largest[j]])
}

#[test]
fn a_record_of_the_scene_gives_torques_within_five_per_cent() {
    let path = Path::new("so101_learn.csv");
    let options = Options {
        effects: vec![
            JointEffect::Viscous,
            JointEffect::Coulomb,
            JointEffect::Armature,
            JointEffect::Load,
        ],
        width: 0.05,
        cutoff: None,
        hold_out: 0.3,
    };
    let robot = described();
    let recorded = Recorded::from(path, record().as_bytes(), &robot.joints(), None).expect("ticks");
    let found = run::identify(&robot, (path, &recorded), None, &options).expect("parameters");
    // The half tick of a torque that is held for a tick: no delay beside it, and no mistake.
    assert!((found.delay - 1e-3).abs() < 1e-9 && found.mistake.is_none(), "{}", found.delay);
    for [rms, largest] in errors(&robot, &found) {
        assert!(rms < 0.02 && largest < 0.05, "{rms} {largest}");
    }
}
