//! Files and folders of one folder that use each other in a circle; a folder and what is in it are
//! not counted.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::read_to_string;
use std::path::Path;

use crate::files::{files, root};

/// They are named in ARCHITECTURE.md.
const MOST: usize = 4;

/// The path of a module in its crate.
type Module = Vec<String>;

/// A file: the paths that it names, and those that it imports, by the name that an import has.
#[derive(Default)]
struct File {
    named: Vec<Module>,
    imports: BTreeMap<String, Module>,
}

/// Words and signs, without comments, strings and modules of tests.
fn tokens(source: &str) -> Vec<String> {
    let mut text = String::new();
    for line in source.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default().lines() {
        text += line.split("//").next().unwrap_or_default();
        text.push('\n');
    }
    let text = text.replace("'\"'", "").replace("\\\"", "");
    let code: String = text.split('"').step_by(2).collect::<Vec<_>>().join(" ");
    let mut tokens: Vec<String> = Vec::new();
    let mut is_word = false;
    for c in code.chars() {
        let word = c.is_alphanumeric() || c == '_';
        match tokens.last_mut() {
            Some(last) if is_word && word || last == ":" && c == ':' => last.push(c),
            _ if c.is_whitespace() => {}
            _ => tokens.push(c.to_string()),
        }
        is_word = word;
    }
    tokens
}

/// Adds the paths of the tree at the start of `tokens`, which may have braces, and returns the rest.
fn paths<'a>(
    mut tokens: &'a [String],
    mut path: Module,
    file: &mut File,
    used: bool,
) -> &'a [String] {
    while let [first, rest @ ..] = tokens {
        tokens = rest;
        if first == "{" {
            while !tokens.is_empty() && tokens[0] != "}" {
                tokens = paths(tokens, path.clone(), file, used);
                tokens = tokens.strip_prefix(&[",".to_owned()]).unwrap_or(tokens);
            }
            return tokens.get(1..).unwrap_or_default();
        }
        match first.as_str() {
            "super" => drop(path.pop()),
            "self" | "crate" => {}
            _ => path.push(first.clone()),
        }
        let [colons, next, ..] = tokens else { break };
        if colons != "::"
            || next != "{" && !next.starts_with(|c: char| c.is_alphabetic() || c == '_')
        {
            break;
        }
        tokens = &tokens[1..];
    }
    let mut name = path.last().cloned().unwrap_or_default();
    if let [word, alias, rest @ ..] = tokens
        && word == "as"
    {
        (name, tokens) = (alias.clone(), rest);
    }
    if used {
        file.imports.insert(name, path.clone());
    }
    file.named.push(path);
    tokens
}

fn read(module: &Module, source: &str, is_module: impl Fn(&Module) -> bool) -> File {
    let (tokens, mut file) = (tokens(source), File::default());
    let mut rest = tokens.as_slice();
    while let [word, after @ ..] = rest {
        let used = word == "use";
        let first = if used { after.first() } else { Some(word) };
        let child = || [module.as_slice(), &[first.cloned().unwrap_or_default()]].concat();
        let start = match first.map(String::as_str) {
            Some("crate") => Some(Vec::new()),
            Some("super" | "self") => Some(module.clone()),
            _ => (used && is_module(&child())).then(|| module.clone()),
        };
        let is_path = used || after.first().is_some_and(|next| next == "::");
        rest = match start.filter(|_| is_path) {
            Some(start) => paths(if used { after } else { rest }, start, &mut file, used),
            None => after,
        };
    }
    file
}

/// The module in which what a path names is defined, through the imports on its way.
fn defined(path: &Module, all: &BTreeMap<Module, File>, depth: usize) -> Module {
    let mut at = Vec::new();
    for (i, name) in path.iter().enumerate() {
        at.push(name.clone());
        if all.contains_key(&at) {
            continue;
        }
        at.pop();
        return match all.get(&at).and_then(|file| file.imports.get(name)) {
            Some(import) if depth > 0 && import != path => {
                defined(&[import, &path[i + 1..]].concat(), all, depth - 1)
            }
            _ => at,
        };
    }
    at
}

/// The circles of a crate whose files have these sources.
fn circles(sources: &BTreeMap<Module, String>) -> BTreeSet<BTreeSet<String>> {
    let all: BTreeMap<Module, File> = sources
        .iter()
        .map(|(module, source)| {
            (module.clone(), read(module, source, |module| sources.contains_key(module)))
        })
        .collect();
    let mut uses: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (module, file) in &all {
        for path in &file.named {
            let to = defined(path, &all, 8);
            let common = module.iter().zip(&to).take_while(|(a, b)| a == b).count();
            if common < module.len() && common < to.len() {
                let end = |of: &Module| of[..=common].join("::");
                uses.entry(end(module)).or_default().insert(end(&to));
            }
        }
    }
    loop {
        let before: usize = uses.values().map(BTreeSet::len).sum();
        let known = uses.clone();
        for reached in uses.values_mut() {
            for at in reached.clone() {
                reached.extend(known.get(&at).cloned().unwrap_or_default());
            }
        }
        if uses.values().map(BTreeSet::len).sum::<usize>() == before {
            break;
        }
    }
    let mutual = |a: &String| {
        let back = |b: &&String| uses.get(*b).is_some_and(|reached| reached.contains(a));
        uses[a].iter().filter(back).cloned().collect::<BTreeSet<_>>()
    };
    uses.keys().map(mutual).filter(|circle| circle.len() > 1).collect()
}

/// The sources of a crate by the paths of their modules; programs beside it have none.
fn sources(src: &Path) -> BTreeMap<Module, String> {
    let modules = files(src, "rs").into_iter().filter_map(|path| {
        let inside = path.strip_prefix(src).ok()?.with_extension("");
        let mut module: Module = inside.iter().map(|part| part.to_string_lossy().into()).collect();
        if matches!(module.last()?.as_str(), "mod" | "lib" | "main") {
            module.pop();
        }
        let counts = !module.iter().any(|part| part == "tests" || part == "bin");
        counts.then(|| (module, read_to_string(&path).expect("a file")))
    });
    modules.collect()
}

#[test]
fn at_most_four_circles_of_files_are_left() {
    let roots = files(&root(), "rs")
        .into_iter()
        .filter(|path| path.ends_with("src/lib.rs") || path.ends_with("src/main.rs"));
    let folders: BTreeSet<_> = roots.filter_map(|path| Some(path.parent()?.to_owned())).collect();
    let found: Vec<String> = folders
        .iter()
        .flat_map(|src| {
            let name = src.strip_prefix(root()).unwrap_or(src).display();
            circles(&sources(src)).into_iter().map(move |circle| format!("{name}: {circle:?}"))
        })
        .collect();
    assert!(found.len() <= MOST, "{} circles of files:\n{}", found.len(), found.join("\n"));
}

#[test]
fn a_circle_through_an_export_is_found() {
    let of = |c: &str| {
        let files = [
            ("", "pub use b::{B, c::C};"),
            ("a", "use crate::B;"),
            ("b", "pub mod c; use self::c::C;"),
            ("b::c", c),
        ];
        let module = |path: &str| {
            path.split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect()
        };
        circles(&files.map(|(path, source)| (module(path), source.to_owned())).into())
    };
    assert_eq!(of("use super::B; // use crate::a::A;"), BTreeSet::new());
    assert_eq!(of("fn f() -> crate::a::A { \"\" }").len(), 1);
}
