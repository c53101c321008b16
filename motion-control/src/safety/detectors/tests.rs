use super::*;
use crate::limits::Mode;
use crate::tests::full_command;

mod signs;

fn detectors(saturated: u32) -> Detectors<f64, 1> {
    Detectors {
        frozen: FrozenEncoder::new([0.01], 1),
        steps: ReferenceStep::new([0.1]),
        saturation: Saturation::new([10.0], saturated),
    }
}

// The reference comes back to the frozen angle.
#[test]
fn a_frozen_encoder_stays_a_fault() {
    let mut frozen = FrozenEncoder::new([0.01_f64; 2], 2);
    let frozen_at = |reference: f64, frozen: &mut FrozenEncoder<f64, 2>| {
        frozen.check(&[reference, 0.5], &[reference, 0.5 + reference])
    };
    let fault = Err(Fault::Frozen { joint: 1 });
    // The second joint is compared in every other tick.
    for reference in [0.0, 0.0, 0.01] {
        assert_eq!(frozen_at(reference, &mut frozen), Ok(()), "{reference}");
    }
    for reference in [0.02, 0.0, 0.005] {
        assert_eq!(frozen_at(reference, &mut frozen), fault, "{reference}");
    }
    frozen.restart();
    assert_eq!(frozen_at(0.03, &mut frozen), Ok(()));
}

#[test]
fn an_encoder_that_freezes_is_found_wherever_the_rotation_is() {
    const JOINTS: usize = 6;
    for joint in 0..JOINTS {
        for begin in 20..20 + JOINTS as u32 {
            let mut frozen = FrozenEncoder::new([1.5e-3_f64; JOINTS], 3);
            let found = (0..100).find(|&tick| {
                let reference = [1e-3 * f64::from(tick); JOINTS];
                let mut q = reference;
                q[joint] = 1e-3 * f64::from(tick.min(begin));
                let fault = frozen.check(&q, &reference);
                assert!(fault.is_ok() || fault == Err(Fault::Frozen { joint }));
                fault.is_err()
            });
            let ticks = found.expect("a fault") - begin;
            assert!((JOINTS..2 * JOINTS).contains(&(ticks as usize)), "{ticks}");
        }
    }
}

#[test]
fn an_arm_at_rest_is_not_frozen() {
    let mut frozen = FrozenEncoder::new([0.01_f64], 2);
    for tick in 0..1000 {
        // The reference of an arm at rest may be off, but does not move.
        assert_eq!(frozen.check(&[0.5], &[0.7]), Ok(()), "{tick}");
    }
    // A count for each 1.3 of the reference.
    for tick in 0..1000 {
        let reference = 0.7 + 1e-3 * f64::from(tick);
        let count = (reference / 1.3e-3).floor() * 1.3e-3;
        assert_eq!(frozen.check(&[count], &[reference]), Ok(()), "{tick}");
    }
}

#[test]
fn each_joint_has_its_own_count_of_saturation() {
    let mut saturation = Saturation::new([10.0_f64, 5.0], 3);
    for tick in 0..20 {
        // Joints in turn, each for as long as it may.
        let torque = [[10.0, 4.9], [-9.9, -5.0]][tick / 3 % 2];
        assert_eq!(saturation.check(&torque), Ok(()), "{tick}");
    }
    let faults = [(); 4].map(|()| saturation.check(&[0.0, -5.0]).is_err());
    assert_eq!(faults, [false, false, false, true]);
}

#[test]
fn a_reference_that_is_not_finite_is_a_step() {
    for bad in [f64::NAN, f64::INFINITY] {
        let mut steps = ReferenceStep::new([f64::INFINITY; 1]);
        assert_eq!(steps.check(&State::at([0.0])), Ok(()));
        let fault = Err(Fault::Reference { joint: 0 });
        for field in 0..3 {
            let mut state = State::at([0.0]);
            [&mut state.q, &mut state.qd, &mut state.qdd][field][0] = bad;
            assert_eq!(steps.check(&state), fault, "{field}");
            steps.restart();
        }
    }
}

#[test]
fn no_reference_acted_before_the_first_tick() {
    let mut frozen = FrozenEncoder::new([0.01_f64], 3);
    // A controller that has had no tick has a reference of zero, wherever the arm is.
    assert_eq!(frozen.check(&[2.0], &[0.0]), Ok(()));
    for tick in 0..10 {
        assert_eq!(frozen.check(&[2.0], &[2.0]), Ok(()), "{tick}");
    }
}

#[test]
fn a_step_without_a_limit_hides_no_other_joint() {
    let mut steps = ReferenceStep::new([f64::INFINITY, 0.1]);
    assert_eq!(steps.check(&State::at([0.0, 0.0])), Ok(()));
    assert_eq!(steps.check(&State::at([9.0, 0.05])), Ok(()));
    let fault = Err(Fault::Reference { joint: 1 });
    assert_eq!(steps.check(&State::at([0.0, 0.5])), fault);
}

