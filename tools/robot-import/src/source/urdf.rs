//! URDF, versions 1.0 to 1.2: links, joints, their dynamics and mimics.

use roxmltree::Node;

use super::lines::Lines;
use super::xml::{self, child, children, number, numbers, required};
use super::{extensions, xacro};
use crate::description::{
    Description, Format, Inertial, Joint, Kind, Limits, Link, Mimic, Pose, Snap, index_of,
    shortened,
};
use crate::error::{Problem, Result};
use crate::snap;
use dynamics_core::glam::{DMat3, DQuat, DVec3};

/// The robot of a document whose root is `<robot>`.
pub fn read(root: Node<'_, '_>) -> Result<Description> {
    let version = root.attribute("version").unwrap_or("1.0");
    if !matches!(version, "1.0" | "1.1" | "1.2") {
        let problem = Problem::Unsupported {
            what: "version",
            word: version.to_owned(),
            reason: "URDF has the versions 1.0 to 1.2".to_owned(),
        };
        return Err(xml::error(root, problem));
    }
    xacro::refuse(root)?;
    let mut notes = xacro::left_out(root);
    // The version that has quaternions (urdfdom).
    let quaternions = version != "1.0";
    let count = children(root, "link").count().max(children(root, "joint").count());
    super::few_enough(count)?;
    let links = children(root, "link").map(|node| link(node, quaternions));
    let links = links.collect::<Result<Vec<_>>>()?;
    // Transmissions have elements of the same tag; they are no children of the root.
    let joints = children(root, "joint").map(|node| joint(node, &links, quaternions));
    let mut joints = joints.collect::<Result<Vec<_>>>()?;
    notes.extend(children(root, "joint").flat_map(not_read));
    notes.extend(extensions::read(root, &mut joints)?);
    if !quaternions {
        notes.extend(root.descendants().filter_map(ignored_quaternion));
    }
    let mut robot = Description {
        name: root.attribute("name").unwrap_or("robot").to_owned(),
        format: Format::Urdf,
        licence: None,
        joints,
        links,
        loops: Vec::new(),
        notes,
        files: Vec::new(),
    };
    // So far offsets.
    let lines = Lines::of(root.document().input_text());
    let of_links = robot.links.iter_mut().map(|link| &mut link.line);
    let of_joints = robot.joints.iter_mut().map(|joint| &mut joint.line);
    for line in of_links.chain(of_joints) {
        *line = lines.line(*line);
    }
    Ok(robot)
}

fn link(node: Node<'_, '_>, quaternions: bool) -> Result<Link> {
    let inertial = child(node, "inertial").map(|inertial| mass(node, inertial, quaternions));
    let (inertial, snapped) = inertial.transpose()?.unzip();
    Ok(Link {
        name: required(node, "name")?.to_owned(),
        line: xml::offset(node),
        inertial,
        snapped: snapped.unwrap_or_default(),
        of_mesh: false,
    })
}

/// An inertia, with the roundings of its frame.
fn mass(
    link: Node<'_, '_>,
    node: Node<'_, '_>,
    quaternions: bool,
) -> Result<(Inertial, Vec<Snap>)> {
    let missing = |tag| xml::error(link, Problem::MissingElement(tag));
    let mass = child(node, "mass").ok_or_else(|| missing("mass"))?;
    let inertia = child(node, "inertia").ok_or_else(|| missing("inertia"))?;
    let mut entries = [0.0; 6];
    let names = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
    for (entry, name) in entries.iter_mut().zip(names) {
        required(inertia, name)?;
        *entry = number(inertia, name)?.unwrap_or_default();
    }
    required(mass, "value")?;
    let frame = child(node, "origin").map(|node| origin(node, quaternions));
    let frame = frame.transpose()?.unwrap_or(Origin::NONE);
    let inertial = Inertial {
        mass: number(mass, "value")?.unwrap_or_default(),
        frame: frame.pose,
        exact: frame.exact,
        inertia: entries,
    };
    Ok((inertial, frame.snapped))
}

/// A placement as the file has it, and with exact values in place of roundings.
struct Origin {
    pose: Pose,
    exact: Pose,
    snapped: Vec<Snap>,
}

impl Origin {
    /// The placement without a displacement.
    const NONE: Self = Self { pose: Pose::IDENTITY, exact: Pose::IDENTITY, snapped: Vec::new() };
}

