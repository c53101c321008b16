//! A joint of a body.

use dynamics_core::glam::{DMat3, DVec3};

use super::compiler::Compiler;
use super::defaults::View;
use super::pose::Placement;
use crate::description::{Joint, Kind, Limits, Pose};
use crate::error::Result;

const KNOWN: &str = "actuatorfrclimited actuatorfrcrange actuatorgravcomp align armature axis \
    class damping frictionloss group limited margin name pos range ref solimpfriction solimplimit \
    solreffriction solreflimit springdamper springref springyield stiffness type user";

/// A joint as its body has it.
pub struct Parsed {
    /// The kind of the joint.
    pub kind: Kind,
    /// Its anchor in the body's frame; without rotation.
    pub anchor: Placement,
    /// From the configuration of the file to q = 0.
    pub back: Placement,
    /// The position in the configuration of the file, rad or m.
    pub reference: f64,
    axis: DVec3,
    limits: Limits,
    damping: f64,
    friction: f64,
    armature: f64,
    spring: [f64; 2],
}

/// A joint in the frames around it.
///
/// # Errors
/// A kind or an attribute that is not in the subset.
pub fn read(
    view: View<'_>,
    frame: &Placement,
    name: &str,
    compiler: &Compiler,
    notes: &mut Vec<String>,
) -> Result<Parsed> {
    let element = view.element;
    element.only(KNOWN)?;
    if element.tag == "freejoint" {
        return Ok(free(View::plain(element), name, notes));
    }
    let (kind, unit) = match view.get("type").unwrap_or("hinge") {
        "hinge" => (Kind::Revolute, compiler.angle),
        "slide" => (Kind::Prismatic, 1.0),
        "ball" => (Kind::Spherical, compiler.angle),
        "free" => (Kind::Free, 1.0),
        word => {
            let reason = "known are hinge, slide, ball and free";
            return Err(element.unsupported("type of joint", word, reason));
        }
    };
    let mut parsed = free(view, name, notes);
    parsed.damping = coefficient(view, "damping")?;
    parsed.friction = view.number("frictionloss")?;
    parsed.armature = view.number("armature")?;
    let spring = spring(view, kind, unit, name, notes)?;
    if kind == Kind::Free {
        return Ok(parsed);
    }
    parsed.kind = kind;
    parsed.spring = spring;
    parsed.anchor = anchor(view, frame)?;
    parsed.axis = match kind.has_axis() {
        true => {
            let axis = DVec3::from_array(view.numbers("axis")?.unwrap_or([0.0, 0.0, 1.0]));
            let [given, exact] = [&frame.pose, &frame.exact].map(|pose| pose.rotation * axis);
            // Without the rounding of the computation here, but with that of the file.
            match given.abs_diff_eq(exact, 1e-12) {
                true => exact,
                false => given,
            }
        }
        false => DVec3::Z,
    };
    let range = view.range("range", "limited", compiler.autolimits)?;
    parsed.limits.position = range.map(|range| range.map(|x| x * unit));
    if kind == Kind::Spherical && parsed.limits.position.take().is_some() {
        notes.push(format!("joint `{name}`: the limit of a ball joint is left out"));
    }
    if kind == Kind::Revolute && parsed.limits.position.is_none() {
        parsed.kind = Kind::Continuous;
    }
    if kind.has_axis() {
        let effort = view.range("actuatorfrcrange", "actuatorfrclimited", compiler.autolimits)?;
        parsed.limits.effort =
            effort.map(|range| greatest(range, &format!("joint `{name}`"), notes));
        parsed.reference = view.number("ref")? * unit;
    }
    if parsed.reference != 0.0 {
        // An axis without length is refused with the description.
        let axis = parsed.axis.normalize_or_zero();
        parsed.back = Placement::computed(match kind {
            Kind::Prismatic => Pose::translation(-axis * parsed.reference),
            _ => Pose {
                position: DVec3::ZERO,
                rotation: match axis == DVec3::ZERO {
                    true => DMat3::IDENTITY,
                    false => DMat3::from_axis_angle(axis, -parsed.reference),
                },
            },
        });
    }
    Ok(parsed)
}

