//! What the firmware says, in words: the joint, what was seen, and what to do. `log.rs` prints it.

use core::fmt;

use joint_drivers::Telemetry;
use motion_control::limits::{Fault, Mode};
use motion_control::motion::ResetError;

use crate::scene::{JOINTS, N, TICK};

/// Ticks on the brake from one list of positions to the next, and from a line to its repetition.
const POSITIONS: u32 = (0.5 / TICK) as u32;
const AGAIN: u32 = (2.0 / TICK) as u32;

/// What was seen, and what to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// The joint, from 0; its text counts from 1, as the table of what to connect does.
    pub joint: Option<usize>,
    pub text: &'static str,
    /// The number of a fault or a register.
    pub number: Option<u32>,
}

impl Line {
    pub const fn of(joint: usize, text: &'static str) -> Self {
        Self { joint: Some(joint), text, number: None }
    }

    pub const fn of_all(text: &'static str) -> Self {
        Self { joint: None, text, number: None }
    }

    /// The name of its joint.
    pub fn name(&self) -> &'static str {
        self.joint.and_then(|joint| JOINTS.get(joint)).copied().unwrap_or_default()
    }
}

impl fmt::Display for Line {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(joint) = self.joint {
            write!(out, "joint {} `{}`: ", joint + 1, self.name())?;
        }
        out.write_str(self.text)?;
        self.number.map_or(Ok(()), |number| write!(out, " ({number})"))
    }
}

/// A message of the firmware.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Said<'a> {
    Mode(Mode, Option<Fault>),
    /// The positions of the joints on the brake, rad or m.
    Positions(&'a [f32; N]),
    Line(Line),
}

/// The memory of what was said: each line at most every two seconds.
#[derive(Debug)]
pub struct Memory {
    last: Option<(Mode, Option<Fault>)>,
    lines: [Option<(Line, u32)>; 2 * N + 4],
    next: usize,
    tick: u32,
    on_brake: u32,
}

impl Memory {
    pub const fn new() -> Self {
        Self { last: None, lines: [None; 2 * N + 4], next: 0, tick: 0, on_brake: 0 }
    }

    /// Says what has changed since the tick before.
    #[inline(never)]
    pub fn tick(&mut self, telemetry: &Telemetry<N>, print: impl Fn(Said<'_>)) {
        self.tick = self.tick.wrapping_add(1);
        let (mode, fault) = (telemetry.status.mode, telemetry.status.fault);
        if self.last != Some((mode, fault)) {
            self.last = Some((mode, fault));
            print(Said::Mode(mode, fault));
            if let Some(line) = fault.and_then(of_fault) {
                self.say(line, &print);
            }
        }
        self.on_brake = match mode {
            Mode::Stopped => (self.on_brake + 1) % POSITIONS,
            _ => 0,
        };
        if self.on_brake == 1 {
            print(Said::Positions(&telemetry.estimate));
        }
    }

    /// Says a line, unless it was said in the last two seconds.
    #[cold]
    #[inline(never)]
    pub fn say(&mut self, line: Line, print: impl Fn(Said<'_>)) {
        let is_old = |(_, tick): (Line, u32)| self.tick.wrapping_sub(tick) >= AGAIN;
        let place = self.lines.iter().position(|last| last.is_some_and(|last| last.0 == line));
        if place.is_some_and(|place| !self.lines[place].is_some_and(is_old)) {
            return;
        }
        let place = place.unwrap_or_else(|| {
            self.next = (self.next + 1) % self.lines.len();
            self.next
        });
        self.lines[place] = Some((line, self.tick));
        print(Said::Line(line));
    }
}

/// A fault that no device reports.
fn of_fault(fault: Fault) -> Option<Line> {
    let of = |joint, text| Some(Line::of(joint, text));
    match fault {
        Fault::Position { joint } => of(joint, OUTSIDE),
        Fault::Jump { joint } => of(joint, "it jumped: lost frames, a loose encoder or shaft"),
        Fault::Speed { joint } => of(joint, FAST),
        Fault::Frozen { joint } => of(joint, FROZEN),
        Fault::Saturated { joint } => {
            of(joint, "too long at its limit of torque: blocked? A load?")
        }
        Fault::LimitCycle { joint } => of(joint, SWINGS),
        Fault::Reference { joint } => of(joint, "its reference jumped: see scene.rs"),
        Fault::Torque { joint } => of(joint, "its law gave no number: see control.rs"),
        Fault::Hot { joint } => of(joint, "its motor is too hot: let it cool, load it less"),
        Fault::Missed | Fault::Overrun => Some(Line::of_all(LATE)),
        Fault::Unfinished | Fault::Restarted => Some(Line::of_all(LEFT)),
        Fault::Brake => Some(Line::of_all("the brake does not respond: its pin in pins.rs")),
        _ => None,
    }
}

const OUTSIDE: &str = "it is outside its range: move it there by hand, or correct its zero or sign";
const FAST: &str =
    "faster than its limit: gains too high, a drive in reverse, two swapped, a wrong zero";
const FROZEN: &str = "it does not move while its reference does: it has not broken away (friction, \
                      rotor), it is blocked, its brake is closed, or its encoder stands";
const SWINGS: &str = "its torque swings from limit to limit: gains too high, or two drives swapped";
const LATE: &str = "a tick took longer than its period: opt-level 1 or more, do less in it";
const LEFT: &str = "the processor left a tick or restarted: its supply, its watchdog";
const FAR: &str =
    "no start, more than 0.15 rad from home(): move it there by hand, or correct its zero";

/// Why the button did not start the robot.
pub fn of_refusal(reason: ResetError) -> Line {
    match reason {
        ResetError::TooFar { joint } => Line::of(joint, FAR),
        ResetError::OutOfBounds { joint } => Line::of(joint, OUTSIDE),
        ResetError::NoMeasurement => Line::of_all("no start: not every joint has a position"),
        _ => Line::of_all("no start: the arm has to stand, and nothing to touch it"),
    }
}
