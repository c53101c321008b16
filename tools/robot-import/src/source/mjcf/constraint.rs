//! Equality constraints: joints that follow others, and loops.

use std::collections::HashMap;

use dynamics_core::glam::DVec3;

use super::body::Tree;
use super::compiler::Compiler;
use super::defaults::{Classes, View};
use super::element::Element;
use super::mimic;
use super::pose::Placement;
use crate::description::{Kind, Loop};
use crate::error::{Problem, Result};

/// The constraints of all sections `<equality>`.
///
/// # Errors
/// A constraint that no description has.
pub fn read(
    root: &Element,
    tree: &mut Tree<'_>,
    classes: &Classes<'_>,
    compiler: &Compiler,
) -> Result<Vec<Loop>> {
    let joints = tree.joints.iter().enumerate();
    let joints: HashMap<String, usize> = joints.map(|(i, joint)| (joint.name.clone(), i)).collect();
    let mut loops = Vec::new();
    for element in root.all("equality").flat_map(|section| &section.children) {
        let view = classes.view(element, classes.main())?;
        let name = element.name().map(str::to_owned);
        let name = name.unwrap_or_else(|| format!("loop_{}", loops.len()));
        if view.flag("active")? == Some(false) {
            let words = element.words();
            tree.notes.push(format!("{words}: the constraint is inactive and left out"));
            continue;
        }
        match element.tag.as_str() {
            "joint" => mimic::of_joints(view, tree, &joints)?,
            "tendon" => mimic::of_tendon(view, tree, &joints, root)?,
            "connect" => loops.push(connect(view, tree, name)?),
            "weld" => loops.push(weld(view, tree, name, compiler)?),
            tag => {
                let reason =
                    "known are joint, tendon, connect and weld: remove it, or set active=\"false\"";
                return Err(element.unsupported("constraint", tag, reason));
            }
        }
    }
    Ok(loops)
}

/// The two sites of a constraint, if it names sites.
fn sites(element: &Element, tree: &Tree<'_>) -> Result<Option<[(usize, Placement); 2]>> {
    if element.get("site1").is_none() && element.get("site2").is_none() {
        return Ok(None);
    }
    if element.get("body1").is_some() || element.get("body2").is_some() {
        return Err(element.value("sites and bodies exclude each other"));
    }
    let find = |attribute: &'static str| -> Result<(usize, Placement)> {
        let name = element.get(attribute);
        let name = name.ok_or_else(|| element.error(Problem::Missing(attribute)))?;
        let found = tree.sites.get(name).cloned();
        found.ok_or_else(|| element.no_such("site", name))
    };
    Ok(Some([find("site1")?, find("site2")?]))
}

/// The two bodies of a constraint; the second is the world if it is not stated.
fn bodies(element: &Element, tree: &Tree<'_>) -> Result<[usize; 2]> {
    let find = |name: &str| {
        let found = tree.bodies.get(name).copied();
        found.ok_or_else(|| element.no_such("body", name))
    };
    let first = element.get("body1");
    let first = first.ok_or_else(|| element.error(Problem::Missing("body1")))?;
    Ok([find(first)?, element.get("body2").map_or(Ok(0), find)?])
}

/// The placement of the second link in the first in the configuration of the file.
fn between(tree: &Tree<'_>, [first, second]: [usize; 2]) -> Placement {
    tree.worlds[first].inverse().poses(&tree.worlds[second])
}

fn closed(view: View<'_>, name: String, kind: Kind, ends: [(usize, Placement); 2]) -> Result<Loop> {
    let [(first, one), (second, other)] = ends;
    if first == second {
        return Err(view.element.value("both ends are in the same body"));
    }
    Ok(Loop {
        name,
        line: view.element.line,
        kind,
        links: [first, second],
        frames: [one.exact, other.exact],
        axis: DVec3::Z,
    })
}

/// A constraint that two bodies share a point.
fn connect(view: View<'_>, tree: &Tree<'_>, name: String) -> Result<Loop> {
    let element = view.element;
    element.only("active anchor body1 body2 class name site1 site2 solimp solref")?;
    if let Some(mut ends) = sites(element, tree)? {
        for (_, placement) in &mut ends {
            placement.pose.rotation = dynamics_core::glam::DMat3::IDENTITY;
            placement.exact.rotation = dynamics_core::glam::DMat3::IDENTITY;
        }
        return closed(view, name, Kind::Spherical, ends);
    }
    let [first, second] = bodies(element, tree)?;
    if element.get("anchor").is_none() {
        return Err(element.error(Problem::Missing("anchor")));
    }
    let anchor = Placement::position(view, "anchor")?;
    let mut other = between(tree, [second, first]).then(&anchor);
    other.exact.rotation = dynamics_core::glam::DMat3::IDENTITY;
    closed(view, name, Kind::Spherical, [(first, anchor), (second, other)])
}

/// A constraint that two bodies share a frame.
fn weld(view: View<'_>, tree: &Tree<'_>, name: String, compiler: &Compiler) -> Result<Loop> {
    let element = view.element;
    element.only(
        "active anchor body1 body2 class name relpose site1 site2 solimp solref torquescale",
    )?;
    if let Some(ends) = sites(element, tree)? {
        return closed(view, name, Kind::Fixed, ends);
    }
    let links = bodies(element, tree)?;
    let anchor = Placement::position(view, "anchor")?;
    let stated = view.numbers::<7>("relpose")?;
    let one = match stated {
        // A quaternion of zeros, the default, is that of the configuration of the file.
        Some([x, y, z, quaternion @ ..]) if quaternion != [0.0; 4] => {
            let [w, i, j, k] = quaternion;
            let text =
                |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
            let relative = Element::placement(element, text(&[x, y, z]), text(&[w, i, j, k]));
            Placement::read(View::plain(&relative), compiler)?
        }
        _ => between(tree, links).then(&anchor),
    };
    closed(view, name, Kind::Fixed, [(links[0], one), (links[1], anchor)])
}
