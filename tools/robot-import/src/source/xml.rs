//! XML with the limits of a robot's file: no document types that expand, and errors that name line
//! and element.

use roxmltree::{Document, Node, ParsingOptions};

pub use super::lines::Lines;
use super::tolerant::Tolerant;
use crate::description::shortened;
use crate::error::{ImportError, Problem, Result};
use crate::limits::{MOST_BYTES, MOST_NODES};

/// A text that is read as XML.
#[derive(Debug)]
pub struct Xml<'t>(Tolerant<'t>);

impl<'t> Xml<'t> {
    /// A text with what its reader tolerates made well-formed.
    ///
    /// # Errors
    /// A text that is too large, too deep or of too many attributes, or a part that has no end.
    pub fn of(text: &'t str) -> Result<Self> {
        if text.len() > MOST_BYTES {
            return Err(Problem::TooLarge {
                what: "bytes in the file",
                found: text.len(),
                most: MOST_BYTES,
            }
            .into());
        }
        Ok(Self(Tolerant::of(text.trim_start_matches('\u{feff}'))?))
    }

    /// The parsed file: entities other than the five of XML, and with them all expansion, are
    /// refused with the document type.
    ///
    /// # Errors
    /// The defect of the form, with line and column.
    pub fn document(&self) -> Result<Document<'_>> {
        let options = ParsingOptions {
            allow_dtd: false,
            nodes_limit: MOST_NODES,
            ..ParsingOptions::default()
        };
        Document::parse_with_options(self.0.text(), options).map_err(|error| {
            let (place, message) = (error.pos(), error.to_string());
            let column = self.0.column(place.row, place.col);
            let message =
                message.replace(&format!("at {place}"), &format!("at {}:{column}", place.row));
            ImportError::at(place.row, "", Problem::Xml(message))
        })
    }

    /// Notes on what is not well-formed and was read all the same, a sentence each.
    pub fn notes(&self) -> Vec<String> {
        self.0.notes()
    }
}

/// The name of an element as the file has it, with its prefix: readers of robots know no
/// namespaces.
pub fn tag<'a>(node: Node<'a, '_>) -> &'a str {
    let name = node.tag_name().name();
    if node.tag_name().namespace().is_none() {
        return name;
    }
    let text = &node.document().input_text()[node.range()];
    let text = text.trim_start_matches('<');
    let end = text.find(|c: char| c.is_whitespace() || matches!(c, '/' | '>'));
    &text[..end.unwrap_or(text.len())]
}

/// The start of an element, in bytes: a search for its line would take as long as the file is.
pub fn offset(node: Node<'_, '_>) -> u32 {
    node.range().start as u32
}

/// An error at an element.
pub fn error(node: Node<'_, '_>, problem: Problem) -> ImportError {
    let tag = tag(node);
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
    let is_of = move |child: &Node<'a, 'i>| child.is_element() && self::tag(*child) == tag;
    node.children().filter(is_of)
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

/// A number that limits something, if the attribute is there: infinite where there is no limit.
pub fn limit(node: Node<'_, '_>, attribute: &'static str) -> Result<Option<f64>> {
    let text = node.attribute(attribute).map(str::trim_ascii);
    match text.and_then(|text| text.parse::<f64>().ok()) {
        Some(x) if x.is_infinite() => Ok(Some(x)),
        _ => number(node, attribute),
    }
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
    error(node, Problem::Number { attribute, text, expected })
}

/// N finite numbers, separated by white space, and nothing else.
fn parsed<const N: usize>(text: &str) -> Option<[f64; N]> {
    let mut words = text.split_ascii_whitespace();
    let mut out = [0.0; N];
    for x in &mut out {
        *x = words.next()?.parse::<f64>().ok().filter(|x| x.is_finite())?;
    }
    words.next().is_none().then_some(out)
}
