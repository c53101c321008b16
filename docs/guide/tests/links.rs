//! Links and names in the documents refer to something that exists: files, headings, items that `cargo doc` writes.

use std::collections::BTreeSet;
use std::fs::read_to_string;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

/// Items of other crates and of written files, options, and parameters.
const OTHERS: [&str; 9] = [
    "BODY",
    "Deserialize",
    "Format",
    "I",
    "InterruptExecutor",
    "MyRobot",
    "PYTHONPATH",
    "R",
    "Serialize",
];

pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

pub fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in folder.read_dir().expect("a folder") {
        let path = entry.expect("an entry").path();
        let is_hidden = path
            .file_name()
            .is_some_and(|name| name.as_encoded_bytes()[0] == b'.');
        if path.is_dir() && !is_hidden && !path.ends_with("target") {
            found.append(&mut files(&path, extension));
        } else if path.extension().is_some_and(|found| found == extension) {
            found.push(path);
        }
    }
    found
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

/// What stands between each occurrence of `begin` and the next `end`.
pub fn between<'a>(text: &'a str, begin: &'a str, end: char) -> impl Iterator<Item = &'a str> {
    text.split(begin)
        .skip(1)
        .filter_map(move |rest| Some(rest.split_once(end)?.0))
}

/// The anchor of a heading.
fn slug(heading: &str) -> String {
    let kept = |c: char| c.is_alphanumeric() || "-_ ".contains(c);
    let text = heading.trim_start_matches('#').trim().to_lowercase();
    text.chars()
        .filter(|&c| kept(c))
        .collect::<String>()
        .replace(' ', "-")
}

/// Whether the target of a link in `page` exists.
fn leads_somewhere(page: &Path, link: &str) -> bool {
    if link.contains("://") || link.starts_with("mailto:") {
        return true;
    }
    let (path, anchor) = link.split_once('#').unwrap_or((link, ""));
    if let Some((_, item)) = path.split_once("doc/") {
        let id = format!("id=\"{anchor}\"");
        let page = DOCUMENTED
            .pages
            .contains(item)
            .then(|| read_to_string(reference().join(item)));
        return page.is_some_and(|page| anchor.is_empty() || page.expect("a page").contains(&id));
    }
    let target = match path {
        "" => page.to_owned(),
        path => page.with_file_name(path),
    };
    let has_heading = || {
        let text = prose(&read_to_string(&target).expect("text"));
        let named = text.contains(&format!("<a id=\"{anchor}\"></a>"));
        let mut lines = text.lines();
        named || lines.any(|line| line.starts_with('#') && slug(line) == anchor)
    };
    target.exists() && (anchor.is_empty() || has_heading())
}

/// The crates whose items the guide names, as `cargo` and as `rustdoc` call them.
const CRATES: [(&str, &str); 4] = [
    ("dynamics-core", "dynamics_core"),
    ("motion-control", "motion_control"),
    ("joint-drivers", "joint_drivers"),
    ("identification", "identification"),
];

/// Where `cargo doc` writes.
fn reference() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("doc")
}

/// What `cargo doc` wrote: its pages, and the names of items, `Type::member` and variants.
struct Documented {
    pages: BTreeSet<String>,
    names: BTreeSet<String>,
}

