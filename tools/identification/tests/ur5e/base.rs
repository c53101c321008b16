//! Base parameters.

use dynamics_core::algorithms::rnea;
use dynamics_core::effects::{Armature, Coulomb, RIGID_BODY, Viscous};
use dynamics_core::model::Robot;
use dynamics_core::robots::Panda;
use identification::{BaseModel, ExcitationLimits, Parameter};

use crate::plant::arm;
use crate::setup::*;

/// The arms are all different, while `ARM` has the bodies of the nominal one.
#[test]
fn the_torques_by_base_parameters_are_those_of_inverse_dynamics() {
    for seed in 0..5 {
        let truth = Parameters::off(seed);
        let of = |k: usize| truth.joints.map(|joint| joint[k]);
        let coulomb = Coulomb { torque: of(1), width: WIDTH };
        let scene = (RIGID_BODY, Viscous(of(0)), coulomb, Armature(of(2)));
        let (arm, base) = (arm(&truth), truth.base());
        for state in states(&CHOSEN, 50) {
            let expected = rnea(&arm, &state, &scene);
            let found = ARM.torques(&base, &state);
            for j in 0..6 {
                let error = found[j] - expected[j] - truth.joints[j][3];
                assert!(error.abs() < 2e-13 * RATED[0], "{seed} {j}: {error:e}");
            }
        }
    }
}

/// Khalil & Dombre (2002), chapter 9: of revolute joints, a vertical one first, one parameter of
/// the first body and seven of each other; the armatures of the first two joints are part of the
/// inertias of their bodies about the axes. Offsets and frictions are independent.
#[test]
fn regrouping_rules_give_the_number_of_base_parameters() {
    let armatures = |parameter: &Parameter| matches!(parameter, Parameter::Joint { .. });
    let first = |k| ARM.terms(k)[0].1;
    let joints = (0..ARM.len()).map(first).filter(armatures).count();
    assert_eq!((ARM.len() - joints, joints), (1 + 5 * 7, 3 * 6 + 4));
    let limits = ExcitationLimits {
        lower: [-1.0; 7],
        upper: [1.0; 7],
        velocity: [2.0; 7],
        acceleration: [5.0; 7],
        torque: [87.0; 7],
    };
    let panda = BaseModel::new(Panda::MODEL, RIGID_BODY, WIDTH, limits);
    assert_eq!(panda.len(), 1 + 6 * 7 + 3 * 7 + 5);
}

#[test]
fn each_column_of_the_regrouping_is_what_its_parameter_adds() {
    let (base, step) = (Parameters::nominal().base(), 0.25);
    for column in 0..60 {
        let Parameters { mut bodies, joints } = Parameters::nominal();
        bodies[column / 10][column % 10] += step;
        let more = ARM.of_all(&bodies, &joints);
        for k in 0..ARM.len() {
            let terms = ARM.terms(k);
            let own = terms.iter().find(|(_, term)| term.column(6) == column);
            let expected = own.map_or(0.0, |(factor, _)| factor * step);
            assert!((more[k] - base[k] - expected).abs() < 1e-12, "{column} {k}");
        }
    }
}
