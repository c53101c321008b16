//! The result of an import, and a check that fails if the import is wrong.

mod changes;
mod extensions;
mod locks;
mod subjects;
mod terms;

use std::path::Path;

use robot_import::advice::{Topic, advice, bare_joints};
use robot_import::check::{MOST, STATES, check, check_trees};
use robot_import::description::{Description, Kind};
use robot_import::number::Attitude;
use robot_import::selection::Selection;
use robot_import::source::parse;
use robot_import::tree::{Numbers, Tree};

const SO101: &str = include_str!("urdf/so101.urdf");
/// Every kind of joint, fixed parts between them, a mimic of a mimic, friction and inertias about
/// turned axes.
const ZOO: &str = include_str!("urdf/zoo.urdf");

fn read(text: &str) -> Description {
    parse(text, Path::new(".")).unwrap_or_else(|error| panic!("{error}"))
}

fn tree(robot: &Description, selection: &Selection) -> Tree {
    let selected = selection.of(robot).expect("a selection");
    Tree::of(robot, &selected, Numbers::Exact).expect("a tree")
}

fn holds(robot: &Description, selection: &Selection) {
    let selected = selection.of(robot).expect("a selection");
    let checked = check(robot, &selected, STATES).expect("of the library's sizes");
    assert!(checked.holds(), "{checked:?}");
}

#[test]
fn every_kind_of_joint_has_the_torques_of_lagranges_equations() {
    let robot = read(ZOO);
    holds(&robot, &Selection::default());
    let free_base = true;
    holds(&robot, &Selection { free_base, ..Selection::default() });
    let lock = vec![("lift".into(), 0.4), ("turn".into(), -0.3)];
    holds(&robot, &Selection { lock, ..Selection::default() });
    let (base, tip) = (Some("plate".into()), Some("finger".into()));
    holds(&robot, &Selection { base, tip, ..Selection::default() });
    let joints = vec!["lift".into(), "finger_joint".into()];
    holds(&robot, &Selection { joints, ..Selection::default() });
}

#[test]
fn a_check_finds_wrong_numbers_of_the_tree() {
    let robot = read(SO101);
    let selected = Selection::default().of(&robot).expect("all joints");
    let given = Tree::of(&robot, &selected, Numbers::AsGiven).expect("a tree");
    type Change = fn(&mut Tree);
    let broken: [(&str, Change); 6] = [
        ("mass", |tree| tree.bodies[3].inertia.mass *= 1.0 + 1e-6),
        ("centre of mass", |tree| tree.bodies[4].inertia.com[2] += 1e-8),
        ("inertia", |tree| tree.bodies[1].inertia.inertia[1] += 1e-9),
        ("offset", |tree| tree.bodies[2].xyz[1] += 1e-8),
        ("axis", |tree| tree.bodies[5].axis[2] = -1.0),
        ("parent", |tree| tree.bodies[5].parent = Some(3)),
    ];
    for (name, change) in broken {
        let mut wrong = given.clone();
        change(&mut wrong);
        let checked =
            check_trees(&robot, &selected, [&wrong, &given], 20).expect("of the library's sizes");
        assert!(!checked.holds() && checked.energy > 10.0 * MOST, "{name}: {:e}", checked.energy);
    }
    let right =
        check_trees(&robot, &selected, [&given, &given], 20).expect("of the library's sizes");
    assert!(right.holds());
}

// They are reported.
#[test]
fn rounded_right_angles_and_zeros_become_exact() {
    let robot = read(SO101);
    let tree = tree(&robot, &Selection::default());
    let quarters = |k: usize| tree.bodies[k].attitude;
    assert_eq!(quarters(0), Attitude::QuarterTurns([2, 0, 2]));
    assert_eq!(quarters(2), Attitude::QuarterTurns([0, 0, 1]));
    assert_eq!(tree.bodies[0].xyz, [0.0388353, 0.0, 0.0624]);
    // Its pitch of 2.8 degrees is none.
    assert!(matches!(quarters(4), Attitude::Rpy([_, 0.0486795, _])));
    let snapped: usize = tree.bodies.iter().map(|body| body.snapped.len()).sum();
    assert_eq!(snapped, 20);
    let selected = Selection::default().of(&robot).expect("all joints");
    let checked = check(&robot, &selected, STATES).expect("of the library's sizes");
    assert!((1e-7..1e-5).contains(&checked.snapping), "{:e}", checked.snapping);
}

