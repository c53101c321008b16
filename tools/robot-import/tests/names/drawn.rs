//! Drawn names of robots, links and joints.

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use super::compiled::{Batch, c_headers};
use super::{Names, project};
use robot_import::project::{RobotFile, files};
use robot_import::text::{code_span, doc_name, doc_sentence, visible};
use robot_import::write::{given_type_name, type_name};

/// Words of Rust, of C, of the library, of the written files, and texts that mean something to a
/// compiler, to Markdown or to a terminal.
#[rustfmt::skip]
const WORDS: &[&str] = &[
    "", " ", "robot", "Robot", "model", "body", "joint", "self", "Self", "crate", "super", "fn", "type", "async",
    "gen", "_", "gravity", "inertia", "coriolis", "viscous", "coulomb", "armature", "width", "arm_model",
    "joint_limits", "transmission", "b", "q", "v", "n", "m", "BASE", "SCENE", "JOINTS", "BODIES", "COUPLING", "pi",
    "option", "some", "none", "ok", "vec", "string", "box", "clone", "copy", "debug", "default", "u8", "f32", "usize",
    "str", "core", "std", "dynamics_core", "arm", "effects", "6axis", "0", "-1", "1. x", "1) x", "- x", "+ x", "# x",
    "> x", "====", "---", "***", "    x", "     let x = 1;", "\tx", "```", "```rust", "~~~", "`", "``",
    "`a` [b](c) `", "[x](http://x.y)", "[`Robot`]", "[x]: y", "http://x.y", "<b>", "<!--", "<script>", "&amp;",
    "| a | b |", "$$x$$", "\\", "\\n", "\\u{41}", "\"", "\"#", "'", "{}", "{x}", "{{robot}}", "{{ robot }}",
    "{% raw %}", "*/", "/*", "//", "///", "*/ fn evil() {} /*", "??/", "??)", "%s", "\r\n#define X", "a\nb",
    "\u{202e}x", "\u{2066}x\u{2069}", "\u{200b}", "\u{200d}", "\u{feff}x", "\u{2028}x", "\u{2029}x", "\u{85}x",
    "\u{9b}2J", "\u{ad}", "e\u{301}", "é", "Робот", "机器人", "ロボット", "🦾", "ß", "ǅ", "int", "class", "joints", "a-b",
    "a.b", "a_b", "a_b_0", "a_b_1",
];

/// A name of any kind.
fn name() -> impl Strategy<Value = String> {
    let markdown = r"[ `*_#+<>\[\]()!|~&{}\-]{0,10}[a-z0-9 .:=;/\\'\x22]{0,10}";
    prop_oneof![
        4 => prop::sample::select(WORDS).prop_map(str::to_owned),
        2 => markdown.prop_map(|name: String| name),
        2 => prop::collection::vec(any::<char>(), 0..12).prop_map(|name| name.into_iter().collect()),
        1 => "[a-zA-Z]",
        1 => "[0-9][a-z_.-]{0,6}",
        1 => "[a-z]{1,4}[-._ ][a-z0-9]{1,2}",
        1 => "[a-zA-Z_]{200,300}",
        1 => (prop::sample::select(WORDS), prop::sample::select(WORDS)).prop_map(|(a, b)| format!("{a} {b}")),
    ]
}

fn names() -> impl Strategy<Value = Names> {
    let four = || prop::array::uniform4(name());
    let file = prop::array::uniform2(name());
    (name(), four(), four(), file).prop_map(|(robot, links, joints, file)| Names {
        robot,
        links,
        joints,
        file,
    })
}

/// The same numbers, and names, in every run.
pub fn runner() -> TestRunner {
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[31; 32]);
    TestRunner::new_with_rng(Config::default(), rng)
}

/// The files of this many robots, every third of them with a loop.
fn draw(count: usize) -> Vec<(Names, RobotFile)> {
    let mut runner = runner();
    let mut drawn = Vec::new();
    let mut refused = 0;
    while drawn.len() < count {
        let names = names().new_tree(&mut runner).expect("a name").current();
        let text = match drawn.len() % 3 {
            2 => names.mjcf(),
            _ => names.urdf(),
        };
        match names.robot_file(&text) {
            Some(file) => drawn.push((names, file)),
            None => refused += 1,
        }
    }
    assert!(refused * 4 < count, "{refused} of {count} have two of one name");
    drawn
}

/// A project's name that no other number has, and that is not the start of another's.
fn number(k: usize) -> String {
    format!("p{k}x")
}

