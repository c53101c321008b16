//! What the firmware says, in words: the joint, what was seen, and what to do. `log.rs` prints it.

use core::fmt;

use joint_drivers::Telemetry;
use motion_control::limits::{Fault, Mode};
use motion_control::motion::ResetError;

use crate::board::SetupError;
use crate::scene::{JOINTS, N, TICK};

/// Ticks on the brake from one list of positions to the next, and from a line to its repetition.
const POSITIONS: u32 = (0.5 / TICK) as u32;
const AGAIN: u32 = (2.0 / TICK) as u32;

/// What was seen, and what to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// The joint, from 0; its text counts from 1, as the table of what to connect does.
    pub joint: Option<usize>,
    pub seen: &'static str,
    /// The number of a fault or a register.
    pub number: Option<u32>,
    pub remedy: &'static str,
}

impl Line {
    pub const fn of(joint: usize, seen: &'static str, remedy: &'static str) -> Self {
        Self { joint: Some(joint), ..Self::of_all(seen, remedy) }
    }

    pub const fn of_all(seen: &'static str, remedy: &'static str) -> Self {
        Self { joint: None, seen, number: None, remedy }
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
        out.write_str(self.seen)?;
        if let Some(number) = self.number {
            write!(out, " ({number})")?;
        }
        write!(out, ": {}", self.remedy)
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
    Some(match fault {
        Fault::Position { joint } => Line::of(
            joint,
            "it is outside its range",
            "move it back by hand; if it is not there, its zero or its direction in board.rs is wrong",
        ),
        Fault::Jump { joint } => {
            Line::of(joint, "its position jumped", "lost frames, or a loose encoder or shaft")
        }
        Fault::Speed { joint } => Line::of(
            joint,
            "it is faster than its limit",
            "a drive mounted in reverse (DRIVES), two drives swapped, a wrong zero, or something pushes the arm",
        ),
        Fault::Frozen { joint } => Line::of(
            joint,
            "it does not move while its reference does",
            "it has not broken away (friction and rotor are not in the description, something blocks it, its brake is closed, its motor is weak), or its encoder stands",
        ),
        Fault::Saturated { joint } => Line::of(
            joint,
            "its torque was at the limit for too long",
            "something blocks it, it carries more than the description says, or its limit is too low",
        ),
        Fault::LimitCycle { joint } => Line::of(
            joint,
            "its torque swings from limit to limit",
            "gains too high or in another unit (those of control.rs are per inertia, 1/s² and 1/s, not N·m/rad), or two drives swapped",
        ),
        Fault::Reference { joint } => {
            Line::of(joint, "its reference jumped", "the motion in scene.rs, or an own reference")
        }
        Fault::Torque { joint } => Line::of(
            joint,
            "its law gave no number",
            "the law in control.rs, or the robot in robot.rs",
        ),
        Fault::Hot { joint } => {
            Line::of(joint, "its motor is too hot", "let it cool, and load it less")
        }
        Fault::Missed | Fault::Overrun => Line::of_all(
            "a tick took longer than its period",
            "build with opt-level 1 or more, do less in the tick, keep other interrupts short",
        ),
        Fault::Unfinished | Fault::Restarted => Line::of_all(
            "the processor restarted, or left a tick",
            "its supply, or a tick that did not end within the watchdog's time",
        ),
        Fault::Brake => Line::of_all("the brake does not respond", "its pin in pins.rs"),
        _ => return None,
    })
}

/// Why the button did not start the robot.
pub fn of_refusal(reason: ResetError) -> Line {
    match reason {
        ResetError::TooFar { joint } => Line::of(
            joint,
            "no start: it is more than 0.15 rad from home() in scene.rs",
            "move it there by hand; if it is there, ZERO in board.rs or the zero of its drive is wrong",
        ),
        ResetError::OutOfBounds { joint } => Line::of(
            joint,
            "no start: it is outside its range",
            "move it back by hand; if it is not there, its zero or its direction in board.rs is wrong",
        ),
        ResetError::NoMeasurement => Line::of_all(
            "no start: not every joint has a position",
            "the line of that joint says why",
        ),
        ResetError::Contact => Line::of_all("no start: something touches the arm", "remove it"),
        _ => Line::of_all("no start: the arm is not stopped", "wait until it stands"),
    }
}

/// The robot stays on its brake for good.
pub fn of_setup(error: &SetupError) -> Line {
    match error {
        SetupError::Motion(_) => {
            Line::of_all("impossible: the motion", "home, away and motion in scene.rs")
        }
        SetupError::Limits(_) => Line::of_all("impossible: a limit", "limits in scene.rs"),
        SetupError::Encoder(error) => Line::of(
            error.joint,
            "impossible: how its encoder is mounted",
            "ZERO in board.rs, encoder_ratios and encoder_ranges in scene.rs",
        ),
        SetupError::Drive(_) => {
            Line::of_all("impossible: the full scale of a drive", "full_scale in board.rs")
        }
        SetupError::Can(error) => Line::of(
            error.joint,
            "impossible: the number, the scale or the torque of its drive",
            "number and SCALES in board.rs, its limit of torque in scene.rs",
        ),
    }
}
