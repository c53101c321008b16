//! Descriptions that no body can have, and those that only look so.

use super::{Case, Row};
use dynamics_core::algorithms::rnea;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{Arm, BASE, Body, Joint, Model, ModelError, Problem};
use dynamics_core::state::State;

/// The family's cases.
pub const CASES: &[Case] = &[Case {
    number: 24,
    name: "joint axis of length 2, of length 0",
    parameters: "axes (0, 0, 2), (0, 1.2, 1.6), (0, 0, 0)",
    source: "URDF files with axes that nobody normalised; a missing <axis> read as zeros",
    oracle: "the same arm with axes of length 1; the typed error",
    reason: "axes are normalised once, in f64: a length of two changes no bit, a direction rounds as before; no length, no direction",
    run: axes,
}];

fn arm(axis: [f64; 3]) -> Result<Arm<f64, 1>, ModelError> {
    let body = Body::new("rod", BASE, Joint::revolute(axis)).mass(2.0);
    Model::try_new("rod", [body.com([0.3, 0.2, 0.1])])
}

fn axes() -> Vec<Row> {
    let tau = |axis| arm(axis).map(|arm| rnea(&arm, &State::at([0.4]), &RIGID_BODY));
    let single = |axis| arm(axis).map(|arm| rnea(&arm.to_f32(), &State::at([0.4]), &RIGID_BODY));
    let mut rows = Vec::new();
    for (name, long, unit) in [
        ("along z", [0.0, 0.0, 2.0], [0.0, 0.0, 1.0]),
        ("in the y-z plane", [0.0, 1.2, 1.6], [0.0, 0.6, 0.8]),
    ] {
        let same = [tau(long) == tau(unit), single(long) == single(unit)];
        let quantity = format!("rnea about a double axis {name}: same bits");
        rows.push(Row::claim(&quantity, "f64", same[0]));
        rows.push(Row::claim(&quantity, "f32", same[1]));
    }
    let refused = matches!(arm([0.0; 3]), Err(e) if e.problem == Problem::Axis && e.body == "rod");
    rows.push(Row::claim("no axis: typed error", "f64", refused));
    rows
}
