//! The modules of the libraries in one-way layers: a table in `lib.rs` lists them in order, and none uses a later one.
//! A module that is not in it, such as the forms for a feature, stands above all. And the packages: what ships uses
//! neither the tests nor what measures.

use std::path::Path;

use crate::kit::error::{Result, refuse_if};
use crate::kit::sources::{code, sources};
use crate::kit::workspace::{self, Use, Workspace};

/// The libraries, and the beginning of a row of the table; its first column has the names of modules in backticks. Users
/// of dynamics-core see its modules, those of motion-control see its items alone.
const LIBRARIES: [(&str, &str); 2] = [
    ("dynamics-core/src", "//! | "),
    ("motion-control/src", "// | "),
];

/// The one circle that is left: the trait `Real` names the model that its cast returns (docs/decisions/0007).
const CIRCLE: (&str, &str) = ("scalar", "model");

/// A library's modules, in order, and what it exports under a name of its own.
struct Order {
    listed: Vec<String>,
    declared: Vec<String>,
    /// An item's name at the crate's root, and its module.
    exports: Vec<(String, String)>,
    /// The functions of the crate's root itself, which every module may use.
    functions: Vec<String>,
}

/// The laboratory, and what else does not ship.
const LAB: &str = "lab";
const UNSHIPPED: [&str; 4] = ["certification", "docs/play", "host-tests", "xtask"];

/// Fails with every use against the order, of packages and of the library's modules.
pub fn check(workspace: &Workspace) -> Result<String> {
    let wrong: Vec<String> = workspace.uses.iter().filter_map(complaint).collect();
    refuse_if!(!wrong.is_empty(), "{}", wrong.join("\n"));
    modules(&workspace.root)
}

/// The complaint about a package that ships and uses one that does not. Its tests may use those of `host-tests`. What
/// a package uses through others needs no search: each of them ships, so that the same holds for it.
fn complaint(a: &Use) -> Option<String> {
    let is_unshipped = |path: &Path| UNSHIPPED.iter().any(|folder| path.starts_with(folder));
    let (by_lab, of_lab) = (a.user.starts_with(LAB), a.used.starts_with(LAB));
    let ships = !by_lab && !is_unshipped(&a.user);
    let is_wrong = ships && (of_lab || !a.is_for_tests && is_unshipped(&a.used));
    let (user, used) = (a.user.display(), a.used.display());
    // Dynamics know no controller, and neither knows a device.
    let may_use = |name: &str| a.user == Path::new("motion-control") && a.used == Path::new(name);
    let is_library = LIBRARIES
        .iter()
        .any(|(library, _)| Path::new(library).starts_with(&a.user));
    if is_library && !a.is_for_tests && !may_use("dynamics-core") {
        return Some(format!("{user}/Cargo.toml: a library uses `{used}`"));
    }
    is_wrong.then(|| format!("{user}/Cargo.toml: what ships uses `{used}`, which does not"))
}

/// Fails with every place where a module of a library uses a later one; modules within a module count as it.
fn modules(root: &Path) -> Result<String> {
    let (mut modules, mut uses, mut wrong) = (0, 0, Vec::new());
    for (library, row) in LIBRARIES {
        let library = root.join(library);
        let order = Order::read(&workspace::read(&library.join("lib.rs"))?, row)?;
        modules += order.declared.len();
        uses += order.examine(root, &library, &mut wrong)?;
    }
    refuse_if!(!wrong.is_empty(), "{}", wrong.join("\n"));
    Ok(format!("{modules} modules, {uses} uses"))
}

impl Order {
    /// Counts the uses in a library, and adds what is wrong with them.
    fn examine(&self, root: &Path, library: &Path, wrong: &mut Vec<String>) -> Result<usize> {
        let mut uses = 0;
        for path in sources(library)? {
            let inside = path.strip_prefix(library).unwrap_or(&path);
            let inside = inside.with_extension("");
            let mut names: Vec<_> = inside.iter().map(|name| name.to_string_lossy()).collect();
            names.retain(|name| name != "mod");
            let user = &*names[0];
            if user == "lib" || names.iter().any(|name| name == "tests") {
                continue;
            }
            let file = path.strip_prefix(root).unwrap_or(&path).display();
            for (line, used) in used(&workspace::read(&path)?, names.len()) {
                uses += 1;
                if let Some(complaint) = self.complaint(user, &used) {
                    wrong.push(format!("{file}:{line}: `{user}` {complaint}"));
                }
            }
        }
        Ok(uses)
    }

