//! One run of the motion, and what is printed of it.

use core::fmt::{self, Write};
use core::hint::black_box;

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use joint_drivers::{ControlLoop, Law, Telemetry};
use motion_control::limits::{Fault, Mode, SafetyLimits};

use crate::control::{FeedForward, Gains, SetupError, controller, detectors, gains};
use crate::marker::measured;
use crate::scene::{self, JOINTS, N, TICK};
use crate::simulation::{Plant, Wires};

/// The results of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The torques of the first tick, N·m or N.
    pub first: [f32; N],
    /// The greatest torques, N·m or N.
    pub largest: [f32; N],
    /// The root mean square of the tracking error of each joint, rad or m.
    pub error: [f32; N],
    /// The number of ticks.
    pub ticks: u32,
    /// Ticks in which a limit on torque or its rate took effect, after the first, where the torque
    /// rises from zero.
    pub limited: u32,
    /// Ticks in another mode than the full one.
    pub faulted: u32,
    /// The first fault and its tick.
    pub fault: Option<(u32, Fault)>,
    /// The first joint whose torque was at a limit then, and the tick.
    pub cut: Option<(u32, usize)>,
    /// The least and the greatest cost of a tick, by the clock.
    pub cost: [u32; 2],
}

/// Why there is no outcome.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RunError {
    /// The scene is impossible.
    Setup(SetupError),
    /// A joint of the simulated robot moves no inertia.
    Plant(NotPositiveDefinite),
}

impl fmt::Display for RunError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Setup(error) => error.fmt(out),
            Self::Plant(error) => {
                let name = JOINTS.get(error.joint).unwrap_or(&"?");
                write!(out, "joint `{name}` moves no inertia: add an Armature in scene.rs")
            }
        }
    }
}

impl core::error::Error for RunError {}

/// The clock counts modulo 2²⁴, as SysTick does.
const COUNTS: u32 = 0x00ff_ffff;
/// The ticks of the start in which the torque may still rise at its allowed rate.
const START: u32 = 20;

/// Runs the motion under the law `L`; `clock` counts what a tick costs.
///
/// # Errors
/// [`RunError`].
pub fn run<L: Law<N, (), Gains>>(clock: impl Fn() -> u32) -> Result<Outcome, RunError> {
    let motion = scene::motion().map_err(|error| RunError::Setup(SetupError::Motion(error)))?;
    let (home, limits) = (scene::home(), scene::limits(&motion));
    let full_scale = limits.torque;
    let wires = Wires::new();
    let encoders = wires.encoders(&motion, &home).map_err(RunError::Setup)?;
    let drives = wires.drives(&full_scale);
    let controller = controller(&motion).map_err(RunError::Setup)?;
    let (brake, detectors) = (wires.brake(), detectors(&motion));
    let mut control =
        ControlLoop::on_circles(encoders, drives, brake, gains(), controller, detectors);
    let mut plant = Plant::new(home, full_scale);
    let mut outcome = Outcome {
        first: [0.0; N],
        largest: [0.0; N],
        error: [0.0; N],
        ticks: motion.ticks(),
        limited: 0,
        faulted: 0,
        fault: None,
        cut: None,
        cost: [u32::MAX, 0],
    };
    let mut last = [0.0; N];
    for tick in 0..outcome.ticks {
        let reference = motion.at(tick).q;
        for (error, (is, wanted)) in
            outcome.error.iter_mut().zip(plant.state.q.iter().zip(reference))
        {
            *error += (is - wanted) * (is - wanted);
        }
        let start = clock();
        let telemetry = measured::<0, _>(|| control.tick::<L, _, _>(&motion, &()));
        let cost = clock().wrapping_sub(start) & COUNTS;
        outcome.cost = [outcome.cost[0].min(cost), outcome.cost[1].max(cost)];
        outcome.note(tick, &telemetry, &limits, &last);
        last = telemetry.torque;
        plant.advance(&wires).map_err(RunError::Plant)?;
    }
    let per_tick = 1.0 / outcome.ticks.max(1) as f32;
    outcome.error = outcome.error.map(|sum| Real::sqrt(sum * per_tick));
    Ok(outcome)
}

impl Outcome {
    fn note(
        &mut self,
        tick: u32,
        telemetry: &Telemetry<N>,
        limits: &SafetyLimits<f32, N>,
        last: &[f32; N],
    ) {
        if tick == 0 {
            self.first = telemetry.torque;
        }
        for (largest, torque) in self.largest.iter_mut().zip(telemetry.torque) {
            *largest = largest.max(torque.abs());
        }
        if telemetry.status.limited && tick > START {
            self.limited += 1;
            let is_cut = |&joint: &usize| {
                let (torque, rate) = (telemetry.torque[joint], limits.rate[joint]);
                torque.abs() >= limits.torque[joint] || (torque - last[joint]).abs() > 0.99 * rate
            };
            let cut = (0..N).find(is_cut).map(|joint| (tick, joint));
            self.cut = self.cut.or(cut);
        }
        let fault = telemetry.status.fault.map(|fault| (tick, fault));
        self.fault = self.fault.or(fault);
        self.faulted += u32::from(telemetry.status.mode != Mode::Full);
    }

    /// Whether the robot followed its motion by its own torque.
    pub fn is_good(&self) -> bool {
        self.limited == 0 && self.faulted == 0
    }

