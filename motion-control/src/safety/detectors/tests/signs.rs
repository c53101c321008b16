//! Both signs of each quantity, and which joint is named.

use super::*;

#[test]
fn a_reference_that_falls_is_a_motion_too() {
    for way in [1.0, -1.0] {
        let mut frozen = FrozenEncoder::new([0.25_f64], 1);
        // Further than 0.25 from where the position last changed.
        let faults = [0.0, 0.125, 0.25, 0.375].map(|reference| {
            let fault = frozen.check(&[1.0], &[1.0 + way * reference]);
            fault.is_err()
        });
        // The first comparison is that of the second tick.
        assert_eq!(faults, [false; 4], "{way}");
        let fault = Err(Fault::Frozen { joint: 0 });
        assert_eq!(frozen.check(&[1.0], &[1.0 + way * 0.5]), fault, "{way}");
    }
}

#[test]
fn each_encoder_has_its_own_distance() {
    for (joint, distance) in [(0, [0.25, 9.0]), (1, [9.0, 0.25])] {
        let mut frozen = FrozenEncoder::new(distance, 2);
        let found = (0..20).find_map(|tick| {
            let reference = [0.125 * f64::from(tick); 2];
            frozen.check(&[0.5; 2], &reference).err()
        });
        assert_eq!(found, Some(Fault::Frozen { joint }));
    }
}

#[test]
fn torques_of_both_signs_saturate_and_the_first_joint_is_named() {
    for limits in [[10.0_f64, 5.0], [5.0, 10.0]] {
        for signs in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
            let torque = [0, 1].map(|k| signs[k] * limits[k]);
            for (torque, joint) in [(torque, 0), ([torque[0], 0.0], 0), ([0.0, torque[1]], 1)] {
                let mut saturation = Saturation::new(limits, 1);
                assert_eq!(saturation.check(&torque), Ok(()));
                let fault = Err(Fault::Saturated { joint });
                assert_eq!(saturation.check(&torque), fault, "{torque:?}");
                assert_eq!(saturation.check(&torque), fault, "{torque:?}");
                let below = torque.map(|torque| 0.999 * torque);
                for _ in 0..5 {
                    assert_eq!(saturation.check(&below), Ok(()), "{torque:?}");
                }
                assert_eq!(saturation, Saturation::new(limits, 1));
            }
        }
    }
    let mut none = Saturation::new([1.0_f64], 0);
    assert_eq!(none.check(&[1.0]), Err(Fault::Saturated { joint: 0 }));
}

/// The first tick with a fault of torques that are at a limit for so many ticks, and then between
/// the limits for so many.
fn swings(at_limit: usize, between: usize) -> Option<(usize, Fault)> {
    let mut saturation = Saturation::new([5.0_f64, 10.0], 3);
    let half = at_limit + between;
    (0..40 * half).find_map(|tick| {
        let side = if (tick / half).is_multiple_of(2) { 1.0 } else { -1.0 };
        let torque = if tick % half < at_limit { side * 10.0 } else { side * 9.0 };
        saturation.check(&[0.0, torque]).err().map(|fault| (tick, fault))
    })
}

#[test]
fn swings_from_limit_to_limit_are_a_fault_whatever_their_period() {
    for (at_limit, between) in [(1, 1), (2, 1), (3, 5), (1, 12)] {
        let fault = Fault::LimitCycle { joint: 1 };
        assert_eq!(swings(at_limit, between), Some((8 * (at_limit + between), fault)));
    }
    // Slower ones are those of a motion, and a torque that stays at its limits is another fault.
    assert_eq!(swings(1, 13), None);
    for at_limit in [1, 4] {
        assert_eq!(swings(at_limit, 0), Some((3, Fault::Saturated { joint: 1 })));
    }
    // Torques that are at one limit again and again do not swing.
    let mut saturation = Saturation::new([10.0_f64], 3);
    assert!((0..100).all(|tick| saturation.check(&[[10.0, 9.0][tick % 2]]).is_ok()));
}

#[test]
fn steps_of_both_signs_are_found_and_the_first_joint_is_named() {
    for (step, joint) in [
        ([0.6, 0.0], 0),
        ([-0.6, 0.0], 0),
        ([0.0, 0.3], 1),
        ([0.0, -0.3], 1),
        ([0.6, 0.3], 0),
        ([-0.6, -0.3], 0),
    ] {
        let mut steps = ReferenceStep::new([0.5, 0.25]);
        assert_eq!(steps.check(&State::at([1.0, 2.0])), Ok(()));
        let next = State::at([1.0 + step[0], 2.0 + step[1]]);
        let fault = Err(Fault::Reference { joint });
        assert_eq!(steps.check(&next), fault, "{step:?}");
        // It was a step from there to here: the next is compared with the last one.
        assert_eq!(steps.check(&next), Ok(()), "{step:?}");
        steps.restart();
        assert_eq!(steps.check(&State::at([9.0; 2])), Ok(()));
    }
}

#[test]
fn rates_that_are_not_finite_are_named_and_large_ones_are_none() {
    for joint in 0..2 {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut steps = ReferenceStep::new([0.5; 2]);
            let mut state = State::at([0.0; 2]);
            state.qd[joint] = bad;
            let fault = Err(Fault::Reference { joint });
            assert_eq!(steps.check(&state), fault, "{bad}");
            // Two that are infinite may have a finite sum nowhere.
            state.qdd[joint] = -bad;
            assert_eq!(steps.check(&state), fault, "{bad}");
        }
    }
    let mut steps = ReferenceStep::new([0.5; 2]);
    let state = State { qd: [f64::MAX; 2], qdd: [f64::MAX; 2], ..State::at([0.0; 2]) };
    assert_eq!(steps.check(&state), Ok(()));
    assert!(steps.check(&State::at([0.6, 0.0])).is_err());
}

#[test]
fn missed_ticks_forget_the_reference_alone() {
    let mut detectors = detectors(1);
    assert_eq!(detectors.measured(&[0.5], &[0.5]), Ok(()));
    assert_eq!(detectors.measured(&[0.5], &[0.5]), Ok(()));
    let at = |q| State::at([q]);
    assert_eq!(detectors.referenced(&at(0.5), Mode::Full), Ok(()));
    let before = detectors;
    detectors.restart();
    assert_eq!(detectors.frozen, before.frozen);
    assert_eq!(detectors.saturation, before.saturation);
    assert_eq!(detectors.referenced(&at(5.0), Mode::Full), Ok(()));
    let fault = Err(Fault::Reference { joint: 0 });
    assert_eq!(detectors.referenced(&at(0.5), Mode::Full), fault);
    let frozen = Err(Fault::Frozen { joint: 0 });
    assert_eq!(detectors.measured(&[0.5], &[0.52]), frozen);
}

#[test]
fn a_position_is_frozen_for_its_ticks_however_many_joints_there_are() {
    // Each of three joints is compared in every third tick: three ticks are one comparison, four or
    // six are two.
    for (ticks, comparisons) in [(0, 1), (1, 1), (3, 1), (4, 2), (6, 2), (7, 3)] {
        let mut frozen = FrozenEncoder::new([0.25_f64; 3], ticks);
        let found = (0..100).find(|&tick| {
            let reference = f64::from(tick);
            // The others move.
            let q = [reference, 0.5, reference];
            frozen.check(&q, &[reference; 3]).is_err()
        });
        // The second joint is compared in the tick 1, 4, 7 and so on, first with nothing.
        assert_eq!(found, Some(1 + 3 * comparisons), "{ticks}");
    }
}
