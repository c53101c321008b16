//! The parts of a return, of joints at either side of ranges that are not centred.

use super::*;
use crate::tests::{controlled, safety_limits};

const LOWER: [f64; 3] = [-1.0, 0.5, -1.0];
const UPPER: [f64; 3] = [0.5, 2.0, 1.0];
/// Beyond the upper bound, beyond the lower one, and at a bound.
const FROM: [f64; 3] = [0.75, 0.25, 1.0];
const LIMIT: f64 = 40.0;

type Arm = MotionController<f64, 3, CurrentTick>;

fn arm(q: [f64; 3]) -> Arm {
    let limits = safety_limits([LIMIT; 3], [LIMIT; 3], [3.0; 3], LOWER, UPPER);
    let numbers = [250.0, 25.0, 0.1];
    let mut arm = Arm::new(controlled(limits, TICK, [2, 100, 50], numbers)).on_brake();
    arm.tick(Ok(&q), &State::at(q), |_, _| [0.0; 3]);
    arm
}

fn back_off_with(margin: f64) -> BackOff<f64, 3> {
    let config = BackOffConfig { margin, ..SLOW };
    BackOff::start(&mut arm(FROM), &config).expect("measured")
}

fn estimate(q: [f64; 3]) -> Estimate<f64, 3> {
    Estimate { q, qd: [0.0; 3] }
}

#[test]
fn each_joint_ends_within_its_bound_or_stays() {
    let back_off = back_off_with(0.125);
    assert_eq!(back_off.goal, [0.375, 0.625, 1.0]);
    assert_eq!(back_off.outward, [1.0, -1.0, 0.0]);
    // No further than the middle of its range.
    assert_eq!(back_off_with(9.0).goal, [-0.25, 1.25, 1.0]);
    // The other bound of a range is within it, too.
    let mut at_bound = arm([0.5, 0.5, -1.0]);
    let back_off = BackOff::start(&mut at_bound, &SLOW).expect("measured");
    assert_eq!(back_off.outward, [0.0; 3]);
}

#[test]
fn the_reference_never_leads_a_joint_outwards() {
    let mut back_off = back_off_with(0.125);
    assert_eq!(back_off.path.at(back_off.tick).q, FROM);
    let reference = |back_off: &BackOff<f64, 3>, q| back_off.reference(&estimate(q)).q;
    // Joints that are where the path begins, or further out.
    assert_eq!(reference(&back_off, FROM), FROM);
    assert_eq!(reference(&back_off, [0.8, 0.2, 1.0]), FROM);
    // Ahead of the path, and ahead of its end.
    assert_eq!(reference(&back_off, [0.6, 0.4, 0.9]), [0.6, 0.4, 1.0]);
    assert_eq!(reference(&back_off, [0.2, 0.9, 0.9]), [0.375, 0.625, 1.0]);
    // At the end of the path.
    back_off.tick = back_off.path.ticks();
    let end = reference(&back_off, [0.7, 0.3, 1.0]);
    assert!((0..3).all(|joint| (end[joint] - back_off.goal[joint]).abs() < 1e-12));
}

#[test]
fn positions_at_a_bound_are_inside_of_it() {
    let mut back_off = back_off_with(0.125);
    back_off.bounds = [[-1.0, 0.5], [0.5, 2.0], [-1.0, 1.0]];
    for q in [LOWER, UPPER] {
        assert!(back_off.inside(&q));
        assert_eq!(back_off.further_out(&q), None);
    }
    for joint in 0..3 {
        for (mut q, step) in [(LOWER, -0.01), (UPPER, 0.01)] {
            q[joint] += step;
            assert!(!back_off.inside(&q), "{q:?}");
            assert_eq!(back_off.further_out(&q), Some(joint));
        }
    }
}

#[test]
fn the_bounds_follow_the_joints_inwards_only() {
    let mut back_off = back_off_with(0.125);
    let step = 0.03125;
    back_off.bounds = [[-1.0, 0.75], [0.25, 2.0], [-1.0, 1.0]];
    for (q, bounds) in [
        // Inwards, outwards, and within the configured bounds.
        ([0.625, 0.375, 0.0], [[-1.0, 0.65625], [0.34375, 2.0]]),
        ([0.71875, 0.28125, 0.0], [[-1.0, 0.65625], [0.34375, 2.0]]),
        ([0.0, 1.0, 0.0], [[-1.0, 0.5], [0.5, 2.0]]),
    ] {
        back_off.follow(&q, &[step; 3]);
        assert_eq!(back_off.bounds[..2], bounds);
        assert_eq!(back_off.bounds[2], [-1.0, 1.0]);
    }
}

