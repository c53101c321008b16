//! Claims about the configuration, about what ends a reaction, and about the reset.

use super::*;
use crate::limits::ConfigParameter;
use crate::limits::MotionLimits;
use crate::reference::Trajectory;
use crate::tests::{controlled, motion_limits, safety_limits, stop};

mod ends;
mod motion;
mod stops;

const TICK: f64 = 1e-3;
const SLOW: MotionLimits<f64> = motion_limits(0.5, 2.0);
const DISTANCE: f64 = 0.2;

fn config() -> ContactReactionConfig<f64> {
    ContactReactionConfig {
        response: ContactResponse::Retract { distance: DISTANCE, limits: SLOW },
        release_ticks: 20,
    }
}

#[test]
fn numbers_that_are_no_configuration_are_refused_by_name() {
    assert_eq!(config().check(), Ok(()));
    let refused = |response, release_ticks| {
        let config = ContactReactionConfig { response, release_ticks };
        crate::tests::refused(ContactReaction::<f64, 1>::try_new(config))
    };
    let retract = |distance, velocity, acceleration| ContactResponse::Retract {
        distance,
        limits: motion_limits(velocity, acceleration),
    };
    let float = |damping, speed| ContactResponse::Float { damping, speed };
    use ConfigParameter::*;
    assert_eq!(refused(ContactResponse::Stop, 0), Some(ReleaseTicks));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(refused(retract(bad, 1.0, 1.0), 1), Some(RetractDistance));
        assert_eq!(refused(retract(1.0, bad, 1.0), 1), Some(RetractLimit));
        assert_eq!(refused(float(bad, 1.0), 1), Some(FloatDamping));
        assert_eq!(refused(float(1.0, bad), 1), Some(FloatSpeed));
    }
    for bad in [0.0, -1.0, f64::NAN] {
        assert_eq!(refused(retract(1.0, 1.0, bad), 1), Some(RetractLimit));
    }
    for good in [ContactResponse::Stop, retract(1.0, 1.0, f64::INFINITY), float(1.0, 1.0)] {
        assert_eq!(refused(good, 1), None);
    }
}

/// A joint that follows its reference, with a contact in some ticks and a lost measurement in
/// others.
struct Joint {
    controller: MotionController<f64, 1>,
    reaction: ContactReaction<f64, 1>,
    motion: Trajectory<f64, 1, 2>,
    q: f64,
}

const CONTACT: Result<Option<DetectedContact<f64>>, Fault> =
    Ok(Some(DetectedContact { joint: 0, torque: 3.0 }));

impl Joint {
    fn new(response: ContactResponse<f64>) -> Self {
        Self::with_ticks(response, 30, 400)
    }

    fn with_ticks(response: ContactResponse<f64>, hold_ticks: u32, reentry_ticks: u32) -> Self {
        let config = ContactReactionConfig { response, ..config() };
        let controller = MotionController::try_new(controlled(
            safety_limits([10.0], [10.0], [3.0], [-2.0], [2.0]),
            TICK,
            [2, hold_ticks, reentry_ticks],
            [250.0, 25.0, 1.0],
        ));
        let points = [stop([0.0], 0), stop([1.0], 1000)];
        let motion = Trajectory::new(&points, TICK, &[motion_limits(3.0, 10.0)]);
        Self {
            controller: controller.expect("a good one"),
            reaction: ContactReaction::try_new(config).expect("a good one"),
            motion: motion.expect("a slow one"),
            q: 0.0,
        }
    }

    /// One that has followed its motion for half of it.
    fn halfway(response: ContactResponse<f64>) -> Self {
        let mut joint = Self::new(response);
        joint.run(500, Ok(None));
        joint
    }

    fn phase(&self) -> ContactPhase {
        self.reaction.phase()
    }

    fn reset(&mut self) -> Result<(), ResetError> {
        self.reaction.reset(&mut self.controller, &self.motion)
    }

    fn run(&mut self, ticks: u32, contact: Result<Option<DetectedContact<f64>>, Fault>) {
        for _ in 0..ticks {
            let measured = [self.q];
            let measured = contact.map(|_| &measured);
            let observed = self.controller.observe(measured);
            let tick = self.reaction.reference(observed, contact, &self.motion);
            self.q = tick.reference().q[0];
            tick.command(&[0.0]);
        }
    }
}

