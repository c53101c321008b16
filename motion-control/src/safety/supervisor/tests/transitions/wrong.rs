//! Supervisors with one wrong transition each.

use super::*;

const REQUIRED: StopRequest = StopRequest { reason: REASON, again: false };

/// A cell, and the state to which it leads by mistake.
const STATES: [(Cell, State); 12] = [
    (("full", "fault: held"), State::Full),
    (("full", "fast: held"), State::Full),
    (("held", "fault: held"), State::Full),
    (("held", "fault: lasting"), State::Held),
    (("held", "no torque: held"), State::Torqueless),
    (("no torque", "good"), State::Full),
    (("to stand, over", "bad: bridged"), OFF),
    (("to lower, over", "good"), OFF),
    (("stand", "good"), State::Full),
    (("stand", "`stop_by` 0"), State::Standing(REQUIRED)),
    (("off", "good"), State::Full),
    (("unusable", "`reset`"), State::Full),
];
const OFF: State = State::Stopped { lowers: false };

/// A supervisor's mistake in any state, and the cell in which it is found.
type Mistake = (Cell, fn(&One, Input, &mut One));
const MISTAKES: [Mistake; 8] = [
    // Faults are never forgotten, or a tick early, or the first is not counted.
    (("full", "bad: bridged"), |before, input, after| {
        if input == Torque {
            after.faults = before.faults;
        }
    }),
    (("full", "fault: lasting"), |_, input, after| {
        if input == Torque && after.quiet == 1 {
            after.faults = 0;
        }
    }),
    (("held", "fault: lasting"), |before, _, after| {
        if before.faults == 0 {
            after.faults = 0;
        }
    }),
    // A deceleration is a tick short, or begins again.
    (("to stand", "late: bridged"), |_, input, after| {
        if let (Good, State::Stopping { ticks, .. }) = (input, &mut after.state) {
            *ticks = ticks.saturating_sub(1);
        }
    }),
    (("to off, over", "fault: held"), |_, input, after| {
        if let (StopBy(1), State::Stopping { ticks, .. }) = (input, &mut after.state) {
            *ticks = after.hold_ticks;
        }
    }),
    // A report is lost.
    (("start", "late: bridged"), |_, input, after| {
        after.open &= input != Report;
    }),
    // The brake opens before the torque is there, or is not set.
    (("full", "torque"), |_, input, after| {
        after.braked &= input != Limited;
    }),
    (("off", "`reset`"), |_, _, after| after.braked = false),
];

fn is_found(cell: Cell, spoil: &dyn Fn(Cell, &One, Input, &mut One)) {
    let message = enumerate(spoil).map(|_| ()).unwrap_err();
    let (state, class) = cell;
    assert!(message.starts_with(&format!("{state}, {class}: ")), "{cell:?} {message}");
}

#[test]
fn each_of_twenty_wrong_transitions_is_found() {
    for (wrong, state) in STATES {
        is_found(wrong, &|cell, _, _, after| {
            if cell == wrong {
                after.state = state;
            }
        });
    }
    for (cell, mistake) in MISTAKES {
        is_found(cell, &|_, before, input, after| mistake(before, input, after));
    }
}
