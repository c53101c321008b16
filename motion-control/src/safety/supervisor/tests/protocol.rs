//! What holds of ticks that lack a half, of a reset, and of the encoders' steps.

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
    assert_eq!(
        brakes,
        [true, true, false, false, false, false, false, false]
    );
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

#[test]
fn an_encoders_step_is_no_jump() {
    let mut limits = LIMITS;
    limits.speed = [0.01; 2];
    let mut supervisor = Supervisor::new(SupervisorConfig {
        limits,
        resolution: 0.01,
        ..CONFIG
    });
    good(&mut supervisor, [0.0; 2]);
    assert_eq!(
        supervisor.accept_measurement(Ok(&[0.01, -0.01])),
        Mode::Full
    );
}
