//! Descriptions as the readers of their formats take them: encodings, XML that is not well-formed,
//! numbers without an end.

use std::fs;
use std::path::Path;
use std::time::Duration;

use crate::hostile::time;
use robot_import::description::{Description, Kind};
use robot_import::error::ImportError;
use robot_import::source::{parse, read, read_below};

const LINKS: &str = "<link name='base'/><link name='rod'><inertial><origin xyz='0.1 0 -0.25'/><mass value='1.5'/>\
    <inertia ixx='0.02' ixy='0' ixz='0' iyy='0.02' iyz='0' izz='0.001'/></inertial></link>";
const JOINT: &str = "<joint name='swing' type='revolute'><parent link='base'/><child link='rod'/><axis xyz='0 1 0'/>\
    <limit lower='-2.5' upper='2.5' effort='20' velocity='8'/></joint>";
const BODY: &str = "<body name='rod'><joint name='swing' axis='0 1 0' range='-140 140'/>\
    <inertial pos='0.1 0 -0.25' mass='1.5' diaginertia='0.02 0.02 0.001'/></body>";

fn urdf() -> String {
    format!("<robot name='r'>\n{LINKS}\n{JOINT}\n</robot>")
}

fn mjcf() -> String {
    format!("<mujoco>\n<worldbody>\n{BODY}\n</worldbody></mujoco>")
}

fn of(text: &str) -> Result<Description, ImportError> {
    parse(text, Path::new("."))
}

/// One joint and 1.5 kg.
fn is_whole(robot: &Description) {
    let joints: Vec<&str> = robot.joints.iter().map(|joint| joint.name.as_str()).collect();
    assert_eq!(joints, ["swing"]);
    let masses = robot.links.iter().filter_map(|link| link.inertial);
    assert_eq!(masses.map(|own| own.mass).sum::<f64>(), 1.5);
}

/// Texts that TinyXML-2 takes, by trying urdfdom in Pinocchio 4.1.0 and MuJoCo 4.0.0: a text, and
/// what the note says of it.
fn tolerated(text: &str) -> Vec<(String, &'static str)> {
    let inside = |what: &str| text.replacen('\n', &format!("\n{what}"), 1);
    vec![
        (format!("\n<?xml version='1.0'?>\n{text}"), "Line 2: white space before the declaration"),
        (
            format!("\n\n  \t<?xml version='1.0' encoding='utf-8'?>{text}"),
            "Line 3: white space before the declaration",
        ),
        (format!("exported\n{text}"), "Line 1: a text before the root"),
        (inside("<!-- ---- mount -- plate ---- -->"), "Line 2: `--` in a comment"),
        (inside("<!-- a --->"), "Line 2: `--` in a comment"),
        (format!("<!-- a -- b -->{text}"), "Line 1: `--` in a comment"),
        (inside("<!DOCTYPE robot>"), "Line 2: a document type"),
        (format!("<!DOCTYPE robot>{text}"), "Line 1: a document type"),
        (
            format!("<?xml version='1.0'?>\n<!DOCTYPE robot [<!ELEMENT robot ANY>]>{text}"),
            "Line 2: a document type",
        ),
        (inside("<!made by hand>"), "Line 2: markup"),
        (inside("a & b"), "Line 2: an `&`"),
        (inside("]]>"), "Line 2: `]]>`"),
        (format!("{text}\n</robot>"), "after the end of the root, which is left out, `</robot>`"),
        (
            format!("{text}</mujoco>\n</mujoco>"),
            "after the end of the root, which is left out, `</mujoco>`",
        ),
        (format!("{text}\n<other/>"), "after the end of the root, which is left out, `<other/>`"),
        (
            format!("{text}\nend & <of> file"),
            "after the end of the root, which is left out, `end & <of>`",
        ),
        (
            text.replace("axis='0 1 0' ", "axis='0 1 0'").replace("lower='-2.5' ", "lower='-2.5'"),
            "no space between two attributes",
        ),
    ]
}

