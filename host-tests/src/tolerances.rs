//! The one tolerance table: largest errors relative to full scale, against Pinocchio, against
//! closed forms and laws that hold for every robot, and (absolute) of sine and cosine.
//!
//! A bound is at most ten times what was measured, and a test fails when one has become slack.

use crate::measured::largest;

/// Not measured in this scalar: every error exceeds it.
const NONE: f64 = f64::NEG_INFINITY;

/// Robot; its quantities, of which some have the same bounds, in f64 and in f32.
const TABLE: &[(&str, &str)] = &[
    (
        "ur5e",
        "rnea | gravity | bias | crba | passive joints: 1e-15 5e-7; engine rnea: 1e-15 3e-7; \
         engine gravity | engine bias: - 4e-7; aba: 2e-13 2e-5; forward: 5e-13 3e-5; \
         aba of rnea: 1e-14 4e-6; engine forward | engine aba: - 3e-5; \
         engine crba | C | C y: - 5e-7; engine jacobian: 3e-15 -; engine bodies: 1.5e-15 1e-6; \
         engine mobility: 1e-12 2e-6; Y φ with friction: 8e-16 -; M qd: 1e-15 -; Cᵀ qd: 4e-15 -; \
         slope of energy: 2e-15 -; Christoffel symbols: 2e-11 -; \
         rate of the energy of s: 5e-12 -; displacement of an impedance: 2e-7 -; \
         energy on an impedance: 5e-10 -; damping ratio of a mode: 2e-3 -; \
         engine ∂FD/∂q: 2e-13 2e-6; engine ∂FD/∂qd: 2e-13 4e-7; \
         forward dynamics under load friction: 1e-14 -; left out at 0.1 %: 5e-4 -",
    ),
    (
        "panda",
        "rnea | gravity | bias | crba: 1e-15 5e-7; engine rnea: 1e-15 3e-7; aba: 3e-14 1.2e-5; \
         forward: 1e-13 3e-5; aba of rnea: 1e-14 6e-6; rnea with wrenches: 9e-16 3e-7; \
         aba with wrenches: 8e-16 4e-7; rnea on a moving base: 7e-16 3e-7; \
         rnea with rotors: 6e-16 4e-7; aba with rotors: 6e-15 2e-6; engine crba: 1.2e-15 -; \
         engine jacobian: - 8e-7; engine bodies: 1.5e-15 -; engine mobility: 2e-14 -; \
         M qd: 1e-15 -; Cᵀ qd: 4e-15 -; slope of energy: 3e-15 -; Christoffel symbols: 2e-11 -; \
         rate of the energy of s: 5e-12 -; displacement of an impedance: 5e-9 -; \
         energy on an impedance: 5e-11 -; damping ratio of a mode: 2e-3 -; \
         damping of an impedance: 1.5e-14 5e-6; tip by a motion of the elbow, m: 3e-4 -; \
         C | C y: - 5e-7; body wrenches: 9e-16 -; world wrenches: 8e-16 -; moving base: 7e-16 -; \
         left out at 0.1 %: 1e-3 -",
    ),
    (
        "iiwa14",
        "rnea | gravity | bias | crba: 1e-15 5e-7; engine rnea: 1e-15 3e-7; aba: 2e-13 3e-5; \
         forward: 8e-13 3e-5; aba of rnea: 1.5e-14 8e-6; engine forward: 1.2e-12 -; \
         engine jacobian: - 8e-7",
    ),
    (
        "a1",
        "rnea | gravity | bias | crba: 1e-15 5e-7; engine rnea: 1e-15 3e-7; aba: 1.5e-14 8e-6; \
         forward: 4e-14 2e-5; aba of rnea: 4e-15 2e-6; rnea with wrenches: 3e-16 2e-7; \
         aba with wrenches: 2e-15 7e-7; rnea on a moving base: 9e-16 4e-7; \
         rnea with rotors: 6e-16 4e-7; aba with rotors: 4e-15 3e-6; \
         engine crba | engine columns of M: 2e-15 -; engine jacobian: 1.5e-15 -; \
         engine bodies: 1.5e-15 5e-7; engine mobility: 4e-15 1e-6; M qd: 7e-16 -; \
         Cᵀ qd: 2e-14 -; slope of energy: 5e-14 -; Christoffel symbols: 2e-11 -",
    ),
    ("gen3", "rnea | gravity | bias | crba: 1e-15 5e-7; aba: 1.5e-13 6e-5"),
    ("xarm7", "rnea: 1.5e-15 5e-7; gravity | bias | crba: 1e-15 5e-7; aba: 3e-13 4e-5"),
    (
        "puma560",
        "rnea | gravity | bias | crba: 1e-15 5e-7; engine rnea: 1e-15 3e-7; aba: 5e-13 1e-5",
    ),
    (
        "openarm",
        "rnea | gravity | bias | engine rnea: 1e-15 5e-7; aba: 2e-13 6e-5; crba: 2e-15 5e-7",
    ),
    ("yam", "rnea | gravity | bias | engine rnea | crba: 1e-15 5e-7; aba: 1e-13 3e-5"),
    ("z1", "rnea | gravity | bias | crba: 1e-15 5e-7; aba: 1.5e-13 6e-5"),
    ("so101", "rnea | gravity | bias | crba: 1e-15 5e-7; aba: 1.5e-13 6e-5"),
    ("g1", "rnea | gravity | bias | crba: 1e-15 5e-7; aba: 1e-12 6e-4"),
    (
        "a1_free",
        "rnea: 1e-15 4e-7; gravity: 2e-15 8e-7; bias: 1.5e-15 4e-7; aba: 2e-13 3e-5; \
         integrate: 3e-16 -; difference: 5e-16 -; crba: 3e-16 1.5e-7; \
         engine bodies | engine and core, q̈ by M | recoil, τ | recoil, q̈: 3e-15 -; \
         engine mobility: 2e-13 -; engine rnea: 2e-15 5e-7; \
         engine and core, M | engine and core, p | engine and core, β | \
         engine and core, loaded: 1e-15 -; engine and core, q̈ | recoil, q̇: 2e-15 -; \
         engine and core, J: 1.5e-15 -; engine ∂FD/∂q: 2e-13 2e-6; engine ∂FD/∂qd: 2e-13 1e-6",
    ),
    (
        "g1_free",
        "rnea: 1e-15 5e-7; gravity: 3e-15 8e-7; bias: 1.5e-15 5e-7; aba: 4e-12 4e-3; \
         integrate: 3e-16 -; difference: 5e-16 -; rnea with wrenches: 8e-16 4e-7; \
         aba with wrenches: 8e-14 3e-6; rnea on a moving base: 7e-16 3e-7; \
         rnea with rotors: 5e-16 2e-7; aba with rotors: 2e-14 1e-5; crba: 4e-16 5e-7; \
         engine rnea: - 8e-7",
    ),
    (
        "tree_a",
        "rnea: 1.5e-15 6e-7; gravity: 3e-15 8e-7; bias: 1.5e-15 5e-7; aba: 2.5e-12 4e-4; \
         integrate: 2e-16 -; difference: 5e-16 -; rnea with wrenches: 1e-15 3e-7; \
         aba with wrenches: 6e-14 1e-5; rnea on a moving base: 9e-16 5e-7; \
         rnea with rotors: 1e-15 9e-7; aba with rotors: 5e-13 2e-4; crba: 1e-15 5e-7; \
         engine bodies | engine and core, q̈: 5e-15 -; engine mobility: 4e-14 -; \
         engine rnea | engine and core, loaded: 3e-15 -; engine and core: 2e-15 8e-7; \
         engine and core, M | engine and core, p | engine and core, β: 2e-15 -; \
         engine and core, q̈ by M: 8e-15 -; engine and core, J: 6e-15 -",
    ),
    (
        "tree_b",
        "rnea: 2e-15 6e-7; gravity: 4e-15 8e-7; bias: 3e-15 6e-7; aba: 5e-13 8e-5; \
         integrate: 6e-16 -; difference | engine and core, q̈ by M: 8e-15 -; \
         rnea with wrenches: 2e-15 9e-7; aba with wrenches: 1e-14 5e-7; \
         rnea on a moving base: 2e-15 4e-7; rnea with rotors: 1e-15 3e-7; \
         aba with rotors: 4e-14 3e-5; crba: 1e-15 5e-7; engine bodies: 7e-15 -; \
         engine mobility: 2e-14 -; engine rnea: 5e-15 -; engine and core: 2e-15 8e-7; \
         engine and core, M | engine and core, p | engine and core, β | \
         engine and core, loaded: 2e-15 -; engine and core, q̈ | engine and core, J: 4e-15 -",
    ),
    (
        "tree",
        "aba of rnea: 1.5e-14 2.5e-5; difference of a step: 4e-15 4e-6; \
         step along a difference: 2e-14 -; power of a step: 4e-11 -",
    ),
    (
        "odd",
        "engine bodies: 4e-15 1.5e-6; engine mobility: 6e-15 8e-7; \
         engine operational space: 1e-12 -; engine hybrid dynamics: 1e-14 -; \
         engine forward of rnea | engine solve: 8e-15 -; \
         engine columns of M | engine loaded M: 3e-15 -; left out at 5 %: 2e-2 -",
    ),
    ("fork", "engine spinning rotors | engine jacobian: 2e-14 -; engine aba of rnea: 1e-14 -"),
    (
        "mixed",
        "columns of M: 7e-15 3e-6; modified method: 2e-15 5e-7; Jacobian: 2e-15 2e-6; \
         hybrid as inverse: 2e-14 6e-6; torques of hybrid: 2e-14 4e-6",
    ),
    (
        "all",
        "symmetry of M | columns of M | sum of effects: 1e-15 -; kinetic energy: 2e-15 -; \
         Lagrange: 8e-12 -; power: 3e-12 -",
    ),
    ("pendulum", "closed form: 6e-16 -; loss to friction: 1e-7 -"),
    ("two links", "closed form: 1e-15 -"),
    ("scara", "planar form: 1e-15 5e-7"),
    ("slide", "closed form: 5e-16 -"),
    (
        "mixed tree",
        "velocity by difference | rate of M qd | rate of M qd by its drift | \
         rate of energy: 1e-12 -; J qd | A_G qd: 2e-15 -; \
         acceleration by difference | velocity of the centre: 2e-12 -; \
         kinetic energy: 6e-16 3e-7; M qd | C(x) y by polarisation | C y by the matrix: 1e-15 -; \
         Y φ: 8e-16 6e-7; C qd and rnea | Cᵀ qd by C: 1.5e-15 -; C(x) y less C(y) x: 4e-15 -; \
         rate of M and C + Cᵀ: 3e-12 -; rnea of equal velocities: 6e-16 -; \
         C y on a moving base: 6e-15 -; momentum about the centre: 1e-16 -; \
         rate of momentum: 2e-10 -; poses: - 6e-7; velocities | A_G: - 7e-7; \
         accelerations: - 8e-7; ∂ID/∂q by dual numbers | ∂ID/∂qd by dual numbers: 1e-14 1e-6; \
         ∂FD/∂q by dual numbers | ∂FD/∂qd by dual numbers | ∂FD/∂tau by dual numbers: 1e-13 -; \
         ∂ID x | xᵀ ∂ID: 2e-15 4e-7; ∂ID/∂q by Pinocchio | ∂ID/∂qd by Pinocchio: 1e-14 -; \
         mobility both ways: 5e-15 -",
    ),
    ("rotations", "shortest rotation: 2e-15 3e-7"),
    (
        "merged robots",
        "rnea | poses | wrenches: 2e-15 -; crba: 1e-15 -; aba: 3e-14 -; \
         velocities | accelerations | jacobian: 1.5e-15 -",
    ),
    (
        "recorded robots",
        "tip pose | kinetic energy: 2e-15 6e-7; tip velocity: 2e-15 5e-7; \
         tip acceleration | potential energy: 2e-15 7e-7; jacobian in the body: 4e-15 7e-7; \
         ∂ID/∂q | ∂ID/∂qd: 1e-14 1e-6; ∂FD/∂q: 4e-13 2e-4; ∂FD/∂qd: 6e-13 2e-4; \
         jacobian in the world | jacobian, mixed: 5e-15 2e-6; drift in the body: 3e-15 8e-7; \
         drift in the world | centroidal momentum: 4e-15 2e-6; drift, mixed: 6e-15 2e-6; \
         centre of mass: 2e-15 1e-6; momentum: 5e-15 8e-7; centroidal matrix: 3e-15 1e-6; \
         M qd: 2e-15 9e-7; Cᵀ qd: 5e-15 9e-7; regressor: 4e-15 1e-6; mobility: 9e-13 3e-6",
    ),
    ("arms", "Λ of Λ⁻¹ | J of its inverse: 1e-13 -; free torque: 4e-14 -"),
    ("matrices", "damped inverse: 6e-14 3e-5"),
    ("arm on a wall", "force: 2e-4 -; path: 5e-4 -; turn: 2e-5 -"),
    ("exponential", "exp_neg: - 1.5e-7"),
    ("stribeck", "closed form: 4e-16 2e-7"),
    ("lugre", "steady sliding: 4e-15 -"),
    ("hoist", "acceleration by efficiency: 5e-16 -"),
    ("sledge", "turning points: 3e-3 -; backward Euler: 3e-16 -"),
    ("block on a belt", "period of stick-slip: 8e-4 -; stretch of stick-slip: 3e-4 -"),
    ("two masses", "stretch: 1.5e-4 -"),
    ("cogging", "series: 1e-14 4e-7"),
    ("gimbal", "rolling base: 5e-16 -"),
    ("weight", "depth on the ground: 1e-11 -"),
    ("slab", "sliding down a slope: 1.5e-6 -; slip_tolerance on a slope: 3e-15 -"),
    (
        "spinning rotors",
        "rnea: 7e-16 3e-7; crba: 4e-16 -; aba: 2e-14 -; kinetic energy: 5e-16 -; \
         momentum | M qd: 6e-16 -; Cᵀ qd: 2e-16 -",
    ),
    ("compliant joints", "motor angle: 8e-16 -; motor rate: 3e-13 -; motor torque: 3e-12 4e-7"),
    ("motor and sledge", "stretch: 7e-4 -"),
    ("actuator", "lag: 5e-16 1.5e-7; lag in fine steps: 4e-15 -; run-up: 1e-5 -"),
    (
        "hop",
        "force on the rail | height of the carriage: - 2e-2; velocity by difference: - 1e-3; \
         acceleration by difference: - 4e-2; arc cosine: - 4e-7",
    ),
    ("picks", "position by cranks | velocity by cranks | acceleration by cranks: 1e-15 1e-6"),
    ("ankle", "velocity by difference | acceleration by difference: - 1e-3"),
    ("space arm", "momentum lost: 1e-15 5e-7; momentum lost by plain steps: 4e-4 6e-4"),
    ("ship", "velocity of the mast | acceleration of the mast: 1e-10 -; gravity: 1e-15 -"),
    ("watch", "attitude of the camera: 1e-15 -; rates of the joints: 1e-10 -"),
    (
        "trig",
        "sin_cos: 3e-16 1e-7; \
         sin_cos_near | minimax of degree 7 | minimax of degree 7, 3 parts | \
         table of 64, order 4: - 1e-7; minimax of degree 3: - 6e-4; minimax of degree 5: - 2e-6; \
         table of 256, order 1: - 1e-4; table of 256, order 2 | carried, seven joints: - 1e-6",
    ),
    ("a1_leg", "left out at 0.1 %: 2e-4 -"),
    (
        "double pendulum",
        "energy kept for a second: 6e-14 1e-5; compensated Runge-Kutta in fine steps: - 6e-7",
    ),
    (
        "four_bar",
        "forward of inverse dynamics: 4e-14 -; power of the motors: 2e-7 -; \
         balance of the cut bodies: 8e-15 -; inverse dynamics with loops: - 2e-6; \
         forward dynamics with loops: - 2e-5; recorded torques: 1e-14 1.5e-6; \
         recorded rates: 4e-15 4e-7; recorded dependent accelerations: 6e-15 5e-7; \
         recorded accelerations: 3e-14 8e-6",
    ),
    (
        "parallelogram",
        "forward of inverse dynamics: 4e-15 -; power of the motors: 2e-7 -; \
         balance of the cut bodies: 3e-15 -; inverse dynamics with loops: - 1e-6; \
         forward dynamics with loops: - 1e-5",
    ),
    (
        "five_bar",
        "forward of inverse dynamics: 7e-15 -; power of the motors: 2e-7 -; \
         balance of the cut bodies: 2e-15 -; inverse dynamics with loops: - 1e-6; \
         forward dynamics with loops: - 4e-6; recorded torques: 2e-14 4e-7; \
         recorded rates: 1.5e-14 4e-7; recorded dependent accelerations: 1.5e-14 5e-7; \
         recorded accelerations: 9e-14 3e-6",
    ),
    (
        "delta",
        "forward of inverse dynamics | balance of the cut bodies: 8e-15 -; \
         power of the motors: 3e-8 -; inverse dynamics with loops: - 1.5e-6; \
         forward dynamics with loops: - 4e-6; recorded torques: 8e-14 6e-7; \
         recorded rates: 2e-14 1.5e-6; recorded dependent accelerations: 4e-14 1.5e-6; \
         recorded accelerations: 3e-13 1.5e-5",
    ),
    (
        "stewart",
        "forward of inverse dynamics: 4e-15 -; power of the motors: 8e-7 -; \
         balance of the cut bodies: 3e-15 -; inverse dynamics with loops: - 4e-6; \
         forward dynamics with loops: - 2e-6; recorded torques: 4e-14 3e-6; \
         recorded rates: 1e-14 5e-7; recorded dependent accelerations: 2e-14 2e-6; \
         recorded accelerations: 4e-14 2e-6",
    ),
    (
        "four_bar_leg",
        "position: 5e-15 -; rate | M: 1.5e-14 -; acceleration: 4e-14 -; rnea: 8e-15 8e-6; \
         engine rnea | engine and core | engine and core, friction and rotors: 6e-15 6e-6; \
         aba of rnea: 2e-13 1.5e-4; gravity: 1.5e-14 1.5e-5; engine gravity: 5e-15 3e-6; \
         engine and core, gravity: 1e-14 8e-6; aba: 1.5e-12 5e-4",
    ),
    (
        "five_bar_leg",
        "position | rate: 1.5e-15 -; acceleration: 2e-15 -; M: 3e-17 -; rnea: 3e-16 3e-7; \
         engine rnea: 6e-16 4e-7; \
         engine and core | engine and core, friction and rotors: 6e-16 8e-7; \
         aba of rnea | aba: 3e-14 8e-6; gravity: 6e-16 1e-7; engine gravity: 1e-15 1e-7; \
         engine and core, gravity: 1e-15 2e-7",
    ),
    (
        "ankle_leg",
        "position: 4e-15 -; rate: 6e-15 -; acceleration: 2e-14 -; M: 8e-16 -; rnea: 6e-16 3e-7; \
         engine rnea | engine and core | engine and core, friction and rotors: 6e-16 4e-7; \
         aba of rnea: 1e-14 8e-6; gravity: 4e-16 4e-7; engine gravity: 8e-16 5e-7; \
         engine and core, gravity: 8e-16 6e-7; aba: 5e-14 5e-6",
    ),
    (
        "delta_robot",
        "M | rate: 2e-14 -; aba: 3e-14 6e-6; aba of rnea: 8e-15 5e-6; acceleration: 1.5e-14 -; \
         engine and core: 6e-16 4e-7; engine and core, friction and rotors: 5e-16 4e-7; \
         engine and core, gravity: 8e-16 5e-7; engine gravity | gravity: 1.5e-14 8e-7; \
         engine rnea | rnea: 1e-14 8e-7; position: 2e-15 -",
    ),
    (
        "stewart_platform",
        "M: 1e-15 -; aba: 1e-14 3e-6; aba of rnea: 4e-15 2e-6; acceleration: 4e-15 -; \
         engine and core | engine and core, friction and rotors | \
         engine and core, gravity: 1.5e-15 4e-7; engine gravity: 1.5e-15 6e-7; \
         engine rnea: 1.5e-15 5e-7; gravity: 1.5e-15 8e-7; position: 1.5e-15 -; rate: 2e-15 -; \
         rnea: 8e-16 5e-7",
    ),
    (
        "wrist",
        "position: 1.5e-16 -; rate | acceleration: 0e0 -; M: 8e-16 -; rnea: 5e-16 2e-7; \
         engine rnea | engine and core | gravity | \
         engine and core, friction and rotors: 5e-16 3e-7; aba of rnea: 6e-13 3e-4; \
         engine gravity | engine and core, gravity: 8e-16 4e-7; aba: 1.5e-12 4e-4",
    ),
    (
        "geared",
        "position: 3e-17 -; rate | acceleration: 4e-17 -; M: 1.5e-15 -; rnea: 4e-16 4e-7; \
         engine rnea: 6e-16 4e-7; engine and core: 3e-16 5e-7; aba of rnea: 3e-14 1.5e-5; \
         gravity: 1e-15 6e-7; engine gravity | engine and core, gravity: 8e-16 4e-7; \
         engine and core, friction and rotors: 8e-17 1.5e-7; aba: 4e-14 1.5e-5",
    ),
];

