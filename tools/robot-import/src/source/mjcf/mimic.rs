//! Joints that follow others: constraints of first degree between two of them.

use std::collections::HashMap;

use super::body::Tree;
use super::defaults::View;
use super::element::Element;
use crate::description::Mimic;
use crate::error::{Problem, Result};

/// The coefficients 0 and 1 of a polynomial whose others have to be zero.
fn linear(view: View<'_>) -> Result<[f64; 2]> {
    let stated = view.list("polycoef", [1, 5])?.unwrap_or_default();
    let mut polynomial = [0.0, 1.0, 0.0, 0.0, 0.0];
    polynomial[..stated.len()].copy_from_slice(&stated);
    if polynomial[2..].iter().any(|x| *x != 0.0) {
        let sentence = "`polycoef` is not linear: a joint follows another by ratio and offset only";
        return Err(view.element.value(sentence));
    }
    Ok([polynomial[0], polynomial[1]])
}

/// The joint that an attribute names.
fn find(
    element: &Element,
    attribute: &'static str,
    tree: &Tree<'_>,
    joints: &HashMap<String, usize>,
) -> Result<usize> {
    let name = element.get(attribute);
    let name = name.ok_or_else(|| element.error(Problem::Missing(attribute)))?;
    let found = joints.get(name).copied();
    let found = found.ok_or_else(|| element.no_such("joint", name))?;
    match tree.joints[found].kind.has_axis() {
        true => Ok(found),
        false => Err(element.value(format!("joint `{name}` is no hinge and no slide"))),
    }
}

/// q₁ = c₀ + c₁ q₂, each from its reference.
pub fn of_joints(
    view: View<'_>,
    tree: &mut Tree<'_>,
    joints: &HashMap<String, usize>,
) -> Result<()> {
    let element = view.element;
    element.only("active class joint1 joint2 name polycoef solimp solref")?;
    let [offset, ratio] = linear(view)?;
    let first = find(element, "joint1", tree, joints)?;
    if element.get("joint2").is_none() {
        let name = &tree.joints[first].name;
        let sentence = format!(
            "it locks joint `{name}`: remove it and lock the joint on import, or remove the joint"
        );
        return Err(element.value(sentence));
    }
    let second = find(element, "joint2", tree, joints)?;
    follow(element, tree, [first, second], [offset, ratio])
}

/// c₁ q₁ + c₂ q₂ = c₀, each from its reference: the length of a fixed tendon over two joints.
///
/// The second follows the first, or the first the second if that follows another already.
pub fn of_tendon(
    view: View<'_>,
    tree: &mut Tree<'_>,
    joints: &HashMap<String, usize>,
    root: &Element,
) -> Result<()> {
    let element = view.element;
    element.only("active class name polycoef solimp solref tendon1 tendon2")?;
    let [constant, _] = linear(view)?;
    let name = element.get("tendon1");
    let name = name.ok_or_else(|| element.error(Problem::Missing("tendon1")))?;
    let mut all = root.all("tendon").flat_map(|section| &section.children);
    let tendon = all.find(|tendon| tendon.name() == Some(name));
    let tendon = tendon.ok_or_else(|| element.no_such("tendon", name))?;
    let over: Vec<&Element> = tendon.children.iter().collect();
    let ([one, other], "fixed", None) =
        (over.as_slice(), tendon.tag.as_str(), element.get("tendon2"))
    else {
        let sentence = match over.len() {
            2 => "only one fixed tendon over two joints is read: couple them by <joint joint1=… \
                joint2=…>"
                .to_owned(),
            n => format!(
                "a tendon over {n} joints is not read, since a follower has one leader here: \
                 import the file without this equality, and write the `Transmission` between \
                 motors and joints yourself (guide, \"Coupled joints\")"
            ),
        };
        return Err(element.value(sentence));
    };
    let mut ends = [(0, 0.0); 2];
    for (end, joint) in ends.iter_mut().zip([one, other]) {
        joint.only("coef joint")?;
        let coefficient = View::plain(joint).number("coef")?;
        if coefficient == 0.0 {
            return Err(joint.value("its coefficient is zero"));
        }
        *end = (find(joint, "joint", tree, joints)?, coefficient);
    }
    if tree.joints[ends[1].0].mimic.is_some() {
        ends.swap(0, 1);
    }
    let [(second, of_second), (first, of_first)] = ends;
    let polynomial = [constant / of_first, -of_second / of_first];
    follow(element, tree, [first, second], polynomial)
}

fn follow(
    element: &Element,
    tree: &mut Tree<'_>,
    [first, second]: [usize; 2],
    [offset, ratio]: [f64; 2],
) -> Result<()> {
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
