//! Motions that do not show the parameters, and recordings that are none.

use identification::{Fit, FourierMotion, IdentificationError, TickRecording};

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
fn parameters_of_resting_joints_are_not_determined() {
    let motion = alone(2);
    assert!(ARM.condition(&states(&motion, 200)) > 1e6);
    let run = Run::new(&motion, &Parameters::off(3));
    let found = fitted(&ARM, &run.recorded(NOISE, 3), Fit::new(TICK));
    let name = |joint, kind| format!("joint {joint} {kind} friction");
    let determined = |name: &String| {
        found.is_determined((0..ARM.len()).find(|&k| ARM.name(k) == *name).expect("one"))
    };
    for joint in [0, 1, 3, 4, 5] {
        assert!(!determined(&name(joint, "viscous")), "{joint}");
    }
    assert!(determined(&name(2, "viscous")) && determined(&name(2, "Coulomb")));
}

#[test]
fn recordings_of_uneven_lengths_or_nonfinite_numbers_are_refused() {
    let (q, tau) = (vec![[0.0; 6]; 20], vec![[0.0; 6]; 20]);
    let refused = |q: &[[f64; 6]], tau: &[[f64; 6]], interval| {
        let stretch = vec![(q.to_vec(), tau.to_vec())];
        TickRecording::try_new(stretch, interval).expect_err("refused")
    };
    let lengths = IdentificationError::Lengths { samples: 20, torques: 19 };
    assert_eq!(refused(&q, &tau[1..], TICK), lengths);
    for interval in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(refused(&q, &tau, interval), IdentificationError::Interval);
    }
    let mut bad = tau.clone();
    bad[13][4] = f64::NAN;
    let not_finite = IdentificationError::NotFinite { sample: 13, joint: 4 };
    assert_eq!(refused(&q, &bad, TICK), not_finite);
    assert_eq!(refused(&bad, &tau, TICK), not_finite);
}

// The noise is that of the filter, and the prior the nominal arm.
#[test]
fn an_arm_without_noise_is_identified() {
    let truth = Parameters::off(5);
    let states: Vec<_> = states(&CHOSEN, EACH as u32);
    let torques = states.iter().map(|state| ARM.torques(&truth.base(), state)).collect();
    let positions = states.iter().map(|state| state.q).collect();
    let recording = TickRecording::try_new(vec![(positions, torques)], TICK).expect("a period");
    let found = fitted(&ARM, &recording, Fit { delay: 0.0, ..Fit::new(TICK) });
    for (k, (found, base)) in found.base.iter().zip(truth.base()).enumerate() {
        let off = (found - base).abs() * ARM.scales()[k];
        assert!(off < 1e-3, "{}: {found} {base}", ARM.name(k));
    }
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
        let found = fitted(&ARM, &recording, Fit { delay: ticks * TICK, ..Fit::new(TICK) });
        crate::coverage::errors(&ARM, &found.base, &truth.base(), &states(&CHOSEN, 200)).largest
    });
    assert!(3.0 * errors[0] < errors[1] && 1.5 * errors[1] < errors[2], "{errors:?}");
}
