//! Texts that TinyXML-2, the reader of urdfdom and of MuJoCo, takes although they are not
//! well-formed XML, made well-formed.
//!
//! One pass over the text, linear in its length, of which the bounds of a hostile file are part:
//! nesting and attributes are counted before a tree is built. Changed text keeps its line, and
//! inserted text is remembered, so that positions in errors are those of the file. Document
//! types that could expand something are refused, not tolerated.

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};
use std::ops::Range;

use super::lines::Lines;
use crate::error::{ImportError, Problem, Result};
use crate::limits::{MOST_ATTRIBUTES, MOST_DEPTH, MOST_PREFIXES, MOST_TOLERATED};

/// The forms that XML forbids and TinyXML-2 takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    BeforeDeclaration,
    BeforeRoot,
    Dashes,
    Ampersand,
    LessThan,
    EndOfSection,
    NoSpace,
    DocumentType,
    Markup,
    AfterRoot,
    Prefix,
}

impl Kind {
    fn words(self) -> &'static str {
        match self {
            Self::BeforeDeclaration => "white space before the declaration",
            Self::BeforeRoot => "a text before the root, which is left out",
            Self::Dashes => "`--` in a comment",
            Self::Ampersand => "an `&` that begins no reference and stands for itself",
            Self::LessThan => "a `<` in the value of an attribute",
            Self::EndOfSection => "`]]>` in a text",
            Self::NoSpace => "no space between two attributes",
            Self::DocumentType => "a document type, which is left out",
            Self::Markup => "markup of a document type outside of one, which is left out",
            Self::AfterRoot => "something after the end of the root, which is left out",
            Self::Prefix => "a prefix of a name that is not declared",
        }
    }
}

/// A text with what replaces its parts, in their order.
#[derive(Debug)]
pub struct Tolerant<'t> {
    text: Cow<'t, str>,
    /// The places in `text` that are longer than in the file, and by how many bytes.
    inserted: Vec<(usize, usize)>,
    /// The form that was tolerated, its line, and its name.
    found: Vec<(Kind, u32, String)>,
}

/// A part of the text and what stands in its place: nothing is white space of the same lines.
type Edit = (Range<usize>, Option<String>);

struct Pass<'t> {
    text: &'t str,
    edits: Vec<Edit>,
    found: Vec<(Kind, usize, String)>,
    /// The number of elements around the position.
    depth: usize,
    /// The end of the root's name.
    root: Option<usize>,
    /// The prefixes that the root declares, those that elements around the position do, and those
    /// that are used.
    of_root: BTreeSet<&'t str>,
    declared: HashMap<&'t str, usize>,
    declared_at: Vec<(usize, &'t str)>,
    used: BTreeSet<&'t str>,
}

/// The text after a token.
enum Next {
    At(usize),
    /// The form that the reader of XML refuses at this position.
    Refused,
    /// The end of the root, and what follows.
    AfterRoot(usize),
}

impl<'t> Tolerant<'t> {
    /// The text of a file, without the mark of byte order.
    ///
    /// # Errors
    /// Nesting and attributes beyond their bounds, and what has no end.
    pub fn of(text: &'t str) -> Result<Self> {
        let mut pass = Pass {
            text,
            edits: Vec::new(),
            found: Vec::new(),
            depth: 0,
            root: None,
            of_root: BTreeSet::new(),
            declared: HashMap::new(),
            declared_at: Vec::new(),
            used: BTreeSet::new(),
        };
        pass.run()?;
        if pass.found.len() > MOST_TOLERATED {
            return Err(Problem::TooLarge {
                what: "places that are not well-formed XML",
                found: pass.found.len(),
                most: MOST_TOLERATED,
            }
            .into());
        }
        if let Some(root) = pass.root {
            let missing: Vec<&str> = pass.used.difference(&pass.of_root).copied().collect();
            let declarations = missing.iter().map(|prefix| format!(" xmlns:{prefix}=\"{prefix}\""));
            let declarations: String = declarations.collect();
            if !declarations.is_empty() {
                pass.edits.push((root..root, Some(declarations)));
            }
        }
        let Pass { mut edits, found, .. } = pass;
        edits.sort_by_key(|(range, _)| range.start);
        let lines = match found.is_empty() {
            true => Lines::of(""),
            false => Lines::of(text),
        };
        let found = found.into_iter().map(|(kind, at, what)| (kind, lines.line(at as u32), what));
        let found = found.collect();
        let (text, inserted) = edited(text, &edits);
        Ok(Self { text, inserted, found })
    }

