//! The Rust file of a tree: the same numbers as the model that was checked.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::io::Write as _;
use std::process::{Command, Stdio};

use crate::description::Kind;
use crate::number::{Attitude, angle, literal};
use crate::tree::{Body, Tree};

/// What the file's head says of its source.
#[derive(Clone, Debug)]
pub struct Origin {
    /// The name of the source file.
    pub file: String,
    /// Its licence, if it states one.
    pub licence: Option<String>,
    /// The day of the import.
    pub date: String,
    /// What was left out or changed besides merged links and roundings, a sentence each.
    pub notes: Vec<String>,
}

/// The type's name: the robot's in CamelCase.
pub fn type_name(name: &str) -> String {
    let words = name.split(|c: char| !c.is_ascii_alphanumeric());
    let mut out = String::new();
    for word in words {
        let mut letters = word.chars();
        out.extend(letters.next().map(|first| first.to_ascii_uppercase()));
        out.extend(letters);
    }
    match out.chars().next() {
        Some(first) if first.is_ascii_alphabetic() => out,
        _ => format!("Robot{out}"),
    }
}

/// A text within a comment or a string: one line, no control characters.
fn plain(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).collect()
}

/// A string literal.
fn quoted(text: &str) -> String {
    format!("{:?}", plain(text))
}

