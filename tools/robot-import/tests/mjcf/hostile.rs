//! Models that are damaged, too large or include each other: an error, in time, and never a panic.

use std::path::Path;
use std::time::Duration;

use crate::hostile::time;
use robot_import::description::Description;
use robot_import::error::{ImportError, Problem};
use robot_import::source::{parse, read};

pub fn model(sections: &str, bodies: &str) -> Result<Description, ImportError> {
    let text = format!("<mujoco>\n{sections}\n<worldbody>\n{bodies}\n</worldbody></mujoco>");
    parse(&text, Path::new("."))
}

pub const GEOM: &str = "<geom size='0.1'/>";

/// Files that include each other, or one twice, and a file that is broken.
#[test]
fn cycles_of_included_files_are_refused() {
    let folder = std::env::temp_dir().join(format!("mjcf-include-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = |name: &str, text: &str| std::fs::write(folder.join(name), text).expect("a file");
    file("self.xml", "<mujoco>\n<include file='self.xml'/></mujoco>");
    file("a.xml", "<mujoco>\n\n<include file='b.xml'/></mujoco>");
    file("b.xml", "<mujoco><include file='a.xml'/></mujoco>");
    file("twice.xml", "<mujoco><include file='empty.xml'/>\n<include file='empty.xml'/></mujoco>");
    file("empty.xml", "<mujoco/>");
    file("broken.xml", "<mujoco>\n\n<include file='part.xml'/></mujoco>");
    file("part.xml", "<mujoco>\n<body></mujoco>");
    for i in 0..40 {
        file(&format!("{i}.xml"), &format!("<mujoco><include file='{}.xml'/></mujoco>", i + 1));
    }
    let cases = [
        ("self.xml", 2, "included twice"),
        ("a.xml", 3, "included twice"),
        ("twice.xml", 2, "included twice"),
        ("broken.xml", 2, "file part.xml: not well-formed"),
        ("0.xml", 1, "files that include each other"),
    ];
    let errors = cases.map(|(name, ..)| read(&folder.join(name)).expect_err(name));
    std::fs::remove_dir_all(&folder).expect("a folder");
    for ((name, line, words), error) in cases.into_iter().zip(errors) {
        assert_eq!(error.place.line, line, "{name}: {error}");
        assert!(error.to_string().contains(words), "{name}: {error}");
    }
}

/// A robot is smaller; the refusal is fast.
#[test]
fn huge_models_are_refused_in_time() {
    let started = time();
    let many = "<body>\n<joint/><geom size='1'/></body>\n".repeat(10_000);
    let nested = format!("{}{}", "<body>".repeat(400), "</body>".repeat(400));
    let deeper = format!("{}{}", "<body>".repeat(505), "</body>".repeat(505));
    let frames = format!("{}{}", "<frame>".repeat(40), "</frame>".repeat(40));
    let classes: String = (0..70).map(|i| format!("<default class='{i}'>")).collect();
    let classes = format!("<default>{classes}{}</default>", "</default>".repeat(70));
    let geoms = format!("<body><joint/>{}</body>", GEOM.repeat(90_000));
    let elements = format!("<body><joint/>{}</body>", GEOM.repeat(150_000));
    let too_large = |result: Result<Description, ImportError>, name: &str| match result {
        Err(ImportError { problem: Problem::TooLarge { what, .. }, place }) => {
            assert_eq!(what, name);
            place.line
        }
        other => panic!("{name}: {:?}", other.err()),
    };
    let line = too_large(model("", &many), "bodies and joints");
    assert!(line > 1_900, "line {line}");
    assert_eq!(model("", &nested).expect("a tree").links.len(), 401);
    too_large(model("", &deeper), "nested elements");
    too_large(model("", &frames), "nested frames");
    too_large(model(&classes, ""), "nested default classes");
    let robot = model("", &geoms).expect("a robot");
    let mass = robot.links[1].inertial.expect("an inertia").mass;
    let sphere = 4.0 / 3.0 * std::f64::consts::PI;
    assert!((mass / (90_000.0 * sphere) - 1.0).abs() < 1e-9, "{mass} kg");
    too_large(model("", &elements), "elements");
    let duration = time() - started;
    assert!(duration < Duration::from_secs(16), "8 models in {duration:?}, at most 2 s each");
}

#[test]
fn bodies_and_joints_without_names_have_those_of_their_order() {
    let inner = format!("<body name='named'><joint/>{GEOM}</body>");
    let like_generated = format!("<body name='body_1'><joint name='joint_2'/>{GEOM}</body>");
    let bodies = format!(
        "<body><joint/><joint/>{GEOM}{inner}</body><body><joint/>{GEOM}</body>{like_generated}"
    );
    let robot = model("", &bodies).expect("a robot");
    let links: Vec<&str> = robot.links.iter().map(|link| link.name.as_str()).collect();
    let expected = ["world", "body_1_2/joint_0", "body_1_2", "named", "body_3", "body_1"];
    assert_eq!(links, expected);
    let joints: Vec<&str> = robot.joints.iter().map(|joint| joint.name.as_str()).collect();
    assert_eq!(joints, ["joint_0", "joint_1", "joint_2_2", "joint_3", "joint_2"]);
}

/// Each fixture, cut anywhere or with a byte replaced, is a robot or an error.
#[test]
fn damaged_models_never_panic() {
    let folder = super::folder();
    let mut refused = 0;
    let mut tried = 0;
    for entry in std::fs::read_dir(&folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|extension| extension != "xml") {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("a fixture");
        for end in (0..text.len()).step_by(7) {
            tried += 1;
            refused += usize::from(parse(&text[..end], &folder).is_err());
        }
        let words = ["-1", "1e308", "nan", "\"", "", "9", "<", "world", "b"];
        for (i, start) in (0..text.len()).step_by(11).enumerate() {
            let mut damaged = text.clone();
            damaged.replace_range(start..=start, words[i % words.len()]);
            tried += 1;
            refused += usize::from(parse(&damaged, &folder).is_err());
        }
    }
    assert!(refused > tried / 2 && refused < tried, "{refused} of {tried}");
}
