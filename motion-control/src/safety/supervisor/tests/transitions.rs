//! All states of supervisors with small numbers of ticks, in each of which everything happens that
//! can, against the table of transitions in the guide, of which `transitions/table.md` is the copy
//! that this crate carries.

use std::collections::{HashMap, HashSet};
use std::mem::{Discriminant, discriminant};
use std::sync::LazyLock;

use super::*;
use crate::safety::StopCategory;
use crate::tests::{safety_limits, supervised};
use expected::Expected;

mod expected;
mod wrong;

pub type One = Supervisor<f32, 1>;
/// The name of a state and that of a class of inputs.
type Cell = (&'static str, &'static str);
/// The next state of each cell.
type Table = HashMap<Cell, &'static str>;

/// The categories 0, 1 and 2, and the lowering.
const CATEGORIES: [StopCategory<f32, 1>; 4] = [
    StopCategory::TorqueOff,
    StopCategory::ControlledOff,
    StopCategory::ControlledHold,
    StopCategory::DampedLowering { damping: [1.0] },
];
/// `ride_through_ticks`, `hold_ticks` and `reentry_ticks`; without a ride-through, a first fault is
/// held or lasting.
const TICKS: [[u32; 3]; 3] = [[2, 3, 1], [0, 1, 2], [1, 1, 0]];
/// Faults that no input has: of the tick before, of a report, and the reason of a stop.
const BEFORE: Fault = Fault::Model;
const REPORTED: Fault = Fault::Overrun;
const REASON: Fault = Fault::Restarted;

/// The torque of the tick before, and the greatest one that its rate allows then, N·m.
const LAST: f32 = 1.0;
const WANTED: f32 = LAST + 4.0;

/// The faults of positions.
const BAD: [Fault; 4] = [
    Fault::Stale,
    Fault::NotFinite { joint: 0 },
    Fault::Position { joint: 0 },
    Fault::Jump { joint: 0 },
];

#[derive(Clone, Copy, Debug, PartialEq)]
enum Input {
    Good,
    Bad(usize),
    Fast,
    Torque,
    Limited,
    NoTorque,
    Report,
    Missed,
    Stop,
    StopBy(usize),
    AsSet,
    Reset,
}
use Input::*;

#[rustfmt::skip]
const INPUTS: [Input; 18] = [
    Good, Bad(0), Bad(1), Bad(2), Bad(3), Fast, Torque, Limited, NoTorque,
    Report, Missed, Stop, StopBy(0), StopBy(1), StopBy(2), StopBy(3), AsSet, Reset,
];

fn step(before: &One, input: Input) -> (One, Option<Command<f32, 1>>) {
    let mut one = *before;
    let reach = one.plausible_step[0] * one.ticks_since_good;
    let mut command = None;
    match input {
        // As far as a joint can move, or within the bounds.
        Good => one.accept_positions(&[(0.99 * reach).min(0.99)]),
        Bad(0) => one.accept_fault(BAD[0]),
        Bad(which) => one.accept_positions(&[[f32::NAN, 1.01, 1.01 * reach][which - 1]]),
        Fast => drop(one.check_speed(&[2.01])),
        Torque => command = Some(one.gate(&[WANTED], &[0.0])),
        Limited => command = Some(one.gate(&[1.01 * WANTED], &[0.0])),
        NoTorque => command = Some(one.gate(&[f32::NAN], &[0.0])),
        Report => one.react(REPORTED),
        Missed => one.missed(2),
        Stop => one.react(Fault::Brake),
        StopBy(category) => one.stop_by(Fault::External, CATEGORIES[category]),
        AsSet => one.react(Fault::External),
        // The controller releases an arm that stands.
        Reset if one.stands() => one.release(),
        Reset => one.reset(),
    }
    (one, command)
}

/// The same state with the numbers that the inputs are relative to: positions, torques, and which
/// faults there were choose no transition.
fn canonical(mut one: One) -> One {
    (one.last_good, one.torque) = ([0.0], [LAST]);
    if one.known {
        one.ticks_since_good = 1.0;
    }
    one.fault = Some(BEFORE);
    one.reported = one.reported.map(|_| REPORTED);
    if let Some((required, _)) = one.state.required() {
        required.reason = REASON;
    }
    one
}

