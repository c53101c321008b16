//! Claims about the first and the last tick of a reaction, and what of it is left to the next one.

use super::*;

/// The ticks of a retraction, whose begin is checked, from a contact in this tick on.
fn retraction(joint: &mut Joint) -> u32 {
    joint.run(1, CONTACT);
    let begin = joint.controller.estimate().q[0];
    assert!((joint.controller.reference().q[0] - begin).abs() < 1e-15);
    let mut ticks = 0;
    while joint.phase() == ContactPhase::Retracting {
        let before = joint.controller.reference().q[0];
        joint.run(1, Ok(None));
        let reference = joint.controller.reference();
        let rate = (reference.q[0] - before) / TICK;
        // The mean of a tick, and the rate at its end.
        assert!((rate - reference.qd[0]).abs() < 2e-3, "{ticks}");
        ticks += 1;
    }
    ticks
}

#[test]
fn each_retraction_lasts_as_long_as_it_was_planned() {
    let mut joint = Joint::halfway(config().response);
    for _ in 0..2 {
        let ticks = retraction(&mut joint);
        assert_eq!(ticks, joint.reaction.path.ticks() + 1);
        joint.run(100, Ok(None));
        assert_eq!(joint.reset(), Ok(()));
        assert_eq!(joint.phase(), ContactPhase::Watching);
        // Along the motion again, further than the retraction goes back.
        joint.run(700, Ok(None));
    }
}

#[test]
fn a_contact_in_a_return_keeps_what_it_advanced() {
    let mut joint = Joint::halfway(config().response);
    retraction(&mut joint);
    joint.run(100, Ok(None));
    let left = joint.controller.trajectory_tick();
    assert_eq!(joint.reset(), Ok(()));
    joint.run(300, Ok(None));
    joint.run(1, CONTACT);
    // ∫w over three quarters of 400 ticks is 103.
    let advanced = joint.controller.trajectory_tick() - left;
    assert!((98..=104).contains(&advanced), "{advanced}");
}

#[test]
fn an_arm_that_was_stopped_has_no_path() {
    let mut joint = Joint::halfway(config().response);
    let off = StopCategory::TorqueOff;
    joint.controller.stop_by(Fault::External, off);
    joint.run(10, Ok(None));
    assert_eq!(joint.controller.reset(&joint.motion), Ok(()));
    joint.run(10, Ok(None));
    joint.run(1, CONTACT);
    assert_eq!(joint.phase(), ContactPhase::Held);
}

#[test]
fn a_floating_arm_is_decelerated_beyond_its_speed() {
    // The gains of FLOAT and of the hold.
    let (damping, most, decay) = (5.0, 1.0, 25.0);
    for speed in [0.5, -0.5, 1.5, -1.5] {
        let mut joint = Joint::halfway(FLOAT);
        joint.run(1, CONTACT);
        for _ in 0..100 {
            let q = joint.q;
            joint.run(1, CONTACT);
            joint.q = q + speed * TICK; // by a hand
        }
        let [qd] = joint.controller.estimate().qd;
        assert!((qd / speed - 1.0).abs() < 0.2, "{qd} {speed}");
        let beyond = qd - qd.clamp(-most, most);
        let expected = -damping * qd - decay * beyond;
        let [qdd] = joint.controller.reference().qdd;
        assert!((qdd - expected).abs() < 1e-9, "{qdd} {expected}");
    }
}

#[test]
fn a_contact_that_holds_the_arm_is_a_stop_from_outside() {
    let mut joint = Joint::halfway(ContactResponse::Stop);
    joint.run(1, CONTACT);
    let measured = [joint.q];
    let law = |_: &_, _: &_| [0.0];
    for _ in 0..100 {
        let command = joint.controller.tick(Ok(&measured), &joint.motion, law);
        let status = command.status;
        let held = (Mode::Hold, Some(Fault::External));
        assert_eq!((status.mode, status.fault), held);
        assert!(!command.brake);
    }
}