/// The bounds of a quantity in f64 and f32, as far as there are any.
pub fn bounds(robot: &str, quantity: &str) -> Option<[f64; 2]> {
    let entries = TABLE.iter().filter(|entry| entry.0 == robot);
    let mut groups = entries.flat_map(|entry| entry.1.split("; "));
    groups.find_map(|group| {
        let (quantities, bounds) = group.rsplit_once(": ")?;
        let (double, single) = bounds.split_once(' ')?;
        let bound = |text: &str| if text == "-" { Some(NONE) } else { text.parse().ok() };
        let is_there = quantities.split(" | ").any(|name| name == quantity);
        is_there.then_some([bound(double)?, bound(single)?])
    })
}

/// Holds a measured error, relative to full scale, against the table.
///
/// # Errors
/// Says which entry is missing, exceeded, or slack by more than ten times.
pub fn check(robot: &str, quantity: &str, scalar: &str, error: f64) -> Result<(), String> {
    let (place, bound) = within(robot, quantity, scalar, error)?;
    if error * 10.0 < bound {
        return Err(format!("{place}: slack by more than ten times, lower it"));
    }
    Ok(())
}

/// The same of some of the robots for which an entry is, of which the worst may be another: returns
/// what was compared, and the bound.
///
/// # Errors
/// Says which entry is missing or exceeded.
pub fn within(
    robot: &str,
    quantity: &str,
    scalar: &str,
    error: f64,
) -> Result<(String, f64), String> {
    let Some([double, single]) = bounds(robot, quantity) else {
        return Err(format!(
            "no bound for {quantity} of {robot}; measured {error:.2e} in {scalar}"
        ));
    };
    let bound = if scalar == "f64" { double } else { single };
    let place = format!("{quantity} of {robot} in {scalar}: error {error:.2e}, bound {bound:.1e}");
    if error.is_nan() || error > bound {
        return Err(format!("{place}: exceeded"));
    }
    Ok((place, bound))
}

