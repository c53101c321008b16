//! Prints how far robots with kinematic loops are from what Pinocchio recorded, as lines of a table: `cargo xtask
//! loops` puts them into docs/loops.md.

use cluster_tests::{DeltaRobot, FiveBarLeg, Geared, Wrist, recorded::errors as clusters};
use firmware_demo::robots::{AnkleLeg, FourBarLeg, StewartPlatform};
use host_tests::tolerances::{Errors, bounds};
use loop_tests::machines::{Delta, FiveBar, FourBar, Stewart};
use loop_tests::recorded::errors as loops;

/// Quantities of the tolerance table, and their names on the page.
const QUANTITIES: [(&str, &str); 7] = [
    ("recorded torques", "inverse dynamics"),
    ("recorded accelerations", "forward dynamics"),
    ("rnea", "inverse dynamics, core"),
    ("engine rnea", "inverse dynamics, engine"),
    ("engine and core", "inverse dynamics, engine against core"),
    ("aba", "forward dynamics"),
    ("aba of rnea", "forward dynamics of inverse dynamics"),
];

fn main() {
    lines("four-bar", &loops::<FourBar, 3, 3, 3, 1, 5, 1>());
    lines("five-bar", &loops::<FiveBar, 4, 4, 4, 1, 5, 2>());
    lines("Delta", &loops::<Delta, 10, 22, 21, 6, 18, 3>());
    lines("Stewart", &loops::<Stewart, 13, 25, 24, 6, 18, 6>());
    lines("four-bar leg", &clusters::<FourBarLeg, 5, 5, 3>());
    lines("five-bar leg", &clusters::<FiveBarLeg, 5, 5, 3>());
    lines("ankle leg", &clusters::<AnkleLeg, 9, 9, 3>());
    lines("Delta robot", &clusters::<DeltaRobot, 12, 12, 3>());
    lines(
        "Stewart platform",
        &clusters::<StewartPlatform, 24, 24, 6>(),
    );
    lines("wrist", &clusters::<Wrist, 6, 6, 6>());
    lines("geared", &clusters::<Geared, 7, 7, 4>());
}

fn lines(name: &str, errors: &Errors) {
    for (quantity, words) in QUANTITIES {
        let measured = ["f64", "f32"].map(|scalar| errors.of(quantity, scalar));
        let ([Some(double), Some(single)], Some([of_double, of_single])) =
            (measured, bounds(errors.robot, quantity))
        else {
            continue;
        };
        println!(
            "| {name} | {words} | {double:.1e} | {of_double:.1e} | {single:.1e} | {of_single:.1e} |"
        );
    }
}
