//! The Rust sources of a folder, and their lines of code.

use std::path::{Path, PathBuf};

use crate::kit::error::{Error, Result};

/// Every Rust source below a folder, without what cargo builds and git keeps.
pub fn sources(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(Error::file("read", folder))? {
        let path = entry.map_err(Error::file("read", folder))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        // Cargo tags what it builds; a folder of sources may be called `target` too.
        let is_built = path.join("CACHEDIR.TAG").is_file();
        if path.is_dir() && !is_built && !name.starts_with('.') {
            found.extend(sources(&path)?);
        } else if name.ends_with(".rs") {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

/// The lines of code of a source that rustfmt has written, with their numbers from 1: none that are
/// blank, comments, or of an item behind `#[cfg(test)]`.
pub fn code(source: &str) -> impl Iterator<Item = (usize, &str)> {
    enum Test {
        /// Its attribute stands at this depth; the item has not opened its brace yet.
        Announced(usize),
        /// It ends with the brace at this depth.
        Open(usize),
    }
    let mut test = None;
    let lines = source.lines().zip(1..).map(|(line, number)| (number, line));
    lines.filter(move |(_, line)| {
        let words = line.trim();
        let depth = line.len() - line.trim_start().len();
        match test {
            None if words.starts_with("#[cfg(test)]") => test = Some(Test::Announced(depth)),
            None => return !words.is_empty() && !words.starts_with("//"),
            Some(Test::Announced(from)) if words.ends_with('{') => test = Some(Test::Open(from)),
            Some(Test::Announced(from)) if depth == from && words.ends_with([';', '}']) => {
                test = None
            }
            Some(Test::Open(from)) if depth == from && words.starts_with('}') => test = None,
            Some(_) => {}
        }
        false
    })
}

#[cfg(test)]
mod tests {
    use super::{code, sources};

    #[test]
    fn sources_in_a_folder_called_target_count() {
        let folder = tempfile::tempdir().expect("a folder");
        let put = |file: &str| {
            let path = folder.path().join(file);
            std::fs::create_dir_all(path.parent().expect("a folder")).expect("made");
            std::fs::write(path, "").expect("written");
        };
        put("lab/target/lib.rs");
        put("target/CACHEDIR.TAG");
        put("target/generated.rs");
        let found = sources(folder.path()).expect("read");
        assert_eq!(found, [folder.path().join("lab/target/lib.rs")]);
    }

    #[test]
    fn blanks_comments_and_tests_are_not_counted() {
        let source = "//! A module.\n\nuse a::B;\n#[cfg(test)]\nuse c::D;\n\n/// A function.\nfn \
                      f() \
                      {\n    // Why.\n    g(); // so\n}\n\n#[cfg(test)]\n#[derive(Debug)]\nstruct \
                      S {\n    a: u8,\n}\n#[cfg(test)]\nmod tests \
                      {\n    #[test]\n    fn t() {\n    }\n}\nfn last() {}\n";
        let lines: Vec<(usize, &str)> = code(source).collect();
        let expected = [
            (3, "use a::B;"),
            (8, "fn f() {"),
            (10, "    g(); // so"),
            (11, "}"),
            (24, "fn last() {}"),
        ];
        assert_eq!(lines, expected);
    }
}