#[test]
fn what_tinyxml_takes_is_read_and_noted() {
    for text in [urdf(), mjcf()] {
        is_whole(&of(&text).expect("well-formed"));
        assert_eq!(of(&text).expect("well-formed").notes, [""; 0]);
        for (text, words) in tolerated(&text) {
            let robot = of(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
            is_whole(&robot);
            assert_eq!(robot.notes.len(), 1, "{:#?}", robot.notes);
            assert!(
                robot.notes[0].contains(words) && robot.notes[0].contains("TinyXML-2"),
                "{}",
                robot.notes[0]
            );
        }
    }
}

#[test]
fn characters_in_attributes_are_read_as_they_stand() {
    let cases = [
        ("arms&tools", "arms&tools", "an `&`"),
        ("a&foo;b", "a&foo;b", "an `&`"),
        ("&", "&", "an `&`"),
        ("a<b", "a<b", "a `<` in the value"),
        ("a&amp;b&#65;&#x42;", "a&bAB", ""),
    ];
    for (name, read, note) in cases {
        let robot = of(&urdf().replace("'swing'", &format!("'{name}'")))
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(robot.joints[0].name, read);
        assert_eq!(robot.notes.len(), usize::from(!note.is_empty()), "{:?}", robot.notes);
        assert!(robot.notes.iter().all(|other| other.contains(note)), "{:?}", robot.notes);
    }
}

#[test]
fn undeclared_prefixes_are_names_like_others() {
    let with = |inside: &str| urdf().replace("</robot>", &format!("{inside}</robot>"));
    for inside in [
        "<gazebo><plugin name='p'><ros:namespace>/left</ros:namespace></plugin></gazebo>",
        "<gazebo>\n<gz:system gz:rate='f' ns2:a='b'/></gazebo>",
    ] {
        let robot = of(&with(inside)).unwrap_or_else(|error| panic!("{error}"));
        is_whole(&robot);
        assert!(
            robot
                .notes
                .iter()
                .all(|note| note.contains("a prefix of a name that is not declared, `")),
            "{:?}",
            robot.notes
        );
    }
    let robot = of(&urdf().replace("<axis", "<axis foo:bar='high'")).expect("an attribute");
    assert!(robot.notes[0].contains("`foo`"), "{:?}", robot.notes);
    // Drake's own elements of the names of URDF are none of URDF, declared or not.
    for declared in ["", " xmlns:drake='http://drake.mit.edu'"] {
        let text = with("<drake:joint name='swing' type='planar'/>")
            .replace("<robot", &format!("<robot{declared}"));
        let robot = of(&text).expect("a robot");
        is_whole(&robot);
        assert!(robot.notes.iter().any(|note| note.contains("<drake:joint>")), "{:?}", robot.notes);
    }
    // Declared below the root, and used there, is well-formed.
    let robot = of(&with("<gazebo xmlns:a='u'><a:b a:c='d'/></gazebo>")).expect("declared");
    assert_eq!(robot.notes, [""; 0]);
    let robot = of(&with("<gazebo xmlns:a='u'/><gazebo><a:b/></gazebo>")).expect("used elsewhere");
    assert_eq!(robot.notes.len(), 1, "{:?}", robot.notes);
    // A default namespace changes nothing.
    is_whole(&of(&urdf().replace("<robot", "<robot xmlns='http://www.ros.org'")).expect("a robot"));
    // MuJoCo refuses them.
    let error = of(&mjcf().replace("<body", "<foo:body/><body")).expect_err("of MJCF");
    assert!(error.to_string().contains("`foo:body`"), "{error}");
    let error = of(&mjcf().replace("<joint", "<joint foo:damping='3'")).expect_err("of MJCF");
    assert!(error.to_string().contains("`foo:damping`"), "{error}");
}

#[test]
fn what_no_reader_takes_is_refused_at_its_line() {
    let inside = |what: &str| urdf().replacen('\n', &format!("\n{what}"), 1);
    let cases = [
        (inside("<!-- no end"), 2, "a comment that begins in column 1 has no end"),
        (inside("<![CDATA[ no end"), 2, "a section of characters"),
        (inside("  <link name='x"), 2, "at 2:28"),
        (format!("<!-- c -->\n<?xml version='1.0'?>{}", urdf()), 2, "declaration"),
        (inside("<link name='x' name='y'/>"), 2, "is already defined"),
        (inside("<link name=x/>"), 2, ""),
        ("\n<?xml version='1.0'?>\n<robot name='r'>&&&<a></b></robot>".to_owned(), 3, "at 3:23"),
        (format!("<!DOCTYPE robot [<!ENTITY a 'b'>]>{}", urdf()), 1, "remove the <!DOCTYPE>"),
        (
            format!("\n<!DOCTYPE robot PUBLIC 'a' 'http://x/y.dtd'>{}", urdf()),
            2,
            "names another file",
        ),
        (format!("<!DOCTYPE robot [ %x; ]>{}", urdf()), 1, "entities"),
    ];
    for (text, line, words) in cases {
        let error = of(&text).expect_err(words);
        assert_eq!(error.place.line, line, "{error}\n{text}");
        assert!(error.to_string().contains("XML") && error.to_string().contains(words), "{error}");
    }
}

/// A file with the bytes of a text in an encoding.
fn file(bytes: &[u8]) -> tempfile::NamedTempFile {
    let file = tempfile::NamedTempFile::new().expect("a file");
    fs::write(&file, bytes).expect("a file");
    file
}

fn utf_16(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
    text.encode_utf16().flat_map(bytes).collect()
}

#[test]
fn files_are_read_in_the_encoding_that_they_declare() {
    let text = |encoding: &str| {
        let declaration = match encoding {
            "" => String::new(),
            name => format!("<?xml version='1.0' encoding=\"{name}\"?>\n"),
        };
        declaration + &urdf().replace("swing", "Drehgelenk_ä")
    };
    let latin = |encoding: &str| -> Vec<u8> {
        text(encoding).chars().map(|c| u8::try_from(u32::from(c)).expect("Latin-1")).collect()
    };
    let mark = |text: String| format!("\u{feff}{text}");
    let cases = [
        text("").into_bytes(),
        text("UTF-8").into_bytes(),
        text("utf8").into_bytes(),
        mark(text("UTF-8")).into_bytes(),
        utf_16(&mark(text("UTF-16")), u16::to_le_bytes),
        utf_16(&mark(text("UTF-16")), u16::to_be_bytes),
        utf_16(&text("UTF-16LE"), u16::to_le_bytes),
        utf_16(&text("UTF-16BE"), u16::to_be_bytes),
        utf_16(&mark(text("")), u16::to_le_bytes),
        latin("ISO-8859-1"),
        latin("latin1"),
        latin("windows-1252"),
        latin("ISO-8859-15"),
        latin("US-ASCII"),
    ];
    for bytes in cases {
        let start = String::from_utf8_lossy(&bytes[..40]).into_owned();
        let robot = read(file(&bytes).path()).unwrap_or_else(|error| panic!("{start}: {error}"));
        assert_eq!(robot.joints[0].name, "Drehgelenk_ä", "{start}");
        assert_eq!(robot.notes, [""; 0]);
    }
    let japanese =
        b"<?xml version='1.0' encoding='Shift_JIS'?><!-- \x83\x8d\x83{\x83b\x83g -->".to_vec();
    is_whole(&read(file(&[japanese, urdf().into_bytes()].concat()).path()).expect("Shift_JIS"));
}

#[test]
fn an_encoding_that_is_not_the_files_is_named() {
    let with = |encoding: &str| format!("<?xml version='1.0' encoding='{encoding}'?>\n{}", urdf());
    for name in ["EBCDIC-CP-FR", "no-such-code", "UTF-32"] {
        let error = read(file(with(name).as_bytes()).path()).expect_err(name).to_string();
        assert!(error.contains(&format!("encoding `{name}` is not known")), "{error}");
    }
    let error =
        read(file(&[0xFF, 0xFE, 0, 0, b'<', 0, 0, 0]).path()).expect_err("UTF-32").to_string();
    assert!(error.contains("`UTF-32`"), "{error}");
    // An old declaration, and bytes of Latin-1 without one.
    let robot = read(file(with("UTF-16").as_bytes()).path()).expect("UTF-8");
    assert!(robot.notes[0].contains("declares the encoding UTF-16"), "{:?}", robot.notes);
    let latin = urdf().replacen('\n', "\n<!-- 90\u{b0} -->", 1);
    let latin: Vec<u8> =
        latin.chars().map(|c| u8::try_from(u32::from(c)).expect("Latin-1")).collect();
    let robot = read(file(&latin).path()).expect("Latin-1");
    is_whole(&robot);
    assert!(robot.notes[0].contains("on line 2: it is read as windows-1252"), "{:?}", robot.notes);
    let odd = [b"\xff\xfe".as_slice(), &utf_16(&urdf(), u16::to_le_bytes), b"<"].concat();
    let error = read(file(&odd).path()).expect_err("half a character").to_string();
    assert!(error.contains("encoding"), "{error}");
}

#[test]
fn numbers_that_stand_for_no_limit_are_none() {
    let limit = |text: &str| {
        let robot =
            of(&urdf().replace("<limit lower='-2.5' upper='2.5' effort='20' velocity='8'/>", text));
        robot.unwrap_or_else(|error| panic!("{text}: {error}"))
    };
    for x in [
        "inf",
        "INF",
        "1e9",
        "1e10",
        "1e16",
        "2147483647",
        "3.4028234663852886e+38",
        "1.7976931348623157e308",
        "1e400",
    ] {
        let robot =
            limit(&format!("<limit lower='-{x}' upper='{x}' effort='{x}' velocity='{x}'/>"));
        let limits = robot.joints[0].limits;
        assert_eq!((limits.position, limits.velocity, limits.effort), (None, None, None), "{x}");
        assert_eq!(robot.joints[0].kind, Kind::Revolute);
        let note = &robot.notes[0];
        assert!(
            note.contains("`swing`")
                && ["speed", "torque", "position"].iter().all(|what| note.contains(what)),
            "{note}"
        );
    }
    let limits = limit("<limit lower='-2.5' upper='2.5' effort='1e8' velocity='9e8'/>");
    assert_eq!(limits.joints[0].limits.effort, Some(1e8));
    assert_eq!(limits.notes, [""; 0]);
    // The end that is one stays.
    let one = limit("<limit lower='-1e16' upper='0.5' effort='5' velocity='8'/>");
    assert_eq!(one.joints[0].limits.position, Some([-1e9, 0.5]));
    assert!(one.notes[0].contains("at one end"), "{:?}", one.notes);
    let robot =
        of(&mjcf().replace("range='-140 140'", "range='-inf inf' actuatorfrcrange='-1e10 1e10'"))
            .expect("MJCF");
    assert_eq!((robot.joints[0].kind, robot.joints[0].limits.effort), (Kind::Continuous, None));
    let error =
        of(&urdf().replace("effort='20'", "effort='nan'")).expect_err("no number").to_string();
    assert!(error.contains("`effort=\"nan\"`"), "{error}");
}

#[test]
fn a_number_beyond_its_bound_is_named_with_the_bound() {
    // Neither M nor inverse dynamics depends on them.
    for (name, x) in [("damping", 1e11), ("frictionloss", 9_999_999_999.0), ("armature", 1e10)] {
        let robot = of(&mjcf().replace("axis=", &format!("{name}='{x}' axis=")))
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let joint = &robot.joints[0];
        assert_eq!(joint.damping + joint.friction + joint.armature, x);
        assert!(robot.notes[0].contains("`--lock swing=0`"), "{:?}", robot.notes);
    }
    let cases = [
        (
            mjcf().replace("axis=", "damping='1e30' axis="),
            "joint `swing`: `damping` is 1e30, at most 1e18",
        ),
        (
            mjcf().replace("axis=", "frictionloss='1e30' axis="),
            "`frictionloss` is 1e30, at most 1e18",
        ),
        (mjcf().replace("axis=", "armature='-1e30' axis="), "`armature` is -1e30, at most 1e18"),
        (mjcf().replace("mass='1.5'", "mass='2e9'"), "link `rod`: `mass` is 2e9, at most 1e9"),
        (
            urdf().replace("<axis", "<dynamics friction='1e20'/><axis"),
            "joint `swing`: `friction` is 1e20, at most 1e18",
        ),
        (urdf().replace("ixz='0'", "ixz='3e10'"), "link `rod`: `ixz` is 3e10, at most 1e9"),
        (
            urdf().replace("xyz='0.1 0 -0.25'", "xyz='0.1 4e9 -0.25'"),
            "link `rod`: `xyz` is 4e9, at most 1e9",
        ),
        (urdf().replace("value='1.5'", "value='1e-320'"), "link `rod`: its mass is 1e-320 kg"),
    ];
    for (text, words) in cases {
        let error = of(&text).expect_err(words).to_string();
        assert!(error.contains(words), "{error}");
    }
}

#[test]
fn includes_are_read_below_a_folder_that_the_user_names() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let write = |name: &str, text: &str| {
        fs::create_dir_all(at(name).parent().expect("a folder")).expect("a folder");
        fs::write(at(name), text).expect("a file");
    };
    let defaults =
        "<mujocoinclude><default><joint damping='0.1' armature='0.01'/></default></mujocoinclude>";
    write("lab/common/defaults.xml", defaults);
    write("secret/defaults.xml", defaults);
    let model = |name: &str, file: &str| {
        write(name, &mjcf().replacen('\n', &format!("\n<include file='{file}'/>"), 1));
        at(name)
    };
    let absolute = at("lab/common/defaults.xml").display().to_string();
    for file in [
        "../common/defaults.xml",
        "..\\common\\defaults.xml",
        "../../lab/common/defaults.xml",
        &absolute,
    ] {
        let path = model("lab/robot/arm.xml", file);
        let error = read(&path).expect_err(file);
        assert_eq!(error.place.line, 2);
        assert!(error.to_string().contains("`--include-root FOLDER`"), "{error}");
        let robot = read_below(&path, Some(&at("lab"))).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((robot.joints[0].damping, robot.joints[0].armature), (0.1, 0.01));
        assert_eq!(robot.files, [at("lab/common/defaults.xml").canonicalize().expect("a file")]);
    }
    // Nothing else is read, also by a link of the file system, whether it is there or not.
    #[cfg(unix)]
    std::os::unix::fs::symlink(at("secret"), at("lab/common/link")).expect("a link");
    for file in [
        "../../secret/defaults.xml",
        "../../secret/none.xml",
        "../common/link/defaults.xml",
        "/etc/passwd",
        "../..",
    ] {
        let path = model("lab/robot/arm.xml", file);
        let error = read_below(&path, Some(&at("lab"))).expect_err(file).to_string();
        assert!(
            error.contains("is not below the folder of the model nor below `--include-root"),
            "{file}: {error}"
        );
    }
    // A note on an included file has its name.
    write("lab/robot/part.xml", &format!("{defaults}</x>"));
    let robot = read(&model("lab/robot/arm.xml", "part.xml")).expect("a part");
    assert!(robot.notes[0].starts_with("Included file part.xml: Line 1"), "{:?}", robot.notes);
}

