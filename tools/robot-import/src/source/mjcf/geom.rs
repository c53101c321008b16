//! Masses and inertias of geoms: solid primitives of one density.

use std::f64::consts::PI;

use dynamics_core::glam::DVec3;

use super::compiler::Compiler;
use super::defaults::View;
use super::pose::{Placement, to_axis};
use crate::description::Pose;
use crate::error::Result;

const KNOWN: &str = "adhesion axisangle castshadow class conaffinity condim contype density euler \
    fitscale fluidcoef fluidshape friction fromto gap group hfield margin mass material mesh name \
    pos priority quat rgba shellinertia size solimp solmix solref surfacevel type user xyaxes \
    zaxis";

/// Mass and inertia of a geom.
pub struct Solid {
    /// Mass, kg.
    pub mass: f64,
    /// Principal inertias along the axes of `frame`, kg·m².
    pub inertia: [f64; 3],
    /// The geom's frame in its body's.
    pub frame: Placement,
}

/// The share of a geom in its body's inertia.
pub enum Geom {
    /// The geom has no mass.
    Massless,
    /// The geom is a solid.
    Solid(Box<Solid>),
    /// The solid of a mesh, which is not read.
    Mesh,
}

/// A geom; `frame` is the frame that its placement is given in.
///
/// # Errors
/// A geom without a size, or a shape that is not known.
pub fn read(view: View<'_>, frame: &Placement, compiler: &Compiler) -> Result<Geom> {
    let element = view.element;
    element.only(KNOWN)?;
    let [group] = view.numbers("group")?.unwrap_or([0.0]);
    let [least, most] = compiler.groups;
    let mass = view.numbers::<1>("mass")?.map(|[mass]| mass);
    let [density] = view.numbers("density")?.unwrap_or([1_000.0]);
    if mass.unwrap_or_default() < 0.0 || density < 0.0 {
        return Err(element.value("its mass or density is negative"));
    }
    let empty = mass.unwrap_or(density) == 0.0;
    let shape = view.get("type").unwrap_or("sphere");
    if empty || !(least..=most).contains(&group) || matches!(shape, "plane" | "hfield") {
        return Ok(Geom::Massless);
    }
    // A primitive with the name of a mesh is fitted to the mesh.
    if matches!(shape, "mesh" | "sdf") || view.get("mesh").is_some() {
        return Ok(Geom::Mesh);
    }
    if view.flag("shellinertia")? == Some(true) {
        let reason = "only solids are read: state the inertia of the body by <inertial>";
        return Err(element.unsupported("shellinertia", "true", reason));
    }
    let mut size = sizes(view)?;
    let placement = match view.numbers::<6>("fromto")? {
        None => Placement::read(view, compiler)?,
        Some(ends) => {
            let (placement, half) = between(view, ends)?;
            let radius = size[0];
            size = match shape {
                "capsule" | "cylinder" => [radius, half, 0.0],
                "box" | "ellipsoid" => [radius, radius, half],
                _ => {
                    let sentence = "`fromto` requires a capsule, a cylinder, a box or an ellipsoid";
                    return Err(element.value(sentence));
                }
            };
            placement
        }
    };
    let Some((count, volume, per_mass)) = solid(shape, size) else {
        let reason = "known are sphere, capsule, cylinder, box, ellipsoid, plane, hfield and mesh";
        return Err(element.unsupported("type of geom", shape, reason));
    };
    if !size[..count].iter().all(|x| *x > 0.0) {
        let sentence = format!("a {shape} requires {count} positive numbers as its size");
        return Err(element.value(sentence));
    }
    let mass = mass.unwrap_or(density * volume);
    Ok(Geom::Solid(Box::new(Solid {
        mass,
        inertia: per_mass.map(|inertia| mass * inertia),
        frame: frame.poses(&placement),
    })))
}

/// The sizes; those that the geom leaves out are from its class.
fn sizes(view: View<'_>) -> Result<[f64; 3]> {
    let mut size = [0.0; 3];
    let levels: Vec<_> = view.levels().collect();
    for element in levels.into_iter().rev() {
        if let Some(text) = element.get("size") {
            let stated = view.parsed("size", text, [1, 3])?;
            size[..stated.len()].copy_from_slice(&stated);
        }
    }
    Ok(size)
}

/// The placement in the middle of two points with the z axis along them, and half of their
/// distance.
fn between(view: View<'_>, ends: [f64; 6]) -> Result<(Placement, f64)> {
    if view.get("pos").is_some() {
        return Err(view.element.value("`pos` and `fromto` exclude each other"));
    }
    let [from, to] = [DVec3::from_slice(&ends[..3]), DVec3::from_slice(&ends[3..])];
    let length = (from - to).length();
    if !(1e-10..1e10).contains(&length) {
        return Err(view.element.value("`fromto` has no direction"));
    }
    let pose = Pose { position: 0.5 * (from + to), rotation: to_axis((from - to) / length) };
    Ok((Placement::computed(pose), 0.5 * length))
}

/// The number of sizes, the volume and the principal inertias of unit mass.
fn solid(shape: &str, [a, b, c]: [f64; 3]) -> Option<(usize, f64, [f64; 3])> {
    let diagonal = |by: f64| [b * b + c * c, a * a + c * c, a * a + b * b].map(|sum| sum / by);
    Some(match shape {
        "sphere" => (1, 4.0 / 3.0 * PI * a * a * a, [0.4 * a * a; 3]),
        "box" => (3, 8.0 * a * b * c, diagonal(3.0)),
        "ellipsoid" => (3, 4.0 / 3.0 * PI * a * b * c, diagonal(5.0)),
        "cylinder" => {
            let across = a * a / 4.0 + b * b / 3.0;
            (2, 2.0 * PI * a * a * b, [across, across, a * a / 2.0])
        }
        "capsule" => {
            // A cylinder of half length b between two halves of a sphere, whose centres of mass are
            // 3a/8 outside of it.
            let ends = 4.0 / 3.0 * PI * a * a * a;
            let middle = 2.0 * PI * a * a * b;
            let part = ends / (ends + middle);
            let across = part * (0.4 * a * a + b * b + 0.75 * a * b)
                + (1.0 - part) * (a * a / 4.0 + b * b / 3.0);
            let along = part * 0.4 * a * a + (1.0 - part) * a * a / 2.0;
            (2, ends + middle, [across, across, along])
        }
        _ => return None,
    })
}
