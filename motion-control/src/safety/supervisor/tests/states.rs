//! The table of the module against all states, and what a reset leads to.

use std::collections::BTreeSet;

use super::*;

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
        quoted.filter(|word| word.starts_with(char::is_uppercase)).map(str::to_owned).collect()
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

#[test]
fn every_transition_of_the_table_occurs_and_no_other_one() {
    let found = transitions::FOUND.as_ref().unwrap();
    let mode = |state: State| [name(state), format!("{:?}", state.mode())];
    let states = found.states.iter().map(|(one, _)| one.state);
    let links = found.links.values().map(|link| link.map(name));
    let [modes, transitions] = table();
    assert_eq!(states.map(mode).collect::<BTreeSet<_>>(), modes);
    assert_eq!(links.collect::<BTreeSet<_>>(), transitions);
}

// An arm with useless limits stays stopped.
#[test]
fn a_reset_restores_the_full_law() {
    let required = StopRequest { reason: Fault::External, again: false };
    let stopping = State::Stopping { required, ending: Ending::Off, ticks: 1 };
    let stopped = State::Stopped { lowers: true };
    let standing = State::Standing(required);
    let (full, held, torqueless) = (State::Full, State::Held, State::Torqueless);
    let unusable = State::Unusable(Fault::Limits { joint: 1 });
    for state in [full, held, torqueless, stopping, standing, stopped, unusable] {
        let mut supervisor = supervisor();
        supervisor.state = state;
        supervisor.reset();
        let after = if state == unusable { unusable } else { full };
        assert_eq!(supervisor.state, after, "after {state:?}");
    }
}
