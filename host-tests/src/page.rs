//! Tables of the guide that tests write: what is between `<!-- NAME:begin -->` and
//! `<!-- NAME:end -->` of a page.

use std::path::PathBuf;

/// The variable that makes tests write their tables. What they hold without it are bounds.
const WRITE: &str = "TABLES_WRITE";

/// Whether the tables are to be written.
pub fn is_wanted() -> bool {
    std::env::var_os(WRITE).is_some()
}

/// A table in a page of the guide.
#[derive(Clone, Copy, Debug)]
pub struct Table {
    /// The file, in `docs/guide/src`.
    pub page: &'static str,
    /// The name in the markers.
    pub name: &'static str,
    /// The test that writes it, from the root of the repository.
    pub test: &'static str,
}

impl Table {
    /// Writes the rows with `TABLES_WRITE=1`.
    ///
    /// # Panics
    /// If the page cannot be read or written, or if it has no such markers.
    pub fn write(self, rows: &str) {
        if !is_wanted() {
            return;
        }
        let guide = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/guide/src");
        let path = PathBuf::from(guide).join(self.page);
        let page = std::fs::read_to_string(&path).expect("a page");
        let marker = |end| format!("<!-- {}:{end} -->\n", self.name);
        let (before, rest) = page.split_once(&marker("begin")).expect("a marker of its begin");
        let (_, after) = rest.split_once(&marker("end")).expect("a marker of its end");
        let by = format!("<!-- written by {} with {WRITE}=1: do not edit -->", self.test);
        let (begin, end) = (marker("begin"), marker("end"));
        let page = format!("{before}{begin}{by}\n\n{rows}\n{end}{after}");
        std::fs::write(&path, page).expect("written");
    }
}
