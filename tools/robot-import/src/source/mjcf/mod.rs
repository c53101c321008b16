//! MJCF: a subset that is stated here; what is outside of it is refused with line and element.
//!
//! | section | what is read |
//! |---|---|
//! | `include` | files below the model's folder, or one that the user names, each once |
//! | `compiler` | `angle`, `eulerseq`, `autolimits`; for inertias six, below |
//! | `default` | classes in classes, `class` and `childclass` |
//! | `worldbody` | `body`, `frame`, `inertial`, `joint`, `freejoint`, `geom`, `site` |
//! | `equality` | `joint` of first degree, `tendon` over two joints, `connect`, `weld` |
//! | `actuator` | `gear`, `forcerange`, a motor's `ctrlrange`, `armature`, `damping` |
//!
//! The settings for inertias are `inertiafromgeom`, `inertiagrouprange`, `boundmass`,
//! `boundinertia`, `balanceinertia` and `settotalmass`.
//!
//! Masses of meshes, `replicate`, `composite`, `flexcomp`, `attach`, plugins and polynomials of
//! damping are refused. Linear springs of hinges and slides are read. Other springs, tendons,
//! gravity, fluids and the gains of actuators are left out and named in the notes. Sections on
//! looks, sensors, contacts and keyframes are skipped.
//!
//! The root is the link `world`. The joints of a body are links without mass, `body/joint`, with
//! their frames at the anchors. Positions are those of MuJoCo's `qpos`: a joint with `ref` has the
//! configuration of the file at q = `ref`, and a free joint has the placement of its body in the
//! world.

mod actuator;
mod body;
mod compiler;
mod constraint;
mod contents;
mod defaults;
mod element;
mod geom;
mod inertia;
mod joint;
mod mimic;
mod pose;

use roxmltree::Node;

use body::Tree;
use compiler::Compiler;
use defaults::Classes;
use element::{Element, Loaded};

use crate::description::{Description, Format};
use crate::error::{ImportError, Problem, Result};
use crate::source::Folders;

const SECTIONS: [&str; 16] = [
    "asset",
    "visual",
    "keyframe",
    "sensor",
    "custom",
    "statistic",
    "contact",
    "size",
    "extension",
    "compiler",
    "option",
    "default",
    "worldbody",
    "equality",
    "actuator",
    "tendon",
];

/// The robot of a document whose root is `<mujoco>`; other files are in `folders`.
pub fn read(root: Node<'_, '_>, folders: Folders<'_>) -> Result<Description> {
    let Loaded { root, files, mut notes } = Element::load(root, folders)?;
    for section in &root.children {
        if !SECTIONS.contains(&section.tag.as_str()) {
            let reason =
                "it is not in the subset of MJCF that is read: remove it or correct its name";
            return Err(section.unsupported("section", &section.tag, reason));
        }
    }
    let compiler = Compiler::read(&root, &mut notes)?;
    compiler::options(&root, &mut notes)?;
    let classes = Classes::read(&root)?;
    let mut tree = Tree::read(&root, &compiler, &classes)?;
    let loops = constraint::read(&root, &mut tree, &classes, &compiler)?;
    actuator::read(&root, &mut tree, &classes, &compiler)?;
    if let Some(total) = compiler.total_mass {
        if let Some(link) = tree.links.iter().find(|link| link.of_mesh) {
            let sentence = "`settotalmass` needs the mass of its mesh, which is not read: give it \
                an <inertial>";
            return Err(ImportError::at(
                link.line,
                format!("body `{}`", link.name),
                Problem::Value(sentence.to_owned()),
            ));
        }
        inertia::scale(&mut tree.links, total);
    }
    notes.append(&mut tree.notes);
    Ok(Description {
        name: root.get("model").unwrap_or("robot").to_owned(),
        format: Format::Mjcf,
        licence: None,
        links: tree.links,
        joints: tree.joints,
        loops,
        notes,
        files,
    })
}