    /// The well-formed text, if nothing else is wrong with it.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The column in the file of one in [`Self::text`], both from 1 and in characters.
    pub fn column(&self, line: u32, column: u32) -> u32 {
        let start = match line {
            0 | 1 => 0,
            line => {
                let mut ends = self.text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
                ends.nth(line as usize - 2).map_or(0, |(end, _)| end + 1)
            }
        };
        let before = self.text[start..].char_indices().nth(column.saturating_sub(1) as usize);
        let end = before.map_or(self.text.len(), |(at, _)| start + at);
        let shift = self.inserted.iter().filter(|(at, _)| (start..end).contains(at));
        let shift: usize = shift.map(|(_, length)| length).sum();
        column.saturating_sub(shift as u32).max(1)
    }

    /// Notes on what was tolerated and where, a sentence for each kind.
    pub fn notes(&self) -> Vec<String> {
        let each = self.found.iter().map(|(kind, _, detail)| (*kind, detail.as_str()));
        let kinds: BTreeSet<(Kind, &str)> = each.collect();
        let sentence = |(kind, detail): (Kind, &str)| {
            let same =
                self.found.iter().filter(|(other, _, what)| *other == kind && what == detail);
            let mut lines: Vec<u32> = same.map(|(_, line, _)| *line).collect();
            lines.dedup();
            let more = match lines.len() - lines.len().min(3) {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            let shown: Vec<String> = lines.iter().take(3).map(u32::to_string).collect();
            let noun = if lines.len() == 1 { "Line" } else { "Lines" };
            let is_xml = match kind {
                Kind::DocumentType => "It",
                _ => "This is not well-formed XML, and",
            };
            format!(
                "{noun} {}{more}: {}{detail}. {is_xml} is read as TinyXML-2 does, the reader of \
                 urdfdom and of MuJoCo.",
                shown.join(", "),
                kind.words(),
            )
        };
        kinds.into_iter().map(sentence).collect()
    }
}

/// The text with its edits, and where it is longer.
fn edited<'t>(text: &'t str, edits: &[Edit]) -> (Cow<'t, str>, Vec<(usize, usize)>) {
    if edits.is_empty() {
        return (Cow::Borrowed(text), Vec::new());
    }
    let (mut out, mut copied, mut inserted) = (String::with_capacity(text.len()), 0, Vec::new());
    for (range, with) in edits {
        if range.start < copied {
            continue;
        }
        out += &text[copied..range.start];
        let old = &text[range.clone()];
        match with {
            Some(new) => {
                inserted.push((out.len(), new.len() - old.len()));
                out += new;
            }
            None => out.extend(old.chars().map(|c| if c == '\n' || c == '\r' { c } else { ' ' })),
        }
        copied = range.end;
    }
    out += &text[copied..];
    (Cow::Owned(out), inserted)
}

impl<'t> Pass<'t> {
    fn tolerate(&mut self, kind: Kind, at: usize, detail: String) {
        self.found.push((kind, at, detail));
    }

    fn error(&self, at: usize, problem: Problem) -> ImportError {
        ImportError::at(Lines::of(&self.text[..at]).line(at as u32), "", problem)
    }

    fn without_end(&self, at: usize, what: &str) -> ImportError {
        let line = self.text[..at].rfind('\n').map_or(0, |end| end + 1);
        let column = self.text[line..at].chars().count() + 1;
        self.error(at, Problem::Xml(format!("{what} that begins in column {column} has no end")))
    }

