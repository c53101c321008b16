//! Advice is given on what the robot has, and options that it names are taken.

use robot_import::import::{Args, Imported, Options, import};

fn tried(text: &str, name: &str, options: Options) -> Result<Imported, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join(name);
    std::fs::write(&file, text).expect("a file");
    let args = Args { file, options, ..Args::default() };
    import(&args, "today").map_err(|error| error.to_string())
}

fn imported(text: &str, name: &str) -> Imported {
    tried(text, name, Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The words on a robot: the advice on each joint or part, and the comments of the written file.
fn said(of: &Imported) -> String {
    let advice = of.report.advice.iter();
    let lines: Vec<String> = advice.map(|one| format!("{}: {}", one.name, one.text)).collect();
    lines.join("\n") + &of.source
}

const INERTIAL: &str = "<inertial><origin xyz='0.1 0 0'/><mass value='1.2'/><inertia ixx='0.001' ixy='0' ixz='0' iyy='0.005' iyz='0' \
                        izz='0.005'/></inertial>";

/// A chain of joints about y, each with what stands in it.
fn chain(joints: &[(&str, &str)]) -> String {
    let mut text = String::from("<robot name='chain'><link name='base'/>");
    let mut parent = "base".to_owned();
    for (name, inside) in joints {
        let link = format!("{name}_link");
        text += &format!(
            "\n<link name='{link}'>{INERTIAL}</link><joint name='{name}' type='revolute'><origin xyz='0.2 0 0'/>\
             <parent link='{parent}'/><child link='{link}'/><axis xyz='0 1 0'/>{inside}</joint>"
        );
        parent = link;
    }
    text + "</robot>"
}

/// A cart with a pole; which actuators there are.
fn cart_pole(actuators: &str) -> String {
    format!(
        "<mujoco model='cart'><worldbody><body name='cart'><joint name='rail' type='slide' axis='1 0 0' range='-1 1'/>\
         <inertial pos='0 0 0' mass='1' diaginertia='0.01 0.01 0.01'/><body name='pole'><joint name='hinge' axis='0 1 0'/>\
         <inertial pos='0 0 0.4' mass='0.2' diaginertia='0.01 0.01 0.001'/></body></body></worldbody>{actuators}</mujoco>"
    )
}

const FULL: &str = "<limit lower='-2' upper='2' effort='40' velocity='3'/>";
const ZERO: &str = "<limit lower='0' upper='0' effort='0' velocity='0'/>";

#[test]
fn a_tree_gets_no_advice_on_loops_or_motors() {
    let free_base = |name: &str, text: &str| {
        let options = Options { free_base: true, ..Options::default() };
        tried(text, name, options).unwrap_or_else(|error| panic!("{error}"))
    };
    let zero = chain(&[("shoulder", ZERO), ("elbow", ZERO)]);
    let robots = [
        imported(&zero, "r.urdf"),
        imported(&chain(&[("shoulder", ""), ("elbow", FULL)]), "r.urdf"),
        imported(&chain(&[("only", ZERO)]), "r.urdf"),
        imported(&cart_pole(""), "r.xml"),
        imported(
            &cart_pole("<actuator><motor joint='rail' ctrlrange='-20 20'/></actuator>"),
            "r.xml",
        ),
        imported(&cart_pole("<actuator><position joint='rail'/></actuator>"), "r.xml"),
        free_base("r.urdf", &zero),
    ];
    for robot in &robots {
        let said = said(robot);
        for word in ["loop", "--motors", "motors on", "taken as driven"] {
            assert!(!said.contains(word), "`{word}` in\n{said}");
        }
    }
    assert!(said(&robots[0]).contains("elbow: It has no limit of speed and of torque"));
}

#[test]
fn a_joint_without_a_motor_needs_no_limit_of_torque() {
    let torque = "no limit of";
    let pole = cart_pole("<actuator><motor joint='rail' ctrlrange='-20 20'/></actuator>");
    assert!(!said(&imported(&pole, "r.xml")).contains(torque));
    // A file without any actuator does not say which have none.
    let none = said(&imported(&cart_pole(""), "r.xml"));
    assert!(none.contains("hinge: It has no limit of torque"), "{none}");
    let follower = |joint: &str| {
        let mimic = format!("<mimic joint='{joint}' multiplier='-1'/>");
        said(&imported(&chain(&[("elbow", FULL), ("rot", &mimic)]), "r.urdf"))
    };
    let said = follower("elbow");
    assert!(!said.contains(torque), "{said}");
    // One whose leader is not there moves by itself.
    let said = follower("nobody");
    assert!(said.contains("rot: It has no limit of speed and of torque"), "{said}");
}

#[test]
fn a_belt_is_described_as_a_coupling() {
    let mimic = "<mimic joint='elbow' multiplier='-1'/>";
    let scara = chain(&[("shoulder", FULL), ("elbow", FULL), ("rot", mimic)]);
    let robot = imported(&scara, "r.urdf");
    let text = robot.report.text();
    assert!(
        text.contains("Coupled: 2 motors drive 3 joints through `COUPLING`, a `Transmission`"),
        "{text}"
    );
    assert!(!said(&robot).contains("loop"), "{}", said(&robot));
    assert!(robot.source.contains("pub const M: usize = 2;"), "{}", robot.source);
    let tree = imported(&chain(&[("shoulder", FULL), ("elbow", FULL)]), "r.urdf");
    assert!(!tree.report.text().contains("Coupled"));
}

#[test]
fn a_tendon_over_three_joints_says_what_to_write() {
    let joint = |name: &str, inside: &str| {
        format!(
            "<body name='{name}' pos='0.2 0 0'><joint name='{name}' axis='0 0 1'/><inertial pos='0.1 0 0' mass='1' \
             diaginertia='0.01 0.01 0.01'/>{inside}</body>"
        )
    };
    let arm = joint("shoulder", &joint("elbow", &joint("pulley", "")));
    let text = format!(
        "<mujoco><worldbody>{arm}</worldbody><tendon><fixed name='belt'><joint joint='shoulder' coef='1'/><joint joint='elbow' coef='1'/>\
         <joint joint='pulley' coef='-1'/></fixed></tendon><equality><tendon tendon1='belt'/></equality></mujoco>"
    );
    let error = tried(&text, "r.xml", Options::default()).expect_err("three joints");
    assert!(error.contains("a tendon over 3 joints"), "{error}");
    assert!(
        error.contains("write the `Transmission` between motors and joints yourself"),
        "{error}"
    );
    // Its advice can be followed.
    let without = text.replace("<equality><tendon tendon1='belt'/></equality>", "");
    assert_eq!(imported(&without, "r.xml").report.sizes, [3, 3, 3]);
}

/// A parallelogram of two cranks and a rod, with a `<connect>` and these actuators.
fn parallelogram(actuators: &str) -> String {
    let crank = |name: &str, x: &str, inside: &str| {
        format!(
            "<body name='{name}' pos='{x} 0 0'><joint name='{name}' axis='0 1 0'/><inertial pos='0 0 0.1' mass='1' \
             diaginertia='0.01 0.01 0.01'/>{inside}</body>"
        )
    };
    let rod = "<body name='rod' pos='0 0 0.2'><joint name='rod' axis='0 1 0'/><inertial pos='0.15 0 0' mass='0.5' \
               diaginertia='0.001 0.01 0.01'/></body>";
    format!(
        "<mujoco model='p'><worldbody>{}{}</worldbody><equality><connect body1='rod' body2='right' anchor='0.3 0 0'/></equality>\
         {actuators}</mujoco>",
        crank("left", "0", rod),
        crank("right", "0.3", "")
    )
}

#[test]
fn an_option_that_advice_names_is_taken() {
    let passive = imported(&parallelogram(""), "p.xml");
    let words = said(&passive);
    assert!(words.contains("`--motors A,B` names those"), "{words}");
    let motors = |names: &[&str]| Options {
        motors: names.iter().map(|&name| name.to_owned()).collect(),
        ..Options::default()
    };
    let named = tried(&parallelogram(""), "p.xml", motors(&["left"])).expect("a motor");
    assert!(!said(&named).contains("--motors"), "{}", said(&named));
    let error = tried(&parallelogram(""), "p.xml", motors(&["lfet"])).expect_err("misspelt");
    assert!(error.ends_with("no joint of this name moves; did you mean `left`?"), "{error}");
    // A tree is not told of the option, and told why not to use it.
    let error =
        tried(&chain(&[("elbow", FULL)]), "r.urdf", motors(&["elbow"])).expect_err("no loop");
    assert!(error.contains("`--motors`: the robot has no loop"), "{error}");
}

#[test]
fn a_robot_below_the_estimates_range_gets_none() {
    let one = imported(&chain(&[("only", FULL)]), "r.urdf");
    let text = one.report.text();
    assert!(!text.contains("estimated"), "{text}");
    assert_eq!((one.report.estimated_cycles, one.report.estimated_flash), (None, None));
    let two_fingers = chain(&[("a", FULL)]).replace("</robot>", "")
        + &format!(
            "<link name='b'>{INERTIAL}</link><joint name='b' type='revolute'><parent link='base'/><child link='b'/>\
             <axis xyz='0 1 0'/>{FULL}</joint></robot>"
        );
    assert_eq!(imported(&two_fingers, "r.urdf").report.estimated_cycles, None);
    let text = imported(&chain(&[("a", FULL), ("b", FULL)]), "r.urdf").report.text();
    assert!(text.contains("(estimated)"), "{text}");
}

#[test]
fn a_misspelt_tip_has_a_suggestion() {
    let arm = chain(&[("wrist_1", FULL), ("wrist_2", FULL), ("wrist_3", FULL)]);
    for (given, meant) in [
        ("wirst_3_link", "wrist_3_link"),
        ("rist_3_link", "wrist_3_link"),
        ("wrist_3_lnik", "wrist_3_link"),
        ("Wrist_2_link", "wrist_2_link"),
        ("wrist_1", "wrist_1_link"),
        ("bsae", "base"),
    ] {
        let options = Options { tip: Some(given.to_owned()), ..Options::default() };
        let error = tried(&arm, "r.urdf", options).expect_err("misspelt");
        let words = format!("there is no link `{given}`; did you mean `{meant}`?");
        assert_eq!(error, words);
    }
    let options = Options { tip: Some("hand".to_owned()), ..Options::default() };
    let error = tried(&arm, "r.urdf", options).expect_err("no such link");
    assert_eq!(error, "there is no link `hand`");
}

#[test]
fn numbers_of_one_body_or_joint_are_named_with_it() {
    let arm = chain(&[("shoulder", FULL), ("elbow", FULL), ("wrist", FULL)]);
    let at = |nth: usize, from: &str, to: &str| {
        let mut parts: Vec<String> = arm.split(from).map(str::to_owned).collect();
        parts[nth] = parts[nth].clone() + to + &parts.remove(nth + 1);
        said(&imported(&parts.join(from), "r.urdf"))
    };
    let words = at(1, FULL, &FULL.replace("'2'", "'170'"));
    assert!(words.contains("elbow: A position limit of 170 rad is 27.1 turns"), "{words}");
    // About the joint: 1.2 kg on 0.1 m are 0.012 kg·m².
    let words = at(1, "iyy='0.005' iyz='0' izz='0.005'", "iyy='0.017' iyz='0' izz='0.017'");
    assert!(words.contains("elbow_link: Its inertia of 0.0170 kg·m² is more than"), "{words}");
    // kg·mm² of a part within 2 m of radius of gyration is named by the library, beyond by the
    // importer.
    let words = at(
        2,
        "ixx='0.001' ixy='0' ixz='0' iyy='0.005' iyz='0' izz='0.005'",
        "ixx='1000' ixy='0' ixz='0' iyy='5000' iyz='0' izz='5000'",
    );
    assert!(words.contains("wrist_link: 1.2 kg with a radius of gyration of 64.5 m"), "{words}");
}

#[test]
fn a_negative_moment_of_a_file_is_computed_with() {
    let arm = chain(&[("a", FULL), ("b", FULL)]).replacen("iyy='0.005'", "iyy='-0.004'", 1);
    let robot = imported(&arm, "r.urdf");
    assert!(
        robot.source.contains(".inertia_as_published([0.001, 0.0, 0.0, -0.004, 0.0, 0.005])"),
        "{}",
        robot.source
    );
    assert_eq!(robot.source.matches(".inertia([").count(), 1);
}
