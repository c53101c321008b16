//! Extensions of URDF that readers in use know: read where its meaning is documented, and named
//! where it is left out.
//!
//! | read | meaning, and by whom |
//! |---|---|
//! | `drake:rotor_inertia`, `drake:gear_ratio` of a `<transmission>` | J N² at the joint (Drake, multibody parsing) |
//! | `armature`, `spring_stiffness`, `spring_reference` of `<dynamics>` | at the joint, as of MJCF and SDFormat |
//! | `springStiffness`, `springReference` of `<gazebo reference>` | at the joint (SDFormat, extensions to URDF) |

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use roxmltree::Node;

use super::xml::{self, child, children, number, tag};
use crate::description::{Joint, shortened};
use crate::error::{Problem, Result};

/// Elements of URDF, with the attributes that it knows.
const CORE: [(&str, &[&str]); 14] = [
    ("link", &["name", "type"]),
    ("joint", &["name", "type"]),
    ("inertial", &[]),
    ("mass", &["value"]),
    ("inertia", &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]),
    ("origin", &["xyz", "rpy", "quat_xyzw"]),
    ("parent", &["link"]),
    ("child", &["link"]),
    ("axis", &["xyz"]),
    ("limit", &["lower", "upper", "effort", "velocity"]),
    ("dynamics", &["damping", "friction", "armature", "spring_stiffness", "spring_reference"]),
    ("mimic", &["joint", "multiplier", "offset"]),
    ("safety_controller", &["soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"]),
    ("calibration", &["rising", "falling", "reference_position"]),
];
/// Elements of links and references to them that are looks, shapes or contacts.
const NOT_DYNAMICS: [&str; 30] = [
    "visual",
    "collision",
    "material",
    "sensor",
    "sensors",
    "plugin",
    "contact",
    "mu",
    "mu1",
    "mu2",
    "fdir1",
    "kp",
    "kd",
    "slip1",
    "slip2",
    "minDepth",
    "min_depth",
    "maxVel",
    "max_vel",
    "maxContacts",
    "max_contacts",
    "laserRetro",
    "rolling_friction",
    "self_collision_checking",
    "selfCollide",
    "self_collide",
    "provideFeedback",
    "preserveFixedJoint",
    "disableFixedJointLumping",
    "verbose",
];

/// The parts that are left out, one entry for all parts that have the same.
#[derive(Default)]
struct Omissions {
    /// Unknown names, and the links or joints with them.
    unknown: BTreeMap<Vec<String>, Vec<String>>,
    /// Gears without the inertia of a rotor, and the joints with them.
    gears: BTreeMap<String, Vec<String>>,
    notes: Vec<String>,
}

impl Omissions {
    fn gear(&mut self, gear: &str, joint: &str) {
        let joints = self.gears.entry(gear.to_owned()).or_default();
        joints.push(joint.to_owned());
    }
}

