//! Files and folders of one folder that use each other in a circle. A folder and the files in it are
//! not counted, nor are tests.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::read_to_string;
use std::path::Path;

use crate::files::{files, root};

/// ARCHITECTURE.md names those that are left.
const MOST: usize = 4;

/// The path of a module or an item in its crate.
type Names = Vec<String>;
type Files<T> = BTreeMap<Names, T>;

/// Words and signs, without comments, strings and modules of tests.
fn tokens(source: &str) -> Vec<String> {
    let source = source.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let lines = source.lines().map(|line| line.split("//").next().unwrap_or_default());
    let text = lines.collect::<Vec<_>>().join("\n").replace("'\"'", "").replace("\\\"", "");
    let code = text.split('"').step_by(2).collect::<Vec<_>>().join(" ").replace("::", "·");
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let spaced = |c: char| if is_word(c) { c.to_string() } else { format!(" {c} ") };
    let spaced: String = code.chars().map(spaced).collect();
    spaced.split_whitespace().map(str::to_owned).collect()
}

/// Adds the paths of the tree with which `tokens` begin, below `path`, and returns the rest.
fn paths<'a>(mut tokens: &'a [String], mut path: Names, all: &mut Vec<Names>) -> &'a [String] {
    while let [first, rest @ ..] = tokens {
        tokens = rest;
        match first.as_str() {
            "{" => {
                while tokens.first().is_some_and(|next| next != "}") {
                    tokens = paths(tokens, path.clone(), all);
                }
                return tokens.get(1..).unwrap_or_default();
            }
            "," => return tokens,
            "super" => drop(path.pop()),
            "self" | "crate" => {}
            _ => path.push(first.clone()),
        }
        match tokens {
            [sign, next, ..] if sign == "·" && next != "<" => tokens = &tokens[1..],
            _ => break,
        }
    }
    all.push(path);
    tokens
}

/// The paths that a file names.
fn named(module: &Names, source: &str, sources: &Files<String>) -> Vec<Names> {
    let (tokens, mut all) = (tokens(source), Vec::new());
    let mut rest = tokens.as_slice();
    while let [first, after @ ..] = rest {
        let child =
            || sources.contains_key(&[module.as_slice(), std::slice::from_ref(first)].concat());
        let start = match first.as_str() {
            _ if after.first().is_none_or(|next| next != "·") => None,
            "crate" => Some(Vec::new()),
            "super" | "self" => Some(module.clone()),
            _ => child().then(|| module.clone()),
        };
        rest = start.map_or(after, |start| paths(rest, start, &mut all));
    }
    all
}

/// The module that defines what a path names, through the imports on its way.
fn defined(path: &[String], all: &Files<Vec<Names>>, depth: usize) -> Names {
    let known = (0..=path.len()).rev().find(|&n| all.contains_key(&path[..n])).unwrap_or(0);
    let (module, rest) = path.split_at(known);
    let import = rest.first().and_then(|name| {
        let mut imports = all.get(module)?.iter();
        imports.find(|import| import.last() == Some(name) && import.as_slice() != path)
    });
    match import {
        Some(import) if depth > 0 => defined(&[import, &rest[1..]].concat(), all, depth - 1),
        _ => module.to_owned(),
    }
}

/// The circles of the crate with these sources.
fn circles(sources: &Files<String>) -> BTreeSet<BTreeSet<String>> {
    let named = |(module, text): (&Names, &String)| (module.clone(), named(module, text, sources));
    let all: Files<Vec<Names>> = sources.iter().map(named).collect();
    let mut uses: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (module, path) in all.iter().flat_map(|(m, named)| named.iter().map(move |p| (m, p))) {
        let to = defined(path, &all, 8);
        let common = module.iter().zip(&to).take_while(|(a, b)| a == b).count();
        if let (Some(from), Some(to)) = (module.get(..=common), to.get(..=common)) {
            uses.entry(from.join("::")).or_default().insert(to.join("::"));
        }
    }
    for over in uses.keys().cloned().collect::<Vec<_>>() {
        let beyond = uses[&over].clone();
        for reached in uses.values_mut().filter(|reached| reached.contains(&over)) {
            reached.extend(beyond.clone());
        }
    }
    let back = |a: &String, b: &String| uses.get(b).is_some_and(|reached| reached.contains(a));
    let mutual = |(a, reached): (&String, &BTreeSet<String>)| -> BTreeSet<String> {
        reached.iter().filter(|b| back(a, b)).cloned().collect()
    };
    uses.iter().map(mutual).filter(|circle| circle.len() > 1).collect()
}

/// The sources of a crate by the paths of their modules, without programs beside it.
fn sources(src: &Path) -> Files<String> {
    let modules = files(src, "rs").into_iter().filter_map(|path| {
        let inside = path.strip_prefix(src).ok()?.with_extension("");
        let mut module: Names = inside.iter().map(|part| part.to_string_lossy().into()).collect();
        module.pop_if(|file| matches!(file.as_str(), "mod" | "lib" | "main"));
        let counts = !module.iter().any(|part| part == "tests" || part == "bin");
        counts.then(|| (module, read_to_string(&path).expect("a file")))
    });
    modules.collect()
}

#[test]
fn at_most_four_circles_of_files_are_left() {
    let is_root = |path: &Path| path.ends_with("src/lib.rs") || path.ends_with("src/main.rs");
    let roots = files(&root(), "rs").into_iter().filter(|path| is_root(path));
    let folders: BTreeSet<_> = roots.filter_map(|path| Some(path.parent()?.to_owned())).collect();
    let found = folders.iter().flat_map(|src| {
        circles(&sources(src))
            .into_iter()
            .map(move |circle| format!("{}: {circle:?}", src.display()))
    });
    let found: Vec<String> = found.collect();
    assert!(found.len() <= MOST, "{} circles of files:\n{}", found.len(), found.join("\n"));
}

#[test]
fn a_circle_through_an_export_is_found() {
    let of = |c: &str| {
        let files = [("", "pub use b::{B, c::C};"), ("a", "use crate::B;"), ("b::c", c)];
        let files = [files.as_slice(), &[("b", "mod c; pub use c::{X as Y, C};")]].concat();
        let names =
            |path: &str| path.split("::").filter(|x| !x.is_empty()).map(str::to_owned).collect();
        circles(&files.iter().map(|(path, text)| (names(path), text.to_string())).collect())
    };
    assert_eq!(of("use super::B; // use crate::a::A;"), BTreeSet::new());
    assert_eq!(of("fn f() -> crate::a::A { \"\" }").len(), 1);
}
