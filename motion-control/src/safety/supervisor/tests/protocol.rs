//! Properties of the brake after a reset.

use super::*;

#[test]
fn after_a_reset_the_brake_waits_for_the_torque() {
    let mut supervisor = supervisor();
    supervisor.reset();
    let mut brakes = [true; 8];
    for brake in &mut brakes {
        supervisor.accept_measurement(Ok(&[0.5; 2]));
        *brake = supervisor.gate(&[10.0, 0.0], &[0.0; 2]).brake;
    }
    assert_eq!(brakes, core::array::from_fn(|tick| tick < 2));
    // A rate that is slower than the ramp makes it wait longer.
    supervisor.rate_limit = [1.5; 2];
    supervisor.reset();
    for _ in 0..6 {
        supervisor.accept_measurement(Ok(&[0.5; 2]));
        assert!(supervisor.gate(&[10.0, 0.0], &[0.0; 2]).brake);
    }
    supervisor.accept_measurement(Ok(&[0.5; 2]));
    assert!(!supervisor.gate(&[10.0, 0.0], &[0.0; 2]).brake);
}
