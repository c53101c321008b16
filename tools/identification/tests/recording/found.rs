//! The findings, and the words for them.

use std::path::Path;

use identification::files::error::Error;
use identification::files::report::Findings;
use identification::files::robot::Robot;
use identification::files::{paste, picture, run};
use robot_import::inertia::MassProperties;

use crate::arm::*;

const SIZE: [f64; 2] = [0.9, 1.1];
const RATES: [f64; 2] = [1.7, 2.6];

/// The description with what was found, as it is pasted.
fn pasted(found: &Findings) -> Robot {
    let mut robot = off();
    let bodies = &mut robot.imported.tree.bodies;
    for ((body, own), joint) in bodies.iter_mut().zip(&found.bodies).zip(&found.joints) {
        body.inertia =
            MassProperties { mass: own.after.mass, com: own.after.com, inertia: own.after.inertia };
        [body.damping, body.friction, body.armature, ..] = joint.after;
    }
    robot
}

/// The largest error of the torques on another path, of the largest torque of each joint.
fn error(robot: &Robot) -> f64 {
    let truth = described();
    let path = (0..500).map(|k| swing(0.01 * f64::from(k), [0.5, -0.8], [3.1, 1.3]));
    let (mut errors, mut largest) = ([0.0_f64; 2], [0.0_f64; 2]);
    for at in path {
        let pairs = torques(robot, &at).into_iter().zip(torques(&truth, &at));
        for (j, (found, truth)) in pairs.enumerate() {
            errors[j] = errors[j].max((found - truth).abs());
            largest[j] = largest[j].max(truth.abs());
        }
    }
    (errors[0] / largest[0]).max(errors[1] / largest[1])
}

#[test]
fn torques_of_another_path_are_within_five_per_cent() {
    let found = identified(&record(|t| swing(t, SIZE, RATES), 10_000)).expect("parameters");
    let (before, after) = (error(&off()), error(&pasted(&found)));
    assert!(before > 0.15 && after < 0.05, "{before} {after}");
    assert!(found.undetermined().is_empty(), "{:?}", found.undetermined());
    // The part that was not fitted has a small error, too: it has the noise of the measurement.
    let (_, share) = found.worst().expect("joints");
    assert!(share < 0.05, "{share}");
    for (joint, truth) in found.joints.iter().zip([[0.8, 0.5], [0.3, 0.2]]) {
        for (k, truth) in truth.into_iter().enumerate() {
            let deviation = joint.deviations[k].expect("a parameter of its own");
            let off = (joint.after[k] - truth).abs();
            assert!(off < 4.0 * deviation + 0.01 * truth, "{joint:?}");
        }
    }
}

#[test]
fn the_text_has_what_is_pasted() {
    let found = identified(&record(|t| swing(t, SIZE, RATES), 4_000)).expect("parameters");
    let text = found.text();
    let svg = picture::svg(&found.traces);
    for part in ["shoulder, torque", "elbow, torque", "by what was found", "height=\"520\""] {
        assert!(svg.contains(part), "{part}");
    }
    let mass = format!("{:?}", found.bodies[1].after.mass);
    let lines = paste::lines(&paste::file(&off(), &found));
    for part in [
        "impl Robot<2, 2, 2> for TwoLinks {",
        &format!(".mass({mass})"),
        "pub const VISCOUS:",
        "pub const COULOMB:",
        "pub const ARMATURE:",
        "Width::f32(0.02)",
        // All that was found acts in a project whose file this becomes.
        "pub type Forces = (Inertia, Coriolis, Viscous<f32, V>, Coulomb<f32, V>);",
        "pub const SCENE: Scene",
    ] {
        assert!(lines.contains(part), "{part}\n{lines}");
    }
    assert!(paste::c(&found).contains(&format!(".mass = {mass}f")));
    for part in ["condition number", "joint 1 viscous friction", "torques of its last part within"]
    {
        assert!(text.contains(part), "{part}\n{text}");
    }
}

#[test]
fn a_joint_that_rests_leaves_its_parameters_and_is_named() {
    let still = record(|t| swing(t, [SIZE[0], 0.0], RATES), 6_000);
    let found = identified(&still).expect("those of the other joint");
    let hidden = found.undetermined();
    assert!(hidden.contains(&"joint 1 viscous friction"), "{hidden:?}");
    assert!(!hidden.contains(&"joint 0 viscous friction"), "{hidden:?}");
    assert!(found.text().contains("not determined by this motion"));
    // It stays as described.
    let joint = &found.joints[1];
    assert!((joint.after[0] / joint.before[0] - 1.0).abs() < 0.1, "{joint:?}");
}

#[test]
fn a_recording_at_rest_is_refused() {
    let error = identified(&record(|_| swing(0.0, [0.0; 2], RATES), 3_000)).expect_err("at rest");
    assert!(matches!(error, Error::AtRest { .. }), "{error}");
}

#[test]
fn an_effect_that_is_not_asked_for_stays_as_described() {
    let recorded = read(&record(|t| swing(t, SIZE, RATES), 4_000)).expect("ticks");
    let options = run::Options { effects: vec![run::JointEffect::Coulomb], ..OPTIONS() };
    let record = (Path::new("run.csv"), &recorded);
    let found = run::identify(&off(), record, None, &options).expect("parameters");
    for joint in &found.joints {
        assert!((joint.after[0] / joint.before[0] - 1.0).abs() < 1e-3, "{joint:?}");
        assert_eq!(joint.deviations[0], None);
    }
}
