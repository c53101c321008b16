//! The one tolerance table: largest errors relative to full scale, against Pinocchio.
//!
//! A bound is at most ten times what was measured, and a test fails when one has become slack.

/// Robot, quantity, bound in f64, bound in f32.
const TABLE: &[(&str, &str, f64, f64)] = &[
    ("ur5e", "rnea", 1e-15, 5e-7),
    ("ur5e", "gravity", 1e-15, 5e-7),
    ("ur5e", "bias", 1e-15, 5e-7),
    ("ur5e", "aba", 2.0e-13, 9.0e-5),
    ("panda", "rnea", 1e-15, 5e-7),
    ("panda", "gravity", 1e-15, 5e-7),
    ("panda", "bias", 1e-15, 5e-7),
    ("panda", "aba", 3.0e-14, 1.2e-05),
    ("iiwa14", "rnea", 1e-15, 5e-7),
    ("iiwa14", "gravity", 1e-15, 5e-7),
    ("iiwa14", "bias", 1e-15, 5e-7),
    ("iiwa14", "aba", 2.0e-13, 7.0e-05),
    ("a1", "rnea", 1e-15, 5e-7),
    ("a1", "gravity", 1e-15, 5e-7),
    ("a1", "bias", 1e-15, 5e-7),
    ("a1", "aba", 1.5e-14, 8.0e-06),
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