fn free(view: View<'_>, name: &str, notes: &mut Vec<String>) -> Parsed {
    if view.get("align") == Some("true") {
        notes.push(format!(
            "joint `{name}`: align: the frame of the body stays as it is in the file"
        ));
    }
    Parsed {
        kind: Kind::Free,
        anchor: Placement::IDENTITY,
        back: Placement::IDENTITY,
        reference: 0.0,
        axis: DVec3::Z,
        limits: Limits::default(),
        damping: 0.0,
        friction: 0.0,
        armature: 0.0,
        spring: [0.0; 2],
    }
}

fn anchor(view: View<'_>, frame: &Placement) -> Result<Placement> {
    let mut anchor = frame.then(&Placement::position(view, "pos")?);
    // The frames around a joint move its anchor and turn its axis, but its frame stays parallel to
    // the body's.
    anchor.pose.rotation = DMat3::IDENTITY;
    anchor.exact.rotation = DMat3::IDENTITY;
    Ok(anchor)
}

/// The first coefficient of a polynomial whose others have to be zero.
fn coefficient(view: View<'_>, attribute: &str) -> Result<f64> {
    let all = view.list(attribute, [1, 3])?.unwrap_or_default();
    if all.iter().skip(1).any(|x| *x != 0.0) {
        let sentence = format!("`{attribute}` is not linear: state its first coefficient only");
        return Err(view.element.value(sentence));
    }
    Ok(all.first().copied().unwrap_or_default())
}

/// Stiffness and rest position of a linear spring at a hinge or a slide; that of another is left
/// out.
fn spring(
    view: View<'_>,
    kind: Kind,
    unit: f64,
    name: &str,
    notes: &mut Vec<String>,
) -> Result<[f64; 2]> {
    let [time, ratio] = view.numbers("springdamper")?.unwrap_or_default();
    if time > 0.0 && ratio > 0.0 {
        let sentence = "`springdamper` sets the damping from inertias: state `stiffness` and \
            `damping` instead";
        return Err(view.element.value(sentence));
    }
    let stiffness = view.list("stiffness", [1, 3])?.unwrap_or_default();
    let is_linear = stiffness.iter().skip(1).all(|x| *x == 0.0);
    if let (true, true, Some(stiffness)) = (kind.has_axis(), is_linear, stiffness.first()) {
        return Ok([*stiffness, view.number("springref")? * unit]);
    }
    if stiffness.iter().any(|x| *x != 0.0) {
        let text = view.get("stiffness").unwrap_or_default();
        let reference = view.get("springref").unwrap_or("0");
        notes.push(format!(
            "joint `{name}`: the spring of stiffness {text} about {reference} is left out"
        ));
    }
    Ok([0.0; 2])
}

/// The greater end of a range of torques or forces.
pub fn greatest([low, high]: [f64; 2], what: &str, notes: &mut Vec<String>) -> f64 {
    if low != -high {
        notes.push(format!(
            "{what}: its effort is from {low} to {high}; the greater absolute value is the limit \
             in both directions"
        ));
    }
    low.abs().max(high.abs())
}

impl Parsed {
    /// The joint between two links.
    pub fn joint(
        &self,
        name: String,
        line: u32,
        [parent, child]: [usize; 2],
        origin: Placement,
    ) -> Joint {
        Joint {
            name,
            line,
            kind: self.kind,
            parent,
            child,
            origin: origin.pose,
            snapped: origin.snapped,
            exact: origin.exact,
            axis: self.axis,
            limits: self.limits,
            damping: self.damping,
            friction: self.friction,
            armature: self.armature,
            spring: self.spring,
            driven: false,
            mimic: None,
        }
    }
}

/// A joint without motion.
pub fn fixed(name: String, line: u32, [parent, child]: [usize; 2], origin: Placement) -> Joint {
    Joint {
        name,
        line,
        kind: Kind::Fixed,
        parent,
        child,
        origin: origin.pose,
        snapped: origin.snapped,
        exact: origin.exact,
        axis: DVec3::X,
        limits: Limits::default(),
        damping: 0.0,
        friction: 0.0,
        armature: 0.0,
        spring: [0.0; 2],
        driven: false,
        mimic: None,
    }
}
