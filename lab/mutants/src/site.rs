//! One place of the code and one change to it.

use std::ops::Range;

/// The way in which the text of a site is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Another expression replaces it.
    Replace,
    /// The statement is left out.
    Delete,
    /// A function returns at its beginning.
    Return,
}

#[derive(Clone, Debug)]
pub struct Site {
    /// Its number in the environment of a test.
    pub number: u32,
    /// The path from the workspace's root.
    pub file: String,
    pub function: String,
    pub line: usize,
    /// The kind of change, by which the sample is balanced.
    pub operator: &'static str,
    pub form: Form,
    /// The bytes of the source that are changed; none for [`Form::Return`].
    pub bytes: Range<usize>,
    /// The text that replaces it.
    pub changed: String,
    /// The change in a few words; with file and function the key of its reason.
    pub change: String,
}

impl Site {
    /// A key of the site that stays the same if lines move.
    pub fn key(&self) -> String {
        format!("{}: {}: {}", self.file, self.function, self.change)
    }

    /// The text before the original one and after it.
    fn around(&self) -> (String, &'static str) {
        let on = format!("::mutant_switch::on({})", self.number);
        let changed = &self.changed;
        match self.form {
            Form::Replace => (format!("(if {on} {{ {changed} }} else {{ "), " })"),
            Form::Delete => (format!("if !{on} {{ "), " }"),
            Form::Return => (format!(" if {on} {{ return {changed}; }} "), ""),
        }
    }
}

/// The bytes that each site takes in a source with switches.
pub type Taken = Vec<(u32, Range<usize>)>;

/// A source in which the sites have switches.
pub fn rewritten(source: &str, sites: &[&Site]) -> (String, Taken) {
    let mut sites = sites.to_vec();
    // If two begin together, the longer one contains the other.
    let order = |s: &&Site| (s.bytes.start, std::cmp::Reverse(s.bytes.end), s.number);
    sites.sort_by_key(order);
    let mut written = (String::with_capacity(2 * source.len()), Taken::new());
    render(source, 0..source.len(), &sites, &mut written);
    written
}

fn render(source: &str, bytes: Range<usize>, mut sites: &[&Site], to: &mut (String, Taken)) {
    let mut at = bytes.start;
    while let [site, rest @ ..] = sites {
        to.0.push_str(&source[at..site.bytes.start]);
        let begin = to.0.len();
        let is_inside = |inner: &&&Site| inner.bytes.start < site.bytes.end;
        let (inner, after) = rest.split_at(rest.iter().take_while(is_inside).count());
        let (before, behind) = site.around();
        to.0.push_str(&before);
        render(source, site.bytes.clone(), inner, to);
        to.0.push_str(behind);
        to.1.push((site.number, begin..to.0.len()));
        (at, sites) = (site.bytes.end, after);
    }
    to.0.push_str(&source[at..bytes.end]);
}
