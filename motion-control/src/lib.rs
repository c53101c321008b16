//! Motion control of robot arms on a microcontroller: reference, estimate, control law, and the
//! safety gate that every command passes; in f32 or f64, with no heap, no panic and no `unsafe`.
//!
//! | module | contents |
//! |---|---|
//! | [`limits`] | what a command may be: limits, faults and their reactions, the command itself |
//! | [`estimate`] | what is known of the arm: velocities, external torques, loads, parameters |
//! | [`reference`](mod@reference) | where the arm should be: trajectories, goals, paths, and their timing |
//! | [`law`] | the torque from a reference and an estimate |
//! | [`safety`] | the gate that every command passes, and what detects faults |
//! | [`motion`] | a whole control loop without its law and devices, and how it stops and starts again |
//!
//! Each module uses those before it alone.
//!
//! Types with a configuration struct have a `try_new`, which checks the struct, and a `new` for
//! constants, which does not.
//!
//! Time is counted in integer ticks of one nominal length; nothing divides by a measured interval.
//! Items without memory give the same bits for the same inputs at any time; items with memory never
//! store a value that they reject. None of them panics or returns NaN.
//!
//! Cargo features, off by default, neither of which changes a number: `defmt` for faults, modes,
//! status, commands and errors; `serde` for limits, gains, configurations and way-points.
//!
//! The control loop of an arm:
//!
//! ```
#![doc = include_str!("example.rs")]
//!
//! use motion_control::reference::{Trajectory, WayPoint};
//!
//! let stop = |q, ticks| WayPoint { q, qd: [0.0; 6], ticks };
//! let home = [0.0, -1.57, 1.57, -1.57, -1.57, 0.0];
//! let away = [1.0, -1.2, 1.4, -1.57, -1.57, 0.0];
//! let speeds = [MotionLimits { velocity: 3.0, acceleration: 10.0 }; 6];
//! let trajectory = Trajectory::new(&[stop(home, 0), stop(away, 1000)], TICK, &speeds)?;
//! let torque = [150.0, 150.0, 150.0, 28.0, 28.0, 28.0];
//! let (lower, upper) = ([-6.3; 6], [6.3; 6]);
//! let limits = SafetyLimits { torque, rate: torque, speed: [3.2; 6], lower, upper };
//!
//! let (mut controller, gains) = (controller(limits)?, gains(&home));
//! // Each tick: from what the encoders latched in the tick before to what goes to drives and
//! // brake.
//! for measured in [Ok(&home), Ok(&home), Err(Fault::Encoder { joint: 2 })] {
//!     let command = controller.tick(measured, &trajectory, |reference, estimate| {
//!         law(&gains, reference, estimate)
//!     });
//!     assert_eq!((command.status.fault, command.brake), (measured.err(), false));
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![cfg_attr(not(test), no_std)]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod estimate;
pub mod law;
pub mod limits;
pub mod motion;
pub mod reference;
pub mod safety;
#[cfg(feature = "serde")]
mod serde_form;
#[cfg(test)]
mod tests;

use dynamics_core::scalar::Real;

/// A number of ticks as a scalar.
#[inline(always)]
fn real<R: Real>(ticks: u32) -> R {
    // One VCVT in f32: the other conversion, a call into software there, is dead code.
    R::select(f64::from(ticks), ticks as f32)
}

/// √x of a number that is zero or normal and not negative: without the division of the usual
/// routine, which is a call into software.
#[inline(always)]
fn root<R: Real>(x: R) -> R {
    x * x.rsqrt()
}

/// The entry of a joint's coordinate, or zero for a joint that has none.
#[inline(always)]
fn entry<T: Copy + Default>(values: &[T], at: usize) -> T {
    values.get(at).copied().unwrap_or_default()
}