static DOCUMENTED: LazyLock<Documented> = LazyLock::new(|| {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .parent()
        .expect("the target's directory");
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["doc", "--quiet", "--no-deps"]);
    cargo.args(
        CRATES
            .iter()
            .flat_map(|(package, _)| ["--package", package]),
    );
    cargo.arg("--target-dir");
    assert!(cargo.arg(target).status().expect("cargo").success());
    let (mut pages, mut names) = (BTreeSet::new(), BTreeSet::new());
    for (_, library) in CRATES {
        let folder = reference().join(library);
        let all = read_to_string(folder.join("all.html")).expect("the list of all items");
        for page in between(&all, "href=\"", '"') {
            let file: Vec<&str> = page
                .rsplit('/')
                .next()
                .expect("a name")
                .split('.')
                .collect();
            let &[_, item, "html"] = file.as_slice() else {
                continue;
            };
            pages.insert(format!("{library}/{page}"));
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
    // The constants of an imported robot's file.
    for file in files(&root().join("robot-import/src/write"), "rs") {
        let text = read_to_string(&file).expect("a source file");
        names.extend(between(&text, "pub const ", ':').map(str::to_owned));
    }
    // Classes of Python.
    for file in files(&root().join("python"), "py") {
        let text = read_to_string(&file).expect("a source file");
        let classes = between(&text, "\nclass ", ':').filter_map(|class| class.split('(').next());
        names.extend(classes.map(str::to_owned));
    }
    for known in ["Engine", "Gravity::EARTH", "COUPLING", "Batch::new"] {
        assert!(names.contains(known), "{known}");
    }
    Documented { pages, names }
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
    let template = root().join("robot-import/template/c");
    let named = ["rs", "liquid", "h", "c", "cmake", "toml"];
    let all = named
        .iter()
        .flat_map(|extension| files(&template, extension));
    all.map(|file| file.display().to_string() + &read_to_string(&file).expect("text"))
        .collect()
});

/// Whether a new project in C for a robot `MyArm` with a joint `elbow` and a body `forearm` names an item.
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
        false => !DOCUMENTED.names.contains(*name),
    };
    let names = code.flat_map(|code| match is_file(code) {
        true => vec![code],
        false => items(code),
    });
    names.filter(is_unknown).collect()
}

// Links lead to a file, a heading or an item.
#[test]
fn every_link_resolves() {
    let mut count = 0;
    // The templates of generated pages are not pages: their links are relative to `docs`.
    let is_template = |page: &PathBuf| page.starts_with(root().join("xtask"));
    for page in files(&root(), "md")
        .into_iter()
        .filter(|page| !is_template(page))
    {
        let text = prose(&read_to_string(&page).expect("a page"));
        for link in between(&text, "](", ')') {
            assert!(leads_somewhere(&page, link), "{}: {link}", page.display());
            count += 1;
        }
    }
    assert!(count > 50, "{count} links");
    let page = root().join("docs/guide/src/tuning.md");
    assert!(leads_somewhere(&page, "effects.md#signs"));
    assert!(leads_somewhere(
        &page,
        "doc/dynamics_core/struct.Engine.html#method.rnea"
    ));
    for dead in [
        "effect.md",
        "effects.md#sings",
        "doc/dynamics_core/struct.Motor.html",
        "doc/dynamics_core/struct.Engine.html#method.id",
    ] {
        assert!(!leads_somewhere(&page, dead), "{dead}");
    }
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
    let wrong = "`Gravity::VENUS` and `algorithms::Lost<R>` in `lost.rs`, `Gains` in `rnea.rs`, `cargo -E x.rs`";
    assert_eq!(
        unknown(wrong, &sources),
        ["Gravity::VENUS", "Lost", "lost.rs"]
    );
}

#[test]
fn every_page_is_listed_and_its_code_compiled() {
    let pages = root().join("docs/guide");
    let list = read_to_string(pages.join("src/SUMMARY.md")).expect("the list");
    let compiled = read_to_string(pages.join("lib.rs")).expect("the library");
    for page in files(&pages.join("src"), "md") {
        let name = page
            .file_name()
            .and_then(|name| name.to_str())
            .expect("a name");
        assert!(
            name == "SUMMARY.md" || list.contains(&format!("({name})")),
            "{name}"
        );
        let has_code = read_to_string(&page).expect("a page").contains("```rust\n");
        assert!(
            !has_code || compiled.contains(&format!("\"{name}\"")),
            "{name}"
        );
    }
}

#[test]
fn the_reference_has_the_mathml_of_each_equation_of_a_page() {
    let mut count = 0;
    for page in &DOCUMENTED.pages {
        let text = read_to_string(reference().join(page)).expect("a page");
        let typeset = text.matches("$$</p>\n<div class=\"equation\">").count();
        assert_eq!(text.matches("<math").count(), typeset, "{page}");
        assert_eq!(text.matches("$$").count(), 2 * typeset, "{page}");
        count += typeset;
    }
    assert!(count > 20, "{count} equations");
}