#[test]
fn a_reference_to_detectors_detects_as_they_do() {
    fn found(mut detectors: impl Detect<f64, 1>) -> [Option<Fault>; 6] {
        let frozen = [0.0, 0.02, 0.04].map(|x| detectors.measured(&[0.5], &[x]).err());
        let mut follow = |q| detectors.referenced(&State::at([q]), Mode::Full).err();
        let steps = [follow(0.0), follow(0.5)];
        detectors.restart();
        let restarted = detectors.referenced(&State::at([0.9]), Mode::Full).err();
        let saturated = detectors.commanded(&full_command([10.0], false)).err();
        [frozen[1], frozen[2], steps[0], steps[1], restarted, saturated]
    }
    let joint = 0;
    let [frozen, step] = [Fault::Frozen { joint }, Fault::Reference { joint }].map(Some);
    let saturated = Some(Fault::Saturated { joint });
    let faults = [None, frozen, None, step, None, saturated];
    assert_eq!(found(detectors(0)), faults);
    assert_eq!(found(&mut detectors(0)), faults);
}

/// The ticks with a fault of a joint that is measured at these positions while its reference moves
/// 0.5 in each tick.
fn frozen_ticks(frozen: &mut FrozenEncoder<f64, 1>, positions: &[f64]) -> Vec<usize> {
    let ticks = positions.iter().enumerate();
    let faults = ticks.filter(|&(tick, &q)| frozen.check(&[q], &[0.5 * tick as f64]).is_err());
    faults.map(|(tick, _)| tick).collect()
}

#[test]
fn a_frozen_position_is_a_fault_after_its_ticks() {
    for ticks in 1..5 {
        let mut frozen = FrozenEncoder::new([0.1], ticks);
        let found = frozen_ticks(&mut frozen, &[0.0; 8]);
        assert_eq!(found, (ticks as usize + 1..8).collect::<Vec<_>>());
        // A position that changes begins anew, whatever was counted.
        let mut frozen = FrozenEncoder::new([0.1], ticks);
        let moves = [0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
        let from = ticks as usize + 2;
        assert_eq!(frozen_ticks(&mut frozen, &moves), (from..8).collect::<Vec<_>>());
    }
}

#[test]
fn a_restart_forgets_what_was_measured() {
    let mut frozen = FrozenEncoder::new([0.1], 4);
    let new = frozen_ticks(&mut frozen.clone(), &[0.0; 8]);
    assert_eq!(frozen_ticks(&mut frozen, &[0.0; 4]), [0; 0]);
    frozen.restart();
    assert_eq!(frozen_ticks(&mut frozen, &[0.0; 8]), new);
    // One that is found, too; it is a new count when the position changes.
    frozen.restart();
    assert_eq!(frozen_ticks(&mut frozen, &[0.0; 8]), new);
    assert_eq!(frozen_ticks(&mut frozen, &[1.0; 8]), [6, 7]);
}

#[test]
fn steps_are_compared_with_the_reference_before() {
    let found = |positions: &[f64]| -> Vec<bool> {
        let mut steps = ReferenceStep::new([0.5, 0.5]);
        let check = |&q: &f64| steps.check(&State::at([q, 0.0])).is_err();
        positions.iter().map(check).collect()
    };
    // Each within a step of the one before, as far as the whole motion goes; the last is as large
    // as a step may be.
    assert_eq!(found(&[0.0, 0.4, 0.8, 1.2, 1.7]), [false; 5]);
    // From one side to the other, and there it stays.
    assert_eq!(found(&[0.5, -0.5, -0.5, -0.9]), [false, true, false, false]);
    assert_eq!(found(&[-2.0, 2.0, 1.75]), [false, true, false]);
    // After a step at its limit the next is compared with it.
    assert_eq!(found(&[0.0, 0.5, 1.0, 1.6]), [false, false, false, true]);
}

#[test]
fn detectors_restart_where_their_quantity_leaps() {
    let mut detectors = detectors(0);
    let mut follow = |q: f64, mode| detectors.referenced(&State::at([q]), mode).is_err();
    assert!(!follow(0.0, Mode::Full) && !follow(0.9, Mode::Hold));
    assert!(!follow(1.8, Mode::Full) && follow(2.7, Mode::Full));
    for brake in [false, true] {
        let command = full_command([0.0], brake);
        detectors.frozen.restart();
        let found = [0.0, 0.5, 1.0, 1.5].map(|reference| {
            let fault = detectors.measured(&[0.5], &[reference]).is_err();
            assert_eq!(detectors.commanded(&command), Ok(()));
            fault
        });
        assert_eq!(found, [false, false, !brake, !brake]);
    }
}

#[test]
fn no_detector_finds_no_fault() {
    let mut none = ();
    let state = State::at([f64::NAN]);
    assert_eq!(Detect::measured(&mut none, &[f64::NAN], &[0.0]), Ok(()));
    assert_eq!(Detect::referenced(&mut none, &state, Mode::Full), Ok(()));
    Detect::<f64, 1>::restart(&mut none);
}