/// The torques of a law after the limits, of joints that have moved at these speeds to where they
/// are.
fn limited(at: [f64; 3], speeds: [f64; 3], mut tau: [f64; 3]) -> [f64; 3] {
    let mut back_off = back_off_with(0.125);
    let q = |ticks: f64| core::array::from_fn(|joint| at[joint] - TICK * ticks * speeds[joint]);
    back_off.speeds.reset(&q(1000.0));
    for tick in (0..1000).rev() {
        back_off.speeds.follow(&q(f64::from(tick)));
    }
    back_off.limit_outward(&mut tau, &[LIMIT; 3]);
    tau
}

#[test]
fn an_outward_torque_brakes_no_more_than_the_speed_needs() {
    let (inwards, rest, all) = ([-0.25, 0.25, 0.0], [0.0; 3], [30.0, -30.0, 30.0]);
    for (at, speeds, tau, expected) in [
        // Half of the greatest speed inwards, and outwards.
        (FROM, inwards, [30.0, -30.0, 30.0], [20.0, -20.0, 30.0]),
        (FROM, inwards, [10.0, -10.0, 30.0], [10.0, -10.0, 30.0]),
        (FROM, [0.25, -0.25, 0.0], [30.0, -30.0, 0.0], rest),
        (FROM, [-9.0, 9.0, 0.0], [99.0, -99.0, 0.0], [40.0, -40.0, 0.0]),
        // Torques that point inwards are as they were, and so are all of a joint that is back.
        (FROM, rest, [-30.0, 30.0, 0.0], [-30.0, 30.0, 0.0]),
        ([0.25, 0.75, 2.0], rest, all, all),
        ([0.5, 0.5, 1.0], rest, all, all),
    ] {
        let got = limited(at, speeds, tau);
        let near = (0..3).all(|joint| (got[joint] - expected[joint]).abs() < 1e-6);
        assert!(near, "{got:?} {expected:?}");
    }
}

/// Leads an arm that follows exactly back; the ticks of its path, those with the brake open, and
/// the reason of its hold.
fn lead_back(mut arm: Arm, q: [f64; 3]) -> (u32, u32, Option<Fault>) {
    let clock = arm.trajectory_tick();
    let mut back_off = BackOff::start(&mut arm, &SLOW).expect("measured");
    let planned = back_off.path.ticks();
    let (mut q, mut open) = (q, 0);
    while !back_off.is_done() {
        let command = back_off.tick(&mut arm, Ok(&q), |_, _| [0.0; 3]);
        assert_eq!(command.status.fault, None);
        open += u32::from(!command.brake);
        q = arm.reference().q;
        assert_eq!(arm.trajectory_tick(), clock);
        assert!(open < 5000);
    }
    let command = arm.tick(Ok(&q), &State::at(q), |_, _| [0.0; 3]);
    (planned, open, command.status.fault)
}

#[test]
fn a_return_ends_with_its_path_and_names_its_joint() {
    for (q, joint) in [(FROM, 0), ([0.0, 0.25, 0.0], 1), ([0.0, 1.0, 1.25], 2)] {
        let (planned, open, fault) = lead_back(arm(q), q);
        assert_eq!(open, planned + 1);
        assert_eq!(fault, Some(Fault::Position { joint }));
    }
    // One that was within its bounds names the first.
    let within = [0.0, 1.0, 0.0];
    let (.., fault) = lead_back(arm(within), within);
    assert_eq!(fault, Some(Fault::Position { joint: 0 }));
}

#[test]
fn a_joint_that_stays_outside_is_not_back() {
    let mut arm = arm(FROM);
    let mut back_off = BackOff::start(&mut arm, &SLOW).expect("measured");
    for _ in 0..back_off.path.ticks() + 100 {
        back_off.tick(&mut arm, Ok(&FROM), |_, _| [0.0; 3]);
    }
    assert!(!back_off.is_done());
}

#[test]
fn the_speeds_begin_at_rest_and_end_with_a_measurement() {
    let damping = [1.0; 3];
    let mut arm = arm(FROM).with_stop(StopCategory::DampedLowering { damping });
    // It sinks.
    for tick in 0..50 {
        let q = FROM.map(|q| q - 5e-4 * f64::from(tick));
        arm.tick(Ok(&q), &State::at(q), |_, _| [0.0; 3]);
    }
    assert!(arm.estimate().qd[0] < -0.4);
    let mut back_off = BackOff::start(&mut arm, &SLOW).expect("measured");
    let rest = estimate(arm.estimate().q);
    assert_eq!(*back_off.speeds.estimate(), rest);
    for tick in 1..20 {
        let gone = 5e-4 * f64::from(tick);
        let q = [rest.q[0] - gone, rest.q[1] + gone, rest.q[2]];
        back_off.tick(&mut arm, Ok(&q), |_, _| [0.0; 3]);
    }
    assert!(back_off.speeds.estimate().qd[0] < -0.2);
    back_off.tick(&mut arm, Err(Fault::Stale), |_, _| [0.0; 3]);
    assert_eq!(back_off.speeds.estimate().qd, [0.0; 3]);
}