/// The file of a tree, not yet formatted.
pub fn source(tree: &Tree, name: &str, origin: &Origin) -> String {
    let mut out = head(tree, name, origin);
    let [q, v] = tree.coordinates();
    let b = tree.bodies.len();
    let single = b == q && b == v;
    let coupled = tree.has_followers() && single;
    out += "\n#![allow(dead_code, reason = \"not every program uses every constant of its robot\")]\n\n";
    let angles: BTreeSet<&str> = tree.bodies.iter().flat_map(constants).collect();
    if !angles.is_empty() {
        let names: Vec<&str> = angles.into_iter().collect();
        let _ = writeln!(out, "use core::f64::consts::{{{}}};\n", names.join(", "));
    }
    if coupled {
        out += "use dynamics_core::drivetrain::Transmission;\n";
    }
    let limited = if tree.bodies.iter().any(|body| limits(body).is_some()) {
        ", JointLimits"
    } else {
        ""
    };
    let base = if tree.bodies.iter().any(|body| body.parent.is_none()) {
        "BASE, "
    } else {
        ""
    };
    let arm = if single { "ArmModel, " } else { "" };
    out += "use dynamics_core::effects::{Armature, Coriolis, Coulomb, Gravity, Inertia, Viscous, Width};\n";
    let _ = writeln!(
        out,
        "use dynamics_core::model::{{{arm}{base}Body, Joint{limited}, Model, Robot}};"
    );
    let _ = writeln!(
        out,
        "\n/// The number of bodies.\npub const B: usize = {b};"
    );
    let _ = writeln!(
        out,
        "/// The number of position coordinates.\npub const Q: usize = {q};"
    );
    let _ = writeln!(
        out,
        "/// The number of velocity coordinates.\npub const V: usize = {v};"
    );
    if single {
        out += "/// The number of joints.\npub const N: usize = V;\n";
    }
    let list = |of: fn(&Body) -> &String| {
        let names: Vec<String> = tree.bodies.iter().map(|body| quoted(of(body))).collect();
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
    let type_name = type_name(name);
    let _ = writeln!(
        out,
        "\n/// {}: {} on {v} degrees of freedom.",
        plain(name),
        counted(b, "body", "bodies")
    );
    let _ = writeln!(
        out,
        "#[derive(Clone, Copy, Debug, Default)]\npub struct {type_name};\n"
    );
    let model = if single {
        format!("ArmModel<f64, {b}>")
    } else {
        format!("Model<f64, {b}, {q}, {v}>")
    };
    let _ = writeln!(
        out,
        "impl Robot<{b}, {q}, {v}> for {type_name} {{\nconst MODEL: {model} = Model::new({}, [",
        quoted(name)
    );
    tree.bodies.iter().for_each(|body| out += &one(body));
    let _ = writeln!(
        out,
        "]);\n}}\n\n// An impossible robot does not compile.\nconst _: {model} = {type_name}::MODEL;"
    );
    out += &effects(tree);
    if coupled {
        out += &coupling(tree);
    }
    out
}

/// A number with its noun.
fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

fn head(tree: &Tree, name: &str, origin: &Origin) -> String {
    let mut out = format!("//! {}.\n//!\n//! # Source\n//!\n", plain(name));
    let licence = match &origin.licence {
        Some(licence) => format!("licence as its comments state it: {}", plain(licence)),
        None => "it states no licence".to_owned(),
    };
    let _ = writeln!(
        out,
        "//! `{}`; {licence}. Imported on {} by robot-import {}.",
        plain(&origin.file),
        origin.date,
        env!("CARGO_PKG_VERSION"),
    );
    let mut changes = Vec::new();
    for body in &tree.bodies {
        if !body.merged.is_empty() {
            let links: Vec<String> = body
                .merged
                .iter()
                .map(|link| format!("`{}`", plain(link)))
                .collect();
            changes.push(format!(
                "Part of body `{}`: {}.",
                plain(&body.name),
                links.join(", ")
            ));
        }
    }
    for body in &tree.bodies {
        for snap in &body.snapped {
            changes.push(format!(
                "Joint `{}`: {} `{}` is {}.",
                plain(&body.joint),
                plain(&snap.attribute),
                plain(&snap.text),
                snap.exact
            ));
        }
    }
    changes.extend(origin.notes.iter().map(|note| plain(note)));
    if !changes.is_empty() {
        out += "//!\n//! # Changed\n//!\n";
        for change in changes {
            let _ = writeln!(out, "//! - {change}");
        }
    }
    out
}

/// The constants of π in a body's attitude.
fn constants(body: &Body) -> Vec<&'static str> {
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

/// A body's entry.
fn one(body: &Body) -> String {
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
    let parent = body
        .parent
        .map_or("BASE".to_owned(), |parent| parent.to_string());
    let mut out = format!(
        "Body::new({}, {parent}, Joint::{joint})",
        quoted(&body.name)
    );
    if body.xyz != [0.0; 3] {
        let _ = write!(out, ".xyz({})", list(body.xyz));
    }
    match body.attitude {
        Attitude::QuarterTurns([0, 0, 0]) => {}
        Attitude::QuarterTurns(turns) => {
            let _ = write!(out, ".quarter_turns({turns:?})");
        }
        Attitude::Rpy(rpy) => {
            let _ = write!(out, ".rpy([{}])", rpy.map(angle).join(", "));
        }
    }
    let own = &body.inertia;
    if own.mass != 0.0 {
        let _ = write!(out, ".mass({})", literal(own.mass));
    }
    if own.com != [0.0; 3] {
        let _ = write!(out, ".com({})", list(own.com));
    }
    if own.inertia != [0.0; 6] {
        let _ = write!(out, ".inertia({})", list(own.inertia));
    }
    if let Some(limits) = limits(body) {
        let _ = write!(out, ".limits({limits})");
    }
    out + ",\n"
}

/// The limits of a body's joint, if it has some.
fn limits(body: &Body) -> Option<String> {
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
        _ => Some(format!(
            "JointLimits {{ {}, ..JointLimits::NONE }}",
            stated.join(", ")
        )),
    }
}

/// A value for each velocity coordinate.
fn per_coordinate(tree: &Tree, of: fn(&Body) -> f64) -> Vec<f64> {
    let each = tree
        .bodies
        .iter()
        .map(|body| vec![of(body); body.kind.coordinates()[1]]);
    each.collect::<Vec<_>>().concat()
}

