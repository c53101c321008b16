//! Files that are wrong: an error that names line or element, never a panic, in little time.

use std::path::Path;
use std::time::Duration;

use robot_import::check::check;
use robot_import::error::{ImportError, Problem};
use robot_import::selection::Selection;
use robot_import::source::parse;
use robot_import::tree::{Numbers, Tree};

const SO101: &str = include_str!("urdf/so101.urdf");

/// The processor time of this thread on Linux, since other programs run beside it; elsewhere none.
pub fn time() -> Duration {
    let stat = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let ran = stat.split(' ').next().and_then(|ran| ran.parse().ok());
    ran.map_or(Duration::ZERO, Duration::from_nanos)
}

/// Everything that an import does, within the time that it may take.
fn import(text: &str) -> Result<Tree, ImportError> {
    let start = time();
    let done = parse(text, Path::new(".")).and_then(|robot| {
        let selected = Selection::default().of(&robot)?;
        check(&robot, &selected, 1)?;
        Tree::of(&robot, &selected, Numbers::Exact)
    });
    let took = time() - start;
    assert!(took < Duration::from_secs(2), "{took:?}");
    done
}

/// A robot of two links with the body of its joint.
fn two(joint: &str) -> String {
    format!(
        "<robot name='r'>\n<link name='a'/>\n<link name='b'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' \
         iyy='1' iyz='0' izz='1'/></inertial></link>\n<joint name='j' type='revolute'>{joint}</joint>\n</robot>"
    )
}

fn error_of(text: &str) -> ImportError {
    match import(text) {
        Ok(tree) => panic!("accepted, with {} bodies:\n{text}", tree.bodies.len()),
        Err(error) => error,
    }
}

#[test]
fn each_defect_is_an_error_that_names_line_and_element() {
    let ends = "<parent link='a'/><child link='b'/>";
    let cases = [
        (two(&format!("{ends}<origin xyz='0 0 nan'/>")), "line 4: <origin>", "finite"),
        (two(&format!("{ends}<origin xyz='0 0'/>")), "line 4: <origin>", "3 finite numbers"),
        (two(&format!("{ends}<origin rpy='0 0 1e999'/>")), "line 4: <origin>", "finite"),
        (two(&format!("{ends}<origin xyz='1e300 0 0'/>")), "line 4: joint `j`", "1e300"),
        (two(&format!("{ends}<axis xyz='0 0 0'/>")), "line 4: joint `j`", "length 0"),
        (two("<parent link='a'/>"), "line 4: joint `j`", "<child>"),
        (two("<parent link='a'/><child link='c'/>"), "line 4: joint `j`", "no link `c`"),
        (two("<parent link='b'/><child link='b'/>"), "line 4: joint `j`", "cycle"),
        (two(&format!("{ends}<limit effort='x'/>")), "line 4: <limit>", "effort"),
        (two(ends).replace("revolute", "telescopic"), "line 4: joint `j`", "telescopic"),
        (two(ends).replace("value='1'", "value='-1'"), "line 3: link `b`", "-1 kg"),
        (two(ends).replace("value='1'", "value='1e200'"), "line 3: link `b`", "1e200"),
        (
            two(ends).replace("<link name='a'/>", "<link name='a'/><link name='b'/>"),
            "line 3: link `b`",
            "same name",
        ),
        (two(ends).replace("<link name='a'/>", "<link/>"), "line 2: <link>", "`name` is missing"),
        (two(ends).replace("</joint>", ""), "line 5", "XML"),
        (
            two(ends).replace("<robot name='r'>", "<robot name='r' version='2.0'>"),
            "line 1: robot `r`",
            "2.0",
        ),
        (two(ends).replace("robot", "sdf"), "line 1: sdf `r`", "neither"),
        (two(ends).replace("revolute", "fixed"), "", "no joint moves"),
        (two(&format!("{ends}<mimic joint='j'/>")), "line 4: joint `j`", "follows itself"),
    ];
    for (text, place, words) in cases {
        let message = error_of(&text).to_string();
        assert!(message.starts_with(place) && message.contains(words), "{message}\n{text}");
    }
    import(&two(ends)).expect("the same without a defect");
}