#[test]
fn fixed_parts_are_merged_and_mimics_of_mimics_resolved() {
    let robot = read(ZOO);
    let tree = tree(&robot, &Selection::default());
    let names: Vec<&str> = tree.bodies.iter().map(|body| body.name.as_str()).collect();
    assert_eq!(names, ["carriage", "ball", "plate", "finger", "thumb", "tail", "drone"]);
    assert_eq!(tree.bodies[0].merged, ["bracket"]);
    assert_eq!(tree.bodies[0].inertia.mass, 3.5);
    assert_eq!(tree.bodies[4].follows, Some((3, -0.5, 0.1)));
    assert_eq!(tree.bodies[5].follows, Some((3, 1.0, -0.3)));
    assert_eq!(tree.bodies[6].kind, Kind::Free);
    assert_eq!(tree.bodies[0].damping, 12.0);
}

// It is locked where it follows to.
#[test]
fn a_follower_of_a_locked_joint_is_locked_too() {
    let robot = read(ZOO);
    let lock = vec![("finger_joint".into(), 0.2)];
    let selection = Selection { lock, ..Selection::default() };
    let tree = tree(&robot, &selection);
    assert!(tree.bodies.iter().all(|body| !["finger", "thumb", "tail"].contains(&&*body.name)));
    holds(&robot, &selection);
}

#[test]
fn a_left_out_link_takes_its_subtree_with_it() {
    let robot = read(SO101);
    let of = |without: &[&str]| Selection {
        without: without.iter().map(|&link| link.into()).collect(),
        ..Selection::default()
    };
    let whole = tree(&robot, &of(&[]));
    let short = tree(&robot, &of(&["wrist_link"]));
    assert_eq!(short.bodies.len(), 3);
    assert_eq!(short.bodies[2].inertia, whole.bodies[2].inertia);
    holds(&robot, &of(&["wrist_link"]));
    // A frame without a joint of its own, and its placeholder of a mass.
    let bare = tree(&robot, &of(&["gripper_frame_link"]));
    assert!(bare.bodies[4].inertia.mass < whole.bodies[4].inertia.mass);
    let error = of(&["base_link"]).of(&robot).expect_err("the base");
    assert!(error.to_string().contains("cannot be left out"), "{error}");
}

#[test]
fn an_unknown_selection_is_an_error_with_a_suggestion() {
    let robot = read(SO101);
    let error = |selection: Selection| selection.of(&robot).expect_err("not there").to_string();
    let joints = vec!["shoulder_pann".into()];
    assert_eq!(
        error(Selection { joints, ..Selection::default() }),
        "there is no joint `shoulder_pann`; did you mean `shoulder_pan`?"
    );
    let (base, tip) = (Some("wrist_link".into()), Some("shoulder_link".into()));
    let text = error(Selection { base, tip, ..Selection::default() });
    assert_eq!(text, "link `shoulder_link` is not below the base");
    let lock = vec![("elbow_flex".into(), f64::NAN)];
    let text = error(Selection { lock, ..Selection::default() });
    assert!(text.contains("joint `elbow_flex`: it cannot be locked at NaN"), "{text}");
}

#[test]
fn a_robot_without_friction_and_rotors_is_named() {
    let is_bare = |text: &str| {
        let robot = read(text);
        let selected = Selection::default().of(&robot).expect("all joints");
        bare_joints(&Tree::of(&robot, &selected, Numbers::Exact).expect("a tree")).is_some()
    };
    let text = include_str!("urdf/so101.urdf");
    assert!(is_bare(text));
    for dynamics in [r#"<dynamics damping="0.1"/>"#, r#"<dynamics friction="0.1"/>"#] {
        let other = text.replace("<limit ", &format!("{dynamics}<limit "));
        assert!(other != text && !is_bare(&other), "{dynamics}");
    }
}

#[test]
fn each_topic_of_advice_names_its_line() {
    let robot = read(include_str!("urdf/advice.urdf"));
    let selected = Selection::default().of(&robot).expect("all joints");
    let tree = Tree::of(&robot, &selected, Numbers::Exact).expect("a tree");
    let all = advice(&robot, &selected, &tree);
    let found: Vec<(Topic, u32)> = all.iter().map(|advice| (advice.topic, advice.line)).collect();
    assert_eq!(
        found,
        [
            (Topic::NonPhysical, 5),
            (Topic::Placeholder, 9),
            (Topic::Placeholder, 13),
            (Topic::Tiny, 17),
            (Topic::Massless, 46),
            (Topic::Axis, 25),
            (Topic::Limits, 25),
            (Topic::Limits, 30),
            (Topic::Limits, 35),
            (Topic::Mimic, 40),
            (Topic::Mimic, 46),
        ],
        "{all:#?}"
    );
    assert!(all[0].text.contains("(0.00, 0.00, 1.00) exceeds the sum of the two others by 20.0 %"));
}