/// Reads what the extensions state of the joints, and lists what they state besides.
///
/// # Errors
/// A number that is read and is none.
pub fn read(root: Node<'_, '_>, joints: &mut [Joint]) -> Result<Vec<String>> {
    let mut found = Omissions::default();
    let names = joints.iter().enumerate();
    let index: HashMap<String, usize> = names.map(|(j, joint)| (joint.name.clone(), j)).collect();
    for part in children(root, "link").chain(children(root, "joint")) {
        let mut names = BTreeSet::new();
        unknown(part, &mut names);
        if !names.is_empty() {
            let parts = found.unknown.entry(names.into_iter().collect());
            let parts = parts.or_default();
            parts.push(format!("{} `{}`", tag(part), name_of(part)));
        }
    }
    for node in root.children().filter(Node::is_element) {
        match tag(node) {
            "transmission" => transmission(node, joints, &index, &mut found)?,
            "ros2_control" => ros2_control(node, &mut found),
            "gazebo" => gazebo(node, joints, &index, &mut found.notes)?,
            "mujoco" => mujoco(node, &mut found.notes),
            _ => {}
        }
    }
    // A rotor may be in another element than its gear, and a gear in two.
    let with_rotor = joints.iter().filter(|joint| joint.armature > 0.0);
    let mut done: HashSet<String> = with_rotor.map(|joint| joint.name.clone()).collect();
    for joints in found.gears.values_mut() {
        joints.retain(|joint| done.insert(joint.clone()));
    }
    found.gears.retain(|_, joints| !joints.is_empty());
    let unknown = found.unknown.into_iter().map(|(names, parts)| {
        let names = quoted(names);
        format!(
            "Left out, as no part of URDF whose meaning is known here: {names} of {}.",
            listed(parts)
        )
    });
    let gears = found.gears.into_iter().map(|(gear, joints)| {
        format!(
            "A gear of {gear} on {}, and the file has no inertia of the motor's rotor: J·N² of it \
             is not in ARMATURE; state it by `armature` of <dynamics>, kg·m².",
            quoted(joints.iter().map(|name| shortened(name)))
        )
    });
    Ok(unknown.chain(gears).chain(found.notes).collect())
}

/// The spring and the armature that `<dynamics>` states.
///
/// # Errors
/// Values that are no numbers, and an armature or a stiffness below zero.
pub fn dynamics(node: Option<Node<'_, '_>>) -> Result<([f64; 2], f64)> {
    let Some(node) = node else {
        return Ok(([0.0; 2], 0.0));
    };
    let at_least_zero = |name| -> Result<f64> {
        let x = number(node, name)?.unwrap_or_default();
        match x < 0.0 {
            true => Err(xml::error(node, Problem::Value(format!("`{name}` is {x}, at least 0")))),
            false => Ok(x),
        }
    };
    let rest = number(node, "spring_reference")?.unwrap_or_default();
    Ok(([at_least_zero("spring_stiffness")?, rest], at_least_zero("armature")?))
}

fn name_of(node: Node<'_, '_>) -> String {
    shortened(node.attribute("name").unwrap_or_default())
}

fn listed(names: impl IntoIterator<Item = String>) -> String {
    let names: Vec<String> = names.into_iter().collect();
    match names.len() {
        0..=8 => names.join(", "),
        n => format!("{} and {} more", names[..8].join(", "), n - 8),
    }
}

/// The names as code in Markdown.
fn quoted(names: impl IntoIterator<Item = String>) -> String {
    listed(names.into_iter().map(|name| format!("`{name}`")))
}

fn is_number(text: &str) -> bool {
    let mut words = text.split_ascii_whitespace().peekable();
    words.peek().is_some() && words.all(|word| word.parse::<f64>().is_ok())
}

/// The names of the elements in a part of a link or a joint, and of its attributes, that have
/// numbers and are none of the core's.
fn unknown(node: Node<'_, '_>, names: &mut BTreeSet<String>) {
    let own = tag(node);
    match CORE.iter().find(|(other, _)| *other == own) {
        Some((_, known)) => {
            let attributes = node.attributes().filter(|one| is_number(one.value()));
            let unknown =
                attributes.map(|one| qualified(node, one)).filter(|name| !known.contains(name));
            names.extend(unknown.map(|name| format!("{own} {}", shortened(name))));
            let inside = node.children().filter(Node::is_element);
            inside.for_each(|inner| unknown_in(inner, names));
        }
        None if has_numbers(node) => {
            names.insert(shortened(own));
        }
        None => {}
    }
}

fn unknown_in(node: Node<'_, '_>, names: &mut BTreeSet<String>) {
    if !NOT_DYNAMICS.contains(&tag(node)) {
        unknown(node, names);
    }
}

/// The name of an attribute with its prefix.
fn qualified<'a>(node: Node<'a, '_>, attribute: roxmltree::Attribute<'a, '_>) -> &'a str {
    &node.document().input_text()[attribute.range_qname()]
}

