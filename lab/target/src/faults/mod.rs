//! Arms under faults of every kind, at random times in random combinations, on the host and on the
//! target: which limits hold, and what each fault leads to.
//!
//! A run is determined by its seed: the same seeds give the same bits of torque on the host and in
//! QEMU.

mod arm;
mod kinds;
mod plants;
mod random;
mod run;

pub use arm::{Controller, HOLD, RIDE, Setup, Violation, controller};
pub use kinds::Kind;
pub use plants::{GimbalArm, Pendulum, Plant, TICK, Ur5eArm};
pub use run::{Observed, Outcome, TICKS, at_speed, run};

/// One run in so many is a UR5e, whose dynamics take longer, and one a gimbal.
const UR5E: u32 = 8;

/// The arm of a seed, by name, and its run; `observe` takes what was observed of each fault that
/// came alone.
///
/// # Errors
/// The limit that did not hold.
pub fn one(
    seed: u32,
    setup: Setup,
    observe: impl FnMut(Observed),
) -> (&'static str, Result<Outcome, Violation>) {
    match seed % UR5E {
        0 => (Ur5eArm::NAME, run::<Ur5eArm, 6>(seed, setup, observe)),
        4 => (GimbalArm::NAME, run::<GimbalArm, 3>(seed, setup, observe)),
        _ => (Pendulum::NAME, run::<Pendulum, 1>(seed, setup, observe)),
    }
}
