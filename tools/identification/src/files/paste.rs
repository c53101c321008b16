//! The robot's Rust file and its initialisers in C with what was found.

use std::fmt::Write as _;

use robot_import::inertia::MassProperties;
use robot_import::write;

use crate::OF_JOINT;

use super::report::{Findings, Gear, rounded};
use super::robot::{DOWN, Robot};

/// The width with which the importer writes Coulomb friction.
const WIDTH: &str = "Width::f32(0.02)";

/// The Rust file of the robot, as `cargo xtask import` writes it, with what was found.
pub fn file(robot: &Robot, found: &Findings) -> String {
    let imported = &robot.imported;
    let mut tree = imported.tree.clone();
    for ((body, own), joint) in tree.bodies.iter_mut().zip(&found.bodies).zip(&found.joints) {
        body.inertia =
            MassProperties { mass: own.after.mass, com: own.after.com, inertia: own.after.inertia };
        [body.damping, body.friction, body.armature] = [0, 1, 2].map(|k| rounded(joint.after[k]));
    }
    let mut notes = vec![format!(
        "Masses, inertias and frictions were identified from {:.1} s of motion.",
        found.fitted_seconds
    )];
    if robot.gravity != DOWN {
        let [x, y, z] = robot.gravity;
        notes.push(format!(
            "The base was mounted so that gravity is along ({x:.4}, {y:.4}, {z:.4}) of it, and \
             that of SCENE is along its −z."
        ));
    }
    let origin = write::Origin {
        file: imported.report.file.clone(),
        licence: imported.robot.licence.clone(),
        date: today(),
        notes,
    };
    let source = write::source(&tree, &imported.name, &imported.report.type_name, &origin);
    let width = format!("Width::f32({:?})", found.width);
    let source = source.replace(WIDTH, &width);
    let source =
        source.replace("full beyond 0.02 rad/s", &format!("full beyond {:?} rad/s", found.width));
    write::formatted(&(source + &others(found, &width) + &gears(found, &width)))
}

/// The day in UTC.
fn today() -> String {
    let today = time::OffsetDateTime::now_utc();
    let month = u8::from(today.month());
    format!("{}-{month:02}-{:02}", today.year(), today.day())
}

/// The lines of the file that differ from the one before: the bodies and the constants of the
/// joints.
pub fn lines(file: &str) -> String {
    let between = |from: &str, to: &str| {
        let start = file.find(from).unwrap_or(file.len());
        let end = file[start..].find(to).map_or(file.len(), |end| start + end);
        &file[start..end]
    };
    let bodies = between("impl Robot<", "\n// A robot with");
    let joints = between("/// Viscous friction,", "\n/// The rigid body, and");
    let titles = [
        "Torque of each joint in",
        "Friction at rest in",
        "Coulomb friction of each",
        "Friction of the gears",
    ];
    let added = titles.into_iter().find_map(|title| file.find(&format!("/// {title}")));
    let added = &file[added.unwrap_or(file.len())..];
    [bodies, joints, added].map(str::trim_end).join("\n\n").trim_end().to_owned() + "\n"
}

/// The constant torques, and the friction of further kinds, if the recording shows some; the
/// importer knows none.
fn others(found: &Findings, width: &str) -> String {
    let list = |of: &dyn Fn(&[f64; OF_JOINT]) -> f64| -> Vec<f64> {
        found.joints.iter().map(|joint| rounded(of(&joint.after))).collect()
    };
    let [offset, excess, asymmetry] = [3, 4, 5].map(|k| list(&|own| own[k]));
    let mut text = String::new();
    let mut add = |of: &[f64], words: &str, name: &str, effect: &str, fields: String| {
        if of.iter().any(|x| *x != 0.0) {
            let effect = format!("::dynamics_core::effects::{effect}");
            let _ = write!(
                text,
                "\n/// {words}, N·m or N: add it to the scene.\npub const {name}: {effect}<f32, V> = \
                 {effect}{fields};\n"
            );
        }
    };
    add(
        &offset,
        "Torque of each joint in any state",
        "OFFSET",
        "ConstantTorque",
        format!("({offset:?})"),
    );
    let speed = found.stribeck_speed.unwrap_or(1.0);
    let fields =
        format!("{{ excess: {excess:?}, stribeck_speed: Width::f32({speed:?}), width: {width} }}");
    add(&excess, "Friction at rest in excess of Coulomb friction", "STRIBECK", "Stribeck", fields);
    // |F₊ − F₋| is at most F₊ + F₋.
    let half = |own: &[f64; OF_JOINT]| own[5].clamp(-own[1], own[1]);
    let [forward, backward] = [1.0, -1.0].map(|side| list(&|own| own[1] + side * half(own)));
    let fields = format!("{{ forward: {forward:?}, backward: {backward:?}, width: {width} }}");
    let words = "Coulomb friction of each direction, in place of COULOMB";
    add(&asymmetry, words, "DIRECTIONS", "AsymmetricCoulomb", fields);
    text
}

