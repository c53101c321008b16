//! The state of the machine as known so far.

use std::collections::VecDeque;

use machine_link::{Counts, PHASES};
use motion_control::limits::{Fault, Mode};

use crate::{Machine, Message, Tick};

/// Events that are kept.
const EVENTS: usize = 100;

/// Events of which one may come again: hold, its fault, and full.
const ALTERNATING: usize = 3;
/// Ticks within which a mode or fault that comes again is the same event.
const AGAIN: u32 = 200;

/// A change of mode or fault, and its repetitions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Event {
    /// The number of the tick in which it came first, and last.
    pub first: u32,
    pub last: u32,
    /// The number of times that it came.
    pub count: u32,
    pub text: String,
}

impl Event {
    /// Its text, with the number of its repetitions.
    #[must_use]
    pub fn words(&self) -> String {
        let Self { last, count, text, .. } = self;
        match count {
            1 => text.clone(),
            _ => format!("{text}  ({count} times to tick {last})"),
        }
    }
}

/// The extremes of a joint so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extremes {
    /// The largest tracking error, rad or m.
    pub error: f32,
    /// The sum of the squares of the tracking errors, rad² or m².
    pub squares: f64,
    /// The largest torque, N·m or N.
    pub torque: f32,
}

/// The state of the machine as known so far.
#[derive(Clone, Debug, Default)]
pub struct View {
    /// Its constants, once they have arrived.
    pub machine: Option<Machine>,
    pub last: Option<Tick>,
    pub counts: Counts,
    /// Ticks that arrived.
    pub ticks: u64,
    pub extremes: Vec<Extremes>,
    /// The largest cost of each phase, in counts of the timer.
    pub cost: [u32; PHASES.len()],
    /// The last changes of mode and fault, the newest last.
    pub events: VecDeque<Event>,
    before: Option<(Mode, Option<Fault>)>,
}

impl View {
    pub fn take(&mut self, message: Message) {
        match message {
            Message::Machine(machine) => self.machine = Some(machine),
            Message::Tick(tick) => self.tick(tick),
            // A message of a later minor version, which this one does not show.
            _ => {}
        }
    }

    fn tick(&mut self, tick: Tick) {
        self.ticks += 1;
        self.extremes.resize(tick.joints.len(), Extremes::default());
        for (extremes, joint) in self.extremes.iter_mut().zip(&tick.joints) {
            let error = joint.error();
            extremes.error = extremes.error.max(error.abs());
            extremes.squares += f64::from(error) * f64::from(error);
            extremes.torque = extremes.torque.max(joint.torque.abs());
        }
        for (largest, cost) in self.cost.iter_mut().zip(tick.cost) {
            *largest = (*largest).max(cost);
        }
        let status = (tick.status.mode, tick.status.fault);
        if self.before.replace(status).unwrap_or((Mode::Full, None)) != status {
            self.event(&tick);
        }
        self.last = Some(tick);
    }

    fn event(&mut self, tick: &Tick) {
        let mode = mode(tick.status.mode);
        let text = match tick.status.fault {
            Some(fault) => format!("{mode}: {fault}"),
            None => mode.to_owned(),
        };
        let number = tick.number;
        // A fault that comes and goes changes the mode in almost every tick.
        let again = self.events.iter_mut().rev().take(ALTERNATING).find(|event| {
            event.text == text && number.checked_sub(event.last).is_some_and(|since| since <= AGAIN)
        });
        if let Some(event) = again {
            (event.last, event.count) = (number, event.count + 1);
            return;
        }
        if self.events.len() == EVENTS {
            self.events.pop_front();
        }
        self.events.push_back(Event { first: number, last: number, count: 1, text });
    }

    /// The time of the machine in the ticks that arrived, s, if it has said how long one is.
    #[must_use]
    pub fn seconds(&self) -> Option<f64> {
        let period = self.machine.as_ref()?.tick_us;
        Some(1e-6 * f64::from(period) * self.ticks as f64)
    }

    /// The limit of a joint's torque, N·m or N, if it is known.
    #[must_use]
    pub fn torque_limit(&self, joint: usize) -> Option<f32> {
        let axis = self.machine.as_ref()?.joints.get(joint)?;
        Some(axis.limits.torque).filter(|limit| limit.is_finite() && *limit > 0.0)
    }

    /// Counts of the timer as µs, if the machine has a timer.
    #[must_use]
    pub fn microseconds(&self, counts: u32) -> Option<f64> {
        let hz = self.machine.as_ref()?.timer_hz;
        (hz > 0).then(|| f64::from(counts) * 1e6 / f64::from(hz))
    }

    /// The root of the mean square of a joint's tracking error, rad or m.
    #[must_use]
    pub fn rms(&self, joint: usize) -> f64 {
        let squares = self.extremes.get(joint).map_or(0.0, |e| e.squares);
        (squares / self.ticks.max(1) as f64).sqrt()
    }
}

#[must_use]
pub fn mode(mode: Mode) -> &'static str {
    match mode {
        Mode::Full => "full",
        Mode::Hold => "hold",
        Mode::Stopped => "stopped",
    }
}
