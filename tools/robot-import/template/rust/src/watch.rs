//! The motion without end, each of its ticks sent as a frame: what `cargo xtask watch --project`
//! shows and records.
//!
//! Here tick and frame follow each other in one loop. On a board the tick is an interrupt, which
//! fills the sample of a `machine_link::Queue`, and the main loop sends what it takes out of the
//! queue: then the port never delays the tick.

use dynamics_core::model::{JointKind, model};
use dynamics_core::state::State;
use joint_drivers::ControlLoop;
use machine_link::{Axis, Machine, Message, Sample, capacity, encode};
use motion_control::reference::Reference;

use crate::control::{FeedForward, SetupError, controller, gains};
use crate::excitation::Excitation;
use crate::report::RunError;
use crate::scene::{self, Arm, Motion, N, TICK};
use crate::simulation::{Plant, Wires};

/// Ticks from one repetition of the constants to the next.
const MACHINE: u32 = 1000;

/// The choice of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The motion that shows the robot's parameters, in place of that of `scene.rs`.
    pub excite: bool,
    /// The number of ticks; 0 for no end.
    pub ticks: u32,
}

impl Options {
    /// Reads words such as `excite` and `ticks=20000`; others are left out.
    pub fn of<'a>(words: impl Iterator<Item = &'a str>) -> Self {
        let mut options = Self::default();
        for word in words {
            options.excite |= word == "excite";
            let ticks = word.strip_prefix("ticks=").and_then(|ticks| ticks.parse().ok());
            options.ticks = ticks.unwrap_or(options.ticks);
        }
        options
    }
}

/// A motion that begins again where it ends.
struct Repeated<'a>(&'a Motion);

impl Reference<f32, N> for Repeated<'_> {
    fn at(&self, tick: u32) -> State<f32, N, N> {
        self.0.at(tick % self.0.ticks().max(1))
    }

    fn ticks(&self) -> u32 {
        u32::MAX
    }
}

/// Runs, and sends the frames.
///
/// # Errors
/// [`RunError`].
pub fn run(options: Options, send: impl FnMut(&[u8])) -> Result<(), RunError> {
    let motion = scene::motion().map_err(|error| RunError::Setup(SetupError::Motion(error)))?;
    match options.excite {
        true => along(&Excitation::new(&motion), &motion, options.ticks, send),
        false => along(&Repeated(&motion), &motion, options.ticks, send),
    }
}

fn along(
    reference: &impl Reference<f32, N>,
    motion: &Motion,
    ticks: u32,
    mut send: impl FnMut(&[u8]),
) -> Result<(), RunError> {
    let (home, full_scale) = (scene::home(), scene::limits(motion).torque);
    let wires = Wires::new();
    let encoders = wires.encoders(motion, &home).map_err(RunError::Setup)?;
    let drives = wires.drives(&full_scale);
    let controller = controller(motion).map_err(RunError::Setup)?;
    // Without detectors: a motion that reverses often looks like a frozen encoder where the drives'
    // steps are coarse.
    let mut control =
        ControlLoop::on_circles(encoders, drives, wires.brake(), gains(), controller, ());
    let mut plant = Plant::new(home, full_scale);
    let mut bytes = [0; capacity(N)];
    let mut number = 0_u32;
    while ticks == 0 || number < ticks {
        if number.is_multiple_of(MACHINE) {
            let frame = encode(&Message::Machine(machine(motion)), &mut bytes);
            frame.into_iter().for_each(&mut send);
        }
        let telemetry = control.tick::<FeedForward, _, _>(reference, &());
        let sample = Sample {
            number,
            tick: telemetry.tick,
            status: telemetry.status,
            reference: telemetry.reference,
            estimate: telemetry.estimate,
            torque: telemetry.torque,
            ..Sample::default()
        };
        let frame = encode(&Message::Tick(sample.message(0)), &mut bytes);
        frame.into_iter().for_each(&mut send);
        plant.advance(&wires).map_err(RunError::Plant)?;
        number = number.wrapping_add(1);
    }
    Ok(())
}

/// The constants of the robot.
fn machine(motion: &Motion) -> Machine<N> {
    let (mut limits, torque) = (scene::described_limits(), scene::limits(motion).torque);
    let mut machine = Machine { tick_us: (TICK * 1e6 + 0.5) as u32, ..Machine::default() };
    let robot = model::<f32, Arm, N, N, N>();
    // A longer name is cut short.
    let _ = robot.name.chars().try_for_each(|letter| machine.name.push(letter));
    for ((limits, torque), link) in limits.iter_mut().zip(torque).zip(&robot.links) {
        limits.torque = torque;
        let prismatic = link.joint.kind == JointKind::Prismatic;
        // There is room for as many as there are.
        let _ = machine.joints.push(Axis { limits: *limits, prismatic });
    }
    machine
}
