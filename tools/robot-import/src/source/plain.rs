//! The text of a document with its numbers as every reader takes them: some refuse blanks and line
//! ends around a number, which XML allows.

use std::fmt::Write as _;

use roxmltree::{Node, NodeType};

use super::xml::tag;

/// The text of an element and of those in it.
pub fn of(node: Node<'_, '_>) -> String {
    let mut text = String::new();
    write(node, &mut text);
    text
}

fn write(node: Node<'_, '_>, text: &mut String) {
    match node.node_type() {
        NodeType::Text => *text += &escaped(node.text().unwrap_or_default()),
        NodeType::Element => {
            let _ = write!(text, "<{}", tag(node));
            for one in node.attributes().filter(|one| one.namespace().is_none()) {
                let words: Vec<&str> = one.value().split_ascii_whitespace().collect();
                let is_number = words.iter().all(|word| word.parse::<f64>().is_ok());
                let value = match is_number {
                    true => words.join(" "),
                    false => one.value().to_owned(),
                };
                let _ = write!(text, " {}=\"{}\"", one.name(), escaped(&value));
            }
            text.push('>');
            node.children().for_each(|child| write(child, text));
            let _ = writeln!(text, "</{}>", tag(node));
        }
        _ => {}
    }
}

/// A text within an attribute's quotes, or between elements.
pub fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            c if c.is_control() => {
                let _ = write!(out, "&#{};", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out
}
