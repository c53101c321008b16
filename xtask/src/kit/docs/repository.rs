//! For tests: the pages of the repository.

use std::path::{Path, PathBuf};

/// The rows of the tables in a page, without their headings.
pub fn rows_of(page: &str) -> Vec<Vec<&str>> {
    let cells = |line| crate::kit::docs::cells(line);
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

/// A file of the repository.
pub fn read(file: impl AsRef<Path>) -> String {
    let path = root().join(file);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}
