//! One name per algorithm: none is a variant of another by its name.
//!
//! Read are the public functions of `algorithms`, the public methods of `Core` and `Engine`, the
//! methods of public traits in these rooms, and the public methods of other types there that take a
//! robot; apart from them those of `loops` and `clusters`. Accessors of results are not.

use std::fs;
use std::path::Path;

/// Endings of names for variants that a type of the argument or a parameter of `Core` and `Engine`
/// replaces: sines and cosines computed before, another kernel.
const VARIANTS: [&str; 2] = ["_at", "_by"];

/// The contents of an item at the left margin.
#[derive(Clone, Copy, PartialEq)]
enum Block {
    /// The methods of `Core`, `Engine` or `Clustered`.
    Marker,
    /// The methods of a public trait.
    Trait,
    /// The methods of another type.
    Other,
}

/// The name that a line defines behind `prefix`.
fn name<'a>(line: &'a str, prefix: &str) -> Option<&'a str> {
    let rest = line.strip_prefix(prefix)?;
    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_');
    Some(&rest[..end.unwrap_or(rest.len())])
}

/// The algorithms that a formatted source makes public.
fn algorithms(source: &str) -> Vec<String> {
    let (mut found, mut block) = (Vec::new(), Block::Other);
    let mut lines = source.lines().peekable();
    while let Some(line) = lines.next() {
        if line.starts_with("#[cfg(test)]") {
            break; // tests stand at the end
        }
        if line.starts_with("pub trait") {
            block = Block::Trait;
        } else if line.starts_with("impl") {
            let inherent = !line.contains(" for ");
            let marker =
                [" Core<", " Engine<", " Clustered<"].iter().any(|name| line.contains(name));
            block = if inherent && marker { Block::Marker } else { Block::Other };
        }
        if let Some(name) = name(line, "pub fn ") {
            found.push(name.to_owned());
        } else if let (Block::Trait, Some(name)) = (block, name(line, "    fn ")) {
            found.push(name.to_owned());
        } else if let Some(name) = name(line, "    pub fn ") {
            let mut signature = line.to_owned();
            while !signature.contains(['{', ';']) {
                signature += lines.next().unwrap_or("{");
            }
            if block == Block::Marker || signature.contains("robot: &") {
                found.push(name.to_owned());
            }
        }
    }
    found
}

/// The objections to these names.
fn objections(names: &[String]) -> Vec<String> {
    names
        .iter()
        .filter(|name| VARIANTS.iter().any(|ending| name.ends_with(ending)))
        .map(|name| format!("`{name}` is named as a variant of another algorithm"))
        .collect()
}

/// The algorithms of all sources at a path.
fn of(path: &Path) -> Vec<String> {
    if path.is_file() {
        return algorithms(&fs::read_to_string(path).expect("a source"));
    }
    let entries = fs::read_dir(path).expect("a directory of sources");
    entries.flat_map(|entry| of(&entry.expect("an entry").path())).collect()
}

#[test]
fn there_is_one_name_per_algorithm() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dynamics-core/src");
    let [free, core, engine, loops, clusters] =
        ["algorithms", "textbook.rs", "engine", "loops", "clusters"]
            .map(|room| of(&src.join(room)));
    let free = [free, of(&src.join("forms.rs"))].concat();
    println!("{free:?}\n{core:?}\n{engine:?}\n{loops:?}\n{clusters:?}");
    // The parser finds something: what every user calls.
    for (room, name) in [
        (&free, "crba"),
        (&core, "rnea"),
        (&engine, "rnea"),
        (&loops, "assemble"),
        (&clusters, "aba"),
    ] {
        assert!(room.iter().any(|found| found == name), "no `{name}`");
    }
    let none = Vec::<String>::new();
    let all = [free, core, engine, loops, clusters].concat();
    assert_eq!(objections(&all), none);
}

#[test]
fn a_variant_of_an_algorithms_name_is_refused() {
    let source = "pub fn crba<R>(robot: &D) {}\n\
                  pub(crate) fn inside() {}\n\
                  impl<T, K> Engine<T, K> {\n    pub fn rnea_at<R>(\n        trig: &T,\n    ) {\n    }\n\
                  \x20   fn private() {}\n}\n\
                  impl<R> Cholesky<R> {\n    pub fn get(&self) -> R {}\n    pub fn solve(&self, robot: &D) {}\n}\n\
                  pub trait Forms {\n    fn rnea_by(&self);\n}\n";
    let names = algorithms(source);
    assert_eq!(names, ["crba", "rnea_at", "solve", "rnea_by"]);
    assert_eq!(objections(&names).len(), 2);
}
