//! A body's entry in the Rust file.

use std::fmt::Write as _;

use crate::description::Kind;
use crate::number::{Attitude, angle, literal};
use crate::physical::{TOLERANCE, impossible};
use crate::text::string_literal;
use crate::tree::Body;

/// The constants of π in a body's attitude.
pub fn constants(body: &Body) -> Vec<&'static str> {
    let Attitude::Rpy(rpy) = body.attitude else {
        return Vec::new();
    };
    let name = |x: f64| match angle(x).trim_start_matches('-') {
        "PI" => Some("PI"),
        "FRAC_PI_2" => Some("FRAC_PI_2"),
        _ => None,
    };
    rpy.into_iter().filter_map(name).collect()
}

fn list<const N: usize>(values: [f64; N]) -> String {
    format!("[{}]", values.map(literal).join(", "))
}

/// The calls that place a frame; none for what is zero.
pub fn placed(xyz: [f64; 3], attitude: Attitude) -> String {
    let mut out = String::new();
    if xyz != [0.0; 3] {
        let _ = write!(out, ".xyz({})", list(xyz));
    }
    match attitude {
        Attitude::QuarterTurns([0, 0, 0]) => {}
        Attitude::QuarterTurns(turns) => {
            let _ = write!(out, ".quarter_turns({turns:?})");
        }
        Attitude::Rpy(rpy) => {
            let _ = write!(out, ".rpy([{}])", rpy.map(angle).join(", "));
        }
    }
    out
}

/// The entry of a body in the file.
pub fn entry(body: &Body) -> String {
    let axis = list(body.axis);
    let joint = match body.kind {
        Kind::Fixed => "fixed()".to_owned(),
        Kind::Revolute => format!("revolute({axis})"),
        Kind::Continuous => format!("continuous({axis})"),
        Kind::Prismatic => format!("prismatic({axis})"),
        Kind::Spherical => "spherical()".to_owned(),
        Kind::Planar => "planar()".to_owned(),
        Kind::Free => "free()".to_owned(),
    };
    let parent = body.parent.map_or("BASE".to_owned(), |parent| parent.to_string());
    let mut out = format!("Body::new({}, {parent}, Joint::{joint})", string_literal(&body.name));
    out += &placed(body.xyz, body.attitude);
    let own = &body.inertia;
    if own.mass != 0.0 {
        let _ = write!(out, ".mass({})", literal(own.mass));
    }
    if own.com != [0.0; 3] {
        let _ = write!(out, ".com({})", list(own.com));
    }
    if own.inertia != [0.0; 6] {
        let call = match impossible(own.inertia, TOLERANCE) {
            Some(found) if found.moment < 0.0 => "inertia_as_published",
            _ => "inertia",
        };
        let _ = write!(out, ".{call}({})", list(own.inertia));
    }
    if let Some(limits) = limits(body) {
        let _ = write!(out, ".limits({limits})");
    }
    out + ",\n"
}

/// The limits of a body's joint, if it has some.
pub fn limits(body: &Body) -> Option<String> {
    let given = &body.limits;
    let [lower, upper] = [0, 1].map(|i| given.position.map(|range| range[i]));
    let fields = [
        ("lower", lower),
        ("upper", upper),
        ("velocity", given.velocity),
        ("torque", given.effort),
    ];
    let stated: Vec<String> = fields
        .iter()
        .filter_map(|(name, value)| Some(format!("{name}: {}", literal((*value)?))))
        .collect();
    match stated.len() {
        0 => None,
        4 => Some(format!("JointLimits {{ {} }}", stated.join(", "))),
        _ => Some(format!("JointLimits {{ {}, ..JointLimits::NONE }}", stated.join(", "))),
    }
}
