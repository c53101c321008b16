//! The parts of a description that a selection leaves out: each part with its mass.

use std::collections::BTreeMap;

use dynamics_core::glam::{DMat3, DVec3};

use crate::description::{Description, shortened};
use crate::number::tidy;
use crate::selection::{Selected, Selection};

/// The links that a selection leaves out, with their mass, and the direction of gravity on a base
/// that is not the root: a sentence each.
pub fn dropped(robot: &Description, selection: &Selection, selected: &Selected) -> Vec<String> {
    let mut joint_of = vec![None; robot.links.len()];
    for (j, joint) in robot.joints.iter().enumerate() {
        joint_of[joint.child] = Some(j);
    }
    let mut is_part = vec![false; robot.links.len()];
    is_part[selected.base] = true;
    let below = selected.order.iter().map(|&j| robot.joints[j].child);
    below.for_each(|link| is_part[link] = true);
    // Below the link that the user names, or not below the base.
    let mut parts: BTreeMap<Option<usize>, Vec<usize>> = BTreeMap::new();
    for link in (0..robot.links.len()).filter(|&link| !is_part[link]) {
        let part = without(robot, selection, selected.base, &joint_of, link);
        parts.entry(part).or_default().push(link);
    }
    let mut notes: Vec<String> =
        parts.iter().map(|(by, links)| sentence(robot, selected, *by, links)).collect();
    notes.extend(gravity(robot, selected, &joint_of).filter(|_| !selected.free_base));
    notes
}

/// The outermost link of `--without` between a link and the base; none if the link is not below the
/// base.
fn without(
    robot: &Description,
    selection: &Selection,
    base: usize,
    joint_of: &[Option<usize>],
    mut link: usize,
) -> Option<usize> {
    let mut named = None;
    while link != base {
        if selection.without.contains(&robot.links[link].name) {
            named = Some(link);
        }
        link = robot.joints[joint_of[link]?].parent;
    }
    named
}

fn sentence(
    robot: &Description,
    selected: &Selected,
    by: Option<usize>,
    links: &[usize],
) -> String {
    let each = links.iter().map(|&link| &robot.links[link]);
    let mass = each.clone().filter_map(|link| link.inertial.as_ref()).map(|own| own.mass);
    let mass = match tidy(mass.sum::<f64>()) {
        0.0 => "no mass".to_owned(),
        mass if mass < 1e-3 => format!("{mass:e} kg"),
        mass => format!("{mass} kg"),
    };
    if let Some(link) = by {
        let name = shortened(&robot.links[link].name);
        return format!("Link `{name}` and all that it carries are left out: {mass}.");
    }
    let names: Vec<String> =
        each.take(5).map(|link| format!("`{}`", shortened(&link.name))).collect();
    let more = match links.len() - names.len() {
        0 => String::new(),
        more => format!(" and {more} more links"),
    };
    format!(
        "Not below the base `{}`, and left out: {}{more}, {mass}.",
        shortened(&robot.links[selected.base].name),
        names.join(", ")
    )
}

/// The direction of gravity in the frame of a base that stands turned on an upright root.
fn gravity(robot: &Description, selected: &Selected, joint_of: &[Option<usize>]) -> Option<String> {
    let (mut turn, mut link) = (DMat3::IDENTITY, selected.base);
    while let Some(j) = joint_of[link] {
        turn = robot.joints[j].exact.rotation * turn;
        link = robot.joints[j].parent;
    }
    let down = turn.transpose() * -DVec3::Z;
    let [x, y, z] = down.to_array().map(|x| format!("{:.4}", x + 0.0).replace("-0.0000", "0.0000"));
    (down.distance(-DVec3::Z) > 1e-6).then(|| {
        format!(
            "The base `{}` is turned in the file at zero positions: on a root that stands upright, \
             gravity is along ({x}, {y}, {z}) of the base, and that of SCENE is along its −z.",
            shortened(&robot.links[selected.base].name)
        )
    })
}