/// The cells of the guide's tables that can occur.
fn table() -> Table {
    let tables = include_str!("transitions/table.md").trim_end();
    let mut cells = Table::new();
    let is_table = |part: &&str| part.starts_with('|');
    for table in tables.split("\n\n").filter(is_table) {
        let words = |line: &'static str| line.trim_matches('|').split('|').map(str::trim);
        let mut lines = table.lines();
        let columns: Vec<_> = words(lines.next().unwrap()).collect();
        for line in lines.skip(1) {
            let row: Vec<_> = words(line).collect();
            assert_eq!(row.len(), columns.len(), "{line}");
            let entries = columns.iter().zip(&row).skip(1);
            let entries = entries.filter(|(_, to)| **to != "–");
            cells.extend(entries.map(|(&column, &to)| ((row[0], column), to)));
        }
    }
    cells
}

/// Every supervisor before its first input: with each category, in the full law, on its brake, and
/// with useless limits.
fn starts() -> Vec<(One, Expected)> {
    let mut starts = Vec::new();
    for (ticks, category) in TICKS.iter().flat_map(|&ticks| (0..4).map(move |c| (ticks, c))) {
        let [ride_through_ticks, hold_ticks, reentry_ticks] = ticks;
        let with = |torque| {
            let limits = safety_limits([torque], [4.0], [2.0], [-1.0], [1.0]);
            let one = Supervisor::new(supervised(
                limits,
                TICK,
                [ride_through_ticks, hold_ticks, reentry_ticks],
            ));
            // The same damping for all, so that a stop by another category does not change it.
            let one = one.with_stop(CATEGORIES[3]);
            one.with_stop(CATEGORIES[category])
        };
        let expected = Expected::new(ticks, category);
        starts.extend([
            (with(10.0), expected),
            (with(10.0).on_brake(), expected.on_brake()),
            (with(f32::NAN), expected.unusable()),
        ]);
    }
    starts
}

/// The findings in all states.
#[derive(Default)]
pub struct Transitions {
    pub states: Vec<(One, Expected)>,
    transitions: usize,
    cells: HashSet<Cell>,
    /// States of each kind that led to another kind.
    pub links: HashMap<[Discriminant<State>; 2], [State; 2]>,
}

/// Everything that can happen, in every state to which it leads; `spoil` can make a transition
/// wrong.
fn enumerate(spoil: &dyn Fn(Cell, &One, Input, &mut One)) -> Result<Transitions, String> {
    let table = table();
    let mut found = Transitions::default();
    let mut seen = HashMap::<Expected, Vec<One>>::new();
    let mut add = |states: &mut Vec<_>, one, expected| {
        let ones = seen.entry(expected).or_default();
        if !ones.contains(&one) {
            ones.push(one);
            states.push((one, expected));
        }
    };
    for (one, expected) in starts() {
        add(&mut found.states, canonical(one), expected);
    }
    let mut at = 0;
    while let Some(&(before, expected)) = found.states.get(at) {
        at += 1;
        assert!(at < 100_000, "the states do not end");
        for input in INPUTS.into_iter().filter(|&input| expected.allows(input)) {
            let (cell, wanted, expected) = expected.after(input, &table)?;
            let (mut after, command) = step(&before, input);
            spoil(cell, &before, input, &mut after);
            let shown = expected::shown(&after, command);
            if shown != wanted {
                let (state, class) = cell;
                let text = format!("{state}, {class}: {wanted:?}, but {shown:?} by {input:?}");
                return Err(text);
            }
            found.transitions += 1;
            found.cells.insert(cell);
            let link = [before.state, after.state];
            let kinds = link.each_ref().map(discriminant);
            if kinds[0] != kinds[1] {
                found.links.insert(kinds, link);
            }
            add(&mut found.states, canonical(after), expected);
        }
    }
    match table.keys().find(|cell| !found.cells.contains(*cell)) {
        Some(cell) => Err(format!("{cell:?} does not occur")),
        None => Ok(found),
    }
}

/// Enumerated once, for all tests.
pub static FOUND: LazyLock<Result<Transitions, String>> =
    LazyLock::new(|| enumerate(&|_, _, _, _| ()));

#[test]
fn every_transition_of_the_supervisor_is_in_the_guides_table() {
    let found = FOUND.as_ref().unwrap();
    let counts = [found.states.len(), found.transitions, found.cells.len()];
    println!("states, transitions and cells: {counts:?}");
}
