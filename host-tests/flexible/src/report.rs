//! The figures of docs/flexible.md.

use dynamics_core::effects::RIGID_BODY;
use dynamics_core::flexible::{Bending, BendingRobot};
use dynamics_core::{Core, Engine};
use serde_json::{Value, json};

use crate::recording::recording;
use crate::referee::{error, forced, inverse, sag};
use crate::{LOWER, Planar, Spatial, UPPER};

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
        errors::<Planar, 4>("planar"),
        errors::<Spatial, 6>("spatial"),
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

/// Robot, form and quantity, and the errors of it in f64 and f32.
fn errors<T, const M: usize>(name: &str) -> Vec<(String, &'static str, [f64; 2])>
where
    T: BendingRobot<2, 2, 2, M>,
{
    let recorded = &recording().dynamics[name];
    let of = |form, double: [Vec<f64>; 2], single: [Vec<f64>; 2]| {
        let quantities = [
            ("torques of the joints", &recorded.tau),
            ("forces on the modes", &recorded.modal),
        ];
        let found = double.into_iter().zip(single);
        let rows = quantities.into_iter().zip(found);
        let rows = rows.map(|((quantity, rows), (double, single))| {
            let of = |found: &[f64]| error(found.iter().zip(rows.iter().flatten()));
            (
                format!("{name}, {form}"),
                quantity,
                [of(&double), of(&single)],
            )
        });
        rows.collect::<Vec<_>>()
    };
    let core = of(
        "core",
        inverse(recorded, |q, eta| {
            Bending::<Core<T>>::rnea::<f64, _, 2, 2, 2, M>(q, eta, &RIGID_BODY)
        }),
        inverse(recorded, |q, eta| {
            Bending::<Core<T>>::rnea::<f32, _, 2, 2, 2, M>(q, eta, &RIGID_BODY)
        }),
    );
    let engine = of(
        "engine",
        inverse(recorded, |q, eta| {
            Bending::<Engine<T>>::rnea::<f64, _, 2, 2, 2, M>(q, eta, &RIGID_BODY)
        }),
        inverse(recorded, |q, eta| {
            Bending::<Engine<T>>::rnea::<f32, _, 2, 2, 2, M>(q, eta, &RIGID_BODY)
        }),
    );
    [core, engine].concat()
}