    /// From the source of `lib.rs`, in which a row of the table begins so.
    fn read(source: &str, row: &str) -> Result<Self> {
        let rows = source.lines().filter_map(|line| line.strip_prefix(row));
        let names = rows.flat_map(|row| {
            let cell = row.split(" | ").next().unwrap_or_default();
            cell.split('`').skip(1).step_by(2)
        });
        // Types of the crate's root, which have capitals, are exports of a module.
        let modules = names.filter(|name| name.starts_with(char::is_lowercase));
        let listed: Vec<String> = modules.map(str::to_owned).collect();
        let (mut exports, mut declared) = (Vec::new(), Vec::new());
        let text: String = code(source)
            .map(|(_, line)| line.to_owned() + " ")
            .collect();
        for statement in text.split(';') {
            // The words after its attributes and its visibility.
            let words = statement.rsplit(']').next().unwrap_or_default().trim();
            let words = words
                .trim_start_matches("pub(crate) ")
                .trim_start_matches("pub ");
            if let Some(name) = words.strip_prefix("mod ") {
                declared.push(name.to_owned());
            }
            let path = words
                .strip_prefix("use ")
                .and_then(|path| path.split_once("::"));
            if let Some((module, items)) = path {
                let items = items.split(['{', '}', ',']).map(str::trim);
                exports.extend(items.map(|item| (item.to_owned(), module.to_owned())));
            }
        }
        let functions = code(source).filter_map(|(_, line)| line.strip_prefix("fn "));
        let end = |c: char| !c.is_alphanumeric() && c != '_';
        let functions =
            functions.map(|words| words[..words.find(end).unwrap_or(words.len())].to_owned());
        let functions = functions.collect();
        refuse_if!(listed.is_empty(), "lib.rs has no table of its modules");
        let gone = listed.iter().find(|name| !declared.contains(name));
        let gone = gone.map_or("", String::as_str);
        refuse_if!(
            !gone.is_empty(),
            "the table in lib.rs lists `{gone}`, which is no module"
        );
        Ok(Self {
            listed,
            declared,
            exports,
            functions,
        })
    }

    /// The complaint about a module that uses a name of the crate's root, if there is one.
    fn complaint(&self, user: &str, used: &str) -> Option<String> {
        let export = self.exports.iter().find(|(item, _)| item == used);
        let module = export.map_or(used, |(_, module)| module);
        let place = |name: &str| self.listed.iter().position(|module| module == name);
        let place = |name: &str| place(name).unwrap_or(usize::MAX);
        let is_known = (user, module) == CIRCLE || self.functions.iter().any(|name| name == used);
        if module == "glam" || module == user || is_known || place(module) < place(user) {
            return None;
        }
        let is_module = self.declared.iter().any(|name| name == module);
        let why = if is_module {
            "comes after it"
        } else {
            "is no module"
        };
        Some(format!("uses `{module}`, which {why}"))
    }
}

/// The names of the crate's root that a source at this depth of modules uses outside its tests, each with its line.
fn used(source: &str, depth: usize) -> Vec<(usize, String)> {
    // Comments after the code of a line are ignored, and a list of paths may take several lines.
    let lines: Vec<(usize, &str)> = code(source).collect();
    let bare = |line: &str| line.split(" // ").next().unwrap_or(line).to_owned() + "\n";
    let text: String = lines.iter().map(|(_, line)| bare(line)).collect();
    let line_at = |at: usize| lines[text[..at].matches('\n').count()].0;
    let mut found = Vec::new();
    for root in ["crate::".to_owned(), "super::".repeat(depth)] {
        for (at, _) in text.match_indices(&root) {
            let is_part = |before: char| before.is_alphanumeric() || "_:".contains(before);
            if text[..at].ends_with(is_part) {
                continue;
            }
            let names = names_at(&text, at + root.len()).into_iter();
            found.extend(names.map(|(at, name)| (line_at(at), name)));
        }
    }
    found
}

