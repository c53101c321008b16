//! Prints as JSON what few modes leave out of links that bend, and how far inverse dynamics is from the referee's: `cargo
//! xtask flexible` puts them into docs/flexible.md.

use dynamics_core::flexible::Modes;
use dynamics_core::model::{ArmModel, Robot};
use flexible_tests::recording::recording;
use flexible_tests::referee::{error, forced, inverse, sag};
use flexible_tests::{LOWER, PLANAR, Planar, SPATIAL, Spatial, UPPER};
use serde_json::json;

fn main() {
    let truncation = [
        of::<1>(),
        of::<2>(),
        of::<3>(),
        of::<4>(),
        of::<5>(),
        of::<6>(),
    ];
    let errors = [
        errors("planar", &Planar::MODEL, &PLANAR),
        errors("spatial", &Spatial::MODEL, &SPATIAL),
    ];
    println!(
        "{}",
        json!({ "truncation": truncation, "errors": errors.concat() })
    );
}

/// What M modes leave out: of the tip at rest, upper and fore link, and of the upper link's in motion.
fn of<const M: usize>() -> [f64; 3] {
    let (at_rest, moving) = (&recording().r#static, &recording().forced);
    let tips: Vec<f64> = forced::<M>(&UPPER, moving)
        .iter()
        .map(|row| row[0])
        .collect();
    [
        sag::<M>(&UPPER, &at_rest["upper"])[1],
        sag::<M>(&LOWER, &at_rest["fore"])[1],
        error(tips.iter().zip(&moving.tip)),
    ]
}

/// Robot, quantity, and its errors in f64 and f32.
fn errors<const M: usize>(
    name: &'static str,
    model: &ArmModel<f64, 2>,
    modes: &Modes<f64, M>,
) -> Vec<(&'static str, &'static str, [f64; 2])> {
    let recorded = &recording().dynamics[name];
    let double = inverse(recorded, model, modes);
    let single = inverse(recorded, &model.to_f32(), &modes.to_f32());
    let of = |quantity, rows: &[Vec<f64>], k: usize| {
        let errors = [&double[k], &single[k]];
        let errors = errors.map(|found| error(found.iter().zip(rows.iter().flatten())));
        (name, quantity, errors)
    };
    vec![
        of("torques of the joints", &recorded.tau, 0),
        of("forces on the modes", &recorded.modal, 1),
    ]
}
