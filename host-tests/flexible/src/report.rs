//! The figures of docs/flexible.md.

use dynamics_core::flexible::Modes;
use dynamics_core::model::{ArmModel, Robot};
use serde_json::{Value, json};

use crate::recording::recording;
use crate::referee::{error, forced, inverse, sag};
use crate::{LOWER, PLANAR, Planar, SPATIAL, Spatial, UPPER};

/// The truncation errors of 1 to 6 modes, and the errors of inverse dynamics in f64 and f32.
pub fn measured() -> Value {
    let truncation = [
        truncation::<1>(),
        truncation::<2>(),
        truncation::<3>(),
        truncation::<4>(),
        truncation::<5>(),
        truncation::<6>(),
    ];
    let errors = [
        errors("planar", &Planar::MODEL, &PLANAR),
        errors("spatial", &Spatial::MODEL, &SPATIAL),
    ];
    json!({ "truncation": truncation, "errors": errors.concat() })
}

/// The truncation errors of M modes: the tips of upper and fore link at rest, and the upper link's tip in motion.
fn truncation<const M: usize>() -> [f64; 3] {
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
