//! Actuators: limits of torque or force, and what they add to the joint. Their controllers are left
//! out.

use std::collections::{BTreeMap, HashMap};

use super::body::Tree;
use super::compiler::Compiler;
use super::defaults::{Classes, View};
use super::element::Element;
use super::joint::greatest;
use crate::description::shortened;
use crate::error::{Problem, Result};

/// The actuators of all sections `<actuator>`.
///
/// # Errors
/// An actuator of a joint that is not there.
pub fn read(
    root: &Element,
    tree: &mut Tree<'_>,
    classes: &Classes<'_>,
    compiler: &Compiler,
) -> Result<()> {
    let joints = tree.joints.iter().enumerate();
    let joints: HashMap<String, usize> = joints.map(|(i, joint)| (joint.name.clone(), i)).collect();
    // Each joint's limit by its actuators together; none if one of them has no limit.
    let mut efforts: BTreeMap<usize, Option<f64>> = BTreeMap::new();
    let mut controllers: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for element in root.all("actuator").flat_map(|section| &section.children) {
        let view = classes.view(element, classes.main())?;
        let Some(name) = element.get("joint").or_else(|| element.get("jointinparent")) else {
            let words = element.words();
            tree.notes.push(format!("{words}: it acts on no joint and is left out"));
            continue;
        };
        let Some(&joint) = joints.get(name) else {
            return Err(element.error(Problem::NoSuch {
                what: "joint",
                name: shortened(name),
                suggestion: String::new(),
            }));
        };
        if !tree.joints[joint].kind.has_axis() {
            let words = element.words();
            tree.notes.push(format!("{words}: its joint is no hinge and no slide; it is left out"));
            continue;
        }
        let gear = view.list("gear", [1, 6])?;
        let gear = gear.and_then(|all| all.first().copied()).unwrap_or(1.0);
        let [damping] = [view.list("damping", [1, 3])?.unwrap_or_default()];
        if damping.iter().skip(1).any(|x| *x != 0.0) {
            return Err(element.value("`damping` is not linear: state its first coefficient only"));
        }
        tree.joints[joint].damping += gear * gear * damping.first().copied().unwrap_or_default();
        tree.joints[joint].armature += gear * gear * view.number("armature")?;
        // A damper only brakes.
        tree.joints[joint].driven |= element.tag != "damper";
        let limit = effort(view, gear, compiler, &mut tree.notes)?;
        if element.tag != "motor" {
            let joint = shortened(name);
            let one = match element.name() {
                Some(own) => format!("`{}` of joint `{joint}`", shortened(own)),
                None => format!("that of joint `{joint}`"),
            };
            controllers.entry(&element.tag).or_default().push(one);
        }
        let total = efforts.entry(joint).or_insert(Some(0.0));
        *total = total.zip(limit).map(|(sum, limit)| sum + limit);
    }
    for (joint, effort) in efforts {
        let stated = &mut tree.joints[joint].limits.effort;
        *stated = match (*stated, effort) {
            (Some(joint), Some(actuators)) => Some(joint.min(actuators)),
            (stated, effort) => stated.or(effort),
        };
    }
    for (tag, all) in controllers {
        tree.notes.push(format!(
            "Actuators of type {tag}, {}: their gains are controllers of the simulation and are \
             left out.",
            all.join(", ")
        ));
    }
    tendons(root, tree, classes)
}

/// The greatest torque or force at the joint: a motor's control is its force.
fn effort(
    view: View<'_>,
    gear: f64,
    compiler: &Compiler,
    notes: &mut Vec<String>,
) -> Result<Option<f64>> {
    let automatic = compiler.autolimits;
    let force = view.range("forcerange", "forcelimited", automatic)?;
    let control = match view.element.tag.as_str() {
        "motor" => view.range("ctrlrange", "ctrllimited", automatic)?,
        _ => None,
    };
    let range = match (force, control) {
        (Some([a, b]), Some([c, d])) => Some([a.max(c), b.min(d)]),
        (force, control) => force.or(control),
    };
    let words = view.element.words();
    Ok(range.map(|range| gear.abs() * greatest(range, &words, notes)))
}

fn tendons(root: &Element, tree: &mut Tree<'_>, classes: &Classes<'_>) -> Result<()> {
    for element in root.all("tendon").flat_map(|section| &section.children) {
        let words = element.words();
        let view = classes.view(element, classes.main())?;
        let forces = ["stiffness", "damping", "frictionloss", "armature"];
        let stated: Vec<&str> =
            forces.into_iter().filter(|name| view.get(name).is_some()).collect();
        let which = match stated.is_empty() {
            true => String::new(),
            false => format!(" with its {}", stated.join(", ")),
        };
        tree.notes.push(format!("{words}: the tendon{which} is left out"));
    }
    Ok(())
}
