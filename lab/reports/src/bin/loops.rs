//! Prints how far robots with kinematic loops are from what Pinocchio recorded, as lines of a table: `cargo xtask
//! loops` puts them into docs/loops.md.

use cluster_tests::{DeltaRobot, FiveBarLeg, Geared, Wrist, recorded as clusters};
use dynamics_core::clusters::ClusteredRobot;
use firmware_demo::robots::{AnkleLeg, FourBarLeg, StewartPlatform};
use host_tests::drawing::Drawing;
use host_tests::tolerances::{Errors, bounds};
use loop_tests::export::drawn;
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

#[rustfmt::skip]
fn main() {
    lines(&drawn::<FourBar, 3, 3, 3, 1, 5, 1>("four-bar"), &loops::<FourBar, 3, 3, 3, 1, 5, 1>());
    lines(&drawn::<FiveBar, 4, 4, 4, 1, 5, 2>("five-bar"), &loops::<FiveBar, 4, 4, 4, 1, 5, 2>());
    lines(&drawn::<Delta, 10, 22, 21, 6, 18, 3>("Delta"), &loops::<Delta, 10, 22, 21, 6, 18, 3>());
    lines(&drawn::<Stewart, 13, 25, 24, 6, 18, 6>("Stewart"), &loops::<Stewart, 13, 25, 24, 6, 18, 6>());
    cluster::<FourBarLeg, 5, 5, 3>("four-bar leg", [0.0; 3]);
    cluster::<FiveBarLeg, 5, 5, 3>("five-bar leg", [0.0, 2.2, 0.9]);
    cluster::<AnkleLeg, 9, 9, 3>("ankle leg", [0.0; 3]);
    cluster::<DeltaRobot, 12, 12, 3>("Delta robot", [0.3; 3]);
    cluster::<StewartPlatform, 24, 24, 6>("Stewart platform", [0.0, 0.0, 0.8, 0.0, 0.0, 0.0]);
    cluster::<Wrist, 6, 6, 6>("wrist", [0.0, -1.0, 1.0, 0.0, 0.5, 0.0]);
    cluster::<Geared, 7, 7, 4>("geared", [0.0, 0.5, 0.5, 0.0]);
}

fn cluster<T: ClusteredRobot<B, N, N, Y, Y>, const B: usize, const N: usize, const Y: usize>(
    name: &str,
    home: [f64; Y],
) {
    lines(
        &clusters::drawn::<T, B, N, Y>(name, home),
        &clusters::errors::<T, B, N, Y>(),
    );
}

/// A robot's drawing as a line of JSON, and its lines of the table.
fn lines(drawing: &Drawing, errors: &Errors) {
    println!("{}", serde_json::to_string(drawing).expect("numbers"));
    let name = &drawing.name;
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
