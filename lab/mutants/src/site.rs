//! One place of the code and one change to it.

use std::ops::Range;

/// How the text of a site is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// An expression by another one.
    Replace,
    /// A statement by none.
    Delete,
    /// A function returns at its beginning.
    Return,
}

/// The kinds of changes, by which the sample is balanced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Operator {
    /// `+`, `-`, `*`, `/`, `%`, shifts, and the signs.
    Arithmetic,
    /// `<`, `==`, …
    Comparison,
    /// `&&`, `|`, `!`, conditions.
    Logic,
    /// Numbers and `true`, `false`.
    Literal,
    /// Statements that are left out.
    Statement,
    /// Functions that return a constant at once, or `None` for `Some`.
    Return,
    /// A method by its counterpart, such as `min` and `max`.
    Method,
}

/// One change.
#[derive(Clone, Debug)]
pub struct Site {
    /// Its number in the environment of a test.
    pub number: u32,
    /// The path from the workspace's root.
    pub file: String,
    /// The function that contains it.
    pub function: String,
    pub line: usize,
    pub operator: Operator,
    pub form: Form,
    /// The bytes of the source that are changed; none for [`Form::Return`].
    pub bytes: Range<usize>,
    /// What stands there instead.
    pub changed: String,
    /// The change in a few words; with file and function the key of its reason.
    pub change: String,
}

impl Site {
    /// What names the site even if lines move.
    pub fn key(&self) -> String {
        format!("{}: {}: {}", self.file, self.function, self.change)
    }

    /// The text before the original one and after it.
    fn around(&self) -> (String, &'static str) {
        let (on, changed) = (
            format!("::mutant_switch::on({})", self.number),
            &self.changed,
        );
        match self.form {
            Form::Replace => (format!("(if {on} {{ {changed} }} else {{ "), " })"),
            Form::Delete => (format!("if !{on} {{ "), " }"),
            Form::Return => (format!(" if {on} {{ return {changed}; }} "), ""),
        }
    }
}

/// A source in which the sites have switches, and the bytes that each of them takes there.
pub fn rewritten(source: &str, sites: &[&Site]) -> (String, Vec<(u32, Range<usize>)>) {
    let mut sites = sites.to_vec();
    // Of two that begin together, the longer one contains the other.
    sites.sort_by_key(|site| {
        (
            site.bytes.start,
            std::cmp::Reverse(site.bytes.end),
            site.number,
        )
    });
    let (mut text, mut places) = (String::with_capacity(2 * source.len()), Vec::new());
    render(source, 0..source.len(), &sites, &mut text, &mut places);
    (text, places)
}

fn render(
    source: &str,
    bytes: Range<usize>,
    mut sites: &[&Site],
    text: &mut String,
    places: &mut Vec<(u32, Range<usize>)>,
) {
    let mut at = bytes.start;
    while let [site, rest @ ..] = sites {
        text.push_str(&source[at..site.bytes.start]);
        let begin = text.len();
        let inside = rest
            .iter()
            .take_while(|inner| inner.bytes.start < site.bytes.end);
        let (inner, after) = rest.split_at(inside.count());
        let (before, behind) = site.around();
        text.push_str(&before);
        render(source, site.bytes.clone(), inner, text, places);
        text.push_str(behind);
        places.push((site.number, begin..text.len()));
        (at, sites) = (site.bytes.end, after);
    }
    text.push_str(&source[at..bytes.end]);
}