/// Whether an element or those in it state numbers.
fn has_numbers(node: Node<'_, '_>) -> bool {
    let mut all = node.descendants();
    all.any(|node| {
        let mut attributes = node.attributes();
        attributes.any(|one| is_number(one.value()))
            || node.is_text() && is_number(node.text().unwrap_or_default())
    })
}

/// The number that is the text of an element.
fn text_number(node: Node<'_, '_>) -> Result<f64> {
    let text = node.text().unwrap_or_default().trim();
    let parsed = text.parse::<f64>().ok().filter(|x| x.is_finite());
    parsed.ok_or_else(|| {
        let problem = Problem::Number {
            attribute: tag(node).to_owned(),
            text: shortened(text),
            expected: "a finite number".to_owned(),
        };
        xml::error(node, problem)
    })
}

/// The rotor's inertia of each actuator at the joint, or its gear without one.
fn transmission(
    node: Node<'_, '_>,
    joints: &mut [Joint],
    index: &HashMap<String, usize>,
    found: &mut Omissions,
) -> Result<()> {
    let of_joints: Vec<&str> =
        children(node, "joint").filter_map(|joint| joint.attribute("name")).collect();
    let actuators = children(node, "actuator").count();
    let what = format!("The <transmission> `{}`", name_of(node));
    let mut left_out = BTreeSet::new();
    for actuator in children(node, "actuator") {
        let value = |name| -> Result<Option<f64>> {
            let stated = child(actuator, name).map(|node| number(node, "value"));
            Ok(stated.transpose()?.flatten())
        };
        let (rotor, ratio) = (value("drake:rotor_inertia")?, value("drake:gear_ratio")?);
        if let Some(rotor) = rotor.filter(|rotor| *rotor < 0.0) {
            let problem = format!("`drake:rotor_inertia` is {rotor}, at least 0");
            return Err(xml::error(actuator, Problem::Value(problem)));
        }
        let reduction =
            child(actuator, "mechanicalReduction").or_else(|| child(node, "mechanicalReduction"));
        let reduction =
            reduction.and_then(|node| node.text()).map(str::trim).filter(|text| is_number(text));
        let own = actuator.children().filter(Node::is_element);
        let others = own.filter(|node| {
            !matches!(
                tag(*node),
                "mechanicalReduction" | "drake:rotor_inertia" | "drake:gear_ratio"
            )
        });
        left_out.extend(others.filter(|node| has_numbers(*node)).map(|node| shortened(tag(node))));
        let gear = ratio.map(|ratio| ratio.to_string()).or_else(|| reduction.map(shortened));
        let joint = match of_joints.as_slice() {
            [name] if actuators == 1 => index.get(*name).map(|&j| &mut joints[j]),
            _ => None,
        };
        match (rotor, joint) {
            (Some(rotor), Some(joint)) => {
                let armature = rotor * ratio.unwrap_or(1.0).powi(2);
                joint.armature += armature;
                if ratio.is_none() && reduction.is_some_and(|text| text.parse() != Ok(1.0)) {
                    found.notes.push(format!(
                        "{what} states the inertia of a rotor without `drake:gear_ratio`: \
                         {armature} kg·m² is taken at joint `{}`, as Drake does, without its \
                         mechanicalReduction of {}.",
                        shortened(&joint.name),
                        shortened(reduction.unwrap_or_default())
                    ));
                }
            }
            (Some(_), None) => {
                left_out.insert("drake:rotor_inertia".to_owned());
            }
            (None, _) => {
                if let Some(gear) = gear.filter(|text| text.parse() != Ok(1.0)) {
                    of_joints.iter().for_each(|name| found.gear(&gear, name));
                }
            }
        }
    }
    if !left_out.is_empty() {
        found.notes.push(format!(
            "{what}: {} is left out: its meaning is not documented, or not for one joint.",
            quoted(left_out)
        ));
    }
    Ok(())
}

