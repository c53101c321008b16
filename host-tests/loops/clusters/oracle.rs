//! Pinocchio's results for robots with loops (`host-tests/oracle/clusters.py`), by core and engine,
//! in f64 and f32; and that the engine gives what the core gives.

use firmware_demo::robots::{AnkleLeg, FourBarLeg};
use loop_tests::clusters::recorded::errors;
use loop_tests::clusters::{DeltaRobot, Geared, Wrist};

#[test]
fn pinocchio_agrees_on_the_four_bar_leg() {
    errors::<FourBarLeg, 5, 5, 3>().check();
}

#[test]
fn pinocchio_agrees_on_the_parallel_ankle() {
    errors::<AnkleLeg, 9, 9, 3>().check();
}

#[test]
fn pinocchio_agrees_on_the_delta_robot() {
    errors::<DeltaRobot, 12, 12, 3>().check();
}

host_tests::in_full! {
    #[test]
    fn pinocchio_agrees_on_further_robots() {
        errors::<loop_tests::clusters::FiveBarLeg, 5, 5, 3>().check();
        errors::<firmware_demo::robots::StewartPlatform, 24, 24, 6>().check();
    }
}

#[test]
fn pinocchio_agrees_on_the_arm_with_a_differential() {
    errors::<Wrist, 6, 6, 6>().check();
}

#[test]
fn pinocchio_agrees_on_the_arm_with_a_belt_and_gears() {
    errors::<Geared, 7, 7, 4>().check();
}
