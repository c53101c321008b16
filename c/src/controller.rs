//! The controller's functions: `..._controller_...` of the header.

use motion_control::limits::{Fault, Mode};

use crate::control::{Config, Control, Rejected, WayPoint, Where};
use crate::memory::Handle;
use crate::status::{self, NULL};
use crate::tool::Tool;
use crate::{Exports, Library, State, check, fault, status_of};

/// Way-points: `..._motion` of the header.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<const N: usize, const POINTS: usize> {
    /// How many of the points count.
    pub count: u32,
    /// The way-points.
    pub points: [WayPoint<N>; POINTS],
}

/// What goes to the drives: `..._command` of the header.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command<const N: usize> {
    /// Torques, N·m or N: always finite.
    pub torque: [f32; N],
    /// Whether the brake must hold the arm.
    pub brake: i32,
    /// Whether the drives are to be enabled.
    pub enable: i32,
    /// The mode.
    pub mode: i32,
    /// The fault of this tick, or the one that stopped the arm.
    pub fault: i32,
    /// Its joint, or −1.
    pub joint: i32,
    /// Whether a limit on torque or rate took effect.
    pub limited: i32,
}

/// What the controller knows: `..._report` of the header.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report<const N: usize> {
    /// Estimated positions, rad or m.
    pub q: [f32; N],
    /// Estimated velocities, rad/s or m/s.
    pub qd: [f32; N],
    /// The reference of the last tick.
    pub reference: State<N>,
    /// Ticks that are left of the way-points.
    pub left: u32,
}

impl<const N: usize> Command<N> {
    /// Zero torque on the brake.
    const STOP: Self =
        Self { torque: [0.0; N], brake: 1, enable: 0, mode: 2, fault: 0, joint: -1, limited: 0 };

    fn of(command: &motion_control::limits::Command<f32, N>) -> Self {
        let (mode, is_stopped) = match command.status.mode {
            Mode::Full => (0, false),
            Mode::Hold => (1, false),
            Mode::Stopped => (2, true),
        };
        let (fault, joint) = command.status.fault.map_or((0, -1), number_of);
        Self {
            torque: command.torque,
            brake: i32::from(command.brake),
            enable: i32::from(!is_stopped),
            mode,
            fault,
            joint,
            limited: i32::from(command.status.limited),
        }
    }
}

/// The faults with their numbers in the header, from which both directions are made.
macro_rules! faults {
    ($($fault:ident $(of $joint:ident)? = $number:ident,)*) => {
        /// The number of a fault in the header, and its joint.
        #[doc(hidden)]
        #[inline]
        pub fn number_of(fault: Fault) -> (i32, i32) {
            let joint = None::<usize>;
            let (number, joint) = match fault {
                $(Fault::$fault $({ $joint })? => (fault::$number, faults!(@some $($joint)?, joint)),)*
                _ => (fault::OTHER, joint),
            };
            (number, joint.map_or(-1, |joint| joint as i32))
        }

        /// The fault of a number in the header.
        #[doc(hidden)]
        pub fn fault_of<const N: usize>(number: i32, joint: i32) -> Option<Fault> {
            let joint = usize::try_from(joint).ok().filter(|&joint| joint < N);
            Some(match number {
                $(fault::$number => Fault::$fault $({ $joint: joint? })?,)*
                _ => return None,
            })
        }
    };
    (@some $joint:ident, $none:ident) => { Some($joint) };
    (@some , $none:ident) => { $none };
}

faults! {
    Encoder of joint = ENCODER,
    Stale = STALE,
    Unfinished = UNFINISHED,
    NotFinite of joint = NOT_FINITE,
    Position of joint = POSITION,
    Jump of joint = JUMP,
    Speed of joint = SPEED,
    Torque of joint = TORQUE,
    Drive of joint = DRIVE,
    Limits of joint = LIMITS,
    Frozen of joint = FROZEN,
    Saturated of joint = SATURATED,
    Reference of joint = REFERENCE,
    NotReady of joint = NOT_READY,
    Missed = MISSED,
    Overrun = OVERRUN,
    Model = MODEL,
    Overflow = OVERFLOW,
    Restarted = RESTARTED,
    Brake = BRAKE,
    External = EXTERNAL,
    Hot of joint = HOT,
    LostTurn of joint = LOST_TURN,
    LimitCycle of joint = LIMIT_CYCLE,
}

/// The status of a result, which also says what it is about.
pub(crate) fn located(result: Result<(), Rejected>, at: Option<&mut Where>) -> i32 {
    let (status, here) = match result {
        Ok(()) => (status::OK, Where::NOWHERE),
        Err(rejected) => rejected,
    };
    if let Some(at) = at {
        *at = here;
    }
    status
}

/// A status that is about nothing of a robot's.
pub(crate) fn bare(status: i32) -> Rejected {
    (status, Where::NOWHERE)
}

fn no_memory(memory: Option<Handle>) -> i32 {
    if memory.is_some() { status::MEMORY } else { status::NULL }
}

