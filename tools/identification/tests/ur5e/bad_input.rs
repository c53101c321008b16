//! Motions that do not show the parameters, and recordings that are none.

use identification::{Batch, FourierMotion, IdentificationError, Recording};

use crate::plant::*;
use crate::setup::*;

/// The chosen motion of this joint, while the others rest.
fn alone(joint: usize) -> FourierMotion<6> {
    let mut motion = CHOSEN.clone();
    for amplitudes in motion.sines.iter_mut().chain(&mut motion.cosines) {
        *amplitudes = std::array::from_fn(|j| if j == joint { amplitudes[j] } else { 0.0 });
    }
    motion
}

#[test]
fn parameters_of_resting_joints_are_named_as_undetermined() {
    let motion = alone(2);
    assert!(ARM.condition(&states(&motion, 200)) > 1e6);
    let run = Run::new(&motion, &Parameters::off(3));
    let error = Batch::new(HARMONICS, TICK)
        .identify(&*ARM, &run.recorded(NOISE, 3))
        .expect_err("one joint does not show all");
    let IdentificationError::RankDeficient { rank, parameters, undetermined } = &error else {
        panic!("{error}");
    };
    assert!(*rank < ARM.len() && parameters.len() == undetermined.len(), "{error}");
    for joint in [0, 1, 3, 4, 5] {
        let name = format!("joint {joint} viscous friction");
        assert!(parameters.contains(&name), "{name}: {error}");
    }
    for name in ["joint 2 viscous friction", "joint 2 Coulomb friction"] {
        assert!(!parameters.iter().any(|parameter| parameter == name), "{error}");
    }
    assert!(error.to_string().contains("joint 5 viscous friction"), "{error}");
}

#[test]
fn recordings_of_partial_or_nonfinite_periods_are_refused() {
    let (q, tau) = (vec![[0.0; 6]; 20], vec![[0.0; 6]; 20]);
    let refused = |q: &[[f64; 6]], tau: &[[f64; 6]], each, interval| {
        Recording::try_new(q.to_vec(), tau.to_vec(), each, interval).expect_err("refused")
    };
    let lengths = IdentificationError::Lengths { samples: 20, torques: 19 };
    assert_eq!(refused(&q, &tau[1..], 10, TICK), lengths);
    let periods = |each| IdentificationError::NotWholePeriods { samples: 20, each };
    assert_eq!(refused(&q, &tau, 7, TICK), periods(7));
    assert_eq!(refused(&q, &tau, 0, TICK), periods(0));
    for interval in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(refused(&q, &tau, 10, interval), IdentificationError::Interval);
    }
    let mut bad = tau.clone();
    bad[13][4] = f64::NAN;
    let not_finite = IdentificationError::NotFinite { sample: 13, joint: 4 };
    assert_eq!(refused(&q, &bad, 10, TICK), not_finite);
    assert_eq!(refused(&bad, &tau, 10, TICK), not_finite);
    let short = Recording::try_new(q, tau, 20, TICK).expect("a period");
    let error = Batch::new(HARMONICS, TICK).identify(&*ARM, &short);
    let harmonics = IdentificationError::Harmonics { harmonics: HARMONICS, least: 29, most: 9 };
    assert_eq!(error, Err(harmonics));
}

// At rest nothing is determined.
#[test]
fn an_arm_without_noise_is_identified() {
    let still = FourierMotion { sines: vec![[0.0; 6]], cosines: vec![[0.0; 6]], ..CHOSEN.clone() };
    let truth = Parameters::off(5);
    let record = |motion: &FourierMotion<6>| {
        let states = states(motion, EACH as u32);
        let torques = states.iter().map(|state| ARM.torques(&truth.base(), state)).collect();
        let positions = states.iter().map(|state| state.q).collect();
        Recording::try_new(positions, torques, EACH, TICK).expect("a period")
    };
    let batch = Batch { delay: 0.0, ..Batch::new(HARMONICS, TICK) };
    let found = batch.identify(&*ARM, &record(&CHOSEN)).expect("a good motion");
    for (k, (found, base)) in found.base.iter().zip(truth.base()).enumerate() {
        assert!((found - base).abs() < 1e-9, "{}: {found} {base}", ARM.name(k));
    }
    let Parameters { bodies, joints } = Parameters::nominal();
    let set = (found.physical(&*ARM, &bodies, &joints, 0.3)).expect("a good model");
    for ((k, found), base) in
        ARM.of_all(&set.bodies, &set.joints).iter().enumerate().zip(truth.base())
    {
        assert!(
            (found - base).abs() < 1e-4 * base.abs().max(0.1),
            "{}: {found} {base}",
            ARM.name(k)
        );
    }
    let error = batch.identify(&*ARM, &record(&still)).expect_err("no motion");
    assert!(matches!(error, IdentificationError::RankDeficient { .. }), "{error}");
}

// A body without mass remains so.
#[test]
fn an_impossible_nominal_body_is_named() {
    let Parameters { mut bodies, joints } = Parameters::nominal();
    let found = crate::coverage::identified(&ARM, &Parameters::off(1), 1);
    bodies[4] = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let error = found.physical(&*ARM, &bodies, &joints, 0.3);
    assert_eq!(error, Err(IdentificationError::ImpossibleBody { body: 4 }));
    bodies[4] = [0.0; 10];
    let set = found.physical(&*ARM, &bodies, &joints, 0.3).expect("without the body");
    assert_eq!(set.bodies[4], [0.0; 10]);
    assert!(set.misfit > 1.0); // the arm has its mass
}

/// The accelerations are then those of another time.
#[test]
fn the_delay_of_held_torques_matters() {
    let truth = Parameters::off(2);
    let recording = Run::new(&CHOSEN, &truth).recorded([0.0; 6], 2);
    let errors = [0.5, -0.5, -1.5].map(|ticks| {
        let batch = Batch { delay: ticks * TICK, ..Batch::new(HARMONICS, TICK) };
        let found = batch.identify(&*ARM, &recording).expect("a good motion");
        crate::coverage::errors(&ARM, &found.base, &truth.base(), &states(&CHOSEN, 200)).largest
    });
    assert!(3.0 * errors[0] < errors[1] && 1.5 * errors[1] < errors[2], "{errors:?}");
}
