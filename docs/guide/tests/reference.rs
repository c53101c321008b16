//! Names of items in the guide are those of what `cargo doc` writes, which only a full run builds
//! here.
#![cfg(feature = "full")]

use std::collections::BTreeSet;
use std::fs::read_to_string;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use crate::files::{files, root};

/// Items of other crates and of written files, options, and parameters.
const OTHERS: [&str; 11] = [
    "BODY",
    "Deserialize",
    "Format",
    "I",
    "InterruptExecutor",
    "MEMORY",
    "MyRobot",
    "R",
    "Serialize",
    "T",
    "TIM2",
];

/// The crates whose items the guide names, as `cargo` and as `rustdoc` call them.
const CRATES: [(&str, &str); 4] = [
    ("dynamics-core", "dynamics_core"),
    ("motion-control", "motion_control"),
    ("joint-drivers", "joint_drivers"),
    ("identification", "identification"),
];

/// The names of items, `Type::member` and variants in what `cargo doc` writes.
static NAMES: LazyLock<BTreeSet<String>> = LazyLock::new(|| {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().expect("the target's directory");
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["doc", "--quiet", "--no-deps"]);
    cargo.args(CRATES.iter().flat_map(|(package, _)| ["--package", package]));
    cargo.arg("--target-dir");
    assert!(cargo.arg(target).status().expect("cargo").success());
    let mut names = BTreeSet::new();
    for (_, library) in CRATES {
        let folder = target.join("doc").join(library);
        let all = read_to_string(folder.join("all.html")).expect("the list of all items");
        for page in between(&all, "href=\"", '"') {
            let file: Vec<&str> = page.rsplit('/').next().expect("a name").split('.').collect();
            let &[_, item, "html"] = file.as_slice() else {
                continue;
            };
            names.insert(item.to_owned());
            let text = read_to_string(folder.join(page)).expect("the page of an item");
            for id in between(&text, "id=\"", '"') {
                if let Some((kind, member)) = id.split_once('.') {
                    names.insert(format!("{item}::{member}"));
                    names.extend((kind == "variant").then(|| member.to_owned()));
                }
            }
        }
    }
    // The constants of an imported robot's file, and of a written project.
    let written = files(&root().join("tools/robot-import/src/write"), "rs");
    let project = files(&root().join("tools/robot-import/template/rust"), "liquid");
    for file in written.iter().chain(&project) {
        let text = read_to_string(file).expect("a source file");
        names.extend(between(&text, "pub const ", ':').map(str::to_owned));
    }
    for known in ["Engine", "Gravity::EARTH", "COUPLING", "Batch::new"] {
        assert!(names.contains(known), "{known}");
    }
    names
});

/// The items that a piece of code in a sentence names: types, constants and their members.
fn items(code: &str) -> Vec<&str> {
    let is_command =
        code.starts_with(|c: char| c.is_lowercase() || c == '-') && code.contains([' ', '=']);
    let parts = code.split(|c: char| !(c.is_alphanumeric() || "_:".contains(c)));
    parts
        .filter(|_| !is_command)
        .filter_map(|path| path.find(|c: char| c.is_uppercase()).map(|at| (path, at)))
        .filter(|&(path, at)| at == 0 || path[..at].ends_with("::"))
        .map(|(path, at)| path[at..].trim_end_matches(':'))
        .filter(|item| !OTHERS.contains(item))
        .collect()
}

/// Everything of a new project in C, which names what its users see: constants, settings, statuses.
static PROJECT_IN_C: LazyLock<String> = LazyLock::new(|| {
    let folders = ["tools/robot-import/template/c", "c"].map(|folder| root().join(folder));
    let named = ["rs", "liquid", "h", "c", "cmake", "toml"];
    let all = folders.iter().flat_map(|of| named.iter().flat_map(|extension| files(of, extension)));
    all.map(|file| file.display().to_string() + &read_to_string(&file).expect("text")).collect()
});

/// Whether a new project in C for a robot `MyArm` with a joint `elbow` and a body `forearm` names
/// an item.
fn is_of_project_in_c(item: &str) -> bool {
    let name = item.strip_prefix("MY_ARM_").unwrap_or(item);
    let name = name.strip_suffix("ELBOW").unwrap_or(name);
    let name = name.strip_suffix("FOREARM").unwrap_or(name);
    name.len() > 1 && PROJECT_IN_C.contains(name)
}

/// The files and items in the sentences of a page that do not exist.
fn unknown<'a>(prose: &'a str, sources: &[PathBuf]) -> Vec<&'a str> {
    let code = prose.split('`').skip(1).step_by(2);
    let is_file = |name: &str| name.ends_with(".rs") && !name.contains(' ');
    let is_unknown = |name: &&str| match is_file(name) {
        true => !sources.iter().any(|source| source.ends_with(name)),
        false => !NAMES.contains(*name),
    };
    let names = code.flat_map(|code| match is_file(code) {
        true => vec![code],
        false => items(code),
    });
    names.filter(is_unknown).collect()
}

#[test]
fn every_file_and_item_that_the_guide_names_exists() {
    let sources = files(&root(), "rs");
    for page in files(&root().join("docs/guide/src"), "md") {
        let text = prose(&read_to_string(&page).expect("a page"));
        let unknown = unknown(&text, &sources);
        let is_unknown = |item: &&str| !page.ends_with("c.md") || !is_of_project_in_c(item);
        let unknown: Vec<&str> = unknown.into_iter().filter(is_unknown).collect();
        assert!(unknown.is_empty(), "{}: {unknown:?}", page.display());
    }
    assert!(is_of_project_in_c("MY_ARM_MOST_POINTS"));
    assert!(!is_of_project_in_c("MY_ARM_MOST_PLACES"));
    let wrong = "`Gravity::VENUS` and `algorithms::Lost<R>` in `lost.rs`, `Gains` in `rnea.rs`, \
        `cargo -E x.rs`";
    assert_eq!(unknown(wrong, &sources), ["Gravity::VENUS", "Lost", "lost.rs"]);
}

/// A page without its blocks of code.
fn prose(page: &str) -> String {
    let mut outside = true;
    let lines = page.lines().filter(|line| {
        let is_fence = line.trim_start().starts_with("```");
        outside ^= is_fence;
        outside && !is_fence
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// The text between each occurrence of `begin` and the next `end`.
fn between<'a>(text: &'a str, begin: &'a str, end: char) -> impl Iterator<Item = &'a str> {
    text.split(begin).skip(1).filter_map(move |rest| Some(rest.split_once(end)?.0))
}
