//! A reset leaves nothing of what was before it.

use super::*;
use crate::safety::StopCategory;

fn good_ticks(supervisor: &mut Supervisor<f32, 2>, ticks: u32) {
    for _ in 0..ticks {
        good(supervisor, [3.0; 2]);
    }
}

type Use = fn(&mut Supervisor<f32, 2>);

/// An arm's possible past, with a good measurement first.
const USES: [(&str, Use); 8] = [
    ("good ticks", |one| good_ticks(one, 1)),
    ("a fault", |one| _ = bad(one, [3.0; 2])),
    ("a lasting fault", |one| {
        (0..20).for_each(|_| _ = bad(one, [3.0; 2]));
    }),
    ("a stop", |one| one.stop(Fault::Brake)),
    ("a controlled stop", |one| {
        one.stop_by(Fault::External, StopCategory::ControlledOff);
        good_ticks(one, 20);
    }),
    ("a report", |one| one.report(Fault::Overrun)),
    ("a tick without a command", |one| {
        one.accept_fault(Fault::Stale);
    }),
    ("a return", |one| {
        one.reset();
        good_ticks(one, 3);
    }),
];

#[test]
fn a_reset_forgets_all_that_was_before() {
    let mut fresh = riding(2);
    fresh.reset();
    assert_eq!(fresh.torque, [0.0; 2]);
    for (name, of) in USES {
        let mut after = riding(2);
        good_ticks(&mut after, 1);
        of(&mut after);
        after.reset();
        // The reason is that of the last tick until there is another, and the last position is
        // compared with nothing.
        (after.fault, after.last_good) = (fresh.fault, fresh.last_good);
        // The rate of a stopped arm is limited from the torque that its drives have.
        if name.contains("stop") || name.contains("lasting") {
            after.torque = fresh.torque;
        }
        assert_eq!(after, fresh, "{name}");
    }
}
