//! Claims about an operator's stops of an arm that floats.

use super::*;

/// An arm that floats, or that has floated and is held.
fn floated(held: bool) -> Joint {
    let mut joint = Joint::halfway(FLOAT);
    joint.run(1, CONTACT);
    if held {
        joint.run(1000, Ok(None));
        assert_eq!(joint.phase(), ContactPhase::Held);
    }
    joint
}

#[test]
fn a_push_does_not_release_an_operators_stop() {
    use StopCategory::{ControlledHold, ControlledOff, TorqueOff};
    for category in [ControlledHold, ControlledOff, TorqueOff] {
        for held in [false, true] {
            let mut joint = floated(held);
            joint.controller.stop_by(Fault::External, category);
            for _ in 0..3 {
                joint.run(100, Ok(None));
                joint.run(100, CONTACT);
                assert_ne!(joint.controller.mode(), Mode::Full, "{category:?} {held}");
                assert_eq!(joint.phase(), ContactPhase::Held);
            }
        }
    }
    for held in [false, true] {
        // Without a stop it floats again.
        let mut joint = floated(held);
        joint.run(1000, Ok(None));
        joint.run(2, CONTACT);
        assert_eq!(joint.controller.mode(), Mode::Full);
        assert_eq!(joint.phase(), ContactPhase::Floating);
    }
}

#[test]
fn a_stop_during_a_push_survives_the_next_push() {
    for held in [false, true] {
        let mut joint = floated(held);
        let observed = joint.controller.observe(Ok(&[joint.q]));
        let mut tick = joint.reaction.reference(observed, CONTACT, &joint.motion);
        tick.stop_by(Fault::External, StopCategory::ControlledHold);
        assert_eq!(tick.mode(), Mode::Hold);
        tick.command(&[0.0]);
        assert_eq!(joint.phase(), ContactPhase::Floating);
        joint.run(100, Ok(None));
        joint.run(100, CONTACT);
        assert_eq!(joint.controller.mode(), Mode::Hold, "{held}");
        assert_eq!(joint.phase(), ContactPhase::Held);
    }
}

#[test]
fn an_arm_floats_again_after_stop_and_reset() {
    for held in [false, true] {
        let mut joint = floated(held);
        let hold = StopCategory::ControlledHold;
        joint.controller.stop_by(Fault::External, hold);
        joint.run(100, Ok(None));
        assert_eq!(joint.reset(), Ok(()));
        joint.run(500, Ok(None));
        joint.run(1, CONTACT);
        joint.run(1000, Ok(None));
        assert_eq!(joint.phase(), ContactPhase::Held);
        joint.run(2, CONTACT);
        assert_eq!(joint.phase(), ContactPhase::Floating);
    }
}

// The arm floats for the second time.
#[test]
fn the_next_stop_decelerates_a_floating_arm() {
    let mut joint = Joint::with_ticks(FLOAT, 0, 400);
    joint.run(500, Ok(None));
    joint.run(1, CONTACT);
    joint.run(1500, Ok(None));
    assert_eq!(joint.phase(), ContactPhase::Held);
    assert_eq!(joint.controller.reference().qd, [0.0]);
    for _ in 0..50 {
        joint.run(1, CONTACT);
        joint.q += 1e-3; // by a hand
    }
    let hold = StopCategory::ControlledHold;
    joint.controller.stop_by(Fault::External, hold);
    joint.run(1, Ok(None));
    let (reference, estimate) = (joint.controller.reference(), joint.controller.estimate());
    assert!(estimate.qd[0] > 0.5, "{estimate:?}");
    assert_eq!(reference.qd, estimate.qd);
    assert_eq!(reference.qdd, [-25.0 * estimate.qd[0]]);
}
