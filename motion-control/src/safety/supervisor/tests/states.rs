//! The table of states against what random events have.

use std::collections::BTreeSet;

use super::*;
use crate::safety::StopCategory;

/// The numbers of one event after the other (Marsaglia, xorshift, 2003).
struct Events(u64);

impl Events {
    fn below(&mut self, n: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % n
    }
}

fn name(state: State) -> String {
    let text = format!("{state:?}");
    let end = text.find(|c: char| !c.is_alphanumeric());
    text[..end.unwrap_or(text.len())].to_owned()
}

/// The modes of the states and the transitions of the table, each as a pair.
fn table() -> [BTreeSet<[String; 2]>; 2] {
    let rows = include_str!("../../supervisor.rs").lines();
    let rows: Vec<_> = rows.filter_map(|row| row.strip_prefix("//! | `")).collect();
    let words = |cell: &str| -> Vec<String> {
        let quoted = cell.split('`').skip(1).step_by(2);
        quoted
            .filter(|word| word.starts_with(char::is_uppercase))
            .map(str::to_owned)
            .collect()
    };
    let pairs = |cell: usize| {
        let row = |row: &&str| {
            let (from, rest) = row.split_once('`')?;
            let cell = words(rest.split('|').nth(cell)?);
            Some(cell.into_iter().map(|to| [from.to_owned(), to]).collect())
        };
        let found = rows.iter().filter_map(row);
        found.flat_map(|pairs: Vec<_>| pairs).collect()
    };
    [pairs(1), pairs(2)]
}

fn event(supervisor: &mut Supervisor<f32, 2>, which: u64) {
    match which {
        0..=5 => drop(supervisor.accept_measurement(Ok(&[0.0; 2]))),
        6 | 7 => drop(supervisor.accept_measurement(Err(Fault::Stale))),
        8..=13 => drop(supervisor.gate(&[1.0; 2], &[0.0; 2])),
        14 => drop(supervisor.gate(&[f32::NAN; 2], &[0.0; 2])),
        15 => drop(supervisor.check_speed(&[9.0; 2])),
        16 => supervisor.report(Fault::Overrun),
        17 => supervisor.stop(Fault::External),
        18 => supervisor.stop_by(Fault::External, StopCategory::ControlledOff),
        19..=21 => supervisor.stop_by(Fault::External, StopCategory::ControlledHold),
        22 => supervisor.stop_by(Fault::External, StopCategory::TorqueOff),
        23 => {
            let damping = [1.0; 2];
            supervisor.stop_by(Fault::External, StopCategory::DampedLowering { damping });
        }
        _ if supervisor.stands() => supervisor.release(),
        _ if supervisor.mode() == Mode::Stopped => supervisor.reset(),
        _ => {}
    }
}

#[test]
fn every_transition_of_the_table_occurs_and_no_other_one() {
    let [modes, transitions] = table();
    let (mut found_modes, mut found) = (BTreeSet::new(), BTreeSet::new());
    let mut events = Events(0x9E37_79B9_7F4A_7C15);
    let useless = SupervisorConfig {
        limits: SafetyLimits {
            torque: [f32::NAN; 2],
            ..LIMITS
        },
        ..CONFIG
    };
    for run in 0..3000 {
        let mut supervisor = match run % 3 {
            0 => riding(2),
            1 => supervisor().with_stop(StopCategory::ControlledHold),
            _ => Supervisor::new(useless),
        };
        for _ in 0..100 {
            let before = supervisor.state;
            event(&mut supervisor, events.below(26));
            let [before, after] = [before, supervisor.state].map(name);
            found_modes.insert([after.clone(), format!("{:?}", supervisor.mode())]);
            if before != after {
                found.insert([before, after]);
            }
        }
    }
    assert_eq!(found, transitions);
    assert_eq!(found_modes, modes);
}

// An arm with useless limits stays stopped.
#[test]
fn a_reset_restores_the_full_law() {
    let required = Required {
        reason: Fault::External,
        again: false,
    };
    let stopping = State::Stopping {
        required,
        ending: Ending::Off,
        ticks: 1,
    };
    let stopped = State::Stopped { lowers: true };
    let standing = State::Standing(required);
    for state in [
        State::Full,
        State::Held,
        State::Torqueless,
        stopping,
        standing,
        stopped,
    ] {
        let mut supervisor = supervisor();
        supervisor.state = state;
        supervisor.reset();
        assert_eq!(supervisor.state, State::Full, "after {state:?}");
    }
    let unusable = State::Unusable(Fault::Limits { joint: 1 });
    let mut supervisor = supervisor();
    supervisor.state = unusable;
    supervisor.reset();
    assert_eq!(supervisor.state, unusable);
}
