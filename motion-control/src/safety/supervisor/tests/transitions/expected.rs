//! The expected behaviour of a supervisor: the table chooses its state, and its ticks and faults
//! are counted here.

use std::hash::{Hash, Hasher};

use super::*;

/// The visible result of a supervisor after an input: its state, its fault, the authority of the
/// full law, whether it knows and has accepted positions and was stopped again during a stop, and
/// its command with the brake.
pub type Observation =
    (&'static str, Option<Fault>, f32, [bool; 3], Option<(Status, bool, [f32; 1])>);
/// A class of inputs, and the fault after one.
type Outcome = (&'static str, Option<Fault>);

const BAD_TICK: [&str; 3] = ["bad: bridged", "fault: held", "fault: lasting"];
const LATE_TICK: [&str; 3] = ["late: bridged", BAD_TICK[1], BAD_TICK[2]];
const FAST: [&str; 3] = ["", "fast: held", "fast: lasting"];
const NO_TORQUE: [&str; 3] = ["no torque: bridged", "no torque: held", "no torque: lasting"];
const STOP_BY: [&str; 4] = ["`stop_by` 0", "`stop_by` 1", "`stop_by` 2", "`stop_by` lowering"];

pub(super) fn shown(one: &One, command: Option<Command<f32, 1>>) -> Observation {
    let mut state = one.state;
    let name = match state {
        State::Full if !one.known => "start",
        State::Full => "full",
        State::Held => "held",
        State::Torqueless => "no torque",
        State::Stopping { ending, .. } => ["to off", "to stand", "to lower"][ending as usize],
        State::Standing(_) => "stand",
        State::Stopped { lowers } => ["off", "lower"][usize::from(lowers)],
        State::Unusable(_) => "unusable",
    };
    let again = state.required().is_some_and(|(required, _)| required.again);
    let flags = [one.known, one.accepted, again];
    let command = command.map(|command| (command.status, command.brake, command.torque));
    (name, one.fault, one.authority(), flags, command)
}

/// A state of the table with its counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Expected {
    /// As configured.
    ticks: [u32; 3],
    category: usize,
    state: &'static str,
    /// Ticks of a deceleration.
    left: u32,
    /// Ticks with a fault, ticks without one, and ticks of the return or of a stop without a fault.
    faults: u32,
    quiet: u32,
    ramp: u32,
    known: bool,
    accepted: bool,
    stopped_again: bool,
    /// Positions were measured, and a torque is to follow.
    begun: bool,
    /// The next tick is late, and why.
    late: Option<Fault>,
    faulted: bool,
    /// The tick is not counted as a good one.
    spoilt: bool,
    braked: bool,
}

// Not of every field, which would take most of the time.
impl Hash for Expected {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        let flags = [self.known, self.begun, self.late.is_some(), self.faulted, self.braked];
        let counts = [self.left, self.faults, self.quiet, self.ramp, self.category as u32];
        let counts = counts.into_iter().chain(flags.map(u32::from));
        let state = self.state.len() as u64;
        hasher.write_u64(counts.fold(state, |all, count| 8 * all + u64::from(count)));
    }
}

impl Expected {
    pub(super) fn new(ticks: [u32; 3], category: usize) -> Self {
        Self { ticks, category, state: "start", quiet: ticks[2], ramp: ticks[2], ..Self::default() }
    }

    pub(super) fn on_brake(mut self) -> Self {
        (self.state, self.ramp) = (self.stopped(), 0);
        self
    }

    pub(super) fn unusable(mut self) -> Self {
        self.state = "unusable";
        self
    }