impl<L: Library<N, TOOL, POINTS>, const N: usize, const TOOL: usize, const POINTS: usize>
    Exports<L, N, TOOL, POINTS>
{
    pub(crate) fn control<'a>(
        memory: Option<Handle>,
    ) -> Result<&'a mut Control<L, N, TOOL, POINTS>, i32> {
        let found = memory.and_then(Handle::control);
        found.ok_or_else(|| no_memory(memory))
    }

    /// The configuration of the robot's description.
    pub fn config_of_description(tick: f32, frequency: f32, config: Option<&mut Config<N>>) -> i32 {
        status_of(|| {
            let config = config.ok_or(NULL)?;
            check::inputs([&[tick, frequency]])?;
            let described = Self::described(tick, frequency);
            check::results([&[described.bandwidth], &described.kp, &described.kd])?;
            *config = described;
            Ok(())
        })
    }

    /// Puts a controller into its memory.
    pub fn controller_init(
        memory: Option<Handle>,
        bytes: usize,
        config: Option<&Config<N>>,
        at: Option<&mut Where>,
    ) -> i32 {
        let (Some(handle), Some(config)) = (memory, config) else {
            return status::NULL;
        };
        let placed = Control::<L, N, TOOL, POINTS>::new(config).and_then(|control| {
            match handle.place(bytes, control) {
                true => Ok(()),
                false => Err(bare(status::MEMORY)),
            }
        });
        located(placed, at)
    }

    /// The tool of the feed-forward, or none.
    pub fn controller_tool(memory: Option<Handle>, tool: Option<&Tool>) -> i32 {
        status_of(|| {
            let control = Self::control(memory)?;
            let tool = tool.map(Self::set_tool).transpose()?;
            control.set_tool(tool.copied());
            Ok(())
        })
    }

    /// Plans a motion through way-points.
    pub fn controller_move(
        memory: Option<Handle>,
        motion: Option<&Motion<N, POINTS>>,
        at: Option<&mut Where>,
    ) -> i32 {
        let plan = || {
            let motion = motion.ok_or(NULL).map_err(bare)?;
            let count = usize::try_from(motion.count).unwrap_or(usize::MAX);
            Self::control(memory).map_err(bare)?.plan(count, &motion.points)
        };
        located(plan(), at)
    }

    /// The reference of the next tick.
    pub fn controller_follow(
        memory: Option<Handle>,
        reference: Option<&State<N>>,
        at: Option<&mut Where>,
    ) -> i32 {
        let reference = reference.ok_or(NULL).map_err(bare);
        located(
            reference.and_then(|reference| Self::control(memory).map_err(bare)?.follow(reference)),
            at,
        )
    }

    /// The measured positions, and which of them are valid.
    pub fn controller_observe(
        memory: Option<Handle>,
        q: Option<&[f32; N]>,
        valid: Option<&[u8; N]>,
    ) -> i32 {
        let Some(q) = q else {
            return status::NULL;
        };
        let invalid = valid.and_then(|valid| valid.iter().position(|&valid| valid == 0));
        let measured = invalid.map_or(Ok(*q), |joint| Err(Fault::Encoder { joint }));
        status_of(|| Self::control(memory).map(|control| control.observe(measured)))
    }

    /// The command of this tick.
    pub fn controller_command(memory: Option<Handle>, command: Option<&mut Command<N>>) -> i32 {
        let Some(command) = command else {
            return status::NULL;
        };
        // What an error leaves there must not be an old torque.
        *command = Command::STOP;
        status_of(|| {
            let new = Command::of(&Self::control(memory)?.command());
            check::results([&new.torque])?;
            *command = new;
            Ok(())
        })
    }

    /// A stop: the arm is decelerated, then zero torque and the brake.
    pub fn controller_stop(memory: Option<Handle>) -> i32 {
        status_of(|| Self::control(memory).map(|control| control.report(Fault::External)))
    }

    /// Zero torque and the brake at once.
    pub fn controller_off(memory: Option<Handle>) -> i32 {
        status_of(|| Self::control(memory).map(Control::switch_off))
    }

    /// A fault that the controller cannot see.
    pub fn controller_fault(memory: Option<Handle>, kind: i32, joint: i32) -> i32 {
        status_of(|| {
            let control = Self::control(memory)?;
            control.report(fault_of::<N>(kind, joint).ok_or(status::NO_FAULT)?);
            Ok(())
        })
    }

    /// Ticks that have passed without a call.
    pub fn controller_missed(memory: Option<Handle>, ticks: u32) -> i32 {
        status_of(|| Self::control(memory).map(|control| control.missed(ticks)))
    }

    /// Starts a stopped arm.
    pub fn controller_reset(memory: Option<Handle>, at: Option<&mut Where>) -> i32 {
        match Self::control(memory) {
            Ok(control) => located(control.reset(), at),
            Err(status) => status,
        }
    }

    /// Estimate and reference.
    pub fn controller_report(memory: Option<Handle>, report: Option<&mut Report<N>>) -> i32 {
        status_of(|| {
            let report = report.ok_or(NULL)?;
            let (estimate, reference, left) = Self::control(memory)?.state();
            let State { q, qd, qdd } = &reference;
            check::results([&estimate.q, &estimate.qd, q, qd, qdd])?;
            let (q, qd) = (estimate.q, estimate.qd);
            *report = Report { q, qd, reference, left };
            Ok(())
        })
    }
}