/// Errors of a robot's quantities, collected over states.
pub struct Errors {
    /// The robot, as in the table.
    pub robot: &'static str,
    /// Quantity, scalar, largest error, full scale.
    rows: Vec<(&'static str, &'static str, f64, f64)>,
}

impl Errors {
    pub fn new(robot: &'static str) -> Self {
        Self { robot, rows: Vec::new() }
    }

    /// Compares the numbers of a state.
    pub fn add(&mut self, quantity: &'static str, scalar: &'static str, got: &[f64], want: &[f64]) {
        assert_eq!(got.len(), want.len(), "{quantity}");
        let error = largest(got.iter().zip(want).map(|(got, want)| (got - want).abs()));
        let scale = largest(want.iter().map(|want| want.abs()));
        let same = |row: &&mut (&str, &str, f64, f64)| (row.0, row.1) == (quantity, scalar);
        match self.rows.iter_mut().find(same) {
            Some(row) => (row.2, row.3) = (largest([row.2, error]), largest([row.3, scale])),
            None => self.rows.push((quantity, scalar, error, scale)),
        }
    }

    /// The largest error of a quantity relative to its full scale, if it was compared in this
    /// scalar.
    pub fn of(&self, quantity: &str, scalar: &str) -> Option<f64> {
        let row = self.rows.iter().find(|row| (row.0, row.1) == (quantity, scalar));
        row.map(|row| row.2 / row.3)
    }

    /// Holds every quantity against the table.
    ///
    /// # Panics
    /// Names what [`check`] finds.
    #[track_caller]
    pub fn check(&self) {
        let mut found = Vec::new();
        for (quantity, scalar, error, scale) in &self.rows {
            let error = error / scale;
            println!("{} {quantity}, {scalar}: {error:.1e}", self.robot);
            found.extend(check(self.robot, quantity, scalar, error).err());
        }
        assert!(found.is_empty(), "{}", found.join("\n"));
    }
}