#[test]
fn a_body_of_six_zero_moments_is_named() {
    let body = |moments: &str, place: &str| {
        let joint = "<joint name='j' axis='0 1 0'/>";
        read(&format!(
            "<mujoco><worldbody><body name='rod'><inertial pos='{place}' mass='1.5' {moments}/>\
             {joint}</body></worldbody></mujoco>"
        ))
    };
    let words = |robot: &Description| {
        let selected = Selection::default().of(robot).expect("all joints");
        let all = advice(robot, &selected, &tree(robot, &Selection::default()));
        let named = all.into_iter().filter(|one| one.name == "rod" && one.text.contains("moments"));
        named.map(|one| (one.topic, one.text)).collect::<Vec<_>>()
    };
    for (moments, place) in [("diaginertia='0 0 0'", "0 0 0"), ("", "0 0 -0.2")] {
        let [(Topic::Placeholder, text)] = &words(&body(moments, place))[..] else {
            panic!("no advice: {moments} {place}");
        };
        assert!(text.starts_with("1.5 kg whose six moments of inertia are zero"), "{text}");
    }
    assert_eq!(words(&body("diaginertia='1e-9 1e-9 1e-9'", "0 0 -0.2")), []);
}

/// The SO-101 with the numbers of attributes changed, as advice on units and torques.
fn plausible_with(changes: &[(&str, f64)]) -> Vec<robot_import::advice::Advice> {
    let mut text = SO101.to_owned();
    for (attribute, factor) in changes {
        let begin = format!(" {attribute}=\"");
        let mut parts = text.split(&begin);
        let mut changed = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            let (numbers, rest) = part.split_once('"').expect("a closing quote");
            let numbers = numbers.split_whitespace().map(|number| {
                let number: f64 = number.parse().expect("a number");
                format!("{:e}", number * factor)
            });
            changed += &format!("{begin}{}\"{rest}", numbers.collect::<Vec<_>>().join(" "));
        }
        text = changed;
    }
    let robot = read(&text);
    let selected = Selection::default().of(&robot).expect("all joints");
    let tree = Tree::of(&robot, &selected, Numbers::Exact).expect("a tree");
    robot_import::plausible::plausible(&tree, "so101")
}

#[test]
fn wrong_units_are_reported_by_joint_and_line() {
    assert_eq!(plausible_with(&[]), []);
    let degrees = 180.0 / std::f64::consts::PI;
    let found = plausible_with(&[("lower", degrees), ("upper", degrees)]);
    let [one] = &found[..] else {
        panic!("{found:#?}");
    };
    assert_eq!((one.topic, &*one.name), (Topic::Units, "wrist_roll"));
    assert!(one.line > 0 && one.text.contains("these look like degrees"), "{one:#?}");
    let inertias = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"].map(|name| (name, 1e3));
    let found = plausible_with(&[&inertias[..], &[("value", 1e3)]].concat());
    assert!(
        found.iter().any(|one| one.text.contains("these look like g") && one.name == "so101"),
        "{found:#?}"
    );
    let found = plausible_with(&[("effort", 0.01)]);
    assert!(found[0].text.starts_with("Gravity needs "), "{found:#?}");
}

#[test]
fn numbers_agree_with_another_reader() {
    let other = urdf_rs::read_from_string(SO101).expect("read");
    let own = read(SO101);
    assert_eq!(own.links.len(), other.links.len());
    for (own, other) in own.links.iter().zip(&other.links) {
        let inertial = own.inertial.expect("each has one");
        let inertia = &other.inertial.inertia;
        assert_eq!(inertial.mass, other.inertial.mass.value);
        assert_eq!(inertial.frame.position.to_array(), *other.inertial.origin.xyz);
        let entries =
            [inertia.ixx, inertia.ixy, inertia.ixz, inertia.iyy, inertia.iyz, inertia.izz];
        assert_eq!(inertial.inertia, entries);
    }
    for (own, other) in own.joints.iter().zip(&other.joints) {
        assert_eq!(own.origin.position.to_array(), *other.origin.xyz);
        let limits = [own.limits.velocity, own.limits.effort];
        if own.kind == Kind::Revolute {
            assert_eq!(own.axis.to_array(), *other.axis.xyz);
            assert_eq!(own.limits.position, Some([other.limit.lower, other.limit.upper]));
            assert_eq!(limits, [Some(other.limit.velocity), Some(other.limit.effort)]);
        }
    }
}