/// The effects that the file states, and the scene of those that are not zero.
fn effects(tree: &Tree) -> String {
    let text = |values: &[f64]| {
        let values: Vec<String> = values.iter().map(|&x| literal(x)).collect();
        format!("[{}]", values.join(", "))
    };
    let viscous = per_coordinate(tree, |body| body.damping);
    let coulomb = per_coordinate(tree, |body| body.friction);
    let armature = per_coordinate(tree, |body| body.armature);
    let mut scene = vec![
        ("Gravity", "Gravity::EARTH"),
        ("Inertia", "Inertia"),
        ("Coriolis", "Coriolis"),
    ];
    let is_some = |values: &[f64]| values.iter().any(|&x| x != 0.0);
    let each = [
        (&viscous, ("Viscous<f32, V>", "VISCOUS")),
        (&coulomb, ("Coulomb<f32, V>", "COULOMB")),
        (&armature, ("Armature<f32, V>", "ARMATURE")),
    ];
    scene.extend(
        each.iter()
            .filter(|(values, _)| is_some(values))
            .map(|(_, effect)| *effect),
    );
    let types: Vec<&str> = scene.iter().map(|(name, _)| *name).collect();
    let values: Vec<&str> = scene.iter().map(|(_, value)| *value).collect();
    format!(
        "\n/// Viscous friction, N·m·s/rad or N·s/m.\npub const VISCOUS: Viscous<f32, V> = Viscous({});\n\
         /// Coulomb friction, N·m or N, full beyond 0.02 rad/s or m/s.\n\
         pub const COULOMB: Coulomb<f32, V> = Coulomb {{ torque: {}, width: Width::f32(0.02) }};\n\
         /// Inertia of the rotors at the joints, kg·m² or kg.\npub const ARMATURE: Armature<f32, V> = Armature({});\n\
         \n/// The rigid body, and the effects that the description states.\n\
         pub const SCENE: ({}) = ({});\n",
        text(&viscous),
        text(&coulomb),
        text(&armature),
        types.join(", "),
        values.join(", "),
    )
}

/// The constant coupling of joints that follow others.
fn coupling(tree: &Tree) -> String {
    let leaders: Vec<usize> = (0..tree.bodies.len())
        .filter(|&i| tree.bodies[i].follows.is_none())
        .collect();
    let (mut rows, mut offsets) = (Vec::new(), Vec::new());
    for (i, body) in tree.bodies.iter().enumerate() {
        let (leader, ratio, offset) = body.follows.unwrap_or((i, 1.0, 0.0));
        let entries = leaders
            .iter()
            .map(|&k| literal(if k == leader { ratio } else { 0.0 }));
        rows.push(format!("[{}]", entries.collect::<Vec<_>>().join(", ")));
        offsets.push(literal(offset));
    }
    let m = leaders.len();
    format!(
        "\n/// The number of motors.\npub const M: usize = {m};\n\
         /// The joints' positions from the motors'.\npub const COUPLING: Transmission<f32, M, V> = \
         Transmission {{ matrix: [{}], offset: [{}] }};\n",
        rows.join(", "),
        offsets.join(", "),
    )
}

/// A file as rustfmt formats it; as it is, if there is no rustfmt.
pub fn formatted(source: &str) -> String {
    run_rustfmt(source)
        .ok()
        .flatten()
        .unwrap_or_else(|| source.to_owned())
}

fn run_rustfmt(source: &str) -> std::io::Result<Option<String>> {
    let mut child = Command::new("rustfmt")
        .args(["--edition", "2024"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()?;
    let stdin = child.stdin.take();
    // Written beside the reading: a file is larger than a pipe's buffer.
    let text = source.to_owned();
    let writer =
        std::thread::spawn(move || stdin.map(|mut stdin| stdin.write_all(text.as_bytes())));
    let output = child.wait_with_output()?;
    let _ = writer.join();
    Ok(output
        .status
        .success()
        .then(|| String::from_utf8_lossy(&output.stdout).into_owned()))
}
