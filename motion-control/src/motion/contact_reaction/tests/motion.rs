//! Claims about the limits of a retraction, the path that it follows, and the clock of the motion
//! that it interrupts.

use super::*;

// This holds whatever the ticks of a return are.
#[test]
fn a_retraction_keeps_its_limits() {
    let (distance, limits) = (0.1, SLOW);
    let response = ContactResponse::Retract { distance, limits };
    for (reentry_ticks, contact) in [(10, 400), (10, 500), (10, 503), (400, 500)] {
        let mut joint = Joint::with_ticks(response, 30, reentry_ticks);
        joint.run(contact, Ok(None));
        let mut path = Vec::new();
        joint.run(1, CONTACT);
        while joint.phase() == ContactPhase::Retracting {
            path.push(joint.controller.reference().q[0]);
            joint.run(1, Ok(None));
        }
        // It begins from rest where the arm is.
        path.insert(0, path[0]);
        let peak = |changes: &[f64]| changes.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
        let rates =
            |of: &[f64]| -> Vec<f64> { of.windows(2).map(|w| (w[1] - w[0]) / TICK).collect() };
        let speeds = rates(&path);
        let (speed, acceleration) = (peak(&speeds), peak(&rates(&speeds)));
        let limits = (speed / SLOW.velocity, acceleration / SLOW.acceleration);
        let most = f64::max(limits.0, limits.1);
        assert!((0.6..=1.0).contains(&most), "{reentry_ticks}: {limits:?}");
        let went = path[0] - path[path.len() - 1];
        assert!((0.095..0.11).contains(&went), "{went}");
    }
}

// Nor does it go to where it never was.
#[test]
fn an_arm_does_not_retract_to_where_it_was_stopped() {
    let mut joint = Joint::new(config().response);
    joint.controller = joint.controller.on_brake();
    // Before a measurement, and then moved by a hand.
    joint.run(10, Err(Fault::Stale));
    joint.q = 0.5;
    for _ in 0..400 {
        joint.controller.stop(Fault::External);
        let q = joint.q - 1e-3;
        joint.run(1, Ok(None));
        joint.q = q;
    }
    joint.run(5, Ok(None));
    assert!((joint.q - 0.1).abs() < 1e-9, "{}", joint.q);
    assert_eq!(joint.controller.reset(&joint.motion), Ok(()));
    joint.run(5, Ok(None));
    joint.run(2, CONTACT);
    assert_eq!(joint.phase(), ContactPhase::Held);
}

#[test]
fn the_motion_clock_stands_still_during_a_reaction() {
    for response in [config().response, FLOAT] {
        let mut joint = Joint::halfway(response);
        let left = joint.controller.trajectory_tick();
        for tick in 0..100 {
            joint.run(1, CONTACT);
            assert_eq!(joint.controller.trajectory_tick(), left, "{tick}");
            // The motion is no reference in ticks that were missed.
            let before = *joint.controller.reference();
            joint.controller.missed(1, &joint.motion);
            assert_eq!(joint.controller.trajectory_tick(), left);
            assert_eq!(*joint.controller.reference(), before);
            assert_ne!(joint.phase(), ContactPhase::Watching);
        }
    }
}

#[test]
fn pushes_do_not_move_the_clock_of_the_motion() {
    for response in [config().response, FLOAT] {
        let mut joint = Joint::halfway(response);
        let left = joint.controller.trajectory_tick();
        for _ in 0..5 {
            joint.run(1, CONTACT);
            joint.run(1500, Ok(None));
            assert_eq!(joint.phase(), ContactPhase::Held);
            assert_eq!(joint.controller.trajectory_tick(), left, "{response:?}");
        }
        // Nor does a fault that ends the reaction.
        let mut joint = Joint::halfway(response);
        joint.run(1, CONTACT);
        joint.run(10, Err(Fault::Stale));
        assert_eq!(joint.phase(), ContactPhase::Held);
        assert_eq!(joint.controller.trajectory_tick(), left, "{response:?}");
    }
    // A stop leads its motion by 1/λ.
    let mut joint = Joint::halfway(ContactResponse::Stop);
    let left = joint.controller.trajectory_tick();
    joint.run(100, CONTACT);
    assert_eq!(joint.controller.trajectory_tick(), left + 40);
}