/// Nothing here is quadratic in the length of a file, or takes memory that is.
#[test]
fn what_is_tolerated_takes_linear_time() {
    let attributes: String = (0..20_000).map(|i| format!(" a{i}='1'")).collect();
    let prefixes: String = (0..20_000).map(|i| format!("<p{i}:a/>")).collect();
    let declared: String = (0..20_000).map(|i| format!("<a xmlns:p{i}='u' p{i}:b='c'/>")).collect();
    let cases = [
        (
            urdf().replace("<axis", &format!("<axis{attributes}")),
            "line 3: <axis>: attributes of an element, or more: 129, at most 128",
        ),
        (
            urdf().replace("</robot>", &format!("{prefixes}</robot>")),
            "prefixes of names, or more: 65, at most 64",
        ),
        (urdf().replace("</robot>", &format!("{declared}</robot>")), "prefixes of names"),
        (
            urdf().replace("</robot>", &format!("{}</robot>", "&".repeat(1 << 20))),
            "places that are not well-formed XML",
        ),
        (
            urdf().replace("'swing'", &format!("'{}'", "<".repeat(1 << 20))),
            "places that are not well-formed XML",
        ),
        (
            urdf().replace("</robot>", &format!("{}</robot>", "<!DOCTYPE a>".repeat(50_000))),
            "places that are not",
        ),
        (format!("{}{}", "<!---->".repeat(100_000), "<robot>".repeat(600)), "nested elements"),
        ("<".repeat(1 << 20), "XML"),
        (format!("<robot {}", "a=".repeat(1 << 19)), "XML"),
    ];
    for (text, words) in cases {
        let start = time();
        let error = of(&text).expect_err(words).to_string();
        assert!(error.contains(words), "{error}");
        assert!(time() - start < Duration::from_secs(8), "{words}: {:?}", time() - start);
    }
    let gears: String = (0..20_000)
        .map(|i| {
            format!(
                "<transmission name='t{i}'><joint name='j{i}'/><actuator name='m'><mechanicalReduction>9</mechanicalReduction></actuator>\
                 </transmission><gazebo reference='l{i}'><stopCfm>1</stopCfm></gazebo>"
            )
        })
        .collect();
    let start = time();
    let robot = of(&urdf().replace("</robot>", &format!("{gears}</robot>"))).expect("a robot");
    assert!(time() - start < Duration::from_secs(8), "{:?}", time() - start);
    assert!(
        robot
            .notes
            .iter()
            .any(|note| note.starts_with("A gear of 9 on `j0`") && note.contains("and 19992 more"))
    );
}