/// Gears of `<ros2_control>`, and the names of its parameters.
fn ros2_control(node: Node<'_, '_>, found: &mut Omissions) {
    let what = format!("The <ros2_control> `{}`", name_of(node));
    let reductions = node
        .descendants()
        .filter(|node| matches!(tag(*node), "mechanical_reduction" | "mechanicalReduction"));
    for reduction in reductions {
        let text = reduction.text().unwrap_or_default().trim();
        let of = reduction.parent().map_or(String::new(), name_of);
        if is_number(text) && text.parse() != Ok(1.0) {
            found.gear(&shortened(text), &of);
        }
    }
    let parameters = node.descendants().filter(|node| tag(*node) == "param" && has_numbers(*node));
    let names: BTreeSet<String> = parameters.map(name_of).collect();
    if !names.is_empty() {
        found.notes.push(format!("{what}: the parameters {} are left out.", quoted(names)));
    }
}

/// Springs of `<gazebo reference="JOINT">`, and the names of what else it states of a link's or a
/// joint's motion.
fn gazebo(
    node: Node<'_, '_>,
    joints: &mut [Joint],
    index: &HashMap<String, usize>,
    notes: &mut Vec<String>,
) -> Result<()> {
    let Some(reference) = node.attribute("reference") else {
        return Ok(());
    };
    let of = shortened(reference);
    let [stiffness, rest] =
        ["springStiffness", "springReference"].map(|tag| child(node, tag).map(text_number));
    let (stiffness, rest) = (stiffness.transpose()?, rest.transpose()?);
    let mut left_out = BTreeSet::new();
    match index.get(reference).map(|&j| &mut joints[j]) {
        Some(joint) => {
            let stated = joint.spring;
            let spring = [stiffness.unwrap_or(stated[0]), rest.unwrap_or(stated[1])];
            if stated[0] != 0.0 && spring != stated {
                notes.push(format!(
                    "Joint `{of}` has a spring of {} about {} in <dynamics> and of {} about {} in \
                     <gazebo>: the latter is taken.",
                    stated[0], stated[1], spring[0], spring[1]
                ));
            }
            joint.spring = spring;
        }
        None if stiffness.is_some() => {
            left_out.insert("springStiffness".to_owned());
        }
        None => {}
    }
    for inner in node.children().filter(Node::is_element) {
        let is_weightless = |node: Node<'_, '_>| {
            let text = node.text().unwrap_or_default().trim();
            matches!(
                (tag(node), text),
                ("gravity", "0" | "false") | ("turnGravityOff", "1" | "true")
            )
        };
        match tag(inner) {
            "springStiffness" | "springReference" => {}
            name if NOT_DYNAMICS.contains(&name) => {}
            _ if is_weightless(inner) => notes.push(format!(
                "The <gazebo> of `{of}` switches its gravity off, which is left out: gravity acts \
                 on the whole robot."
            )),
            "gravity" | "turnGravityOff" | "implicitSpringDamper" => {}
            name if has_numbers(inner) => {
                left_out.insert(shortened(name));
            }
            _ => {}
        }
    }
    if !left_out.is_empty() {
        notes.push(format!("The <gazebo> of `{of}`: {} is left out.", quoted(left_out)));
    }
    Ok(())
}

/// Settings by which MuJoCo changes the inertias of a URDF.
fn mujoco(node: Node<'_, '_>, notes: &mut Vec<String>) {
    let names = ["balanceinertia", "boundinertia", "boundmass", "inertiafromgeom", "settotalmass"];
    let compilers = children(node, "compiler");
    let stated: BTreeSet<String> = compilers
        .flat_map(|node| names.into_iter().filter(move |name| node.has_attribute(*name)))
        .map(str::to_owned)
        .collect();
    if !stated.is_empty() {
        notes.push(format!(
            "The <mujoco> section: {}, by which MuJoCo changes inertias, is left out: they are \
             those of the file.",
            quoted(stated)
        ));
    }
}
