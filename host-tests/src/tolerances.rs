//! The one tolerance table: largest errors relative to full scale, against Pinocchio, against
//! closed forms and laws that hold for every robot, and (absolute) of sine and cosine.
//!
//! A bound is at most ten times what was measured, and a test fails when one has become slack.

/// Not measured in this scalar: every error exceeds it.
const NONE: f64 = f64::NEG_INFINITY;

/// Robot, quantity, bound in f64, bound in f32.
const TABLE: &[(&str, &str, f64, f64)] = &[
    ("ur5e", "rnea", 1e-15, 5e-7),
    ("ur5e", "gravity", 1e-15, 5e-7),
    ("ur5e", "bias", 1e-15, 5e-7),
    ("ur5e", "engine rnea", 1e-15, 3e-7),
    ("ur5e", "engine gravity", 1e-15, 4e-7),
    ("ur5e", "engine bias", 1e-15, 4e-7),
    ("ur5e", "aba", 2.0e-13, 9.0e-5),
    ("ur5e", "aba of rnea", 1.0e-14, 4.0e-6),
    ("panda", "rnea", 1e-15, 5e-7),
    ("panda", "gravity", 1e-15, 5e-7),
    ("panda", "bias", 1e-15, 5e-7),
    ("panda", "engine rnea", 1e-15, 3e-7),
    ("panda", "engine gravity", 1e-15, 3e-7),
    ("panda", "engine bias", 1e-15, 2.5e-7),
    ("panda", "aba", 3.0e-14, 1.2e-05),
    ("panda", "aba of rnea", 1.0e-14, 6.0e-6),
    ("iiwa14", "rnea", 1e-15, 5e-7),
    ("iiwa14", "gravity", 1e-15, 5e-7),
    ("iiwa14", "bias", 1e-15, 5e-7),
    ("iiwa14", "engine rnea", 1e-15, 3e-7),
    ("iiwa14", "engine gravity", 1e-15, 4e-7),
    ("iiwa14", "engine bias", 1e-15, 3e-7),
    ("iiwa14", "aba", 2.0e-13, 7.0e-05),
    ("iiwa14", "aba of rnea", 1.5e-14, 8.0e-6),
    ("a1", "rnea", 1e-15, 5e-7),
    ("a1", "gravity", 1e-15, 5e-7),
    ("a1", "bias", 1e-15, 5e-7),
    ("a1", "engine rnea", 1e-15, 3e-7),
    ("a1", "engine gravity", 1e-15, 4e-7),
    ("a1", "engine bias", 1e-15, 4e-7),
    ("a1", "aba", 1.5e-14, 8.0e-06),
    ("a1", "aba of rnea", 4.0e-15, 2.0e-6),
    ("gen3", "rnea", 1e-15, 5e-7),
    ("gen3", "gravity", 1e-15, 5e-7),
    ("gen3", "bias", 1e-15, 5e-7),
    ("gen3", "aba", 1.5e-13, 6e-5),
    ("xarm7", "rnea", 1.5e-15, 5e-7),
    ("xarm7", "gravity", 1e-15, 5e-7),
    ("xarm7", "bias", 1e-15, 5e-7),
    ("xarm7", "aba", 3e-13, 1.5e-4),
    ("z1", "rnea", 1e-15, 5e-7),
    ("z1", "gravity", 1e-15, 5e-7),
    ("z1", "bias", 1e-15, 5e-7),
    ("z1", "aba", 1.5e-13, 6e-5),
    ("g1", "rnea", 1e-15, 5e-7),
    ("g1", "gravity", 1e-15, 5e-7),
    ("g1", "bias", 1e-15, 5e-7),
    ("g1", "aba", 1e-12, 6e-4),
    ("a1_free", "rnea", 1e-15, 4e-7),
    ("a1_free", "gravity", 2e-15, 8e-7),
    ("a1_free", "bias", 1.5e-15, 4e-7),
    ("a1_free", "aba", 2e-13, 1e-4),
    ("g1_free", "rnea", 1e-15, 5e-7),
    ("g1_free", "gravity", 3e-15, 8e-7),
    ("g1_free", "bias", 1.5e-15, 5e-7),
    ("g1_free", "aba", 4e-12, 4e-3),
    ("tree_a", "rnea", 1.5e-15, 6e-7),
    ("tree_a", "gravity", 3e-15, 8e-7),
    ("tree_a", "bias", 1.5e-15, 5e-7),
    ("tree_a", "aba", 2.5e-12, 4e-4),
    ("tree_b", "rnea", 2e-15, 6e-7),
    ("tree_b", "gravity", 4e-15, 8e-7),
    ("tree_b", "bias", 3e-15, 6e-7),
    ("tree_b", "aba", 5e-13, 8e-5),
    ("a1_free", "integrate", 3e-16, NONE),
    ("a1_free", "difference", 5e-16, NONE),
    ("g1_free", "integrate", 3e-16, NONE),
    ("g1_free", "difference", 5e-16, NONE),
    ("tree_a", "integrate", 2e-16, NONE),
    ("tree_a", "difference", 5e-16, NONE),
    ("tree_b", "integrate", 6e-16, NONE),
    ("tree_b", "difference", 8e-15, NONE),
    ("panda", "rnea with wrenches", 9e-16, 3e-7),
    ("panda", "aba with wrenches", 8e-16, 4e-7),
    ("panda", "rnea on a moving base", 7e-16, 3e-7),
    ("panda", "rnea with rotors", 6e-16, 4e-7),
    ("panda", "aba with rotors", 6e-15, 2e-6),
    ("a1", "rnea with wrenches", 3e-16, 2e-7),
    ("a1", "aba with wrenches", 2e-15, 7e-7),
    ("a1", "rnea on a moving base", 9e-16, 4e-7),
    ("a1", "rnea with rotors", 6e-16, 4e-7),
    ("a1", "aba with rotors", 4e-15, 3e-6),
    ("g1_free", "rnea with wrenches", 8e-16, 4e-7),
    ("g1_free", "aba with wrenches", 2e-15, 2e-6),
    ("g1_free", "rnea on a moving base", 7e-16, 3e-7),
    ("g1_free", "rnea with rotors", 5e-16, 2e-7),
    ("g1_free", "aba with rotors", 2e-14, 1e-5),
    ("tree_a", "rnea with wrenches", 1e-15, 3e-7),
    ("tree_a", "aba with wrenches", 6e-14, 1e-5),
    ("tree_a", "rnea on a moving base", 9e-16, 5e-7),
    ("tree_a", "rnea with rotors", 1e-15, 9e-7),
    ("tree_a", "aba with rotors", 5e-13, 2e-4),
    ("tree_b", "rnea with wrenches", 2e-15, 9e-7),
    ("tree_b", "aba with wrenches", 1e-14, 5e-7),
    ("tree_b", "rnea on a moving base", 2e-15, 4e-7),
    ("tree_b", "rnea with rotors", 1e-15, 3e-7),
    ("tree_b", "aba with rotors", 4e-14, 3e-5),
    ("tree", "aba of rnea", 1.5e-14, 2.5e-5),
    ("tree", "difference of a step", 4e-15, 4e-6),
    ("tree", "step along a difference", 2e-14, NONE),
    ("tree", "power of a step", 4e-11, NONE),
    ("all", "symmetry of M", 1e-15, NONE),
    ("all", "columns of M", 1e-15, NONE),
    ("all", "kinetic energy", 2e-15, NONE),
    ("all", "Lagrange", 8e-12, NONE),
    ("all", "power", 3e-12, NONE),
    ("all", "sum of effects", 1e-15, NONE),
    ("pendulum", "closed form", 6e-16, NONE),
    ("two links", "closed form", 1e-15, NONE),
    ("slide", "closed form", 5e-16, NONE),
    ("mixed tree", "velocity by difference", 1e-12, NONE),
    ("mixed tree", "J qd", 2e-15, NONE),
    ("mixed tree", "acceleration by difference", 2e-12, NONE),
    ("mixed tree", "kinetic energy", 6e-16, 3e-7),
    ("mixed tree", "rate of energy", 1e-12, NONE),
    ("mixed tree", "velocity of the centre", 2e-12, NONE),
    ("mixed tree", "momentum about the centre", 1e-16, NONE),
    ("mixed tree", "A_G qd", 2e-15, NONE),
    ("mixed tree", "rate of momentum", 2e-10, NONE),
    ("mixed tree", "poses", NONE, 6e-7),
    ("mixed tree", "velocities", NONE, 7e-7),
    ("mixed tree", "accelerations", NONE, 8e-7),
    ("mixed tree", "A_G", NONE, 7e-7),
    ("trig", "sin_cos", 3e-16, 1e-7),
    ("trig", "sin_cos_near", NONE, 1e-7),
];

/// Holds a measured error, relative to full scale, against the table.
///
/// # Errors
/// Says which entry is missing, exceeded, or slack by more than ten times.
pub fn check(robot: &str, quantity: &str, scalar: &str, error: f64) -> Result<(), String> {
    let Some(&(.., double, single)) = TABLE.iter().find(|t| t.0 == robot && t.1 == quantity) else {
        return Err(format!(
            "no bound for {quantity} of {robot}; measured {error:.2e} in {scalar}"
        ));
    };
    let bound = if scalar == "f64" { double } else { single };
    let place = format!("{quantity} of {robot} in {scalar}: error {error:.2e}, bound {bound:.1e}");
    if error.is_nan() || error > bound {
        return Err(format!("{place}: exceeded"));
    }
    if error * 10.0 < bound {
        return Err(format!("{place}: slack by more than ten times, lower it"));
    }
    Ok(())
}
