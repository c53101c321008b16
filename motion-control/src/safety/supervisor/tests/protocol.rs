//! Properties of ticks that lack a half, of a reset, and of the encoders' steps.

use super::*;

#[test]
fn a_tick_without_a_measurement_is_stale() {
    let mut supervisor = supervisor();
    good(&mut supervisor, [1.0; 2]);
    supervisor.accept_measurement(Err(Fault::Stale));
    let status = supervisor.gate(&[1.0; 2], &[0.0; 2]).status;
    assert_eq!(
        (status.mode, status.fault),
        (Mode::Hold, Some(Fault::Stale))
    );
}

#[test]
fn a_tick_without_torque_faults_the_next() {
    let mut supervisor = riding(2);
    good(&mut supervisor, [3.0; 2]);
    let unfinished = Some(Fault::Unfinished);
    for (ticks, mode) in [(1, Mode::Full), (1, Mode::Full), (HOLD, Mode::Hold)] {
        for _ in 0..ticks {
            supervisor.accept_measurement(Ok(&[0.0; 2])); // and no torque
            let command = good(&mut supervisor, [3.0; 2]);
            assert_eq!(
                (command.status.mode, command.status.fault),
                (mode, unfinished)
            );
        }
    }
    supervisor.accept_measurement(Ok(&[0.0; 2]));
    let command = good(&mut supervisor, [3.0; 2]);
    assert_eq!((command.torque, command.brake), ([0.0; 2], true));
    assert_eq!(command.status.fault, unfinished);
}

#[test]
fn many_unfinished_ticks_in_a_row_stop_the_arm() {
    let mut supervisor = riding(2);
    good(&mut supervisor, [3.0; 2]);
    let modes = [(); 8].map(|()| supervisor.accept_measurement(Ok(&[0.0; 2])));
    let (full, held) = (Mode::Full, Mode::Hold);
    assert_eq!(modes[..3], [full; 3]);
    assert_eq!(modes[3..6], [held; 3]);
    assert_eq!(modes[6..], [Mode::Stopped; 2]);
}

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