/// Compiles what is written of drawn names.
fn compiles(drawn: &[(Names, RobotFile)]) {
    let (mut batch, mut headers) = (Batch::new(), Vec::new());
    for (k, (_, robot)) in drawn.iter().enumerate() {
        let [firmware, library] = [false, true].map(|c| project(&number(k), robot.clone(), c));
        // The libraries of projects take longer: a robot of three has one, in Rust and in C by
        // turns.
        match k % 6 {
            0 => batch.project(&firmware),
            3 => batch.project(&library),
            _ => batch.file(&robot.text),
        }
        let files = files(&library).expect("a legal name");
        let header = files.into_iter().find(|(path, _)| path.starts_with("include/"));
        headers.extend(header.map(|(_, text)| text));
    }
    let names = || drawn.iter().enumerate().map(|(k, names)| format!("m{k}: {:?}\n", names.0));
    let all = |error: String| panic!("{}\n{error}", names().collect::<String>());
    batch.check().unwrap_or_else(all);
    assert_eq!(batch.doctests(), [""; 0]);
    assert_eq!(headers.len(), drawn.len());
    c_headers(&headers).map(drop).unwrap_or_else(all);
}

#[test]
fn files_of_forty_drawn_names_compile_and_document_nothing_else() {
    let drawn = draw(40);
    compiles(&drawn);
    let mut batch = Batch::new();
    drawn.iter().for_each(|(_, robot)| batch.file(&robot.text));
    batch.document().unwrap_or_else(|error| panic!("{error}"));
}

#[cfg(feature = "full")]
#[test]
fn files_of_five_hundred_drawn_names_compile() {
    draw(500).chunks(250).for_each(compiles);
}

#[test]
fn a_string_of_a_written_file_is_the_name() {
    for (names, file) in draw(40) {
        let literal = format!("Model::new({:?}", names.robot);
        assert!(file.text.contains(&literal), "{literal} in {}", file.text);
        assert!(file.joints.iter().all(|joint| { file.text.contains(&format!("{joint:?}")) }));
    }
}

#[test]
fn a_chosen_type_is_one_that_the_user_may_give() {
    let words = WORDS.iter().map(|&word| word.to_owned());
    let drawn = draw(40).into_iter().map(|(names, _)| names.robot);
    for name in words.chain(drawn) {
        assert_eq!(given_type_name(&type_name(&name)), Ok(type_name(&name)));
    }
    for name in ["", "Self", "Robot", "N", "SCENE", "Option", "robot", "1", "My_Arm", "É"] {
        assert!(given_type_name(name).is_err(), "{name}");
    }
    let error = given_type_name("Robot").expect_err("the file uses it");
    assert!(error.contains("`MyRobot` is free"), "{error}");
}

#[test]
fn no_text_in_documentation_is_markdown() {
    let mut runner = runner();
    let mut texts: Vec<String> = WORDS.iter().map(|&word| word.to_owned()).collect();
    texts.extend((0..200).map(|_| name().new_tree(&mut runner).expect("a name").current()));
    let of = |form: &dyn Fn(&str) -> String| {
        let forms = texts.iter().map(|text| form(text));
        let lines =
            forms.map(|text| format!("//! - {text}\n//!\n//! {text}\n//!\n//! x {text}\n//!\n"));
        let mut batch = Batch::new();
        batch.file(&(lines.collect::<String>() + "//! # Source\n"));
        batch.check().and_then(|()| batch.document()).map(|()| batch.doctests())
    };
    let none = Ok(Vec::new());
    assert_eq!(of(&|text| doc_name(text)), none);
    assert_eq!(of(&|text| code_span(text)), none);
    assert_eq!(of(&|text| doc_sentence(text)), none);
    assert_eq!(of(&|text| doc_sentence(&format!("Link `{text}` of `{text}`: {text}"))), none);
    assert!(of(&|text| visible(text)).is_err());
}

#[test]
fn no_word_of_a_written_file_is_its_type() {
    let plain = |robot: &str| Names {
        robot: robot.to_owned(),
        links: ["base", "a", "b", "c"].map(str::to_owned),
        joints: ["j", "k", "l", "m"].map(str::to_owned),
        file: ["arm.urdf", "MIT"].map(str::to_owned),
    };
    let arm = plain("Arm6");
    let texts = [arm.urdf(), arm.mjcf()].map(|text| arm.robot_file(&text).expect("an arm").text);
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut words: Vec<&str> = texts.iter().flat_map(|text| text.split(|c| !is_part(c))).collect();
    words.sort_unstable();
    words.dedup();
    assert!(words.contains(&"JointLimits") && words.contains(&"LOOPS"));
    let mut batch = Batch::new();
    for (k, word) in words.iter().enumerate() {
        let names = plain(word);
        let text = if k % 2 == 0 { names.urdf() } else { names.mjcf() };
        batch.file(&names.robot_file(&text).expect("an arm").text);
    }
    batch.check().unwrap_or_else(|error| panic!("{words:?}\n{error}"));
}
