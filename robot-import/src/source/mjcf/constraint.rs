//! Equality constraints: joints that follow others, and loops.

use std::collections::HashMap;

use dynamics_core::glam::DVec3;

use super::body::Tree;
use super::compiler::Compiler;
use super::defaults::{Classes, View};
use super::element::Element;
use super::pose::Placement;
use crate::description::{Kind, Loop, Mimic, shortened};
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
            tree.notes
                .push(format!("{words}: the constraint is inactive and left out"));
            continue;
        }
        match element.tag.as_str() {
            "joint" => mimic(view, tree, &joints)?,
            "connect" => loops.push(connect(view, tree, name)?),
            "weld" => loops.push(weld(view, tree, name, compiler)?),
            tag => {
                let reason =
                    "known are joint, connect and weld: remove it, or set active=\"false\"";
                return Err(element.unsupported("constraint", tag, reason));
            }
        }
    }
    Ok(loops)
}

/// q₁ = c₀ + c₁ q₂, each from its reference.
fn mimic(view: View<'_>, tree: &mut Tree<'_>, joints: &HashMap<String, usize>) -> Result<()> {
    let element = view.element;
    element.only("active class joint1 joint2 name polycoef solimp solref")?;
    let stated = view.list("polycoef", [1, 5])?.unwrap_or_default();
    let mut polynomial = [0.0, 1.0, 0.0, 0.0, 0.0];
    polynomial[..stated.len()].copy_from_slice(&stated);
    let [offset, ratio, ..] = polynomial;
    let find = |attribute: &'static str| -> Result<usize> {
        let name = element.get(attribute);
        let name = name.ok_or_else(|| element.error(Problem::Missing(attribute)))?;
        let found = joints.get(name).copied();
        found.ok_or_else(|| no_such(element, "joint", name))
    };
    let first = find("joint1")?;
    if element.get("joint2").is_none() {
        let name = &tree.joints[first].name;
        let sentence = format!(
            "it locks joint `{name}`: remove it and lock the joint on import, or remove the joint"
        );
        return Err(element.value(sentence));
    }
    let second = find("joint2")?;
    if polynomial[2..].iter().any(|x| *x != 0.0) {
        let sentence = "`polycoef` is not linear: a joint follows another by ratio and offset only";
        return Err(element.value(sentence));
    }
    for i in [first, second] {
        let joint = &tree.joints[i];
        if !joint.kind.has_axis() {
            let sentence = format!("joint `{}` is no hinge and no slide", joint.name);
            return Err(element.value(sentence));
        }
    }
    if first == second {
        return Err(element.value("a joint cannot follow itself"));
    }
    let mimic = Mimic {
        joint: tree.joints[second].name.clone(),
        multiplier: ratio,
        offset: tree.references[first] + offset - ratio * tree.references[second],
    };
    let joint = &mut tree.joints[first];
    if joint.mimic.replace(mimic).is_some() {
        let sentence = format!("joint `{}` follows two joints", joint.name);
        return Err(element.value(sentence));
    }
    Ok(())
}

fn no_such(element: &Element, what: &'static str, name: &str) -> crate::error::ImportError {
    element.error(Problem::NoSuch {
        what,
        name: shortened(name),
        suggestion: String::new(),
    })
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
        found.ok_or_else(|| no_such(element, "site", name))
    };
    Ok(Some([find("site1")?, find("site2")?]))
}

/// The two bodies of a constraint; the second is the world if it is not stated.
fn bodies(element: &Element, tree: &Tree<'_>) -> Result<[usize; 2]> {
    let find = |name: &str| {
        let found = tree.bodies.get(name).copied();
        found.ok_or_else(|| no_such(element, "body", name))
    };
    let first = element.get("body1");
    let first = first.ok_or_else(|| element.error(Problem::Missing("body1")))?;
    Ok([find(first)?, element.get("body2").map_or(Ok(0), find)?])
}

/// The placement of the second link in the first in the configuration of the file.
fn between(tree: &Tree<'_>, [first, second]: [usize; 2]) -> Placement {
    tree.worlds[first].inverse().then(&tree.worlds[second])
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

/// A common point.
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
    closed(
        view,
        name,
        Kind::Spherical,
        [(first, anchor), (second, other)],
    )
}

/// A common frame.
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
            let text = |numbers: &[f64]| {
                numbers
                    .iter()
                    .map(f64::to_string)
                    .collect::<Vec<_>>()
                    .join(" ")
            };
            let relative = Element::placement(element, text(&[x, y, z]), text(&[w, i, j, k]));
            Placement::read(View::plain(&relative), compiler)?
        }
        _ => between(tree, links).then(&anchor),
    };
    closed(
        view,
        name,
        Kind::Fixed,
        [(links[0], one), (links[1], anchor)],
    )
}