fn origin(node: Node<'_, '_>, quaternions: bool) -> Result<Origin> {
    let mut snapped = Vec::new();
    let position = numbers::<3>(node, "xyz")?.unwrap_or_default();
    let mut exact_position = position;
    for (x, name) in exact_position.iter_mut().zip(["x", "y", "z"]) {
        if *x != 0.0 && x.abs() < snap::NO_LENGTH {
            snapped.push(Snap {
                attribute: name.to_owned(),
                text: format!("{x:e}"),
                exact: "0".to_owned(),
                difference: *x,
            });
            *x = 0.0;
        }
    }
    let stated = match quaternions {
        true => numbers::<4>(node, "quat_xyzw")?,
        false => None,
    };
    let (rotation, exact) = match stated {
        Some(_) if node.has_attribute("rpy") => {
            let problem = Problem::Value("`rpy` and `quat_xyzw` exclude each other".to_owned());
            return Err(xml::error(node, problem));
        }
        Some(xyzw) => quaternion(node, xyzw, &mut snapped)?,
        None => angles(node, &mut snapped)?,
    };
    let pose =
        |position: [f64; 3], rotation| Pose { position: DVec3::from_array(position), rotation };
    Ok(Origin { pose: pose(position, rotation), exact: pose(exact_position, exact), snapped })
}

/// The rotation by `rpy`, and the exact one.
fn angles(node: Node<'_, '_>, snapped: &mut Vec<Snap>) -> Result<(DMat3, DMat3)> {
    let angles = numbers::<3>(node, "rpy")?.unwrap_or_default();
    let texts = node.attribute("rpy").unwrap_or("0 0 0");
    let mut exact = angles.map(f64::sin_cos);
    let names = ["roll", "pitch", "yaw"];
    let each = texts.split_ascii_whitespace().zip(angles).zip(names);
    for (sin_cos, ((text, angle), name)) in exact.iter_mut().zip(each) {
        let Some(turns) = snap::quarter_turns(angle, snap::resolution(text)) else {
            continue;
        };
        *sin_cos = snap::sin_cos(turns);
        let difference = angle - f64::from(turns) * std::f64::consts::FRAC_PI_2;
        if difference != 0.0 {
            snapped.push(Snap {
                attribute: name.to_owned(),
                text: text.to_owned(),
                exact: snap::words(turns).to_owned(),
                difference,
            });
        }
    }
    Ok((snap::rpy(angles.map(f64::sin_cos)), snap::rpy(exact)))
}

/// The rotation by a quaternion, and the exact one.
fn quaternion(
    node: Node<'_, '_>,
    xyzw: [f64; 4],
    snapped: &mut Vec<Snap>,
) -> Result<(DMat3, DMat3)> {
    let given = DQuat::from_array(xyzw);
    let length = given.length();
    if !(1e-3..1e3).contains(&length) {
        return Err(xml::not_numbers(node, "quat_xyzw", 4));
    }
    let rotation = DMat3::from_quat(given / length);
    let text = node.attribute("quat_xyzw").unwrap_or_default();
    let resolutions = text.split_ascii_whitespace().map(snap::resolution);
    let resolution = match snap::states_a_small_entry(&xyzw.map(|x| x / length)) {
        true => 0.0,
        false => resolutions.fold(0.0, f64::max),
    };
    let Some((exact, difference)) = snap::permutation(&rotation, 2.0 * resolution) else {
        return Ok((rotation, rotation));
    };
    if difference != 0.0 {
        snapped.push(Snap {
            attribute: "quat_xyzw".to_owned(),
            text: text.to_owned(),
            exact: "quarter turns".to_owned(),
            difference,
        });
    }
    Ok((rotation, exact))
}

/// The orientation that version 1.0 does not have, as a sentence, where a link or a joint states
/// it.
fn ignored_quaternion(node: Node<'_, '_>) -> Option<String> {
    node.attribute("quat_xyzw")?;
    let part = node
        .ancestors()
        .skip(1)
        .find(|node| ["inertial", "link", "joint"].iter().any(|tag| xml::tag(*node) == *tag))?;
    let of = part.ancestors().find(|node| node.has_attribute("name"))?;
    // Looks and shapes have placements, too.
    if xml::tag(part) == "link" {
        return None;
    }
    Some(format!(
        "The `quat_xyzw` of the <{}> of {} `{}` is left out, since URDF has it from version 1.1 \
         on: state version=\"1.1\" in <robot>, or `rpy`.",
        xml::tag(node),
        xml::tag(of),
        shortened(of.attribute("name").unwrap_or_default()),
    ))
}

