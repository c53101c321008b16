//! The constants beside the robot in the Rust file: effects, their scene, and the coupling of
//! joints.

use crate::number::literal;
use crate::tree::{Body, Tree};

/// A value for each velocity coordinate.
fn per_coordinate(tree: &Tree, of: fn(&Body) -> f64) -> Vec<f64> {
    let each = tree.bodies.iter().map(|body| vec![of(body); body.kind.coordinates()[1]]);
    each.collect::<Vec<_>>().concat()
}

/// The effects that the file states, and the scene of those that are not zero, which the compiler
/// checks at its line.
pub fn effects(tree: &Tree, type_name: &str) -> String {
    let text = |values: &[f64]| {
        let values: Vec<String> = values.iter().map(|&x| literal(x)).collect();
        format!("[{}]", values.join(", "))
    };
    let viscous = per_coordinate(tree, |body| body.damping);
    let coulomb = per_coordinate(tree, |body| body.friction);
    let armature = per_coordinate(tree, |body| body.armature);
    let mut forces = vec![("Inertia", "Inertia"), ("Coriolis", "Coriolis")];
    let [stiffness, rest] =
        [per_coordinate(tree, |body| body.spring[0]), per_coordinate(tree, |body| body.spring[1])];
    let is_some = |values: &[f64]| values.iter().any(|&x| x != 0.0);
    let each = [
        (&viscous, ("Viscous<f32, V>", "VISCOUS")),
        (&coulomb, ("Coulomb<f32, V>", "COULOMB")),
        (&armature, ("Armature<f32, V>", "ARMATURE")),
        (&stiffness, ("Spring<f32, V>", "SPRING")),
    ];
    forces.extend(each.iter().filter(|(values, _)| is_some(values)).map(|(_, effect)| *effect));
    let types: Vec<&str> = forces.iter().map(|(name, _)| *name).collect();
    let values: Vec<&str> = forces.iter().map(|(_, value)| *value).collect();
    let spring = match tree.has_springs() {
        true => format!(
            "/// Springs at the joints, N·m/rad or N/m about rad or m.\n\
             pub const SPRING: Spring<f32, V> = Spring {{ stiffness: {}, rest: {} }};\n",
            text(&stiffness),
            text(&rest),
        ),
        false => String::new(),
    };
    format!(
        "\n/// Viscous friction, N·m·s/rad or N·s/m.\npub const VISCOUS: Viscous<f32, V> = \
         Viscous({});\n\
         /// Coulomb friction, N·m or N, full beyond 0.02 rad/s or m/s.\n\
         pub const COULOMB: Coulomb<f32, V> = Coulomb {{ torque: {}, width: Width::f32(0.02) }};\n\
         /// Inertia of the rotors at the joints, kg·m² or kg.\n\
         pub const ARMATURE: Armature<f32, V> = Armature({});\n{spring}\
         \n/// The rigid body's forces of inertia, and those effects that the description states.\n\
         pub type Forces = ({});\n\
         /// With their parameters.\npub const FORCES: Forces = ({});\n\
         /// All that acts on the robot.\npub type Scene = (Gravity, Forces);\n\
         /// On Earth, checked at this line.\n\
         pub const SCENE: Scene = ::dynamics_core::Core::<{type_name}>::scene_f32((Gravity::EARTH, FORCES));\n",
        text(&viscous),
        text(&coulomb),
        text(&armature),
        types.join(", "),
        values.join(", "),
    )
}

/// The constant coupling of joints that follow others.
pub fn coupling(tree: &Tree) -> String {
    let leaders: Vec<usize> =
        (0..tree.bodies.len()).filter(|&i| tree.bodies[i].follows.is_none()).collect();
    let (mut rows, mut offsets) = (Vec::new(), Vec::new());
    for (i, body) in tree.bodies.iter().enumerate() {
        let (leader, ratio, offset) = body.follows.unwrap_or((i, 1.0, 0.0));
        let entries = leaders.iter().map(|&k| literal(if k == leader { ratio } else { 0.0 }));
        rows.push(format!("[{}]", entries.collect::<Vec<_>>().join(", ")));
        offsets.push(literal(offset));
    }
    let m = leaders.len();
    format!(
        "\n/// The number of motors.\npub const M: usize = {m};\n\
         /// The joints' positions from the motors'.\n\
         pub const COUPLING: Transmission<f32, M, V> = \
         Transmission {{ matrix: [{}], offset: [{}] }};\n",
        rows.join(", "),
        offsets.join(", "),
    )
}
