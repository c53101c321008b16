//! The contents of a frame.

use core::array;

use dynamics_core::model::JointLimits;
use heapless::{String, Vec};
use motion_control::limits::{Mode, Status};
use serde::{Deserialize, Serialize};

/// The phases of a tick whose cost is sent, in their order.
pub const PHASES: [&str; 5] = ["read", "reference", "dynamics", "safety", "write"];

/// A message of a machine with up to N joints.
///
/// ```
/// use machine_link::{Machine, Message};
/// let message = Message::Machine(Machine::<6>::default());
/// assert!(matches!(message, Message::Machine(machine) if machine.joints.is_empty()));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
// A box needs a heap, and the small variant is the rare one.
#[allow(clippy::large_enum_variant, reason = "there is no heap for a box")]
#[non_exhaustive]
pub enum Message<const N: usize> {
    /// The constants of the machine, repeated about once a second: a listener may come at any time.
    Machine(Machine<N>),
    /// A tick.
    Tick(Tick<N>),
}

/// The constants of a machine.
///
/// # Cost
/// A frame of 37 bytes and 17 per joint at most.
///
/// ```
/// let machine = machine_link::Machine::<6> { tick_us: 1000, ..Default::default() };
/// assert_eq!(machine.name, "");
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Machine<const N: usize> {
    /// The name of the machine or of its program.
    pub name: String<16>,
    /// The period of the control tick, µs.
    pub tick_us: u32,
    /// The frequency of the timer in which the phases are measured, Hz; 0 if there is none.
    pub timer_hz: u32,
    /// The joints, from the base outward.
    pub joints: Vec<Axis, N>,
}

/// The constants of a joint.
///
/// ```
/// use dynamics_core::model::JointLimits;
/// let limits = JointLimits { lower: -3.1, upper: 3.1, velocity: 2.0, torque: 28.0 };
/// let axis = machine_link::Axis { limits, prismatic: false };
/// assert_eq!(axis.limits.torque, 28.0);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// Position, velocity and torque, rad or m.
    pub limits: JointLimits<f32>,
    /// Whether it slides: its positions are in m, its torques in N.
    pub prismatic: bool,
}

/// The positions and the torque of a joint in a tick.
///
/// ```
/// let joint = machine_link::Joint { reference: 0.5, estimate: 0.25, torque: 3.0 };
/// assert_eq!(joint.error(), 0.25);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    /// The reference position, rad or m.
    pub reference: f32,
    /// The estimated position, rad or m.
    pub estimate: f32,
    /// The commanded torque, N·m or N.
    pub torque: f32,
}

impl Joint {
    /// The tracking error: reference less estimate, rad or m.
    ///
    /// ```
    /// assert_eq!(machine_link::Joint::default().error(), 0.0);
    /// ```
    #[must_use]
    pub fn error(&self) -> f32 {
        self.reference - self.estimate
    }
}

/// The quantities of a control tick, for [`Producer::push`](crate::Producer::push).
///
/// ```
/// use motion_control::limits::Mode;
/// let sample = machine_link::Sample::<6>::default();
/// assert_eq!((sample.status.mode, sample.counts), (Mode::Full, [0; 6]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample<const N: usize> {
    /// The number of the tick since the start of the program;
    /// [`Producer::push`](crate::Producer::push) sets it.
    pub number: u32,
    /// Ticks that the full queue has dropped before this one;
    /// [`Producer::push`](crate::Producer::push) sets it.
    pub dropped: u32,
    /// Ticks since the start of the trajectory.
    pub tick: u32,
    /// The status of the supervisor.
    pub status: Status,
    /// The reference positions from the base outward, rad or m.
    pub reference: [f32; N],
    /// The estimated positions, rad or m.
    pub estimate: [f32; N],
    /// The commanded torques, N·m or N.
    pub torque: [f32; N],
    /// The counts of a timer that counts down, at the start and after each of [`PHASES`]; zeros if
    /// there is no timer.
    pub counts: [u32; PHASES.len() + 1],
}

impl<const N: usize> Default for Sample<N> {
    fn default() -> Self {
        Self {
            number: 0,
            dropped: 0,
            tick: 0,
            status: IDLE,
            reference: [0.0; N],
            estimate: [0.0; N],
            torque: [0.0; N],
            counts: [0; PHASES.len() + 1],
        }
    }
}

impl<const N: usize> Sample<N> {
    /// The message of this sample. `period` is the number of counts after which the timer begins
    /// again.
    ///
    /// ```
    /// let sample = machine_link::Sample::<1> { counts: [50, 30, 10, 90, 80, 80], ..Default::default() };
    /// assert_eq!(sample.message(100).cost, [20, 20, 20, 10, 0]);
    /// ```
    #[must_use]
    pub fn message(&self, period: u32) -> Tick<N> {
        let positions = self.reference.iter().zip(&self.estimate).zip(&self.torque);
        let joints = positions.map(|((&reference, &estimate), &torque)| Joint {
            reference,
            estimate,
            torque,
        });
        let cost = array::from_fn(|phase| {
            let (from, to) = (self.counts[phase], self.counts[phase + 1]);
            let wrapped = if to > from { period } else { 0 };
            from.wrapping_add(wrapped).wrapping_sub(to)
        });
        Tick {
            number: self.number,
            dropped: self.dropped,
            tick: self.tick,
            status: self.status,
            joints: joints.collect(),
            cost,
        }
    }
}

/// The status of a tick without a fault.
const IDLE: Status = Status { mode: Mode::Full, fault: None, limited: false };

/// A tick on the wire.
///
/// # Cost
/// A frame of 59 bytes and 12 per joint at most, where `usize` has 32 bits.
///
/// ```
/// let tick = machine_link::Tick::<6>::default();
/// assert_eq!((tick.number, tick.dropped), (0, 0));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tick<const N: usize> {
    /// The number of the tick since the start of the program, dropped ones included.
    pub number: u32,
    /// Ticks that the full queue has dropped before this one.
    pub dropped: u32,
    /// Ticks since the start of the trajectory.
    pub tick: u32,
    /// The status of the supervisor.
    pub status: Status,
    /// The joints, from the base outward.
    pub joints: Vec<Joint, N>,
    /// The time of each of [`PHASES`], in counts of the timer; 0 if there is no timer.
    pub cost: [u32; PHASES.len()],
}

impl<const N: usize> Default for Tick<N> {
    fn default() -> Self {
        Self {
            number: 0,
            dropped: 0,
            tick: 0,
            status: IDLE,
            joints: Vec::new(),
            cost: [0; PHASES.len()],
        }
    }
}
