//! Parts of a file that are not in the robot, or not as the file has them, are named in words.

use std::path::Path;

use robot_import::description::{Description, Kind};
use robot_import::import::{Args, Imported, Options, import};
use robot_import::source::parse;

fn imported(text: &str, name: &str) -> Imported {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join(name);
    std::fs::write(&file, text).expect("a file");
    let args = Args { file, options: Options::default(), ..Args::default() };
    import(&args, "today").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn read(text: &str) -> Description {
    parse(text, Path::new(".")).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// A robot of one joint: attributes of the root, what is beside its parts, in its joint, and in its
/// inertia.
fn robot(root: &str, beside: &str, joint: &str, inertial: &str) -> String {
    format!(
        "<robot name='r' {root}>\n<link name='a'/>\n<link name='b'><inertial>{inertial}<mass value='2'/><inertia ixx='0.01' ixy='0' \
         ixz='0' iyy='0.01' iyz='0' izz='0.01'/></inertial></link>\n<joint name='j' type='revolute'><parent link='a'/>\
         <child link='b'/><axis xyz='0 1 0'/>{joint}</joint>\n{beside}\n</robot>"
    )
}

const PROPERTY: &str = "<xacro:property name='l' value='.2'/>";
const LIMIT: &str = "<limit lower='-1' upper='2' effort='10' velocity='3'/>";

#[test]
fn a_file_of_xacro_is_refused_with_what_to_do() {
    let declared = "xmlns:xacro='http://www.ros.org/wiki/xacro'";
    let cases = [
        (
            robot(declared, "<xacro:arm prefix='left'/>", LIMIT, ""),
            "line 5: <xacro:arm>: <xacro:arm> is of xacro",
        ),
        (
            robot(
                "xmlns:xacro='http://else.where'",
                "<xacro:macro name='m' params='p'><link name='x'/></xacro:macro>",
                LIMIT,
                "",
            ),
            "line 5: xacro:macro `m`: <xacro:macro> is of xacro",
        ),
        (
            robot(declared, "", &format!("{LIMIT}<xacro:damping/>"), ""),
            "line 4: <xacro:damping>: <xacro:damping> is of xacro",
        ),
        (robot("", "<xacro:arm/>", LIMIT, ""), "line 5: <xacro:arm>: <xacro:arm> is of xacro"),
        (
            robot("", "", LIMIT, "<origin xyz='${l} 0 0'/>"),
            "line 3: <origin>: `xyz=\"${l} 0 0\"` is of xacro",
        ),
        (
            robot(declared, PROPERTY, LIMIT, "<origin xyz='${l} 0 0'/>"),
            "line 3: <origin>: `xyz=\"${l} 0 0\"` is of xacro",
        ),
        (
            robot(declared, &format!("{PROPERTY}<xacro:arm/>"), LIMIT, ""),
            "line 5: <xacro:arm>: <xacro:arm> is of xacro",
        ),
        (
            robot(declared, &format!("{PROPERTY}<gazebo><mu1>${{l}}</mu1></gazebo>"), LIMIT, ""),
            "line 5: xacro:property `l`: <xacro:property> is of xacro",
        ),
        (
            robot("", "", LIMIT, "").replace("'b'", "'$(arg tf_prefix)b'"),
            "line 3: link `$(arg tf_prefix)b`: ",
        ),
    ];
    for (text, words) in cases {
        let error = parse(&text, Path::new(".")).expect_err(words).to_string();
        assert!(error.starts_with(words), "{error}");
        assert!(error.contains("`xacro FILE > robot.urdf`"), "{error}");
    }
    // The traces of xacro in a file that was expanded.
    let expanded = read(&robot(declared, "<gazebo/><material name='m'/>", LIMIT, ""));
    assert_eq!(expanded.notes, [""; 0]);
    // A property that nothing uses.
    for root in [declared, "xmlns:xacro='http://else.where'", ""] {
        let notes = read(&robot(root, PROPERTY, LIMIT, "")).notes;
        let note = notes.last().expect("a note");
        assert!(note.starts_with("The <xacro:property> on line 5 is of xacro, and"), "{note}");
    }
}

#[test]
fn what_may_be_a_macro_is_named() {
    let looks = "<link name='c'><visual><geometry><mesh filename='$(find arm)/c.stl'/></geometry></visual></link>\
        <joint name='k' type='fixed'><parent link='b'/><child link='c'/></joint>";
    let notes = read(&robot("", &format!("<cylinder_arm length='1'/>\n{looks}"), LIMIT, "")).notes;
    assert_eq!(notes.len(), 2, "{notes:#?}");
    assert!(
        notes[0]
            .starts_with("The element <cylinder_arm> on line 5 is none of URDF and is left out"),
        "{}",
        notes[0]
    );
    assert!(notes[1].starts_with("The <mesh> on line 6 has a text of xacro"), "{}", notes[1]);
    assert!(notes.iter().all(|note| note.contains("`xacro FILE > robot.urdf`")));
}

#[test]
fn limits_that_are_left_out_are_listed() {
    let soft = format!(
        "{LIMIT}<safety_controller soft_lower_limit='-0.9' soft_upper_limit='1.9' k_velocity='10'/>"
    );
    let imported_soft = imported(&robot("", "", &soft, ""), "r.urdf");
    let words = "The soft limits -0.9 to 1.9 of joint `j` are left out; its limits are those of its <limit>.";
    assert!(imported_soft.report.text().contains(words), "{}", imported_soft.report.text());
    assert!(
        imported_soft.source.contains("The soft limits -0.9 to 1.9"),
        "{}",
        imported_soft.source
    );
    let endless = robot("", "", LIMIT, "").replace("revolute", "continuous");
    let report = imported(&endless, "r.urdf").report.text();
    let words = "The limits of position -1 to 2 of joint `j` are left out: a continuous joint has none, a revolute one has.";
    assert!(report.contains(words), "{report}");
    let without_gains = robot("", "", &format!("{LIMIT}<safety_controller k_velocity='1'/>"), "");
    assert_eq!(read(&without_gains).notes, [""; 0]);
}

#[test]
fn roundings_in_frames_of_inertias_are_listed() {
    let turned = robot("", "", LIMIT, "<origin xyz='1e-9 0.1 0' rpy='1.5708 0.001 0'/>");
    let found = imported(&turned, "r.urdf");
    for words in
        ["Inertia of link `b`: x `1e-9` is 0.", "Inertia of link `b`: roll `1.5708` is π/2."]
    {
        assert!(found.report.text().contains(words), "{words}\n{}", found.report.text());
        assert!(found.source.contains(words), "{words}\n{}", found.source);
    }
    assert!(!found.source.contains("pitch"), "a milliradian is stated:\n{}", found.source);
    let model = "<mujoco><worldbody><body><joint/><inertial mass='1' pos='0.1 2e-8 0' diaginertia='1 2 2' quat='0.7071 0.7071 0 0'/></body></worldbody></mujoco>";
    let found = imported(model, "m.xml");
    assert!(found.report.text().contains("Inertia of link `body_1`: y"), "{}", found.report.text());
}

#[test]
fn a_milliradian_is_no_rounding_of_zero() {
    let text = robot("", "", &format!("{LIMIT}<origin rpy='0.001 0 1.571'/>"), "");
    let joint = &read(&text).joints[0];
    assert_eq!(joint.snapped.len(), 1, "{:?}", joint.snapped);
    assert_eq!(joint.snapped[0].attribute, "yaw");
    assert!((joint.exact.rotation.y_axis.z - 0.001_f64.sin()).abs() < 1e-15);
}

#[test]
fn quaternions_are_of_version_1_1() {
    let quarter = "<origin xyz='1 0 0' quat_xyzw='0 0 0.7071067811865476 0.7071067811865476'/>";
    let of = |version: &str| read(&robot(version, "", &format!("{LIMIT}{quarter}"), quarter));
    for version in ["version='1.1'", "version='1.2'"] {
        let robot = of(version);
        assert!(robot.joints[0].origin.rotation.x_axis.y > 0.999 && robot.notes.is_empty());
    }
    for version in ["", "version='1.0'"] {
        let robot = of(version);
        let [joint, link] =
            [robot.joints[0].origin.rotation, robot.links[1].inertial.expect("one").frame.rotation];
        assert_eq!([joint, link], [dynamics_core::glam::DMat3::IDENTITY; 2]);
        assert_eq!(robot.notes.len(), 2, "{:#?}", robot.notes);
        assert!(
            robot.notes.iter().any(|note| note.contains("<origin> of joint `j` is left out")),
            "{:#?}",
            robot.notes
        );
        assert!(
            robot.notes.iter().any(|note| note.contains("<origin> of link `b` is left out")),
            "{:#?}",
            robot.notes
        );
    }
    // Both are no mistake where one of them is not read.
    let both = quarter.replace("quat", "rpy='0 0 1' quat");
    let joint = read(&robot("", "", &format!("{LIMIT}{both}"), "")).joints[0].clone();
    assert!((joint.origin.rotation.x_axis.x - 1.0_f64.cos()).abs() < 1e-15);
    assert_eq!(joint.kind, Kind::Revolute);
}

#[test]
fn a_file_says_which_of_its_inertias_no_body_has() {
    let possible = imported(&robot("", "", LIMIT, ""), "r.urdf").source;
    assert!(
        possible.contains(
            "// A robot with an impossible joint or a negative mass does not compile.\nconst _"
        ),
        "{possible}"
    );
    for (entry, words) in [
        (
            "iyy='-0.01'",
            "The moment of inertia about (0.00, 1.00, 0.00) is -1.000e-2 kg·m², and none is negative",
        ),
        (
            "iyy='0.03'",
            "The moment of inertia about (0.00, 1.00, 0.00) exceeds the sum of the two others by 33.3 % of the largest",
        ),
    ] {
        let found = imported(&robot("", "", LIMIT, "").replace("iyy='0.01'", entry), "r.urdf");
        assert!(
            found.source.contains(&format!(
                "// Body `b` has an impossible inertia, which compiles. {words}"
            )),
            "{}",
            found.source
        );
        assert!(found.report.text().contains(words), "{}", found.report.text());
    }
}

#[test]
fn excessive_torque_limits_are_reported_with_both_numbers() {
    // 2 kg at 0.1 m: gravity takes 2 N·m, and 5 rad/s² another 0.15.
    let limited = |effort: &str| {
        let limit = format!("<limit lower='-1' upper='2' effort='{effort}' velocity='3'/>");
        imported(&robot("", "", &limit, "<origin xyz='0.1 0 0'/>"), "r.urdf").report.text()
    };
    let report = limited("100");
    assert!(
        report.contains("Its limit is 100 N·m, 49 times the 2.05 N·m")
            && report.contains("a safety gate with these limits never acts"),
        "{report}"
    );
    for near in ["60", "0", "1"] {
        let report = limited(near);
        assert!(!report.contains("never acts"), "{report}");
    }
}

#[test]
fn a_joint_that_takes_hours_for_its_range_is_named() {
    let of = |velocity: &str| {
        let limit = format!("<limit lower='-1' upper='2' effort='10' velocity='{velocity}'/>");
        imported(&robot("", "", &limit, ""), "r.urdf").report.text()
    };
    let report = of("1e-6");
    assert!(
        report.contains(
            "At its limit of speed, 0.000001 rad/s, it takes 833.3 hours for its range of 3.000 rad"
        ),
        "{report}"
    );
    assert!(!of("0.01").contains("hours"));
}