    fn stopped(&self) -> &'static str {
        ["off", "off", "off", "lower"][self.category]
    }

    fn mode(&self) -> Mode {
        match self.state {
            "start" | "full" => Mode::Full,
            "off" | "lower" | "unusable" => Mode::Stopped,
            _ => Mode::Hold,
        }
    }

    fn is_stopped(&self) -> bool {
        self.mode() == Mode::Stopped
    }

    /// Whether it is decelerated or stands.
    fn is_required(&self) -> bool {
        matches!(self.state, "to off" | "to stand" | "to lower" | "stand")
    }

    /// The row of the first table: whether the next tick has no deceleration. An arm that will
    /// stand stands from the last one on.
    fn row(&self) -> &'static str {
        match (self.state, self.left) {
            ("to off", 0) => "to off, over",
            ("to stand", 0 | 1) => "to stand, over",
            ("to lower", 0) => "to lower, over",
            (state, _) => state,
        }
    }

    /// Whether the controller, or the types of its tick, allow an input.
    pub(super) fn allows(&self, input: Input) -> bool {
        match input {
            // Before the first positions, all are plausible.
            Bad(3) => self.known,
            Fast | Torque | Limited | NoTorque => self.begun,
            Reset => self.state == "stand" || self.is_stopped(),
            _ => true,
        }
    }

    /// The cell of an input, what is to show after it, and the next state.
    pub(super) fn after(
        mut self,
        input: Input,
        table: &Table,
    ) -> Result<(Cell, Observation, Self), String> {
        let (state, row) = (self.state, self.row());
        let (class, fault) = match input {
            Good => self.begin(None),
            Bad(which) => self.begin(Some(BAD[which])),
            Fast => self.exceed(),
            Torque | Limited => ("torque", Some(BEFORE)),
            NoTorque => self.lack_torque(),
            Report | Missed => self.notify(input == Report),
            Stop => ("`stop`", self.stop(Fault::Brake)),
            StopBy(category) => self.stop_by(category),
            AsSet => self.stop_by(self.category),
            Reset => self.reset(),
        };
        let entry = |row| table.get_key_value(&(row, class));
        let entry = entry(row).or_else(|| entry(state));
        let (&cell, next) = entry.ok_or_else(|| format!("{row}, {class}: not in the table"))?;
        self.enter(next);
        let limited = input != Torque;
        let command = matches!(input, Torque | Limited | NoTorque).then(|| {
            self.end(limited);
            let stops = self.is_stopped();
            let status = Status { mode: self.mode(), fault, limited: limited & !stops };
            let torque = match input {
                _ if stops => 0.0,
                NoTorque => LAST,
                _ => WANTED,
            };
            (status, stops | self.braked, [torque])
        });
        let rise = (self.ramp + 1) as f32 / self.ticks[2] as f32;
        let rises = (self.mode() == Mode::Full) & !self.braked;
        let authority = if rises { rise.min(1.0) } else { 0.0 };
        let flags = [self.known, self.accepted, self.stopped_again];
        Ok((cell, (self.state, fault, authority, flags, command), self))
    }

    fn class(&self, faults: u32, classes: [&'static str; 3]) -> &'static str {
        let [ride, hold, _] = self.ticks;
        let held = if self.category == 0 { 0 } else { hold };
        classes[usize::from(faults > ride) + usize::from(faults > ride + held)]
    }

    fn count(&mut self, faults: u32) {
        if !self.is_stopped() {
            (self.faults, self.faulted, self.spoilt) = (faults, true, true);
        }
    }

    fn begin(&mut self, bad: Option<Fault>) -> Outcome {
        let late = self.late.is_some();
        let over = matches!(self.row(), "to off, over" | "to lower, over");
        if self.is_required() & !late {
            self.forget();
        }
        self.faulted = false;
        let fault = self.late.or(bad);
        let mut class = "good";
        if fault.is_some() {
            class = self.class(self.faults + 1, if late { LATE_TICK } else { BAD_TICK });
            self.count(self.faults + 1);
        }
        // The fault of a late tick comes before what its state does, and that of positions after
        // it.
        let hidden = if late { class != BAD_TICK[2] } else { over };
        let fault = match self.state {
            "start" | "full" | "held" => fault,
            "off" | "lower" | "unusable" => Some(BEFORE),
            "no torque" => fault.or(Some(BEFORE)),
            _ => fault.filter(|_| !hidden).or(Some(REASON)),
        };
        (self.begun, self.late) = (true, Some(Fault::Unfinished));
        self.accepted = bad.is_none();
        self.known |= self.accepted;
        self.left = self.left.saturating_sub(1);
        (class, fault)
    }

    fn forget(&mut self) {
        let good = self.accepted & !core::mem::take(&mut self.spoilt);
        self.ramp = (self.ramp + 1) * u32::from(good);
        if self.ramp >= self.ticks[2].max(1) {
            (self.faults, self.ramp) = (0, 0);
        }
    }

    fn exceed(&mut self) -> Outcome {
        let faults = self.faults.max(self.ticks[0]) + 1;
        self.count(faults);
        let fault = Fault::Speed { joint: 0 };
        (self.class(faults, FAST), Some(self.unless_stopped(fault)))
    }

    fn lack_torque(&mut self) -> Outcome {
        let faults = self.faults + u32::from(!self.faulted);
        let class = self.class(faults, NO_TORQUE);
        if self.faulted & (self.state == "full") {
            return (class, Some(BEFORE));
        }
        self.count(faults);
        let fault = Fault::Torque { joint: 0 };
        (class, Some(self.unless_stopped(fault)))
    }

    fn unless_stopped(&self, fault: Fault) -> Fault {
        if self.is_stopped() { BEFORE } else { fault }
    }

    /// Nothing of this can be called within a tick: one that was begun is given up.
    fn notify(&mut self, reports: bool) -> Outcome {
        self.begun = false;
        if reports {
            self.late = Some(REPORTED);
        }
        ("`report`, `missed`", Some(BEFORE))
    }

    fn stop(&mut self, fault: Fault) -> Option<Fault> {
        if !self.is_required() {
            (self.left, self.ramp, self.spoilt) = (self.ticks[1], 0, true);
        }
        Some(self.unless_stopped(fault))
    }

    fn stop_by(&mut self, category: usize) -> Outcome {
        self.stopped_again = self.is_required();
        let fault = match (self.stopped_again, category) {
            (false, _) => Fault::External,
            (true, 0) => REASON,
            (true, _) => BEFORE,
        };
        (STOP_BY[category], self.stop(fault))
    }

    fn reset(&mut self) -> Outcome {
        let mut fault = BEFORE;
        if self.state == "unusable" {
            fault = Fault::Limits { joint: 0 };
        }
        (self.begun, self.ramp) = (false, 0);
        if self.state != "stand" {
            (self.known, self.accepted, self.late) = (false, false, None);
            (self.faulted, self.braked, self.faults, self.quiet) = (false, true, 0, 0);
        }
        ("`reset`", Some(fault))
    }

    fn enter(&mut self, next: &'static str) {
        self.state = if next == "stopped" { self.stopped() } else { next };
        if self.faulted & (self.mode() != Mode::Full) {
            self.ramp = 0;
        }
        if !self.is_required() {
            (self.left, self.stopped_again, self.spoilt) = (0, false, false);
        }
    }

    fn end(&mut self, limited: bool) {
        let (full, reentry) = (self.mode() == Mode::Full, self.ticks[2]);
        if full & !self.braked {
            self.ramp = (self.ramp + 1).min(reentry);
        }
        self.braked &= !full | limited;
        let quiet = full & !self.faulted;
        self.quiet = (self.quiet + 1).min(reentry) * u32::from(quiet);
        if quiet & (self.quiet >= reentry) {
            self.faults = 0;
        }
        (self.begun, self.late, self.faulted) = (false, None, false);
    }
}