/// The constant of the gears, if their friction was found; the importer knows none.
fn gears(found: &Findings, width: &str) -> String {
    let each: Vec<_> = found.joints.iter().filter_map(|joint| joint.gear).collect();
    let list = |of: &dyn Fn(&Gear) -> f64| {
        let numbers: Vec<String> = each.iter().map(|g| format!("{:?}", rounded(of(g)))).collect();
        numbers.join(", ")
    };
    let [first, second] = [0, 1].map(|k| list(&|gear| gear.friction[k]));
    let (name, fields) = match each.first().map(|gear| gear.deflection) {
        None => return String::new(),
        Some(None) => {
            ("LoadFriction", format!("driving: [{first}], backdriving: [{second}], width: {width}"))
        }
        Some(Some(_)) => {
            let h = list(&|gear| gear.deflection.map_or(0.0, |[h, _]| h));
            let rest = "direction: [0.0; V]";
            let fields =
                format!("magnitude: [{first}], torque: [{second}], deflection: [{h}], {rest}");
            ("PreslidingLoadFriction", fields)
        }
    };
    format!(
        "\n/// Friction of the gears per transmitted torque: add it to the scene.\npub const \
         GEARS: ::dynamics_core::effects::{name}<f32, V> = ::dynamics_core::effects::{name} \
         {{ {fields} }};\n"
    )
}

/// Initialisers for C: of each body the fields of `<name>_load` in the header of a project, and of
/// each joint its friction.
pub fn c(found: &Findings) -> String {
    let list = |numbers: &[f64]| {
        let each: Vec<String> = numbers.iter().map(|x| format!("{:?}f", rounded(*x))).collect();
        format!("{{{}}}", each.join(", "))
    };
    let mut text = format!(
        "/* Bodies in their own frames: kg, m, kg m^2 about the centre of mass (xx, xy, xz, yy, \
         yz, zz). */\n\
         static const struct {{ float mass; float com[3]; float inertia[6]; }} bodies[{}] = {{\n",
        found.bodies.len()
    );
    for body in &found.bodies {
        let own = &body.after;
        let _ = writeln!(
            text,
            "    {{ .mass = {:?}f, .com = {}, .inertia = {} }}, /* {} */",
            own.mass,
            list(&own.com),
            list(&own.inertia),
            robot_import::text::visible(&body.name).replace("*/", "* /")
        );
    }
    text += "};\n";
    let names = ["viscous", "coulomb", "armature", "offset", "stribeck_excess", "asymmetry"];
    let units = [
        "Viscous friction, N m s/rad or N s/m",
        "Coulomb friction, N m or N",
        "Inertia of the rotors at the joints, kg m^2 or kg",
        "Torque in any state, N m or N",
        "Friction at rest in excess of Coulomb friction, N m or N",
        "Half of the difference of Coulomb friction forward and backward, N m or N",
    ];
    for (k, (name, unit)) in names.into_iter().zip(units).enumerate() {
        let numbers: Vec<f64> = found.joints.iter().map(|joint| joint.after[k]).collect();
        if k > 3 && numbers.iter().all(|x| *x == 0.0) {
            continue;
        }
        let _ = writeln!(
            text,
            "static const float {name}[{}] = {}; /* {unit} */",
            numbers.len(),
            list(&numbers)
        );
    }
    text
}