#[test]
fn a_second_contact_or_lasting_fault_holds_the_retraction() {
    let lost = Err(Fault::Stale);
    for (again, phase) in [
        (Ok(None), ContactPhase::Retracting),
        (CONTACT, ContactPhase::Held),
        (lost, ContactPhase::Held),
    ] {
        let mut joint = Joint::halfway(config().response);
        // The contact that began it does not end it.
        joint.run(10, CONTACT);
        assert_eq!(joint.phase(), ContactPhase::Retracting);
        joint.run(25, Ok(None));
        joint.run(4, again);
        assert_eq!(joint.phase(), phase, "{again:?}");
    }
}

// The arm goes on where it left its motion.
#[test]
fn a_reset_after_contactless_ticks_resumes_the_motion() {
    let mut joint = Joint::halfway(config().response);
    let left = joint.controller.trajectory_tick();
    joint.run(1, CONTACT);
    joint.run(2000, Ok(None));
    assert_eq!(joint.phase(), ContactPhase::Held);
    assert!((left..left + 60).contains(&joint.controller.trajectory_tick()));
    for unknown in [CONTACT, Err(Fault::Stale)] {
        joint.run(1, unknown);
        joint.run(19, Ok(None));
        assert_eq!(joint.reset(), Err(ResetError::Contact));
        joint.run(1, Ok(None));
        assert!(joint.reaction.released());
    }
    assert_eq!(joint.reset(), Ok(()));
    joint.run(1000, Ok(None));
    assert_eq!(joint.phase(), ContactPhase::Watching);
    assert!((joint.q - 1.0).abs() < 1e-9, "{}", joint.q);
    // A reset of the controller itself counts as well.
    joint.run(1, CONTACT);
    assert_eq!(joint.phase(), ContactPhase::Retracting);
    joint.run(25, Ok(None));
    joint.run(50, CONTACT);
    assert_eq!(joint.phase(), ContactPhase::Held);
    assert_eq!(joint.controller.reset(&joint.motion), Ok(()));
    joint.run(1, Ok(None));
    assert_eq!(joint.phase(), ContactPhase::Watching);
    // An arm that has no path yet stops.
    joint.run(1, CONTACT);
    assert_eq!(joint.phase(), ContactPhase::Held);
}

const FLOAT: ContactResponse<f64> = ContactResponse::Float { damping: 5.0, speed: 1.0 };

// This holds after a hold too.
#[test]
fn a_floating_arms_reference_is_its_estimate() {
    let mut joint = Joint::halfway(FLOAT);
    // The first tick after a hold is one of the hold.
    for first in [0, 1] {
        joint.run(first, CONTACT);
        for _ in 0..10 {
            joint.run(1, CONTACT);
            joint.q += 1e-3; // by a hand
            assert_eq!(joint.phase(), ContactPhase::Floating);
            let controller = &joint.controller;
            assert_eq!(controller.reference().q, controller.estimate().q);
        }
        joint.run(1000, Ok(None));
        assert_eq!(joint.phase(), ContactPhase::Held);
    }
}

#[test]
fn an_arm_floats_until_rest_or_a_lasting_fault() {
    let mut joint = Joint::halfway(FLOAT);
    joint.run(1, CONTACT);
    for _ in 0..40 {
        joint.run(1, Ok(None));
        joint.q += 1e-3;
    }
    assert_eq!(joint.phase(), ContactPhase::Floating);
    joint.run(2, Err(Fault::Stale));
    assert_eq!(joint.phase(), ContactPhase::Floating);
    joint.run(2, Err(Fault::Stale));
    assert_eq!(joint.phase(), ContactPhase::Held);
    // A stopped arm does not float again.
    joint.controller.stop(Fault::External);
    joint.run(5, CONTACT);
    assert_eq!(joint.phase(), ContactPhase::Held);
}

#[test]
fn an_arm_that_is_held_for_another_reason_stays_held() {
    let mut joint = Joint::halfway(FLOAT);
    let hold = StopCategory::ControlledHold;
    joint.controller.stop_by(Fault::External, hold);
    joint.run(50, CONTACT);
    assert_eq!(joint.controller.mode(), Mode::Hold);
    assert_eq!(joint.phase(), ContactPhase::Watching);
}