    /// The reason why the robot did not follow its motion: the joint, the number and what to do;
    /// nothing if it did.
    ///
    /// # Errors
    /// The text cannot be written.
    pub fn say(&self, out: &mut impl Write) -> fmt::Result {
        let ticks = self.ticks;
        if self.limited > 0 {
            write!(out, "error: {} of {ticks} ticks at a limit", self.limited)?;
            if let Some((tick, joint)) = self.cut {
                let (name, torque) = (JOINTS[joint], self.largest[joint]);
                write!(
                    out,
                    ", first joint `{name}` in tick {tick}, whose torque was up to {torque:.3}"
                )?;
            }
            writeln!(out, ": see limits and away in scene.rs")?;
        }
        if self.faulted == 0 {
            return Ok(());
        }
        write!(out, "error: {} of {ticks} ticks on hold or stopped", self.faulted)?;
        if let Some((tick, fault)) = self.fault {
            write!(out, ", first in tick {tick}: {}", fault.named(&JOINTS))?;
        }
        writeln!(out, ": see OMEGA_N, limits and away in scene.rs")
    }
}

/// A state with other numbers for every joint.
pub fn probe() -> State<f32, N, N> {
    let of = |first: f32, step: f32| core::array::from_fn(|joint| first + step * joint as f32);
    State { q: of(0.1, 0.07), qd: of(0.3, -0.05), qdd: of(-0.2, 0.11) }
}

/// A clock of 24 bits.
#[derive(Clone, Copy, Debug)]
pub struct Clock<F> {
    /// The function that reads the clock.
    pub now: F,
    /// QEMU's instructions per count, as a fraction whose denominator is the counts of a
    /// microsecond; `None` where nothing counts.
    pub instructions: Option<[u64; 2]>,
}

/// Runs the motion and prints what happened; whether all went well, and each tick within its
/// period.
///
/// # Errors
/// The text cannot be written.
pub fn print(out: &mut impl Write, clock: Clock<impl Fn() -> u32>) -> Result<bool, fmt::Error> {
    let state = black_box(probe());
    let torque = measured::<1, _>(|| scene::inverse_dynamics(&state));
    values(out, "inverse dynamics of the probe", &torque)?;
    let outcome = match run::<FeedForward>(&clock.now) {
        Ok(outcome) => outcome,
        Err(error) => {
            writeln!(out, "error: {error}")?;
            return Ok(false);
        }
    };
    values(out, "torques of the first tick", &outcome.first)?;
    writeln!(
        out,
        "joint: tracking error RMS in 1e-3 rad or m, greatest torque in N·m or N, its limit"
    )?;
    let limits = scene::motion().map(|motion| {
        let needed = scene::needed_torque(&motion);
        (scene::limits(&motion).torque, needed)
    });
    let (limits, needed) = limits.unwrap_or(([0.0; N], [0.0; N]));
    for (joint, name) in JOINTS.iter().enumerate() {
        let (error, torque) = (1e3 * outcome.error[joint], outcome.largest[joint]);
        writeln!(out, "  {name}: {error:.3}, {torque:.3}, {:.3}", limits[joint])?;
    }
    for (joint, name) in
        JOINTS.iter().enumerate().filter(|&(joint, _)| needed[joint] > limits[joint])
    {
        let (needed, limit) = (needed[joint], limits[joint]);
        writeln!(
            out,
            "error: joint `{name}` needs {needed:.3} for this motion, its limit is {limit:.3}: see home, away and limits in scene.rs"
        )?;
    }
    outcome.say(out)?;
    let in_time = cost(out, &outcome, clock)?;
    Ok(outcome.is_good() && in_time)
}

fn values(out: &mut impl Write, name: &str, values: &[f32; N]) -> fmt::Result {
    write!(out, "{name}:")?;
    for value in values {
        write!(out, " {value:.6}")?;
    }
    write!(out, "\n  bits:")?;
    for value in values {
        write!(out, " {:08x}", value.to_bits())?;
    }
    writeln!(out)
}

/// Prints what a tick costs; whether the longest one ends within its period.
fn cost(
    out: &mut impl Write,
    outcome: &Outcome,
    clock: Clock<impl Fn() -> u32>,
) -> Result<bool, fmt::Error> {
    let Some([numerator, denominator]) = clock.instructions else {
        writeln!(out, "tick: {} ticks; no counter of instructions here", outcome.ticks)?;
        return Ok(true);
    };
    let before = (clock.now)();
    let overhead = (clock.now)().wrapping_sub(before) & COUNTS;
    let [least, most] = outcome.cost.map(|cost| u64::from(cost.saturating_sub(overhead)));
    let [first, last] =
        [least, most].map(|counts| (counts * numerator + denominator / 2) / denominator);
    let share = 100.0 * most as f32 / (TICK * 1e6 * denominator as f32);
    writeln!(
        out,
        "tick: {first} to {last} instructions in {} ticks, within 2 ({least} to {most} counts of a timer at 168 MHz: in \
         QEMU 1.344 an instruction, on a board cycles); the longest takes {share:.1} % of its period",
        outcome.ticks
    )?;
    if share > 100.0 {
        writeln!(
            out,
            "error: the longest tick takes {share:.0} % of its period: build with --release, or with opt-level 1 or more"
        )?;
    }
    Ok(share <= 100.0)
}
