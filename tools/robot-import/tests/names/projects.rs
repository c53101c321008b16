//! Projects of any name.

use std::fmt::Write as _;

use proptest::prelude::*;
use proptest::strategy::ValueTree;

use super::compiled::{Folder, c_headers, failure, rust};
use super::drawn::runner;
use super::{Names, project};
use robot_import::project::{Project, files};

/// Names that the written files, the templates, Cargo, C or the target's linker have, too.
#[rustfmt::skip]
const WORDS: &[&str] = &[
    "robot", "model", "body", "joint", "q", "b", "n", "v", "m", "width", "gravity", "inertia", "option", "some", "ok",
    "vec", "arm", "scene", "control", "report", "board", "simulation", "marker", "main", "lib", "target", "tracking",
    "calls", "state", "status", "plant", "clock", "print", "outcome", "law", "pd", "run", "glam", "libm", "heapless",
    "nb", "serde", "panic", "assert", "union", "auto", "safe", "raw", "int", "class", "double", "printf", "memcpy",
    "c", "a--b", "a-", "a_", "x1", "joints", "spi", "digital",
];

fn robot(name: &str) -> robot_import::project::RobotFile {
    let names = Names {
        robot: name.to_owned(),
        links: ["base", "a", "b", "c"].map(str::to_owned),
        joints: ["a-b", "a.b", "l", "m"].map(str::to_owned),
        file: ["arm.urdf", "MIT"].map(str::to_owned),
    };
    names.robot_file(&names.urdf()).expect("an arm")
}

/// So many names that no word of the list is, besides all of that list.
fn draw(count: usize) -> Vec<String> {
    let mut runner = runner();
    let strategy = "[a-z][a-z0-9_-]{0,12}";
    let mut names: Vec<String> = WORDS.iter().map(|&word| word.to_owned()).collect();
    while names.len() < WORDS.len() + count {
        let name = strategy.new_tree(&mut runner).expect("a name").current();
        // Two crates and two sets of C constants of one name are not for one program.
        let same = |other: &String| other.replace('-', "_") == name.replace('-', "_");
        if files(&project(&name, robot("arm"), false)).is_ok() && !names.iter().any(same) {
            names.push(name);
        }
    }
    names
}

/// The text of a project's file.
fn text(project: &Project, path: &str) -> String {
    let files = files(project).unwrap_or_else(|error| panic!("{error}"));
    let file = files.into_iter().find(|file| file.0 == path);
    file.unwrap_or_else(|| panic!("no {path}")).1
}

/// Compiles programs and tests of firmware, and headers for C, of projects of these names. Their
/// libraries differ in the robot's file alone: one stands for all, under each name.
fn compile(names: &[String]) {
    let folder = Folder::new();
    for (path, text) in files(&project("arm", robot("arm"), false)).expect("a legal name") {
        folder.write(&path, &text);
    }
    let library = folder.0.join("library.rmeta");
    let out = format!("metadata={}", library.display());
    let crate_name = ["--crate-name", "arm", "--emit", &out];
    let said = failure(&rust("rustc", &folder.0.join("src/lib.rs"), &crate_name));
    assert_eq!(said, None);
    // An argument a line.
    let mut arguments = String::new();
    let mut root = "#![allow(dead_code, reason = \"programs in one crate\")]\n".to_owned();
    for (k, name) in names.iter().enumerate() {
        let firmware = project(name, robot(name), false);
        folder.write(&format!("m{k}.rs"), &text(&firmware, "src/main.rs"));
        folder.write(&format!("t{k}.rs"), &text(&firmware, "tests/tracking.rs"));
        let _ = writeln!(root, "mod m{k};\nmod t{k};");
        let name = name.replace('-', "_");
        let _ = writeln!(arguments, "--extern\n{name}={}", library.display());
    }
    let root = folder.write("all.rs", &root);
    folder.write("arguments", &arguments);
    let out = format!("metadata={}", folder.0.join("checked").display());
    let call = ["--test", "--emit", &out, "@arguments"];
    let said = failure(&rust("rustc", &root, &call));
    assert!(said.is_none(), "{names:?}\n{}", said.unwrap_or_default());
    let headers: Vec<String> = names
        .iter()
        .map(|name| {
            let library = project(name, robot(name), true);
            let path = format!("include/{}.h", name.replace('-', "_"));
            text(&library, &path)
        })
        .collect();
    c_headers(&headers).unwrap_or_else(|error| panic!("{names:?}\n{error}"));
}

#[test]
fn a_hundred_names_of_projects_compile() {
    compile(&draw(40));
}

#[cfg(feature = "full")]
#[test]
fn five_hundred_names_of_projects_compile() {
    compile(&draw(500));
}

#[test]
fn what_cannot_be_a_project_is_refused_in_words() {
    let names = "fn self type std core test alloc f32 u8 str bool deps build examples incremental dynamics-core embedded_hal \
                 cortex-m-rt Arm 1arm _arm -arm ärm a.b";
    for name in names.split_whitespace().chain(["", "a b", "a/b"]) {
        let error = files(&project(name, robot("arm"), false)).expect_err(name);
        assert!(error.to_string().contains("cannot be the name"), "{error}");
    }
}

/// Whole projects as Cargo checks them, in one workspace; their own is removed.
#[cfg(feature = "full")]
#[test]
fn projects_of_names_that_once_failed_pass_cargo_check() {
    use robot_import::project::create;
    use std::{env, fs, path::Path, process::Command};

    let folder = Folder::new();
    let mut members = Vec::new();
    for (name, c) in [
        ("robot", false),
        ("q", false),
        // The name of a dependency of the library is refused, too.
        ("glam", false),
        ("robot-c", true),
        ("model", true),
    ] {
        let path = folder.0.join(name);
        create(&path, &project(name, robot(name), c)).unwrap_or_else(|error| panic!("{error}"));
        let manifest = fs::read_to_string(path.join("Cargo.toml")).expect("a manifest");
        let own = "[workspace]";
        assert!(manifest.contains(own));
        let (before, _) = manifest.split_once("[profile.dev]").expect("profiles");
        fs::write(path.join("Cargo.toml"), before.replace(own, "")).expect("a manifest");
        members.push(format!("{name:?}"));
    }
    let members = members.join(", ");
    folder.write("Cargo.toml", &format!("[workspace]\nresolver = \"3\"\nmembers = [{members}]\n"));
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    fs::copy(workspace.join("Cargo.lock"), folder.0.join("Cargo.lock")).expect("a lock file");
    let cargo = env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let output = Command::new(cargo)
        .args(["check", "--quiet", "--all-targets"])
        .current_dir(&folder.0)
        .env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).join("names"))
        .env("RUSTFLAGS", "-D warnings")
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .output()
        .expect("cargo");
    assert_eq!(failure(&output), None);
}
