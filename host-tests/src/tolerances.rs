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
    ("ur5e", "aba", 2.0e-13, 2.0e-5),
    ("ur5e", "crba", 1e-15, 5e-7),
    ("ur5e", "forward", 5e-13, 3e-5),
    ("ur5e", "aba of rnea", 1.0e-14, 4.0e-6),
    ("panda", "rnea", 1e-15, 5e-7),
    ("panda", "gravity", 1e-15, 5e-7),
    ("panda", "bias", 1e-15, 5e-7),
    ("panda", "engine rnea", 1e-15, 3e-7),
    ("panda", "engine gravity", 1e-15, 3e-7),
    ("panda", "engine bias", 1e-15, 2.5e-7),
    ("panda", "aba", 3.0e-14, 1.2e-05),
    ("panda", "crba", 1e-15, 5e-7),
    ("panda", "forward", 1e-13, 3e-5),
    ("panda", "aba of rnea", 1.0e-14, 6.0e-6),
    ("iiwa14", "rnea", 1e-15, 5e-7),
    ("iiwa14", "gravity", 1e-15, 5e-7),
    ("iiwa14", "bias", 1e-15, 5e-7),
    ("iiwa14", "engine rnea", 1e-15, 3e-7),
    ("iiwa14", "engine gravity", 1e-15, 4e-7),
    ("iiwa14", "engine bias", 1e-15, 3e-7),
    ("iiwa14", "aba", 2.0e-13, 3.0e-05),
    ("iiwa14", "crba", 1e-15, 5e-7),
    ("iiwa14", "forward", 8e-13, 3e-5),
    ("iiwa14", "aba of rnea", 1.5e-14, 8.0e-6),
    ("a1", "rnea", 1e-15, 5e-7),
    ("a1", "gravity", 1e-15, 5e-7),
    ("a1", "bias", 1e-15, 5e-7),
    ("a1", "engine rnea", 1e-15, 3e-7),
    ("a1", "engine gravity", 1e-15, 4e-7),
    ("a1", "engine bias", 1e-15, 4e-7),
    ("a1", "aba", 1.5e-14, 8.0e-06),
    ("a1", "crba", 1e-15, 5e-7),
    ("a1", "forward", 4e-14, 2e-5),
    ("a1", "aba of rnea", 4.0e-15, 2.0e-6),
    ("tree", "aba of rnea", 1.5e-14, 2.5e-5),
    ("mixed", "columns of M", 7e-15, 3e-6),
    ("mixed", "modified method", 2e-15, 5e-7),
    ("mixed", "Jacobian", 2e-15, 2e-6),
    ("mixed", "hybrid as inverse", 2e-14, 6e-6),
    ("mixed", "torques of hybrid", 2e-14, 4e-6),
    ("all", "symmetry of M", 1e-15, NONE),
    ("all", "columns of M", 1e-15, NONE),
    ("all", "kinetic energy", 2e-15, NONE),
    ("all", "Lagrange", 8e-12, NONE),
    ("all", "power", 3e-12, NONE),
    ("all", "sum of effects", 1e-15, NONE),
    ("pendulum", "closed form", 6e-16, NONE),
    ("two links", "closed form", 1e-15, NONE),
    ("slide", "closed form", 5e-16, NONE),
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
