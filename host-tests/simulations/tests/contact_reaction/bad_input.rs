//! Bad input: torques stay within their limits, and ten seconds of good ticks undo whatever it led
//! to.

use motion_control::{ContactPhase, ContactResponse, Mode};

use crate::contact_reaction::cell::{Cell, STEP, Spoiled};
use crate::contact_reaction::plant::Setup;
use crate::contact_reaction::{OFF, RESPONSES};

/// The result of a second of bad input.
#[derive(Debug)]
struct Outcome {
    /// Whether a contact was found, or a fault that holds the arm.
    noticed: bool,
    /// The largest torque as a share of its limit; infinite if one was not finite.
    torque: f64,
    recovers: bool,
}

/// A second of bad input during the motion, then ten of `after`, then a reset.
fn run(response: ContactResponse<f64>, spoiled: Spoiled, after: Spoiled) -> Outcome {
    let mut cell = Cell::new(&Setup {
        off: OFF[0],
        response: Some(response),
        ..Setup::FREE
    });
    let (mut noticed, mut torque) = (false, 0.0_f64);
    for tick in 0..11_800 {
        let bad = (800..1800).contains(&tick);
        let command = cell.tick(match tick {
            0..800 => Spoiled::Nothing,
            800..1800 => spoiled,
            _ => after,
        });
        torque = torque.max(Cell::share(&command.torque, &cell.limits.torque));
        noticed |= bad & (cell.reaction.phase() != ContactPhase::Watching);
        noticed |= bad & (command.status.mode != Mode::Full);
    }
    Outcome {
        noticed,
        torque,
        recovers: cell.recovers(after),
    }
}

fn undone_by_ten_good_seconds(spoiled: Spoiled, noticed: bool) {
    for response in RESPONSES {
        let outcome = run(response, spoiled, Spoiled::Nothing);
        assert_eq!(outcome.noticed, noticed, "{spoiled:?} {response:?}");
        assert!(
            outcome.torque <= 1.0,
            "{spoiled:?} {response:?} {outcome:?}"
        );
        assert!(outcome.recovers, "{spoiled:?} {response:?}");
    }
}

// The noise is ten times the step of the encoders.
#[test]
fn ten_good_seconds_undo_encoder_noise() {
    undone_by_ten_good_seconds(Spoiled::Noise(5.0 * STEP), true);
}

#[test]
fn ten_good_seconds_undo_a_stuck_encoder() {
    undone_by_ten_good_seconds(Spoiled::Stuck(0), true);
    undone_by_ten_good_seconds(Spoiled::Stuck(1), true);
}

#[test]
fn ten_good_seconds_undo_nan_torques_and_bounds() {
    undone_by_ten_good_seconds(Spoiled::Torque(1), true);
    // The detector refuses these, and no reaction begins.
    undone_by_ten_good_seconds(Spoiled::Detector, false);
}

// The friction has the wrong sign, and the load is beyond the limits.
#[test]
fn ten_good_seconds_undo_wrong_friction_and_load() {
    undone_by_ten_good_seconds(Spoiled::Friction, true);
    undone_by_ten_good_seconds(Spoiled::Load(400.0), true);
}

#[test]
fn lasting_bad_input_prevents_recovery() {
    for spoiled in [
        Spoiled::Noise(5.0 * STEP),
        Spoiled::Torque(1),
        Spoiled::Friction,
    ] {
        let outcome = run(ContactResponse::Stop, spoiled, spoiled);
        assert!(
            outcome.noticed && !outcome.recovers,
            "{spoiled:?} {outcome:?}"
        );
    }
    // Torques that no supervisor has limited fail the check of the torques.
    let limits = &Cell::new(&Setup::FREE).limits.torque;
    for bad in [f64::NAN, f64::INFINITY, 28.1] {
        assert!(Cell::share(&[0.0, 0.0, 0.0, bad, 0.0, 0.0], limits) > 1.0);
    }
    assert!(Cell::share(&[150.0, 0.0, 0.0, 28.0, 0.0, 0.0], limits) <= 1.0);
}
