//! The reference of the scene `jog`.

use dynamics_core::spatial::Motion;
use dynamics_core::state::State;
use firmware_demo::scene::Scene;
use firmware_demo::scenes::jog::{Jog, LIMITS, RANGE, stick};
use firmware_demo::scenes::ur5e::PickAndPlace;
use motion_control::reference::Reference;

/// The properties of a reference: whether it stays within the limits of the scene; the ticks in which the
/// last joint is at the end of its range; the least sines of elbow and wrist, which are zero in
/// singular postures.
fn seen(reference: &impl Reference<f32, 6>) -> (bool, usize, [f32; 2]) {
    let (mut within, mut ended, mut least) = (true, 0, [f32::MAX; 2]);
    for State { q, qd, qdd } in (0..=reference.ticks()).map(|tick| reference.at(tick)) {
        within &= (0..6).all(|j| q[j].abs() <= RANGE[j] && qd[j].abs() <= LIMITS.velocity);
        within &= qdd.iter().all(|qdd| qdd.abs() <= LIMITS.acceleration);
        ended += usize::from(q[5].abs() > RANGE[5] - 1e-3);
        least = [least[0].min(q[2].sin().abs()), least[1].min(q[4].sin().abs())];
    }
    (within, ended, least)
}

#[test]
fn it_comes_to_a_limit_and_to_two_singular_postures() {
    let (within, ended, [elbow, wrist]) = seen(&Jog::reference().unwrap());
    assert!(within && ended > 500 && elbow < 1e-2 && wrist < 1e-2, "{ended} {elbow} {wrist}");
    let (_, ended, [elbow, wrist]) = seen(&PickAndPlace::reference().unwrap());
    assert!(ended == 0 && elbow > 0.5 && wrist > 0.5);
    assert!(!seen(&State::at([2.0; 6])).0);
}

#[test]
fn it_rests_when_the_stick_is_let_go_and_begins_again_as_it_began() {
    let jogged = Jog::reference().unwrap();
    let end = jogged.ticks();
    let states: Vec<_> = (0..=end).map(|tick| jogged.at(tick)).collect();
    for tick in [0, 299, end] {
        assert_eq!((stick(tick), states[tick as usize].qd), (Motion::ZERO, [0.0; 6]), "{tick}");
    }
    assert_ne!(stick(400), Motion::ZERO);
    assert_ne!(states[400], states[0]);
    for tick in 0..=end {
        assert_eq!(
            (jogged.at(tick), jogged.at(tick)),
            (states[tick as usize], states[tick as usize])
        );
    }
}
