//! Files of xacro, the macros of ROS: a URDF is what they expand to, and they are not expanded
//! here.

use roxmltree::Node;

use super::lines::Lines;
use super::xml::{self, children};
use crate::description::shortened;
use crate::error::{ImportError, Problem, Result};

/// The advice for a file that is not expanded.
const EXPAND: &str = "expand it first, with `xacro FILE > robot.urdf` (the program of the ROS \
    package xacro, or of `pip install xacro`), and import robot.urdf";

/// Elements below the root of a URDF that state nothing of its dynamics, or are read.
const KNOWN: [&str; 15] = [
    "link",
    "joint",
    "material",
    "transmission",
    "gazebo",
    "ros2_control",
    "sensor",
    "sensors",
    "mujoco",
    "plugin",
    "drake",
    "group",
    "verbose",
    "self_collide",
    "disable_collisions",
];

/// Elements whose contents change no dynamics.
const LOOKS: [&str; 8] = [
    "visual",
    "collision",
    "material",
    "transmission",
    "gazebo",
    "ros2_control",
    "sensor",
    "mujoco",
];

/// The error of an element or a text of xacro.
fn error(node: Node<'_, '_>, what: &str) -> ImportError {
    let problem = format!("{what} is of xacro: the file is not a URDF yet; {EXPAND}");
    xml::error(node, Problem::Value(problem))
}

/// Whether an element is one of xacro, by its prefix or its namespace.
fn is_of_xacro(node: Node<'_, '_>) -> bool {
    let namespace = node.tag_name().namespace().unwrap_or_default();
    xml::tag(node).starts_with("xacro:") || namespace.contains("xacro")
}

/// Whether an element defines a name of xacro and stands for nothing by itself.
fn is_definition(node: Node<'_, '_>) -> bool {
    let name = node.tag_name().name();
    is_of_xacro(node) && matches!(name.strip_prefix("xacro:").unwrap_or(name), "property" | "arg")
}

/// Fails at the first element or text that xacro would have expanded, other than in what is not
/// read and definitions in a file without a text that could use them.
///
/// # Errors
/// With line and element.
pub fn refuse(root: Node<'_, '_>) -> Result<()> {
    let uses = |text: &str| text.contains("${") || text.contains("$(arg");
    let is_used = root.descendants().any(|node| {
        node.attributes().any(|one| uses(one.value())) || node.text().is_some_and(uses)
    });
    for node in root.descendants().filter(Node::is_element) {
        if is_of_xacro(node) && (is_used || !is_definition(node)) {
            return Err(error(node, &format!("<{}>", shortened(xml::tag(node)))));
        }
        let text = node.attributes().find(|one| is_text(one.value()));
        let is_read = || {
            let mut around = node.ancestors();
            !around.any(|node| LOOKS.contains(&xml::tag(node)))
        };
        if let Some(one) = text.filter(|_| is_read()) {
            let what = format!("`{}=\"{}\"`", one.name(), shortened(one.value()));
            return Err(error(node, &what));
        }
    }
    Ok(())
}

/// Whether xacro replaces a part of a text.
fn is_text(text: &str) -> bool {
    text.contains("${") || text.contains("$(")
}

/// The elements that are none of URDF, such as calls of macros without a prefix, and texts of xacro
/// in what is not read; a sentence each.
pub fn left_out(root: Node<'_, '_>) -> Vec<String> {
    let lines = Lines::of(root.document().input_text());
    let line = |node| lines.line(xml::offset(node));
    let mut notes = Vec::new();
    for node in root.children().filter(Node::is_element) {
        let tag = xml::tag(node);
        if is_definition(node) {
            notes.push(format!(
                "The <{}> on line {} is of xacro, and nothing in the file uses it: it is left out.",
                shortened(tag),
                line(node)
            ));
        } else if !KNOWN.contains(&tag) {
            // A prefix is that of an extension.
            let macros = match tag.contains(':') {
                true => String::new(),
                false => format!("; if it is a macro of xacro, {EXPAND}"),
            };
            notes.push(format!(
                "The element <{}> on line {} is none of URDF and is left out with all that is in \
                 it{macros}.",
                shortened(tag),
                line(node)
            ));
        }
    }
    let looks = root.descendants().find(|node| {
        let mut attributes = node.attributes();
        attributes.any(|one| is_text(one.value()))
    });
    if let Some(node) = looks {
        notes.push(format!(
            "The <{}> on line {} has a text of xacro, in a part that is not read: the file may not \
             be expanded; if so, {EXPAND}.",
            shortened(xml::tag(node)),
            line(node)
        ));
    }
    for link in children(root, "link").chain(children(root, "joint")) {
        let name = shortened(link.attribute("name").unwrap_or_default());
        let named = ["link", "joint"];
        for inner in link.children().filter(|node| named.iter().any(|tag| xml::tag(*node) == *tag))
        {
            notes.push(format!(
                "The <{}> on line {} is inside of `{name}`, where URDF has none, and is left out.",
                xml::tag(inner),
                line(inner)
            ));
        }
    }
    notes
}
