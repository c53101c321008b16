//! The text of a model for MuJoCo: what of the file its rigid bodies depend on, with the included
//! files in it, and without the name of any file.
//!
//! MuJoCo opens each mesh, picture and submodel that a model names, wherever it is, and a
//! description from elsewhere may name what it likes. In place of a mesh there is a tetrahedron: a
//! body whose inertia depends on a mesh is not read, or is fixed.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use roxmltree::Node;

use super::element::Element;
use crate::error::Result;
use crate::source::Folders;
use crate::source::plain::escaped;

/// The sections of a model that its rigid bodies depend on.
const SECTIONS: [&str; 3] = ["compiler", "default", "worldbody"];
/// Elements of these sections that move nothing, or have their defaults in other sections.
const DROPPED: [&str; 14] = [
    "mesh", "material", "camera", "light", "pair", "equality", "tendon", "general", "motor",
    "position", "velocity", "site", "plugin", "numeric",
];
/// Attributes that name files or what has them, and those that place a free body's frame elsewhere
/// than the file does.
const WITHOUT: [&str; 9] = [
    "material",
    "file",
    "assetdir",
    "meshdir",
    "texturedir",
    "strippath",
    "savecompiled",
    "align",
    "alignfree",
];
/// The stand-ins for a mesh and for a field of heights.
const TETRAHEDRON: &str = "vertex=\"0 0 0 1 0 0 0 1 0 0 0 1\"";
const FIELD: &str = "nrow=\"2\" ncol=\"2\" size=\"1 1 1 1\" elevation=\"0 1 0 1\"";

/// The text of a document whose root is `<mujoco>`; included files are in `folders`.
///
/// # Errors
/// As [`super::read`] for the elements and the included files.
pub fn of(root: Node<'_, '_>, folders: Folders<'_>) -> Result<String> {
    let root = Element::load(root, folders)?.root;
    let mut text = String::from("<mujoco>\n");
    let mut named = [BTreeSet::new(), BTreeSet::new()];
    let sections = root.children.iter();
    for section in sections.filter(|one| SECTIONS.contains(&one.tag.as_str())) {
        write(section, &mut text, &mut named);
    }
    let [meshes, fields] = named;
    text += "<asset>\n";
    for (tag, names, shape) in [("mesh", meshes, TETRAHEDRON), ("hfield", fields, FIELD)] {
        for name in names {
            let _ = writeln!(text, "<{tag} name=\"{}\" {shape}/>", escaped(&name));
        }
    }
    text += "</asset>\n</mujoco>\n";
    Ok(text)
}

/// An element and those below it; the names of meshes and of fields of heights are collected.
fn write(element: &Element, text: &mut String, named: &mut [BTreeSet<String>; 2]) {
    let tag = &element.tag;
    let _ = write!(text, "<{tag}");
    for (name, value) in &element.attributes {
        if WITHOUT.contains(&name.as_str()) {
            continue;
        }
        if let Some(which) = ["mesh", "hfield"].iter().position(|of| of == name)
            && !value.is_empty()
        {
            named[which].insert(value.clone());
        }
        // A plugin computes the surface of such a shape.
        let value = match (name.as_str(), value.as_str()) {
            ("type", "sdf") => "mesh",
            (_, value) => value,
        };
        let _ = write!(text, " {name}=\"{}\"", escaped(value));
    }
    text.push('>');
    for child in &element.children {
        if !DROPPED.contains(&child.tag.as_str()) {
            write(child, text, named);
        }
    }
    let _ = writeln!(text, "</{tag}>");
}
