//! The Rust file of a tree: the same numbers as the model that was checked.

mod body;
mod constants;
mod names;
#[cfg(feature = "program")]
mod rustfmt;

use std::collections::BTreeSet;
use std::fmt::Write as _;

pub use body::placed;
pub use names::{given_type_name, renamed, type_name, type_of};
#[cfg(feature = "program")]
pub use rustfmt::formatted;

use crate::physical::{TOLERANCE, impossible, sentence};
use crate::text::{code_span, doc_name, doc_sentence, string_literal, visible};
use crate::tree::{Body, Tree};

/// The words of the file's head about its source.
#[derive(Clone, Debug)]
pub struct Origin {
    /// The name of the source file.
    pub file: String,
    /// Its licence, if it states one.
    pub licence: Option<String>,
    /// The day of the import.
    pub date: String,
    /// The parts that were left out or changed besides merged links and roundings, a sentence each.
    pub notes: Vec<String>,
}

/// The file of a tree, not yet formatted.
pub fn source(tree: &Tree, name: &str, type_name: &str, origin: &Origin) -> String {
    let mut out = head(tree, name, origin);
    let [q, v] = tree.coordinates();
    let b = tree.bodies.len();
    let single = b == q && b == v;
    let coupled = tree.has_followers() && single;
    out +=
        "\n#![allow(dead_code, reason = \"not every program uses every constant of its robot\")]\n";
    out += "#![allow(clippy::approx_constant, reason = \"numbers are those of the file\")]\n\n";
    let angles: BTreeSet<&str> = tree.bodies.iter().flat_map(body::constants).collect();
    if !angles.is_empty() {
        let names: Vec<&str> = angles.into_iter().collect();
        let _ = writeln!(out, "use ::core::f64::consts::{{{}}};\n", names.join(", "));
    }
    if coupled {
        out += "use ::dynamics_core::drivetrain::Transmission;\n";
    }
    let limited = if tree.bodies.iter().any(|body| body::limits(body).is_some()) {
        ", JointLimits"
    } else {
        ""
    };
    let base = if tree.bodies.iter().any(|body| body.parent.is_none()) { "BASE, " } else { "" };
    let arm = if single { "ArmModel, " } else { "" };
    let spring = if tree.has_springs() { "Spring, " } else { "" };
    let _ = writeln!(
        out,
        "use ::dynamics_core::effects::{{Armature, Coriolis, Coulomb, Gravity, Inertia, {spring}Viscous, Width}};"
    );
    let _ = writeln!(
        out,
        "use ::dynamics_core::model::{{{arm}{base}Body, Joint{limited}, Model, Robot}};"
    );
    let _ = writeln!(out, "\n/// The number of bodies.\npub const B: usize = {b};");
    let _ = writeln!(out, "/// The number of position coordinates.\npub const Q: usize = {q};");
    let _ = writeln!(out, "/// The number of velocity coordinates.\npub const V: usize = {v};");
    if single {
        out += "/// The number of joints.\npub const N: usize = V;\n";
    }
    let list = |of: fn(&Body) -> &String| {
        let names: Vec<String> = tree.bodies.iter().map(|body| string_literal(of(body))).collect();
        names.join(", ")
    };
    let _ = writeln!(
        out,
        "\n/// The names of the bodies.\npub const BODIES: [&str; B] = [{}];",
        list(|body| &body.name)
    );
    let _ = writeln!(
        out,
        "/// The names of their joints.\npub const JOINTS: [&str; B] = [{}];",
        list(|body| &body.joint)
    );
    let _ = writeln!(
        out,
        "\n/// {}: {} on {v} degrees of freedom.",
        doc_name(name),
        counted(b, "body", "bodies")
    );
    let _ = writeln!(out, "#[derive(Clone, Copy, Debug, Default)]\npub struct {type_name};\n");
    let model =
        if single { format!("ArmModel<f64, {b}>") } else { format!("Model<f64, {b}, {q}, {v}>") };
    let _ = writeln!(
        out,
        "impl Robot<{b}, {q}, {v}> for {type_name} {{\nconst MODEL: {model} = Model::new({}, [",
        string_literal(name)
    );
    tree.bodies.iter().for_each(|body| out += &body::entry(body));
    let _ = writeln!(
        out,
        "]);\n}}\n\n// A robot with an impossible joint or a negative mass does not compile.{}\nconst _: {model} = {type_name}::MODEL;",
        inertias(tree)
    );
    out += &constants::effects(tree, type_name);
    if coupled {
        out += &constants::coupling(tree);
    }
    out
}

/// Which bodies have an inertia that no body has, each on a line of a comment: such a robot is
/// computed with all the same.
fn inertias(tree: &Tree) -> String {
    let each = tree.bodies.iter().filter_map(|body| {
        let words = sentence(&impossible(body.inertia.inertia, TOLERANCE)?);
        Some(format!(
            "\n// Body `{}` has an impossible inertia, which compiles. {words}",
            visible(&body.name)
        ))
    });
    each.collect()
}

/// A number with its noun.
fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

fn head(tree: &Tree, name: &str, origin: &Origin) -> String {
    let mut out = format!("//! {}.\n//!\n//! # Source\n//!\n", doc_name(name));
    let licence = match &origin.licence {
        Some(licence) => format!("licence as its comments state it: {}", doc_sentence(licence)),
        None => "it states no licence".to_owned(),
    };
    let _ = writeln!(
        out,
        "//! {}; {licence}. Imported on {} by robot-import {}.",
        code_span(&origin.file),
        visible(&origin.date),
        env!("CARGO_PKG_VERSION"),
    );
    let mut changes = Vec::new();
    for body in &tree.bodies {
        if !body.merged.is_empty() {
            let links: Vec<String> = body.merged.iter().map(|link| code_span(link)).collect();
            changes.push(format!("Part of body {}: {}.", code_span(&body.name), links.join(", ")));
        }
    }
    for body in &tree.bodies {
        for snap in &body.snapped {
            changes.push(format!(
                "Joint {}: {} {} is {}.",
                code_span(&body.joint),
                visible(&snap.attribute),
                code_span(&snap.text),
                snap.exact
            ));
        }
    }
    changes.extend(origin.notes.iter().map(|note| doc_sentence(note)));
    if !changes.is_empty() {
        out += "//!\n//! # Changed\n//!\n";
        for change in changes {
            let _ = writeln!(out, "//! - {change}");
        }
    }
    out
}
