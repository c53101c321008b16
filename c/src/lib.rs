//! The dynamics and the controller of a robot for C: the functions of the header, which
//! [`export!`] exports under the prefix of a library.
//!
//! No function allocates, blocks or panics, or keeps a state outside the memory that C passes.
//! References behind `Option` are C's pointers: null is `None`, and what else C has to guarantee of
//! a pointer is in the header, `include/dynamics.h.liquid`. robot-import puts in the prefix and the
//! names of a robot's joints.

#![no_std]

mod advice;
mod check;
mod control;
mod controller;
mod dynamics;
mod export;
mod goal;
mod kinematics;
mod memory;
mod thermal;
mod tip;
mod tool;
mod wrench;

use core::marker::PhantomData;

use dynamics_core::effects::Effect;
use dynamics_core::model::Robot;

pub use advice::AdviceText;
pub use control::{Config, WayPoint, Where};
pub use controller::{Command, Motion, Report};
#[doc(hidden)]
pub use controller::{fault_of, number_of};
pub use dynamics::Form;
#[doc(hidden)]
pub use dynamics_core::{effects::Gravity, glam::Vec3};
pub use export::assert_header;
pub use goal::{Goal, GoalChange};
pub use kinematics::Pose;
pub use memory::{Argument, Handle, Kept};
pub use numbers::{fault, field, status};
pub use thermal::{Heat, Motors, Temperatures, Thermal};
pub use tip::{PoseSolver, Tip};
pub use tool::{Load, Tool};
pub use wrench::{SensorFit, SensorLoad, Wrench};

/// The numbers of the header.
#[allow(non_snake_case, unused_parens, unused_variables, reason = "they are C's expressions")]
mod numbers {
    include!(concat!(env!("OUT_DIR"), "/numbers.rs"));
}

/// Positions, velocities and accelerations of the joints: `..._state` of the header.
pub type State<const N: usize> = dynamics_core::state::State<f32, N, N>;

/// The name of a library and its version, by which it knows the memory that it has written.
pub trait Named {
    /// The name and the version.
    const NAME: &'static str;
    /// The hash of Fowler, Noll and Vo of it.
    const HASH: u64 = {
        let name = Self::NAME.as_bytes();
        let (mut hash, mut k) = (0xcbf2_9ce4_8422_2325_u64, 0);
        while k < name.len() {
            hash = (hash ^ name[k] as u64).wrapping_mul(0x0000_0100_0000_01b3);
            k += 1;
        }
        hash
    };
}

/// A robot of N joints and what acts on it, whose tools are on the body `TOOL` as a rule, and whose
/// motions have up to `POINTS` way-points. [`export!`] implements it.
pub trait Library<const N: usize, const TOOL: usize, const POINTS: usize>: Named {
    /// The robot.
    type Arm: Robot<N, N, N>;
    /// The algorithms of inertia matrix and forward dynamics.
    type Form: Form<Self::Arm, N>;
    /// What acts on the robot beside gravity.
    type Forces: Effect<f32, N, N> + 'static;
    /// The names of the joints.
    const JOINTS: [&'static str; N];
    /// Gravity, m/s², along −z of the base.
    const GRAVITY: f64;
    /// Gravity, and what else acts: a place in memory, whose values are then constants of the
    /// machine code.
    const EFFECTS: &'static (Gravity, Self::Forces);
}

/// The functions of a library, as C calls them.
#[derive(Clone, Copy, Debug)]
pub struct Exports<L, const N: usize, const TOOL: usize, const POINTS: usize>(PhantomData<L>);

/// The status of a computation as C receives it.
#[inline(always)]
fn status_of(compute: impl FnOnce() -> Result<(), i32>) -> i32 {
    match compute() {
        Ok(()) => status::OK,
        Err(status) => status,
    }
}

impl<L: Library<N, TOOL, POINTS>, const N: usize, const TOOL: usize, const POINTS: usize>
    Exports<L, N, TOOL, POINTS>
{
    /// The version of the library.
    pub const fn version() -> i32 {
        numbers::VERSION
    }

    /// Fails to compile if the header reserves too few bytes for an object.
    pub const FITS: () = {
        let () = Self::CONTROLLER_FITS;
        assert!(size_of::<goal::Goal<L, N>>() <= numbers::GOAL_BYTES(N, POINTS));
        assert!(size_of::<goal::GoalChange<L, N>>() <= numbers::GOAL_CHANGE_BYTES(N, POINTS));
        assert!(size_of::<thermal::Thermal<L, N>>() <= numbers::THERMAL_BYTES(N, POINTS));
        assert!(size_of::<tip::Tip<L, N>>() <= numbers::TIP_BYTES(N, POINTS));
    };
}