/// The statements of a joint that the import leaves out, a sentence each.
fn not_read(node: Node<'_, '_>) -> Vec<String> {
    let name = shortened(node.attribute("name").unwrap_or_default());
    let mut notes = Vec::new();
    let text = |node: Node<'_, '_>, attribute| node.attribute(attribute).map(shortened);
    if let Some(soft) = child(node, "safety_controller") {
        let ends = ["soft_lower_limit", "soft_upper_limit"].map(|end| text(soft, end));
        if ends.iter().any(Option::is_some) {
            let [lower, upper] = ends.map(|end| end.unwrap_or("0".to_owned()));
            notes.push(format!(
                "The soft limits {lower} to {upper} of joint `{name}` are left out; its limits are \
                 those of its <limit>."
            ));
        }
    }
    if let (Some("continuous"), Some(limit)) = (node.attribute("type"), child(node, "limit")) {
        let ends = ["lower", "upper"].map(|end| text(limit, end));
        if ends.iter().any(Option::is_some) {
            let [lower, upper] = ends.map(|end| end.unwrap_or("0".to_owned()));
            notes.push(format!(
                "The limits of position {lower} to {upper} of joint `{name}` are left out: a \
                 continuous joint has none, a revolute one has."
            ));
        }
    }
    notes
}

fn joint(node: Node<'_, '_>, links: &[Link], quaternions: bool) -> Result<Joint> {
    let name = required(node, "name")?.to_owned();
    let kind = match required(node, "type")? {
        "fixed" => Kind::Fixed,
        "revolute" => Kind::Revolute,
        "continuous" => Kind::Continuous,
        "prismatic" => Kind::Prismatic,
        "spherical" => Kind::Spherical,
        "planar" => Kind::Planar,
        "floating" => Kind::Free,
        word => {
            let problem = Problem::Unsupported {
                what: "joint type",
                word: crate::description::shortened(word),
                reason: "known are fixed, revolute, continuous, prismatic, spherical, planar and \
                    floating"
                    .to_owned(),
            };
            return Err(xml::error(node, problem));
        }
    };
    let end = |tag: &'static str| -> Result<usize> {
        let end = child(node, tag).ok_or_else(|| xml::error(node, Problem::MissingElement(tag)))?;
        let names = links.iter().map(|link| link.name.as_str());
        let found = index_of(required(end, "link")?, "link", names);
        found.map_err(|error| xml::error(node, error.problem))
    };
    let at = child(node, "origin").map(|node| origin(node, quaternions));
    let at = at.transpose()?.unwrap_or(Origin::NONE);
    let axis = match child(node, "axis") {
        Some(axis) => numbers::<3>(axis, "xyz")?,
        None => None,
    };
    let dynamics = child(node, "dynamics");
    let of_dynamics = |attribute| -> Result<f64> {
        let stated = dynamics.map(|dynamics| number(dynamics, attribute));
        Ok(stated.transpose()?.flatten().unwrap_or_default())
    };
    let limits = limits(node)?;
    let (spring, armature) = extensions::dynamics(dynamics)?;
    Ok(Joint {
        line: xml::offset(node),
        parent: end("parent")?,
        child: end("child")?,
        origin: at.pose,
        exact: at.exact,
        snapped: at.snapped,
        axis: DVec3::from_array(axis.unwrap_or([1.0, 0.0, 0.0])),
        limits,
        driven: limits.effort.is_some_and(|effort| effort > 0.0),
        damping: of_dynamics("damping")?,
        friction: of_dynamics("friction")?,
        armature,
        spring,
        mimic: child(node, "mimic").map(mimic).transpose()?,
        name,
        kind,
    })
}

fn limits(node: Node<'_, '_>) -> Result<Limits> {
    let Some(limit) = child(node, "limit") else {
        return Ok(Limits::default());
    };
    let [lower, upper] = [xml::limit(limit, "lower")?, xml::limit(limit, "upper")?];
    let stated = lower.is_some() || upper.is_some();
    let position = [lower.unwrap_or_default(), upper.unwrap_or_default()];
    Ok(Limits {
        position: stated.then_some(position),
        velocity: xml::limit(limit, "velocity")?,
        effort: xml::limit(limit, "effort")?,
    })
}

fn mimic(node: Node<'_, '_>) -> Result<Mimic> {
    Ok(Mimic {
        joint: required(node, "joint")?.to_owned(),
        multiplier: number(node, "multiplier")?.unwrap_or(1.0),
        offset: number(node, "offset")?.unwrap_or(0.0),
    })
}
