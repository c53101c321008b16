//! Tables of the guide that tests write: what is between `<!-- NAME:begin -->` and
//! `<!-- NAME:end -->` of a page.

use std::path::PathBuf;

/// The variable that makes [`Table::check`] write the table.
const WRITE: &str = "TABLES_WRITE";

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
    /// The page.
    ///
    /// # Panics
    /// If it cannot be read.
    pub fn read(self) -> String {
        let path = self.path();
        std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
    }

    /// Compares the rows with those of the page; with `TABLES_WRITE=1` it writes them.
    ///
    /// # Panics
    /// If they differ, if the page cannot be read or written, or if it has no such markers.
    pub fn check(self, rows: &str) {
        let (page, fresh) = (self.read(), self.text(rows));
        let [before, written, after] = self.parts(&page);
        if std::env::var_os(WRITE).is_some() {
            std::fs::write(self.path(), format!("{before}{fresh}{after}")).expect("written");
        } else {
            let why = format!("{}: not what was observed: {WRITE}=1 writes it", self.page);
            assert_eq!(written, fresh, "{why}");
        }
    }

    /// The rows with what stands between them and the markers.
    pub fn text(self, rows: &str) -> String {
        let test = self.test;
        format!("<!-- written by {test} with {WRITE}=1: do not edit -->\n\n{rows}\n")
    }

    /// The text up to the begin marker, between the markers, and from the end marker on.
    ///
    /// # Panics
    /// If a marker is missing.
    pub fn parts(self, page: &str) -> [&str; 3] {
        let begin = format!("<!-- {}:begin -->\n", self.name);
        let end = format!("<!-- {}:end -->\n", self.name);
        let place = |marker| page.find(marker).unwrap_or_else(|| panic!("no {marker}"));
        let (first, last) = (place(&begin) + begin.len(), place(&end));
        [&page[..first], &page[first..last], &page[last..]]
    }

    fn path(self) -> PathBuf {
        let guide = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/guide/src");
        PathBuf::from(guide).join(self.page)
    }
}