/// The first names of a path, or of each path of a list in braces, with their places; none of a macro's.
fn names_at(text: &str, from: usize) -> Vec<(usize, String)> {
    let mut names = Vec::new();
    let (mut depth, mut expects, mut at) = (0, true, from);
    while let Some(letter) = text[at..].chars().next() {
        let is_name = |c: &char| c.is_alphanumeric() || "_*".contains(*c);
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 1 => expects = true,
            _ if expects && is_name(&letter) => {
                let name: String = text[at..].chars().take_while(is_name).collect();
                let end = at + name.len();
                // A macro's name, or what it is called with.
                if !text[end..].starts_with('!') && !text[..at].ends_with('$') {
                    names.push((at, name));
                }
                (expects, at) = (false, end - 1);
            }
            _ => {}
        }
        if depth == 0 && !expects || letter == ';' {
            break;
        }
        at += text[at..].chars().next().map_or(1, char::len_utf8);
    }
    names
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{complaint, modules, used};
    use crate::kit::workspace::{Use, Workspace};

    /// Two libraries, of three layers, the middle one of two files, and of two, with this text in one of the files.
    fn tree(name: &str, file: &str, text: &str) -> Result<String, String> {
        let root = std::env::temp_dir().join(format!("layers-{name}-{}", std::process::id()));
        let put = |file: &str, text: &str| {
            let path = root.join(file);
            std::fs::create_dir_all(path.parent().unwrap_or(Path::new("."))).expect("a folder");
            std::fs::write(path, text).expect("a file");
        };
        let lib = "//! A library.\n//!\n//! | module | contents |\n//! |---|---|\n//! | `scalar` | numbers |\n//! | \
                   [`model`], `control`: [`Law`] | the rest, not `scalar` |\n\n#[cfg(feature = \"form\")]\nmod \
                   form;\npub mod control;\npub mod model;\nmod scalar;\npub use control::{Law, \
                   Gate};\npub use glam;\n";
        let core = "dynamics-core/src/";
        for (file, text) in [
            ("lib.rs", lib),
            ("scalar.rs", "use crate::glam::Vec3;\n"),
            ("form.rs", "use crate::control::Law;\n"),
            ("model/mod.rs", "use crate::scalar::Real;\n"),
            (
                "model/tree.rs",
                "use super::Joint;\nuse super::super::scalar;\n",
            ),
            (
                "control.rs",
                "use crate::{model, scalar::Real};\nuse super::model::Body;\n",
            ),
        ] {
            put(&format!("{core}{file}"), text);
        }
        let lib = "// | `limits` | what may be |\n// | `safety` | what guards it |\nmod limits;\nmod safety;\npub use \
                   safety::Stop;\nfn real() {}\n";
        put("motion-control/src/lib.rs", lib);
        put("motion-control/src/limits.rs", "use crate::real;\n");
        put("motion-control/src/safety.rs", "use crate::limits;\n");
        put(file, text);
        let outcome = modules(&root).map_err(|error| error.to_string());
        std::fs::remove_dir_all(&root).expect("gone again");
        outcome
    }

    fn verdict(user: &str, used: &str, is_for_tests: bool) -> Option<String> {
        complaint(&Use {
            user: user.into(),
            used: used.into(),
            is_for_tests,
        })
    }

    #[test]
    fn what_ships_must_not_use_the_laboratory() {
        let error = verdict("firmware-demo", "lab/history", false).expect("refused");
        assert_eq!(
            error,
            "firmware-demo/Cargo.toml: what ships uses `lab/history`, which does not"
        );
        for (user, used, is_for_tests) in [
            ("identification", "lab/target", true),
            ("telemetry/pil", "host-tests", false),
            ("boards/pico2", "xtask", false),
            ("dynamics-core", "motion-control", false),
            ("motion-control", "drivers", false),
        ] {
            assert!(verdict(user, used, is_for_tests).is_some(), "{user}");
        }
        for (user, used, is_for_tests) in [
            ("firmware-demo", "drivers", false),
            ("motion-control", "dynamics-core", false),
            ("identification", "host-tests", true),
            ("host-tests/loops", "lab/target", false),
            ("lab/reports", "host-tests", false),
            ("xtask", "lab/meter", false),
        ] {
            assert_eq!(verdict(user, used, is_for_tests), None);
        }
    }

    #[test]
    fn the_workspace_names_what_its_packages_use() {
        let uses = Workspace::find().expect("a workspace").uses;
        let has = |user: &str, used: &str, is_for_tests: bool| {
            uses.iter().any(|a| {
                let names = (a.user.as_path(), a.used.as_path(), a.is_for_tests);
                names == (Path::new(user), Path::new(used), is_for_tests)
            })
        };
        assert!(has("lab/target", "lab/history", false));
        assert!(has("identification", "host-tests", true));
    }

    #[test]
    fn modules_that_use_lower_ones_pass() {
        let outcome = tree("good", "notes.txt", "").expect("in order");
        assert_eq!(outcome, "6 modules, 9 uses");
        let tests = "use crate::scalar;\n// crate::control is above.\n#[cfg(test)]\nmod tests {\n    use crate::control::Law;\n}\n";
        assert!(tree("tests", "dynamics-core/src/model/tree.rs", tests).is_ok());
    }

    #[test]
    fn a_module_that_uses_a_later_one_is_named() {
        let [core, control] = [
            "dynamics-core/src/model/tree.rs",
            "motion-control/src/limits.rs",
        ];
        let braces = "use crate::{\n    scalar,\n    control::{Law, Gate},\n};\n";
        for (file, text, what) in [
            (
                core,
                "use std::fmt;\nuse crate::control::Gate;\n",
                "2: `model` uses `control`",
            ),
            (core, braces, "3: `model` uses `control`"),
            (
                core,
                "fn f() {\n    crate::Law::new()\n}\n",
                "2: `model` uses `control`",
            ),
            (
                core,
                "use super::super::control;\n",
                "1: `model` uses `control`",
            ),
            (
                control,
                "use crate::safety::Stop;\n",
                "1: `limits` uses `safety`",
            ),
            (control, "use crate::Stop;\n", "1: `limits` uses `safety`"),
        ] {
            let error = tree("bad", file, text).expect_err(text);
            let place = Path::new(file).display();
            assert_eq!(error, format!("{place}:{what}, which comes after it"));
        }
    }

    #[test]
    fn what_is_no_module_is_refused() {
        let refused = |name, file, text| {
            tree(name, &format!("dynamics-core/src/{file}"), text).expect_err(name)
        };
        let gone = refused(
            "gone",
            "lib.rs",
            "//! | `scalar`, `model` | all |\nmod scalar;\n",
        );
        assert!(gone.contains("`model`, which is no module"), "{gone}");
        let none = refused("none", "lib.rs", "mod scalar;\n");
        assert!(none.contains("no table"), "{none}");
        let all = refused("all", "control.rs", "use crate::*;\n");
        assert!(
            all.contains("`control` uses `*`, which is no module"),
            "{all}"
        );
        let form = refused("form", "control.rs", "use crate::form;\n");
        assert!(
            form.contains("`control` uses `form`, which comes after it"),
            "{form}"
        );
    }

    #[test]
    fn what_stands_behind_a_path_is_none_of_its_names() {
        let source = "fn f() {\n    crate::a::g(b, S { c, d });\n}\n";
        assert_eq!(used(source, 1), [(2, "a".to_owned())]);
    }

    #[test]
    fn macros_and_longer_paths_are_no_modules() {
        assert_eq!(
            used("crate::each!(1);\nmy_crate::x();\na::super::b();\n", 1),
            []
        );
        assert_eq!(used("crate::$module::x();\n", 1), []);
        assert_eq!(used("$crate::a::b();\n", 2), [(1, "a".to_owned())]);
    }
}