    /// The end of what begins at `at` and ends with `end`.
    fn end_of(&self, at: usize, skip: usize, end: &str, what: &str) -> Result<usize> {
        let found = self.text[at..].get(skip..).and_then(|rest| rest.find(end));
        let found = found.ok_or_else(|| self.without_end(at, what))?;
        Ok(at + skip + found + end.len())
    }

    fn run(&mut self) -> Result<()> {
        let mut at = 0;
        while self.found.len() <= MOST_TOLERATED {
            let rest = &self.text[at..];
            let next = at + rest.find('<').unwrap_or(rest.len());
            let blank = is_blank(&self.text[at..next]);
            match (self.root, self.depth, blank) {
                (None, _, false) => {
                    self.edits.push((at..next, None));
                    self.tolerate(Kind::BeforeRoot, at, String::new());
                }
                (Some(_), 0, false) => {
                    self.leave_out_after(at);
                    return Ok(());
                }
                _ => self.characters(at..next, false),
            }
            if next == self.text.len() {
                return Ok(());
            }
            match self.markup(next)? {
                Next::At(end) => at = end,
                Next::Refused => return Ok(()),
                Next::AfterRoot(start) => {
                    self.leave_out_after(start);
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    /// A token that begins with `<`.
    fn markup(&mut self, at: usize) -> Result<Next> {
        let rest = &self.text[at..];
        let is_done = self.root.is_some() && self.depth == 0;
        if rest.starts_with("<!--") {
            let end = self.end_of(at, 4, "-->", "a comment")?;
            let inner = at + 4..end - 3;
            let text = &self.text[inner.clone()];
            if text.contains("--") || text.ends_with('-') {
                self.edits.push((inner, None));
                self.tolerate(Kind::Dashes, at, String::new());
            }
            return Ok(Next::At(end));
        }
        if let Some(instruction) = rest.strip_prefix("<?") {
            let end = self.end_of(at, 2, "?>", "an instruction")?;
            let name = instruction.strip_prefix("xml");
            let is_declaration = name.is_some_and(|rest| rest.starts_with(char::is_whitespace));
            if is_declaration && at > 0 && is_blank(&self.text[..at]) {
                self.edits.push((at..end, None));
                self.tolerate(Kind::BeforeDeclaration, at, String::new());
            }
            return Ok(Next::At(end));
        }
        if is_done {
            return Ok(Next::AfterRoot(at));
        }
        if rest.starts_with("<![CDATA[") {
            return Ok(Next::At(self.end_of(at, 9, "]]>", "a section of characters")?));
        }
        if rest.starts_with("<!DOCTYPE") {
            let end = self.document_type(at)?;
            self.edits.push((at..end, None));
            self.tolerate(Kind::DocumentType, at, String::new());
            return Ok(Next::At(end));
        }
        if rest.starts_with("<!") {
            let end = self.end_of(at, 2, ">", "markup")?;
            self.edits.push((at..end, None));
            self.tolerate(Kind::Markup, at, String::new());
            return Ok(Next::At(end));
        }
        if rest.starts_with("</") {
            let end = self.end_of(at, 2, ">", "the end of an element")?;
            self.close();
            return Ok(Next::At(end));
        }
        self.element(at)
    }

    /// The end of a document type in which nothing expands and which names no other file.
    fn document_type(&self, at: usize) -> Result<usize> {
        let (mut brackets, mut quote, mut end) = (0_usize, None, None);
        for (i, &byte) in self.text.as_bytes()[at..].iter().enumerate() {
            match (quote, byte) {
                (Some(open), byte) if open == byte => quote = None,
                (Some(_), _) => {}
                (None, b'"' | b'\'') => quote = Some(byte),
                (None, b'[') => brackets += 1,
                (None, b']') => brackets = brackets.saturating_sub(1),
                (None, b'>') if brackets == 0 => {
                    end = Some(at + i + 1);
                    break;
                }
                _ => {}
            }
        }
        let end = end.ok_or_else(|| self.without_end(at, "a document type"))?;
        let text = &self.text[at..end];
        let expands = ["<!ENTITY", "%", "SYSTEM", "PUBLIC"];
        if expands.iter().any(|word| text.contains(word)) {
            let words = "its document type declares entities or names another file, which are not \
                         expanded: put what they stand for in their places and remove the \
                         <!DOCTYPE>";
            return Err(self.error(at, Problem::Xml(words.to_owned())));
        }
        Ok(end)
    }

    /// From the start of an element to the end of its tag.
    fn element(&mut self, start: usize) -> Result<Next> {
        let text = self.text;
        let bytes = text.as_bytes();
        let is_end =
            |byte: u8| byte.is_ascii_whitespace() || matches!(byte, b'/' | b'>' | b'=' | b'<');
        let name_end = |from: usize| {
            bytes[from..].iter().position(|&byte| is_end(byte)).map_or(text.len(), |n| from + n)
        };
        let space_end = |from: usize| {
            let blank = |byte: &u8| !byte.is_ascii_whitespace();
            bytes[from..].iter().position(blank).map_or(text.len(), |n| from + n)
        };
        let mut at = name_end(start + 1);
        if at == start + 1 {
            return Ok(Next::Refused);
        }
        self.depth += 1;
        if self.depth > MOST_DEPTH {
            let problem =
                Problem::TooLarge { what: "nested elements", found: self.depth, most: MOST_DEPTH };
            return Err(problem.into());
        }
        let is_root = self.root.is_none();
        self.root = self.root.or(Some(at));
        let mut names = vec![&text[start + 1..at]];
        loop {
            let name = space_end(at);
            match bytes.get(name) {
                None => return Err(self.without_end(start, "an element")),
                Some(b'>') => {
                    at = name + 1;
                    break;
                }
                Some(b'/') if bytes.get(name + 1) == Some(&b'>') => {
                    self.used_by(start, &names)?;
                    self.close();
                    return Ok(Next::At(name + 2));
                }
                _ => {}
            }
            let end = name_end(name);
            let equals = space_end(end);
            let open = space_end((equals + 1).min(text.len()));
            let quote = bytes.get(open).copied().filter(|byte| matches!(byte, b'"' | b'\''));
            let (Some(b'='), Some(quote), true) = (bytes.get(equals), quote, end > name) else {
                return Ok(Next::Refused);
            };
            let value = bytes[open + 1..].iter().position(|&byte| byte == quote);
            let close = open
                + 1
                + value.ok_or_else(|| self.without_end(open, "the value of an attribute"))?;
            if name == at {
                self.edits.push((name..name, Some(" ".to_owned())));
                self.tolerate(Kind::NoSpace, name, String::new());
            }
            self.attribute(name..end, open + 1..close, is_root, &mut names);
            if names.len() > MOST_ATTRIBUTES + 1 {
                let element = format!("<{}>", crate::description::shortened(names[0]));
                let problem = Problem::TooLarge {
                    what: "attributes of an element, or more",
                    found: names.len() - 1,
                    most: MOST_ATTRIBUTES,
                };
                let mut error = self.error(start, problem);
                error.place.element = element;
                return Err(error);
            }
            at = close + 1;
        }
        self.used_by(start, &names)?;
        Ok(Next::At(at))
    }

    /// An attribute: a declaration of a prefix below the root is left out, as names are taken with
    /// their prefixes.
    fn attribute(
        &mut self,
        name: Range<usize>,
        value: Range<usize>,
        is_root: bool,
        names: &mut Vec<&'t str>,
    ) {
        let text = &self.text[name.clone()];
        names.push(text);
        let prefix = text.strip_prefix("xmlns:");
        match (prefix, is_root) {
            (Some(prefix), true) => {
                self.of_root.insert(prefix);
            }
            (Some(prefix), false) => {
                *self.declared.entry(prefix).or_default() += 1;
                self.declared_at.push((self.depth, prefix));
            }
            _ => {}
        }
        if !is_root && (prefix.is_some() || text == "xmlns") {
            self.edits.push((name.start..value.end + 1, None));
            return;
        }
        self.characters(value, true);
    }

    /// The prefixes of the names of an element and its attributes.
    fn used_by(&mut self, at: usize, names: &[&'t str]) -> Result<()> {
        for name in names {
            let Some((prefix, _)) = name.split_once(':') else {
                continue;
            };
            if matches!(prefix, "" | "xml" | "xmlns") {
                continue;
            }
            let is_declared =
                self.of_root.contains(prefix) || self.declared.get(prefix).is_some_and(|n| *n > 0);
            if !is_declared {
                self.tolerate(
                    Kind::Prefix,
                    at,
                    format!(", `{}`", crate::description::shortened(prefix)),
                );
            }
            self.used.insert(prefix);
            if self.used.len() > MOST_PREFIXES {
                let problem = Problem::TooLarge {
                    what: "prefixes of names, or more",
                    found: self.used.len(),
                    most: MOST_PREFIXES,
                };
                return Err(self.error(at, problem));
            }
        }
        Ok(())
    }

    /// The end of an element.
    fn close(&mut self) {
        while let Some((_, prefix)) = self.declared_at.pop_if(|(depth, _)| *depth >= self.depth) {
            self.declared.entry(prefix).and_modify(|n| *n -= 1);
        }
        self.depth = self.depth.saturating_sub(1);
    }

    /// A text, or the value of an attribute: what of it XML does not have.
    fn characters(&mut self, range: Range<usize>, is_value: bool) {
        let text = &self.text[range.clone()];
        if !text.contains('&') && !text.contains('<') && !text.contains("]]>") {
            return;
        }
        for (i, c) in text.char_indices().filter(|(_, c)| matches!(c, '&' | '<' | ']')) {
            if self.found.len() > MOST_TOLERATED {
                return;
            }
            let at = range.start + i;
            match c {
                '&' if !is_reference(&text[i + 1..]) => {
                    self.edits.push((at + 1..at + 1, Some("amp;".to_owned())));
                    self.tolerate(Kind::Ampersand, at, String::new());
                }
                '<' => {
                    self.edits.push((at..at + 1, Some("&lt;".to_owned())));
                    self.tolerate(Kind::LessThan, at, String::new());
                }
                ']' if !is_value && text[i..].starts_with("]]>") => {
                    self.edits.push((at + 2..at + 3, Some("&gt;".to_owned())));
                    self.tolerate(Kind::EndOfSection, at, String::new());
                }
                _ => {}
            }
        }
    }

    /// Leaves out all that follows the end of the root.
    fn leave_out_after(&mut self, at: usize) {
        let start = self.text.len() - self.text[at..].trim_start().len();
        let what: String =
            self.text[start..].chars().take_while(|c| !c.is_control()).take(20).collect();
        let what = what.split_inclusive('>').next().unwrap_or_default().to_owned();
        self.edits.push((at..self.text.len(), None));
        self.tolerate(Kind::AfterRoot, start, format!(", `{}`", what.replace('`', "'")));
    }
}

fn is_blank(text: &str) -> bool {
    text.bytes().all(|byte| byte.is_ascii_whitespace())
}

/// Whether what follows an `&` makes it a reference of XML: to a character, or one of the five
/// names.
fn is_reference(rest: &str) -> bool {
    let word = rest.as_bytes().iter().take(12).position(|&byte| byte == b';');
    let Some(word) = word.and_then(|end| rest.get(..end)) else {
        return false;
    };
    let digits =
        |text: &str, is_digit: fn(char) -> bool| !text.is_empty() && text.chars().all(is_digit);
    match (word.strip_prefix("#x"), word.strip_prefix('#')) {
        (Some(hexadecimal), _) => digits(hexadecimal, |c| c.is_ascii_hexdigit()),
        (None, Some(decimal)) => digits(decimal, |c| c.is_ascii_digit()),
        _ => matches!(word, "amp" | "lt" | "gt" | "quot" | "apos"),
    }
}
