//! XML with the limits of a robot's file: no document types, and errors that name line and element.

use roxmltree::{Document, Node, ParsingOptions};

use crate::description::shortened;
use crate::error::{ImportError, Problem, Result};

/// The largest file, bytes.
pub const MOST_BYTES: usize = 16 << 20;
/// The most elements and texts.
const MOST_NODES: u32 = 1_000_000;
/// The deepest nesting, which the parser and the drop of its tree are recursive in.
const MOST_DEPTH: usize = 512;

/// A parsed file: entities other than the five of XML, and with them all expansion, are refused with the document type.
pub fn parse(text: &str) -> Result<Document<'_>> {
    if text.len() > MOST_BYTES {
        return Err(Problem::TooLarge {
            what: "bytes in the file",
            found: text.len(),
            most: MOST_BYTES,
        }
        .into());
    }
    let found = depth(text);
    if found > MOST_DEPTH {
        return Err(Problem::TooLarge {
            what: "nested elements",
            found,
            most: MOST_DEPTH,
        }
        .into());
    }
    let options = ParsingOptions {
        allow_dtd: false,
        nodes_limit: MOST_NODES,
        ..ParsingOptions::default()
    };
    Document::parse_with_options(text, options).map_err(|error| {
        let line = error.pos().row;
        if let roxmltree::Error::UnknownNamespace(prefix, _) = &error
            && prefix == "xacro"
        {
            return super::xacro::undeclared(line);
        }
        ImportError::at(line, "", Problem::Xml(error.to_string()))
    })
}

/// A bound of the nesting: opening tags minus closing ones, where the text is well-formed.
fn depth(text: &str) -> usize {
    let bytes = text.as_bytes();
    let (mut depth, mut most) = (0_usize, 0);
    for (i, &byte) in bytes.iter().enumerate() {
        match (byte, bytes.get(i + 1)) {
            (b'<', Some(b'/')) => depth = depth.saturating_sub(1),
            (b'/', Some(b'>')) => depth = depth.saturating_sub(1),
            (b'<', Some(b'!' | b'?')) => {}
            (b'<', _) => depth += 1,
            _ => {}
        }
        most = most.max(depth);
    }
    most
}

/// Where an element starts, in bytes: a search for its line would take as long as the file is.
pub fn offset(node: Node<'_, '_>) -> u32 {
    node.range().start as u32
}

/// The lines of offsets, from 1.
pub struct Lines(Vec<u32>);

impl Lines {
    /// Of a text.
    pub fn of(text: &str) -> Self {
        let ends = text.bytes().enumerate();
        Self(
            ends.filter(|(_, byte)| *byte == b'\n')
                .map(|(i, _)| i as u32)
                .collect(),
        )
    }

    /// The line of an offset.
    pub fn line(&self, offset: u32) -> u32 {
        self.0.partition_point(|end| *end < offset) as u32 + 1
    }
}

/// An error at an element.
pub fn error(node: Node<'_, '_>, problem: Problem) -> ImportError {
    let tag = node.tag_name().name();
    let element = match node.attribute("name") {
        Some(name) => format!("{tag} `{}`", shortened(name)),
        None => format!("<{tag}>"),
    };
    let line = node.document().text_pos_at(node.range().start).row;
    ImportError::at(line, element, problem)
}

/// The elements of this tag directly below.
pub fn children<'a, 'i>(
    node: Node<'a, 'i>,
    tag: &'static str,
) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(move |child| child.has_tag_name(tag))
}

/// The first element of this tag directly below.
pub fn child<'a, 'i>(node: Node<'a, 'i>, tag: &'static str) -> Option<Node<'a, 'i>> {
    children(node, tag).next()
}

/// An attribute that must be there.
pub fn required<'a>(node: Node<'a, '_>, attribute: &'static str) -> Result<&'a str> {
    let text = node.attribute(attribute);
    text.ok_or_else(|| error(node, Problem::Missing(attribute)))
}

/// A finite number, if the attribute is there.
pub fn number(node: Node<'_, '_>, attribute: &'static str) -> Result<Option<f64>> {
    Ok(numbers::<1>(node, attribute)?.map(|[x]| x))
}

/// N finite numbers, if the attribute is there.
pub fn numbers<const N: usize>(
    node: Node<'_, '_>,
    attribute: &'static str,
) -> Result<Option<[f64; N]>> {
    let Some(text) = node.attribute(attribute) else {
        return Ok(None);
    };
    match parsed(text) {
        Some(numbers) => Ok(Some(numbers)),
        None => Err(not_numbers(node, attribute, N)),
    }
}

/// The error of an attribute that should be `n` numbers.
pub fn not_numbers(node: Node<'_, '_>, attribute: &str, n: usize) -> ImportError {
    let expected = match n {
        1 => "a finite number".to_owned(),
        n => format!("{n} finite numbers"),
    };
    let text = shortened(node.attribute(attribute).unwrap_or_default());
    let attribute = attribute.to_owned();
    error(
        node,
        Problem::Number {
            attribute,
            text,
            expected,
        },
    )
}

/// N finite numbers, separated by white space, and nothing else.
fn parsed<const N: usize>(text: &str) -> Option<[f64; N]> {
    let mut words = text.split_ascii_whitespace();
    let mut out = [0.0; N];
    for x in &mut out {
        *x = words
            .next()?
            .parse::<f64>()
            .ok()
            .filter(|x| x.is_finite())?;
    }
    words.next().is_none().then_some(out)
}