#[test]
fn cycles_second_parents_and_second_roots_are_named() {
    let link = |name: &str| format!("<link name='{name}'/>");
    let joint = |name: &str, parent: &str, child: &str| {
        format!(
            "<joint name='{name}' type='fixed'><parent link='{parent}'/><child link='{child}'/></joint>\n"
        )
    };
    let robot = |joints: &[(&str, &str)]| {
        let joints = joints.iter().enumerate();
        let joints: String = joints.map(|(i, (a, b))| joint(&format!("j{i}"), a, b)).collect();
        format!("<robot name='r'>{}{joints}</robot>", ["a", "b", "c", "d"].map(link).concat())
    };
    let problem = |joints: &[(&str, &str)]| error_of(&robot(joints)).problem;
    assert!(matches!(problem(&[("b", "c"), ("c", "d"), ("d", "b")]), Problem::Cycle(_)));
    assert_eq!(
        problem(&[("a", "b"), ("a", "c"), ("c", "b"), ("c", "d")]),
        Problem::TwoParents("b".into())
    );
    assert_eq!(problem(&[("a", "b")]), Problem::Roots(3, "a, c, d".into()));
}

#[test]
fn a_truncated_file_is_refused_wherever_it_ends() {
    let step = if cfg!(feature = "full") { 7 } else { 29 };
    for end in (0..SO101.trim_end().len()).step_by(step) {
        let Some(text) = SO101.get(..end) else {
            continue;
        };
        parse(text, Path::new(".")).expect_err("truncated");
    }
    import(SO101).expect("the whole file");
}

#[test]
fn a_file_with_a_byte_changed_is_read_or_refused() {
    let mut read = 0;
    let (step, least) = if cfg!(feature = "full") { (11, 100) } else { (41, 50) };
    for (i, byte) in (0..SO101.len())
        .step_by(step)
        .zip([b'<', b'"', b'9', b'e', b'-', b' ', 0xC3, b'&'].iter().cycle())
    {
        let mut bytes = SO101.as_bytes().to_vec();
        bytes[i] = *byte;
        let text = String::from_utf8_lossy(&bytes);
        let Ok(robot) = parse(&text, Path::new(".")) else {
            continue;
        };
        let selected = Selection::default().of(&robot).expect("all joints");
        let tree = Tree::of(&robot, &selected, Numbers::Exact).expect("they move");
        assert!(tree.bodies.iter().all(|body| body.inertia.mass.is_finite()));
        read += 1;
    }
    assert!(read > least, "{read} of the files were read");
}

#[test]
fn entities_do_not_expand() {
    let bomb = "<!DOCTYPE robot [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;'>]><robot name='&b;'/>";
    assert!(matches!(error_of(bomb).problem, Problem::Xml(_)));
    let external = "<!DOCTYPE robot SYSTEM 'file:///etc/passwd'><robot name='r'/>";
    assert!(matches!(error_of(external).problem, Problem::Xml(_)));
}

#[test]
fn huge_files_are_refused_with_their_size() {
    let links = |n: usize, kind: &str| {
        let mut text = String::from("<robot name='r'><link name='l0'/>");
        for i in 1..n {
            text += &format!(
                "<link name='l{i}'/><joint name='j{i}' type='{kind}'><parent link='l{}'/><child link='l{i}'/></joint>",
                i - 1
            );
        }
        text + "</robot>"
    };
    assert_eq!(
        error_of(&links(10_000, "revolute")).to_string(),
        "links or joints: 10000, at most 2000"
    );
    assert_eq!(
        error_of(&links(2_000, "revolute")).to_string(),
        "coordinates of a robot: 1999, at most 136"
    );
    assert_eq!(error_of(&links(2_000, "fixed")).problem, Problem::NothingMoves);
    let deep = "<robot>".repeat(100_000) + &"</robot>".repeat(100_000);
    assert!(error_of(&deep).to_string().starts_with("nested elements"));
    let long = format!("<robot name='{}'/>", "x".repeat(20 << 20));
    assert!(error_of(&long).to_string().starts_with("bytes in the file"));
    // The longest robot that is taken.
    assert_eq!(import(&links(137, "prismatic")).expect("of 136 joints").bodies.len(), 136);
}

#[test]
fn a_missing_file_is_named() {
    let error = robot_import::source::read(Path::new("no/such.urdf")).expect_err("not there");
    assert!(error.to_string().starts_with("cannot read no/such.urdf: "), "{error}");
}
