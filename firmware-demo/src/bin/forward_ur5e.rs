//! What M, forward dynamics and Jacobians cost on the UR5e.
#![no_std]
#![no_main]

mod costs;
#[path = "costs/engine.rs"]
mod engine;
#[path = "costs/forward.rs"]
mod forward;

use cortex_m_rt::entry;
use dynamics_core::robots::Ur5e;
use forward::Forms;

#[entry]
fn main() -> ! {
    forward::run::<Ur5e, 6, 6>(
        &costs::asks::<Ur5e, 6, 6>(),
        &[Forms::core::<Ur5e, 6>(), engine::engine::<Ur5e, 6, 6, 5>()],
    )
}
