//! For tests: what is in the repository, against the list of what commands write.

use std::path::{Path, PathBuf};

use clap::builder::TypedValueParser;

use super::generated::{Checked, FILES};

/// The rows of the tables in a page, without their headings.
pub fn rows_of(page: &str) -> Vec<Vec<&str>> {
    let cells = |line| crate::docs::columns::cells(line);
    let (mut rows, mut inside) = (Vec::new(), false);
    for line in page.lines() {
        match cells(line) {
            Some(cells) if cells[0].starts_with("---") => inside = true,
            Some(cells) if inside => rows.push(cells),
            Some(_) => {}
            None => inside = false,
        }
    }
    rows
}

/// The repository's root.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// All files below a directory of the repository.
fn below(directory: &str) -> Vec<String> {
    let entries = std::fs::read_dir(root().join(directory)).expect("a directory");
    let each = entries
        .map(|entry| entry.expect("an entry"))
        .flat_map(|entry| {
            let name = format!("{directory}/{}", entry.file_name().to_string_lossy());
            match entry.path().is_dir() {
                true => below(&name),
                false => vec![name],
            }
        });
    each.collect()
}

/// Whether a command writes it: all data and pictures, and pages that say so.
fn is_generated(name: &str) -> bool {
    if !name.ends_with(".md") {
        return true;
    }
    let text = std::fs::read_to_string(root().join(name)).expect("a page");
    text.contains("<!-- written by `")
}

#[test]
fn every_generated_file_is_compared_in_a_step_or_says_why_not() {
    let mut there = below("docs");
    // The guide is written by hand, its programs included.
    there.retain(|name| !name.starts_with("docs/guide/") && is_generated(name));
    there.push("README.md".into());
    there.sort();
    let listed: Vec<&str> = FILES.iter().map(|(name, _)| *name).collect();
    assert_eq!(there, listed);
    let steps = crate::test::names();
    let steps: Vec<String> = steps
        .possible_values()
        .expect("names")
        .map(|step| step.get_name().to_owned())
        .collect();
    for (name, checked) in FILES {
        match checked {
            Checked::Step(step) => {
                assert!(steps.iter().any(|known| known == step), "{name}: {step}")
            }
            Checked::Bars(reason) => assert!(!reason.is_empty(), "{name}"),
        }
    }
}
