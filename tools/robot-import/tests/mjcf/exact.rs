//! Exact values in place of roundings.

use std::f64::consts::FRAC_PI_2;

use dynamics_core::glam::{DMat3, DVec3};
use robot_import::source::read;

use super::hostile::{GEOM, model};

/// The attributes of a body, whether its rotation is one of quarter turns, and the number of
/// reports.
#[test]
fn roundings_of_quarter_turns_are_exact() {
    let cases = [
        ("quat='0.707107 0 0 0.707107'", true, 0),
        ("quat='0.7071 0 0 -0.70711'", true, 1),
        ("quat='0.5 -0.5 0.5 0.5'", true, 0),
        ("quat='0.707105 0.707108 0 0'", true, 1),
        ("quat='-3.67321e-06 1 0 0'", true, 1),
        ("quat='-3.67321e-05 1 0 0'", false, 0),
        ("quat='0.71 0 0 0.7'", false, 0),
        ("euler='90 0 -180'", true, 0),
        ("euler='90.00001 0 0'", true, 1),
        ("euler='90.1 0 0'", false, 0),
        ("euler='90.001 0 0'", false, 0),
        ("axisangle='0 0 1 89.9'", false, 0),
        ("axisangle='0 0 1 -90'", true, 0),
        ("xyaxes='0 1 0 -1 0 0.00001'", true, 1),
        ("xyaxes='0 1 0 -1 0 0.01'", false, 0),
        ("xyaxes='0 1 0 -1 0 0.001'", false, 0),
        ("quat='1 0.001 0 0'", false, 0),
        ("quat='0.7071 0.001 0 0.7071'", false, 0),
        ("zaxis='0 -2 0'", true, 0),
        ("zaxis='0 -2 0.002'", false, 0),
        ("pos='1e-9 0.1 -2e-10'", true, 2),
        ("pos='1e-5 0.1 0'", true, 0),
    ];
    for (attributes, quarter, reports) in cases {
        let bodies =
            format!("<body name='a' {attributes}><joint name='a' axis='1 0 0'/>{GEOM}</body>");
        let robot = model("", &bodies).expect(attributes);
        let joint = &robot.joints[0];
        let entries = joint.exact.rotation.to_cols_array();
        let exact = entries.iter().all(|x| [-1.0, 0.0, 1.0].contains(x));
        assert_eq!(exact, quarter, "{attributes}: {entries:?}");
        assert_eq!(joint.snapped.len(), reports, "{attributes}: {:?}", joint.snapped);
        let apart = joint.exact.rotation - joint.origin.rotation;
        let most = if reports > 0 { 1e-4 } else { 1e-15 };
        assert!(apart.to_cols_array().iter().all(|x| x.abs() < most), "{attributes}: {apart}");
        for report in &joint.snapped {
            assert!(report.difference != 0.0 && report.difference.abs() < 1e-4, "{report:?}");
        }
    }
}

/// In radians a right angle is always a rounding, in degrees only the noise of a computation is
/// one.
#[test]
fn right_angles_in_radians_are_roundings() {
    for (euler, quarter) in [
        ("1.57 0 -3.1416", true),
        ("1.5708 0 0", true),
        ("1.5694 0 0", false),
        ("0.001 0 1.571", false),
    ] {
        let bodies = format!("<body name='a' euler='{euler}'>{GEOM}</body>");
        let robot = model("<compiler angle='radian'/>", &bodies).expect(euler);
        let entries = robot.joints[0].exact.rotation.to_cols_array();
        let exact = entries.iter().all(|x| [-1.0, 0.0, 1.0].contains(x));
        assert_eq!(exact, quarter, "{euler}: {entries:?}");
    }
}

#[test]
fn a_reference_of_a_quarter_turn_is_exact() {
    let bodies = format!("<body name='a'><joint name='a' ref='90'/>{GEOM}</body>");
    let robot = model("", &bodies).expect("a robot");
    let quarter = DMat3::from_cols(-DVec3::Y, DVec3::X, DVec3::Z);
    assert_eq!(robot.joints[0].exact.rotation, quarter);
    let given = DMat3::from_rotation_z(-FRAC_PI_2);
    assert!(robot.joints[0].origin.rotation.abs_diff_eq(given, 1e-15));
}

/// The numbers of the fixtures are exact already: both placements of each joint are the same.
#[test]
fn exact_placements_are_those_of_the_file() {
    for entry in std::fs::read_dir(super::folder()).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|extension| extension != "xml") {
            continue;
        }
        let robot = read(&path).expect("a fixture");
        for joint in &robot.joints {
            let [origin, exact] = [&joint.origin, &joint.exact];
            let near = origin.rotation.abs_diff_eq(exact.rotation, 1e-14)
                && origin.position.abs_diff_eq(exact.position, 1e-14);
            assert!(near, "{}: joint {}", path.display(), joint.name);
        }
        for link in &robot.links {
            let Some(inertial) = link.inertial else {
                continue;
            };
            let [frame, exact] = [&inertial.frame, &inertial.exact];
            let near = frame.rotation.abs_diff_eq(exact.rotation, 1e-14)
                && frame.position.abs_diff_eq(exact.position, 1e-14);
            assert!(near, "{}: link {}", path.display(), link.name);
        }
    }
}
